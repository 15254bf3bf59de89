#pragma once

#include <functional>
#include <memory>
#include <string>

#include "runtime/module_abi.h"

namespace casimir {

class StepWatch;
struct Program;

/// The entry points of a module, as module_abi.h describes them: functions of a shared object or,
/// where nothing was compiled, objects that carry a program.
struct ModuleFunctions {
  /// A function of time, state and parameters that writes numbers.
  using Evaluation = void(double t, const double* x, const double* p, double* values);
  /// A whole run.
  using Integration = void(const casimir_run*, double* x, casimir_outcome*);

  int dimension = 0;        ///< number of states n
  int parameter_count = 0;  ///< number of run-time parameters
  int invariant_count = 0;
  std::function<Evaluation> rhs;       ///< writes dx/dt
  std::function<Evaluation> jacobian;  ///< or empty
  std::function<Evaluation> invariants;
  std::function<Integration> integrate;  ///< or empty
};

/// A compiled system: a shared object, or functions of the program itself.
///
/// Movable, not copyable. The functions live as long as the module.
class Module {
 public:
  /// Opens a shared object.
  /// \throws std::runtime_error  naming the file and the reason: it cannot be loaded, was made for
  ///                             another version of the interface, or lacks an entry point.
  static Module load(const std::string& path);

  /// \throws std::invalid_argument  if the dimension is not positive, a count is negative, the
  ///                                right-hand side is missing, or invariants are but counted.
  static Module from_functions(const ModuleFunctions& functions);

  /// The entry points.
  const ModuleFunctions& functions() const { return functions_; }
  /// The number of states.
  int dimension() const { return functions_.dimension; }
  /// The number of run-time parameters.
  int parameter_count() const { return functions_.parameter_count; }
  /// The number of invariants.
  int invariant_count() const { return functions_.invariant_count; }
  /// Whether there is a Jacobian.
  bool has_jacobian() const { return functions_.jacobian != nullptr; }
  /// What its steps are watched for, or null: nothing in polynomials of low degree.
  const StepWatch* watch() const { return watch_.get(); }
  /// The equations of motion, where steps along Taylor series may work out their leading terms in
  /// more digits by them; or null.
  const Program* exact_rates() const { return exact_rates_.get(); }
  /// Tells what is integrated: the steps of runs are watched for what may be stepped over, and in
  /// long runs they are rounded less.
  /// \param rhs  the program of the right-hand side.
  void know_equations(const Program& rhs);
  /// Whether it can do a whole run by itself.
  bool has_integrate() const { return functions_.integrate != nullptr; }

 private:
  struct Close {
    void operator()(void* handle) const;
  };
  Module() = default;
  std::unique_ptr<void, Close> handle_;
  ModuleFunctions functions_;
  std::shared_ptr<const StepWatch> watch_;
  std::shared_ptr<const Program> exact_rates_;
};

}  // namespace casimir
