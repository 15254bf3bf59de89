// A FunctionRing's elements as expressions, as text, and at rational points.
#include <cln/integer.h>
#include <cln/rational.h>
#include <cln/rational_io.h>
#include <fmt/format.h>

#include <numeric>

#include "symbolic/algebra/number_text.hpp"
#include "symbolic/case/limits.hpp"
#include "symbolic/functions/function_ring.hpp"

namespace casimir {
namespace {

std::string power_text(unsigned long exponent) {
  return exponent == 1 ? "" : "^" + std::to_string(exponent);
}

std::string bracketed(const std::string& text) { return "(" + text + ")"; }

}  // namespace

using GiNaC::ex;

double FunctionRing::expression_size(const Polynomial& p) const {
  double size = 0;
  for (const auto& [coefficient, exponents] : p.term_list()) {
    for (std::size_t i = 0; i < exponents.size(); ++i) {
      if (exponents[i] > 0) size += i < symbols_.size() ? 1 : generators_[i - symbols_.size()].size;
    }
  }
  return size;
}

ex FunctionRing::expression(const Polynomial& p) const {
  // GiNaC shares what is repeated, but goes through all of it to compare and to sort.
  if (expression_size(p) > limits().size)
    throw TooLarge(fmt::format("an expression would have more than {:g} factors; {}", limits().size,
                               limit_hint(&Limits::size)));
  GiNaC::exvector terms;
  for (const auto& [coefficient, exponents] : p.term_list()) {
    GiNaC::exvector factors{GiNaC::numeric(coefficient)};
    for (std::size_t i = 0; i < exponents.size(); ++i) {
      if (exponents[i] == 0) continue;
      const ex base =
          i < symbols_.size() ? ex(symbols_[i]) : generators_[i - symbols_.size()].value;
      factors.push_back(GiNaC::pow(base, static_cast<long>(exponents[i])));
    }
    terms.push_back(GiNaC::mul(factors));
  }
  return GiNaC::add(terms);
}

ex FunctionRing::quotient(const Polynomial& p, const Polynomial& q) const {
  const auto [p_top, p_bottom] = fraction(p);
  const auto [q_top, q_bottom] = fraction(q);
  Polynomial top = numerator(checked_product(p_top, q_bottom));
  Polynomial bottom = numerator(checked_product(q_top, p_bottom));
  if (top.is_zero()) return 0;
  const Polynomial common = Polynomial::gcd(top, bottom);
  top.divide(common, &top);
  bottom.divide(common, &bottom);
  return expression(top) / expression(bottom);
}

std::string FunctionRing::text(const Polynomial& p) const {
  std::string result;
  for (const auto& [coefficient, exponents] : p.term_list()) {
    std::string factors;
    for (std::size_t i = 0; i < exponents.size(); ++i) {
      if (exponents[i] == 0) continue;
      if (!factors.empty()) factors += "*";
      factors += i < symbols_.size() ? symbols_[i].get_name() + power_text(exponents[i])
                                     : power_of(generators_[i - symbols_.size()], exponents[i]);
    }
    append_term(result, coefficient, factors);
  }
  return result.empty() ? "0" : result;
}

/// A power associates to the right, and so does not take over a power that is written out: the
/// square of x^(1/3) is x^(2/3), not x^(1/3)^2.
std::string FunctionRing::power_of(const Generator& g, unsigned long exponent) const {
  if (g.kind == Kind::root && g.order > 2) {
    const unsigned long common = std::gcd(exponent, g.order);
    const unsigned long bottom = g.order / common;
    return bracketed(text(g.base)) + "^" +
           (bottom == 1 ? std::to_string(exponent / common)
                        : fmt::format("({}/{})", exponent / common, bottom));
  }
  return name(g) + power_text(exponent);
}

/// What stands in a product or under a power as it is; GiNaC's text of log(x^2)/2 does not.
std::string FunctionRing::name(const Generator& g) const {
  switch (g.kind) {
    case Kind::sine:
      return "sin(" + text(g.base) + ")";
    case Kind::cosine: {
      // Its sine stands just before it and has the angle.
      const auto index = static_cast<std::size_t>(&g - generators_.data());
      return "cos(" + text(generators_[index - 1].base) + ")";
    }
    case Kind::exponential:
      return "exp(" + text(g.base) + ")";
    case Kind::root:
      return g.order == 2 ? "sqrt(" + text(g.base) + ")" : power_of(g, 1);
    case Kind::inverse:
      return "(1/(" + text(g.base) + "))";
    case Kind::absolute:
      return "sqrt(" + text(g.base) + ")";
    case Kind::imaginary:
      return "I";
    case Kind::function:
      break;
  }
  // GiNaC's order of terms differs from run to run.
  if (g.order == kPartCosine) return "cos(" + text(g.base) + ")";
  if (g.order == kPartSine) return "sin(" + text(g.base) + ")";
  if (g.order == kCosineOfPi) return "cos(Pi/" + text(g.base) + ")";
  if (g.order == kSignedHalf) {  // 2 r = (r - x) + (r + x)
    const Polynomial& other = generators_[g.partner->first - symbols_.size()].base;
    return "(sqrt(" + text(g.relation[0] + other) + ")*sin(" + text(g.base) + "))";
  }
  const std::string value = expression_text(g.value);
  return GiNaC::is_exactly_a<GiNaC::function>(g.value) ||
                 GiNaC::is_exactly_a<GiNaC::constant>(g.value)
             ? value
             : bracketed(value);
}

FunctionRing::Origin FunctionRing::origin(std::size_t place) const {
  using Of = Origin::Kind;
  const Generator& g = generators_.at(place - symbols_.size());
  switch (g.kind) {
    case Kind::sine:
      return {Of::sine, g.base};
    case Kind::cosine:
      return {Of::cosine, generators_[place - symbols_.size() - 1].base};
    case Kind::exponential:
      return {Of::exponential, g.base};
    case Kind::root:
      return {Of::root, g.base, g.order};
    case Kind::inverse:
      return {Of::inverse, g.base};
    case Kind::absolute:
      return {Of::absolute, g.base, g.order};
    case Kind::imaginary:
      return {Of::imaginary, g.base};
    case Kind::function:
      break;
  }
  switch (g.order) {
    case kLogarithm:
    case kLogOfAbsolute:
      return {Of::logarithm, g.base};
    case kArcTangent:
      return {Of::arc_tangent, g.base};
    case kArcSine:
    case kArcCosine:
      return {Of::arc_sine, g.base};
    case kArcTangentOfTwo: {
      // The arguments were converted when it was made.
      const Polynomial& y = known_.at(g.value.op(0));
      const Polynomial& x = known_.at(g.value.op(1));
      return {Of::arc_tangent_of_two, x * x + y * y};
    }
    case kPartCosine:
    case kPartSine:
    case kSignedHalf:
    case kCosineOfPi:
      return {Of::part_of_angle, g.base};
    default:
      return {Of::constant, g.base};
  }
}

bool FunctionRing::is_exponential(const Polynomial& p) const {
  for (std::size_t g = 0; g < generators_.size(); ++g) {
    if (generators_[g].kind == Kind::exponential && p == ring_->variable(symbols_.size() + g))
      return true;
  }
  return false;
}

void FunctionRing::mark_denominators(const Polynomial& p, std::vector<bool>& marks) const {
  std::size_t place = 0;
  for (std::size_t g = 0; g < generators_.size(); ++g) {
    if (generators_[g].kind != Kind::inverse) continue;
    if (marks.size() == place) marks.push_back(false);
    if (!marks[place]) marks[place] = p.uses(symbols_.size() + g);
    ++place;
  }
}

std::vector<std::pair<Polynomial, bool>> FunctionRing::implied_positive() const {
  std::vector<std::pair<Polynomial, bool>> result;
  for (const Sign& s : signs_) {
    if (s.implied) result.emplace_back(s.sign > 0 ? s.of : -s.of, s.strict);
  }
  return result;
}

std::vector<ex> FunctionRing::real_domain() const {
  std::vector<ex> result;
  if (complex_) return result;
  for (const Generator& g : generators_) {
    const bool even_root = g.kind == Kind::root && g.order % 2 == 0;
    const bool logarithm = g.kind == Kind::function && g.order == kLogarithm;
    if ((even_root || logarithm) && !g.base.is_constant()) result.push_back(expression(g.base));
  }
  return result;
}

std::vector<Polynomial> FunctionRing::denominators() const {
  std::vector<Polynomial> result;
  for (const Generator& g : generators_) {
    if (g.kind == Kind::inverse) result.push_back(g.base);
  }
  return result;
}

}  // namespace casimir
