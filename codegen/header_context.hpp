#pragma once

#include <string>
#include <vector>

#include "codegen/specialise.hpp"
#include "codegen/statements.hpp"

namespace casimir::codegen {

/// What the parts of an emitted header share: its number type and its names.
struct HeaderContext {
  HeaderContext(const Specialisation& specialisation, Scalar scalar);

  bool has_parameters() const { return !spec.parameters.empty(); }
  /// "parameters", or "parameters<Real>" in a template.
  std::string parameter_type() const;
  /// "t, STATE, p, " as far as the functions take them.
  std::string arguments(const std::string& state) const;

  const Specialisation& spec;
  bool is_template;
  StatementStyle style;
  std::vector<std::string> sources;  ///< for each input of the programs, e.g. "x[0]", "p.r", "t"
  std::vector<std::string> names;    ///< and the local variable that holds it
};

/// The classes and functions that make the header fit Boost.Odeint and CVODE.
std::string adapters(const HeaderContext& context);

/// A function template with the Taylor coefficients of the solution, and what it calls.
std::string taylor(const HeaderContext& context);

/// "  using std::sin;" and so on: in a template, functions of its number type are found beside that
/// type, those of double in std.
std::string using_declarations(const Program& program);

}  // namespace casimir::codegen
