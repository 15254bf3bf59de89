// Sorts a program into groups for the kernel of its series.
#include "runtime/taylor/program_layout.hpp"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "runtime/program/operation.hpp"

using ProgramKernel = void(const casimir_program*, double, double, double*);
extern "C" {
#ifdef CASIMIR_X86_KERNELS
ProgramKernel casimir_program_avx512, casimir_program_avx2;
#endif
ProgramKernel casimir_program_baseline;
}

namespace casimir {
namespace {

std::size_t as_index(int i) { return static_cast<std::size_t>(i); }

ProgramKernel* kernel_of([[maybe_unused]] int width) {
#ifdef CASIMIR_X86_KERNELS
  if (width == 8) return casimir_program_avx512;
  if (width == 4) return casimir_program_avx2;
#endif
  return casimir_program_baseline;
}

/// How many series the recurrence of a group keeps.
int series_of(int kind) {
  switch (kind) {
    case CASIMIR_GROUP_MUL:
    case CASIMIR_GROUP_DIV:
    case CASIMIR_GROUP_EXP:
      return 2;
    case CASIMIR_GROUP_SQRT:
      return 1;
    case CASIMIR_GROUP_LOG:
    case CASIMIR_GROUP_SINCOS:
      return 3;
    case CASIMIR_GROUP_POW:
      return 4;
    default:
      return 0;
  }
}

}  // namespace

/// Puts the lines of a program into groups and gives every line a place.
class ProgramLayout::Sorter {
 public:
  Sorter(ProgramLayout& layout)
      : layout_(layout), program_(layout.program_), level_(program_.code.size(), 0) {}

  /// \return  whether every operation has a group.
  bool sort() {
    find_constants();
    for (std::size_t i = 0; i < program_.code.size(); ++i)
      if (!layout_.is_constant_[i] && !put(static_cast<int>(i))) return false;
    give_places();
    return true;
  }

 private:
  bool constant(int line) const { return line < 0 || layout_.is_constant_[as_index(line)]; }

  void find_constants() {
    const std::size_t states = program_.outputs.size();
    for (const Instruction& line : program_.code) {
      const bool known = is_literal(line) ||
                         (line.op == Op::input ? as_index(line.a) >= states &&
                                                     as_index(line.a) + 1 < program_.inputs.size()
                                               : constant(line.a) && constant(line.b));
      layout_.is_constant_.push_back(known);
    }
  }

  /// The kind of a line that is neither constant nor an input; nothing if there is none.
  std::optional<int> kind_of(const Instruction& line) const {
    switch (line.op) {
      case Op::add:
        return CASIMIR_GROUP_ADD;
      case Op::sub:
        return CASIMIR_GROUP_SUB;
      case Op::neg:
        return CASIMIR_GROUP_NEG;
      case Op::mul:
        return constant(line.a) || constant(line.b) ? CASIMIR_GROUP_SCALE : CASIMIR_GROUP_MUL;
      case Op::div:
        return constant(line.b) ? CASIMIR_GROUP_SHRINK : CASIMIR_GROUP_DIV;
      case Op::sqrt:
        return CASIMIR_GROUP_SQRT;
      case Op::pow:
        return CASIMIR_GROUP_POW;
      case Op::exp:
        return CASIMIR_GROUP_EXP;
      case Op::log:
        return CASIMIR_GROUP_LOG;
      case Op::sin:
      case Op::cos:
        return CASIMIR_GROUP_SINCOS;
      default:
        return std::nullopt;
    }
  }

  /// Notes the group of a line and its level: one above those of its operands.
  bool put(int i) {
    const Instruction& line = program_.code[as_index(i)];
    if (line.op == Op::input) return true;
    const std::optional<int> kind = kind_of(line);
    if (!kind) return false;
    int level = level_[as_index(line.a)];
    if (line.b >= 0) level = std::max(level, level_[as_index(line.b)]);
    level_[as_index(i)] = level + 1;
    Group& group = groups_[{level + 1, *kind}];
    group.kind = *kind;
    if (*kind == CASIMIR_GROUP_SINCOS) {
      const auto [known, fresh] = pair_.try_emplace(line.a, group.lines.size());
      cell_[i] = {*kind, level + 1, known->second, line.op == Op::cos};
      if (fresh) group.lines.push_back(i);
    } else {
      cell_[i] = {*kind, level + 1, group.lines.size(), false};
      group.lines.push_back(i);
    }
    return true;
  }

  int in_whole_registers(int count) const {
    return (count + layout_.width_ - 1) / layout_.width_ * layout_.width_;
  }

