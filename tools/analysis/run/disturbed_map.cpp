#include "tools/analysis/run/disturbed_map.hpp"

#include <cln/dfloat.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "runtime/program/exact_number.hpp"
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

LongerMap::LongerMap(const Program& program, std::vector<long double> parameters)
    : program_(program), parameters_(std::move(parameters)) {
  for (const Instruction& line : program.code)
    value_.push_back(is_literal(line) ? literal_value(program, line, Arithmetic<long double>{})
                                      : 0);
}

void LongerMap::operator()(std::vector<long double>& state) {
  constexpr Arithmetic<long double> arithmetic;
  const std::size_t n = state.size();
  for (std::size_t k = 0; k < value_.size(); ++k) {
    const Instruction& line = program_.code[k];
    if (is_literal(line)) continue;
    if (line.op == Op::input) {
      const auto i = static_cast<std::size_t>(line.a);
      value_[k] = i < n ? state[i] : i - n < parameters_.size() ? parameters_[i - n] : 0;
      continue;
    }
    const auto at = [&](int i) { return value_[static_cast<std::size_t>(i)]; };
    value_[k] = applied(line.op, at(line.a), at(line.b < 0 ? line.a : line.b), arithmetic);
  }
  std::ranges::transform(program_.outputs, state.begin(),
                         [&](int i) { return value_[static_cast<std::size_t>(i)]; });
}

std::optional<Program> with_moved_constants(Program program, std::mt19937_64& random, bool all) {
  constexpr Arithmetic<double> arithmetic;
  const double infinity = std::numeric_limits<double>::infinity();
  std::vector<std::optional<double>> fixed(program.code.size());  // what does not depend on inputs
  bool moved = false;
  const auto move = [&](std::size_t k, double value, double towards) {
    if (!std::isfinite(value) || value == 0 || (!all && random() % 2 == 0)) return;
    const double other = std::nextafter(value, towards);
    fixed[k] = other;
    program.code[k] = {Op::constant, static_cast<int>(program.constants.size())};
    program.constants.push_back(exact_number(other));
    moved = true;
  };
  for (std::size_t k = 0; k < program.code.size(); ++k) {
    const Instruction line = program.code[k];
    if (line.op == Op::input) continue;
    if (is_literal(line)) {
      fixed[k] = literal_value(program, line, arithmetic);
      if (line.op == Op::pi) {
        move(k, *fixed[k], infinity);  // the double is less than Pi
        continue;
      }
      const cln::cl_RA exact = program.constants[static_cast<std::size_t>(line.a)];
      const cln::cl_RA rounded = std::isfinite(*fixed[k]) ? exact_number(*fixed[k]) : exact;
      if (exact != rounded) move(k, *fixed[k], exact > rounded ? infinity : -infinity);
      continue;
    }
    const auto at = [&](int i) { return fixed[static_cast<std::size_t>(i)]; };
    if (!at(line.a) || (line.b >= 0 && !at(line.b))) continue;
    fixed[k] = applied(line.op, *at(line.a), *at(line.b < 0 ? line.a : line.b), arithmetic);
    if (!is_exact(line.op)) move(k, *fixed[k], random() % 2 == 0 ? infinity : -infinity);
  }
  if (!moved) return std::nullopt;
  return program;
}

}  // namespace casimir
