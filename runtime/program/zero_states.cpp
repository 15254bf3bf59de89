#include "runtime/program/zero_states.hpp"

#include <cln/integer.h>
#include <cln/rational.h>

#include <algorithm>
#include <cstdint>
#include <random>

namespace casimir {
namespace {

/// The value of a line at a point where the states of S vanish.
struct Seen {
  std::uint64_t value = 0;
  bool sees = false;  ///< a state of S is among what it is made of
  bool known = true;  ///< false: not smooth in S, or not to be had modulo this prime
};

/// One evaluation modulo a prime below 2^31, functions being random numbers.
class RandomPoint {
 public:
  RandomPoint(const Program& rhs, const std::vector<bool>& zero, std::uint64_t prime, unsigned seed)
      : rhs_(rhs), prime_(prime), random_(seed) {
    for (const Instruction& line : rhs.code) lines_.push_back(seen(line, zero));
  }

  /// Whether a rate is smooth and vanishes here.
  bool vanishes(std::size_t state) const {
    const Seen& rate = lines_[static_cast<std::size_t>(rhs_.outputs[state])];
    return rate.known && rate.value == 0;
  }

 private:
  Seen at(int line) const { return lines_[static_cast<std::size_t>(line)]; }
  std::uint64_t any() { return random_() % prime_; }

  std::uint64_t power(std::uint64_t base, std::uint64_t exponent) const {
    std::uint64_t result = 1;
    for (; exponent > 0; exponent /= 2) {
      if (exponent % 2 == 1) result = result * base % prime_;
      base = base * base % prime_;
    }
    return result;
  }

  Seen quotient(const Seen& a, const Seen& b) const {
    return {a.value * power(b.value, prime_ - 2) % prime_, a.sees || b.sees,
            a.known && b.known && b.value != 0};
  }

  Seen number(const cln::cl_RA& value) const {
    const auto part = [&](const cln::cl_I& whole) {
      const cln::cl_I rest = cln::mod(whole, cln::cl_I(static_cast<unsigned long>(prime_)));
      return Seen{static_cast<std::uint64_t>(cln::cl_I_to_ulong(rest))};
    };
    return quotient(part(cln::numerator(value)), part(cln::denominator(value)));
  }

  /// Of a function that is analytic on the whole line.
  Seen entire(const Seen& a, std::uint64_t at_zero) {
    return {a.value == 0 ? at_zero : any(), a.sees, a.known};
  }

  Seen seen(const Instruction& line, const std::vector<bool>& zero) {
    switch (line.op) {
      case Op::input: {
        const auto input = static_cast<std::size_t>(line.a);
        if (input < zero.size() && zero[input]) return {0, true};
        return {any()};
      }
      case Op::constant:
        return number(rhs_.constants[static_cast<std::size_t>(line.a)]);
      case Op::pi:
        return {any()};
      case Op::neg:
        return {(prime_ - at(line.a).value) % prime_, at(line.a).sees, at(line.a).known};
      case Op::sin:
      case Op::sinh:
      case Op::tanh:
        return entire(at(line.a), 0);
      case Op::cos:
      case Op::cosh:
      case Op::exp:
        return entire(at(line.a), 1);
      default:
        break;
    }
    const Seen a = at(line.a), b = line.b < 0 ? Seen{} : at(line.b);
    const bool sees = a.sees || b.sees, known = a.known && b.known;
    switch (line.op) {
      case Op::add:
        return {(a.value + b.value) % prime_, sees, known};
      case Op::sub:
        return {(a.value + prime_ - b.value) % prime_, sees, known};
      case Op::mul:
        return {a.value * b.value % prime_, sees, known};
      case Op::div:
        return quotient(a, b);
      default:  // may have an edge
        return {any(), sees, known && !sees};
    }
  }

  const Program& rhs_;
  const std::uint64_t prime_;
  std::mt19937 random_;
  std::vector<Seen> lines_;
};

constexpr std::uint64_t kPrimes[] = {2147483647, 2147483629};
constexpr unsigned kPoints = 8;

}  // namespace

std::vector<std::size_t> states_that_stay_zero(const Program& rhs,
                                               const std::vector<bool>& zero_at_start) {
  std::vector<bool> zero = zero_at_start;
  for (bool changed = true; changed;) {
    changed = false;
    if (std::ranges::find(zero, true) == zero.end()) break;
    for (unsigned k = 0; k < 2 * kPoints && !changed; ++k) {
      const RandomPoint point(rhs, zero, kPrimes[k % 2], k);
      for (std::size_t i = 0; i < zero.size(); ++i) {
        if (!zero[i] || point.vanishes(i)) continue;
        zero[i] = false;
        changed = true;
      }
    }
  }
  std::vector<std::size_t> states;
  for (std::size_t i = 0; i < zero.size(); ++i)
    if (zero[i]) states.push_back(i);
  return states;
}

Program at_rest(Program rhs, const std::vector<std::size_t>& states) {
  if (states.empty()) return rhs;
  rhs.constants.emplace_back(0);
  rhs.code.push_back({Op::constant, static_cast<int>(rhs.constants.size()) - 1});
  for (const std::size_t state : states) rhs.outputs[state] = static_cast<int>(rhs.code.size()) - 1;
  return rhs;
}

}  // namespace casimir
