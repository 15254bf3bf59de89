#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace casimir::tools {

/// What run times depend on, besides the program.
struct Machine {
  std::string processor;           ///< as it calls itself, or the architecture
  std::vector<std::string> flags;  ///< of its vector instruction sets, those that matter here
  std::string instructions;        ///< the set that kernels and generated code use
  unsigned cores = 0;
  std::string system;  ///< "Linux 6.1.0 x86_64"
  /// The compiler that generated code went through, and the libraries beside us, with versions.
  std::vector<std::pair<std::string, std::string>> versions;
};

Machine this_machine();

/// "AMD EPYC, 2 cores, avx2 fma avx512f; kernels and generated code for avx512".
std::string processor_text(const Machine& machine);

/// "g++ (Debian 12.2.0-14) 12.2.0, SUNDIALS 6.4.1, Boost 1.74".
std::string versions_text(const Machine& machine);

/// The keys "machine" and "versions" of a document.
void add_to_json(nlohmann::ordered_json& document, const Machine& machine);

}  // namespace casimir::tools
