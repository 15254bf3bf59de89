#pragma once

#include <ginac/ginac.h>

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "symbolic/case/limits.hpp"
#include "symbolic/case_file.hpp"
#include "symbolic/comparison.hpp"
#include "symbolic/error.hpp"
#include "symbolic/frame.hpp"
#include "symbolic/poisson.hpp"

namespace casimir {

/// An expression with the name and the place that its case file gives it.
struct NamedExpression {
  std::string name;
  GiNaC::ex value;
  Location where;
  /// Where one of these has no value, nor has the expression as it was written.
  std::vector<GiNaC::ex> domain{};
};

/// Their names, in order.
std::vector<std::string> names_of(const std::vector<NamedExpression>& list);

/// A condition from an `assume` or a `domain`: `difference` compared with 0.
struct Assumption {
  GiNaC::ex difference;
  Comparison comparison = Comparison::unequal;
  std::string text;  ///< as the file has it

  /// Whether it holds where `point` gives every symbol a rational value; false also where the
  /// difference has no value there or its sign is not decided by exact arithmetic.
  /// \throws TooLarge  beyond the limit `bits`
  bool holds_at(const GiNaC::exmap& point, const Limits& limits) const;
};

/// A function whose zero level is invariant (`conditional`: that is a first integral there) on the
/// common zero level of `on`.
struct LevelClaim {
  NamedExpression expression;
  std::vector<NamedExpression> on;
};

/// Two functions that are equal, where the functions `on` vanish.
struct Identity {
  std::string name;
  Location where;
  GiNaC::ex left, right;
  std::vector<NamedExpression> on;
  std::vector<GiNaC::ex> domain{};  ///< as of NamedExpression
};

/// `density * dx` is invariant: under the flow, or under that of every Hamiltonian.
struct Measure {
  NamedExpression density;
  bool every_hamiltonian = false;
};

/// dL/dt = [L, A] identically in the spectral parameter.
struct LaxPair {
  std::optional<GiNaC::symbol> spectral;
  GiNaC::matrix l, a;
  std::vector<GiNaC::ex> domain{};    ///< as of NamedExpression
  std::vector<NamedExpression> on{};  ///< it is one on this common zero level only; or empty
};

/// The default Poincare section: `function` = 0 crossed in one direction, and the plotted pair.
struct Section {
  GiNaC::ex function;
  bool upwards = true;
  std::vector<GiNaC::ex> plot;
};

/// A right inverse of a map on a part of its image.
struct MapInverse {
  std::vector<GiNaC::ex> expressions;   ///< one for each variable, over the target's coordinates
  std::vector<Assumption> domain;       ///< where on the target it is one
  std::vector<GiNaC::ex> defined_by{};  ///< as the domain of NamedExpression
};

/// A map from the phase space onto another one, claimed to be Poisson (`sign` 1) or anti-Poisson
/// (-1), where the functions `on` vanish.
struct PoissonMap {
  std::string name;
  Location where;
  PoissonStructure target;             ///< over its own symbols
  std::vector<GiNaC::ex> expressions;  ///< one for each coordinate of the target
  std::vector<NamedExpression> on;
  int sign = 1;
  std::string to;                      ///< the algebra or case that it leads to, or empty
  std::vector<NamedExpression> image;  ///< over the target's coordinates; vanish on the image
  std::vector<MapInverse> inverses;    ///< the first whose domain holds is used
  std::vector<GiNaC::ex> domain{};     ///< of the expressions and brackets, as of NamedExpression
  /// The inequalities of the target's domain at phi(x); its equations are in `image`.
  std::vector<Assumption> leads_to{};

  /// The target's brackets {y_i, y_j}, i < j, with the expressions put in for its coordinates.
  std::vector<GiNaC::ex> composed_brackets() const;
};

/// Why a scene is hard to integrate, as its file says it.
enum class Extreme { separatrix, stiff, scale, gimbal, long_run, blowup };

/// "separatrix", "stiff", "scale", "gimbal", "long" or "blowup".
std::string to_string(Extreme extreme);

/// All of them, in that order.
const std::vector<Extreme>& extremes();

/// Initial data for a run. All values are exact constants (rational, or such as sqrt(2)).
struct Scene {
  std::string name;
  Location where;
  std::vector<GiNaC::ex> parameters;  ///< one for each of Model::parameters
  std::vector<GiNaC::ex> initial;     ///< one for each of Model::variables
  std::optional<GiNaC::ex> duration;  ///< none: only what needs no end of a run can use it
  std::vector<std::string> observe;   ///< empty: everything
  std::optional<Extreme> extreme;     ///< none: an ordinary one
  std::vector<std::optional<GiNaC::ex>> reference;  ///< empty, or one for each variable
  std::string unusable;   ///< why it cannot be run although it was read; or empty
  bool singular = false;  ///< for that reason: its state has no image in the variables chosen
  /// What the functions among `parameters` were written with and show no longer, as sqrt(r) of
  /// sqrt(r)^2: by the name of the parameter, over the arguments in its value.
  std::map<std::string, std::vector<GiNaC::ex>> lost_of_functions = {};
};

/// A case file made mathematical. Owns every symbol: GiNaC compares symbols by identity, so no
/// other code may create one of the same name and expect it to match.
struct Model {
  std::string name;  ///< file name without folder and extension
  std::string file;
  std::string title;
  std::string source;
  std::string book;  ///< section or appendix of the book, as "2.4"; may be empty
  std::vector<std::string> tags;
  bool integrable = false;
  bool superintegrable = false;  ///< more integrals than Liouville's theorem needs, not all commute
  bool complex_numbers = false;  ///< its expressions use I

