#include "runtime/taylor/program_leading.hpp"

#include <algorithm>
#include <limits>

namespace casimir {
namespace {

/// From so many steps on their rounding is more than a hundred times that of one, and a step that
/// is rounded less costs two to three times as much.
constexpr unsigned long long kLongRun = 30'000;

std::vector<long double> numbers_between(const Program& rhs, const double* parameters) {
  const std::size_t count = rhs.inputs.size() - rhs.outputs.size() - 1;
  return count == 0 ? std::vector<long double>{}
                    : std::vector<long double>(parameters, parameters + count);
}

}  // namespace

bool ProgramLeading::serves(const Program& rhs) {
  if (std::numeric_limits<long double>::digits <= std::numeric_limits<double>::digits) return false;
  return std::none_of(rhs.code.begin(), rhs.code.end(), [](const Instruction& line) {
    return line.op == Op::abs || line.op == Op::sign || line.op == Op::atan2 ||
           line.op == Op::asin || line.op == Op::acos;
  });
}

ProgramLeading::ProgramLeading(const Program& rhs, const double* parameters)
    : jet_(rhs, Arithmetic<long double>{}, numbers_between(rhs, parameters), CASIMIR_LEADING),
      state_(rhs.outputs.size()) {}

casimir_leading ProgramLeading::view() const { return {this, kLongRun, &add}; }

void ProgramLeading::add(const void* object, double t, double unit, double s, double* x,
                         double* carry, const double* tail) {
  const auto& self = *static_cast<const ProgramLeading*>(object);
  const std::size_t states = self.state_.size();
  for (std::size_t i = 0; i < states; ++i)
    self.state_[i] = static_cast<long double>(x[i]) + static_cast<long double>(carry[i]);
  const auto& series = self.jet_.expand(t, self.state_, unit);
  for (std::size_t i = 0; i < states; ++i) {
    long double sum = tail[i];
    for (std::size_t k = CASIMIR_LEADING; k > 0; --k) sum = series[i][k] + sum * s;
    sum *= s;
    // x + carry + sum, with nothing lost but what is beyond the digits of the carry.
    const auto high = static_cast<double>(sum);
    const double next = x[i] + high, part = next - x[i];
    const double lost = (x[i] - (next - part)) + (high - part);
    const double low = lost + (carry[i] + static_cast<double>(sum - high));
    x[i] = next + low;
    carry[i] = low - (x[i] - next);
  }
}

}  // namespace casimir
