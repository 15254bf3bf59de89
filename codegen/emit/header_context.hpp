#pragma once

#include <string>
#include <vector>

#include "codegen/emit/statements.hpp"
#include "codegen/emit_cpp.hpp"
#include "codegen/specialise.hpp"

namespace casimir::codegen {

/// What codegen::statements wants for one function.
struct Slots {
  std::vector<std::string> sources, names, targets;
};

/// What the functions of a header are called, and what stands above them: of a flow or of a map.
struct MotionWords {
  std::string rhs, target, comment;
  std::string variational, deviation_target, deviation;
  std::string jacobian;   ///< the comment
  std::string conserved;  ///< in front of the names of the invariants
  std::string inverse;    ///< the comment of a map's inverse
};

/// What the parts of an emitted header share: its number type and its names.
struct HeaderContext {
  HeaderContext(const Specialisation& specialisation, const HeaderOptions& options);

  MotionWords words() const;
  bool has_parameters() const { return !spec.parameters.empty(); }
  /// "parameters", or "parameters<Real>" in a template.
  std::string parameter_type() const;
  /// "t, STATE, p, " as far as the functions take them.
  std::string arguments(const std::string& state) const;
  /// The number that output k of Specialisation::start is.
  std::string start_value(std::size_t k, Scalar scalar) const;
  /// Those of the initial state, with commas.
  std::string initial_values(Scalar scalar) const;
  /// For a function that writes one output after the other, or into a matrix by columns.
  Slots entries(const std::string& target, const Program& program,
                const SparseProgram* matrix) const;
  /// For the function `variational`: a deviation beside the state.
  Slots variational() const;

  const Specialisation& spec;
  bool is_template;
  StatementStyle style;
  std::vector<std::string> sources;  ///< for each input of the programs, e.g. "x[0]", "p.r", "t"
  std::vector<std::string> names;    ///< and the local variable that holds it
};

/// Where a sparse matrix by columns has entries, as lists of numbers.
struct Pattern {
  std::string columns, rows;
};

Pattern pattern_of(const SparseProgram& matrix, std::size_t columns);

/// The name of an include guard. (`#pragma once` would be a warning where the header is compiled
/// alone.)
/// \param scope  what the header is called
/// \param given  whether a person called it so: then `top` and `Top` are two headers
/// \param end  "HPP" or "H"
std::string guard_of(const std::string& scope, bool given, const std::string& end);

/// The texts as string literals with commas between them.
std::string quoted_list(const std::vector<std::string>& values);

/// "H, F1, K".
std::string listed(const std::vector<std::string>& names);

/// The classes and functions that make the header fit Boost.Odeint and CVODE.
std::string adapters(const HeaderContext& context);

/// A function template with the Taylor coefficients of the solution, and what it calls.
std::string taylor(const HeaderContext& context);

/// "  using std::sin;" and so on: in a template, functions of its number type are found beside that
/// type, those of double in std.
std::string using_declarations(const Program& program);

}  // namespace casimir::codegen
