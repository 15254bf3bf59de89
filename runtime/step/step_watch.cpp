#include "runtime/step/step_watch.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <cmath>

#include "runtime/evaluate.hpp"
#include "runtime/program/operation.hpp"

namespace casimir {
namespace {

/// Lower powers are seen by any method.
constexpr int kHighPower = 10;
/// Degrees of what is divided by, from which on a peak may have no tail that is seen from afar:
/// that of area 1 and width w is w^(n-1)/d^n at the distance d.
constexpr double kDeep = 4, kDeepWithin = 2;

std::size_t index(int i) { return static_cast<std::size_t>(i); }

bool has_operands(const Instruction& line) { return line.op != Op::input && !is_literal(line); }

/// Which lines depend on the states or the time.
std::vector<bool> varying(const Program& rhs) {
  const auto states = static_cast<int>(rhs.outputs.size());
  const auto inputs = static_cast<int>(rhs.inputs.size());
  std::vector<bool> result;
  for (const Instruction& line : rhs.code) {
    if (line.op == Op::input)
      result.push_back(line.a < states || line.a + 1 == inputs);
    else
      result.push_back(has_operands(line) &&
                       (result[index(line.a)] || (line.b >= 0 && result[index(line.b)])));
  }
  return result;
}

/// For each line the line and the exponent that it is a power of; itself and 1 if of none.
std::vector<std::pair<int, int>> powers_of(const Program& program) {
  constexpr int kMost = (1 << 20) - 1;  // odd: no square by mistake
  std::vector<std::pair<int, int>> result;
  for (std::size_t i = 0; i < program.code.size(); ++i) {
    const Instruction& line = program.code[i];
    result.emplace_back(static_cast<int>(i), 1);
    if (line.op != Op::mul) continue;
    const auto &a = result[index(line.a)], &b = result[index(line.b)];
    if (a.first == b.first) result.back() = {a.first, std::min(a.second + b.second, kMost)};
  }
  return result;
}

/// Which lines are nowhere negative, whatever the inputs: sums of squares and what is made of them.
std::vector<bool> nowhere_negative(const Program& rhs) {
  const Arithmetic<double> arithmetic;
  const auto powers = powers_of(rhs);
  std::vector<bool> result;
  for (std::size_t i = 0; i < rhs.code.size(); ++i) {
    const Instruction& line = rhs.code[i];
    const auto operands = [&] {
      return result[index(line.a)] && (line.b < 0 || result[index(line.b)]);
    };
    bool is = false;
    switch (line.op) {
      case Op::input:
      case Op::neg:
      case Op::sub:
      case Op::sign:
        break;
      case Op::abs:
      case Op::cosh:
      case Op::exp:
      case Op::sqrt:
      case Op::acos:
        is = true;
        break;
      case Op::mul:
        is = operands() || powers[i].second % 2 == 0;
        break;
      case Op::add:
      case Op::div:
        is = operands();
        break;
      case Op::pow:
        is = result[index(line.a)];
        break;
      default:
        is = is_literal(line) && literal_value(rhs, line, arithmetic) >= 0;
    }
    result.push_back(is);
  }
  return result;
}

/// The program without the lines that no output needs.
Program pruned(const Program& program) {
  std::vector<bool> live(program.code.size(), false);
  for (const int output : program.outputs) live[index(output)] = true;
  for (std::size_t i = program.code.size(); i-- > 0;) {
    const Instruction& line = program.code[i];
    if (!live[i] || !has_operands(line)) continue;
    live[index(line.a)] = true;
    if (line.b >= 0) live[index(line.b)] = true;
  }
  Program result = program;
  result.code.clear();
  std::vector<int> moved(program.code.size(), -1);
  for (std::size_t i = 0; i < program.code.size(); ++i) {
    if (!live[i]) continue;
    Instruction line = program.code[i];
    if (has_operands(line)) {
      line.a = moved[index(line.a)];
      if (line.b >= 0) line.b = moved[index(line.b)];
    }
    moved[i] = static_cast<int>(result.code.size());
    result.code.push_back(line);
  }
  for (int& output : result.outputs) output = moved[index(output)];
  return result;
}

/// The degree of each line as a polynomial of those that are given a degree.
/// \param degrees  of these lines, and 0 of all others
std::vector<double> with_degrees(const Program& rhs, std::vector<double> degrees) {
  for (std::size_t i = 0; i < rhs.code.size(); ++i) {
    const Instruction& line = rhs.code[i];
    if (degrees[i] > 0 || !has_operands(line)) continue;
    const double a = degrees[index(line.a)], b = line.b < 0 ? 0 : degrees[index(line.b)];
    switch (line.op) {
      case Op::add:
      case Op::sub:
      case Op::atan2:
        degrees[i] = std::max(a, b);
        break;
      case Op::mul:
        degrees[i] = a + b;
        break;
      case Op::sqrt:
        degrees[i] = a / 2;
        break;
      default:
        degrees[i] = a;
    }
  }
  return degrees;
}

/// The degree of each line as a polynomial of the states, the time and functions of them.
std::vector<double> degrees(const Program& rhs, const std::vector<bool>& varies) {
  std::vector<double> atoms(rhs.code.size(), 0.);
  for (std::size_t i = 0; i < rhs.code.size(); ++i) {
    const Op op = rhs.code[i].op;
    const bool is_arithmetic = op == Op::add || op == Op::sub || op == Op::mul || op == Op::div ||
                               op == Op::neg || op == Op::abs || op == Op::sqrt;
    if (varies[i] && !is_arithmetic) atoms[i] = 1;
  }
  return with_degrees(rhs, std::move(atoms));
}

/// The power to which a line is raised in the equations.
double highest_power(const Program& rhs, std::size_t of) {
  std::vector<double> atoms(rhs.code.size(), 0.);
  atoms[of] = 1;
  const std::vector<double> degrees = with_degrees(rhs, std::move(atoms));
  double highest = 1;
  for (const int output : rhs.outputs) highest = std::max(highest, degrees[index(output)]);
  return highest;
}

/// The exponent of a broken power.
double exponent_of(const Program& rhs, const Instruction& line) {
  return literal_value(rhs, rhs.code[index(line.b)], Arithmetic<double>{});
}

/// Takes 1/u^n apart: the powers of lines that are no products themselves.
/// \param powers  of all lines up to u; on return of what stands in the denominator.
void split_divisor(const Program& rhs, std::vector<double>& powers) {
  for (std::size_t i = powers.size(); i-- > 0;) {
    const Instruction& line = rhs.code[i];
    const double n = powers[i];
    if (n == 0 || !has_operands(line)) continue;
    double left = 0, right = 0;
    switch (line.op) {
      case Op::mul:
        left = right = n;
        break;
      case Op::div:
      case Op::neg:
      case Op::abs:
        left = n;
        break;
      case Op::sqrt:
        left = n / 2;
        break;
      case Op::pow:
        left = n * std::max(exponent_of(rhs, line), 0.);
        break;
      case Op::exp:  // watched as what it is
      case Op::cosh:
        break;
      default:
        continue;
    }
    powers[i] = 0;
    if (left > 0) powers[index(line.a)] += left;
    if (right > 0) powers[index(line.b)] += right;
  }
}

/// The logarithm of the product of all numbers above 1, and no more than a double may hold.
double log_of_numbers(const Program& rhs) {
  constexpr double kMost = 660;
  double sum = 0;
  for (const Instruction& line : rhs.code) {
    if (!is_literal(line)) continue;
    const double size = std::abs(literal_value(rhs, line, Arithmetic<double>{}));
    sum += std::log(std::max(size, 1.));
  }
  return std::min(sum, kMost);
}

/// How far a number is from 1, as a logarithm; nothing for those that everybody has.
double extremeness(double number) {
  constexpr double kUsual = 3.5;
  const double size = std::abs(std::log(std::abs(number)));
  return std::isfinite(size) && size > kUsual ? size : 0;
}

double extremeness_of_literals(const Program& rhs) {
  double sum = 0;
  for (const Instruction& line : rhs.code)
    if (is_literal(line)) sum += extremeness(literal_value(rhs, line, Arithmetic<double>{}));
  return sum;
}

}  // namespace

StepWatch::StepWatch(const Program& rhs)
    : arguments_(rhs),
      log_of_factors_(log_of_numbers(rhs)),
      log_of_extremes_(extremeness_of_literals(rhs)),
      states_(rhs.outputs.size()) {
  arguments_.outputs.clear();
  arguments_.output_names.clear();
  const std::vector<bool> varies = varying(rhs);
  watch_branches(rhs, varies);
  watch_powers(rhs, varies);
  watch_divisors(rhs, varies, within_arguments(false));
  watch_near_kinks(rhs, varies);
  watch_phases(varies);
  find_signed_divisors(rhs);
  arguments_ = pruned(arguments_);
}

bool StepWatch::is_extreme(const double* parameters, const double* state) const {
  constexpr double kFrom = 18.4;  // of a factor of 10^8
  double sum = log_of_extremes_;
  for (std::size_t i = states_; parameters && i + 1 < arguments_.inputs.size(); ++i)
    sum += extremeness(parameters[i - states_]);
  for (std::size_t i = 0; state && i < states_; ++i) sum += extremeness(state[i]);
  return sum > kFrom;
}

bool StepWatch::looks(const double* parameters, const double* state) const {
  if (watched_.empty()) return false;
  const auto is_faint = [](const Watched& watched) { return watched.faint; };
  return !std::ranges::all_of(watched_, is_faint) || is_extreme(parameters, state);
}

void StepWatch::take_compiled(void* object, const std::shared_ptr<void>& open) {
  auto* const count = reinterpret_cast<int (*)()>(dlsym(object, "casimir_watched_count"));
  auto* const values = reinterpret_cast<Values*>(dlsym(object, "casimir_watched"));
  if (!count || !values || count() != static_cast<int>(arguments_.outputs.size())) return;
  compiled_ = values;
  open_ = open;
}

/// Which lines the arguments depend on that are watched, or are so whatever the numbers.
std::vector<bool> StepWatch::within_arguments(bool faint_too) const {
  std::vector<bool> within(arguments_.code.size(), false);
  for (const Watched& watched : watched_) {
    if (watched.faint && !faint_too) continue;
    within[index(arguments_.outputs[watched.place])] = true;
    if (watched.kind == Kind::turn) within[index(arguments_.outputs[watched.place + 1])] = true;
  }
  for (std::size_t i = within.size(); i-- > 0;) {
    const Instruction& line = arguments_.code[i];
    if (!within[i] || !has_operands(line)) continue;
    within[index(line.a)] = true;
    if (line.b >= 0) within[index(line.b)] = true;
  }
  return within;
}

void StepWatch::watch_branches(const Program& rhs, const std::vector<bool>& varies) {
  const std::vector<bool> positive = nowhere_negative(rhs);
  for (std::size_t i = 0; i < rhs.code.size(); ++i) {
    const Instruction& line = rhs.code[i];
    if (!varies[i] || !has_operands(line)) continue;
    switch (line.op) {
      case Op::abs:
        watch(Kind::side, {line.a});
        break;
      case Op::sign:
        watch(Kind::jump, {line.a});
        break;
      case Op::atan2:
        watch(Kind::turn, {line.a, line.b});
        break;
      case Op::sqrt:
      case Op::log:
      case Op::pow:
        if (!positive[index(line.a)]) watch(Kind::positive, {line.a});
        break;
      case Op::asin:
      case Op::acos:
        watch(Kind::unit, {line.a});
        break;
      case Op::exp:
        watch(Kind::exponent, {line.a});
        break;
      case Op::sinh:
      case Op::cosh:
        watch(Kind::both, {line.a});
        break;
      case Op::tanh:
        watch(Kind::front, {line.a});
        break;
      default:
        break;
    }
  }
}

void StepWatch::watch_powers(const Program& rhs, const std::vector<bool>& varies) {
  std::vector<int> highest(rhs.code.size(), 1);
  for (const auto& [base, exponent] : powers_of(rhs))
    highest[index(base)] = std::max(highest[index(base)], exponent);
  for (std::size_t i = 0; i < rhs.code.size(); ++i)
    if (varies[i] && highest[i] >= kHighPower)
      watch(Kind::power, {static_cast<int>(i)}, highest[i]);
  for (std::size_t i = 0; i < rhs.code.size(); ++i) {
    const Instruction& line = rhs.code[i];
    if (line.op == Op::pow && varies[i] && exponent_of(rhs, line) >= kHighPower)
      watch(Kind::power, {line.a}, exponent_of(rhs, line));
  }
}

/// Those that any method sees from afar, see `kDeep`, where numbers are extreme only. In the
/// argument of a function they may be seen as little as that is.
void StepWatch::watch_divisors(const Program& rhs, const std::vector<bool>& varies,
                               const std::vector<bool>& watched) {
  const std::vector<double> degree = degrees(rhs, varies);
  const auto enough = [&](std::size_t i) { return watched[i] ? kDeepWithin : kDeep; };
  for (std::size_t i = 0; i < rhs.code.size(); ++i) {
    const Instruction& line = rhs.code[i];
    if (!varies[i] || !has_operands(line)) continue;
    if (line.op == Op::tan) {
      const double power = highest_power(rhs, i);
      arguments_.code.push_back({Op::cos, line.a});
      watch(Kind::divisor, {static_cast<int>(arguments_.code.size()) - 1}, power, power < enough(i))
          .pole = true;
    }
    const double power = line.op == Op::div ? 1 : line.op == Op::pow ? -exponent_of(rhs, line) : 0;
    if (!(power > 0)) continue;
    std::vector<double> powers(i, 0.);
    powers[index(line.op == Op::div ? line.b : line.a)] = power * highest_power(rhs, i);
    split_divisor(rhs, powers);
    for (std::size_t base = 0; base < i; ++base) {
      if (powers[base] == 0 || !varies[base]) continue;
      watch(Kind::divisor, {static_cast<int>(base)}, powers[base],
            powers[base] * degree[base] < enough(i))
          .pole = true;
    }
  }
}

/// Where roots, logarithms and angles are nearly singular they turn as a kink does, on a way that
/// is as short as a small number in their argument makes it: sqrt(x^2 + 10^(-20)).
void StepWatch::watch_near_kinks(const Program& rhs, const std::vector<bool>& varies) {
  const auto put = [&](Op op, int a, int b = -1) {
    arguments_.code.push_back({op, a, b});
    return static_cast<int>(arguments_.code.size()) - 1;
  };
  for (std::size_t i = 0; i < rhs.code.size(); ++i) {
    const Instruction& line = rhs.code[i];
    if (!varies[i] || !has_operands(line)) continue;
    if (line.op == Op::sqrt || line.op == Op::log || line.op == Op::pow)
      watch(Kind::divisor, {line.a}, 1, true);
    if (line.op == Op::atan2)
      watch(Kind::divisor,
            {put(Op::add, put(Op::mul, line.a, line.a), put(Op::mul, line.b, line.b))}, 1, true);
  }
}

/// \param varies  of the equations' lines; those that were added behind them do.
void StepWatch::watch_phases(const std::vector<bool>& varies) {
  const std::vector<bool> within = within_arguments(true), always = within_arguments(false);
  for (std::size_t i = 0; i < within.size(); ++i) {
    const Instruction& line = arguments_.code[i];
    if (!within[i] || (i < varies.size() && !varies[i])) continue;
    if (line.op == Op::sin || line.op == Op::cos || line.op == Op::tan)
      watch(Kind::phase, {line.a}, 1, !always[i]);
  }
}

/// Behind all others, while the lines of the right-hand side have their places.
void StepWatch::find_signed_divisors(const Program& rhs) {
  const std::vector<bool> positive = nowhere_negative(arguments_);
  rates_and_divisors_ = arguments_;
  rates_and_divisors_.outputs = rhs.outputs;
  rates_and_divisors_.output_names = rhs.output_names;
  for (const Watched& watched : watched_) {
    const int line = arguments_.outputs[watched.place];
    if (!watched.pole || positive[index(line)]) continue;
    signed_divisors_.push_back(watched.place);
    rates_and_divisors_.outputs.push_back(line);
    rates_and_divisors_.output_names.push_back(arguments_.output_names[watched.place]);
  }
  rates_and_divisors_ = signed_divisors_.empty() ? Program{} : pruned(rates_and_divisors_);
}

StepWatch::Watched& StepWatch::watch(Kind kind, const std::vector<int>& lines, double exponent,
                                     bool faint) {
  for (Watched& known : watched_) {
    if (known.kind != kind || arguments_.outputs[known.place] != lines[0] ||
        (lines.size() > 1 && arguments_.outputs[known.place + 1] != lines[1]))
      continue;
    known.exponent = std::max(known.exponent, exponent);
    known.faint = known.faint && faint;
    return known;
  }
  const std::size_t place = arguments_.outputs.size();
  for (const int line : lines) {
    arguments_.outputs.push_back(line);
    arguments_.output_names.push_back("u" + std::to_string(arguments_.outputs.size()));
  }
  return watched_.emplace_back(Watched{kind, place, exponent, faint});
}

std::shared_ptr<const StepWatch> watch_of_object(const Program& rhs, const std::string& path) {
  auto watch = std::make_shared<StepWatch>(rhs);
  if (watch->empty()) return nullptr;
  const std::shared_ptr<void> object(dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL), [](void* open) {
    if (open) dlclose(open);
  });
  if (object) watch->take_compiled(object.get(), object);
  return watch;
}

}  // namespace casimir
