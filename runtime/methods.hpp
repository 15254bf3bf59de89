#pragma once

#include <span>
#include <string>
#include <string_view>

namespace casimir {

/// An integration method, as data. A new one is a kernel in `runtime/kernels` and a line in
/// `methods.cpp`; one of another library is a file here and a line there.
struct Method {
  std::string_view name;
  int order;
  std::string_view kernel;   ///< file in runtime/kernels; empty for a method of another library
  std::string_view call;     ///< what `integrate<System>` of a module calls
  std::string_view library;  ///< "SUNDIALS CVODE", ..; empty for our own
  bool implicit;
  bool keeps_quadratic;      ///< quadratic invariants stay at rounding level, whatever the step
  bool constant_step;        ///< can run with a constant step
  std::string_view description;
};

/// All of them, in the order in which tables show them.
std::span<const Method> methods();

/// The method of that name, or null.
const Method* find_method(std::string_view name);

/// C++ text to stand before a generated system: the interface, what the kernel includes, the kernel
/// and `casimir_kernel::integrate<System>`. For a method of another library only the interface.
std::string kernel_source(const Method& method);

}  // namespace casimir
