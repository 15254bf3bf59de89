#pragma once

#include <ginac/ginac.h>

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "symbolic/algebra/polynomial.hpp"
#include "symbolic/error.hpp"
#include "symbolic/model.hpp"

namespace casimir {

/// The functions of a case as polynomials: symbols are variables of the ring, and every sine,
/// root, denominator .. is one more variable (a generator) with its derivation and, where it has
/// one, its algebraic relation:
///
///   s = sin v, c = cos v    Ds = c Dv, Dc = -s Dv          c^2 = 1 - s^2
///   e = exp v               De = e Dv
///   l = log v               Dl = Dv / v                    log(v w) = log v + log w
///   u = b^(1/q)             Du = u Db / (q b)              u^q = b
///   y = 1/d                 Dy = -y^2 Dd                   y d = 1
///   a = |b|                 Da = b Db / a                  a^2 = b^2
///   inverse functions by their derivatives                 I^2 = -1
///   C = cos(v/n), S = sin(v/n) of an inverse function v    T_n(C) = cos v, S U_(n-1)(C) = sin v
///   cos(Pi/n) by its minimal polynomial
///
/// Angles and exponents are split into independent ones first (sums, multiples), denominators into
/// irreducible factors, and roots lose their square factors, under the declared signs and those
/// that make roots and logarithms real (unless I occurs). What reduces to zero is identically zero:
/// that is a proof. What does not is not zero in the ring; whether it is not zero as a function is
/// for a witness to show.
class FunctionRing {
 public:
  /// \param symbols  independent symbols: variables, parameters, time, a spectral parameter.
  /// \param assumptions  decide the signs of square factors of roots.
  /// \param expressions  everything that will be converted later.
  /// \throws ModelError  for a denominator that is identically zero; TooLarge.
  FunctionRing(std::vector<GiNaC::symbol> symbols, const std::vector<Assumption>& assumptions,
               const std::vector<GiNaC::ex>& expressions);
  ~FunctionRing();
  FunctionRing(const FunctionRing&) = delete;
  FunctionRing& operator=(const FunctionRing&) = delete;

  /// \param expression  one of those given to the constructor, or made of their parts.
  /// \return  kept by the ring, so that the same expression is converted once.
  const Polynomial& convert(const GiNaC::ex& expression);

  /// dp/ds where s is the i-th symbol, through all generators.
  Polynomial derivative(const Polynomial& p, std::size_t symbol) const;

  /// The numerator of `p` over the common denominator of its terms, reduced by all relations: zero
  /// exactly when `p` is zero modulo the relations.
  Polynomial numerator(const Polynomial& p) const;

  /// All of `row` times one function that vanishes nowhere where they have values, so that no
  /// denominator is left, and reduced by all relations.
  std::vector<Polynomial> common_numerators(std::vector<Polynomial> row) const;

  /// `p` by the relations of roots and cosines, denominators as they are: the same function.
  Polynomial reduced(Polynomial p) const;

  /// a*b.
  /// \throws TooLarge
  Polynomial checked_product(const Polynomial& a, const Polynomial& b) const;

  /// A function that is constant identically in a spectral parameter has constant coefficients:
  /// those of its powers, and of the powers of roots that contain it, after clearing denominators
  /// that are free of the coordinates.
  /// \param spectral  the parameter's place among the symbols
  /// \param coordinates  the first symbols are the coordinates
  std::vector<Polynomial> spectral_coefficients(const Polynomial& p, std::size_t spectral,
                                                std::size_t coordinates) const;

  /// With the functions themselves.
  /// \throws TooLarge  beyond the limit `size`
  GiNaC::ex expression(const Polynomial& p) const;
  /// p/q with both reduced by the relations and in lowest terms as polynomials.
  GiNaC::ex quotient(const Polynomial& p, const Polynomial& q) const;

  /// Text with terms in the ring's order: the same in every run, unlike GiNaC's.
  std::string text(const Polynomial& p) const;

