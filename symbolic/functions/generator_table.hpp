#pragma once

#include <ginac/ginac.h>

#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "symbolic/algebra/polynomial.hpp"
#include "symbolic/case/limits.hpp"
#include "symbolic/error.hpp"

/// The parts of which a FunctionRing is made.
namespace casimir::functions {

/// What a generator is, as far as its relation goes.
enum class Kind { sine, cosine, exponential, root, inverse, absolute, imaginary, function };

/// What a generator of the kind `function` is, as its `order`.
enum FunctionTag : unsigned long {
  kConstant,  ///< such as Pi
  kLogarithm,
  kArcTangent,
  kArcSine,
  kArcCosine,
  kArcTangentOfTwo,
  kLogOfAbsolute,  ///< log|base|, where the sign of the base is not known
  kPartCosine,     ///< cos(base), of a part of an inverse function
  kPartSine,       ///< sin(base)
  kSignedHalf,     ///< sqrt(2 r) sin(base), where the base is half of atan2(y, x) and r = |(x, y)|
  kCosineOfPi,     ///< cos(Pi/base)
  kArbitrary,      ///< of an arbitrary function
  kLastArbitrary,  ///< the same, with derivatives that are not known
};

/// A function that is one more variable of the ring.
struct Generator {
  Kind kind;
  GiNaC::ex value;
  Polynomial base;                      ///< radicand, denominator or argument
  unsigned long order = 1;              ///< q of a root, or a FunctionTag
  std::vector<Polynomial> derivatives;  ///< with respect to each symbol
  double size = 1;                      ///< of `value` as a tree
  /// Of a function u that is algebraic: u^n = the sum of relation[k] u^k, where n is their
  /// number.
  std::vector<Polynomial> relation{};
  /// u * first = second, where `first` vanishes nowhere where u has a value.
  std::optional<std::pair<Polynomial, Polynomial>> quotient{};
  /// u * w = second, where w is an earlier generator and w and u have no common zero.
  std::optional<std::pair<std::size_t, Polynomial>> partner{};
  /// Of atan2 and of arbitrary functions, which have more than one argument.
  std::vector<Polynomial> arguments{};

  /// Whether it depends on the symbol directly, or through its derivative.
  bool depends_on(std::size_t symbol) const;
  /// Whether powers of it reduce to lower ones.
  bool has_power_relation() const;
};

/// More generators are needed than the ring has room for, or they have another form than it was
/// thought. While a ring is built it is built again; later it is a limit like others.
struct Full : TooLarge {
  Full() : TooLarge("functions are needed that the expressions of the claim do not show") {}
};

/// The variables of a FunctionRing, symbols and then generators, with the derivation and the
/// relations: the data of the ring, and what follows from these data alone. Each generator is made
/// of earlier ones.
class GeneratorTable {
 public:
  /// The table of these symbols has no generators yet, and no room for any.
  /// \param limits  of what is computed in it
  GeneratorTable(std::vector<GiNaC::symbol> symbols, Limits limits);

  /// Forgets all generators and makes a polynomial ring of the present capacity.
  void restart();
  /// Makes the next ring larger, and throws Full.
  [[noreturn]] void grow();
  /// The number of generators that the polynomial ring has room for.
  std::size_t capacity() const { return capacity_; }
  /// Whether so many more generators fit.
  bool has_room(std::size_t more) const { return generators_.size() + more <= capacity_; }

  const std::vector<GiNaC::symbol>& symbols() const { return symbols_; }
  const PolynomialRing& ring() const { return *ring_; }
  const Limits& limits() const { return limits_; }
  const std::vector<Generator>& generators() const { return generators_; }
  /// The place of the generator `g` among the variables of the ring.
  std::size_t place(std::size_t g) const { return symbols_.size() + g; }
  /// The generator at this place among the variables of the ring, behind the symbols.
  const Generator& at_place(std::size_t place) const {
    return generators_[place - symbols_.size()];
  }
  /// The generator `g` as a polynomial; it may be one that is still to be made.
  Polynomial variable(std::size_t g) const { return ring_->variable(place(g)); }
  /// The generator that will be made next, if there is room for it.
  Polynomial next_variable() const;
  /// What a variable of the ring stands for: a symbol, or the function of a generator.
  GiNaC::ex variable_value(std::size_t place) const {
    return place < symbols_.size() ? GiNaC::ex(symbols_[place]) : at_place(place).value;
  }

