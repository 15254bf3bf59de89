#pragma once

// For what reads case files alone: no other file needs to know the TOML library.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#define TOML_EXCEPTIONS 1
#include <toml++/toml.h>

#include "symbolic/case/limits.hpp"
#include "symbolic/case/name_families.hpp"
#include "symbolic/case/toml_keys.hpp"
#include "symbolic/case_file.hpp"

namespace casimir {

using Keys = std::vector<std::string>;

/// Turns the values of a TOML document into text with places, and refuses those of a wrong type.
class TomlReader {
 public:
  /// \param limits  outlive it
  TomlReader(const std::string& toml, std::string file, const Limits& limits)
      : file_(std::move(file)), limits_(limits) {
    std::istringstream stream(toml);
    for (std::string line; std::getline(stream, line);) lines_.emplace_back(line);
  }

  SourceLine line(int number) const {
    return number >= 1 && number <= static_cast<int>(lines_.size()) ? lines_[number - 1]
                                                                    : SourceLine();
  }

 protected:
  Location place(const toml::source_region& region) const {
    return {file_, static_cast<int>(region.begin.line), static_cast<int>(region.begin.column)};
  }

  [[noreturn]] void fail(const toml::source_region& region, const std::string& what,
                         const std::string& hint = {}) const {
    const Location where = place(region);
    throw CaseError(where, what, line(where.line).text(), hint);
  }

  Text key_text(const toml::key& key) const {
    const Location where = place(key.source());
    return {one_line(std::string(key.str())), where, line(where.line)};
  }

  /// A string value. Integers are accepted too, since they are exact.
  Text text(const toml::node& node, const std::string& what, const std::string& hint = {}) const {
    const Location where = place(node.source());
    if (const auto integer = node.value_exact<int64_t>()) {
      return {std::to_string(*integer), where, line(where.line)};
    }
    if (node.is_floating_point()) {
      fail(node.source(), what + " must be a string, so that it stays exact",
           "write it in quotes: \"0.5\" is read as 1/2");
    }
    const auto value = node.value_exact<std::string>();
    if (!value) fail(node.source(), what + " must be a string", hint);
    Text text = inside_quotes({*value, where, line(where.line)});
    text.value = flat(*value);
    return text;
  }

  /// A string that is printed as it is.
  Text name(const toml::table& table, const std::string& what) const {
    Text name = text(required(table, "name", what), "'name'");
    constexpr std::size_t kMaxName = 200;
    if (name.value.size() > kMaxName)
      throw name.error(fmt::format("a name is longer than {} characters", kMaxName));
    name.value = one_line(name.value);
    return name;
  }

  /// Moves the place from the opening quote to the first character, where the string stands in the
  /// file as it is; otherwise (escapes, several lines) positions inside it are not known.
  static Text inside_quotes(Text text) {
    const std::size_t start = static_cast<std::size_t>(std::max(text.where.column, 1));
    const std::string& line = text.excerpt.text();
    if (line.compare(std::min(start, line.size()), text.value.size(), text.value) == 0)
      text.where.column += 1;
    return text;
  }

  void allow(const toml::table& table, const std::string& where, const Keys& keys) const {
    for (const auto& [key, node] : table) {
      const std::string name(key.str());
      if (std::find(keys.begin(), keys.end(), name) == keys.end()) {
        std::string hint = root_key_hint(name);
        if (hint.empty()) hint = suggest_or_list(name, keys, "known keys");
        fail(key.source(), fmt::format("unknown key '{}' in {}", printable(name), where), hint);
      }
    }
  }

  const toml::node& required(const toml::table& table, const char* key,
                             const std::string& where) const {
    const toml::node* node = table.get(key);
    if (node == nullptr) fail(table.source(), fmt::format("{} needs a key '{}'", where, key));
    return *node;
  }

  const toml::table& as_table(const toml::node& node, const std::string& what) const {
    if (!node.is_table())
      fail(node.source(), what + " must be a table",
           node.is_array_of_tables() && what.starts_with('[')
               ? fmt::format("there is only one: write {} with single brackets", what)
               : "");
    return *node.as_table();
  }

  const toml::array& as_array(const toml::node& node, const std::string& what) const {
    if (!node.is_array()) fail(node.source(), what + " must be an array");
    return *node.as_array();
  }

  bool boolean(const toml::table& table, const char* key) const {
    const toml::node* node = table.get(key);
    if (node == nullptr) return false;
    if (!node->is_boolean()) fail(node->source(), fmt::format("'{}' must be true or false", key));
    return node->as_boolean()->get();
  }