  /// How `complete` may choose the values of sines and exponentials.
  struct Freedom {
    /// Freely: they are algebraically independent of their arguments, so that what holds at such a
    /// point (a rank) holds at generic points. Logarithms and inverse functions are not drawn.
    bool formal = false;
    /// Not formal: symbols that occur as they are, so that they keep their rational values. An
    /// angle of any other symbol is drawn, and the symbol has the value that belongs to it.
    std::vector<bool> bare{};
    /// Sines and cosines that are not drawn, by the sine's place in the ring.
    std::map<std::size_t, std::pair<cln::cl_RA, cln::cl_RA>> angles{};
  };

  /// The places of the sines, each followed by its cosine, whose angles are plain symbols that
  /// `complete` chooses freely.
  std::vector<std::size_t> free_sines(const Freedom& freedom) const;

  /// Given values of the symbols in point[0..symbols), fills in values of the generators that obey
  bool complete(std::vector<cln::cl_RA>& point, const std::function<cln::cl_RA()>& draw,
                const Freedom& freedom) const;

  /// The largest total degree of the arguments of the generators: what it costs to complete a
  /// point.
  long argument_degree() const;

  /// Whether `p` has a value at a completed point: logarithms, inverse functions and I have none.
  bool has_value(const Polynomial& p) const;

  /// Which symbols occur as they are in `p` or in any generator, and not only as plain angles.
  std::vector<bool> bare_symbols(const Polynomial& p) const;

  /// An angle or exponent `factor * symbol` with its value at a completed point.
  struct PlainArgument {
    std::size_t symbol;
    cln::cl_RA factor;
    bool angle;               ///< else an exponent
    cln::cl_RA sine, cosine;  ///< of an angle
    cln::cl_RA exponential;   ///< of an exponent
  };
  std::vector<PlainArgument> plain_arguments(const std::vector<cln::cl_RA>& point) const;

  /// The denominators in what was converted: where one of them vanishes, nothing is claimed.
  std::vector<Polynomial> denominators() const;

  /// Whether `p` is one exponential, which vanishes nowhere.
  bool is_exponential(const Polynomial& p) const;

  /// Marks the denominators that occur in `p`, in the order of `denominators`.
  void mark_denominators(const Polynomial& p, std::vector<bool>& marks) const;

  /// What was taken to be positive, beyond the assumptions, since a root or a logarithm is real
  /// only there.
  /// With each whether it is not zero either, as what a logarithm is taken of.
  std::vector<std::pair<Polynomial, bool>> implied_positive() const;

  /// Expressions that are not negative where everything that was converted is real; empty where
  /// complex numbers are used.
  std::vector<GiNaC::ex> real_domain() const;

  const std::vector<GiNaC::symbol>& symbols() const { return symbols_; }
  const PolynomialRing& ring() const { return *ring_; }
  /// What a generator of the ring is.
  struct Origin {
    enum class Kind {
      sine,    ///< its cosine stands just behind it
      cosine,  ///< of the argument of the sine before it
      exponential,
      root,      ///< of order `order`
      inverse,   ///< 1/argument
      absolute,  ///< the positive root of the argument, which is a square
      imaginary,
      constant,   ///< such as Pi
      logarithm,  ///< of |argument|
      arc_tangent,
      arc_tangent_of_two,
      arc_sine,       ///< or cosine
      part_of_angle,  ///< a sine or cosine of a part of an inverse function, or of Pi
    };
    Kind kind;
    Polynomial argument;      ///< of a function of two, the sum of their squares
    unsigned long order = 1;  ///< of a root
  };
  /// \param place  of the generator among the ring's variables, behind the symbols
  Origin origin(std::size_t place) const;
  /// One more than the place of the last generator.
  std::size_t end_of_generators() const { return symbols_.size() + generators_.size(); }

