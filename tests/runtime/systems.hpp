#pragma once

#include <cmath>
#include <vector>

#include "runtime/integrate.hpp"
#include "runtime/kernels/one_step/dop853.hpp"
#include "runtime/kernels/one_step/dopri5.hpp"
#include "runtime/kernels/one_step/gauss.hpp"
#include "runtime/kernels/one_step/radau.hpp"
#include "runtime/methods.hpp"
#include "runtime/program.hpp"

// Problems with known solutions, as the classes that kernels are instantiated with.
namespace casimir::test {

/// Euler's free top with moments such that M = (k cn-like ..): see `euler_solution`.
struct Euler {
  static constexpr int n = 3;
  static constexpr double a[3] = {1, 0.5, 0.25};
  static void rhs(double, const double* m, const double*, double* d) {
    d[0] = (a[2] - a[1]) * m[1] * m[2];
    d[1] = (a[0] - a[2]) * m[0] * m[2];
    d[2] = (a[1] - a[0]) * m[0] * m[1];
  }
  static void jacobian(double, const double* m, const double*, double* J) {
    const double r[3] = {a[2] - a[1], a[0] - a[2], a[1] - a[0]};
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) J[3 * j + i] = i == j ? 0 : r[i] * m[3 - i - j];
  }
};

/// Kovalevskaya's top of the oracle scene; invariants H, F1, F2, K.
struct Kovalevskaya {
  static constexpr int n = 6;
  static void rhs(double, const double* x, const double*, double* d) {
    const double M1 = x[0], M2 = x[1], M3 = x[2], g1 = x[3], g2 = x[4], g3 = x[5];
    d[0] = M2 * M3;
    d[1] = -M1 * M3 - g3;
    d[2] = g2;
    d[3] = -M2 * g3 + 2 * M3 * g2;
    d[4] = M1 * g3 - 2 * M3 * g1;
    d[5] = -M1 * g2 + M2 * g1;
  }
  static void invariants(double, const double* x, const double*, double* v) {
    const double M1 = x[0], M2 = x[1], M3 = x[2], g1 = x[3], g2 = x[4], g3 = x[5];
    v[0] = (M1 * M1 + M2 * M2) / 2 + M3 * M3 - g1;
    v[1] = g1 * g1 + g2 * g2 + g3 * g3;
    v[2] = M1 * g1 + M2 * g2 + M3 * g3;
    const double re = M1 * M1 - M2 * M2 + 2 * g1, im = 2 * M1 * M2 + 2 * g2;
    v[3] = re * re + im * im;
  }
  static std::vector<double> initial() { return {1, 0.5, 0.25, 0.6, 0, 0.8}; }
  /// The state at t = 100 to 34 digits (two Taylor runs of 45 and 90 digits).
  static constexpr const char* kReference[6] = {
      "9.314032994660502364310950999798322e-1",  "-7.727771548496725187650202251736759e-1",
      "-2.165199782262415614360373243103645e-1", "6.917292196279919174252871365318238e-1",
      "8.284220645188389721404163384672686e-4",  "-7.221564930330075899430591212925448e-1"};
};

/// x'' = -x, from (1, 0): (cos t, -sin t).
struct Oscillator {
  static constexpr int n = 2;
  static void rhs(double, const double* x, const double*, double* d) {
    d[0] = x[1];
    d[1] = -x[0];
  }
  static void invariants(double, const double* x, const double*, double* v) {
    v[0] = x[0] * x[0] + x[1] * x[1];
  }
};

/// x' = x cos t, from 1: exp(sin t). The time enters.
struct Forced {
  static constexpr int n = 1;
  static void rhs(double t, const double* x, const double*, double* d) {
    d[0] = x[0] * std::cos(t);
  }
  static void jacobian(double t, const double*, const double*, double* J) { J[0] = std::cos(t); }
};

/// x' = x^2: x0 / (1 - x0 t), with a pole at 1/x0.
struct Square {
  static constexpr int n = 1;
  static void rhs(double, const double* x, const double*, double* d) { d[0] = x[0] * x[0]; }
};

/// x' = -1 / (2x), from 1: sqrt(1 - t), which ends at t = 1 with a finite state.
struct Root {
  static constexpr int n = 1;
  static void rhs(double, const double* x, const double*, double* d) { d[0] = -0.5 / x[0]; }
};

