#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace casimir {

/// A numerical method as users name it, with the properties that other parts rely on.
struct Method {
  std::string_view name;
  int order = 0;                     ///< of the global error; 0 = variable
  bool implicit = false;             ///< solves equations in every step; suited to stiff systems
  bool uses_jacobian = false;        ///< is faster or more robust with it
  bool preserves_quadratic = false;  ///< keeps quadratic invariants up to rounding
  bool fixed_step_ok = false;        ///< accepts Settings::fixed_step
  bool series = false;               ///< needs the recurrences of the system's Taylor coefficients
  bool splits = false;               ///< follows the flows of the parts of a Hamiltonian
  bool closed_form = false;     ///< takes no steps: evaluates the solution of systems that have one
  bool quadratic_only = false;  ///< is defined for equations that are polynomials of degree two
  bool free_body =
      false;  ///< is defined for a free rigid body, and asks for its moments of inertia
  std::string_view outside = {};  ///< the library that does it, or empty: a kernel of our own
  std::string_view header = {};   ///< of the kernel, in kernels/; empty: a library calls rhs
  std::string_view entry = {};    ///< the function template of the kernel, called with <System ..>;
                                  ///< empty: the integrator is precompiled, the kernel is storage
  std::string_view optimise = {};  ///< options of GCC under which the kernel is fastest, or empty
  std::string_view description = {};
  std::string_view literature = {};
};

/// All methods, own ones first. A new one is a header in `kernels/` and a line in methods.cpp.
std::span<const Method> methods();

/// The method of this name, or null.
const Method* find_method(std::string_view name);

/// The names, for messages.
std::vector<std::string> method_names();

/// The text to compile in front of a generated right-hand side: the plain C interface and the
/// kernel, with all that they include, ending in
///
///     namespace casimir_kernel {
///     template <class System> void integrate(const casimir_run*, double*, casimir_outcome*);
///     }
///
/// For a method without a header the interface alone, and for one without an entry no `integrate`.
/// The same text every time; the kernels of outside methods include their library's headers.
std::string kernel_source(const Method& method);

/// The text of one header of `kernels/` with all that it includes.
std::string kernel_text(std::string_view header);

}  // namespace casimir