  void give_places() {
    const int states = static_cast<int>(program_.outputs.size());
    int next = states;
    layout_.time_ = next++;
    layout_.first_constant_ = next;
    for (std::size_t i = 0; i < program_.code.size(); ++i) {
      if (!layout_.is_constant_[i]) continue;
      constant_place_[static_cast<int>(i)] = next++;
      layout_.constants_.push_back(static_cast<int>(i));
    }
    next = in_whole_registers(next);
    for (auto& [key, group] : groups_) {
      group.level = key.first;
      const int count = static_cast<int>(group.lines.size());
      group.padded = in_whole_registers(count);
      group.target = next;
      next += group.kind == CASIMIR_GROUP_SINCOS ? 2 * group.padded : group.padded;
    }
    layout_.places_ = next;
    for (auto& [key, group] : groups_) {
      for (const int line : group.lines) take_operands(group, program_.code[as_index(line)]);
      layout_.groups_.push_back(group);
    }
    for (const int line : program_.outputs) layout_.outputs_.push_back(place_of(line));
  }

  void take_operands(Group& group, const Instruction& line) const {
    const bool swapped = group.kind == CASIMIR_GROUP_SCALE && constant(line.a);
    group.a.push_back(place_of(swapped ? line.b : line.a));
    if (group.kind == CASIMIR_GROUP_SCALE)
      group.constant.push_back(swapped ? line.a : line.b);
    else if (group.kind == CASIMIR_GROUP_SHRINK || group.kind == CASIMIR_GROUP_POW)
      group.constant.push_back(line.b);
    else if (line.b >= 0)
      group.b.push_back(place_of(line.b));
  }

  int place_of(int line) const {
    const Instruction& at = program_.code[as_index(line)];
    if (layout_.is_constant_[as_index(line)]) return constant_place_.at(line);
    if (at.op == Op::input) return as_index(at.a) < program_.outputs.size() ? at.a : layout_.time_;
    const auto& [kind, level, cell, second] = cell_.at(line);
    const Group& group = groups_.at({level, kind});
    return group.target + static_cast<int>(cell) + (second ? group.padded : 0);
  }

  ProgramLayout& layout_;
  const Program& program_;
  std::vector<int> level_;
  std::map<std::pair<int, int>, Group> groups_;  ///< by level and kind
  std::map<int, std::size_t> pair_;              ///< of sine and cosine, by their argument
  std::map<int, std::tuple<int, int, std::size_t, bool>> cell_;
  std::map<int, int> constant_place_;
};

std::optional<ProgramLayout> ProgramLayout::of(const Program& program, std::size_t parameters,
                                               int width) {
  ProgramLayout layout;
  layout.program_ = program;
  layout.parameters_ = parameters;
  layout.width_ = width;
  if (!Sorter(layout).sort()) return std::nullopt;
  return layout;
}

void ProgramLayout::start(int order, const double* parameters) {
  order_ = order;
  const Arithmetic<double> arithmetic;
  std::vector<double> value(program_.code.size());
  for (const int i : constants_) {
    const Instruction& line = program_.code[as_index(i)];
    value[as_index(i)] = is_literal(line) ? literal_value(program_, line, arithmetic)
                         : line.op == Op::input
                             ? parameters[as_index(line.a) - program_.outputs.size()]
                             : applied(line.op, value[as_index(line.a)],
                                       value[as_index(line.b < 0 ? line.a : line.b)], arithmetic);
  }
  constant_values_.clear();
  for (const int i : constants_) constant_values_.push_back(value[as_index(i)]);
  const auto lines = [](std::size_t numbers) { return std::vector<Line>(numbers / 8 + 1); };
  place_ = lines(as_index(places_));
  std::size_t room = 0;
  for (Group& group : groups_) {
    group.history = room;
    room += as_index(series_of(group.kind)) * as_index(order + 1) * as_index(group.padded);
    group.values.clear();
    for (const int line : group.constant) group.values.push_back(value[as_index(line)]);
  }
  history_ = lines(room);
  tables_.clear();
  for (const Group& group : groups_)
    tables_.push_back({group.kind, static_cast<int>(group.lines.size()), group.padded, group.target,
                       group.a.data(), group.b.data(), group.values.data(),
                       history_[0].numbers + group.history});
}

void ProgramLayout::expand(double t, double unit, double* rows, int stride) {
  const casimir_program view = {static_cast<int>(outputs_.size()),
                                static_cast<int>(parameters_),
                                order_,
                                order_ + 1,
                                stride,
                                static_cast<int>(tables_.size()),
                                tables_.data(),
                                outputs_.data(),
                                time_,
                                static_cast<int>(constants_.size()),
                                first_constant_,
                                constant_values_.data(),
                                place_[0].numbers};
  kernel_of(width_)(&view, t, unit, rows);
}

}  // namespace casimir