/// x' = sqrt(x) - 1: the right-hand side ceases to exist at x = 0, which is reached in finite time.
struct Edge {
  static constexpr int n = 1;
  static void rhs(double, const double* x, const double*, double* d) { d[0] = std::sqrt(x[0]) - 1; }
};

/// x' = p (cos t - x): stiff for large p.
struct Stiff {
  static constexpr int n = 1;
  static void rhs(double t, const double* x, const double* p, double* d) {
    d[0] = p[0] * (std::cos(t) - x[0]);
  }
  static void jacobian(double, const double*, const double* p, double* J) { J[0] = -p[0]; }
};

/// x'' = t^p, from rest at zero: t^(p+2) / ((p+1)(p+2)). Nothing moves at the start.
struct Pushed {
  static constexpr int n = 2;
  static void rhs(double t, const double* x, const double* p, double* d) {
    d[0] = x[1];
    d[1] = std::pow(t, p[0]);
  }
  static void jacobian(double, const double*, const double*, double* J) {
    J[0] = J[1] = J[3] = 0;
    J[2] = 1;
  }
};

template <class System>
void no_invariants(double, const double*, const double*, double*) {}

/// A module of a hand-written system with a kernel, as generated code would give it.
template <class System>
Module module_of(void (*integrate)(const casimir_run*, double*, casimir_outcome*),
                 int parameters = 0, int invariants = 0) {
  ModuleFunctions functions;
  functions.dimension = System::n;
  functions.parameter_count = parameters;
  functions.invariant_count = invariants;
  functions.rhs = System::rhs;
  functions.invariants = no_invariants<System>;
  if constexpr (requires { System::invariants; }) functions.invariants = System::invariants;
  if constexpr (requires { System::jacobian; }) functions.jacobian = System::jacobian;
  functions.integrate = integrate;
  return Module::from_functions(functions);
}

template <class System>
auto* const dop853 = &casimir_kernel::dop853::integrate<System>;
template <class System>
auto* const dopri5 = &casimir_kernel::dopri5::integrate<System>;
template <class System, int stages>
auto* const gauss = &casimir_kernel::gauss::integrate<System, stages>;
template <class System, int stages>
auto* const radau = &casimir_kernel::radau::integrate<System, stages>;

/// The kernel of this name for a system.
template <class System>
auto kernel(const std::string& name) {
  return name == "dop853"     ? dop853<System>
         : name == "dopri5"   ? dopri5<System>
         : name == "midpoint" ? gauss<System, 1>
         : name == "gauss4"   ? gauss<System, 2>
         : name == "gauss6"   ? gauss<System, 3>
         : name == "gauss8"   ? gauss<System, 4>
         : name == "gauss12"  ? gauss<System, 6>
         : name == "radau5"   ? radau<System, 3>
         : name == "radau9"   ? radau<System, 5>
                              : gauss<System, 8>;
}

/// Integrates a hand-written system by a method of that name, own or outside.
template <class System>
Trajectory run(const std::string& name, const Settings& settings, std::vector<double> initial,
               std::vector<double> parameters = {}, int invariants = 0) {
  const Method& method = *find_method(name);
  const Module module = module_of<System>(method.outside.empty() ? kernel<System>(name) : nullptr,
                                          static_cast<int>(parameters.size()), invariants);
  return integrate(module, method, settings, initial, parameters);
}

/// Methods that need no more than the right-hand side of a hand-written system: those with a kernel
/// of our own, and those of a library that we link to.
inline std::vector<std::string> own_methods() {
  std::vector<std::string> names;
  for (const Method& method : methods())
    if (method.outside.empty() && !method.series && !method.splits && !method.closed_form &&
        !method.quadratic_only && !method.free_body)
      names.emplace_back(method.name);
  return names;
}
inline std::vector<std::string> own_and_linked_methods() {
  std::vector<std::string> names = own_methods();
  for (const Method& method : methods())
    if (!method.outside.empty() && method.header.empty()) names.emplace_back(method.name);
  return names;
}

inline std::string test_name(const std::string& name) {
  std::string result = name;
  for (char& c : result)
    if (c == '-') c = '_';
  return result;
}

}  // namespace casimir::test
