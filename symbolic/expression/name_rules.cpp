// The names that expressions may use.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string_view>

#include "symbolic/expression/cpp_keywords.hpp"
#include "symbolic/expression/elementary.hpp"
#include "symbolic/expression/expression.hpp"
#include "symbolic/expression/name_characters.hpp"

namespace casimir {

const Quantity* NameTable::find(const std::string& name) {
  const auto it = table_.find(name);
  return it == table_.end() ? nullptr : &it->second;
}

std::vector<std::string> NameTable::known() const {
  std::vector<std::string> names;
  for (const auto& [name, quantity] : table_) names.push_back(name);
  return names;
}

std::size_t symbol_position(const Text& text, const std::string& name, std::size_t offset,
                            const std::vector<GiNaC::symbol>& symbols, const std::string& what) {
  std::vector<std::string> known;
  for (std::size_t i = 0; i < symbols.size(); ++i) {
    if (symbols[i].get_name() == name) return i;
    known.push_back(symbols[i].get_name());
  }
  throw text.error(fmt::format("'{}' is not {}", printable(name), what), offset,
                   suggest_or_list(name, known));
}

void check_name(const Text& name, const std::string& what) {
  const std::string& s = name.value;
  const std::string shown = printable(s);
  if (s.empty() || !is_name_start(s[0]) || !std::all_of(s.begin(), s.end(), is_name_part)) {
    throw name.error(fmt::format("'{}' cannot name {}", shown, what), 0,
                     "a name is an ASCII letter or '_', then letters, digits and '_'");
  }
  if (s.size() > kMaxNameLength) {
    throw name.error(
        fmt::format("the name '{}' is longer than {} characters", shown, kMaxNameLength));
  }
  if (find_elementary_function(s) != nullptr || s == "Pi" || s == "I") {
    throw name.error(fmt::format("'{}' is a function or constant and cannot name {}", s, what));
  }
  if (std::ranges::count(kCppKeywords, s) != 0) {
    throw name.error(fmt::format("'{}' is a C++ keyword and cannot name {}", s, what));
  }
}

}  // namespace casimir
