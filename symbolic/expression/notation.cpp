#include "symbolic/expression/notation.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

#include "symbolic/expression/expression.hpp"
#include "symbolic/expression/name_characters.hpp"

namespace casimir {

std::string_view latex_command(std::string_view text, std::size_t at) {
  if (at >= text.size() || text[at] != '\\') return {};
  std::size_t end = at + 1;
  while (end < text.size() && std::isalpha(static_cast<unsigned char>(text[end])) != 0) ++end;
  return text.substr(at + 1, end - at - 1);
}

std::size_t latex_space(std::string_view text, std::size_t at) {
  const std::string_view command = latex_command(text, at);
  for (const std::string_view space : {"quad", "left", "right"})
    if (command == space) return 1 + command.size();
  const bool sign = command.empty() && at + 1 < text.size() && text[at] == '\\' &&
                    std::string_view(",;:!").find(text[at + 1]) != std::string_view::npos;
  return sign ? 2 : 0;
}

std::string usual_name(const std::string& word) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 5> kUsual = {
      {{"ln", "log"}, {"arcsin", "asin"}, {"arccos", "acos"}, {"arctan", "atan"}, {"pi", "Pi"}}};
  const auto it = std::find_if(kUsual.begin(), kUsual.end(),
                               [&](const auto& pair) { return pair.first == word; });
  return it == kUsual.end() ? word : std::string(it->second);
}

const Quantity* find_with_subscript(const std::string& word, Scope& names) {
  const std::size_t at = word.rfind('_');
  if (at == std::string::npos || at == 0 || at + 1 == word.size()) return nullptr;
  return names.find(word.substr(0, at) + word.substr(at + 1));
}

std::string read_name(const std::string& text, std::size_t& at, std::size_t end) {
  const std::size_t start = at;
  while (at < end && is_name_part(text[at])) ++at;
  std::string result = text.substr(start, at - start);
  if (result.back() != '_' || at >= end || text[at] != '{') return result;
  std::size_t close = at + 1;
  while (close < end && is_name_part(text[close])) ++close;
  if (close >= end || text[close] != '}' || close == at + 1) return result;
  result += text.substr(at + 1, close - at - 1);
  at = close + 1;
  return result;
}

std::string utf8_character(const std::string& text, std::size_t at, std::size_t end) {
  std::size_t length = 1;
  while (at + length < end && (static_cast<unsigned char>(text[at + length]) & 0xC0) == 0x80)
    ++length;
  return text.substr(at, length);
}

}  // namespace casimir
