#include "codegen/prepare.hpp"

#include <map>
#include <string>
#include <utility>

#include "codegen/optimise/program_writer.hpp"

namespace casimir::codegen {

namespace {

/// A value as the product of what the parameters decide and of the rest; -1 stands for 1.
struct Factored {
  int ready = -1;  ///< a line of the preparation
  int open = -1;   ///< a line of the rest
};

/// The program under construction that all others share.
class Preparation {
 public:
  Preparation(const Program& like, std::size_t first, std::size_t count) : writer_(program_) {
    const auto begin = like.inputs.begin() + static_cast<std::ptrdiff_t>(first);
    program_.inputs.assign(begin, begin + static_cast<std::ptrdiff_t>(count));
  }

  ProgramWriter& writer() { return writer_; }
  const Instruction& line(int i) const { return program_.code[static_cast<std::size_t>(i)]; }
  const cln::cl_RA& constant(int i) const {
    return program_.constants[static_cast<std::size_t>(i)];
  }

  /// Which output a line is; it becomes one.
  std::size_t output(int i) {
    const auto [place, is_new] = outputs_.try_emplace(i, program_.outputs.size());
    if (is_new) {
      program_.outputs.push_back(i);
      program_.output_names.push_back("k" + std::to_string(program_.outputs.size()));
    }
    return place->second;
  }

  const Program& program() const { return program_; }

 private:
  Program program_;
  ProgramWriter writer_;
  std::map<int, std::size_t> outputs_;
};

/// How often each line is used, by lines and as an output.
std::vector<int> uses_of(const Program& program) {
  std::vector<int> uses(program.code.size());
  for (const Instruction& line : program.code) {
    if (line.op == Op::input || line.op == Op::constant || line.op == Op::pi) continue;
    for (const int operand : {line.a, line.b})
      if (operand >= 0) ++uses[static_cast<std::size_t>(operand)];
  }
  // What is an output has to be there as it is.
  for (const int output : program.outputs) uses[static_cast<std::size_t>(output)] += 2;
  return uses;
}

/// Takes one program apart. The inputs for prepared values are put in when all are known: until
/// then they are numbered from `kReady` on.
class Parting {
 public:
  static constexpr int kReady = 1 << 24;

  Parting(const Program& whole, Preparation& preparation, std::size_t first, std::size_t count)
      : whole_(whole),
        preparation_(preparation),
        first_(static_cast<int>(first)),
        end_(static_cast<int>(first + count)),
        writer_(rest_) {}

  Program run() {
    const std::vector<int> uses = uses_of(whole_);
    for (std::size_t i = 0; i < whole_.code.size(); ++i) {
      Factored value = taken_apart(whole_.code[i]);
      // A product that several lines want is made once, and not by each of them.
      if (value.open >= 0 && value.ready >= 0 && uses[i] > 1) value = {-1, joined(value)};
      values_.push_back(value);
    }
    for (const int output : whole_.outputs) rest_.outputs.push_back(joined(at(output)));
    rest_.output_names = whole_.output_names;
    return std::move(rest_);
  }

 private:
  const Factored& at(int i) const { return values_[static_cast<std::size_t>(i)]; }

  Factored taken_apart(const Instruction& line) {
    ProgramWriter& ready = preparation_.writer();
    switch (line.op) {
      case Op::input:
        return line.a >= first_ && line.a < end_
                   ? Factored{ready.emit(Op::input, line.a - first_), -1}
                   : Factored{-1, writer_.emit(Op::input, line.a)};
      case Op::constant:
        return {ready.number(whole_.constants[static_cast<std::size_t>(line.a)]), -1};
      case Op::pi:
        return {ready.emit(Op::pi), -1};
      default:
        break;
    }
    const Factored a = at(line.a);
    const Factored b = line.b >= 0 ? at(line.b) : Factored{};
    if (line.op == Op::mul) return product(a, b);
    if (line.op == Op::neg && a.open >= 0) return negated(a);
    if (a.open < 0 && b.open < 0) return {of_parameters(line, a.ready, b.ready), -1};
    if (line.op == Op::div && b.open < 0 && ready.constant(b.ready) == nullptr)
      return product(a, {ready.quotient(ready.number(1), b.ready), -1});
    return {-1, of_states(line, joined(a), line.b >= 0 ? joined(b) : -1)};
  }

  Factored product(const Factored& a, const Factored& b) {
    const auto both = [](ProgramWriter& writer, int x, int y) {
      return x < 0 ? y : y < 0 ? x : writer.product(x, y);
    };
    return {both(preparation_.writer(), a.ready, b.ready), both(writer_, a.open, b.open)};
  }

