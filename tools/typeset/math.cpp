#include "tools/typeset/math.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace casimir::tools::typeset {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// A part of a name: a Greek letter, one letter, a word set upright, or a number.
Math part_of_name(const std::string& part) {
  if (!part.empty() && is_digit(part[0])) return number(part);
  return {part.size() <= 1 || is_greek(part) ? Kind::letter : Kind::word, part};
}

}  // namespace

bool is_greek(std::string_view text) {
  static constexpr std::array kGreek = std::to_array<std::string_view>(
      {"alpha", "beta",    "gamma",  "delta", "epsilon", "zeta",  "eta",   "theta",
       "iota",  "kappa",   "lambda", "mu",    "nu",      "xi",    "rho",   "sigma",
       "tau",   "upsilon", "phi",    "chi",   "psi",     "omega", "Gamma", "Delta",
       "Theta", "Lambda",  "Xi",     "Sigma", "Upsilon", "Phi",   "Psi",   "Omega"});
  return std::ranges::find(kGreek, text) != kGreek.end();
}

Math letter(std::string_view name) { return {Kind::letter, std::string(name)}; }
Math symbol(std::string_view name) { return {Kind::symbol, std::string(name)}; }
Math number(std::string_view digits) { return {Kind::number, std::string(digits)}; }
Math prose(std::string_view words) { return {Kind::prose, std::string(words)}; }

Math product(std::vector<Math> factors) {
  if (factors.size() == 1) return std::move(factors.front());
  return {Kind::product, {}, std::move(factors)};
}

Math list(std::vector<Math> parts) { return {Kind::list, {}, std::move(parts)}; }

Math fraction(Math above, Math below) {
  return {Kind::fraction, {}, {std::move(above), std::move(below)}};
}

Math in_brackets(Math inside) { return {Kind::brackets, {}, {std::move(inside)}}; }

Math with_index(Math base, Math index) {
  return {Kind::scripts, {}, {std::move(base), std::move(index), {}}};
}

Math with_power(Math base, Math power) {
  if (base.kind == Kind::scripts && base.parts[2].empty()) {
    base.parts[2] = std::move(power);
    return base;
  }
  return {Kind::scripts, {}, {std::move(base), {}, std::move(power)}};
}

Math negated(Math term) { return {Kind::sum, {}, {std::move(term)}, {true}}; }

void add_term(Math& sum, Math term) {
  if (sum.kind != Kind::sum)
    sum = sum.empty() ? Math{Kind::sum} : Math{Kind::sum, {}, {sum}, {false}};
  if (term.kind != Kind::sum) term = {Kind::sum, {}, {std::move(term)}, {false}};
  for (std::size_t i = 0; i < term.parts.size(); ++i) {
    sum.parts.push_back(std::move(term.parts[i]));
    sum.negative.push_back(term.negative[i]);
  }
}

Math rate(const Math& letter) {
  if (letter.kind != Kind::scripts) return {Kind::dotted, {}, {letter}};
  Math result = letter;
  result.parts[0] = {Kind::dotted, {}, {letter.parts[0]}};
  return result;
}

double width(const Math& formula) {
  constexpr double kSmall = 0.7, kSign = 2;
  std::vector<double> parts;
  double all = 0;
  for (const Math& part : formula.parts) all += parts.emplace_back(width(part));
  const auto count = static_cast<double>(parts.size());
  switch (formula.kind) {
    case Kind::letter:
      return is_greek(formula.text) ? 1 : static_cast<double>(formula.text.size());
    case Kind::symbol:
      return 1;
    case Kind::word:
    case Kind::number:
    case Kind::prose:
      return static_cast<double>(formula.text.size());
    case Kind::sum:
      return all + kSign * (count - 1) + (formula.negative.front() ? 1 : 0);
    case Kind::list:
    case Kind::cross:
      return all + count - 1;
    case Kind::fraction:
      return std::ranges::max(parts);
    case Kind::scripts:
      return parts[0] + kSmall * std::max(parts[1], parts[2]);
    case Kind::call:
      return static_cast<double>(formula.text.size()) + 2 + all;
    case Kind::root:
    case Kind::brackets:
    case Kind::tuple:
    case Kind::poisson:
      return all + 2;
    default:
      return all;
  }
}

std::vector<Math> lines_of(const Math& formula, double letters) {
  if (formula.kind != Kind::sum || width(formula) <= letters) return {formula};
  std::vector<Math> lines;
  double filled = 0;
  for (std::size_t i = 0; i < formula.parts.size(); ++i) {
    constexpr double kSign = 2;
    const double more = width(formula.parts[i]) + kSign;
    if (lines.empty() || filled + more > letters) {
      lines.push_back({Kind::sum});
      filled = 0;
    }
    lines.back().parts.push_back(formula.parts[i]);
    lines.back().negative.push_back(formula.negative[i]);
    filled += more;
  }
  return lines;
}

Math name(std::string_view name) {
  std::vector<std::string> parts(1);
  for (const char c : name) {
    if (c == '_' || (!parts.back().empty() && is_digit(c) != is_digit(parts.back().back())))
      parts.emplace_back();
    if (c != '_') parts.back() += c;
  }
  std::vector<Math> index;
  for (std::size_t i = 1; i < parts.size(); ++i) {
    if (!parts[i].empty()) index.push_back(part_of_name(parts[i]));
  }
  Math head = part_of_name(parts[0]);
  return index.empty() ? head : with_index(std::move(head), product(std::move(index)));
}

}  // namespace casimir::tools::typeset
