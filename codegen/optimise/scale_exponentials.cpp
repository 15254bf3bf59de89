#include "codegen/optimise/scale_exponentials.hpp"

#include <vector>

#include "codegen/optimise/program_writer.hpp"

namespace casimir::codegen {
namespace {

/// value * exp(power); none: value.
struct Carried {
  int value = -1;
  std::optional<int> power = {};
};

class Scaler {
 public:
  Scaler(const Program& program, std::size_t states) : program_(program), states_(states) {
    result_.inputs = program.inputs;
    result_.output_names = program.output_names;
  }

  std::optional<Program> run() {
    for (const Instruction& line : program_.code) {
      varies_.push_back(varies(line));
      lines_.push_back(carried(line));
    }
    if (!serves_) return std::nullopt;
    for (const int output : program_.outputs)
      result_.outputs.push_back(plain(lines_[static_cast<std::size_t>(output)]));
    return std::move(result_);
  }

 private:
  static bool is_leaf(Op op) { return op == Op::input || op == Op::constant || op == Op::pi; }

  /// With the states or the time.
  bool varies(const Instruction& line) const {
    const auto of = [&](int i) { return i >= 0 && varies_[static_cast<std::size_t>(i)]; };
    if (line.op == Op::input) {
      const auto i = static_cast<std::size_t>(line.a);
      return i < states_ || i + 1 == program_.inputs.size();
    }
    return !is_leaf(line.op) && (of(line.a) || of(line.b));
  }

  int exp(int u) { return writer_.is_zero(u) ? writer_.number(1) : writer_.emit(Op::exp, u); }
  int half(int u) { return writer_.product(u, writer_.number(cln::cl_RA(1) / 2)); }

  int plain(const Carried& c) {
    return c.power ? writer_.product(c.value, exp(*c.power)) : c.value;
  }

  /// Of what it stands in the exponential may be more than a double holds.
  const Carried& held(const Carried& c) {
    serves_ = serves_ || c.power;
    return c;
  }

  std::optional<int> sum(const std::optional<int>& m, const std::optional<int>& n) {
    return m && n ? writer_.sum(*m, *n) : m ? m : n;
  }

  Carried added(const Carried& a, const Carried& b, bool subtract) {
    const auto joined = [&](int x, int y) {
      return subtract ? writer_.difference(x, y) : writer_.sum(x, y);
    };
    if (a.power == b.power) return {joined(a.value, b.value), a.power};
    const int zero = writer_.number(0), m = a.power.value_or(zero), n = b.power.value_or(zero);
    const int apart = writer_.difference(m, n), size = writer_.emit(Op::abs, apart);
    const int of_a = exp(half(writer_.difference(apart, size)));
    const int of_b = exp(half(writer_.negation(writer_.sum(apart, size))));
    return {joined(writer_.product(a.value, of_a), writer_.product(b.value, of_b)),
            half(writer_.sum(writer_.sum(m, n), size))};
  }

  /// cosh and sinh: (exp(u - |u|) +- exp(-u - |u|))/2 exp(|u|).
  Carried hyperbolic(int u, bool is_sinh) {
    const int size = writer_.emit(Op::abs, u);
    const int right = exp(writer_.difference(u, size));
    const int left = exp(writer_.negation(writer_.sum(u, size)));
    return {half(is_sinh ? writer_.difference(right, left) : writer_.sum(right, left)), size};
  }

  Carried carried(const Instruction& line) {
    if (line.op == Op::constant)
      return {writer_.number(program_.constants[static_cast<std::size_t>(line.a)])};
    if (is_leaf(line.op)) return {writer_.emit(line.op, line.a)};
    const Carried a = lines_[static_cast<std::size_t>(line.a)];
    const Carried b = line.b < 0 ? Carried{} : lines_[static_cast<std::size_t>(line.b)];
    if (!varies_.back()) return {writer_.emit(line.op, a.value, b.value)};
    switch (line.op) {
      case Op::exp:
        return {writer_.number(1), plain(a)};
      case Op::sinh:
      case Op::cosh:
        return hyperbolic(plain(a), line.op == Op::sinh);
      case Op::add:
      case Op::sub:
        return added(a, b, line.op == Op::sub);
      case Op::neg:
        return {writer_.negation(a.value), a.power};
      case Op::mul:
        return {writer_.product(a.value, b.value), sum(a.power, b.power)};
      case Op::div:
        return {writer_.quotient(a.value, held(b).value),
                sum(a.power, b.power ? std::optional(writer_.negation(*b.power)) : std::nullopt)};
      case Op::sqrt:
        return {writer_.emit(Op::sqrt, held(a).value),
                a.power ? std::optional(half(*a.power)) : std::nullopt};
      case Op::pow:
        return {writer_.emit(Op::pow, held(a).value, b.value),
                a.power ? std::optional(writer_.product(*a.power, b.value)) : std::nullopt};
      case Op::log: {
        const int log = writer_.emit(Op::log, held(a).value);
        return {a.power ? writer_.sum(*a.power, log) : log};
      }
      case Op::abs:
        return {writer_.emit(Op::abs, a.value), a.power};
      case Op::sign:
        return {writer_.emit(Op::sign, a.value)};
      default:
        return {writer_.emit(line.op, plain(a), line.b < 0 ? -1 : plain(b))};
    }
  }

  const Program& program_;
  const std::size_t states_;
  Program result_;
  ProgramWriter writer_{result_};
  std::vector<bool> varies_;
  std::vector<Carried> lines_;
  bool serves_ = false;
};

}  // namespace

std::optional<Program> with_scaled_exponentials(const Program& program, std::size_t states) {
  return Scaler(program, states).run();
}

}  // namespace casimir::codegen