  /// True where everything that was converted is a polynomial in the symbols.
  bool is_polynomial() const { return generators_.empty(); }
  /// The imaginary unit occurs, so that roots and logarithms need not be real.
  bool is_complex() const { return complex_ && !generators_.empty(); }
  /// What a variable of the ring stands for: a symbol, or the function of a generator.
  GiNaC::ex variable_value(std::size_t place) const {
    return place < symbols_.size() ? GiNaC::ex(symbols_[place])
                                   : generators_[place - symbols_.size()].value;
  }

  /// p = first / second in lowest terms, both reduced by all relations and without generators 1/d:
  /// where `second` vanishes nowhere, p is continuous.
  std::pair<Polynomial, Polynomial> lowest_terms(const Polynomial& p) const;

  /// Whether the assumptions, or what makes roots and logarithms real, leave no point at which `p`
  /// vanishes: each of its factors has a strict sign, or is assumed not to be zero.
  bool is_nowhere_zero(const Polynomial& p) const;

  /// Functions whose common real zeros are those of `p`: where that is a sum of squares, or of what
  /// is not negative, all of its parts; else `p` itself.
  std::vector<Polynomial> real_zeros(const Polynomial& p) const;

  /// Whether each factor has a strict sign that is assumed, not implied by roots and logarithms,
  /// and their product is positive; also true of exponentials.
  bool is_assumed_positive(const Polynomial& p) const;

  /// The irreducible factors of what stands under the roots and absolute values that `p` contains,
  /// also within other functions. Where none of them vanishes, `p` is differentiable.
  /// \param cuts  with what has to vanish for atan2 to jump, which does not concern derivatives
  std::vector<Polynomial> radicand_factors(const Polynomial& p, bool cuts = false) const;

  /// Whether `p` is differentiable all the same where one of its radicands has the factor `f` that
  /// vanishes, as y*|y| and x^(3/2) are.
  bool is_smooth_across(const Polynomial& p, const Polynomial& f) const;

  /// Whether `p` has the factor `f` under its roots in |f| alone, and no inverse function: then it
  /// is differentiable along a curve on which f keeps its sign, or stays zero.
  bool is_rough_in_absolute_value_alone(const Polynomial& p, const Polynomial& f) const;

  /// Whether `p` depends on one of the first `coordinates` symbols, through generators too.
  bool depends_on_first(const Polynomial& p, std::size_t coordinates) const;
  /// The same for one symbol.
  bool depends_on(const Polynomial& p, std::size_t symbol) const;

  /// How functions hang together beyond the part of the domain where a point lies.
  struct Pieces {
    /// What absolute values are taken of: on the set where each keeps its sign, the functions are
    /// restrictions of meromorphic or algebraic ones that are the same all over that set.
    std::vector<Polynomial> switches;
    /// False where this is not shown: what holds at a point is then known to hold at almost all
    /// points of the connected part of the domain around it, and no more.
    bool rigid = true;
  };
  Pieces pieces(const std::vector<Polynomial>& functions) const;

  /// Points at which functions are told apart by their values before algebra is asked.
  static constexpr std::size_t kProbes = 8;

  /// A point in double precision, by which nothing is proved: it only saves the work on what does
  /// not hold there.
  struct Probe {
    std::vector<double> coordinates;                ///< of the symbols
    std::vector<std::optional<double>> generators;  ///< as far as they were computed
  };
  /// Another one for each k below `kProbes`: coordinates between 0.3 and 1 in no simple relation.
  Probe probe(std::size_t k) const;
  /// The value of `p` there, as exact as doubles are; not a number where it has no real one.
  double value_at(Probe& probe, const Polynomial& p) const;
  /// Whether all functions of the ring have, but for 1/d: the derivatives of roots have
  /// denominators where the roots themselves have values.
  bool has_values_at(Probe& probe) const;

