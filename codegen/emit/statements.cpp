#include "codegen/emit/statements.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "codegen/emit/identifiers.hpp"
#include "codegen/optimise/lower.hpp"
#include "runtime/program/function_table.hpp"

namespace casimir::codegen {

namespace {

constexpr std::size_t kWidth = 100;
constexpr std::size_t kNamesInNote = 6;

/// How tightly an operator of C++ binds; the higher the tighter.
enum Binding { kAny, kSum, kProduct, kUnary, kPrimary };

bool is_leaf(Op op) { return op == Op::input || op == Op::constant || op == Op::pi; }

class StatementWriter {
 public:
  StatementWriter(const Program& program, const std::vector<std::string>& names,
                  const StatementStyle& style)
      : program_(program),
        style_(style),
        constant_(constant_instructions(program)),
        names_(program.code.size()),
        uses_(program.code.size(), 0),
        outputs_of_(program.code.size()) {
    // In a template, irrational constants are computed in its number type.
    if (style.scalar == Scalar::templated) {
      for (std::size_t i = 0; i < constant_.size(); ++i) {
        constant_[i] = constant_[i] && is_rational(program, static_cast<int>(i));
      }
    }
    for (std::size_t i = 0; i < program.code.size(); ++i) {
      if (code(i).op == Op::input) names_[i] = names[static_cast<std::size_t>(code(i).a)];
    }
    count_uses();
  }

  std::string run(const std::vector<std::string>& targets) {
    std::string shared;
    for (std::size_t i = 0; i < program_.code.size(); ++i) {
      if (is_named(i)) shared += name_shared(i);
    }
    std::vector<std::string> assignments;
    for (std::size_t k = 0; k < targets.size(); ++k) {
      std::string line = style_.indent + targets[k] + " = ";
      append(static_cast<std::size_t>(program_.outputs[k]), kAny, line);
      assignments.push_back(line + ";");
    }
    const std::string tables = constants_ + shared;
    return tables + (tables.empty() ? "" : "\n") + commented(assignments);
  }

 private:
  const Instruction& code(std::size_t i) const { return program_.code[i]; }

  void count_uses() {
    for (std::size_t k = 0; k < program_.outputs.size(); ++k) {
      const auto i = static_cast<std::size_t>(program_.outputs[k]);
      ++uses_[i];
      outputs_of_[i].insert(k);
    }
    for (std::size_t i = program_.code.size(); i-- > 0;) {
      if (is_leaf(code(i).op) || constant_[i]) continue;
      for (const int operand : {code(i).a, code(i).b}) {
        if (operand < 0) continue;
        const auto o = static_cast<std::size_t>(operand);
        uses_[o] += code(i).op == Op::sign ? 2 : 1;  // it is written twice
        outputs_of_[o].insert(outputs_of_[i].begin(), outputs_of_[i].end());
      }
    }
  }

  /// A leaf, or a changed sign of one: not worth a name.
  bool is_simple(std::size_t i) const {
    return is_leaf(code(i).op) ||
           (code(i).op == Op::neg && is_leaf(code(static_cast<std::size_t>(code(i).a)).op));
  }

  bool is_named(std::size_t i) const { return uses_[i] > 1 && !constant_[i] && !is_simple(i); }

  std::string name_shared(std::size_t i) {
    const std::string name = "t" + std::to_string(++shared_count_);
    std::string line = style_.indent + "const " + style_.real + " " + name + " = ";
    append(i, kAny, line);
    names_[i] = name;
    std::string note;
    for (const std::size_t k : outputs_of_[i]) {
      note += (note.empty() ? "used in " : ", ") + program_.output_names[k];
      if (note.size() > 60 ||
          (outputs_of_[i].size() > kNamesInNote && k == *outputs_of_[i].begin())) {
        note += " and others";
        break;
      }
    }
    return with_comment(line + ";", note, 0);
  }

