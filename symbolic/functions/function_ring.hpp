#pragma once

#include <ginac/ginac.h>

#include <memory>
#include <string>
#include <vector>

#include "symbolic/case/limits.hpp"
#include "symbolic/functions/function_pieces.hpp"
#include "symbolic/functions/function_probe.hpp"
#include "symbolic/functions/function_text.hpp"
#include "symbolic/functions/generator_origin.hpp"
#include "symbolic/functions/generator_table.hpp"
#include "symbolic/functions/sign_table.hpp"
#include "symbolic/model.hpp"

namespace casimir {

namespace functions {
class Converter;
}

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
///   U of an arbitrary function: DU(a) = sum U_i(a) Da_i, its derivatives are further generators,
///   up to some more than occur: the derivatives of the last ones are not known (`derivative`)
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
  /// \param limits  of polynomials and of expressions: those of the model.
  /// \throws ModelError  for a denominator that is identically zero; TooLarge.
  FunctionRing(std::vector<GiNaC::symbol> symbols, const std::vector<Assumption>& assumptions,
               const std::vector<GiNaC::ex>& expressions, const Limits& limits);
  ~FunctionRing();
  FunctionRing(const FunctionRing&) = delete;
  FunctionRing& operator=(const FunctionRing&) = delete;

  /// \param expression  one of those given to the constructor, or made of their parts.
  /// \return  kept by the ring, so that the same expression is converted once.
  const Polynomial& convert(const GiNaC::ex& expression);

  /// dp/ds where s is the i-th symbol, through all generators.
  /// \throws TooLarge  where a derivative of an arbitrary function is needed that is none of them
  Polynomial derivative(const Polynomial& p, std::size_t symbol) const {
    return table_.derivative(p, symbol);
  }

  /// The numerator of `p` over the common denominator of its terms, reduced by all relations: zero
  /// exactly when `p` is zero modulo the relations.
  Polynomial numerator(const Polynomial& p) const { return table_.numerator(p); }

  /// All of `row` times one function that vanishes nowhere where they have values, so that no
  /// denominator is left, and reduced by all relations.
  std::vector<Polynomial> common_numerators(std::vector<Polynomial> row) const {
    return table_.common_numerators(std::move(row));
  }

  /// `p` by the relations of roots and cosines, denominators as they are: the same function.
  Polynomial reduced(Polynomial p) const { return table_.reduced(std::move(p)); }

  /// a*b.
  /// \throws TooLarge
  Polynomial checked_product(const Polynomial& a, const Polynomial& b) const {
    return table_.checked_product(a, b);
  }

  /// With the functions themselves.
  /// \throws TooLarge  beyond the limit `size`
  GiNaC::ex expression(const Polynomial& p) const { return table_.expression(p); }
  /// p/q with both reduced by the relations and in lowest terms as polynomials.
  GiNaC::ex quotient(const Polynomial& p, const Polynomial& q) const;

  /// Text with terms in the ring's order: the same in every run, unlike GiNaC's.
  std::string text(const Polynomial& p) const { return functions::FunctionText(table_).text(p); }

  /// The denominators in what was converted: where one of them vanishes, nothing is claimed.
  std::vector<Polynomial> denominators() const;

  /// Marks the denominators that occur in `p`, in the order of `denominators`.
  void mark_denominators(const Polynomial& p, std::vector<bool>& marks) const;

  /// What was taken to be positive or not zero, beyond the assumptions, since a root or a logarithm
  /// is real only there.
  functions::Implied implied_by_values() const { return signs_.implied_by_values(); }
  /// Whether something is taken to hold, beyond the assumptions, since what was converted has
  /// values: that a radicand is not negative, and the square of its root. What is proved then is
  /// proved where all of that has values. (Of a quotient only its denominator is marked.)
  bool rests_on_what_was_converted() const;

  const std::vector<GiNaC::symbol>& symbols() const { return table_.symbols(); }
  const PolynomialRing& ring() const { return table_.ring(); }
  /// What is computed in it is held to these.
  const Limits& limits() const { return table_.limits(); }
  /// The data of the ring: what points, values and spectral coefficients are computed from.
  const functions::GeneratorTable& table() const { return table_; }
  using Origin = functions::Origin;
  /// \param place  of the generator among the ring's variables, behind the symbols
  Origin origin(std::size_t place) const { return functions::origin_of(table_, place); }
  /// One more than the place of the last generator.
  std::size_t end_of_generators() const { return table_.place(table_.generators().size()); }

  /// True where everything that was converted is a polynomial in the symbols.
  bool is_polynomial() const { return table_.generators().empty(); }
  /// The imaginary unit occurs, so that roots and logarithms need not be real.
  bool is_complex() const { return table_.is_complex() && !is_polynomial(); }
  /// What a variable of the ring stands for: a symbol, or the function of a generator.
  GiNaC::ex variable_value(std::size_t place) const { return table_.variable_value(place); }

