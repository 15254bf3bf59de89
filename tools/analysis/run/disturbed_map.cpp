#include "tools/analysis/run/disturbed_map.hpp"

#include <algorithm>
#include <limits>

#include "runtime/program/number.hpp"
#include "runtime/program/operation.hpp"

namespace casimir {
namespace {

/// Whether the result of an operation is exact.
bool is_exact(Op op) { return op == Op::neg || op == Op::abs || op == Op::sign; }

}  // namespace

void DisturbedMap::operator()(const std::vector<double>& state,
                              const std::vector<double>& parameters, std::mt19937_64& random,
                              std::vector<double>& next) {
  constexpr double kOneUnit = std::numeric_limits<double>::epsilon();
  constexpr Arithmetic<double> arithmetic;
  const std::size_t n = state.size();
  std::uint64_t bits = 0;
  for (std::size_t k = 0; k < value_.size(); ++k) {
    const Instruction& line = program_.code[k];
    if (line.op == Op::input) {
      const auto i = static_cast<std::size_t>(line.a);
      value_[k] = i < n ? state[i] : i - n < parameters.size() ? parameters[i - n] : 0;
      continue;
    }
    if (is_literal(line)) {
      value_[k] = literal_value(program_, line, arithmetic);
      continue;
    }
    const auto at = [&](int i) { return value_[static_cast<std::size_t>(i)]; };
    value_[k] = applied(line.op, at(line.a), at(line.b < 0 ? line.a : line.b), arithmetic);
    if (is_exact(line.op)) continue;
    if (bits == 0) bits = random() | std::uint64_t{1} << 63;
    value_[k] *= bits % 2 == 0 ? 1 + kOneUnit : 1 - kOneUnit;
    bits >>= 1;
  }
  std::ranges::transform(program_.outputs, next.begin(),
                         [&](int i) { return value_[static_cast<std::size_t>(i)]; });
}

}  // namespace casimir
