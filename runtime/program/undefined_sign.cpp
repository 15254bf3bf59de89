#include "runtime/program/undefined_sign.hpp"

#include "runtime/evaluate.hpp"

namespace casimir {

bool takes_sign_of_zero(const Program& rhs, const std::vector<double>& start,
                        const std::vector<double>& end) {
  Program arguments = rhs;
  arguments.outputs.clear();
  for (const Instruction& line : rhs.code)
    if (line.op == Op::sign) arguments.outputs.push_back(line.a);
  arguments.output_names.assign(arguments.outputs.size(), "");
  if (arguments.outputs.empty()) return false;
  const std::vector<double> first = evaluate(arguments, start), last = evaluate(arguments, end);
  for (std::size_t k = 0; k < first.size(); ++k)
    if (first[k] == 0 && last[k] == 0) return true;
  return false;
}

}  // namespace casimir
