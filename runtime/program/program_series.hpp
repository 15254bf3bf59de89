#pragma once

#include <cassert>
#include <type_traits>
#include <utility>
#include <vector>

#include "runtime/program/function_table.hpp"
#include "runtime/program/operation.hpp"

namespace casimir {

/// The Taylor coefficients of the solution of dx/dt = program(x, t) at a point, by the recurrence
/// of each operation (automatic differentiation; Moore, Methods and Applications of Interval
/// Analysis, 1979, Sec. 3.4). Every instruction of the program keeps its own series, so one
/// coefficient of the solution costs one pass, and order N costs O(N^2) operations in all.
///
/// The program is a right-hand side: its inputs are the states, then parameters, then the time. It
/// must live as long as this object. Over doubles `expand` neither allocates nor throws.
template <class Number>
class TaylorJet {
 public:
  /// \param parameters  values of the inputs between the states and the time.
  TaylorJet(const Program& program, Arithmetic<Number> arithmetic, std::vector<Number> parameters,
            int order)
      : program_(program),
        arithmetic_(std::move(arithmetic)),
        parameters_(std::move(parameters)),
        order_(order),
        unit_(arithmetic_.from(cln::cl_RA(1))) {
    assert(program.outputs.size() + parameters_.size() + 1 == program.inputs.size());
    for (int k = 0; k <= order + 1; ++k) integers_.push_back(arithmetic_.from(cln::cl_RA(k)));
    const Series empty(static_cast<std::size_t>(order) + 1, integers_[0]);
    states_.assign(program.outputs.size(), empty);
    series_.assign(program.code.size(), empty);
    for (const Instruction& line : program.code) {
      constant_.push_back(is_constant(line));
      const bool helped = is_function(line.op) && has_helpers(line.op);
      helpers_.push_back(helped ? static_cast<int>(helper_series_.size()) : -1);
      if (helped) helper_series_.insert(helper_series_.end(), 2, empty);
    }
  }

  /// Coefficients [state][k], k = 0..order, of x(t + h) = sum_k coefficient_k h^k.
  /// \throws std::domain_error  where the arithmetic refuses.
  const std::vector<std::vector<Number>>& expand(const Number& t, const std::vector<Number>& x) {
    return expand(t, x, integer(1));
  }

  /// The same with h in another unit of time: x(t + h unit) = sum_k coefficient_k h^k.
  const std::vector<std::vector<Number>>& expand(const Number& t, const std::vector<Number>& x,
                                                 const Number& unit) {
    unit_ = unit;
    begin_order(0);
    if (!constants_known_) find_constants();
    for (std::size_t i = 0; i < x.size(); ++i) states_[i][0] = x[i];
    for (std::size_t i = 0; i < program_.code.size(); ++i) {
      if (!constant_[i]) begin(i, t);
    }
    advance(0);
    for (int k = 1; k < order_; ++k) {
      begin_order(k);
      for (std::size_t i = 0; i < program_.code.size(); ++i) {
        if (!constant_[i]) extend(i, k);
      }
      advance(k);
    }
    begin_order(0);
    return states_;
  }

  /// The series of a line of the program, from the last expansion: all but its last coefficient.
  /// The reference stays good as long as this object.
  const std::vector<Number>& series_of(int line) const { return of(line); }

  /// The series of the last expansion that can end sooner than those of the states: of operations
  /// that have singularities of their own.
  std::vector<const std::vector<Number>*> singular_series() const {
    std::vector<const std::vector<Number>*> result;
    for (std::size_t i = 0; i < program_.code.size(); ++i) {
      if (!constant_[i] && may_be_singular(program_.code[i])) result.push_back(&series_[i]);
    }
    return result;
  }

 private:
  using Series = std::vector<Number>;

  /// Whether the arithmetic has scalar products of its own, and wants to know the order.
  static constexpr bool kHasSums = requires(const Arithmetic<Number>& m, const Series& s) {
    m.convolution(s, s, 0, 0, 0);
    m.weighted(s, s, 0, 0, 0);
    m.begin_order(0);
  };
  /// Whether it has quotients by whole numbers of its own.
  static constexpr bool kHasQuotients = requires(const Arithmetic<Number>& m, const Number& a) {
    m.over(a, 1);
  };
  void begin_order(int k) const {
    if constexpr (kHasSums) arithmetic_.begin_order(k);
  }

  bool may_be_singular(const Instruction& line) const {
    if (line.op == Op::div) return !constant_[index(line.b)];
    return is_function(line.op) && function_row(line.op).singular;
  }

  static std::size_t index(int i) { return static_cast<std::size_t>(i); }
  const Number& integer(int k) const { return integers_[index(k)]; }
  const Series& of(int line) const { return series_[index(line)]; }

