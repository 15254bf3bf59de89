#pragma once

#include <ginac/ginac.h>

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "symbolic/case/limits.hpp"
#include "symbolic/case_file.hpp"
#include "symbolic/comparison.hpp"

namespace casimir {

/// An expression with bounds on what computing with it may cost. The bounds are checked while text
/// is read, so that no expression of a stranger can make GiNaC build a giant.
struct Quantity {
  GiNaC::ex value;
  double bits = 1;    ///< size of the numbers in it
  double degree = 0;  ///< total degree, counting every function as a variable
  double nodes = 1;   ///< size of the tree, counting shared parts as often as they are used
  double depth = 1;   ///< levels of the tree
  /// The functions, roots and quotients that were read on the way. GiNaC may have made something of
  /// them that has values where they have none, as x of exp(log(x)).
  std::shared_ptr<const std::vector<GiNaC::ex>> parts{};
  bool vector = false;  ///< one component of a vector, within `dot` and `cross` alone

  static Quantity symbol(const GiNaC::symbol& s) { return {s, 1, 1, 1}; }
};

/// The parts that no longer occur in the value: it is defined only where these have values.
std::vector<GiNaC::ex> lost_parts(const Quantity& quantity);

/// What becomes of a term that is zero once values are put in.
enum class VanishingTerms {
  counted,  ///< it is there as written: it has a value where its parts have
  dropped,  ///< it is not there, as the force with the strength 0 in a scene
};

/// The functions and powers that an expression needs and no longer shows once values are put into
/// it, each with the values in it: sqrt(q) of U(sqrt(q)) for U = r^2, log(q) of exp(a*log(q)) for
/// a = 1. What comes out is the expression with these values only where all of them have a value.
/// Constants that are no real numbers are among them, as sqrt(-1).
/// \throws TooLarge, GiNaC::pole_error  as `substituted`
std::vector<GiNaC::ex> lost_in_substitution(const GiNaC::ex& expression, const GiNaC::exmap& values,
                                            const Limits& limits, VanishingTerms vanishing);

/// The expression with values put in, and behind it what it needs and no longer shows: as of
/// `lost_in_substitution`, with terms that vanish counted. For what a claim about a composition
/// f(phi(x)) is about: f(phi(x)) has a value only where f has one at phi(x).
/// \throws TooLarge, GiNaC::pole_error  as `substituted`
std::vector<GiNaC::ex> substituted_with_parts(const GiNaC::ex& expression,
                                              const GiNaC::exmap& values, const Limits& limits);

/// The quantity with these parts, and those that its value shows.
Quantity with_parts(Quantity quantity, const std::vector<GiNaC::ex>& lost);

inline constexpr std::size_t kMaxNameLength = 100;

/// The bracket and the flow of a system, for expressions such as `{F, G}` and `rate(F)`.
class Dynamics {
 public:
  virtual ~Dynamics() = default;
  virtual bool has_bracket() const = 0;
  virtual bool has_flow() const = 0;  ///< a map has none
  /// {f, g}; only where there is a bracket.
  virtual GiNaC::ex bracket(const GiNaC::ex& f, const GiNaC::ex& g) const = 0;
  /// df/dt along the flow; only where there is one.
  virtual GiNaC::ex rate(const GiNaC::ex& f) const = 0;
  virtual std::size_t dimension() const = 0;
  /// What has to have values beside what the bracket, or the flow, shows: as of `lost_parts`.
  virtual std::vector<GiNaC::ex> parts_of_bracket() const { return {}; }
  virtual std::vector<GiNaC::ex> parts_of_flow() const { return {}; }
};

/// The names that an expression may use, and how large it may become.
class Scope {
 public:
  virtual ~Scope() = default;
  /// What `name` stands for, or null. May read a definition on the way, and throw its CaseError.
  virtual const Quantity* find(const std::string& name) = 0;
  /// Every name, for the hint in an error.
  virtual std::vector<std::string> known() const = 0;
  /// What differentiates, where the equations of motion are known; null elsewhere.
  virtual const Dynamics* dynamics() { return nullptr; }
  /// Whether values may be complex, so that (1/x)^(1/2) and 1/x^(1/2) have to be told apart.
  virtual bool complex_numbers() const { return false; }
  /// What expressions over these names are held to.
  virtual const Limits& limits() const = 0;
};

/// A fixed table of names.
class NameTable : public Scope {
 public:
  /// No names yet. \param limits  of the expressions over them
  explicit NameTable(Limits limits) : limits_(std::move(limits)) {}

  /// Has a name stand for this.
  void add(const std::string& name, Quantity quantity) { table_[name] = std::move(quantity); }
  const Quantity* find(const std::string& name) override;
  std::vector<std::string> known() const override;
  const Limits& limits() const override { return limits_; }

 private:
  Limits limits_;
  std::map<std::string, Quantity> table_;
};

/// Reads an expression over `names`: + - * / ^, exact rationals and decimals ("0.5" is 1/2), Pi, I,
/// sqrt sin cos tan cot sinh cosh tanh exp log asin acos atan atan2 abs sign; diff(F, x) for a
/// partial derivative; and where `names` knows the dynamics, {F, G} for the Poisson bracket and
/// rate(F) for dF/dt. What is usual elsewhere and has one meaning is read as well: `notation.hpp`.
/// \throws CaseError  with the place inside `text`: unknown name, wrong arity, division by zero,
///                    syntax, or a limit exceeded.
Quantity parse_expression(const Text& text, Scope& names);

/// Reads an expression without any variable.
GiNaC::ex parse_constant(const Text& text, const Limits& limits);
/// The same, for an exact real number.
GiNaC::ex parse_real_constant(const Text& text, const Limits& limits);

/// A condition: two sides, and how they compare, as in "r != 0".
struct Condition {
  GiNaC::ex left;
  Comparison comparison;
  GiNaC::ex right;
  std::vector<GiNaC::ex> lost;  ///< as of `lost_parts`: it does not hold where one has no value
};
Condition parse_condition(const Text& text, Scope& names);

/// The two sides of "LEFT = RIGHT"; the right one is 0 where there is no sign of equality.
std::pair<Quantity, Quantity> parse_equation(const Text& text, Scope& names);

/// The position of the symbol of that name.
/// \param what  as in "'x' is not WHAT", for the error where there is none
/// \param name  the part of `text` that starts at `offset`
std::size_t symbol_position(const Text& text, const std::string& name, std::size_t offset,
                            const std::vector<GiNaC::symbol>& symbols, const std::string& what);

/// Throws unless `name` may name a variable, parameter or definition: letters, digits and `_`, not
/// a function, constant or C++ keyword, at most kMaxNameLength characters.
void check_name(const Text& name, const std::string& what);

}  // namespace casimir
