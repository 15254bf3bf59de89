#include "runtime/methods.hpp"

#include <cassert>
#include <set>

#include "runtime/step/kernel_text.hpp"

namespace casimir {
namespace {

constexpr Method gauss(std::string_view name, int order, std::string_view entry) {
  return {.name = name,
          .order = order,
          .implicit = true,
          .uses_jacobian = true,
          .preserves_quadratic = true,
          .fixed_step_ok = true,
          .header = "runtime/kernels/one_step/gauss.hpp",
          .entry = entry,
          // Short sums in a chain of dependent steps: packing them costs a third of the speed (GCC
          // 12).
          .optimise = "no-tree-vectorize,no-tree-slp-vectorize",
          .description = "collocation at the Gauss nodes, symplectic and A-stable",
          .literature = "Hairer, Lubich, Wanner: Geometric Numerical Integration (2006), II.1.3"};
}

constexpr Method radau(std::string_view name, int order, std::string_view entry) {
  return {.name = name,
          .order = order,
          .implicit = true,
          .uses_jacobian = true,
          .fixed_step_ok = true,
          .header = "runtime/kernels/one_step/radau.hpp",
          .entry = entry,
          .description = "collocation at the Radau nodes, L-stable, for stiff and damped systems",
          .literature =
              "Hairer, Wanner: Solving Ordinary Differential Equations II (1996), IV.5, "
              "IV.8"};
}

constexpr Method splitting(std::string_view name, int order, std::string_view entry) {
  return {.name = name,
          .order = order,
          .fixed_step_ok = true,
          .splits = true,
          .header = "runtime/kernels/one_step/splitting.hpp",
          .entry = entry,
          .description = "composition of exact flows of parts of the Hamiltonian, a Poisson map",
          .literature =
              "Hairer, Lubich, Wanner: Geometric Numerical Integration (2006), II.5, "
              "V.3, VII.4"};
}

/// Taylor series; the integrator is precompiled.
constexpr Method taylor(std::string_view name) {
  return {.name = name,
          .fixed_step_ok = true,
          .series = true,
          .header = "runtime/kernels/taylor/convolved.hpp",
          .description = "Taylor series of order 8 to 24 by recurrences, for smooth problems",
          .literature =
              "Jorba, Zou: A software package for the numerical integration of ODEs "
              "(2005)"};
}

constexpr Method odeint(std::string_view name, int order, std::string_view entry,
                        std::string_view description) {
  return {.name = name,
          .order = order,
          .outside = "Boost.Odeint",
          .header = "runtime/kernels/one_step/odeint.hpp",
          .entry = entry,
          .description = description,
          .literature = "Ahnert, Mulansky: Odeint, AIP Conf. Proc. 1389 (2011) 1586"};
}

constexpr std::string_view kCvode = "Hindmarsh et al., ACM Trans. Math. Softw. 31 (2005) 363";

constexpr Method kMethods[] = {
    {.name = "dop853",
     .order = 8,
     .fixed_step_ok = true,
     .header = "runtime/kernels/one_step/dop853.hpp",
     .entry = "dop853::integrate<System>",
     .description = "explicit Runge-Kutta method of Dormand and Prince",
     .literature = "Hairer, Norsett, Wanner: Solving Ordinary Differential Equations I (1993), "
                   "II.5, II.10"},
    {.name = "dopri5",
     .order = 5,
     .fixed_step_ok = true,
     .header = "runtime/kernels/one_step/dopri5.hpp",
     .entry = "dopri5::integrate<System>",
     .description = "explicit Runge-Kutta pair of Dormand and Prince of order 5(4), for few digits",
     .literature = "Hairer, Norsett, Wanner: Solving Ordinary Differential Equations I (1993), "
                   "II.5, II.6"},
    taylor("taylor"),
    taylor("taylor-compiled"),
    gauss("gauss4", 4, "gauss::integrate<System, 2>"),
    gauss("gauss6", 6, "gauss::integrate<System, 3>"),
    gauss("gauss8", 8, "gauss::integrate<System, 4>"),
    gauss("gauss12", 12, "gauss::integrate<System, 6>"),
    gauss("gauss16", 16, "gauss::integrate<System, 8>"),
    gauss("midpoint", 2, "gauss::integrate<System, 1>"),
    {.name = "kahan",
     .order = 2,
     .uses_jacobian = true,
     .fixed_step_ok = true,
     .quadratic_only = true,
     .header = "runtime/kernels/one_step/kahan.hpp",
     .entry = "kahan::integrate<System>",
     .description = "Kahan's map of quadratic equations, one linear system a step",
     .literature = "Celledoni, McLachlan, Owren, Quispel: J. Phys. A 46 (2013) 025201"},
    {.name = "moser-veselov",
     .order = 2,
     .fixed_step_ok = true,
     .free_body = true,
     .header = "runtime/kernels/one_step/moser_veselov.hpp",
     .entry = "moser_veselov::integrate<System>",
     .description = "Moser's and Veselov's map of a free rigid body, which keeps all integrals",
     .literature = "Moser, Veselov: Commun. Math. Phys. 139 (1991) 217"},
    radau("radau5", 5, "radau::integrate<System, 3>"),
    radau("radau9", 9, "radau::integrate<System, 5>"),
    splitting("splitting6", 6, "splitting::integrate<System, 6>"),
    splitting("splitting", 8, "splitting::integrate<System, 8>"),
    {.name = "exact",
     .closed_form = true,
     .description = "elliptic and elementary functions, of systems that are recognised",
     .literature = "Whittaker: A Treatise on the Analytical Dynamics of Particles and Rigid "
                   "Bodies (1937), VI"},
    odeint("odeint-fehlberg78", 8, "odeint::integrate<System, odeint::runge_kutta_fehlberg78>",
           "Boost.Odeint, explicit Runge-Kutta method of Fehlberg of order 7(8)"),
    odeint("odeint-dopri5", 5, "odeint::integrate<System, odeint::runge_kutta_dopri5>",
           "Boost.Odeint, explicit Runge-Kutta method of Dormand and Prince of order 5(4)"),
    {.name = "cvode-adams",
     .outside = "SUNDIALS",
     .description = "CVODE, Adams-Moulton methods of order 1 to 12 with functional iteration",
     .literature = kCvode},
    {.name = "cvode-bdf",
     .implicit = true,
     .uses_jacobian = true,
     .outside = "SUNDIALS",
     .description = "CVODE, backward differentiation formulas of order 1 to 5 with Newton "
                    "iteration",
     .literature = kCvode},
    {.name = "arkode-erk",
     .order = 8,
     .outside = "SUNDIALS",
     .description = "ARKODE, explicit Runge-Kutta method of Fehlberg of order 8(7)",
     .literature = "Reynolds et al., ACM Trans. Math. Softw. 49 (2023) 19"},
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
