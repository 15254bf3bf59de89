#include "tools/cli/machine.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/utsname.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>
#if __has_include(<boost/version.hpp>)
#include <boost/version.hpp>
#endif

#include "codegen/compile.hpp"
#include "codegen/compile/compiler.hpp"
#include "runtime/instruction_set.hpp"
#include "runtime/outside/sundials_version.hpp"

namespace casimir::tools {
namespace {

/// The value after the colon of the first line of /proc/cpuinfo with this key, or empty.
std::string processor_entry(const std::string& key) {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    const std::size_t colon = line.find(':');
    if (colon == std::string::npos || !line.starts_with(key)) continue;
    const std::size_t value = line.find_first_not_of(' ', colon + 1);
    return value == std::string::npos ? "" : line.substr(value);
  }
  return "";
}

std::vector<std::string> vector_flags() {
  std::vector<std::string> found;
  std::istringstream flags(processor_entry("flags"));
  for (std::string flag; flags >> flag;) {
    for (const char* known : {"sse2", "avx", "avx2", "fma", "avx512f", "avx512dq", "avx512vl"})
      if (flag == known) found.push_back(flag);
  }
  return found;
}

/// The first line of what the compiler says of itself; empty where there is none.
std::string compiler_version() {
  std::string pattern = (std::filesystem::temp_directory_path() / "casimir-XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) return "";
  std::string text;
  try {
    text = codegen::run_compiler(codegen::find_compiler(""), {"--version"}, pattern).messages;
  } catch (const EnvironmentError&) {
  }
  std::error_code ignored;
  std::filesystem::remove_all(pattern, ignored);
  return text.substr(0, text.find('\n'));
}

}  // namespace

Machine this_machine() {
  utsname system = {};
  uname(&system);
  Machine machine;
  machine.processor = processor_entry("model name");
  if (machine.processor.empty()) machine.processor = system.machine;
  machine.flags = vector_flags();
  machine.instructions = name_of(chosen_instruction_set());
  machine.cores = std::thread::hardware_concurrency();
  machine.system = fmt::format("{} {} {}", system.sysname, system.release, system.machine);
  if (const std::string compiler = compiler_version(); !compiler.empty())
    machine.versions.emplace_back("compiler", compiler);
  machine.versions.emplace_back("SUNDIALS", sundials_version());
#ifdef BOOST_VERSION
  machine.versions.emplace_back(
      "Boost", fmt::format("{}.{}", BOOST_VERSION / 100000, BOOST_VERSION / 100 % 1000));
#endif
  machine.versions.emplace_back("casimir", CASIMIR_VERSION);
  return machine;
}

std::string processor_text(const Machine& machine) {
  std::string text =
      fmt::format("{}, {} core{}", machine.processor, machine.cores, machine.cores == 1 ? "" : "s");
  if (!machine.flags.empty()) text += fmt::format(", {}", fmt::join(machine.flags, " "));
  return text + "; kernels and generated code for " + machine.instructions;
}

std::string versions_text(const Machine& machine) {
  std::vector<std::string> parts;
  for (const auto& [name, version] : machine.versions)
    parts.push_back(name == "compiler" ? version : name + " " + version);
  return fmt::format("{}", fmt::join(parts, ", "));
}

void add_to_json(nlohmann::ordered_json& document, const Machine& machine) {
  document["machine"] = {{"cpu", machine.processor},
                         {"flags", machine.flags},
                         {"instructions", machine.instructions},
                         {"cores", machine.cores},
                         {"system", machine.system}};
  nlohmann::ordered_json versions = nlohmann::ordered_json::object();
  for (const auto& [name, version] : machine.versions) versions[name] = version;
  document["versions"] = versions;
}

}  // namespace casimir::tools
