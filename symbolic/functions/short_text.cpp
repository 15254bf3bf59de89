#include "symbolic/functions/short_text.hpp"

#include <cln/integer.h>
#include <cln/rational.h>
#include <cln/rational_io.h>
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

namespace casimir::search {
namespace {

using Exponents = std::vector<unsigned long>;

Polynomial monomial(const PolynomialRing& ring, const cln::cl_RA& number,
                    const Exponents& exponents) {
  Polynomial result = ring.constant(number);
  for (std::size_t i = 0; i < exponents.size(); ++i)
    if (exponents[i] > 0) result *= ring.variable(i).pow(exponents[i]);
  return result;
}

/// The root of a monomial without its number; empty where an exponent is odd.
std::optional<Exponents> root_of(Exponents exponents) {
  for (unsigned long& e : exponents) {
    if (e % 2 != 0) return std::nullopt;
    e /= 2;
  }
  return exponents;
}

/// The length, and more for brackets within brackets.
std::size_t cost(const std::string& text) {
  constexpr std::size_t kNested = 15;
  std::size_t depth = 0, deepest = 1;
  for (const char c : text) {
    if (c == '(') deepest = std::max(deepest, ++depth);
    if (c == ')') --depth;
  }
  return text.size() + kNested * (deepest - 1);
}

class Writer {
 public:
  Writer(const FunctionRing& ring, const std::vector<bool>& constant)
      : ring_(ring), constant_(constant) {}

  /// \param splits  how many squares and products may be split off
  std::string shortest(const Polynomial& p, int splits) const {
    std::string best = product(p);
    if (splits == 0 || p.terms() < kFewestTerms || p.terms() > kMostTerms) return best;
    const auto take = [&best](const std::string& text) {
      if (!text.empty() && cost(text) < cost(best)) best = text;
    };
    for (const auto& [number, exponents] : p.term_list())
      take(with_square(p, number, exponents, splits));
    for (std::size_t i = 0; i < constant_.size(); ++i)
      if (!constant_[i] && p.uses(i)) take(with_factor(p, i, splits));
    return best;
  }

 private:
  static constexpr std::size_t kFewestTerms = 3, kMostTerms = 24;

  std::string product(const Polynomial& p) const;
  std::string sum(const Polynomial& p) const;
  std::string with_square(const Polynomial& p, const cln::cl_RA& number, const Exponents& exponents,
                          int splits) const;
  std::string with_factor(const Polynomial& p, std::size_t place, int splits) const;
  bool in_variables(const Polynomial& p) const {
    for (std::size_t i = 0; i < constant_.size(); ++i)
      if (!constant_[i] && p.uses(i)) return true;
    return false;
  }
  bool is_sum(const Polynomial& p) const { return p.terms() > 1; }
  std::string bracketed(const Polynomial& p) const {
    return is_sum(p) ? "(" + sum(p) + ")" : sum(p);
  }
  static void append(std::string& sum, const std::string& term) {
    if (sum.empty())
      sum = term;
    else
      sum += term.starts_with('-') ? " - " + term.substr(1) : " + " + term;
  }

