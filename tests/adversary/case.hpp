#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tests/adversary/expression.hpp"

namespace casimir::adversary {

/// `left RELATION 0`, of an `assume` or a `domain`.
struct Assumption {
  Expr left;
  std::string relation;
  std::string text() const { return left.text() + " " + relation + " 0"; }
};

struct Parameter {
  std::string name;
  std::vector<Assumption> assume{};
};

struct Named {
  std::string name;
  Expr value;
};

/// Which form of the phase space a file has.
enum class Bracket { none, canonical, so3, e3, structure_constants, brackets };

/// A phase space with its flow.
struct System {
  std::vector<std::string> variables;
  std::vector<Parameter> parameters{};
  std::vector<Assumption> domain{};
  Bracket bracket = Bracket::none;
  std::map<std::pair<std::size_t, std::size_t>, Expr> entries{};  ///< i < j, where written out
  Expr hamiltonian{};
  std::vector<Expr> equations{};  ///< where there is no bracket
  std::string time{};
  std::vector<Named> definitions{};

  /// {x_i, x_j} by the conventions of the interface.
  Expr bracket_of(std::size_t i, std::size_t j) const;
  /// All symbols that have values: variables, parameters, the time.
  std::vector<std::string> symbols() const;
  std::vector<Assumption> assumptions() const;
};

/// A claim about the common zero level of some functions.
struct OnLevel {
  std::string name;
  Expr expression;
  std::vector<Expr> on;
};

struct IdentityClaim {
  Expr left, right;
  std::vector<Expr> on{};
};

using Matrix = std::vector<std::vector<Expr>>;

struct Lax {
  std::string spectral;
  Matrix l, a;
};

/// A map to a phase space that is written out beside it.
struct Map {
  System target;
  std::vector<Expr> expressions;
  int sign = 1;
};

struct Measure {
  Expr density;
  bool every_hamiltonian = false;
};

enum class Kind {
  integral,
  casimir,
  jacobi,
  identity,
  conditional,
  invariant_relation,
  lax,
  measure,
  map,
  involution,
  independence,
  rank,
  liouville,
  search,
  free_search,
  exponents,
  darboux,
  certificate
};

/// As the library calls it.
std::string to_string(Kind kind);

/// What is so, known from how a claim was made.
enum class Truth {
  yes,
  no,
  nothing,  ///< the claim is about no real point at all, so that nobody should call it proved
};

std::string to_string(Truth truth);

/// A case file with one claim that is asked about.
struct Case {
  System system;
  bool integrable = false;
  std::vector<Named> casimirs{}, integrals{};
  std::vector<OnLevel> conditionals{}, invariant_relations{};
  std::vector<IdentityClaim> identities{};
  std::vector<Lax> lax{};
  std::vector<Map> maps{};
  std::vector<Measure> measures{};

  Kind kind = Kind::integral;
  std::string name{};  ///< of the claim, where there are several of its kind
  Truth truth = Truth::yes;
  /// The construction only proposes, as a random change that might happen to change nothing: what
  /// the oracle finds is the truth.
  bool by_oracle = false;
  std::string family;  ///< what makes it hard, as "half-angle"
  /// Where the claim is about a level, all of its parts: some symbols as expressions of the others.
  std::vector<Substitution> pieces{};
  /// A solution that starts on the level and leaves it, over the time `s`; for a field that is not
  /// smooth there an integration does not find it.
  std::optional<Substitution> orbit{};
  double duration = 0.5;  ///< how far orbits are to be followed

  /// The case file.
  std::string text() const;
};

}  // namespace casimir::adversary
