#include "tools/typeset/printed_names.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace casimir::tools {
namespace {

using Pair = std::pair<std::string_view, std::string_view>;

constexpr auto kGreekNames = std::to_array<Pair>(
    {{"alpha", "α"},  {"beta", "β"},  {"gamma", "γ"}, {"delta", "δ"}, {"epsilon", "ε"},
     {"zeta", "ζ"},   {"eta", "η"},   {"theta", "θ"}, {"iota", "ι"},  {"kappa", "κ"},
     {"lambda", "λ"}, {"mu", "μ"},    {"nu", "ν"},    {"xi", "ξ"},    {"pi", "π"},
     {"rho", "ρ"},    {"sigma", "σ"}, {"tau", "τ"},   {"phi", "φ"},   {"chi", "χ"},
     {"psi", "ψ"},    {"omega", "ω"}, {"Gamma", "Γ"}, {"Delta", "Δ"}, {"Theta", "Θ"},
     {"Lambda", "Λ"}, {"Xi", "Ξ"},    {"Pi", "π"},    {"Sigma", "Σ"}, {"Phi", "Φ"},
     {"Psi", "Ψ"},    {"Omega", "Ω"}});

constexpr std::array<std::string_view, 10> kLowered = {"₀", "₁", "₂", "₃", "₄",
                                                       "₅", "₆", "₇", "₈", "₉"};

/// What LaTeX calls it, in mathematics.
constexpr auto kMathematics =
    std::to_array<Pair>({{"·", "\\cdot "}, {"×", "\\times "}, {"−", "-"}});

/// Characters that mean something to LaTeX, as it prints them.
constexpr auto kSpecial =
    std::to_array<std::pair<char, std::string_view>>({{'\\', "\\textbackslash{}"},
                                                      {'{', "\\{"},
                                                      {'}', "\\}"},
                                                      {'$', "\\$"},
                                                      {'&', "\\&"},
                                                      {'#', "\\#"},
                                                      {'%', "\\%"},
                                                      {'_', "\\_"},
                                                      {'^', "\\textasciicircum{}"},
                                                      {'~', "\\textasciitilde{}"},
                                                      {'<', "\\ensuremath{<}"},
                                                      {'>', "\\ensuremath{>}"},
                                                      {'|', "\\ensuremath{|}"}});

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// A name such as M1 or theta with its digits lowered and Greek letters as such.
std::string printed_name(std::string_view name) {
  const std::size_t letters = static_cast<std::size_t>(
      std::find_if_not(name.begin(), name.end(), is_letter) - name.begin());
  const std::string_view digits = name.substr(letters);
  if (!std::ranges::all_of(digits, is_digit)) return std::string(name);
  std::string result(name.substr(0, letters));
  const auto greek = std::ranges::find(kGreekNames, std::string_view(result), &Pair::first);
  if (greek != kGreekNames.end()) result = greek->second;
  for (const char digit : digits) result += kLowered.at(static_cast<std::size_t>(digit - '0'));
  return result;
}

/// Which of the texts stands at this place: its index, or -1.
template <class Texts>
int at_place(const Texts& texts, const std::string& text, std::size_t place) {
  for (std::size_t i = 0; i < texts.size(); ++i)
    if (std::string_view(text).substr(place).starts_with(texts[i])) return static_cast<int>(i);
  return -1;
}

std::size_t length_of_character(unsigned char first) {
  return first < 0x80 ? 1 : first < 0xe0 ? 2 : first < 0xf0 ? 3 : 4;
}

/// The Greek letter at this place as LaTeX has it, and how long it is; or nothing.
Pair greek_at(const std::string& text, std::size_t place) {
  for (const auto& [name, letter] : kGreekNames)
    if (std::string_view(text).substr(place).starts_with(letter) && name != "Pi")
      return {name, letter};
  return {};
}

/// The digits that are lowered from this place on, as ordinary ones; moves `place` behind them.
std::string lowered_digits(const std::string& text, std::size_t& place) {
  std::string digits;
  for (int digit = at_place(kLowered, text, place); digit >= 0;
       digit = at_place(kLowered, text, place)) {
    digits += static_cast<char>('0' + digit);
    place += kLowered[static_cast<std::size_t>(digit)].size();
  }
  return digits;
}

std::string with_index(const std::string& letter, const std::string& digits) {
  return "$" + letter + (digits.empty() ? "" : "_{" + digits + "}") + "$";
}

}  // namespace

std::string printed_names(const std::string& expression) {
  std::string result;
  for (std::size_t at = 0; at < expression.size();) {
    const char c = expression[at];
    if (c == '*') {
      result += "·";
      ++at;
      continue;
    }
    const auto in_name = [](char d) { return is_letter(d) || is_digit(d) || d == '_'; };
    const auto end = static_cast<std::size_t>(
        std::find_if_not(expression.begin() + static_cast<std::ptrdiff_t>(at), expression.end(),
                         in_name) -
        expression.begin());
    if (end == at) {
      result += c;
      ++at;
      continue;
    }
    const std::string name = expression.substr(at, end - at);
    const bool function = end < expression.size() && expression[end] == '(';
    result += function || !is_letter(c) ? name : printed_name(name);
    at = end;
  }
  return result;
}

std::string latex_text(const std::string& text) {
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    if (const auto [name, letter] = greek_at(text, at); !name.empty()) {
      at += letter.size();
      result += with_index("\\" + std::string(name), lowered_digits(text, at));
      continue;
    }
    const auto special =
        std::ranges::find(kSpecial, text[at], &std::pair<char, std::string_view>::first);
    if (special != kSpecial.end()) {
      result += special->second;
      ++at;
      continue;
    }
    const std::size_t length = length_of_character(static_cast<unsigned char>(text[at]));
    if (length > 1) {
      const auto known = std::ranges::find_if(kMathematics, [&](const Pair& one) {
        return std::string_view(text).substr(at).starts_with(one.first);
      });
      if (known != kMathematics.end())
        result += "$" + std::string(known->second) + "$";
      else
        result += text.substr(at, length);
      at += length;
      continue;
    }
    // Letters with an index are a symbol.
    std::size_t end = at;
    while (end < text.size() && is_letter(text[end])) ++end;
    if (end > at && at_place(kLowered, text, end) >= 0) {
      const std::string letters = text.substr(at, end - at);
      at = end;
      result += with_index(letters.size() > 1 ? "\\mathit{" + letters + "}" : letters,
                           lowered_digits(text, at));
      continue;
    }
    end = std::max(end, at + 1);
    result += text.substr(at, end - at);
    at = end;
  }
  return result;
}

}  // namespace casimir::tools