  /// Whether I occurs: roots and logarithms need not be real then. Nothing is made of these before
  /// that is looked for.
  bool is_complex() const { return complex_; }
  void set_complex(bool complex) { complex_ = complex; }

  /// The generator of this kind, base and order, if it was made.
  const Generator* find(Kind kind, const Polynomial& base, unsigned long order,
                        std::size_t* index) const;
  /// Adds a generator that is complete.
  void add(Generator generator) { generators_.push_back(std::move(generator)); }
  /// The generator that was added last, to be completed.
  Generator& last() { return generators_.back(); }
  /// Adds a generator.
  /// \param derivative_of  its derivative where that of the base is `slope`
  /// \return  its variable
  /// \throws Full
  Polynomial generator(Kind kind, const GiNaC::ex& value, const Polynomial& base,
                       unsigned long order,
                       const std::function<Polynomial(const Polynomial& slope)>& derivative_of);

  /// dp/ds where s is the i-th symbol, through all generators.
  /// \throws TooLarge  where a derivative of an arbitrary function is needed that is none of them
  Polynomial derivative(const Polynomial& p, std::size_t symbol) const;
  /// The derivatives by all symbols.
  std::vector<Polynomial> slopes(const Polynomial& p) const;

  /// a*b.
  /// \throws TooLarge
  Polynomial checked_product(const Polynomial& a, const Polynomial& b) const;
  /// p^exponent.
  /// \throws TooLarge
  Polynomial power(const Polynomial& p, unsigned long exponent) const;

  /// p = first / second without generators of the kind 1/d.
  std::pair<Polynomial, Polynomial> fraction(const Polynomial& p) const;
  /// See FunctionRing, as for the next three.
  Polynomial numerator(const Polynomial& p) const;
  std::vector<Polynomial> common_numerators(std::vector<Polynomial> row) const;
  Polynomial reduced(Polynomial p) const;
  std::pair<Polynomial, Polynomial> lowest_terms(const Polynomial& p) const;
  /// p by the relation of the generator `g`, which has one of powers.
  Polynomial reduced_power(const Polynomial& p, std::size_t g) const;

  /// The indices of the generators in `functions`, with those that they are made of.
  std::vector<std::size_t> generators_in(const std::vector<Polynomial>& functions) const;
  /// Whether `p` depends on a symbol, through generators too.
  bool depends_on(const Polynomial& p, std::size_t symbol) const;
  /// Whether `p` is one exponential, which vanishes nowhere.
  bool is_exponential(const Polynomial& p) const;
  /// Whether it has real values only, I apart from which functions might have others.
  bool is_real_everywhere(const Polynomial& p) const;

  /// With the functions themselves.
  /// \throws TooLarge  beyond the limit `size`
  GiNaC::ex expression(const Polynomial& p) const;
  /// Of the tree that `expression` makes: its symbols, with those in the arguments of functions.
  double expression_size(const Polynomial& p) const;

 private:
  Polynomial by_relation(const Polynomial& p, std::size_t g) const;
  Polynomial by_partner(const Polynomial& p, std::size_t g) const;
  bool vanishes_by_partners(const Polynomial& p, std::size_t below) const;
  Polynomial without_inverse(const Polynomial& p, std::size_t g, unsigned long power) const;
  Polynomial reduced_sparse_power(const Polynomial& p, std::size_t g) const;

  void check_bits(double bits) const;
  TooLarge too_many_terms(const char* what) const;

  Limits limits_;
  std::vector<GiNaC::symbol> symbols_;
  std::size_t capacity_ = 0;
  std::unique_ptr<PolynomialRing> ring_;
  std::vector<Generator> generators_;
  bool complex_ = true;
};

}  // namespace casimir::functions
