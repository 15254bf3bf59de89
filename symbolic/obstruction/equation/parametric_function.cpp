#include "symbolic/obstruction/equation/parametric_function.hpp"

#include <cln/integer.h>
#include <cln/rational.h>
#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "symbolic/algebra/number_text.hpp"
#include "symbolic/obstruction/equation/kovacic.hpp"

namespace casimir::obstruction {
namespace {

const PolynomialRing& ring() {
  static const PolynomialRing result(1 + ParametricFunction::kMostParameters);
  return result;
}

const std::string& name_of(std::size_t place, const CurveNames& names) {
  if (place == ParametricFunction::kParameter) return names.parameter;
  return place == ParametricFunction::kVariable ? names.z : names.further[place - 2];
}

bool has_further(const Polynomial& polynomial) {
  for (std::size_t i = 2; i < polynomial.ring().size(); ++i)
    if (polynomial.uses(i)) return true;
  return false;
}

std::string printed(const Polynomial& polynomial, const CurveNames& names) {
  std::string result;
  for (const auto& [coefficient, exponents] : polynomial.term_list()) {
    std::string term;
    for (std::size_t i = 0; i < exponents.size(); ++i) {
      if (exponents[i] == 0) continue;
      term += (term.empty() ? "" : "*") + name_of(i, names);
      if (exponents[i] > 1) term += fmt::format("^{}", exponents[i]);
    }
    append_term(result, coefficient, term);
  }
  return result.empty() ? "0" : result;
}

std::string enclosed(const std::string& text) {
  return text.find_first_of(" /*", 1) == std::string::npos ? text : "(" + text + ")";
}

/// The root of a product of even powers; empty for anything else.
std::optional<Polynomial> root(const Polynomial& polynomial) {
  Polynomial result = ring().constant(1);
  for (const auto& [factor, exponent] : polynomial.factors()) {
    if (factor.is_constant()) {
      const auto number = square_root(factor.evaluate(std::vector<cln::cl_RA>(ring().size(), 0)));
      if (!number) return std::nullopt;
      result = result.scaled(*number);
    } else if (exponent % 2 == 0) {
      result *= factor.pow(exponent / 2);
    } else {
      return std::nullopt;
    }
  }
  return result;
}

}  // namespace

ParametricFunction::ParametricFunction() : ParametricFunction(0) {}

ParametricFunction::ParametricFunction(int constant) : ParametricFunction(cln::cl_RA(constant)) {}

ParametricFunction::ParametricFunction(const cln::cl_RA& constant)
    : numerator_(ring().constant(constant)), denominator_(ring().constant(1)) {}

ParametricFunction::ParametricFunction(Polynomial numerator, Polynomial denominator)
    : numerator_(std::move(numerator)), denominator_(std::move(denominator)) {
  if (denominator_.is_zero()) throw std::domain_error("division of a rational function by zero");
  if (numerator_.is_zero()) {
    denominator_ = ring().constant(1);
    return;
  }
  const Polynomial common = Polynomial::gcd(numerator_, denominator_);
  if (!common.is_constant()) {
    Polynomial above(ring()), below(ring());
    if (!numerator_.divide(common, &above) || !denominator_.divide(common, &below))
      throw std::logic_error("a common factor divides");
    numerator_ = above;
    denominator_ = below;
  }
  const cln::cl_RA leading = denominator_.term_list().front().first;
  numerator_ = numerator_.scaled(1 / leading);
  denominator_ = denominator_.scaled(1 / leading);
}

ParametricFunction ParametricFunction::variable() {
  return {ring().variable(kVariable), ring().constant(1)};
}

ParametricFunction ParametricFunction::parameter(std::size_t i) {
  return {ring().variable(i == 0 ? kParameter : i + 1), ring().constant(1)};
}

ParametricFunction ParametricFunction::of_parameter(const Univariate& polynomial) {
  Polynomial result(ring());
  const Polynomial c = ring().variable(kParameter);
  for (long i = polynomial.degree(); i >= 0; --i)
    result = result * c + ring().constant(polynomial.coefficient(i));
  return {result, ring().constant(1)};
}

bool ParametricFunction::uses_variable() const {
  return numerator_.uses(kVariable) || denominator_.uses(kVariable);
}

RationalFunction ParametricFunction::in_parameter() const {
  return {obstruction::in_parameter(numerator_), obstruction::in_parameter(denominator_)};
}

RationalFunction ParametricFunction::at_parameter(const cln::cl_RA& value) const {
  const auto at = [&](const Polynomial& polynomial) {
    std::vector<cln::cl_RA> coefficients;
    for (const Univariate& own : parameter_coefficients(polynomial))
      coefficients.push_back(own.at(value));
    return Univariate(coefficients);
  };
  return {at(numerator_), at(denominator_)};
}

ParametricFunction operator+(const ParametricFunction& a, const ParametricFunction& b) {
  return {a.numerator_ * b.denominator_ + b.numerator_ * a.denominator_,
          a.denominator_ * b.denominator_};
}

ParametricFunction operator-(const ParametricFunction& a, const ParametricFunction& b) {
  return {a.numerator_ * b.denominator_ - b.numerator_ * a.denominator_,
          a.denominator_ * b.denominator_};
}

ParametricFunction operator*(const ParametricFunction& a, const ParametricFunction& b) {
  return {a.numerator_ * b.numerator_, a.denominator_ * b.denominator_};
}

ParametricFunction operator/(const ParametricFunction& a, const ParametricFunction& b) {
  return {a.numerator_ * b.denominator_, a.denominator_ * b.numerator_};
}

ParametricFunction operator-(const ParametricFunction& a) { return ParametricFunction() - a; }

ParametricFunction ParametricFunction::derivative() const {
  return {numerator_.derivative(kVariable) * denominator_ -
              numerator_ * denominator_.derivative(kVariable),
          denominator_ * denominator_};
}

std::optional<ParametricFunction> ParametricFunction::square_root() const {
  if (is_zero()) return ParametricFunction();
  const std::optional<Polynomial> above = root(numerator_), below = root(denominator_);
  if (!above || !below) return std::nullopt;
  return ParametricFunction(*above, *below);
}

std::vector<Univariate> parameter_coefficients(const Polynomial& polynomial) {
  std::vector<Univariate> result;
  for (const Polynomial& own : polynomial.coefficients(ParametricFunction::kVariable))
    result.push_back(in_parameter(own));
  return result;
}

std::vector<ParametricFunction> variable_coefficients(const Polynomial& polynomial) {
  std::vector<ParametricFunction> result;
  for (const Polynomial& own : polynomial.coefficients(ParametricFunction::kVariable))
    result.emplace_back(own, ring().constant(1));
  return result;
}

Univariate in_parameter(const Polynomial& polynomial) {
  if (has_further(polynomial)) throw std::logic_error("not a function of one parameter alone");
  std::vector<cln::cl_RA> coefficients;
  for (const auto& [coefficient, exponents] : polynomial.term_list()) {
    if (exponents[ParametricFunction::kVariable] != 0)
      throw std::logic_error("not a function of the parameter alone");
    const std::size_t degree = exponents[ParametricFunction::kParameter];
    if (coefficients.size() <= degree) coefficients.resize(degree + 1, 0);
    coefficients[degree] = coefficient;
  }
  return Univariate(coefficients);
}

std::string written(const RationalFunction& f, const CurveNames& names) { return f.text(names.z); }

std::string written(const ParametricFunction& f, const CurveNames& names) {
  const std::string above = printed(f.numerator(), names);
  if (f.denominator().is_constant()) return above;
  // The numbers before the factors of a monic denominator multiply to 1: all are written monic.
  std::string below;
  std::size_t count = 0;
  for (const auto& [factor, exponent] : f.denominator().factors()) {
    if (factor.is_constant()) continue;
    const Polynomial own = factor.scaled(1 / factor.term_list().front().first);
    below += (count++ > 0 ? "*" : "") + enclosed(printed(own, names));
    if (exponent > 1) below += fmt::format("^{}", exponent);
  }
  const bool sum = above.find(' ', 1) != std::string::npos || above.find('/') != std::string::npos;
  return (sum ? "(" + above + ")" : above) + "/" + (count > 1 ? "(" + below + ")" : below);
}

long total_degree(const RationalFunction& f) {
  return f.numerator().degree() + f.denominator().degree();
}

long total_degree(const ParametricFunction& f) {
  return f.numerator().degree(ParametricFunction::kVariable) +
         f.denominator().degree(ParametricFunction::kVariable);
}

long pole_count(const RationalFunction& f) { return f.denominator().degree(); }

long pole_count(const ParametricFunction& f) {
  return f.denominator().degree(ParametricFunction::kVariable);
}

bool leads_with_minus(const RationalFunction& f) { return cln::minusp(f.numerator().leading()); }

bool leads_with_minus(const ParametricFunction& f) {
  const Polynomial above = f.numerator().coefficients(ParametricFunction::kVariable).back();
  const Polynomial below = f.denominator().coefficients(ParametricFunction::kVariable).back();
  if (!above.is_constant() || !below.is_constant())
    throw NotDecided("the sign of a root depends on the parameter");
  return cln::minusp(in_parameter(above).leading() / in_parameter(below).leading());
}

void ParameterConditions::nonzero(const Univariate& polynomial) {
  if (polynomial.is_zero()) throw NotDecided("a condition on the parameter fails for all values");
  for (const auto& [factor, exponent] : polynomial.factors())
    if (std::find(polynomials_.begin(), polynomials_.end(), factor) == polynomials_.end())
      polynomials_.push_back(factor);
}

namespace {

/// The polynomial whose zeros c are those where all coefficients vanish.
Univariate common_factor(const Polynomial& polynomial) {
  Univariate result;
  for (const Univariate& own : parameter_coefficients(polynomial)) result = gcd(result, own);
  return result;
}

}  // namespace

void ParameterConditions::nonzero(const Polynomial& polynomial) {
  if (!has_further(polynomial)) {
    nonzero(common_factor(polynomial));
    return;
  }
  const Polynomial leading = polynomial.coefficients(ParametricFunction::kVariable).back();
  for (const auto& [factor, exponent] : leading.factors()) {
    if (factor.is_constant()) continue;
    if (!has_further(factor)) {
      nonzero(in_parameter(factor));
      continue;
    }
    const Polynomial monic = factor.scaled(1 / factor.term_list().front().first);
    if (std::find(several_.begin(), several_.end(), monic) == several_.end())
      several_.push_back(monic);
  }
}

void ParameterConditions::nonzero(const ParametricFunction& f) {
  nonzero(f.numerator());
  defined(f);
}

void ParameterConditions::defined(const ParametricFunction& f) { nonzero(f.denominator()); }

void ParameterConditions::add(const ParameterConditions& others) {
  for (const Univariate& own : others.polynomials_) nonzero(own);
  for (const Polynomial& own : others.several_) nonzero(own);
}

}  // namespace casimir::obstruction
