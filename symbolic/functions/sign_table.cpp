// What is inferred has to hold at every point at which the assumptions hold and everything that was
// converted has a real value, not only at almost all of them: a level may consist of the others. So
// the difference between > and >= counts. x^2*y >= 0 says nothing of y where x = 0, nor does
// a*b >= 0 say anything of b where a = 0.
#include "symbolic/functions/sign_table.hpp"

#include <algorithm>

#include "symbolic/algebra/ball_evaluator.hpp"
#include "symbolic/functions/function_factors.hpp"

namespace casimir::functions {

void SignTable::read(const Convert& convert) {
  for (const Reading reading : {Reading::first, Reading::second}) read_all(reading, convert);
  // What was learnt may tell more of the others: a*b > 0, a*c > 0 and c > 0.
  constexpr int kRounds = 3;
  for (int round = 0; round < kRounds; ++round) {
    const std::size_t before = signs_.size() + nonzero_.size();
    read_all(Reading::second, convert);
    if (signs_.size() + nonzero_.size() == before) return;
  }
}

void SignTable::read_all(Reading reading, const Convert& convert) {
  for (const Assumption& assumption : assumptions_) read_assumption(assumption, reading, convert);
  // By place, and a copy: what is converted may imply more.
  for (const auto* list : {&implied_, &products_}) {
    for (std::size_t i = 0; i < list->size(); ++i) {
      const Product implied = (*list)[i];
      read_sign(convert(implied.value), 1, reading, true, implied.strict);
    }
  }
}

bool SignTable::wants_another_build(const Implications& before, const Convert& convert) {
  const std::size_t known = implied_.size() + products_.size();
  const bool more = implied_.size() > before.signs ||
                    (known > before.signs + before.products && tell_more(convert));
  return more && known + assumptions_.size() >= 2;
}

/// Whether the products say more now that everything has been converted.
bool SignTable::tell_more(const Convert& convert) {
  const std::size_t before = signs_.size() + nonzero_.size();
  for (const Reading reading : {Reading::first, Reading::second}) {
    for (std::size_t i = 0; i < products_.size(); ++i) {
      const Product product = products_[i];
      read_sign(convert(product.value), 1, reading, true, product.strict);
    }
  }
  return signs_.size() + nonzero_.size() > before;
}

/// The first reading is of the inequalities that give the sign of a single factor, the second is of
/// those that rest on signs already known.
void SignTable::read_assumption(const Assumption& assumption, Reading reading,
                                const Convert& convert) {
  const Comparison comparison = assumption.comparison;
  if (comparison == Comparison::unequal) {
    const Polynomial difference = table_.fraction(convert(assumption.difference)).first;
    if (difference.is_zero()) return;
    for (const auto& [f, exponent] : difference.factors()) {
      if (!f.is_constant() && !known_nonzero(f)) add_nonzero(f, false);
    }
    return;
  }
  const bool positive = comparison == Comparison::greater || comparison == Comparison::at_least;
  const bool negative = comparison == Comparison::less || comparison == Comparison::at_most;
  const bool strict = comparison == Comparison::greater || comparison == Comparison::less;
  if (positive || negative)
    read_sign(convert(assumption.difference), positive ? 1 : -1, reading, false, strict);
}

/// The sign of a product of irreducible factors gives that of the only one whose own is unknown, if
/// none of the others can vanish; and those of two, where a sum of them has a known sign: G > 0 and
/// G^2 > L^2 make G - L and G + L positive.
void SignTable::read_sign(const Polynomial& p, int sign, Reading reading, bool implied,
                          bool strict) {
  const auto [top, bottom] = table_.fraction(p);
  if (top.is_zero()) return;  // 0 >= 0 says nothing
  const auto factors =
      table_.checked_product(top, bottom).factors();  // of one sign with the fraction
  std::vector<Polynomial> unknown;
  std::size_t odd = 0;
  bool others_vanish = false;
  if (cln::minusp(factors[0].first.term_list()[0].first)) sign = -sign;
  for (std::size_t k = 1; k < factors.size(); ++k) {
    const Polynomial& f = factors[k].first;
    // A product that is not zero has no factor that is; nor has a fraction with a value a
    // denominator that is.
    Polynomial quotient(table_.ring());
    if ((strict || bottom.divide(f, &quotient)) && !known_nonzero(f)) add_nonzero(f, implied);
    const int known = factors[k].second % 2 == 0 ? 1 : known_sign(f);
    if (factors[k].second % 2 == 1) ++odd;
    if (known == 0) unknown.push_back(f);
    if (known != 0 && may_vanish(f)) others_vanish = true;
    if (known < 0) sign = -sign;
  }
  if ((odd == 1) != (reading == Reading::first) || others_vanish) return;
  // That the other factors do not vanish may be implied, and with it the sign of this one.
  implied = implied || (factors.size() > 2 && rests_on_what_was_converted());
  if (unknown.size() == 1) add_sign(unknown[0], sign, implied, strict);
  if (unknown.size() != 2) return;
  // f g >= 0 and f + g >= 0 make neither negative: if f were, so would be g, and the sum.
  const Polynomial sum = unknown[0] + unknown[1].scaled(sign);  // the two have one sign
  if (sum.is_zero()) return;
  const cln::cl_RA content = sum.content();
  const int known = known_sign(sum.scaled(1 / content)) * (cln::minusp(content) ? -1 : 1);
  if (known == 0) return;
  add_sign(unknown[0], known, implied, strict);
  add_sign(unknown[1], sign * known, implied, strict);
}

void SignTable::add_sign(const Polynomial& f, int sign, bool implied, bool strict) {
  signs_.push_back({f, sign, implied, strict});
}

/// The sign that an irreducible polynomial has wherever it does not vanish, or 0.
int SignTable::known_sign(const Polynomial& p) const {
  for (const Sign& s : signs_) {
    if (s.of == p) return s.sign;
    if (s.of == -p) return -s.sign;
  }
  if (!table_.is_real_everywhere(p)) return 0;
  if (const auto sign = sign_of_number(p)) return *sign;
  return is_not_negative(p) ? 1 : is_not_negative(-p) ? -1 : 0;
}

/// Whether an irreducible polynomial is known not to vanish.
bool SignTable::known_nonzero(const Polynomial& p) const {
  if (p.is_constant()) return !p.is_zero();
  if (is_listed_nonzero(p)) return true;
  return is_nonzero_by_form(p);
}

bool SignTable::is_listed_nonzero(const Polynomial& p) const {
  const auto listed = [&](const auto& entry) { return entry.of == p || entry.of == -p; };
  return std::any_of(nonzero_.begin(), nonzero_.end(), listed) ||
         std::any_of(signs_.begin(), signs_.end(),
                     [&](const Sign& s) { return s.strict && listed(s); });
}

/// What is known at the edge: 1/sqrt(p) implies p > 0, and p may be zero where it has no value.
const SignTable& SignTable::at_edge() const {
  if (!at_edge_) {
    auto edge = std::make_shared<SignTable>(*this);
    std::erase_if(edge->nonzero_, [](const Nonzero& entry) { return entry.implied; });
    for (Sign& s : edge->signs_) s.strict = s.strict && !s.implied;
    at_edge_ = std::move(edge);
  }
  return *at_edge_;
}

bool SignTable::is_assumed_nonzero(const Polynomial& p) const { return at_edge().known_nonzero(p); }

/// Whether an irreducible polynomial vanishes nowhere by its form.
bool SignTable::is_nonzero_by_form(const Polynomial& p) const {
  if (table_.is_exponential(p)) return true;
  if (!table_.is_real_everywhere(p)) return false;
  if (const auto sign = sign_of_number(p)) return *sign != 0;
  return is_not_negative(p).value_or(false) || is_not_negative(-p).value_or(false);
}

/// The sign of a number other than zero, certified by balls; empty for what is not a number.
std::optional<int> SignTable::sign_of_number(const Polynomial& p) const {
  if (p.is_constant()) return std::nullopt;
  for (std::size_t i = 0; i < table_.symbols().size(); ++i)
    if (p.uses(i)) return std::nullopt;
  for (const std::size_t g : table_.generators_in({p})) {
    const Generator& generator = table_.generators()[g];
    const bool number = generator.kind == Kind::root || generator.kind == Kind::inverse ||
                        (generator.kind == Kind::function &&
                         (generator.order == kConstant || generator.order == kCosineOfPi));
    if (!number) return std::nullopt;
    for (std::size_t i = 0; i < table_.symbols().size(); ++i)
      if (generator.base.uses(i)) return std::nullopt;
  }
  constexpr long kBits = 256;
  try {
    BallEvaluator evaluator(BallEvaluator::Numbers::real, kBits);
    const auto sign = evaluator.sign(table_.expression(p));
    return sign && *sign != 0 ? sign : std::nullopt;
  } catch (const NotCertified&) {
    return std::nullopt;
  }
}

/// 1 where `p` is not negative anywhere, -1 where it is not positive, 0 where neither is known:
/// by the signs of its factors.
int SignTable::sign_of(const Polynomial& p) const {
  const auto [top, bottom] = table_.fraction(p);
  if (top.is_zero()) return 1;
  int sign = 1;
  for (const auto& [f, exponent] : table_.checked_product(top, bottom).factors()) {
    if (exponent % 2 == 0 && table_.is_real_everywhere(f)) continue;
    if (f.is_constant()) {
      if (cln::minusp(f.term_list()[0].first)) sign = -sign;
      continue;
    }
    sign *= known_sign(f);
  }
  return sign;
}

/// Adds what is not listed. \return whether it was not
bool SignTable::keep(std::vector<Product>& list, const GiNaC::ex& value, bool strict) {
  const bool listed = std::any_of(list.begin(), list.end(), [&](const Product& known) {
    return known.strict == strict && known.value.is_equal(value);
  });
  if (!listed) list.push_back({value, strict});
  return !listed;
}

/// Takes it that f has this sign, since a root or a logarithm is real only there.
void SignTable::imply_sign(const Polynomial& f, int sign, bool strict) {
  if (table_.is_complex() || built_) return;
  if (known_sign(f) != 0) {
    if (strict && !known_nonzero(f)) {
      add_nonzero(f, true);
      keep(implied_, sign * table_.expression(f), true);
    }
    return;
  }
  add_sign(f, sign, true, strict);
  if (!keep(implied_, sign * table_.expression(f), strict)) return;
  // What was made without knowing it may have another form now.
  for (const Generator& g : table_.generators()) {
    const bool may_change = g.kind == Kind::absolute || g.kind == Kind::root ||
                            (g.kind == Kind::function && g.order == kLogOfAbsolute);
    for (std::size_t i = 0; i < table_.ring().size() && may_change; ++i)
      if (f.uses(i) && g.base.uses(i)) throw Full{};
  }
}

/// asin(v) and acos(v) are real for -1 <= v <= 1 only. A denominator does not vanish.
void SignTable::imply_between(const Polynomial& v) {
  if (table_.is_complex()) return;
  const Polynomial one = table_.ring().constant(1);
  for (const Polynomial& side : {one - v, one + v}) {
    const auto [unreduced, bottom] = table_.fraction(side);
    const Polynomial top = table_.numerator(unreduced);
    if (!top.is_zero())
      imply_radicand(factors_of(table_, table_.checked_product(top, bottom)), false);
  }
}

/// A radicand with this denominator, in lowest terms, has no value where that vanishes. So the
/// factor is kept apart from what makes roots real: it is a condition that is printed.
void SignTable::imply_divisor(const Polynomial& bottom) {
  if (table_.is_complex() || built_) return;
  for (const auto& [f, exponent] : bottom.factors())
    if (!f.is_constant() && may_vanish(f)) divisors_.push_back(table_.expression(f));
}

bool SignTable::may_vanish(const Polynomial& f) const {
  return !known_nonzero(f) && std::none_of(divisors_.begin(), divisors_.end(), [&](const auto& d) {
    return d.is_equal(table_.expression(f)) || d.is_equal(table_.expression(-f));
  });
}

/// Of a product of which several signs are not known yet: it is read again when more is.
void SignTable::keep_product(const Factors& factors, bool strict) {
  constexpr std::size_t kMostTerms = 50;
  Polynomial product = table_.ring().constant(1);
  for (const auto& [f, exponent] : factors) {
    if (f.terms() > kMostTerms || product.terms() > kMostTerms) return;
    product = table_.checked_product(product, exponent % 2 == 1 ? f : f * f);
  }
  keep(products_, table_.expression(product), strict);
}

/// The radicand of an even root is not negative where the root is real, and that gives the sign of
/// the only factor of odd power whose sign is not known, if no other factor can vanish.
/// \param strict  it is not zero either, as what a logarithm is taken of
void SignTable::imply_radicand(const Factors& factors, bool strict) {
  if (!built_) radicands_.push_back({factors, strict});
  const Polynomial* unknown = nullptr;
  std::size_t odd = 0;
  bool others_vanish = false;
  int sign = 1;
  for (const auto& [f, exponent] : factors) {
    if (exponent % 2 == 1) {
      const int known =
          f.is_constant() ? (cln::minusp(f.term_list()[0].first) ? -1 : 1) : known_sign(f);
      if (known < 0) sign = -sign;
      if (!f.is_constant()) ++odd;
      if (known == 0 && unknown != nullptr) return keep_product(factors, strict);
      if (known == 0) {
        unknown = &f;
        continue;
      }
    }
    others_vanish = others_vanish || (!strict && may_vanish(f));
  }
  if (unknown != nullptr && !others_vanish) imply_sign(*unknown, sign, strict);
  if (unknown == nullptr && strict && odd == 1) {
    for (const auto& [f, exponent] : factors)
      if (!f.is_constant() && exponent % 2 == 1) imply_sign(f, known_sign(f), strict);
  }
}

bool SignTable::is_nowhere_zero(const Polynomial& p) const {
  if (p.is_zero()) return false;
  // Where nothing is assumed, a polynomial in the symbols without constant term is zero at zero.
  if (table_.generators().empty() && signs_.empty() && nonzero_.empty() &&
      cln::zerop(p.evaluate(std::vector<cln::cl_RA>(table_.ring().size()))))
    return false;
  const auto factors = p.factors();
  return std::all_of(factors.begin(), factors.end(),
                     [&](const auto& factor) { return known_nonzero(factor.first); });
}

bool SignTable::rests_on_what_was_converted() const {
  return !implied_.empty() || !products_.empty() || !divisors_.empty();
}

bool SignTable::is_assumed_positive(const Polynomial& p) const {
  int sign = 1;
  for (const auto& [f, exponent] : p.factors()) {
    if (f.is_constant()) {
      if (cln::minusp(f.term_list()[0].first)) sign = -sign;
      continue;
    }
    if (table_.is_exponential(f)) continue;
    const auto found = std::find_if(signs_.begin(), signs_.end(), [&f = f](const Sign& s) {
      return !s.implied && s.strict && (s.of == f || s.of == -f);
    });
    if (found == signs_.end() && !(known_sign(f) != 0 && is_sum_of_squares(f) && known_nonzero(f)))
      return false;
    if (known_sign(f) < 0 && exponent % 2 == 1) sign = -sign;
  }
  return sign > 0;
}

}  // namespace casimir::functions
