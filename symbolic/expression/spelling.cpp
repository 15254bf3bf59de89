#include "symbolic/expression/spelling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <iterator>
#include <span>
#include <unordered_set>

#include "symbolic/error.hpp"
#include "symbolic/expression/elementary.hpp"
#include "symbolic/expression/elliptic.hpp"

namespace casimir {
namespace {

struct Spelling {
  std::string_view elsewhere, here;
};

/// One name for another.
constexpr Spelling kNames[] = {
    {"Log", "log"},   {"PI", "Pi"},   {"M_PI", "Pi"},     {"arctg", "atan"},    {"tg", "tan"},
    {"sh", "sinh"},   {"ch", "cosh"}, {"th", "tanh"},     {"ctg", "cot"},       {"sgn", "sign"},
    {"fabs", "abs"},  {"Abs", "abs"}, {"signum", "sign"}, {"arctan2", "atan2"}, {"Sqrt", "sqrt"},
    {"root", "sqrt"}, {"D", "diff"},  {"dt", "rate"},
};

/// What has no name here.
constexpr Spelling kForms[] = {
    {"e", "e is written exp(1)"},
    {"pow", "pow(x, y) is written x^y"},
    {"sqr", "sqr(x) is written x^2"},
    {"cbrt", "cbrt(x) is written x^(1/3) for x > 0"},
    {"coth", "coth(x) is written 1/tanh(x)"},
    {"asinh", "asinh(x) is written log(x + sqrt(x^2 + 1))"},
    {"arsinh", "arsinh(x) is written log(x + sqrt(x^2 + 1))"},
    {"acosh", "acosh(x) is written log(x + sqrt(x^2 - 1))"},
    {"arcosh", "arcosh(x) is written log(x + sqrt(x^2 - 1))"},
    {"atanh", "atanh(x) is written log((1 + x)/(1 - x))/2"},
    {"artanh", "artanh(x) is written log((1 + x)/(1 - x))/2"},
    {"sec", "sec(x) is written 1/cos(x)"},
    {"csc", "csc(x) is written 1/sin(x)"},
    {"log10", "log10(x) is written log(x)/log(10)"},
    {"log2", "log2(x) is written log(x)/log(2)"},
};

constexpr Spelling kCharacters[] = {
    {"π", "Pi"},      {"·", "*"},      {"×", "*"},     {"⋅", "*"},       {"∗", "*"},
    {"−", "-"},       {"–", "-"},      {"—", "-"},     {"÷", "/"},       {"∕", "/"},
    {"²", "^2"},      {"³", "^3"},     {"⁴", "^4"},    {"½", "1/2"},     {"¼", "1/4"},
    {"√", "sqrt(x)"}, {"≠", "!="},     {"≤", "<="},    {"≥", ">="},      {"α", "alpha"},
    {"β", "beta"},    {"γ", "gamma"},  {"δ", "delta"}, {"ε", "epsilon"}, {"θ", "theta"},
    {"κ", "kappa"},   {"λ", "lambda"}, {"μ", "mu"},    {"ν", "nu"},      {"ρ", "rho"},
    {"σ", "sigma"},   {"τ", "tau"},    {"φ", "phi"},   {"χ", "chi"},     {"ψ", "psi"},
    {"ω", "omega"},   {"Ω", "Omega"},  {"“", "\""},    {"”", "\""},
};

std::string_view found_in(std::span<const Spelling> table, std::string_view word) {
  const auto it =
      std::ranges::find_if(table, [&](const Spelling& entry) { return entry.elsewhere == word; });
  return it == table.end() ? std::string_view{} : it->here;
}

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }

}  // namespace

std::string spelling_of_name(std::string_view name) {
  if (const std::string_view ours = found_in(kNames, name); !ours.empty())
    return fmt::format("did you mean '{}'?", ours);
  return std::string(found_in(kForms, name));
}