  std::optional<Text> optional_text(const toml::table& table, const char* key) const {
    const toml::node* node = table.get(key);
    if (node == nullptr) return std::nullopt;
    return text(*node, fmt::format("'{}'", key));
  }

  std::string plain(const toml::table& table, const char* key) const {
    const std::optional<Text> value = optional_text(table, key);
    return value ? one_line(value->value) : "";
  }

  std::vector<Text> texts(const toml::table& table, const char* key) const {
    std::vector<Text> result;
    const toml::node* node = table.get(key);
    if (node == nullptr) return result;
    for (const toml::node& item : as_array(*node, fmt::format("'{}'", key))) {
      result.push_back(text(item, fmt::format("each entry of '{}'", key)));
    }
    return result;
  }

  /// The same for names, of which some may be families as in "q[1..3]".
  std::vector<Text> name_list(const toml::table& table, const char* key) const {
    std::vector<Text> result;
    for (const Text& given : texts(table, key))
      for (FamilyMember& member : members_of(given, integers_, limits_))
        result.push_back(std::move(member.name));
    return result;
  }

  std::vector<std::vector<Text>> matrix(const toml::table& table, const char* key) const {
    std::vector<std::vector<Text>> rows;
    for (const toml::node& item :
         as_array(required(table, key, "[[lax]]"), fmt::format("'{}'", key))) {
      std::vector<Text> row;
      for (const toml::node& entry : as_array(item, fmt::format("each row of '{}'", key))) {
        row.push_back(text(entry, fmt::format("each entry of '{}'", key)));
      }
      rows.push_back(std::move(row));
    }
    for (const std::vector<Text>& row : rows) {
      if (row.size() != rows.size())
        fail(table.get(key)->source(), fmt::format("'{}' must be square", key));
    }
    return rows;
  }

  /// The key-value pairs of a table of strings, in the order of the file. A key may stand for a
  /// family, as "q[i=1..n]"; then the value is read for each i.
  std::vector<Entry> entries(const toml::node& node, const std::string& what) const {
    std::vector<Entry> result;
    for (const auto& [key, value] : as_table(node, what)) {
      const Text given = text(value, fmt::format("'{}'", printable(std::string(key.str()))),
                              root_key_hint(key.str()));
      for (FamilyMember& member : members_of(key_text(key), integers_, limits_)) {
        result.emplace_back(std::move(member.name), given);
        if (!member.indices.empty())
          result.back().second.indices = std::make_shared<const Indices>(std::move(member.indices));
      }
    }
    std::stable_sort(result.begin(), result.end(), [](const Entry& a, const Entry& b) {
      return std::pair(a.first.where.line, a.first.where.column) <
             std::pair(b.first.where.line, b.first.where.column);
    });
    return result;
  }

  std::vector<Entry> optional_entries(const toml::table& table, const char* key) const {
    const toml::node* node = table.get(key);
    return node == nullptr ? std::vector<Entry>{} : entries(*node, fmt::format("'{}'", key));
  }

  /// Calls `read` for each table of the array of tables `key`.
  template <class Read>
  void each(const toml::table& root, const char* key, Read read) const {
    const toml::node* node = root.get(key);
    if (node == nullptr) return;
    const std::string what = fmt::format("[[{}]]", key);
    if (!node->is_array())
      fail(node->source(), what + " must be an array of tables",
           fmt::format("there may be several: write {} with double brackets", what));
    for (const toml::node& item : *node->as_array()) read(as_table(item, what), what);
  }

  /// Integers that stand in [definitions] as they are: they may be bounds of families.
  void read_integers(const toml::table& root) {
    const toml::node* node = root.get("definitions");
    if (node == nullptr || !node->is_table()) return;
    for (const auto& [key, value] : *node->as_table()) {
      const auto plain = value.value_exact<int64_t>();
      const auto quoted = value.value_exact<std::string>();
      long number = 0;
      if (plain) {
        number = *plain;
      } else if (quoted) {
        const auto [end, problem] =
            std::from_chars(quoted->data(), quoted->data() + quoted->size(), number);
        if (problem != std::errc() || end != quoted->data() + quoted->size()) continue;
      } else {
        continue;
      }
      integers_[std::string(key.str())] = number;
    }
  }

  std::string file_;
  const Limits& limits_;
  std::vector<SourceLine> lines_;
  Indices integers_;
};

}  // namespace casimir
