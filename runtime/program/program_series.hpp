#pragma once

#include <cassert>
#include <type_traits>
#include <utility>
#include <vector>

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
      helpers_.push_back(has_helpers(line.op) ? static_cast<int>(helper_series_.size()) : -1);
      if (has_helpers(line.op)) helper_series_.insert(helper_series_.end(), 2, empty);
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
  void begin_order(int k) const {
    if constexpr (kHasSums) arithmetic_.begin_order(k);
  }

  bool may_be_singular(const Instruction& line) const {
    switch (line.op) {
      case Op::div:
        return !constant_[index(line.b)];
      case Op::pow:
      case Op::sqrt:
      case Op::log:
      case Op::tan:
      case Op::asin:
      case Op::acos:
      case Op::atan2:
        return true;
      default:
        return false;
    }
  }

  static std::size_t index(int i) { return static_cast<std::size_t>(i); }
  const Number& integer(int k) const { return integers_[index(k)]; }
  const Series& of(int line) const { return series_[index(line)]; }

  /// Whether the recurrence of the operation needs series of its own beside the result.
  static bool has_helpers(Op op) {
    return op == Op::sin || op == Op::cos || op == Op::tan || op == Op::asin || op == Op::acos ||
           op == Op::atan2 || op == Op::abs;
  }
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
    for (std::size_t i = 0; i < states_.size(); ++i)
      states_[i][index(k + 1)] = unit_ * (of(program_.outputs[i])[index(k)] / integer(k + 1));
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
    const Arithmetic<Number>& m = arithmetic_;
    const Number &a = of(line.a)[0], &one = integer(1);
    Number &u = helper(i, 0)[0], &w = helper(i, 1)[0];
    switch (line.op) {
      case Op::sin:
        u = m.cos(a);
        break;
      case Op::cos:
        u = m.sin(a);
        break;
      case Op::tan:
        u = one + series_[i][0] * series_[i][0];
        break;
      case Op::abs:
        u = side_of(a);
        break;
      case Op::atan2:
        u = of(line.b)[0] * of(line.b)[0] + a * a;
        break;
      default:  // asin, acos
        w = one - a * a;
        u = m.sqrt(w);
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
        next = next_of_function(i, line, a, b, k);
    }
  }

  /// Coefficient k > 0 of a function of the series a (and, for atan2, of x = b).
  Number next_of_function(std::size_t i, const Instruction& line, const Series& a, const Series& b,
                          int k) {
    const Series& s = series_[i];
    const std::size_t n = index(k);
    const Number &at_k = integer(k), &two = integer(2);
    switch (line.op) {
      case Op::sqrt:
        return arithmetic_.divide(a[n] - convolution(s, s, k, 1, k - 1), two * s[0]);
      case Op::pow:  // a s' = e a' s
        return arithmetic_.divide(b[0] * weighted(a, s, k, 1, k) - weighted(s, a, k, 1, k - 1),
                                  at_k * a[0]);
      case Op::exp:
        return weighted(a, s, k, 1, k) / at_k;
      case Op::sign:
        return integer(0);
      case Op::log:
        return arithmetic_.divide(at_k * a[n] - weighted(s, a, k, 1, k - 1), at_k * a[0]);
      default:
        return next_with_helpers(i, line, a, b, k);
    }
  }

  Number next_with_helpers(std::size_t i, const Instruction& line, const Series& a, const Series& b,
                           int k) {
    const Series& s = series_[i];
    Series &u = helper(i, 0), &w = helper(i, 1);
    const std::size_t n = index(k);
    const Number &at_k = integer(k), &two = integer(2);
    switch (line.op) {
      case Op::sin: {
        const Number next = weighted(a, u, k, 1, k) / at_k;
        u[n] = -(weighted(a, s, k, 1, k) / at_k);
        return next;
      }
      case Op::cos: {
        const Number next = -(weighted(a, u, k, 1, k) / at_k);
        u[n] = weighted(a, s, k, 1, k) / at_k;
        return next;
      }
      case Op::tan: {
        // s' = (1 + s^2) a', and u = 1 + s^2 needs the new coefficient of s
        const Number next = weighted(a, u, k, 1, k) / at_k;
        u[n] = convolution(s, s, k, 1, k - 1) + two * s[0] * next;
        return next;
      }
      case Op::abs:  // where it begins at zero, the first term that is not says on which side
        if (arithmetic_.sign(u[0]) == 0) u[0] = side_of(a[n]);
        return u[0] * a[n];
      case Op::atan2:
        // r s' = x y' - y x', r = x^2 + y^2
        u[n] = convolution(b, b, k, 0, k) + convolution(a, a, k, 0, k);
        return arithmetic_.divide(
            weighted(a, b, k, 1, k) - weighted(b, a, k, 1, k) - weighted(s, u, k, 1, k - 1),
            at_k * u[0]);
      default: {  // asin, acos: u = sqrt(1 - a^2), u s' = +-a'
        w[n] = -convolution(a, a, k, 0, k);
        u[n] = arithmetic_.divide(w[n] - convolution(u, u, k, 1, k - 1), two * u[0]);
        const Number slope = line.op == Op::asin ? a[n] : -a[n];
        return arithmetic_.divide(at_k * slope - weighted(s, u, k, 1, k - 1), at_k * u[0]);
      }
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
  std::vector<bool> constant_;         ///< free of states and time
  bool constants_known_ = false;
};

}  // namespace casimir