  /// The sign goes to the parameters where there are any.
  Factored negated(const Factored& a) {
    if (a.ready >= 0) return {preparation_.writer().negation(a.ready), a.open};
    return {-1, writer_.negation(a.open)};
  }

  int of_parameters(const Instruction& line, int a, int b) {
    ProgramWriter& ready = preparation_.writer();
    switch (line.op) {
      case Op::add:
        return ready.sum(a, b);
      case Op::sub:
        return ready.difference(a, b);
      case Op::div:
        return ready.quotient(a, b);
      case Op::neg:
        return ready.negation(a);
      default:
        return ready.emit(line.op, a, b);
    }
  }

  int of_states(const Instruction& line, int a, int b) {
    switch (line.op) {
      case Op::add:
        return writer_.sum(a, b);
      case Op::sub:
        return writer_.difference(a, b);
      case Op::div:
        return writer_.quotient(a, b);
      default:
        return writer_.emit(line.op, a, b);
    }
  }

  /// The line of the rest that is the whole value.
  int joined(const Factored& value) {
    if (value.ready < 0) return value.open;
    const int factor = read(value.ready);
    return value.open < 0 ? factor : writer_.product(factor, value.open);
  }

  /// A value of the preparation in the rest: a constant and a parameter are there already.
  int read(int ready) {
    const Instruction line = preparation_.line(ready);
    if (line.op == Op::constant) return writer_.number(preparation_.constant(line.a));
    if (line.op == Op::pi) return writer_.emit(Op::pi);
    if (line.op == Op::input) return writer_.emit(Op::input, line.a + first_);
    if (line.op == Op::neg) return writer_.negation(read(line.a));  // a sign costs nothing
    return writer_.emit(Op::input, kReady + static_cast<int>(preparation_.output(ready)));
  }

  const Program& whole_;
  Preparation& preparation_;
  const int first_, end_;
  Program rest_;
  ProgramWriter writer_;
  std::vector<Factored> values_;
};

/// Leaves out the lines that no output needs: parts of products that became longer ones.
void prune(Program& program) {
  std::vector<bool> needed(program.code.size());
  for (const int output : program.outputs) needed[static_cast<std::size_t>(output)] = true;
  const auto has_operands = [](const Instruction& line) {
    return line.op != Op::input && line.op != Op::constant && line.op != Op::pi;
  };
  for (std::size_t i = program.code.size(); i-- > 0;) {
    const Instruction& line = program.code[i];
    if (!needed[i] || !has_operands(line)) continue;
    for (const int operand : {line.a, line.b})
      if (operand >= 0) needed[static_cast<std::size_t>(operand)] = true;
  }
  std::vector<int> place(program.code.size(), -1);
  std::vector<Instruction> code;
  const auto moved = [&](int i) { return i < 0 ? i : place[static_cast<std::size_t>(i)]; };
  for (std::size_t i = 0; i < program.code.size(); ++i) {
    if (!needed[i]) continue;
    Instruction line = program.code[i];
    if (has_operands(line)) line = {line.op, moved(line.a), moved(line.b)};
    place[i] = static_cast<int>(code.size());
    code.push_back(line);
  }
  program.code = std::move(code);
  for (int& output : program.outputs) output = moved(output);
}

/// Puts the prepared values between the parameters and the time.
void number_inputs(Program& rest, const Program& whole, const Program& prepare) {
  const int before = static_cast<int>(whole.inputs.size()) - 1;
  for (Instruction& line : rest.code) {
    if (line.op != Op::input || line.a < before) continue;
    line.a = line.a >= Parting::kReady ? before + (line.a - Parting::kReady)
                                       : before + static_cast<int>(prepare.outputs.size());
  }
  rest.inputs = whole.inputs;
  rest.inputs.insert(rest.inputs.end() - 1, prepare.output_names.begin(),
                     prepare.output_names.end());
}

}  // namespace

Prepared prepared(const std::vector<Program>& programs, std::size_t first, std::size_t count) {
  Preparation preparation(programs.front(), first, count);
  Prepared result;
  for (const Program& program : programs)
    result.rest.push_back(Parting(program, preparation, first, count).run());
  result.prepare = preparation.program();
  prune(result.prepare);
  for (std::size_t i = 0; i < programs.size(); ++i) {
    prune(result.rest[i]);
    number_inputs(result.rest[i], programs[i], result.prepare);
  }
  return result;
}

}  // namespace casimir::codegen
