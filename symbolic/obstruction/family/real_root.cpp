#include "symbolic/obstruction/family/real_root.hpp"

#include <acb.h>
#include <arb_fmpz_poly.h>
#include <cln/integer.h>
#include <cln/rational.h>
#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "symbolic/algebra/flint_conversion.hpp"
#include "symbolic/algebra/number_text.hpp"

namespace casimir::obstruction {
namespace {

using cln::cl_RA;

RationalInterval product(const RationalInterval& a, const RationalInterval& b) {
  const cl_RA ends[] = {a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high};
  RationalInterval result{ends[0], ends[0]};
  for (const cl_RA& end : ends) {
    if (end < result.low) result.low = end;
    if (end > result.high) result.high = end;
  }
  return result;
}

RationalInterval value_on(const Univariate& polynomial, const RationalInterval& x) {
  RationalInterval result{0, 0};
  for (long i = polynomial.degree(); i >= 0; --i) {
    result = product(result, x);
    result.low = result.low + polynomial.coefficient(i);
    result.high = result.high + polynomial.coefficient(i);
  }
  return result;
}

cl_RA rational(const arf_t value) {
  Rational result;
  arf_get_fmpq(result.get(), value);
  return result.number();
}

/// Arb's ball of a real number, from below to above.
RationalInterval interval_of(const arb_t ball) {
  arf_t low, high;
  arf_init(low);
  arf_init(high);
  arb_get_lbound_arf(low, ball, 64);
  arb_get_ubound_arf(high, ball, 64);
  RationalInterval result{rational(low), rational(high)};
  arf_clear(low);
  arf_clear(high);
  return result;
}

int sign(const cl_RA& value) { return cln::zerop(value) ? 0 : cln::minusp(value) ? -1 : 1; }

/// Intervals around the real roots of an irreducible polynomial of degree 2 or more, in order; with
/// rational ends none of which is a root, they are disjoint where Arb's bounds are.
std::vector<RationalInterval> isolated(const Univariate& polynomial) {
  fmpz_poly_t integral;
  fmpz_poly_init(integral);
  fmpq_poly_get_numerator(integral, polynomial.raw());
  const slong degree = fmpz_poly_degree(integral);
  acb_ptr const roots = _acb_vec_init(degree);
  arb_fmpz_poly_complex_roots(roots, integral, 0, 64);
  std::vector<RationalInterval> result;
  for (slong k = 0; k < degree; ++k)
    if (acb_is_real(roots + k) != 0) result.push_back(interval_of(acb_realref(roots + k)));
  _acb_vec_clear(roots, degree);
  fmpz_poly_clear(integral);
  std::sort(result.begin(), result.end(),
            [](const auto& a, const auto& b) { return a.low < b.low; });
  for (std::size_t i = 0; i < result.size(); ++i)
    if (sign(polynomial.at(result[i].low)) * sign(polynomial.at(result[i].high)) >= 0 ||
        (i > 0 && result[i - 1].high >= result[i].low))
      throw std::logic_error("a real root is not isolated");
  return result;
}

}  // namespace

RealRoot::RealRoot(const cl_RA& value)
    : polynomial_(Univariate::variable() - Univariate(value)), place_(0), interval_{value, value} {}

std::optional<cl_RA> RealRoot::rational() const {
  if (polynomial_.degree() != 1) return std::nullopt;
  return -polynomial_.coefficient(0);
}

void RealRoot::refine() {
  if (polynomial_.degree() == 1) return;
  const cl_RA middle = (interval_.low + interval_.high) / 2;
  // An irreducible polynomial of degree 2 or more has no rational root.
  const bool above = sign(polynomial_.at(middle)) == sign(polynomial_.at(interval_.low));
  (above ? interval_.low : interval_.high) = middle;
}

bool operator<(const RealRoot& a, const RealRoot& b) {
  if (a.polynomial_ == b.polynomial_) return a.place_ < b.place_;
  // Different irreducible polynomials have no common root.
  RealRoot left = a, right = b;
  for (;;) {
    if (left.interval_.high < right.interval_.low) return true;
    if (right.interval_.high < left.interval_.low) return false;
    left.refine();
    right.refine();
  }
}

bool RealRoot::is_root_of(const Univariate& polynomial) const {
  return polynomial.remainder(polynomial_).is_zero();
}

RationalInterval RealRoot::value(const RationalFunction& f, const cl_RA& length) const {
  if (is_root_of(f.denominator())) throw std::domain_error("a function has a pole");
  RealRoot place = *this;
  for (;; place.refine()) {
    const RationalInterval below = value_on(f.denominator(), place.interval_);
    if (sign(below.low) * sign(below.high) <= 0) continue;
    const RationalInterval result = product(value_on(f.numerator(), place.interval_),
                                            RationalInterval{1 / below.high, 1 / below.low});
    if (result.high - result.low <= length) return result;
  }
}

std::string RealRoot::text(const std::string& name) const {
  if (const auto own = rational()) return rational_text(*own);
  RealRoot place = *this;
  for (int i = 0; i < 40; ++i) place.refine();
  return fmt::format("the root of {} near {:.6g}", polynomial_.text(name),
                     cln::double_approx(place.interval_.low));
}

std::vector<RealRoot> real_roots(const Univariate& polynomial) {
  std::vector<RealRoot> result;
  for (const auto& [factor, exponent] : polynomial.factors()) {
    if (factor.degree() == 1) {
      result.emplace_back(-factor.coefficient(0));
      continue;
    }
    const std::vector<RationalInterval> intervals = isolated(factor);
    for (std::size_t i = 0; i < intervals.size(); ++i)
      result.push_back(RealRoot(factor, i, intervals[i]));
  }
  std::sort(result.begin(), result.end());
  return result;
}

}  // namespace casimir::obstruction