 private:
  enum class Kind { sine, cosine, exponential, root, inverse, absolute, imaginary, function };
  struct Generator {
    Kind kind;
    GiNaC::ex value;
    Polynomial base;                      ///< radicand, denominator or argument
    unsigned long order = 1;              ///< q of a root
    std::vector<Polynomial> derivatives;  ///< with respect to each symbol
    double size = 1;                      ///< of `value` as a tree
    /// Of a function u that is algebraic: u^n = the sum of relation[k] u^k, where n is their
    /// number.
    std::vector<Polynomial> relation{};
    /// u * first = second, where `first` vanishes nowhere where u has a value.
    std::optional<std::pair<Polynomial, Polynomial>> quotient{};
    /// u * w = second, where w is an earlier generator and w and u have no common zero.
    std::optional<std::pair<std::size_t, Polynomial>> partner{};
  };
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
    kSignedHalf,  ///< sqrt(2 r) sin(base), where the base is half of atan2(y, x) and r = |(x, y)|
    kCosineOfPi,  ///< cos(Pi/base)
  };
  struct Monomial {
    cln::cl_RA coefficient;
    std::vector<unsigned long> exponents;
  };
  /// More generators are needed than the ring has room for, or they have another form than it was
  /// thought. While a ring is built it is built again; later it is a limit like others.
  struct Full : TooLarge {
    Full() : TooLarge("functions are needed that the expressions of the claim do not show") {}
  };