  /// Writes instruction i where something that binds like `context` needs it.
  void append(std::size_t i, Binding context, std::string& out) {
    if (constant_[i]) return append_constant(i, context, out);
    if (!names_[i].empty()) {
      out += names_[i];
      return;
    }
    const Instruction& c = code(i);
    const auto a = static_cast<std::size_t>(c.a);
    const auto b = static_cast<std::size_t>(c.b);
    if (c.op == Op::pi) {
      out += style_.call_prefix + "acos" + style_.call_suffix + "(" + converted("-1") + ")";
    } else if (c.op == Op::sign) {
      append_sign(c, context, out);
    } else if (is_function(c.op)) {
      append_call(c, out);
    } else if (c.op == Op::neg) {
      append_negation(a, context, out);
    } else {
      const bool additive = c.op == Op::add || c.op == Op::sub;
      const Binding own = additive ? kSum : kProduct;
      static constexpr const char* kSigns[] = {" + ", " - ", " * ", " / "};
      const bool parenthesised = own < context;
      if (parenthesised) out += '(';
      append(a, own, out);
      out += kSigns[static_cast<int>(c.op) - static_cast<int>(Op::add)];
      // a + (b + c) is another sum in floating point than a + b + c.
      append(b, additive ? kProduct : kUnary, out);
      if (parenthesised) out += ')';
    }
  }

  void append_call(const Instruction& c, std::string& out) {
    out += style_.call_prefix;
    out += function_row(c.op).c_name;
    out += style_.call_suffix + "(";
    if (c.op == Op::sign) out += converted("1") + ", ";
    append_argument(c.a, out);
    if (c.b >= 0) {
      out += ", ";
      append_argument(c.b, out);
    }
    out += ')';
  }

  /// What has no value has no sign either, and copysign would take one from the bits of a NaN.
  void append_sign(const Instruction& c, Binding context, std::string& out) {
    if (context > kSum) out += '(';
    append_call(c, out);
    out += " + " + converted("0") + " * ";
    append(static_cast<std::size_t>(c.a), kUnary, out);
    if (context > kSum) out += ')';
  }

  /// A whole number alone would choose the function for int, or none.
  void append_argument(int i, std::string& out) {
    const auto index = static_cast<std::size_t>(i);
    const std::size_t before = out.size();
    append(index, kAny, out);
    const std::string text = out.substr(before);
    if (text.find_first_not_of("-0123456789") != std::string::npos) return;
    out = out.substr(0, before) + converted(text);
  }

  std::string converted(const std::string& number) const {
    return (style_.c_casts ? "(" + style_.real + ")" : style_.real) + "(" + number + ")";
  }

  /// -a * b is (-a) * b, the same number as -(a * b).
  void append_negation(std::size_t a, Binding context, std::string& out) {
    std::string operand;
    append(a, kProduct, operand);
    if (operand.starts_with('-')) operand = "(" + operand + ")";
    out += context > kProduct ? "(-" + operand + ")" : "-" + operand;
  }

  void append_constant(std::size_t i, Binding context, std::string& out) {
    if (names_[i].empty()) {
      const int index = static_cast<int>(i);
      const bool rational = is_rational(program_, index);
      const NumberText number =
          number_text(constant_value(program_, index, style_.limits), style_.scalar,
                      rational ? "" : constant_text(program_, index));
      names_[i] = number.text;
      if (!number.is_plain) {
        names_[i] = "c" + std::to_string(++constant_count_);
        const std::string line =
            style_.indent + "const " + style_.real + " " + names_[i] + " = " + number.text + ";";
        constants_ += with_comment(line, number.comment, 0);
      }
    }
    const bool parenthesised = names_[i][0] == '-' && context > kProduct;
    out += parenthesised ? "(" + names_[i] + ")" : names_[i];
  }

  /// The assignments, with their comments in one column while they are short.
  std::string commented(const std::vector<std::string>& lines) const {
    std::size_t column = 0;
    for (const std::string& line : lines) {
      if (line.size() <= kWidth / 2) column = std::max(column, line.size());
    }
    std::string result;
    for (std::size_t k = 0; k < lines.size(); ++k) {
      result += with_comment(lines[k], program_.output_names[k], column);
    }
    return result;
  }

  std::string with_comment(const std::string& line, const std::string& raw,
                           std::size_t column) const {
    const std::string note = comment_text(raw);
    if (note.empty()) return wrapped(line) + "\n";
    const std::size_t padding = column > line.size() ? column - line.size() : 0;
    const std::string whole = line + std::string(padding + 2, ' ') + "// " + note;
    if (whole.size() <= kWidth) return whole + "\n";
    return comment_lines(note, style_.indent) + wrapped(line) + "\n";
  }

