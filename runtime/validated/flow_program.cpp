#include <map>
#include <tuple>

#include "runtime/validated/flow_piece.hpp"

namespace casimir::validated {
namespace {

/// Appends the lines of programs over the same inputs, each once.
class Joiner {
 public:
  explicit Joiner(Program& program) : program_(program) {}

  /// \return  for each line of `other`, that of the joined program.
  std::vector<int> append(const Program& other) {
    std::vector<int> moved;
    for (Instruction line : other.code) {
      if (line.op == Op::constant) {
        line.a = constant(other.constants[static_cast<std::size_t>(line.a)]);
      } else if (line.op != Op::input && line.op != Op::pi) {
        line.a = moved[static_cast<std::size_t>(line.a)];
        if (line.b >= 0) line.b = moved[static_cast<std::size_t>(line.b)];
      }
      const auto [place, is_new] =
          known_.try_emplace({line.op, line.a, line.b}, static_cast<int>(program_.code.size()));
      if (is_new) program_.code.push_back(line);
      moved.push_back(place->second);
    }
    return moved;
  }

 private:
  int constant(const cln::cl_RA& value) {
    for (std::size_t i = 0; i < program_.constants.size(); ++i)
      if (program_.constants[i] == value) return static_cast<int>(i);
    program_.constants.push_back(value);
    return static_cast<int>(program_.constants.size()) - 1;
  }

  Program& program_;
  std::map<std::tuple<Op, int, int>, int> known_;
};

}  // namespace

FlowProgram joined(const Program& rates, const Program& jacobian, const Entries& entries) {
  FlowProgram flow{.rates = rates, .both = {}, .entries = entries, .entry_lines = {}};
  flow.both.inputs = rates.inputs;
  flow.both.output_names = rates.output_names;
  Joiner joiner(flow.both);
  const std::vector<int> of_rates = joiner.append(rates), of_jacobian = joiner.append(jacobian);
  for (const int output : rates.outputs)
    flow.both.outputs.push_back(of_rates[static_cast<std::size_t>(output)]);
  for (const int output : jacobian.outputs)
    flow.entry_lines.push_back(of_jacobian[static_cast<std::size_t>(output)]);
  return flow;
}

}  // namespace casimir::validated