  void build(const std::vector<GiNaC::ex>& expressions);
  Polynomial convert_new(const GiNaC::ex& e);
  Polynomial convert_number(const GiNaC::numeric& number);
  Polynomial convert_sum(const GiNaC::ex& sum);
  Polynomial convert_product(const GiNaC::ex& product);
  std::size_t place_of(const GiNaC::ex& symbol) const;
  bool multiply_power(const GiNaC::ex& base, const GiNaC::ex& exponent, Monomial& monomial) const;
  static bool multiply_number(const GiNaC::ex& number, Monomial& monomial);
  bool multiply_monomial(const GiNaC::ex& e, Monomial& monomial) const;
  void order(GiNaC::exvector& operands);
  const std::string& order_key(const GiNaC::ex& e);
  std::string order_key_of_sum(const GiNaC::ex& sum);
  Polynomial convert_power(const GiNaC::ex& base, const GiNaC::ex& exponent);
  Polynomial convert_function(const GiNaC::function& f);
  /// Of the tree that `expression` makes: its symbols, with those in the arguments of functions.
  double expression_size(const Polynomial& p) const;
  Polynomial generator(Kind kind, const GiNaC::ex& value, const Polynomial& base,
                       unsigned long order,
                       const std::function<Polynomial(const Polynomial& slope)>& derivative_of);
  const Generator* find(Kind kind, const Polynomial& base, unsigned long order,
                        std::size_t* index) const;
  [[noreturn]] void grow();
  bool has_power_relation(const Generator& g) const;
  Polynomial by_relation(const Polynomial& p, std::size_t g) const;
  Polynomial by_partner(const Polynomial& p, std::size_t g) const;
  bool vanishes_by_partners(const Polynomial& p, std::size_t below) const;
  Polynomial without_inverse(const Polynomial& p, std::size_t g, unsigned long power) const;
  std::string name(const Generator& g) const;
  std::string power_of(const Generator& g, unsigned long exponent) const;
  bool complete_argument(std::size_t g, std::vector<cln::cl_RA>& point, std::vector<bool>& chosen,
                         const std::function<cln::cl_RA()>& draw, const Freedom& freedom) const;
  std::optional<std::pair<std::size_t, cln::cl_RA>> plain_symbol(const Polynomial& p) const;
  static bool depends_on(const Generator& g, std::size_t symbol);
  Polynomial reduced_power(const Polynomial& p, std::size_t g) const;
  Polynomial reduced_sparse_power(const Polynomial& p, std::size_t g) const;
  std::vector<Polynomial> slopes(const Polynomial& p) const;
  Polynomial power(const Polynomial& p, unsigned long exponent) const;
  Polynomial inverse(const Polynomial& p);
  Polynomial root(const Polynomial& p, unsigned long q);
  Polynomial complex_root(const Polynomial& p, unsigned long q);
  Polynomial number_root(const cln::cl_RA& r, unsigned long q);
  Polynomial plain_root(const Polynomial& primitive, unsigned long q);
  Polynomial root_generator(const Polynomial& radicand, unsigned long q);
  Polynomial absolute(const Polynomial& p);
  int known_sign(const Polynomial& p) const;
  bool known_nonzero(const Polynomial& p) const;
  enum class Reading { first, second };
  void read_signs();
  void read_all(Reading reading);
  bool tell_more_signs();
  void read_assumption(const Assumption& assumption, Reading reading);
  void read_sign(const Polynomial& p, int sign, Reading reading, bool implied, bool strict);
  void add_sign(const Polynomial& f, int sign, bool implied, bool strict);
  void imply_sign(const Polynomial& f, int sign, bool strict);
  void imply_radicand(const std::vector<std::pair<Polynomial, unsigned long>>& factors,
                      bool strict);
  void keep_product(const std::vector<std::pair<Polynomial, unsigned long>>& factors, bool strict);
  void imply_between(const Polynomial& v);
  void imply_divisor(const Polynomial& bottom);
  bool may_vanish(const Polynomial& f) const;
  bool is_sum_of_squares(const Polynomial& p) const;
  bool is_never_negative(std::size_t place) const;
  bool is_never_zero(std::size_t place) const;
  int sign_of_variable(std::size_t place) const;
  int sign_of_term(const cln::cl_RA& coefficient,
                   const std::vector<unsigned long>& exponents) const;
  std::optional<bool> not_negative_by_terms(
      const Polynomial& p, std::pair<cln::cl_RA, std::vector<unsigned long>>* bad) const;
  std::optional<std::vector<Polynomial>> squares_of_quadratic(Polynomial p) const;
  static constexpr int kSignsInSum = 3;  ///< known signs that are added up to find another
  std::optional<bool> is_not_negative(const Polynomial& p, int depth = kSignsInSum) const;
  Polynomial zeros_of_variable(std::size_t place) const;
  std::optional<Polynomial> logarithm_of_reciprocal(const Polynomial& p, unsigned long tag);
  std::vector<Polynomial> zeros_of_terms(const Polynomial& p) const;
  std::optional<int> sign_of_number(const Polynomial& p) const;
  int sign_of(const Polynomial& p) const;
  std::optional<Polynomial> square_root(const Polynomial& p) const;
  std::optional<Polynomial> denested(const Polynomial& radicand);
  std::optional<Polynomial> denested_number(const Polynomial& radicand, unsigned long q);
  bool is_real_everywhere(const Polynomial& p) const;
  std::vector<std::size_t> generators_in(const std::vector<Polynomial>& functions) const;
  std::vector<std::pair<Polynomial, unsigned long>> factors_of(const Polynomial& p) const;
  std::pair<Polynomial, Polynomial> sine_cosine(const Polynomial& angle);
  std::pair<Polynomial, Polynomial> plain_sine_cosine(const Polynomial& unit);
  /// Sine and cosine of a part of an angle, and how often the angle contains that part.
  struct PartOfAngle {
    Polynomial sine, cosine;
    cln::cl_I times;
  };
  std::optional<PartOfAngle> algebraic_sine_cosine(const cln::cl_RA& coefficient,
                                                   const std::vector<unsigned long>& monomial);
  std::pair<Polynomial, Polynomial> inverse_sine_cosine(const Generator& g);
  std::optional<PartOfAngle> part_of_inverse(std::size_t index, const cln::cl_I& parts);
  std::optional<PartOfAngle> first_part(std::size_t index, bool half);
  Polynomial half_sine(std::size_t index, const Polynomial& r, const Polynomial& x,
                       const Polynomial& y, const Polynomial& root);
  Polynomial part_cosine(const Polynomial& unit, const Polynomial& whole, unsigned long n);
  Polynomial part_sine(const Polynomial& unit, const Polynomial& cosine, const Polynomial& times,
                       const Polynomial& whole);
  std::optional<std::pair<Polynomial, Polynomial>> sine_cosine_of_pi(const cln::cl_RA& part);
  Polynomial cosine_of_pi(const cln::cl_I& times);
  std::optional<Polynomial> root_by_pi(unsigned long prime);
  std::optional<Polynomial> square_root_by_pi(const Polynomial& top, const Polynomial& bottom);
  std::pair<Polynomial, Polynomial> without_roots(Polynomial p) const;
  std::optional<Polynomial> known_inverse(const GiNaC::function& f);
  Probe& own_probe(std::size_t k);
  const std::vector<Polynomial>& factors_of_radicand(std::size_t g) const;
  double generator_at(Probe& probe, std::size_t g) const;
  double new_generator_at(Probe& probe, std::size_t g) const;
  /// Whether two values at that point are of different functions; false where one is no number.
  static bool differ(double a, double b);
  Polynomial logarithm(const GiNaC::ex& whole, const Polynomial& p);
  std::optional<Polynomial> logarithm_of_generator(const Polynomial& f);
  Polynomial exponential(const Polynomial& exponent);
  std::optional<Polynomial> special_exponential(const cln::cl_RA& coefficient,
                                                const std::vector<unsigned long>& monomial);
  std::pair<Polynomial, Polynomial> fraction(const Polynomial& p) const;
  std::pair<Polynomial, cln::cl_I> unit_of(const std::vector<unsigned long>& monomial,
                                           const cln::cl_RA& coefficient);

