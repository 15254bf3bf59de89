#include "tools/sweep/grid_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "codegen/dag/expression_dag.hpp"
#include "codegen/optimise/optimise.hpp"
#include "runtime/evaluate.hpp"
#include "runtime/program/number.hpp"
#include "symbolic/case/limits.hpp"
#include "symbolic/expression/expression.hpp"
#include "tools/analysis/run/prepared_scene.hpp"
#include "tools/cli/errors.hpp"

namespace casimir::tools {
namespace {

/// A part of an option, with its place.
Text piece_of(const Text& whole, std::size_t begin, std::size_t end) {
  while (begin < end && whole.value[begin] == ' ') ++begin;
  while (end > begin && whole.value[end - 1] == ' ') --end;
  Text part = whole;
  part.value = whole.value.substr(begin, end - begin);
  part.where.column += static_cast<int>(begin);
  return part;
}

std::vector<Text> split(const Text& whole, std::size_t begin, char separator) {
  std::vector<Text> parts;
  int depth = 0;
  for (std::size_t at = begin; at <= whole.value.size(); ++at) {
    const char c = at < whole.value.size() ? whole.value[at] : separator;
    depth += c == '(' ? 1 : c == ')' ? -1 : 0;
    if (at < whole.value.size() && (c != separator || depth > 0)) continue;
    parts.push_back(piece_of(whole, begin, at));
    begin = at + 1;
  }
  return parts;
}

cln::cl_F grid_value(const Text& text, const Limits& limits) {
  if (text.value.empty()) throw text.error("expected a number");
  codegen::Dag dag({}, 0);
  const codegen::Scaled value = dag.convert(parse_real_constant(text, limits));
  const Program program = codegen::optimised(dag, {value}, {}, {"value"});
  return evaluate(program, {}, Arithmetic<cln::cl_F>(kConstantDigits)).front();
}

double nearest(const cln::cl_F& value, const Text& text) {
  try {
    return rounded(value);
  } catch (const ModelError&) {
    throw text.error("this number is outside the range of double precision");
  }
}

std::size_t count(const Text& text) {
  std::size_t n = 0;
  const char* const end = text.value.data() + text.value.size();
  const auto [last, problem] = std::from_chars(text.value.data(), end, n);
  if (text.value.empty() || last != end || problem != std::errc{} || n == 0)
    throw text.error("expected how many points, a positive whole number");
  if (n > kMostPoints) throw text.error(fmt::format("more than {} points", kMostPoints));
  return n;
}

/// FROM:TO:N, both ends included.
std::vector<double> range(const std::vector<Text>& parts, const Limits& limits) {
  const cln::cl_F from = grid_value(parts[0], limits), to = grid_value(parts[1], limits);
  const std::size_t n = count(parts[2]);
  if (n == 1 && from != to)
    throw parts[2].error("one point cannot reach from one value to another: at least 2");
  std::vector<double> values;
  for (std::size_t k = 0; k < n; ++k) {
    const cln::cl_F value = n == 1
                                ? from
                                : from + (to - from) * cln::cl_RA(static_cast<unsigned long>(k)) /
                                             cln::cl_RA(static_cast<unsigned long>(n - 1));
    values.push_back(nearest(k + 1 == n ? to : value, parts[1]));
  }
  return values;
}

std::vector<double> values_of(const Text& option, std::size_t begin, const Limits& limits) {
  const std::vector<Text> ends = split(option, begin, ':');
  if (ends.size() == 3) return range(ends, limits);
  if (ends.size() != 1)
    throw piece_of(option, begin, option.value.size())
        .error("expected FROM:TO:N, such as 0:1:11, or values such as 1,2,4");
  std::vector<double> values;
  for (const Text& text : split(option, begin, ','))
    values.push_back(nearest(grid_value(text, limits), text));
  return values;
}

bool has(const std::vector<GiNaC::symbol>& symbols, const std::string& name) {
  return std::ranges::any_of(symbols, [&](const GiNaC::symbol& s) { return s.get_name() == name; });
}

/// Whether a name stands as a word in one of the texts.
bool used(const std::vector<std::string>& texts, const std::string& name) {
  const auto of_word = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  };
  return std::ranges::any_of(texts, [&](const std::string& text) {
    for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + 1)) {
      const std::size_t end = at + name.size();
      if ((at == 0 || !of_word(text[at - 1])) && (end == text.size() || !of_word(text[end])))
        return true;
    }
    return false;
  });
}

