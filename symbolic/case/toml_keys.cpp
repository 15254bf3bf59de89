#include "symbolic/case/toml_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "symbolic/error.hpp"

namespace casimir {
namespace {

constexpr int kMostPartsOfKey = 30;

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

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = std::min(text.find_first_not_of(" \t\r"), text.size());
  return text.substr(begin, text.find_last_not_of(" \t\r") + 1 - begin);
}

/// Those of the root keys that are no tables.
constexpr std::string_view kRootValues[] = {"title",       "source",     "book",
                                            "tags",        "integrable", "superintegrable",
                                            "hamiltonian", "lagrangian", "map_sign"};

}  // namespace

const std::vector<std::string>& root_keys() {
  static const std::vector<std::string> keys = {
      "title",       "source",     "book",        "tags",        "integrable",
      "hamiltonian", "lagrangian", "phase_space", "parameters",  "definitions",
      "casimirs",    "integrals",  "equations",   "conditional", "invariant_relation",
      "lax",         "map",        "measure",     "identity",    "section",
      "scene",       "map_sign",   "map_step",    "symmetry",    "superintegrable",
      "functions",   "conjugacy"};
  return keys;
}

std::string root_key_hint(std::string_view key) {
  if (std::ranges::count(kRootValues, key) != 0)
    return fmt::format("'{}' belongs to the whole file: it stands above the first [table]", key);
  if (std::ranges::count(root_keys(), key) == 0) return {};
  return fmt::format("'{}' is a table of its own, beside this one and not in it", key);
}

std::string unquoted_hint(std::string_view line, std::size_t column) {
  // The value that the column is in or behind: since the last mark that ends one.
  std::size_t begin = 0;
  std::string_view key;
  for (std::size_t i = 0; i < std::min(column, line.size());) {
    const char c = line[i];
    if (c == '#') return {};
    if (c == '"' || c == '\'') {
      i = end_of_string(line, i);
      continue;
    }
    ++i;
    if (c == '=') key = trimmed(line.substr(begin, i - 1 - begin));
    if (std::string_view("=,[{").find(c) != std::string_view::npos) begin = i;
    if (c == '[' || c == '{') key = {};
  }
  if (begin == 0) return {};
  const std::string_view rest = line.substr(begin);
  int depth = 0;  // of parentheses: atan2(M1, M2) has a comma
  std::size_t end = 0;
  for (; end < rest.size() && rest[end] != '#' && rest[end] != '"'; ++end) {
    depth += rest[end] == '(' ? 1 : rest[end] == ')' ? -1 : 0;
    if (depth <= 0 && std::string_view(",]}").find(rest[end]) != std::string_view::npos) break;
  }
  const std::string_view value = trimmed(rest.substr(0, end));
  if (value.empty() || value.find_first_of("'=[{") != std::string_view::npos) return {};
  if (end < rest.size() && rest[end] == '"') return {};
  const std::string quoted = fmt::format("\"{}\"", printable(std::string(value)));
  return "strings and expressions stand in quotes: " +
         (key.empty() ? quoted : fmt::format("{} = {}", printable(std::string(key)), quoted));
}

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
    if (c == '.' && ++dots >= kMostPartsOfKey) return line;
    if (c == '\n') ++line;
    if (std::string_view("\n=,[]{}").find(c) != std::string_view::npos) dots = 0;
    ++i;
  }
  return std::nullopt;
}

}  // namespace casimir
