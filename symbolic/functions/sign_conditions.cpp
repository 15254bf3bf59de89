// What roots and logarithms need in order to be real, as conditions that are said beside a verdict.
// The signs of single factors are not all of it: of x*y > 0 no factor has a sign, x^2*y >= 0 holds
// where x = 0 whatever y is, and log(x^2) has no value at x = 0.
#include <algorithm>

#include "symbolic/functions/sign_table.hpp"

namespace casimir::functions {
namespace {

bool contains(const std::vector<Polynomial>& list, const Polynomial& p) {
  return std::any_of(list.begin(), list.end(),
                     [&](const Polynomial& known) { return known == p || known == -p; });
}

}  // namespace

Implied SignTable::implied_by_values() const {
  Implied result;
  if (table_.is_complex()) return result;
  for (const Sign& s : signs_)
    if (s.implied) result.positive.emplace_back(s.sign > 0 ? s.of : -s.of, s.strict);
  // Those that are not zero first: where one holds, the same root has a value.
  for (const bool strict : {true, false}) {
    for (const Radicand& radicand : radicands_)
      if (radicand.strict == strict) add_conditions(radicand, result);
  }
  // x >= 0 and x != 0 are one condition.
  for (auto& condition : result.positive) {
    const Polynomial& p = condition.first;
    const auto is_p = [&](const Polynomial& f) { return f == p || f == -p; };
    if (std::erase_if(result.nonzero, is_p) > 0) condition.second = true;
  }
  return result;
}

/// Whether an irreducible polynomial vanishes nowhere, whatever is known of it by name: that may
/// have come from the very radicand whose conditions are asked for.
bool SignTable::is_nonzero_unless_listed(const Polynomial& f) const {
  if (f.terms() > 1) return is_nonzero_by_form(f);
  std::size_t place = 0;
  while (!f.uses(place)) ++place;
  if (place < table_.symbols().size()) return false;
  const Generator& g = table_.at_place(place);
  if (g.kind == Kind::exponential) return true;
  return (g.kind == Kind::root || g.kind == Kind::absolute) && is_nowhere_zero(g.base);
}

/// Adds what a radicand needs beyond the signs that are said already.
void SignTable::add_conditions(const Radicand& radicand, Implied& conditions) const {
  const auto is_shown_nonzero = [&](const Polynomial& f) {
    const auto shown = [&](const auto& s) { return s.of == f || s.of == -f; };
    return std::any_of(signs_.begin(), signs_.end(),
                       [&](const Sign& s) { return s.strict && shown(s); }) ||
           std::any_of(nonzero_.begin(), nonzero_.end(),
                       [&](const Nonzero& n) { return !n.implied && shown(n); }) ||
           contains(conditions.nonzero, f) || is_nonzero_unless_listed(f);
  };
  Polynomial open = table_.ring().constant(1);    // the factors whose signs are not known
  Polynomial others = table_.ring().constant(1);  // what may vanish beside them
  int sign = 1;
  for (const auto& [f, exponent] : radicand.factors) {
    if (f.is_constant()) {
      if (cln::minusp(f.term_list()[0].first)) sign = -sign;
      continue;
    }
    const int known = exponent % 2 == 0 ? 1 : known_sign(f);
    if (known < 0) sign = -sign;
    if (known == 0) open = table_.checked_product(open, f);
    if (is_shown_nonzero(f) || (known == 0 && radicand.strict)) continue;
    if (radicand.strict)
      conditions.nonzero.push_back(f);
    else if (known != 0)
      others = table_.checked_product(others, exponent % 2 == 0 ? f * f : f.scaled(known));
  }
  if (open.is_constant() && sign > 0) return;
  const auto is_said = [&](const Polynomial& p) {
    return std::any_of(conditions.positive.begin(), conditions.positive.end(), [&](const auto& c) {
      return c.first == p && (c.second || !radicand.strict);
    });
  };
  const Polynomial whole = table_.checked_product(open, others).scaled(sign);
  if (!is_said(open.scaled(sign)) && !is_said(whole))
    conditions.positive.emplace_back(whole, radicand.strict);
}

}  // namespace casimir::functions