Axis::Kind kind_of(const Text& name, const std::vector<std::string>& lets, const Model& model) {
  for (const auto& [fixed, ignored] : model.fixed)
    if (fixed.value == name.value)
      throw name.error(fmt::format("'{}' is already given by --param", name.value));
  if (has(model.parameters, name.value)) return Axis::Kind::parameter;
  if (has(model.variables, name.value)) return Axis::Kind::state;
  if (used(lets, name.value)) return Axis::Kind::free;
  std::vector<std::string> known;
  for (const auto* list : {&model.parameters, &model.variables})
    for (const GiNaC::symbol& symbol : *list) known.push_back(symbol.get_name());
  throw name.error(fmt::format("there is no parameter or variable '{}'; a new name needs a --let "
                               "that uses it",
                               printable(name.value)),
                   0, suggest_or_list(name.value, known));
}

/// The name before the equal sign of a --let.
std::string let_name(const std::string& let) {
  std::string name = let.substr(0, let.find('='));
  std::erase(name, ' ');
  return name;
}

}  // namespace

Grid read_grid(const std::vector<std::string>& over, const std::vector<std::string>& lets,
               const Model& model) {
  Grid grid;
  std::size_t points = 1;
  for (const std::string& value : over) {
    const Text option{value, {"--over", 1, 1}, value};
    const std::size_t equals = value.find('=');
    if (equals == std::string::npos)
      throw option.error("expected NAME=FROM:TO:N, such as --over r=1:2:11");
    const Text name = piece_of(option, 0, equals);
    for (const Axis& axis : grid.axes)
      if (axis.name == name.value) throw name.error(fmt::format("there are two '{}'", name.value));
    const Axis::Kind kind = kind_of(name, lets, model);
    grid.axes.push_back({name.value, kind, values_of(option, equals + 1, model.limits)});
    if (points > kMostPoints / grid.axes.back().values.size())
      throw UsageError(fmt::format("the grid has more than {} points", kMostPoints));
    points *= grid.axes.back().values.size();
  }
  return grid;
}

std::vector<std::string> names_set(const Grid& grid, const std::vector<std::string>& lets) {
  std::vector<std::string> result;
  for (const Axis& axis : grid.axes)
    if (axis.kind != Axis::Kind::free) result.push_back(axis.name);
  for (const std::string& let : lets) result.push_back(let_name(let));
  return result;
}

Lets read_lets(const std::vector<std::string>& lets, const Grid& grid, const Model& model) {
  NameTable table(model.limits);
  Lets result;
  for (const Axis& axis : grid.axes) {
    result.axes.emplace_back(axis.name);
    table.add(axis.name, Quantity::symbol(result.axes.back()));
  }
  for (const std::string& let : lets) {
    const Text option{let, {"--let", 1, 1}, let};
    const std::size_t equals = let.find('=');
    if (equals == std::string::npos)
      throw option.error("expected NAME=EXPR, such as --let \"g1=sin(theta)\"");
    const std::string name = let_name(let);
    if (!has(model.variables, name) && !has(model.parameters, name)) {
      std::vector<std::string> names;
      for (const auto* list : {&model.variables, &model.parameters})
        for (const GiNaC::symbol& s : *list) names.push_back(s.get_name());
      throw option.error(fmt::format("there is no variable or parameter '{}'", printable(name)), 0,
                         suggest_or_list(name, names));
    }
    for (const Axis& axis : grid.axes)
      if (axis.name == name) throw option.error(fmt::format("'{}' is given by --over", name));
    for (const auto& [other, ignored] : result.values)
      if (other == name) throw option.error(fmt::format("there are two '{}'", name));
    const Text expression{let.substr(equals + 1), {"--let", 1, static_cast<int>(equals) + 2}, let};
    result.values.emplace_back(name, parse_expression(expression, table).value);
    result.text += let + '\n';
  }
  return result;
}

}  // namespace casimir::tools
