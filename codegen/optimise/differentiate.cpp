#include "codegen/optimise/differentiate.hpp"

#include <cln/integer.h>

#include <array>
#include <map>
#include <string>

#include "codegen/optimise/lower.hpp"
#include "codegen/optimise/program_writer.hpp"
#include "runtime/program/function_table.hpp"

namespace casimir::codegen {

namespace {

/// A copy of a program, line by line, to which derivatives are appended.
class Derivation {
 public:
  /// \param first_moved  inputs from this one on are `moved` further behind in the result.
  Derivation(const Program& program, std::size_t variables, std::size_t moved = 0)
      : program_(program), variables_(static_cast<int>(variables)), writer_(result_) {
    result_.inputs = program.inputs;
    for (const Instruction& code : program.code) {
      if (code.op == Op::input) {
        const int behind = code.a < variables_ ? 0 : static_cast<int>(moved);
        values_.push_back(writer_.emit(Op::input, code.a + behind));
      } else if (code.op == Op::constant) {
        values_.push_back(writer_.number(program.constants[static_cast<std::size_t>(code.a)]));
      } else {  // Pi has no operand
        values_.push_back(writer_.emit(code.op, code.a < 0 ? -1 : value(code.a),
                                       code.b < 0 ? -1 : value(code.b)));
      }
    }
  }

  /// The derivative of line i by each of its operands, as it stands in the result.
  std::array<int, 2> partials(std::size_t i) {
    const Instruction& code = program_.code[i];
    const int a = value(code.a);
    const int b = code.b < 0 ? -1 : value(code.b);
    const int own = values_[i];
    const int one = writer_.number(1);
    switch (code.op) {
      case Op::add:
        return {one, one};
      case Op::sub:
        return {one, writer_.number(-1)};
      case Op::neg:
        return {writer_.number(-1), -1};
      case Op::mul:
        return {b, a};
      case Op::div:
        return {inverse(b), writer_.negation(writer_.product(own, inverse(b)))};
      case Op::pow: {
        const cln::cl_RA exponent = *writer_.constant(b);
        return {writer_.product(b, power(a, exponent - 1)), -1};
      }
      case Op::abs:
        return {writer_.emit(Op::sign, a), -1};
      case Op::sign:
        return {writer_.number(0), -1};
      case Op::atan2: {  // the angle of the point (b, a)
        const int unit = inverse(writer_.sum(square(a), square(b)));
        return {writer_.product(b, unit), writer_.negation(writer_.product(a, unit))};
      }
      default:
        return {slope(code.op, a, own), -1};
    }
  }

  bool has_operands(std::size_t i) const {
    const Op op = program_.code[i].op;
    return op != Op::input && op != Op::constant && op != Op::pi;
  }

  /// The operands of line i, and -1 for what is none.
  std::array<int, 2> operands(std::size_t i) const {
    const Instruction& code = program_.code[i];
    return {code.a, code.op == Op::pow ? -1 : code.b};
  }

  /// The variable that line i is, or -1.
  int variable(std::size_t i) const {
    const Instruction& code = program_.code[i];
    return code.op == Op::input && code.a < variables_ ? code.a : -1;
  }

  int value(int i) const { return values_[static_cast<std::size_t>(i)]; }
  ProgramWriter& writer() { return writer_; }
  void add_output(int line, std::string name) {
    result_.outputs.push_back(line);
    result_.output_names.push_back(std::move(name));
  }
  Program take() { return without_dead_code(result_); }

  /// The outputs and then their derivatives along deviations of the variables, which are the inputs
  /// behind them. `along` gives that of a line of the program.
  template <class Along>
  Program variational(const Along& along) {
    for (std::size_t k = 0; k < program_.outputs.size(); ++k)
      add_output(value(program_.outputs[k]), program_.output_names[k]);
    for (std::size_t k = 0; k < program_.outputs.size(); ++k) {
      const std::string& name = program_.output_names[k];
      add_output(along(program_.outputs[k]),
                 "ddelta_" + name.substr(name.starts_with('d') ? 1 : 0));
    }
    std::vector<std::string> deviations;
    for (int i = 0; i < variables_; ++i)
      deviations.push_back("delta_" + program_.inputs[static_cast<std::size_t>(i)]);
    result_.inputs.insert(result_.inputs.begin() + variables_, deviations.begin(),
                          deviations.end());
    return take();
  }

 private:
  int inverse(int a) { return writer_.quotient(writer_.number(1), a); }
  int square(int a) { return writer_.product(a, a); }

