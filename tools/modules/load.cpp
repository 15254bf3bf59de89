#include "tools/modules/load.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <string>

#include "tools/cli/errors.hpp"

namespace casimir::tools {

namespace fs = std::filesystem;

fs::path module_file(const char* module) {
  std::error_code problem;
  const fs::path folder = fs::read_symlink("/proc/self/exe", problem).parent_path();
  // A path from the folder of whoever calls would load what lies there.
  if (problem) throw SystemError("where this program is cannot be told: /proc is not there");
  const std::string file = std::string(module) + ".so";
  const fs::path beside = folder / "modules" / file;
  if (fs::exists(beside, problem)) return beside;
  return (folder / CASIMIR_MODULES / file).lexically_normal();
}

void* module_symbol(const char* module, const char* symbol) {
  const std::string file = module_file(module).string();
  void* const handle = dlopen(file.c_str(), RTLD_NOW | RTLD_GLOBAL);
  void* const found = handle == nullptr ? nullptr : dlsym(handle, symbol);
  if (found == nullptr) {
    const char* const why = dlerror();
    throw SystemError(
        fmt::format("a part of casimir does not load: {}", why == nullptr ? file : why));
  }
  return found;
}

}  // namespace casimir::tools