  const FunctionRing& ring_;
  const std::vector<bool>& constant_;
};

std::string Writer::product(const Polynomial& p) const {
  const auto factors = p.factors();  // the number first
  if (factors.size() == 2 && factors[1].second == 1) return sum(p);
  std::string result;
  bool negative = false;
  for (const auto& [factor, exponent] : factors) {
    // The ring knows how a root is written under a power.
    std::string text = is_sum(factor) ? bracketed(factor) : ring_.text(factor.pow(exponent));
    if (factor.is_constant()) {
      negative = text.starts_with('-');
      if (negative) text = text.substr(1);
      if (text == "1") continue;
    }
    if (exponent > 1 && is_sum(factor)) text += fmt::format("^{}", exponent);
    result += (result.empty() ? "" : "*") + text;
  }
  if (result.empty()) result = "1";
  return negative ? fmt::format("-{}", result) : result;
}

/// The coefficients in the parameters are collected, and factored.
std::string Writer::sum(const Polynomial& p) const {
  std::vector<Exponents> order;
  std::map<Exponents, Polynomial> coefficients;
  for (const auto& [number, exponents] : p.term_list()) {
    Exponents own = exponents, parameters = exponents;
    for (std::size_t i = 0; i < exponents.size(); ++i) (constant_[i] ? own : parameters)[i] = 0;
    const auto [place, fresh] = coefficients.try_emplace(own, Polynomial(p.ring()));
    if (fresh) order.push_back(own);
    place->second += monomial(p.ring(), number, parameters);
  }
  std::string result;
  for (const Exponents& exponents : order) {
    const Polynomial& coefficient = coefficients.at(exponents);
    const Polynomial powers = monomial(p.ring(), 1, exponents);
    if (!is_sum(coefficient) || powers.is_constant()) {
      append(result, ring_.text(coefficient * powers));
      continue;
    }
    const bool opposite = ring_.text(coefficient).starts_with('-');
    const Polynomial size = opposite ? -coefficient : coefficient;
    const auto factors = size.factors();
    const bool alone = factors.size() == 2 && factors[1].second == 1;
    append(result, fmt::format("{}{}*{}", opposite ? "-" : "",
                               alone ? bracketed(size) : product(size), ring_.text(powers)));
  }
  return result.empty() ? "0" : result;
}

/// p = d*(e*m + ..)^2 + rest, where d*e^2*m^2 is the given term, and the square takes with it all
/// terms that m divides but m^2 does not; empty where there is no such square, or where it leaves
/// as many terms.
std::string Writer::with_square(const Polynomial& p, const cln::cl_RA& number,
                                const Exponents& exponents, int splits) const {
  const std::optional<Exponents> root = root_of(exponents);
  if (!root) return "";
  const PolynomialRing& ring = p.ring();
  const Polynomial first = monomial(ring, 1, *root);
  Polynomial with_first(ring);
  for (const auto& [other, powers] : p.term_list()) {
    const Polynomial term = monomial(ring, other, powers);
    Polynomial quotient(ring);
    if (powers != exponents && term.divide(first, &quotient)) with_first += quotient;
  }
  if (!in_variables(with_first)) return "";
  Polynomial base = first + with_first.scaled(1 / (2 * number));
  cln::cl_RA factor = number;
  const cln::cl_RA content = base.content();
  base = base.scaled(1 / content);
  factor = factor * content * content;
  const Polynomial rest = p - (base * base).scaled(factor);
  if (rest.terms() >= p.terms()) return "";
  std::string square = bracketed(base) + "^2";
  const std::string size = ring_.text(ring.constant(cln::abs(factor)));
  if (size != "1") square = size + "*" + square;
  if (cln::minusp(factor)) square = "-" + square;
  if (rest.is_zero()) return square;
  std::string result = shortest(rest, splits - 1);
  append(result, square);
  return result;
}

/// p = v*q + rest, where rest has no v.
std::string Writer::with_factor(const Polynomial& p, std::size_t place, int splits) const {
  const Polynomial rest = p.coefficients(place)[0];
  if (rest.is_zero() || !is_sum(p - rest)) return "";
  std::string result = product(p - rest);
  append(result, shortest(rest, splits - 1));
  return result;
}

}  // namespace

std::string short_text(const FunctionRing& ring, const Polynomial& p,
                       const std::vector<bool>& constant) {
  constexpr int kSplits = 2;
  const Writer writer(ring, constant);
  const std::string text = writer.shortest(p, kSplits);
  if (!text.starts_with('-')) return text;
  const std::string opposite = writer.shortest(-p, kSplits);
  return opposite.starts_with('-') || cost(opposite) > cost(text) ? text : opposite;
}

}  // namespace casimir::search
