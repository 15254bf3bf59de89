#pragma once

#include <cassert>
#include <vector>

#include "runtime/number.hpp"
#include "runtime/program.hpp"

namespace casimir {

/// The Taylor coefficients of the solution of dx/dt = program(x, t) at a point, by the recurrence
/// of each operation (automatic differentiation; Moore, Methods and Applications of Interval
/// Analysis, 1979, Sec. 3.4). Every instruction of the program keeps its own series, so one
/// coefficient of the solution costs one pass, and order N costs O(N^2) operations in all.
///
/// The program is a right-hand side: its inputs are the states, then parameters, then the time.
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
    for (int k = 0; k <= order; ++k) integers_.push_back(arithmetic_.from(cln::cl_RA(k)));
    const auto lines = program.code.size();
    series_.resize(lines);
    first_auxiliary_.resize(lines);
    second_auxiliary_.resize(lines);
    for (const Instruction& line : program.code) constant_.push_back(is_constant(line));
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
    states_.assign(x.size(), {});
    for (std::size_t i = 0; i < x.size(); ++i) states_[i].push_back(x[i]);
    for (auto* store : {&series_, &first_auxiliary_, &second_auxiliary_}) {
      for (std::vector<Number>& s : *store) s.clear();
    }
    for (int k = 0; k < order_; ++k) {
      for (std::size_t i = 0; i < program_.code.size(); ++i) extend(i, k, t);
      for (std::size_t i = 0; i < x.size(); ++i) {
        const Number& rate =
            series_[static_cast<std::size_t>(program_.outputs[i])][static_cast<std::size_t>(k)];
        states_[i].push_back(unit_ * (rate / integer(k + 1)));
      }
    }
    return states_;
  }

 private:
  using Series = std::vector<Number>;

  const Number& integer(int k) const { return integers_[static_cast<std::size_t>(k)]; }

  bool is_constant(const Instruction& line) const {
    if (line.op == Op::constant || line.op == Op::pi) return true;
    if (line.op == Op::input)
      return line.a >= static_cast<int>(program_.outputs.size()) &&
             line.a + 1 < static_cast<int>(program_.inputs.size());
    return constant_[static_cast<std::size_t>(line.a)] &&
           (line.b < 0 || constant_[static_cast<std::size_t>(line.b)]);
  }

  Number zero() const { return integers_[0]; }

  /// sum over j = from..to of u_j v_{k-j}
  Number convolution(const Series& u, const Series& v, int k, int from, int to) const {
    Number sum = zero();
    for (int j = from; j <= to; ++j)
      sum = sum + u[static_cast<std::size_t>(j)] * v[static_cast<std::size_t>(k - j)];
    return sum;
  }

  /// sum over j = from..to of j u_j v_{k-j}
  Number weighted(const Series& u, const Series& v, int k, int from, int to) const {
    Number sum = zero();
    for (int j = from; j <= to; ++j)
      sum = sum + integer(j) * u[static_cast<std::size_t>(j)] * v[static_cast<std::size_t>(k - j)];
    return sum;
  }

  Number input(int index, int k, const Number& t) const {
    const int states = static_cast<int>(states_.size());
    if (index < states)
      return states_[static_cast<std::size_t>(index)][static_cast<std::size_t>(k)];
    if (index + 1 < static_cast<int>(program_.inputs.size()))
      return k == 0 ? parameters_[static_cast<std::size_t>(index - states)] : zero();
    return k == 0 ? t : k == 1 ? unit_ : zero();
  }

  /// Appends coefficient k to the series of instruction i.
  void extend(std::size_t i, int k, const Number& t) {
    const Instruction& line = program_.code[i];
    Series& s = series_[i];
    if (k > 0 && constant_[i]) {
      s.push_back(zero());
      return;
    }
    const Series* const a = line.op > Op::pi ? &series_[static_cast<std::size_t>(line.a)] : nullptr;
    const Series* const b = line.b >= 0 ? &series_[static_cast<std::size_t>(line.b)] : nullptr;
    const auto n = static_cast<std::size_t>(k);
    switch (line.op) {
      case Op::input:
        s.push_back(input(line.a, k, t));
        break;
      case Op::constant:
        s.push_back(arithmetic_.from(program_.constants[static_cast<std::size_t>(line.a)]));
        break;
      case Op::pi:
        s.push_back(arithmetic_.pi());
        break;
      case Op::add:
        s.push_back((*a)[n] + (*b)[n]);
        break;
      case Op::sub:
        s.push_back((*a)[n] - (*b)[n]);
        break;
      case Op::neg:
        s.push_back(-(*a)[n]);
        break;
      case Op::mul:
        if (constant_[static_cast<std::size_t>(line.a)])
          s.push_back((*a)[0] * (*b)[n]);
        else if (constant_[static_cast<std::size_t>(line.b)])
          s.push_back((*a)[n] * (*b)[0]);
        else
          s.push_back(convolution(*a, *b, k, 0, k));
        break;
      case Op::div:
        if (constant_[static_cast<std::size_t>(line.b)])
          s.push_back(arithmetic_.divide((*a)[n], (*b)[0]));
        else
          s.push_back(arithmetic_.divide((*a)[n] - convolution(*b, s, k, 1, k), (*b)[0]));
        break;
      default:
        s.push_back(k == 0 ? start_function(i, line) : next_function(i, line, *a, b, k));
        break;
    }
  }

  /// The value of a function, and of its auxiliary series.
  Number start_function(std::size_t i, const Instruction& line) {
    const Arithmetic<Number>& m = arithmetic_;
    const Number a = series_[static_cast<std::size_t>(line.a)][0];
    const Number one = integers_.size() > 1 ? integer(1) : m.from(cln::cl_RA(1));
    Series& u = first_auxiliary_[i];
    Series& w = second_auxiliary_[i];
    switch (line.op) {
      case Op::sqrt:
        return m.sqrt(a);
      case Op::pow:
        return m.power(a, exponent(line));
      case Op::exp:
        return m.exp(a);
      case Op::log:
        return m.log(a);
      case Op::sin:
        u.push_back(m.cos(a));
        return m.sin(a);
      case Op::cos:
        u.push_back(m.sin(a));
        return m.cos(a);
      case Op::tan: {
        const Number tangent = m.tan(a);
        u.push_back(one + tangent * tangent);
        return tangent;
      }
      case Op::asin:
      case Op::acos:
        w.push_back(one - a * a);
        u.push_back(m.sqrt(w[0]));
        return line.op == Op::asin ? m.asin(a) : m.acos(a);
      case Op::atan2: {
        const Number x = series_[static_cast<std::size_t>(line.b)][0];
        u.push_back(x * x + a * a);
        return m.atan2(a, x);
      }
      default:
        assert(false);
        return a;
    }
  }

  const cln::cl_RA& exponent(const Instruction& line) const {
    return program_
        .constants[static_cast<std::size_t>(program_.code[static_cast<std::size_t>(line.b)].a)];
  }

  /// Coefficient k > 0 of a function of the series a (and, for atan2, of x = b).
  Number next_function(std::size_t i, const Instruction& line, const Series& a, const Series* b,
                       int k) {
    const auto n = static_cast<std::size_t>(k);
    Series& s = series_[i];
    Series& u = first_auxiliary_[i];
    Series& w = second_auxiliary_[i];
    const Number two = integer(1) + integer(1);
    switch (line.op) {
      case Op::sqrt:
        return arithmetic_.divide(a[n] - convolution(s, s, k, 1, k - 1), two * s[0]);
      case Op::pow: {
        // a s' = e a' s
        const Number e = arithmetic_.from(exponent(line));
        return arithmetic_.divide(e * weighted(a, s, k, 1, k) - weighted(s, a, k, 1, k - 1),
                                  integer(k) * a[0]);
      }
      case Op::exp:
        return weighted(a, s, k, 1, k) / integer(k);
      case Op::log:
        return arithmetic_.divide(integer(k) * a[n] - weighted(s, a, k, 1, k - 1),
                                  integer(k) * a[0]);
      case Op::sin: {
        const Number next = weighted(a, u, k, 1, k) / integer(k);
        u.push_back(-(weighted(a, s, k, 1, k) / integer(k)));
        return next;
      }
      case Op::cos: {
        const Number next = -(weighted(a, u, k, 1, k) / integer(k));
        u.push_back(weighted(a, s, k, 1, k) / integer(k));
        return next;
      }
      case Op::tan: {
        // s' = (1 + s^2) a', and u = 1 + s^2 needs the new coefficient of s
        const Number next = weighted(a, u, k, 1, k) / integer(k);
        u.push_back(convolution(s, s, k, 1, k - 1) + two * s[0] * next);
        return next;
      }
      case Op::asin:
      case Op::acos: {
        // u = sqrt(1 - a^2), u s' = +-a'
        w.push_back(-convolution(a, a, k, 0, k));
        u.push_back(arithmetic_.divide(w[n] - convolution(u, u, k, 1, k - 1), two * u[0]));
        const Number slope = line.op == Op::asin ? a[n] : -a[n];
        return arithmetic_.divide(integer(k) * slope - weighted(s, u, k, 1, k - 1),
                                  integer(k) * u[0]);
      }
      case Op::atan2: {
        // r s' = x y' - y x', r = x^2 + y^2
        const Series& x = *b;
        u.push_back(convolution(x, x, k, 0, k) + convolution(a, a, k, 0, k));
        return arithmetic_.divide(
            weighted(a, x, k, 1, k) - weighted(x, a, k, 1, k) - weighted(s, u, k, 1, k - 1),
            integer(k) * u[0]);
      }
      default:
        assert(false);
        return a[n];
    }
  }

  const Program& program_;
  Arithmetic<Number> arithmetic_;
  Series parameters_;
  int order_;
  Series integers_;
  Number unit_;
  std::vector<Series> states_;
  std::vector<Series> series_, first_auxiliary_, second_auxiliary_;
  std::vector<bool> constant_;
};

}  // namespace casimir
