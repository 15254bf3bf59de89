#include "symbolic/case_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <fstream>

#include "symbolic/case/case_tables.hpp"
#include "symbolic/expression/spelling.hpp"

namespace casimir {
namespace {

std::string read_text(const std::filesystem::path& path, const Limits& limits) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    throw CaseError({path.string()}, "this is a folder; a case file was expected");
  }
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw CaseError({path.string()}, "the case file does not exist or cannot be read");
  std::string text;
  char chunk[1 << 14];
  while (static_cast<double>(text.size()) <= limits.file_bytes &&
         (stream.read(chunk, sizeof chunk), stream.gcount() > 0))
    text.append(chunk, static_cast<std::size_t>(stream.gcount()));
  return text;
}

/// Whether an expression has I as a word of its own.
bool has_imaginary_unit(std::string_view expression) {
  const auto is_part = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
  };
  for (std::size_t i = 0; i < expression.size(); ++i) {
    if (expression[i] != 'I') continue;
    const bool starts = i == 0 || !is_part(expression[i - 1]);
    const bool ends = i + 1 == expression.size() || !is_part(expression[i + 1]);
    if (starts && ends) return true;
  }
  return false;
}

/// Whether a string below this node has it.
/// \param words  keys of this table whose values are words: Appendix I is no number
bool has_imaginary_unit(const toml::node& node, std::initializer_list<std::string_view> words) {
  if (const auto* text = node.as_string()) return has_imaginary_unit(std::string_view(**text));
  if (const auto* list = node.as_array())
    return std::ranges::any_of(
        *list, [](const toml::node& part) { return has_imaginary_unit(part, {"name"}); });
  const auto* table = node.as_table();
  return table && std::ranges::any_of(*table, [&](const auto& entry) {
           const std::string_view key = entry.first.str();
           if (std::ranges::find(words, key) != words.end()) return false;
           return key == "section" && entry.second.is_table()
                      ? has_imaginary_unit(entry.second, {"labels"})
                      : has_imaginary_unit(entry.second, {});
         });
}

/// What people write who think of their formulas and not of TOML.
std::string hint_for(const toml::parse_error& problem, const std::string& line) {
  const auto column = static_cast<std::size_t>(problem.source().begin.column);
  const std::string quotes = unquoted_hint(line, column);
  return quotes.empty() ? spelling_of_escape("", line) : quotes;
}

}  // namespace

CaseError Text::error(const std::string& what, std::size_t offset, const std::string& hint,
                      double Limits::*limit) const {
  if (where.line <= 0) return CaseError(where, what, {}, hint, limit);
  Location at = where;
  // Inside a string with escapes or line breaks only the start of the string is known.
  const std::size_t start = static_cast<std::size_t>(std::max(where.column - 1, 0));
  const std::string& line = excerpt.text();
  const bool verbatim =
      flat(line.substr(std::min(start, line.size()), value.size())) == flat(value);
  if (verbatim) at.column += static_cast<int>(std::min(offset, value.size()));
  return CaseError(at, what, line, hint, limit);
}

const CaseFile& common_part(const AnyCaseFile& any) {
  if (const auto* map = std::get_if<MapCaseFile>(&any)) return map->file;
  return std::get<CaseFile>(any);
}

CaseError MapCaseFile::not_a_flow() const {
  return map.error(
      "this is the case of a map, and a flow is needed here: equations or a hamiltonian", 0,
      "show, verify, search, degrees, generate, integrate, conserve and section work with maps; "
      "[[map]] with double brackets claims that a map to another phase space is Poisson");
}

CaseFile parse_case(const std::string& toml, const std::string& file, const Limits& limits) {
  AnyCaseFile any = parse_any_case(toml, file, limits);
  if (const auto* map = std::get_if<MapCaseFile>(&any)) throw map->not_a_flow();
  return std::get<CaseFile>(std::move(any));
}

AnyCaseFile parse_any_case(const std::string& toml, const std::string& file, const Limits& limits) {
  if (static_cast<double>(toml.size()) > limits.file_bytes)
    throw CaseError({file},
                    fmt::format("the file is larger than {:g} MiB", limits.file_bytes / (1 << 20)),
                    {}, limits.hint(&Limits::file_bytes), &Limits::file_bytes);
  CaseTables reader(toml, file, limits);
  if (const std::optional<int> number = line_of_deep_key(toml))
    throw CaseError({file, *number, 1}, "a key has too many parts", reader.line(*number).text());
  try {
    const toml::table root = toml::parse(toml, std::string_view(file));
    AnyCaseFile result = reader.read(root);
    CaseFile& common = std::visit(
        [](auto& part) -> CaseFile& {
          if constexpr (std::is_same_v<std::decay_t<decltype(part)>, CaseFile>)
            return part;
          else
            return part.file;
        },
        result);
    common.complex_numbers = has_imaginary_unit(root, {"title", "source", "book", "tags"});
    common.limits = limits;
    return result;
  } catch (const toml::parse_error& problem) {
    const auto begin = problem.source().begin;
    const int number = std::max(1, static_cast<int>(begin.line));
    throw CaseError({file, number, std::max(1, static_cast<int>(begin.column))},
                    "this is not TOML: " + printable(std::string(problem.description()), 200),
                    reader.line(number).text(), hint_for(problem, reader.line(number).text()));
  }
}

CaseFile read_case(const std::filesystem::path& path, const Limits& limits) {
  return parse_case(read_text(path, limits), path.string(), limits);
}

AnyCaseFile read_any_case(const std::filesystem::path& path, const Limits& limits) {
  return parse_any_case(read_text(path, limits), path.string(), limits);
}

}  // namespace casimir
