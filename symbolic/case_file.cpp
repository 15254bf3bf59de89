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

/// Whether a line gives one of the keys whose values are words: Appendix I is no number.
bool is_line_of_words(const std::string& toml, std::size_t begin) {
  for (const std::string key : {"title", "source", "book", "tags"})
    if (toml.compare(begin, key.size(), key) == 0 && begin + key.size() < toml.size() &&
        (toml[begin + key.size()] == ' ' || toml[begin + key.size()] == '='))
      return true;
  return false;
}

/// Whether the text has I as a word of its own, outside of comments and of what is said of the
/// case.
bool speaks_of_imaginary_unit(const std::string& toml) {
  const auto is_part = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
  };
  bool comment = false;
  char quote = 0;  // of the string that is open
  for (std::size_t i = 0; i < toml.size(); ++i) {
    if (toml[i] == '\n') {
      comment = false;
      quote = 0;
    }
    if ((i == 0 || toml[i - 1] == '\n') && is_line_of_words(toml, i)) comment = true;
    const bool escaped = quote == '"' && toml[i - 1] == '\\';
    if (!comment && !escaped && (toml[i] == '"' || toml[i] == '\'')) {
      if (quote == 0)
        quote = toml[i];
      else if (quote == toml[i])
        quote = 0;
    }
    comment = comment || (toml[i] == '#' && quote == 0);
    if (comment || toml[i] != 'I') continue;
    const bool starts = i == 0 || !is_part(toml[i - 1]);
    const bool ends = i + 1 == toml.size() || !is_part(toml[i + 1]);
    if (starts && ends) return true;
  }
  return false;
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
    AnyCaseFile result = reader.read(toml::parse(toml, std::string_view(file)));
    CaseFile& common = std::visit(
        [](auto& part) -> CaseFile& {
          if constexpr (std::is_same_v<std::decay_t<decltype(part)>, CaseFile>)
            return part;
          else
            return part.file;
        },
        result);
    common.complex_numbers = speaks_of_imaginary_unit(toml);
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