  std::string phase_space;  ///< "e(3)", "canonical", "explicit brackets", "equations", ..
  std::vector<GiNaC::symbol> variables;
  std::vector<GiNaC::symbol> parameters;
  std::optional<GiNaC::symbol> time;  ///< set where the file names it
  std::vector<Assumption> assumptions;
  std::vector<NamedExpression> constraints;  ///< vanish at the initial state of every scene

  bool linear_bracket = false;              ///< that of a Lie algebra
  std::optional<PoissonStructure> poisson;  ///< none for a system given by [equations]
  std::optional<GiNaC::ex> hamiltonian;     ///< none for a system given by [equations]
  std::optional<Frame> frame;               ///< set where the bracket is that of a frame
  std::vector<GiNaC::ex> field;             ///< dx_i/dt for each variable, not expanded
  std::vector<GiNaC::ex> domain;  ///< of the Hamiltonian or the equations, as of NamedExpression
  std::vector<GiNaC::ex> bracket_domain;  ///< the same of the bracket

  std::vector<NamedExpression> definitions;
  std::vector<std::pair<Text, GiNaC::ex>> fixed;  ///< parameters replaced by ParameterValues
  std::vector<NamedExpression> casimirs;
  std::vector<NamedExpression> integrals;
  std::vector<LevelClaim> conditionals;
  std::vector<LevelClaim> invariant_relations;
  std::vector<LaxPair> lax_pairs;
  std::vector<PoissonMap> maps;
  std::vector<Measure> measures;
  std::vector<Identity> identities;
  std::optional<Section> section;
  std::vector<Scene> scenes;
  Limits limits{};  ///< of its file; whatever is computed with the model is held to them

  /// The variables, then the parameters.
  std::vector<GiNaC::symbol> symbols() const;

  /// The scene of that name; "default" may also mean the first one.
  /// \throws CaseError      if there is none, the message lists the names; or it is unusable
  /// \throws SingularPoint  if its state has no image in the variables chosen
  const Scene& scene(const std::string& scene_name) const;

  /// Reads an expression over the variables, parameters, time, definitions, and the names of the
  /// Casimirs and integrals.
  /// \throws CaseError
  GiNaC::ex parse(const Text& text) const;
  /// The same, with its text for a name.
  NamedExpression parse_named(const Text& text) const;
  /// The same for "LEFT = RIGHT".
  Identity parse_identity(const Text& text) const;

  /// df/dt along the flow, with the explicit dependence on time; not expanded.
  GiNaC::ex rate(const GiNaC::ex& f) const;

  /// What a scene has in place of each parameter: exact numbers, and functions with these in them.
  GiNaC::exmap parameter_values(const Scene& scene) const;
  /// `expression` with every parameter replaced by the scene's exact value.
  GiNaC::ex at_parameters(const GiNaC::ex& expression, const Scene& scene) const;
};

/// The case without what it assumes of its variables. The start of a motion obeys that; what comes
/// after it, or where a map leads, need not.
Model anywhere(const Model& model);

/// Values from the command line (`--param NAME=VALUE`) that replace parameters by exact constants
/// before anything else is read.
using ParameterValues = std::vector<std::pair<Text, Text>>;

/// Finds the case file that a map's `to` names where there is none of that name beside the case
/// file itself; empty if there is none.
using FindCase = std::function<std::optional<CaseFile>(const std::string& name)>;

/// Reads every expression of the case file and builds the bracket and the equations of motion.
/// \throws CaseError  with the place of what is wrong.
Model build_model(const CaseFile& file, const ParameterValues& fixed = {},
                  const FindCase& find_case = {});

}  // namespace casimir
