#include "symbolic/toml_keys.hpp"

#include <string_view>

namespace casimir {
namespace {

constexpr int kMostParts = 30;

/// The end of the string that starts at `at`, which is a quotation mark; that of the text where it
/// is not closed.
std::size_t end_of_string(std::string_view text, std::size_t at) {
  const char quote = text[at];
  const bool escapes = quote == '"';
  const bool long_string = text.substr(at, 3) == std::string(3, quote);
  std::size_t i = at + (long_string ? 3 : 1);
  for (; i < text.size(); ++i) {
    if (escapes && text[i] == '\\') {
      ++i;
    } else if (!long_string && (text[i] == quote || text[i] == '\n')) {
      return i + 1;
    } else if (long_string && text.substr(i, 3) == std::string(3, quote)) {
      i += 3;
      while (i < text.size() && text[i] == quote) ++i;  // up to two more belong to the string
      return i;
    }
  }
  return text.size();
}

}  // namespace

std::optional<int> line_of_deep_key(const std::string& toml) {
  const std::string_view text = toml;
  int line = 1;
  int dots = 0;
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    if (c == '"' || c == '\'') {
      const std::size_t end = end_of_string(text, i);
      for (; i < end; ++i) line += text[i] == '\n' ? 1 : 0;
      continue;
    }
    if (c == '#') {
      while (i < text.size() && text[i] != '\n') ++i;
      continue;
    }
    if (c == '.' && ++dots >= kMostParts) return line;
    if (c == '\n') ++line;
    if (std::string_view("\n=,[]{}").find(c) != std::string_view::npos) dots = 0;
    ++i;
  }
  return std::nullopt;
}

}  // namespace casimir