  Series& helper(std::size_t line, int which) {
    return helper_series_[index(helpers_[line] + which)];
  }

  bool is_constant(const Instruction& line) const {
    if (is_literal(line)) return true;
    if (line.op == Op::input)
      return line.a >= static_cast<int>(program_.outputs.size()) &&
             line.a + 1 < static_cast<int>(program_.inputs.size());
    return constant_[index(line.a)] && (line.b < 0 || constant_[index(line.b)]);
  }

  /// The values of what is free of states and time; their other coefficients stay zero.
  void find_constants() {
    for (std::size_t i = 0; i < program_.code.size(); ++i) {
      const Instruction& line = program_.code[i];
      if (!constant_[i]) continue;
      series_[i][0] = is_literal(line)       ? literal_value(program_, line, arithmetic_)
                      : line.op == Op::input ? parameters_[index(line.a) - program_.outputs.size()]
                                             : value_of(line);
    }
    constants_known_ = true;
  }

  Number value_of(const Instruction& line) const {
    return applied(line.op, of(line.a)[0], of(line.b < 0 ? line.a : line.b)[0], arithmetic_);
  }

  /// Coefficient k + 1 of the states, from coefficient k of the rates.
  void advance(int k) {
    if (k == order_) return;
    for (std::size_t i = 0; i < states_.size(); ++i) {
      const Number& rate = of(program_.outputs[i])[index(k)];
      if constexpr (kHasQuotients)
        states_[i][index(k + 1)] = unit_ * arithmetic_.over(rate, k + 1);
      else
        states_[i][index(k + 1)] = unit_ * (rate / integer(k + 1));
    }
  }

  /// sum over j = from..to of u_j v_{k-j}
  Number convolution(const Series& u, const Series& v, int k, int from, int to) const {
    if constexpr (kHasSums) return arithmetic_.convolution(u, v, k, from, to);
    return sum_of(from, to, [&](int j) -> Number { return u[index(j)] * v[index(k - j)]; });
  }

  /// sum over j = from..to of j u_j v_{k-j}
  Number weighted(const Series& u, const Series& v, int k, int from, int to) const {
    if constexpr (kHasSums) return arithmetic_.weighted(u, v, k, from, to);
    return sum_of(from, to,
                  [&](int j) -> Number { return integer(j) * u[index(j)] * v[index(k - j)]; });
  }

  template <class Term>
  Number sum_of(int from, int to, Term term) const {
    Number sum = integers_[0];
    int j = from;
    if constexpr (std::is_floating_point_v<Number>) {
      // The processor need not wait for one addition before it begins the next.
      Number second = 0, third = 0, fourth = 0;
      for (; j + 3 <= to; j += 4) {
        sum += term(j);
        second += term(j + 1);
        third += term(j + 2);
        fourth += term(j + 3);
      }
      sum = (sum + second) + (third + fourth);
    }
    for (; j <= to; ++j) sum = sum + term(j);
    return sum;
  }

  Number side_of(const Number& a) const {
    return arithmetic_.from(cln::cl_RA(arithmetic_.sign(a)));
  }

  /// The value of instruction i, and where its recurrence begins.
  void begin(std::size_t i, const Number& t) {
    const Instruction& line = program_.code[i];
    if (line.op == Op::input) {
      const bool is_state = index(line.a) < states_.size();
      series_[i][0] = is_state ? states_[index(line.a)][0] : t;
      return;
    }
    series_[i][0] = value_of(line);
    if (helpers_[i] < 0) return;
    for (const SeriesStep& step : series_steps(line.op)) begin_helper(i, line, step);
  }

  /// The value of the helper that a step of the recurrence of instruction i is about.
  void begin_helper(std::size_t i, const Instruction& line, const SeriesStep& step) {
    const Arithmetic<Number>& m = arithmetic_;
    const Number& a = of(line.a)[0];
    if (step.rule == SeriesRule::angle) {
      helper(i, 0)[0] = of(line.b)[0] * of(line.b)[0] + a * a;
      return;
    }
    if (step.rule == SeriesRule::side) {
      helper(i, 0)[0] = side_of(a);
      return;
    }
    Series& target = at(i, line, step.target);
    if (&target == &series_[i]) return;
    const Number &of_it = at(i, line, step.of)[0], &one = integer(1);
    if (step.rule == SeriesRule::squares)
      target[0] = step.sign < 0 ? one - of_it * of_it : one + of_it * of_it;
    else if (step.rule == SeriesRule::root)
      target[0] = m.sqrt(of_it);
    else
      target[0] = m.function(function_row(line.op).partner, a);
  }

