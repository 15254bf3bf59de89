#pragma once

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "symbolic/case/limits.hpp"
#include "symbolic/model.hpp"

namespace casimir {

/// Whether a case has arbitrary functions.
bool has_arbitrary_functions(const Model& model);

/// Polynomials for the arbitrary functions of a case.
struct GivenFunctions {
  Limits limits;                                           ///< of the case
  GiNaC::exmap values;                                     ///< by the symbol of the function
  std::vector<std::pair<std::string, std::string>> texts;  ///< "U(r)" and "r^2 + r"
  bool complex_numbers = false;                            ///< as of the case
  /// What they were written with and show no longer: see Scene::lost_of_functions.
  std::map<std::string, std::vector<GiNaC::ex>> lost = {};

  /// An expression with these functions in place of the arbitrary ones.
  /// \throws TooLarge  beyond the limit `bits`
  GiNaC::ex put(const GiNaC::ex& expression) const;
  /// Puts them into an expression and into what it needs values of, to which is added what the
  /// expression does not show any longer: U(sqrt(q)) is 1 + q for U = 1 + r^2, where q >= 0.
  /// \throws ModelError  where a part of it becomes a constant that is no real number
  void put_into(GiNaC::ex& expression, std::vector<GiNaC::ex>& domain) const;
  /// The same of a function with a domain of its own.
  NamedExpression put(NamedExpression f) const;
};

/// What the functions that a scene gives were written with and show no longer, at every place of an
/// expression where they stand: sqrt(q) for U(q) with U = sqrt(r)^2.
/// \param values  of the functions, by their symbols
/// \param lost    see Scene::lost_of_functions
std::vector<GiNaC::ex> lost_of_functions_in(
    const GiNaC::ex& expression, const GiNaC::exmap& values,
    const std::map<std::string, std::vector<GiNaC::ex>>& lost, const Limits& limits);

/// Different choices, simple ones: of degrees 1, 2 and 3, a negative one, and small numbers.
std::vector<GivenFunctions> function_choices(const Model& model);

/// A case with the functions that a scene gives, and that scene, whose parameters are no functions.
/// \throws ModelError  where the scene does not say what one of them is
std::pair<Model, Scene> in_scene(const Model& model, const Scene& scene);
/// The same case alone; one without arbitrary functions as it is.
Model model_in_scene(const Model& model, const Scene& scene);

/// The error that a scene lacks a function. \param parameter  as in the model, "U(r)"
ModelError function_not_given(const std::string& scene, const std::string& parameter);

/// The case with given functions: what it claims is then about these alone.
Model with_functions(const Model& model, const GivenFunctions& given);

}  // namespace casimir
