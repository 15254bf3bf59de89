#pragma once

#include <filesystem>
#include <string>

namespace casimir::codegen {

/// Why that shared object cannot be loaded, or empty. One that has lost its end is told from its
/// headers: to load it would end the process.
std::string loading_problem(const std::filesystem::path& object);

}  // namespace casimir::codegen