  std::vector<GiNaC::symbol> symbols_;
  std::vector<Assumption> assumptions_;
  std::size_t capacity_ = 0;
  std::unique_ptr<PolynomialRing> ring_;
  std::vector<Generator> generators_;
  std::unordered_map<GiNaC::ex, std::size_t> places_;  ///< of the symbols in the ring
  std::unordered_map<GiNaC::ex, Polynomial> known_;
  std::unordered_map<GiNaC::ex, std::string> order_keys_;
  /// I occurs: roots and logarithms need not be real then. Nothing is made of these before that is
  /// looked for.
  bool complex_ = true;
  std::array<Probe, kProbes> probes_;
  mutable std::unordered_map<std::size_t, std::vector<Polynomial>> radicands_;
  bool built_ = false;  ///< what is converted from then on says no more of signs
  struct Sign {
    Polynomial of;
    int sign;
    bool implied;  ///< by a root or a logarithm, else assumed
    bool strict;   ///< it does not vanish
  };
  std::vector<Sign> signs_;
  std::vector<Polynomial> nonzero_;  ///< assumed not to vanish; irreducible
  struct Implied {
    GiNaC::ex value;  ///< not negative where the roots and logarithms are real
    bool strict;      ///< nor zero
  };
  static bool keep(std::vector<Implied>& list, const GiNaC::ex& value, bool strict);
  std::vector<Implied> implied_;
  std::vector<GiNaC::ex> divisors_;  ///< of radicands, irreducible: where one vanishes is no value
  std::vector<Implied> products_;    ///< the same, where no single sign followed when it was met
  /// For a monomial in an angle or exponent: the least common denominator of its coefficients.
  std::vector<std::pair<GiNaC::ex, cln::cl_I>> units_;
  /// For a radicand: the least common multiple of the orders of its roots.
  std::vector<std::pair<GiNaC::ex, unsigned long>> root_orders_;
  /// All parts of Pi are multiples of Pi over this even number; 0 where none needs a generator.
  unsigned long pi_parts_ = 0;
};

}  // namespace casimir
