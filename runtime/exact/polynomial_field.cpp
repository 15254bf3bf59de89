#include "runtime/exact/polynomial_field.hpp"

#include <stdexcept>
#include <utility>

#include "runtime/program/operation.hpp"

namespace casimir {
namespace {

using Poly = ExactPolynomial;

/// More terms or a higher degree than any closed form has.
constexpr std::size_t kMostTerms = 100;
constexpr int kMostDegree = 8;

class Reader {
 public:
  explicit Reader(const Program& rhs)
      : rhs_(rhs), arithmetic_(kExactDigits), generators_(3 * rhs.outputs.size()) {}

  std::optional<std::vector<Poly>> read() {
    std::vector<std::optional<Poly>> values;
    for (const Instruction& line : rhs_.code) values.push_back(value_of(line, values));
    std::vector<Poly> rates;
    for (const int output : rhs_.outputs) {
      const auto& rate = values[static_cast<std::size_t>(output)];
      if (!rate) return std::nullopt;
      rates.push_back(*rate);
    }
    return rates;
  }

 private:
  Poly constant(const cln::cl_F& value) const {
    if (cln::zerop(value)) return {};
    return {{std::vector<int>(generators_, 0), value}};
  }
  Poly generator(std::size_t which) const {
    std::vector<int> exponents(generators_, 0);
    exponents[which] = 1;
    return {{exponents, arithmetic_.from(cln::cl_RA(1))}};
  }

  /// The value of a constant; nothing for others.
  std::optional<cln::cl_F> constant_in(const Poly& p) const {
    if (p.empty()) return arithmetic_.from(cln::cl_RA(0));
    if (p.size() > 1) return std::nullopt;
    for (const int e : p.begin()->first)
      if (e != 0) return std::nullopt;
    return p.begin()->second;
  }

  /// The state that it is, or nothing.
  std::optional<std::size_t> state_in(const Poly& p) const {
    for (std::size_t i = 0; i < generators_; i += 3)
      if (p == generator(i)) return i;
    return std::nullopt;
  }

  std::optional<Poly> value_of(const Instruction& line,
                               const std::vector<std::optional<Poly>>& values) const {
    if (is_literal(line)) return constant(literal_value(rhs_, line, arithmetic_));
    if (line.op == Op::input) {
      const auto i = static_cast<std::size_t>(line.a);
      if (i >= rhs_.outputs.size()) return std::nullopt;  // the time, or a parameter
      return generator(3 * i);
    }
    const auto& a = values[static_cast<std::size_t>(line.a)];
    const auto& b = values[static_cast<std::size_t>(line.b < 0 ? line.a : line.b)];
    if (!a || !b) return std::nullopt;
    switch (line.op) {
      case Op::add:
        return sum(*a, *b, 1);
      case Op::sub:
        return sum(*a, *b, -1);
      case Op::neg:
        return sum({}, *a, -1);
      case Op::mul:
        return product(*a, *b);
      default:
        return function(line.op, *a, *b);
    }
  }

  Poly sum(Poly a, const Poly& b, int sign) const {
    for (const auto& [exponents, factor] : b) {
      const cln::cl_F added = sign > 0 ? factor : -factor;
      const auto [at, fresh] = a.try_emplace(exponents, added);
      if (fresh) continue;
      at->second = at->second + added;
      if (cln::zerop(at->second)) a.erase(at);
    }
    return a;
  }

  std::optional<Poly> product(const Poly& a, const Poly& b) const {
    Poly result;
    for (const auto& [u, x] : a)
      for (const auto& [v, y] : b) {
        std::vector<int> exponents(generators_);
        int degree = 0;
        for (std::size_t i = 0; i < generators_; ++i) degree += exponents[i] = u[i] + v[i];
        if (degree > kMostDegree) return std::nullopt;
        result = sum(std::move(result), {{exponents, x * y}}, 1);
        if (result.size() > kMostTerms) return std::nullopt;
      }
    return result;
  }

  std::optional<Poly> function(Op op, const Poly& a, const Poly& b) const {
    const auto of_a = constant_in(a), of_b = constant_in(b);
    try {
      if (of_a && of_b) return constant(applied(op, *of_a, *of_b, arithmetic_));
      if (op == Op::div && of_b)
        return product(a, constant(arithmetic_.divide(arithmetic_.from(cln::cl_RA(1)), *of_b)));
    } catch (const std::domain_error&) {
      return std::nullopt;
    }
    const auto state = state_in(a);
    if (!state || (op != Op::sin && op != Op::cos)) return std::nullopt;
    return generator(*state + (op == Op::sin ? 1 : 2));
  }

  const Program& rhs_;
  const Arithmetic<cln::cl_F> arithmetic_;
  const std::size_t generators_;
};

}  // namespace

std::optional<std::vector<ExactPolynomial>> polynomial_field(const Program& rhs) {
  return Reader(rhs).read();
}

}  // namespace casimir
