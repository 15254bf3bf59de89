#include "codegen/quadratic.hpp"

#include <cln/float.h>
#include <cln/real.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "codegen/emit/number_literal.hpp"
#include "codegen/optimise/lower.hpp"
#include "runtime/program/exact_number.hpp"

namespace casimir {
namespace {

constexpr int kOne = -1;  // in place of a state: the factor 1

/// A polynomial of degree two: coefficients of the products of two of 1, x_1, .., x_n.
using Polynomial = std::map<std::pair<int, int>, cln::cl_RA>;

bool is_constant(const Polynomial& p) {
  return std::all_of(p.begin(), p.end(),
                     [](const auto& term) { return term.first.second == kOne; });
}

cln::cl_RA constant_of(const Polynomial& p) {
  return p.empty() ? cln::cl_RA(0) : p.begin()->second;
}

Polynomial constant(const cln::cl_RA& value) {
  Polynomial p;
  if (value != 0) p[{kOne, kOne}] = value;
  return p;
}

Polynomial sum(Polynomial a, const Polynomial& b, int sign) {
  for (const auto& [product, factor] : b) {
    cln::cl_RA& total = a[product];
    total = sign > 0 ? total + factor : total - factor;
    if (total == 0) a.erase(product);
  }
  return a;
}

/// Nothing if the degree of the product is more than two.
std::optional<Polynomial> product(const Polynomial& a, const Polynomial& b) {
  Polynomial result;
  for (const auto& [u, x] : a) {
    for (const auto& [v, y] : b) {
      std::array<int, 4> states = {u.first, u.second, v.first, v.second};
      std::sort(states.begin(), states.end());
      if (states[1] != kOne) return std::nullopt;
      result = sum(std::move(result), {{{states[2], states[3]}, x * y}}, 1);
    }
  }
  return result;
}

/// The parameters as numbers of the program: what depends on them alone is then constant.
Program with_numbers(Program program, const std::vector<double>& parameters) {
  const std::size_t states = program.outputs.size();
  for (Instruction& code : program.code) {
    if (code.op != Op::input || code.a < static_cast<int>(states)) continue;
    const std::size_t parameter = static_cast<std::size_t>(code.a) - states;
    if (parameter >= parameters.size()) continue;  // the time
    code = {Op::constant, static_cast<int>(program.constants.size()), -1};
    program.constants.push_back(exact_number(parameters[parameter]));
  }
  return codegen::without_dead_code(program);
}

double lost_by_rounding(const cln::cl_RA& exact, double rounded) {
  if (!std::isfinite(rounded)) return 0;
  return nearest_double(exact - exact_number(rounded));
}

class QuadraticExpander {
 public:
  QuadraticExpander(const Program& program, const Limits& limits)
      : program_(program), limits_(limits), constant_(codegen::constant_instructions(program)) {}

  /// The polynomial of each output.
  std::optional<std::vector<Polynomial>> run() {
    for (std::size_t i = 0; i < program_.code.size(); ++i) {
      // Roots of constants and the like are rounded far beyond double.
      std::optional<Polynomial> value =
          constant_[i] ? constant(codegen::constant_value(program_, static_cast<int>(i), limits_))
                       : line(program_.code[i]);
      if (!value) return std::nullopt;
      values_.push_back(std::move(*value));
    }
    std::vector<Polynomial> outputs;
    for (const int output : program_.outputs) outputs.push_back(at(output));
    return outputs;
  }

 private:
  const Polynomial& at(int i) const { return values_[static_cast<std::size_t>(i)]; }

  std::optional<Polynomial> line(const Instruction& code) const {
    switch (code.op) {
      case Op::input:
        if (code.a >= static_cast<int>(program_.outputs.size())) return std::nullopt;  // the time
        return Polynomial{{{kOne, code.a}, 1}};
      case Op::add:
        return sum(at(code.a), at(code.b), 1);
      case Op::sub:
        return sum(at(code.a), at(code.b), -1);
      case Op::neg:
        return sum({}, at(code.a), -1);
      case Op::mul:
        return product(at(code.a), at(code.b));
      case Op::div:
        if (!is_constant(at(code.b)) || at(code.b).empty()) return std::nullopt;
        return product(at(code.a), constant(1 / constant_of(at(code.b))));
      default:
        return std::nullopt;
    }
  }

  const Program& program_;
  const Limits& limits_;
  const std::vector<bool> constant_;
  std::vector<Polynomial> values_;
};

}  // namespace

std::optional<QuadraticForm> quadratic_form(const Program& rhs, const Limits& limits,
                                            const std::vector<double>& parameters) {
  const auto rates = QuadraticExpander(with_numbers(rhs, parameters), limits).run();
  if (!rates) return std::nullopt;
  const std::size_t n = rates->size();
  QuadraticForm form;
  form.states = static_cast<int>(n);
  form.constant.resize(n);
  form.linear.assign(n, std::vector<double>(n));
  form.constant_rest = form.constant;
  form.linear_rest = form.linear;
  std::map<std::pair<int, int>, std::pair<std::vector<double>, std::vector<double>>> products;
  for (std::size_t i = 0; i < n; ++i) {
    for (const auto& [states, exact] : (*rates)[i]) {
      const double factor = nearest_double(exact), rest = lost_by_rounding(exact, factor);
      if (states.second == kOne) {
        form.constant[i] = factor;
        form.constant_rest[i] = rest;
      } else if (states.first == kOne) {
        form.linear[i][static_cast<std::size_t>(states.second)] = factor;
        form.linear_rest[i][static_cast<std::size_t>(states.second)] = rest;
      } else {
        auto& [factors, rests] = products[states];
        factors.resize(n);
        rests.resize(n);
        factors[i] = factor;
        rests[i] = rest;
      }
    }
  }
  for (auto& [states, factors] : products)
    form.products.push_back(
        {states.first, states.second, std::move(factors.first), std::move(factors.second)});
  return form;
}

}  // namespace casimir
