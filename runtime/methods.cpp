#include "runtime/methods.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <sstream>

#include "runtime/embedded.hpp"

namespace casimir {
namespace {

constexpr std::array kMethods = {
    Method{"dop853", 8, "dop853.hpp", "dop853::integrate<System>", "", false, false, true,
           "Dormand-Prince 8(5,3), explicit, with dense output"},
    Method{"gauss4", 4, "gauss.hpp", "gauss::integrate<System, 2>", "", true, true, true,
           "Gauss-Legendre collocation with 2 stages, symplectic for a constant step"},
    Method{"gauss6", 6, "gauss.hpp", "gauss::integrate<System, 3>", "", true, true, true,
           "Gauss-Legendre collocation with 3 stages, symplectic for a constant step"},
    Method{"gauss8", 8, "gauss.hpp", "gauss::integrate<System, 4>", "", true, true, true,
           "Gauss-Legendre collocation with 4 stages, symplectic for a constant step"},
    Method{"cvode-adams", 12, "", "", "SUNDIALS CVODE", false, false, false,
           "Adams-Moulton of order 1 to 12, functional iteration"},
    Method{"cvode-bdf", 5, "", "", "SUNDIALS CVODE", true, false, false,
           "backward differentiation of order 1 to 5, Newton iteration"},
};

/// Appends the text of a file of this stage, with its includes put in place, each once.
void append(std::string& text, const std::string& file, std::set<std::string>& seen) {
  if (!seen.insert(file).second) return;
  std::istringstream lines{std::string(embedded_file(file))};
  const std::string include = "#include \"";
  for (std::string line; std::getline(lines, line);) {
    if (line == "#pragma once") continue;
    if (line.starts_with(include)) {
      append(text, line.substr(include.size(), line.rfind('"') - include.size()), seen);
    } else {
      text += line + '\n';
    }
  }
}

}  // namespace

std::span<const Method> methods() { return kMethods; }

const Method* find_method(std::string_view name) {
  const auto it = std::find_if(kMethods.begin(), kMethods.end(), [&](const Method& m) { return m.name == name; });
  return it == kMethods.end() ? nullptr : &*it;
}

std::string kernel_source(const Method& method) {
  std::string text;
  std::set<std::string> seen;
  append(text, "runtime/module_abi.h", seen);
  if (method.kernel.empty()) return text;
  append(text, "runtime/kernels/" + std::string(method.kernel), seen);
  text += "\nnamespace casimir_kernel {\ntemplate <class System>\n"
          "void integrate(const casimir_run* run, double* x, casimir_outcome* out) {\n  " +
          std::string(method.call) + "(run, x, out);\n}\n}  // namespace casimir_kernel\n";
  return text;
}

}  // namespace casimir
