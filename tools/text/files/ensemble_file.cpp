// The CSV file of an ensemble. No library of Debian's tells in which line and column a field
// stands.
#include "tools/text/files/ensemble_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>

#include "codegen/dag/expression_dag.hpp"
#include "codegen/emit/number_literal.hpp"
#include "codegen/optimise/optimise.hpp"
#include "symbolic/expression/expression.hpp"
#include "tools/cli/errors.hpp"

namespace casimir::tools {
namespace {

std::string content_of(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    throw UsageError(fmt::format("'{}' is a folder", printable(path, 200)));
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  if (stream) text << stream.rdbuf();
  if (!stream)
    throw UsageError(
        fmt::format("cannot read '{}': {}", printable(path, 200), std::strerror(errno)));
  std::string content = text.str();
  if (content.starts_with("\xef\xbb\xbf")) content.erase(0, 3);  // a byte order mark
  return content;
}

/// Takes the fields of a CSV text one after the other.
class Fields {
 public:
  Fields(const std::string& path, const std::string& content) : path_(path), content_(content) {}

  /// Goes to the next line that is not blank; whether there is one.
  bool next_line() {
    while (begin_ < content_.size() || at_ < content_.size()) {
      begin_ = at_;
      if (begin_ >= content_.size()) return false;
      ++line_;
      end_ = std::min(content_.find('\n', begin_), content_.size());
      if (content_.find_first_not_of(" \t\r", begin_) < end_) {
        more_ = true;
        return true;
      }
      at_ = end_ + 1;
    }
    return false;
  }

  bool more() const { return more_; }

  /// The next field of the line, without spaces around it.
  Text next() {
    while (at_ < content_.size() && (content_[at_] == ' ' || content_[at_] == '\t')) ++at_;
    return at_ < content_.size() && content_[at_] == '"' ? quoted() : plain();
  }

  /// A place behind the last field of the line.
  Text here() const { return text("", std::min(at_, content_.size())); }

 private:
  Text plain() {
    const std::size_t begin = at_;
    const std::size_t end = std::min(content_.find_first_of(",\n", at_), content_.size());
    std::size_t last = end;
    while (last > begin && std::strchr(" \t\r", content_[last - 1])) --last;
    at_ = end;
    Text field = text(content_.substr(begin, last - begin), begin);
    separate();
    return field;
  }

  Text quoted() {
    const std::size_t begin = ++at_;
    std::string value;
    for (;; ++at_) {
      if (at_ >= content_.size() || content_[at_] == '\n')
        throw text("", begin - 1).error("this quotation mark is not closed in its line");
      if (content_[at_] == '"' && content_.compare(at_, 2, "\"\"") != 0) break;
      if (content_[at_] == '"') ++at_;
      value += content_[at_];
    }
    ++at_;
    while (at_ < content_.size() && std::strchr(" \t\r", content_[at_])) ++at_;
    if (at_ < content_.size() && content_[at_] != ',' && content_[at_] != '\n')
      throw text("", at_).error("expected a comma or the end of the line after a quoted field");
    Text field = text(value, begin);
    separate();
    return field;
  }

  /// Goes over what ends a field.
  void separate() {
    more_ = at_ < content_.size() && content_[at_] == ',';
    if (more_ || at_ < content_.size()) ++at_;
  }

  Text text(std::string value, std::size_t offset) const {
    std::string excerpt = content_.substr(begin_, end_ - begin_);
    if (excerpt.ends_with('\r')) excerpt.pop_back();
    return {std::move(value),
            {path_, line_, static_cast<int>(offset - begin_) + 1},
            std::move(excerpt)};
  }

