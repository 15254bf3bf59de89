#pragma once

#include <optional>
#include <string>

#include "codegen/emit/number_literal.hpp"
#include "codegen/specialise.hpp"
#include "codegen/split.hpp"

namespace casimir {

/// What a header is written in.
enum class Language { cpp, c };

/// What a header is like.
struct HeaderOptions {
  Scalar scalar = Scalar::real64;
  bool sparse_jacobian = false;  ///< `jacobian_entries` as well
  Language language = Language::cpp;
  /// Of the namespace, the include guard, and in C the prefix, so that several headers of one case
  /// go into one program; none: the name of the case.
  std::optional<std::string> name = {};
};

/// A C++20 header that needs nothing of casimir: a namespace named after the case with
/// `dimension`, the names and initial values of the states, `duration`, `rhs`, `invariants`,
/// `gradients` of the invariants and `jacobian` (by columns) with its pattern, as far as the
/// specialisation has them, and adapters:
/// `system` is a right-hand side for Boost.Odeint, `stiff_system` one for its Rosenbrock methods,
/// `sundials_rhs<N_Vector>` and `sundials_jacobian<N_Vector, SUNMatrix>` are for CVODE (double
/// only). Run-time parameters come as a struct whose defaults are the values of the scene.
///
/// Where they were asked for: `variational` carries a small deviation along with the state, and
/// `taylor<Order>` writes the Taylor coefficients of the solution.
///
/// In C99 the same functions and tables have the name of the case in front, as in
/// `kovalevskaya_rhs`, and there are no adapters: a callback of CVODE is three lines around `rhs`.
///
/// Compiles alone and without warnings; includes `<cmath>` only where a function is called, and
/// `<quadmath.h>` for float128. The same bytes in every process.
/// \throws ModelError  for a number outside the range of the number type, for a name that is no
///                     identifier, and for what C has no form of: templates, float128 and Taylor
///                     coefficients.
std::string emit_header(const Specialisation& specialisation, const HeaderOptions& options = {});

/// What the kernel of a method asks of `System` beside the right-hand side.
struct KernelNeeds {
  /// Instead of `casimir_integrate`, what the precompiled integrator along Taylor series calls; the
  /// kernel is then the storage of recurrences (runtime/kernels/taylor/convolved.hpp).
  bool series = false;
  /// The flows of the parts of the Hamiltonian, for runtime/kernels/one_step/splitting.hpp.
  std::optional<Splitting> splitting = {};
  /// Of a free body, for runtime/kernels/one_step/moser_veselov.hpp; see `free_body_moments`.
  std::optional<Program> moments = {};
};

/// The text of a module as in runtime/module_abi.h, in double. It includes nothing.
/// \param kernel_source  C++ text that holds the interface and a template
///        `casimir_kernel::integrate<System>(const casimir_run*, double*, casimir_outcome*)`;
///        empty: the module has no `casimir_integrate`.
/// `System` has `n`, `rhs(t, x, p, dx)` and, where the specialisation has it, `jacobian(t, x, p,
/// J)` by columns, all entries.
std::string emit_module(const Specialisation& specialisation, const std::string& kernel_source = {},
                        const KernelNeeds& needs = {});

/// The text of a module for ensembles: Taylor series, one trajectory in each lane of a register.
/// Run-time parameters are those of a member. Quadratic systems have a better one, see
/// lane_form.hpp.
/// \param kernel_source  the text of runtime/kernels/lanes/lane_convolved.hpp with all it includes.
std::string emit_series_lanes(const Specialisation& specialisation,
                              const std::string& kernel_source);

/// Whether the code of the specialisation calls functions of the mathematical library.
bool needs_math_library(const Specialisation& specialisation);

/// "9 multiplications, 5 additions, 0 divisions, 0 calls".
std::string cost_text(const OperationCount& count);

namespace codegen {

/// The comment at the head of generated code: where it comes from and what was left out.
/// \param with_values  also the scene and its values of run-time parameters, which the code does
/// not
///                     depend on.
std::string head_comment(const Specialisation& specialisation, bool with_values);

/// The comment below it in what a user takes away.
std::string ownership_comment();

/// emit_header for Language::c.
std::string emit_c_header(const Specialisation& specialisation, const HeaderOptions& options);

}  // namespace codegen
}  // namespace casimir
