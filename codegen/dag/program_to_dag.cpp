#include "codegen/dag/program_to_dag.hpp"

namespace casimir::codegen {

namespace {

Scaled line(Dag& dag, const Program& program, const Instruction& code,
            const std::vector<Scaled>& values) {
  const auto at = [&](int i) -> const Scaled& { return values[static_cast<std::size_t>(i)]; };
  const auto constant = [&](int i) -> const cln::cl_RA& {
    return program.constants[static_cast<std::size_t>(i)];
  };
  const auto minus = [](const Scaled& e) { return Scaled{-e.coefficient, e.node}; };
  switch (code.op) {
    case Op::input:
      return dag.symbol(code.a);
    case Op::constant:
      return {constant(code.a), Dag::kOne};
    case Op::pi:
      return dag.pi();
    case Op::add:
      return dag.sum({at(code.a), at(code.b)});
    case Op::sub:
      return dag.sum({at(code.a), minus(at(code.b))});
    case Op::neg:
      return minus(at(code.a));
    case Op::mul:
      return dag.product({at(code.a), at(code.b)});
    case Op::div:
      return dag.product({at(code.a), dag.power(at(code.b), -1)});
    case Op::sqrt:
      return dag.power(at(code.a), cln::cl_RA(1) / 2);
    case Op::pow:
      return dag.power(at(code.a), constant(program.code[static_cast<std::size_t>(code.b)].a));
    case Op::abs:
      return dag.power(dag.power(at(code.a), 2), cln::cl_RA(1) / 2);
    case Op::atan2:
      return dag.call(code.op, {at(code.a), at(code.b)});
    default:
      return dag.call(code.op, {at(code.a)});
  }
}

}  // namespace

std::vector<Scaled> lifted(Dag& dag, const Program& program) {
  std::vector<Scaled> values;
  for (const Instruction& code : program.code) values.push_back(line(dag, program, code, values));
  std::vector<Scaled> result;
  for (const int output : program.outputs)
    result.push_back(values[static_cast<std::size_t>(output)]);
  return result;
}

}  // namespace casimir::codegen
