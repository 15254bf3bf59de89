#pragma once

#include <ginac/ginac.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "symbolic/error.hpp"
#include "symbolic/poisson.hpp"

namespace casimir {

/// An expression with the name and the place that its case file gives it.
struct NamedExpression {
  std::string name;
  GiNaC::ex value;
  Location where;
};

/// `lhs RELATION rhs`, from an `assume` or a `domain`.
struct Assumption {
  enum class Relation { equal, not_equal, less, less_equal, greater, greater_equal };
  GiNaC::ex lhs;
  Relation relation;
  GiNaC::ex rhs;
  std::string text;
};

/// A function whose zero level is invariant (`conditional`: that is a first integral there) on the
/// common zero level of `on`.
struct LevelClaim {
  NamedExpression expression;
  std::vector<NamedExpression> on;
};

/// Initial data for a run. All values are exact constants (rational, or such as sqrt(2)).
struct Scene {
  std::string name;
  Location where;
  std::vector<GiNaC::ex> parameters;  ///< one for each of Model::parameters
  std::vector<GiNaC::ex> initial;     ///< one for each of Model::variables
  GiNaC::ex duration;
  std::vector<std::string> observe;              ///< empty: everything
  std::string extreme;                           ///< empty, "separatrix", "stiff", "scale", ..
  std::vector<std::optional<GiNaC::ex>> reference;  ///< empty, or one for each variable
};

/// A case file made mathematical. Owns every symbol: GiNaC compares symbols by identity, so no
/// other code may create one of the same name and expect it to match.
struct Model {
  std::string name;  ///< file name without folder and extension
  std::string file;
  std::string title;
  std::string source;
  std::vector<std::string> tags;
  bool integrable = false;

  std::string phase_space;  ///< "e(3)", "canonical", "explicit brackets", "equations", ..
  std::vector<GiNaC::symbol> variables;
  std::vector<GiNaC::symbol> parameters;
  std::optional<GiNaC::symbol> time;  ///< set where the file names it
  std::vector<Assumption> assumptions;

  std::optional<PoissonStructure> poisson;    ///< none for a system given by [equations]
  std::optional<GiNaC::ex> hamiltonian;       ///< none for a system given by [equations]
  std::vector<GiNaC::ex> field;               ///< dx_i/dt for each variable, not expanded

  std::vector<NamedExpression> definitions;
  std::vector<NamedExpression> casimirs;
  std::vector<NamedExpression> integrals;
  std::vector<LevelClaim> conditionals;
  std::vector<LevelClaim> invariant_relations;
  std::vector<Scene> scenes;

  /// The scene of that name; "default" may also mean the first one.
  /// \throws CaseError  if there is none; the message lists the names.
  const Scene& scene(const std::string& scene_name) const;

  /// `expression` with every parameter replaced by the scene's exact value.
  GiNaC::ex at_parameters(const GiNaC::ex& expression, const Scene& scene) const;
};

}  // namespace casimir
