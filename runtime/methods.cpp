#include "runtime/methods.hpp"

#include <cassert>
#include <set>

#include "runtime/kernel_text.hpp"

namespace casimir {
namespace {

constexpr std::string_view kGaussText = "collocation at the Gauss nodes, symplectic and A-stable";
constexpr std::string_view kGaussBook =
    "Hairer, Lubich, Wanner: Geometric Numerical Integration (2006), II.1.3";
constexpr std::string_view kGauss = "runtime/kernels/gauss.hpp";
constexpr std::string_view kRadauText =
    "collocation at the Radau nodes, L-stable, for stiff and damped systems";
constexpr std::string_view kRadauBook =
    "Hairer, Wanner: Solving Ordinary Differential Equations II (1996), IV.5, IV.8";
constexpr std::string_view kRadau = "runtime/kernels/radau.hpp";
constexpr std::string_view kOdeint = "runtime/kernels/odeint.hpp";
constexpr std::string_view kTaylor = "runtime/kernels/convolved.hpp";
constexpr std::string_view kTaylorText =
    "Taylor series of order 8 to 24 by recurrences, for smooth problems";
constexpr std::string_view kTaylorBook =
    "Jorba, Zou: A software package for the numerical integration of ODEs (2005)";
// Short sums in a chain of dependent steps: packing them costs a third of the speed (GCC 12).
constexpr std::string_view kScalar = "no-tree-vectorize,no-tree-slp-vectorize";

// name, order, implicit, needs J, uses J, quadratic, fixed step, series, outside, header, entry,
// optimise, ..
constexpr Method kMethods[] = {
    {"dop853", 8, false, false, false, false, true, false, "", "runtime/kernels/dop853.hpp",
     "dop853::integrate<System>", "", "explicit Runge-Kutta method of Dormand and Prince",
     "Hairer, Norsett, Wanner: Solving Ordinary Differential Equations I (1993), II.5, II.10"},
    {"taylor", 0, false, false, false, false, true, true, "", kTaylor, "", "", kTaylorText,
     kTaylorBook},
    {"taylor-compiled", 0, false, false, false, false, true, true, "", kTaylor, "", "", kTaylorText,
     kTaylorBook},
    {"gauss4", 4, true, false, true, true, true, false, "", kGauss, "gauss::integrate<System, 2>",
     kScalar, kGaussText, kGaussBook},
    {"gauss6", 6, true, false, true, true, true, false, "", kGauss, "gauss::integrate<System, 3>",
     kScalar, kGaussText, kGaussBook},
    {"gauss8", 8, true, false, true, true, true, false, "", kGauss, "gauss::integrate<System, 4>",
     kScalar, kGaussText, kGaussBook},
    {"gauss12", 12, true, false, true, true, true, false, "", kGauss, "gauss::integrate<System, 6>",
     kScalar, kGaussText, kGaussBook},
    {"gauss16", 16, true, false, true, true, true, false, "", kGauss, "gauss::integrate<System, 8>",
     kScalar, kGaussText, kGaussBook},
    {"radau5", 5, true, false, true, false, true, false, "", kRadau, "radau::integrate<System, 3>",
     "", kRadauText, kRadauBook},
    {"radau9", 9, true, false, true, false, true, false, "", kRadau, "radau::integrate<System, 5>",
     "", kRadauText, kRadauBook},
    {"odeint-fehlberg78", 8, false, false, false, false, false, false, "Boost.Odeint", kOdeint,
     "odeint::integrate<System, odeint::runge_kutta_fehlberg78>", "",
     "Boost.Odeint, explicit Runge-Kutta method of Fehlberg of order 7(8)",
     "Ahnert, Mulansky: Odeint, AIP Conf. Proc. 1389 (2011) 1586"},
    {"odeint-dopri5", 5, false, false, false, false, false, false, "Boost.Odeint", kOdeint,
     "odeint::integrate<System, odeint::runge_kutta_dopri5>", "",
     "Boost.Odeint, explicit Runge-Kutta method of Dormand and Prince of order 5(4)",
     "Ahnert, Mulansky: Odeint, AIP Conf. Proc. 1389 (2011) 1586"},
    {"cvode-adams", 0, false, false, false, false, false, false, "SUNDIALS", "", "", "",
     "CVODE, Adams-Moulton methods of order 1 to 12 with functional iteration",
     "Hindmarsh et al., ACM Trans. Math. Softw. 31 (2005) 363"},
    {"cvode-bdf", 0, true, false, true, false, false, false, "SUNDIALS", "", "", "",
     "CVODE, backward differentiation formulas of order 1 to 5 with Newton iteration",
     "Hindmarsh et al., ACM Trans. Math. Softw. 31 (2005) 363"},
    {"arkode-erk", 8, false, false, false, false, false, false, "SUNDIALS", "", "", "",
     "ARKODE, explicit Runge-Kutta method of Fehlberg of order 8(7)",
     "Reynolds et al., ACM Trans. Math. Softw. 49 (2023) 19"},
};

/// Appends the text of a header after those it includes, each header once.
void append_header(std::string_view name, std::set<std::string>& seen, std::string& out) {
  if (!seen.emplace(name).second) return;
  const KernelText* found = nullptr;
  for (int i = 0; i < kKernelTextCount; ++i)
    if (name == kKernelTexts[i].name) found = kKernelTexts + i;
  assert(found && "a kernel includes what is not embedded");
  std::string_view text = found->text;
  constexpr std::string_view kInclude = "#include \"";
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    if (line.starts_with(kInclude)) {
      append_header(line.substr(kInclude.size(), line.rfind('"') - kInclude.size()), seen, out);
    } else if (!line.starts_with("#pragma once")) {
      out.append(line).push_back('\n');
    }
    text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
  }
}

}  // namespace

std::span<const Method> methods() { return kMethods; }

const Method* find_method(std::string_view name) {
  for (const Method& method : kMethods)
    if (method.name == name) return &method;
  return nullptr;
}

std::vector<std::string> method_names() {
  std::vector<std::string> names;
  for (const Method& method : kMethods) names.emplace_back(method.name);
  return names;
}

std::string kernel_source(const Method& method) {
  std::string out;
  std::set<std::string> seen;
  if (!method.optimise.empty()) {
    out.append("#if defined(__GNUC__) && !defined(__clang__)\n#pragma GCC optimize(\"");
    out.append(method.optimise).append("\")\n#endif\n");
  }
  append_header("runtime/module_abi.h", seen, out);
  if (method.header.empty()) return out;
  append_header(method.header, seen, out);
  if (method.entry.empty()) return out;
  out.append("\nnamespace casimir_kernel {\n\ntemplate <class System>\n");
  out.append("void integrate(const casimir_run* run, double* x, casimir_outcome* out) {\n  ");
  out.append(method.entry).append("(run, x, out);\n}\n\n}  // namespace casimir_kernel\n");
  return out;
}

std::string kernel_text(std::string_view header) {
  std::string out;
  std::set<std::string> seen;
  append_header(header, seen, out);
  return out;
}

}  // namespace casimir