  const std::string& path_;
  const std::string& content_;
  std::size_t begin_ = 0, end_ = 0, at_ = 0;
  int line_ = 0;
  bool more_ = false;
};

/// A decimal number, of which all characters are one.
std::optional<double> decimal(const std::string& text, std::size_t begin, std::size_t end,
                              bool& out_of_range) {
  if (begin < end && text[begin] == '+') ++begin;
  const std::size_t digits = begin < end && text[begin] == '-' ? begin + 1 : begin;
  // Not the words for infinity and for what is no number.
  if (digits >= end || !std::strchr("0123456789.", text[digits])) return std::nullopt;
  double value = 0;
  const auto [last, problem] = std::from_chars(text.data() + begin, text.data() + end, value);
  if (last != text.data() + end) return std::nullopt;
  out_of_range = problem == std::errc::result_out_of_range;
  return value;
}

/// a/b with integers that are doubles exactly, so that the quotient is rounded once.
std::optional<double> quotient(const std::string& text) {
  const std::size_t bar = text.find('/');
  if (bar == std::string::npos || text.find_first_of(".eE") != std::string::npos)
    return std::nullopt;
  bool beyond = false;
  const auto a = decimal(text, 0, bar, beyond), b = decimal(text, bar + 1, text.size(), beyond);
  constexpr double kExact = 0x1p53;
  if (!a || !b || *b == 0 || std::abs(*a) > kExact || std::abs(*b) > kExact) return std::nullopt;
  if (text[bar + 1] == '-' || text[bar + 1] == '+') return std::nullopt;
  return *a / *b;
}

/// Any other constant, by exact algebra.
double exact_constant(const Text& text, const Limits& limits) {
  codegen::Dag dag({}, 0);
  const codegen::Scaled value = dag.convert(parse_real_constant(text, limits));
  const Program program = codegen::optimised(dag, {value}, {}, {"value"});
  try {
    return codegen::nearest<double>(
        codegen::constant_value(program, program.outputs.front(), limits));
  } catch (const ModelError&) {
    throw text.error("this number is outside the range of double precision");
  }
}

double member_value(const Text& text, const Limits& limits) {
  if (text.value.empty()) throw text.error("expected a number, not an empty field");
  bool out_of_range = false;
  if (const auto value = decimal(text.value, 0, text.value.size(), out_of_range)) {
    if (out_of_range) throw text.error("this number is outside the range of double precision");
    return *value;
  }
  if (const auto value = quotient(text.value)) return *value;
  return exact_constant(text, limits);
}

std::vector<std::string> header(Fields& fields, const std::vector<std::string>& known,
                                const std::vector<std::string>& fixed) {
  std::vector<std::string> columns;
  do {
    const Text name = fields.next();
    if (std::find(fixed.begin(), fixed.end(), name.value) != fixed.end())
      throw name.error(fmt::format("'{}' is already given by --param", name.value));
    if (std::find(known.begin(), known.end(), name.value) == known.end()) {
      throw name.error(fmt::format("there is no variable or parameter '{}'; the first line names "
                                   "the columns",
                                   printable(name.value)),
                       0, suggest_or_list(name.value, known));
    }
    if (std::find(columns.begin(), columns.end(), name.value) != columns.end())
      throw name.error(fmt::format("there are two columns '{}'", name.value));
    columns.push_back(name.value);
  } while (fields.more());
  return columns;
}

void row(Fields& fields, EnsembleFile& file, const Limits& limits) {
  std::size_t count = 0;
  while (fields.more()) {
    const Text field = fields.next();
    if (++count > file.columns.size())
      throw field.error(
          fmt::format("more fields than the {} columns of the first line", file.columns.size()));
    file.values.push_back(member_value(field, limits));
  }
  if (count < file.columns.size())
    throw fields.here().error(
        fmt::format("{} fields, but the first line names {} columns", count, file.columns.size()));
}

}  // namespace

EnsembleFile read_ensemble(const std::string& path, const std::vector<std::string>& known,
                           const Limits& limits, const std::vector<std::string>& fixed) {
  const std::string content = content_of(path);
  Fields fields(path, content);
  EnsembleFile file;
  if (!fields.next_line())
    throw CaseError({path, 1, 1},
                    "the file is empty: expected a line of names, then one for each "
                    "member");
  file.columns = header(fields, known, fixed);
  while (fields.next_line()) row(fields, file, limits);
  if (file.rows() == 0)
    throw fields.here().error("there are no members: expected a line for each after the names");
  return file;
}

}  // namespace casimir::tools