std::string spelling_of_character(std::string_view character) {
  const std::string_view ours = found_in(kCharacters, character);
  return ours.empty() ? std::string{} : fmt::format("'{}' is written {}", character, ours);
}

std::string spelling_of_sign(std::string_view text, std::size_t at) {
  const auto is_digit_at = [&](std::size_t i) {
    return i < text.size() && std::isdigit(static_cast<unsigned char>(text[i])) != 0;
  };
  switch (at < text.size() ? text[at] : '\0') {
    case '!':
      if (at + 1 >= text.size() || text[at + 1] != '=')
        return "there are no factorials: 5! is written 120, and x! has no name here";
      [[fallthrough]];
    case '<':
    case '>':
      return "an expression stands here and no condition: conditions stand in 'assume' and "
             "'domain'";
    case '=':
      return "an expression stands here and no equation: A = B is the zero level of A - (B)";
    case '[':
    case ']':
      return "only round parentheses group, as in 2*(x + y)";
    case '|':
      return "|x| is written abs(x)";
    case ',': {
      if (at == 0 || !is_digit_at(at - 1) || !is_digit_at(at + 1)) return {};
      std::size_t from = at, to = at + 1;
      while (from > 0 && is_digit_at(from - 1)) --from;
      while (is_digit_at(to)) ++to;
      return fmt::format("decimals have a point: {}.{}", text.substr(from, at - from),
                         text.substr(at + 1, to - at - 1));
    }
    default:
      return {};
  }
}

std::string spelling_of_escape(std::string_view value, std::string_view written) {
  if (value.find('\\') != std::string_view::npos) return {};
  for (std::size_t at = written.find('\\'); at < written.size(); at = written.find('\\', at + 1)) {
    const auto begin = written.begin() + static_cast<std::ptrdiff_t>(at) + 1;
    const auto end = std::find_if_not(begin, written.end(), is_letter);
    constexpr std::ptrdiff_t kLongest = 30;
    if (end - begin >= 2 && end - begin <= kLongest)
      return fmt::format(
          "between double quotes a backslash begins an escape of TOML: write '..\\{}..' between "
          "single ones",
          std::string_view(begin, end));
  }
  return {};
}

std::string product_of_names(const std::string& word, const std::vector<std::string>& known) {
  const std::unordered_set<std::string> names(known.begin(), known.end());
  // The products that the beginnings of the word are; empty: none.
  std::vector<std::string> product(word.size() + 1);
  for (std::size_t end = 1; end <= word.size(); ++end) {
    for (std::size_t begin = 0; begin < end && product[end].empty(); ++begin) {
      if (begin > 0 && product[begin].empty()) continue;
      const std::string name = word.substr(begin, end - begin);
      if (names.contains(name)) product[end] = begin == 0 ? name : product[begin] + "*" + name;
    }
  }
  const std::string& whole = product.back();
  return whole.find('*') == std::string::npos ? std::string{}
                                              : fmt::format("did you mean '{}'?", whole);
}

std::string hint_for_function(const std::string& word) {
  std::vector<std::string> functions = elementary_function_names();
  for (std::string& name : elliptic_function_names()) functions.push_back(std::move(name));
  functions.insert(functions.end(), {"diff", "rate"});
  const std::string hint = spelling_of_name(word);
  return hint.empty() ? suggest_or_list(word, functions, "functions") : hint;
}

std::string hint_for_name(const std::string& word, std::vector<std::string> known) {
  const bool constant = known.empty();
  known.emplace_back("Pi");
  std::string hint = same_but_for_case(word, known);
  if (hint.empty()) hint = spelling_of_name(word);
  if (hint.empty()) hint = product_of_names(word, known);
  if (!hint.empty()) return hint;
  if (constant) return "a constant stands here: numbers, Pi and functions of them";
  hint = suggest(word, known);
  return hint.empty() ? fmt::format("{}; a parameter is declared in [parameters], as {} = {{}}",
                                    suggest_or_list(word, known, "declared"), printable(word))
                      : hint;
}

}  // namespace casimir