  /// p = first / second in lowest terms, both reduced by all relations and without generators 1/d:
  /// where `second` vanishes nowhere, p is continuous.
  std::pair<Polynomial, Polynomial> lowest_terms(const Polynomial& p) const {
    return table_.lowest_terms(p);
  }

  /// Whether the assumptions, or what makes roots and logarithms real, leave no point at which `p`
  /// vanishes: each of its factors has a strict sign, or is assumed not to be zero.
  bool is_nowhere_zero(const Polynomial& p) const { return signs_.is_nowhere_zero(p); }
  /// The same of an irreducible one, and at the edge of where roots and logarithms have values,
  /// too: the motion may pass where one function has none.
  bool is_assumed_nonzero(const Polynomial& p) const { return signs_.is_assumed_nonzero(p); }

  /// Functions whose common real zeros are those of `p`: where that is a sum of squares, or of what
  /// is not negative, all of its parts; else `p` itself.
  std::vector<Polynomial> real_zeros(const Polynomial& p) const { return signs_.real_zeros(p); }
  /// The same at the edge of where roots and logarithms have values, too.
  std::vector<Polynomial> real_zeros_at_edge(const Polynomial& p) const {
    return signs_.at_edge().real_zeros(p);
  }

  /// Whether each factor has a strict sign that is assumed, not implied by roots and logarithms,
  /// and their product is positive; also true of exponentials.
  bool is_assumed_positive(const Polynomial& p) const { return signs_.is_assumed_positive(p); }

  /// The irreducible factors of what stands under the roots and absolute values that `p` contains,
  /// also within other functions. Where none of them vanishes, `p` is differentiable.
  /// \param cuts  with what has to vanish for atan2 to jump, which does not concern derivatives
  std::vector<Polynomial> radicand_factors(const Polynomial& p, bool cuts = false) const {
    return pieces_.radicand_factors(p, cuts);
  }

  /// See `FunctionPieces`.
  std::vector<Polynomial> pole_factors(const Polynomial& p) const {
    return pieces_.pole_factors(p);
  }

  /// See `FunctionPieces`.
  std::optional<Polynomial> leading_divided_by(const Polynomial& p, const Polynomial& f) const {
    return pieces_.leading_divided_by(p, f);
  }

  /// Where `p`, having values on both sides, may jump.
  /// \param cuts  as of `FunctionPieces`
  std::vector<functions::JumpPlace> jump_factors(const Polynomial& p, bool cuts,
                                                 const std::vector<Polynomial>& more) const {
    return pieces_.jump_factors(p, cuts, more);
  }
  /// See `FunctionPieces`.
  std::vector<functions::JumpPlace> split_jump_factors(const Polynomial& p) const {
    return pieces_.split_jump_factors(p);
  }
  bool vanishes_with(const Polynomial& p, const Polynomial& f) const {
    return pieces_.vanishes_with(p, f);
  }

  /// See `FunctionPieces`.
  std::optional<Polynomial> pole_coefficient(const Polynomial& p, const Polynomial& f) const {
    return pieces_.pole_coefficient(p, f);
  }
  bool grows_towards_zero(const Polynomial& p, const Polynomial& f) const {
    return pieces_.grows_towards_zero(p, f);
  }

  /// Whether `p` is differentiable all the same where one of its radicands has the factor `f` that
  /// vanishes, as y*|y| and x^(3/2) are.
  bool is_smooth_across(const Polynomial& p, const Polynomial& f) const {
    return pieces_.is_smooth_across(p, f);
  }

  /// Whether `p` has the factor `f` under its roots in |f| alone, and no inverse function: then it
  /// is differentiable along a curve on which f keeps its sign, or stays zero.
  bool is_rough_in_absolute_value_alone(const Polynomial& p, const Polynomial& f) const {
    return pieces_.is_rough_in_absolute_value_alone(p, f);
  }

  /// Whether `p` depends on one of the first `coordinates` symbols, through generators too.
  bool depends_on_first(const Polynomial& p, std::size_t coordinates) const;
  /// The same for one symbol.
  bool depends_on(const Polynomial& p, std::size_t symbol) const {
    return table_.depends_on(p, symbol);
  }

  /// How functions hang together beyond the part of the domain where a point lies.
  using Pieces = functions::FunctionPieces::Pieces;
  Pieces pieces(const std::vector<Polynomial>& functions) const {
    return pieces_.pieces(functions);
  }

 private:
  void build(const std::vector<GiNaC::ex>& expressions);

  functions::GeneratorTable table_;
  functions::SignTable signs_;
  std::unique_ptr<functions::Converter> converter_;
  functions::FunctionPieces pieces_;
};

}  // namespace casimir
