#include "codegen/optimise/lower.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "codegen/optimise/program_writer.hpp"

namespace casimir::codegen {

namespace {

class Lowering {
 public:
  explicit Lowering(const TermSystem& system)
      : system_(system),
        writer_(program_),
        values_(system.variables.size(), -1),
        monomials_with_(system.variables.size(), 0) {}

  Program run(const std::vector<std::string>& inputs, const std::vector<std::string>& outputs) {
    program_.inputs = inputs;
    program_.output_names = outputs;
    std::vector<bool> reached(system_.variables.size(), false);
    for (const int output : system_.outputs) count_uses(output, reached);
    for (const int output : system_.outputs) program_.outputs.push_back(value(output));
    return std::move(program_);
  }

 private:
  const Variable& variable(int v) const { return system_.variables[static_cast<std::size_t>(v)]; }

  bool is_inverse(int v) const {
    return variable(v).kind == Variable::Kind::function && variable(v).function == Op::div;
  }

  void count_uses(int v, std::vector<bool>& reached) {
    if (reached[static_cast<std::size_t>(v)]) return;
    reached[static_cast<std::size_t>(v)] = true;
    for (const int argument : variable(v).arguments) {
      ++monomials_with_[static_cast<std::size_t>(argument)];
      count_uses(argument, reached);
    }
    for (const Term& t : variable(v).value) {
      for (const VariablePower& l : t.monomial) {
        ++monomials_with_[static_cast<std::size_t>(l.variable)];
        count_uses(l.variable, reached);
      }
    }
  }

  int value(int v) {
    int& known = values_[static_cast<std::size_t>(v)];
    if (known < 0) known = new_value(variable(v));
    return known;
  }

  int new_value(const Variable& v) {
    switch (v.kind) {
      case Variable::Kind::input:
        return writer_.emit(Op::input, v.input);
      case Variable::Kind::pi:
        return writer_.emit(Op::pi);
      case Variable::Kind::polynomial:
        return polynomial(v.value);
      case Variable::Kind::function:
        break;
    }
    const int first = value(v.arguments[0]);
    switch (v.function) {
      case Op::div:
        return writer_.emit(Op::div, writer_.number(1), first);
      case Op::pow:
        return writer_.emit(Op::pow, first, writer_.number(v.exponent));
      case Op::atan2:
        return writer_.emit(Op::atan2, first, value(v.arguments[1]));
      default:
        return writer_.emit(v.function, first);
    }
  }

  int polynomial(const Polynomial& terms) {
    if (terms.empty()) return writer_.number(0);
    std::size_t first = 0;
    while (first < terms.size() && cln::minusp(terms[first].coefficient)) ++first;
    if (first == terms.size()) first = 0;
    int result = leading(terms[first]);
    for (std::size_t i = 0; i < terms.size(); ++i) {
      if (i == first) continue;
      const cln::cl_RA& c = terms[i].coefficient;
      result = writer_.emit(cln::minusp(c) ? Op::sub : Op::add, result,
                            term(cln::abs(c), terms[i].monomial));
    }
    return result;
  }

  int leading(const Term& t) {
    const bool has_number = cln::abs(t.coefficient) != 1 || t.monomial.empty();
    if (cln::plusp(t.coefficient) || has_number) return term(t.coefficient, t.monomial);
    return writer_.emit(Op::neg, term(1, t.monomial));
  }

  /// a * b, where a < 0 stands for nothing.
  int joined(int a, int b) { return a < 0 ? b : writer_.emit(Op::mul, a, b); }

  int term(const cln::cl_RA& coefficient, const Monomial& monomial) {
    int above = coefficient == 1 ? -1 : writer_.number(coefficient);
    int below = -1;
    for (const bool constant : {true, false}) {
      for (const VariablePower& l : monomial) {
        if (variable(l.variable).constant != constant) continue;
        if (is_inverse(l.variable) && monomials_with_[static_cast<std::size_t>(l.variable)] == 1) {
          const int base = value(variable(l.variable).arguments[0]);
          below = joined(below, writer_.power(base, l.exponent));
        } else {
          above = joined(above, writer_.power(value(l.variable), l.exponent));
        }
      }
    }
    if (above < 0) above = writer_.number(1);
    return below < 0 ? above : writer_.emit(Op::div, above, below);
  }

  const TermSystem& system_;
  Program program_;
  ProgramWriter writer_;
  std::vector<int> values_;
  std::vector<int> monomials_with_;
};

bool has_operands(Op op) { return op != Op::input && op != Op::constant && op != Op::pi; }

}  // namespace

Program lowered(const TermSystem& system, const std::vector<std::string>& inputs,
                const std::vector<std::string>& outputs) {
  return Lowering(system).run(inputs, outputs);
}

std::vector<bool> constant_instructions(const Program& program) {
  std::vector<bool> result;
  for (const Instruction& i : program.code) {
    bool constant = i.op != Op::input;
    if (has_operands(i.op)) {
      constant = result[static_cast<std::size_t>(i.a)] &&
                 (i.b < 0 || result[static_cast<std::size_t>(i.b)]);
    }
    result.push_back(constant);
  }
  return result;
}

OperationCount count_operations(const Program& program) {
  OperationCount result;
  const std::vector<bool> constant = constant_instructions(program);
  for (std::size_t i = 0; i < program.code.size(); ++i) {
    if (constant[i]) continue;
    switch (program.code[i].op) {
      case Op::input:
      case Op::constant:
      case Op::pi:
        break;
      case Op::mul:
        ++result.mul;
        break;
      case Op::div:
        ++result.div;
        break;
      case Op::add:
      case Op::sub:
      case Op::neg:
        ++result.add;
        break;
      default:
        ++result.calls;
        break;
    }
  }
  return result;
}

int weight(const OperationCount& count) {
  return count.mul + count.add + 5 * count.div + 20 * count.calls;
}

Program without_dead_code(const Program& program) {
  std::vector<bool> live(program.code.size(), false);
  for (const int output : program.outputs) live[static_cast<std::size_t>(output)] = true;
  for (std::size_t i = program.code.size(); i-- > 0;) {
    const Instruction& code = program.code[i];
    if (!live[i] || !has_operands(code.op)) continue;
    live[static_cast<std::size_t>(code.a)] = true;
    if (code.b >= 0) live[static_cast<std::size_t>(code.b)] = true;
  }
  Program result{program.inputs, {}, {}, {}, program.output_names};
  std::vector<int> moved(program.code.size(), -1);
  std::map<int, int> constants;
  for (std::size_t i = 0; i < program.code.size(); ++i) {
    if (!live[i]) continue;
    Instruction code = program.code[i];
    if (code.op == Op::constant) {
      const auto [place, is_new] =
          constants.try_emplace(code.a, static_cast<int>(constants.size()));
      if (is_new) result.constants.push_back(program.constants[static_cast<std::size_t>(code.a)]);
      code.a = place->second;
    } else if (has_operands(code.op)) {
      code.a = moved[static_cast<std::size_t>(code.a)];
      if (code.b >= 0) code.b = moved[static_cast<std::size_t>(code.b)];
    }
    moved[i] = static_cast<int>(result.code.size());
    result.code.push_back(code);
  }
  for (const int output : program.outputs) {
    result.outputs.push_back(moved[static_cast<std::size_t>(output)]);
  }
  return result;
}

Program single_output(const Program& program, std::size_t k) {
  Program one = program;
  one.outputs = {program.outputs[k]};
  one.output_names = {program.output_names[k]};
  return without_dead_code(one);
}

}  // namespace casimir::codegen
