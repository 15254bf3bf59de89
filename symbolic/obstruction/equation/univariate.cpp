#include "symbolic/obstruction/equation/univariate.hpp"

#include <cln/rational_io.h>
#include <flint/fmpz_poly.h>
#include <flint/fmpz_poly_factor.h>
#include <fmt/format.h>

#include <stdexcept>

#include "symbolic/algebra/flint_conversion.hpp"
#include "symbolic/algebra/number_text.hpp"

namespace casimir::obstruction {

Univariate::Univariate(const cln::cl_RA& constant) : Univariate() {
  Rational number(constant);
  fmpq_poly_set_fmpq(value_, number.get());
}

Univariate::Univariate(const std::vector<cln::cl_RA>& coefficients) : Univariate() {
  for (std::size_t i = 0; i < coefficients.size(); ++i) {
    Rational number(coefficients[i]);
    fmpq_poly_set_coeff_fmpq(value_, static_cast<slong>(i), number.get());
  }
}

Univariate::Univariate(const Univariate& other) : Univariate() {
  fmpq_poly_set(value_, other.value_);
}

Univariate::Univariate(Univariate&& other) noexcept : Univariate() {
  fmpq_poly_swap(value_, other.value_);
}

Univariate& Univariate::operator=(Univariate other) noexcept {
  fmpq_poly_swap(value_, other.value_);
  return *this;
}

Univariate Univariate::variable() { return Univariate(std::vector<cln::cl_RA>{0, 1}); }

cln::cl_RA Univariate::coefficient(long i) const {
  if (i < 0) return 0;
  Rational number;
  fmpq_poly_get_coeff_fmpq(number.get(), value_, i);
  return number.number();
}

cln::cl_RA Univariate::at(const cln::cl_RA& point) const {
  Rational where(point), result;
  fmpq_poly_evaluate_fmpq(result.get(), value_, where.get());
  return result.number();
}

Univariate& Univariate::operator+=(const Univariate& other) {
  fmpq_poly_add(value_, value_, other.value_);
  return *this;
}

Univariate& Univariate::operator-=(const Univariate& other) {
  fmpq_poly_sub(value_, value_, other.value_);
  return *this;
}

Univariate& Univariate::operator*=(const Univariate& other) {
  fmpq_poly_mul(value_, value_, other.value_);
  return *this;
}

Univariate Univariate::derivative() const {
  Univariate result;
  fmpq_poly_derivative(result.value_, value_);
  return result;
}

Univariate Univariate::pow(unsigned long exponent) const {
  Univariate result;
  fmpq_poly_pow(result.value_, value_, exponent);
  return result;
}

Univariate Univariate::monic() const {
  Univariate result;
  fmpq_poly_make_monic(result.value_, value_);
  return result;
}

Univariate Univariate::composed(const Univariate& inner) const {
  Univariate result;
  fmpq_poly_compose(result.value_, value_, inner.value_);
  return result;
}

std::pair<Univariate, Univariate> Univariate::divided(const Univariate& divisor) const {
  if (divisor.is_zero()) throw std::domain_error("division of a polynomial by zero");
  std::pair<Univariate, Univariate> result;
  fmpq_poly_divrem(result.first.value_, result.second.value_, value_, divisor.value_);
  return result;
}

Univariate Univariate::inverse(const Univariate& modulus) const {
  Univariate common, own, other;
  fmpq_poly_xgcd(common.value_, own.value_, other.value_, value_, modulus.value_);
  if (common.degree() != 0) throw std::domain_error("no inverse modulo a polynomial");
  return own.remainder(modulus);
}

std::vector<std::pair<Univariate, unsigned long>> Univariate::factors() const {
  std::vector<std::pair<Univariate, unsigned long>> result;
  if (degree() < 1) return result;
  fmpz_poly_t integral;
  fmpz_poly_init(integral);
  fmpq_poly_get_numerator(integral, value_);
  fmpz_poly_factor_t list;
  fmpz_poly_factor_init(list);
  fmpz_poly_factor(list, integral);
  for (slong i = 0; i < list->num; ++i) {
    Univariate factor;
    fmpq_poly_set_fmpz_poly(factor.value_, list->p + i);
    result.emplace_back(factor.monic(), static_cast<unsigned long>(list->exp[i]));
  }
  fmpz_poly_factor_clear(list);
  fmpz_poly_clear(integral);
  return result;
}

namespace {

std::string power_text(const std::string& variable, long exponent) {
  return exponent == 1 ? variable : fmt::format("{}^{}", variable, exponent);
}

}  // namespace

std::string Univariate::text(const std::string& variable) const {
  if (is_zero()) return "0";
  std::string result;
  for (long i = degree(); i >= 0; --i) {
    const cln::cl_RA c = coefficient(i);
    if (cln::zerop(c)) continue;
    const cln::cl_RA size = cln::abs(c);
    if (result.empty())
      result = cln::minusp(c) ? "-" : "";
    else
      result += cln::minusp(c) ? " - " : " + ";
    if (i == 0)
      result += rational_text(size);
    else
      result += (size == 1 ? "" : rational_text(size) + "*") + power_text(variable, i);
  }
  return result;
}

Univariate gcd(const Univariate& a, const Univariate& b) {
  Univariate result;
  fmpq_poly_gcd(result.raw(), a.raw(), b.raw());
  return result;
}

RationalFunction::RationalFunction(Univariate numerator, Univariate denominator) {
  if (denominator.is_zero()) throw std::domain_error("division of a rational function by zero");
  const Univariate common = gcd(numerator, denominator);
  numerator_ = numerator.divided(common).first;
  denominator_ = denominator.divided(common).first;
  const cln::cl_RA leading = denominator_.leading();
  numerator_ *= Univariate(1 / leading);
  denominator_ *= Univariate(1 / leading);
}

RationalFunction operator+(const RationalFunction& a, const RationalFunction& b) {
  return {a.numerator_ * b.denominator_ + b.numerator_ * a.denominator_,
          a.denominator_ * b.denominator_};
}

RationalFunction operator-(const RationalFunction& a, const RationalFunction& b) {
  return {a.numerator_ * b.denominator_ - b.numerator_ * a.denominator_,
          a.denominator_ * b.denominator_};
}

RationalFunction operator*(const RationalFunction& a, const RationalFunction& b) {
  return {a.numerator_ * b.numerator_, a.denominator_ * b.denominator_};
}

RationalFunction operator/(const RationalFunction& a, const RationalFunction& b) {
  return {a.numerator_ * b.denominator_, a.denominator_ * b.numerator_};
}

RationalFunction RationalFunction::derivative() const {
  return {numerator_.derivative() * denominator_ - numerator_ * denominator_.derivative(),
          denominator_ * denominator_};
}

RationalFunction RationalFunction::pow(long exponent) const {
  const auto size = static_cast<unsigned long>(exponent < 0 ? -exponent : exponent);
  if (exponent < 0) return {denominator_.pow(size), numerator_.pow(size)};
  return {numerator_.pow(size), denominator_.pow(size)};
}

std::optional<RationalFunction> RationalFunction::square_root() const {
  if (is_zero()) return RationalFunction(0);
  const std::optional<cln::cl_RA> leading = obstruction::square_root(numerator_.leading());
  if (!leading) return std::nullopt;
  const auto root = [](const Univariate& p) -> std::optional<Univariate> {
    Univariate result(1);
    for (const auto& [factor, exponent] : p.factors()) {
      if (exponent % 2 != 0) return std::nullopt;
      result *= factor.pow(exponent / 2);
    }
    return result;
  };
  const std::optional<Univariate> above = root(numerator_), below = root(denominator_);
  if (!above || !below) return std::nullopt;
  return RationalFunction(*above * Univariate(*leading), *below);
}

std::string RationalFunction::text(const std::string& variable) const {
  const auto enclosed = [&](const Univariate& p) {
    const std::string own = p.text(variable);
    return own.find_first_of(" /", 1) == std::string::npos ? own : "(" + own + ")";
  };
  if (denominator_.is_constant()) return numerator_.text(variable);
  std::string below;
  std::size_t count = 0;
  for (const auto& [factor, exponent] : denominator_.factors()) {
    below += (count++ > 0 ? "*" : "") + enclosed(factor);
    if (exponent > 1) below += fmt::format("^{}", exponent);
  }
  return enclosed(numerator_) + "/" + (count > 1 ? "(" + below + ")" : below);
}

std::optional<cln::cl_RA> square_root(const cln::cl_RA& value) {
  cln::cl_RA root;
  if (cln::minusp(value) || !cln::sqrtp(value, &root)) return std::nullopt;
  return root;
}

}  // namespace casimir::obstruction
