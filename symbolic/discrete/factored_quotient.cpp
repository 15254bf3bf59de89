#include "symbolic/discrete/factored_quotient.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "symbolic/algebra/integer_factors.hpp"
#include "symbolic/algebra/number_text.hpp"
#include "symbolic/error.hpp"

namespace casimir::discrete {
namespace {

bool is_same_up_to_sign(const Polynomial& a, const Polynomial& b) { return a == b || a == -b; }

/// The exponent of a prime in a number that is not zero.
int exponent_in(const cln::cl_RA& number, const cln::cl_I& prime) {
  int result = 0;
  for (cln::cl_I part = cln::numerator(number); cln::mod(part, prime) == 0;
       part = cln::exquo(part, prime))
    ++result;
  for (cln::cl_I part = cln::denominator(number); cln::mod(part, prime) == 0;
       part = cln::exquo(part, prime))
    --result;
  return result;
}

std::vector<cln::cl_I> primes_of(const std::vector<FactoredQuotient>& quotients) {
  std::vector<cln::cl_I> primes;
  for (const FactoredQuotient& q : quotients) {
    for (const cln::cl_I& part : {cln::abs(cln::numerator(q.number)), cln::denominator(q.number)}) {
      const auto factors = prime_factors(part);
      if (!factors) throw TooLarge("the number of a cofactor was not factored");
      for (const auto& [prime, exponent] : *factors)
        if (std::ranges::find(primes, prime) == primes.end()) primes.push_back(prime);
    }
  }
  return primes;
}

}  // namespace

void FactoredQuotient::multiply(const Polynomial& base, int exponent) {
  const auto own = std::ranges::find_if(
      powers, [&](const auto& power) { return is_same_up_to_sign(power.first, base); });
  if (own == powers.end()) {
    powers.emplace_back(base, exponent);
    return;
  }
  if (!(own->first == base) && exponent % 2 != 0) number = -number;
  own->second += exponent;
}

void FactoredQuotient::multiply_factors(const Polynomial& p, int exponent) {
  for (const auto& [factor, e] : p.factors()) {
    const int own = static_cast<int>(e) * exponent;
    if (factor.is_constant())
      number = number * cln::expt(factor.content(), own);
    else
      multiply(factor, own);
  }
}

int FactoredQuotient::exponent_of(const Polynomial& base) const {
  for (const auto& [own, exponent] : powers)
    if (is_same_up_to_sign(own, base)) return exponent;
  return 0;
}

std::string FactoredQuotient::text(const FunctionRing& ring) const {
  std::string top, bottom;
  int below = 0;
  for (const auto& [base, exponent] : powers) {
    if (exponent == 0) continue;
    std::string& text = exponent > 0 ? top : bottom;
    below += exponent < 0 ? 1 : 0;
    const std::string own = ring.text(base);
    if (!text.empty()) text += "*";
    text += base.terms() > 1 || base.total_degree() > 1 ? "(" + own + ")" : own;
    if (std::abs(exponent) != 1) text += fmt::format("^{}", std::abs(exponent));
  }
  const std::string factor = rational_text(number);
  if (top.empty())
    top = factor;
  else if (number == -1)
    top = "-" + top;
  else if (number != 1)
    top = factor + "*" + top;
  if (bottom.empty()) return top;
  return top + "/" + (below == 1 ? bottom : "(" + bottom + ")");
}

GiNaC::ex FactoredQuotient::value(const FunctionRing& ring) const {
  GiNaC::ex result = GiNaC::numeric(number);
  for (const auto& [base, exponent] : powers) result *= GiNaC::pow(ring.expression(base), exponent);
  return result;
}

RationalMatrix exponent_rows(const std::vector<FactoredQuotient>& quotients) {
  FactoredQuotient all;
  for (const FactoredQuotient& q : quotients)
    for (const auto& [base, e] : q.powers) all.multiply(base, 1);
  RationalMatrix rows;
  for (const auto& [base, e] : all.powers) {
    rows.emplace_back();
    for (const FactoredQuotient& q : quotients) rows.back().push_back(q.exponent_of(base));
  }
  for (const cln::cl_I& prime : primes_of(quotients)) {
    rows.emplace_back();
    for (const FactoredQuotient& q : quotients) rows.back().push_back(exponent_in(q.number, prime));
  }
  return rows;
}

}  // namespace casimir::discrete
