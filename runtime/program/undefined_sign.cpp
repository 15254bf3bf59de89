#include "runtime/program/undefined_sign.hpp"

#include <algorithm>

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
  // At an end, and where its rates lead from there: what leaves comes back to 0 perhaps.
  const double way = (end.back() - start.back()) / 1024;
  std::vector<bool> zero(arguments.outputs.size(), true);
  for (const std::vector<double>& at : {start, end}) {
    const std::vector<double> rates = evaluate(rhs, at);
    for (const double share : {0., way, -way}) {
      std::vector<double> place = at;
      for (std::size_t i = 0; i < rates.size(); ++i) place[i] += share * rates[i];
      place.back() += share;
      const std::vector<double> values = evaluate(arguments, place);
      for (std::size_t k = 0; k < values.size(); ++k) zero[k] = zero[k] && values[k] == 0;
    }
  }
  return std::ranges::find(zero, true) != zero.end();
}

}  // namespace casimir
