#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "runtime/module_abi.h"

namespace casimir {

/// The entry points of a module, as runtime/module_abi.h names them. Null where it has none.
struct ModuleFunctions {
  int dimension = 0;
  int parameter_count = 0;
  int invariant_count = 0;
  void (*rhs)(double t, const double* x, const double* p, double* dx) = nullptr;
  void (*jacobian)(double t, const double* x, const double* p, double* J) = nullptr;
  void (*invariants)(double t, const double* x, const double* p, double* values) = nullptr;
  void (*integrate)(const casimir_run* run, double* x, casimir_outcome* outcome) = nullptr;
};

/// A loaded module. Owns the shared object; copies share it.
class Module {
 public:
  /// \throws std::runtime_error  if it cannot be loaded, lacks an entry point, or was written for
  ///                             another version of the interface.
  static Module load(const std::filesystem::path& shared_object);

  /// A module of functions that are part of the program itself.
  static Module from_functions(const ModuleFunctions& functions);

  const ModuleFunctions& functions() const { return functions_; }
  int dimension() const { return functions_.dimension; }

 private:
  ModuleFunctions functions_;
  std::shared_ptr<void> handle_;
};

}  // namespace casimir
