#pragma once

#include <filesystem>

namespace casimir::tools {

/// Where the module of this name would be: beside the program in a build tree, in the folder of
/// libraries where it is installed. To load MPI, HDF5 and all that they bring with them takes
/// longer than to load the rest of the program, which asks for them hardly ever.
/// \throws SystemError  where the system does not say where the program is
std::filesystem::path module_file(const char* module);

/// What a module has under a name. It stays loaded.
/// \throws SystemError  where the module is not there or does not load
void* module_symbol(const char* module, const char* symbol);

}  // namespace casimir::tools