  /// The derivative of a function of one argument, from its recurrence.
  int slope(Op op, int a, int own) {
    const SeriesStep* step = step_of(op, Slot::value);
    if (step->rule == SeriesRule::root)
      return writer_.quotient(writer_.number(cln::cl_RA(1) / 2), own);
    const int factor = in_slot(op, step->by, a, own);
    const int size = step->rule == SeriesRule::quotient ? inverse(factor) : factor;
    return step->sign < 0 ? writer_.negation(size) : size;
  }

  /// The step of the recurrence of a function that is about a slot.
  static const SeriesStep* step_of(Op op, Slot slot) {
    const SeriesStep* found = nullptr;
    for (const SeriesStep& step : series_steps(op))
      if (own_slot(op, step.target) == slot) found = &step;
    return found;
  }

  /// What a slot of the recurrence of a function is, as a function of the argument.
  int in_slot(Op op, Slot slot, int a, int own) {
    slot = own_slot(op, slot);
    if (slot == Slot::argument) return a;
    if (slot == Slot::value) return own;
    const SeriesStep* step = step_of(op, slot);
    if (step->rule == SeriesRule::integral) return writer_.emit(function_row(op).partner, a);
    const int of = in_slot(op, step->of, a, own);
    if (step->rule == SeriesRule::root) return writer_.emit(Op::sqrt, of);
    const int one = writer_.number(1);
    return step->sign < 0 ? writer_.difference(one, square(of)) : writer_.sum(one, square(of));
  }

  int power(int base, const cln::cl_RA& exponent) {
    if (cln::denominator(exponent) != 1)
      return writer_.emit(Op::pow, base, writer_.number(exponent));
    const int e = cln::cl_I_to_int(cln::numerator(exponent));
    if (e == 0) return writer_.number(1);
    return e > 0 ? writer_.power(base, e) : inverse(writer_.power(base, -e));
  }

  const Program& program_;
  const int variables_;
  Program result_;
  ProgramWriter writer_;
  std::vector<int> values_;  ///< of each line of the program, as a line of the result
};

/// A sum of lines with factors.
using LinearTerms = std::map<int, cln::cl_RA>;

/// The derivatives of each line in some directions; what is missing is zero.
///
/// That of a product of many factors, whatever the order in which they are multiplied, is kept as
/// the terms of the product rule: (a*b)*c has a'*b*c + a*b'*c + a*b*c' and not (a'*b + a*b')*c +
/// .., which hides from the optimiser what the terms have in common.
class Tangents {
 public:
  explicit Tangents(Derivation& derivation) : derivation_(derivation) {}

  /// `seed` gives the direction of an input and the derivative there.
  template <class Seed>
  void run(const Program& program, const Seed& seed) {
    terms_.resize(program.code.size());
    for (std::size_t i = 0; i < program.code.size(); ++i) {
      if (const int variable = derivation_.variable(i); variable >= 0) {
        const auto [direction, line] = seed(variable);
        terms_[i][direction] = {{line, 1}};
      } else if (derivation_.has_operands(i)) {
        differentiate(i, program.code[i].op);
      }
    }
  }

  /// By direction, the derivative of line i as one line.
  std::map<int, int> of(int i) {
    std::map<int, int> result;
    for (const auto& [direction, terms] : at(i)) {
      const int line = total(terms);
      if (!writer().is_zero(line)) result[direction] = line;
    }
    return result;
  }

 private:
  ProgramWriter& writer() { return derivation_.writer(); }
  const std::map<int, LinearTerms>& at(int i) const { return terms_[static_cast<std::size_t>(i)]; }

  void differentiate(std::size_t i, Op op) {
    const bool is_product = op == Op::mul || op == Op::div || op == Op::neg;
    const std::array<int, 2> operands = derivation_.operands(i);
    std::array<int, 2> partials{-1, -1};
    std::map<int, LinearTerms>& own = terms_[i];
    for (std::size_t k = 0; k < 2; ++k) {
      if (operands[k] < 0 || at(operands[k]).empty()) continue;
      if (partials[0] < 0) partials = derivation_.partials(i);
      for (const auto& [direction, terms] : at(operands[k])) {
        const LinearTerms factors = is_product ? terms : LinearTerms{{total(terms), 1}};
        for (const auto& [line, factor] : factors) {
          const auto [place, is_new] =
              own[direction].try_emplace(writer().product(partials[k], line), factor);
          if (!is_new) place->second = place->second + factor;
        }
      }
    }
    for (auto& [direction, terms] : own) {
      if (!is_product) terms = {{total(terms), 1}};
      std::erase_if(terms, [this](const auto& term) {
        return term.second == 0 || writer().is_zero(term.first);
      });
    }
    std::erase_if(own, [](const auto& entry) { return entry.second.empty(); });
  }