  /// The series in a slot of the recurrence of instruction i.
  Series& at(std::size_t i, const Instruction& line, Slot slot) {
    switch (own_slot(line.op, slot)) {
      case Slot::argument:
        return series_[index(line.a)];
      case Slot::second:
        return series_[index(line.b)];
      case Slot::value:
        return series_[i];
      case Slot::helper:
        return helper(i, 0);
      default:
        return helper(i, 1);
    }
  }

  /// Coefficient k > 0 of the series of instruction i.
  void extend(std::size_t i, int k) {
    const Instruction& line = program_.code[i];
    const std::size_t n = index(k);
    Number& next = series_[i][n];
    if (line.op == Op::input) {
      const bool is_state = index(line.a) < states_.size();
      next = is_state ? states_[index(line.a)][n] : k == 1 ? unit_ : integer(0);
      return;
    }
    const Series &a = of(line.a), &b = of(line.b < 0 ? line.a : line.b);
    switch (line.op) {
      case Op::add:
        next = a[n] + b[n];
        break;
      case Op::sub:
        next = a[n] - b[n];
        break;
      case Op::neg:
        next = -a[n];
        break;
      case Op::mul:
        next = constant_[index(line.a)]   ? a[0] * b[n]
               : constant_[index(line.b)] ? a[n] * b[0]
                                          : convolution(a, b, k, 0, k);
        break;
      case Op::div:
        next = constant_[index(line.b)]
                   ? arithmetic_.divide(a[n], b[0])
                   : arithmetic_.divide(a[n] - convolution(b, series_[i], k, 1, k), b[0]);
        break;
      default:
        for (const SeriesStep& step : series_steps(line.op)) extend(i, line, step, k);
    }
  }

  /// Coefficient k > 0 of the series that a step of a recurrence is about.
  void extend(std::size_t i, const Instruction& line, const SeriesStep& step, int k) {
    const std::size_t n = index(k);
    Series& y = at(i, line, step.target);
    const Series &a = at(i, line, step.of), &f = at(i, line, step.by);
    const Number &at_k = integer(k), &two = integer(2);
    const auto with_sign = [&](const Number& value) { return step.sign < 0 ? -value : value; };
    switch (step.rule) {
      case SeriesRule::integral:
        y[n] = with_sign(weighted(a, f, k, 1, k) / at_k);
        break;
      case SeriesRule::quotient:
        y[n] =
            arithmetic_.divide(at_k * with_sign(a[n]) - weighted(y, f, k, 1, k - 1), at_k * f[0]);
        break;
      case SeriesRule::root:
        y[n] = arithmetic_.divide(a[n] - convolution(y, y, k, 1, k - 1), two * y[0]);
        break;
      case SeriesRule::squares:
        // Of the function's own series, whose last coefficient is new, in the order of a
        // recurrence that has all others already.
        y[n] = with_sign(step.of == Slot::value ? convolution(a, a, k, 1, k - 1) + two * a[0] * a[n]
                                                : convolution(a, a, k, 0, k));
        break;
      default:
        extend_alone(i, line, step.rule, k);
    }
  }

  /// The same by a rule of one function.
  void extend_alone(std::size_t i, const Instruction& line, SeriesRule rule, int k) {
    const Series &a = of(line.a), &b = of(line.b < 0 ? line.a : line.b);
    Series& y = series_[i];
    const std::size_t n = index(k);
    const Number& at_k = integer(k);
    if (rule == SeriesRule::power) {
      y[n] = arithmetic_.divide(b[0] * weighted(a, y, k, 1, k) - weighted(y, a, k, 1, k - 1),
                                at_k * a[0]);
    } else if (rule == SeriesRule::constant) {
      y[n] = integer(0);
    } else if (rule == SeriesRule::side) {
      // Where it begins at zero, the first term that is not says on which side.
      Series& u = helper(i, 0);
      if (arithmetic_.sign(u[0]) == 0) u[0] = side_of(a[n]);
      y[n] = u[0] * a[n];
    } else {
      Series& r = helper(i, 0);
      r[n] = convolution(b, b, k, 0, k) + convolution(a, a, k, 0, k);
      y[n] = arithmetic_.divide(
          weighted(a, b, k, 1, k) - weighted(b, a, k, 1, k) - weighted(y, r, k, 1, k - 1),
          at_k * r[0]);
    }
  }

  const Program& program_;
  Arithmetic<Number> arithmetic_;
  Series parameters_;
  int order_;
  Series integers_;
  Number unit_;
  std::vector<Series> states_;
  std::vector<Series> series_;         ///< of each line
  std::vector<Series> helper_series_;  ///< two for each line that needs them ..
  std::vector<int> helpers_;           ///< .. and where they begin, or -1
  std::vector<char> constant_;         ///< 1: free of states and time; bits would be slow to read
  bool constants_known_ = false;
};

}  // namespace casimir