  const Program& program_;
  const StatementStyle& style_;
  std::vector<bool> constant_;
  std::vector<std::string> names_;
  std::vector<int> uses_;
  std::vector<std::set<std::size_t>> outputs_of_;
  std::string constants_;
  int shared_count_ = 0;
  int constant_count_ = 0;
};

std::string input_locals(const Program& program, const std::vector<std::string>& sources,
                         const std::vector<std::string>& names, const StatementStyle& style) {
  const std::vector<bool> used = used_inputs(program);
  std::string result;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    if (!used[i] || sources[i] == names[i]) continue;
    result += (result.empty() ? style.indent + "const " + style.real + " " : ", ") + names[i] +
              " = " + sources[i];
  }
  return result.empty() ? "" : wrapped(result + ";") + "\n";
}

/// The space before an operator or after a comma where a line is best broken: in as few parentheses
/// as possible, then far to the right.
std::size_t break_before(const std::string& line, std::size_t indent, std::size_t width) {
  std::size_t best = std::string::npos;
  int least = 0;
  int depth = 0;
  for (std::size_t i = indent; i + 2 < line.size() && i <= width; ++i) {
    depth += line[i] == '(' ? 1 : line[i] == ')' ? -1 : 0;
    if (line[i] != ' ' || i <= indent + 1) continue;
    const bool operator_follows =
        std::string("+-*/").find(line[i + 1]) != std::string::npos && line[i + 2] == ' ';
    if (!operator_follows && line[i - 1] != ',') continue;
    // The left half of a line is a last resort.
    const int cost = depth + (i < width / 2 ? 1000 : 0);
    if (best == std::string::npos || cost <= least) {
      best = i;
      least = cost;
    }
  }
  return best;
}

}  // namespace

std::vector<bool> used_inputs(const Program& program) {
  const Program live = without_dead_code(program);
  std::vector<bool> result(program.inputs.size(), false);
  for (const Instruction& c : live.code) {
    if (c.op == Op::input) result[static_cast<std::size_t>(c.a)] = true;
  }
  return result;
}

bool calls_functions(const Program& program) {
  const std::vector<bool> constant = constant_instructions(program);
  for (std::size_t i = 0; i < program.code.size(); ++i) {
    if (!constant[i] && is_function(program.code[i].op)) return true;
  }
  return false;
}

std::string statements(const Program& program, const std::vector<std::string>& sources,
                       const std::vector<std::string>& names,
                       const std::vector<std::string>& targets, const StatementStyle& style) {
  const std::string locals = input_locals(program, sources, names, style);
  const std::string rest = StatementWriter(program, names, style).run(targets);
  const bool has_table = rest.starts_with(style.indent + "const ");
  return locals + (locals.empty() || has_table ? "" : "\n") + rest;
}

std::string wrapped(const std::string& text, std::size_t width) {
  const std::string continuation(text.find_first_not_of(' ') + 4, ' ');
  std::string result;
  std::string rest = text;
  while (rest.size() > width) {
    const std::size_t place = break_before(rest, continuation.size(), width);
    if (place == std::string::npos) break;
    result += rest.substr(0, place) + "\n";
    rest = continuation + rest.substr(place + 1);
  }
  return result + rest;
}

std::string comment_lines(const std::string& text, const std::string& indent) {
  std::string rest = comment_text(text);
  std::string result;
  const std::size_t width = kWidth - indent.size() - 3;
  bool first = true;
  while (!rest.empty()) {
    const std::size_t room = first ? width : width - 2;
    std::size_t cut = rest.size();
    if (rest.size() > room) {
      cut = rest.rfind(' ', room);
      if (cut == std::string::npos || cut == 0) cut = room;
    }
    result += indent + (first ? "// " : "//   ") + rest.substr(0, cut) + "\n";
    rest.erase(0, rest[std::min(cut, rest.size() - 1)] == ' ' ? cut + 1 : cut);
    first = false;
  }
  return result;
}

}  // namespace casimir::codegen