  int total(const LinearTerms& terms) {
    int sum = writer().number(0);
    for (const auto& [line, factor] : terms)
      sum = writer().sum(sum, writer().product(writer().number(factor), line));
    return sum;
  }

  Derivation& derivation_;
  std::vector<std::map<int, LinearTerms>> terms_;
};

/// The derivatives by each variable.
Tangents all_tangents(Derivation& derivation, const Program& program) {
  Tangents tangents(derivation);
  tangents.run(program, [&](int variable) {
    return std::pair{variable, derivation.writer().number(1)};
  });
  return tangents;
}

}  // namespace

SparseProgram jacobian(const Program& program, std::size_t variables) {
  Derivation derivation(program, variables);
  Tangents tangents = all_tangents(derivation, program);
  std::vector<std::map<int, int>> rows;
  for (const int output : program.outputs) rows.push_back(tangents.of(output));
  SparseProgram result;
  for (int column = 0; column < static_cast<int>(variables); ++column) {
    for (std::size_t row = 0; row < rows.size(); ++row) {
      const auto entry = rows[row].find(column);
      if (entry == rows[row].end()) continue;
      result.entries.emplace_back(static_cast<int>(row), column);
      derivation.add_output(entry->second, program.output_names[row] + "/d" +
                                               program.inputs[static_cast<std::size_t>(column)]);
    }
  }
  result.program = derivation.take();
  return result;
}

SparseProgram gradients(const Program& program, std::size_t variables) {
  Derivation derivation(program, variables);
  ProgramWriter& writer = derivation.writer();
  std::vector<bool> active;  // depends on a variable
  for (std::size_t i = 0; i < program.code.size(); ++i) {
    bool depends = derivation.variable(i) >= 0;
    if (derivation.has_operands(i)) {
      for (const int operand : derivation.operands(i))
        depends = depends || (operand >= 0 && active[static_cast<std::size_t>(operand)]);
    }
    active.push_back(depends);
  }
  SparseProgram result;
  for (std::size_t k = 0; k < program.outputs.size(); ++k) {
    constexpr int kNone = -1;
    std::vector<int> adjoint(program.code.size(), kNone);  // d output / d line
    std::vector<int> gradient(variables, kNone);
    const auto add = [&](int& sum, int term) { sum = sum == kNone ? term : writer.sum(sum, term); };
    adjoint[static_cast<std::size_t>(program.outputs[k])] = writer.number(1);
    for (std::size_t i = program.code.size(); i-- > 0;) {
      if (adjoint[i] == kNone || !active[i]) continue;
      if (const int variable = derivation.variable(i); variable >= 0) {
        add(gradient[static_cast<std::size_t>(variable)], adjoint[i]);
        continue;
      }
      const std::array<int, 2> partials = derivation.partials(i);
      const std::array<int, 2> operands = derivation.operands(i);
      for (std::size_t o = 0; o < 2; ++o) {
        const auto operand = static_cast<std::size_t>(operands[o]);
        if (operands[o] >= 0 && active[operand])
          add(adjoint[operand], writer.product(adjoint[i], partials[o]));
      }
    }
    for (std::size_t i = 0; i < variables; ++i) {
      if (gradient[i] == kNone || writer.is_zero(gradient[i])) continue;
      result.entries.emplace_back(static_cast<int>(i), static_cast<int>(k));
      derivation.add_output(gradient[i], "d" + program.output_names[k] + "/d" + program.inputs[i]);
    }
  }
  result.program = derivation.take();
  return result;
}

Program variational(const Program& program, std::size_t variables) {
  Derivation derivation(program, variables, variables);
  Tangents tangents(derivation);
  tangents.run(program, [&](int variable) {
    return std::pair{0,
                     derivation.writer().emit(Op::input, static_cast<int>(variables) + variable)};
  });
  return derivation.variational([&](int output) {
    const std::map<int, int> along = tangents.of(output);
    return along.empty() ? derivation.writer().number(0) : along.begin()->second;
  });
}

Program variational_by_columns(const Program& program, std::size_t variables) {
  Derivation derivation(program, variables, variables);
  ProgramWriter& writer = derivation.writer();
  Tangents tangents = all_tangents(derivation, program);
  return derivation.variational([&](int output) {
    int sum = writer.number(0);
    for (const auto& [variable, entry] : tangents.of(output)) {
      const int deviation = writer.emit(Op::input, static_cast<int>(variables) + variable);
      sum = writer.sum(sum, writer.product(entry, deviation));
    }
    return sum;
  });
}

}  // namespace casimir::codegen
