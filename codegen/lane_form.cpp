// The form of a right-hand side for ensembles: its polynomials, and the layout of their products.
#include "codegen/lane_form.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <tuple>
#include <utility>

#include "codegen/emit/number_literal.hpp"
#include "codegen/optimise/lower.hpp"

namespace casimir {
namespace {

constexpr int kNoState = -1;  // in place of a state: the factor 1

/// A number that does not depend on the states: exact, or a line of the program of numbers.
struct Number {
  cln::cl_RA exact = 0;
  int line = -1;
  bool is_exact() const { return line < 0; }
  bool is_zero() const { return is_exact() && exact == 0; }
};

/// Writes the program of numbers, every value once.
class NumberWriter {
 public:
  explicit NumberWriter(std::vector<std::string> parameters) {
    program_.inputs = std::move(parameters);
  }

  Number input(int parameter) { return {0, line(Op::input, parameter, -1)}; }

  Number combined(Op op, const Number& a, const Number& b) {
    if (a.is_exact() && b.is_exact()) {
      if (op == Op::add) return {a.exact + b.exact};
      if (op == Op::sub) return {a.exact - b.exact};
      if (op == Op::mul) return {a.exact * b.exact};
      if (op == Op::div) return {a.exact / b.exact};
    }
    if ((op == Op::add || op == Op::sub) && b.is_zero()) return a;
    if (op == Op::add && a.is_zero()) return b;
    if (op == Op::sub && a.is_zero()) return negated(b);
    if (op == Op::mul && (a.is_zero() || b.is_zero())) return {};
    if (op == Op::mul && a.is_exact() && cln::abs(a.exact) == 1)
      return a.exact == 1 ? b : negated(b);
    if (op == Op::mul && b.is_exact() && cln::abs(b.exact) == 1)
      return b.exact == 1 ? a : negated(a);
    return {0, line(op, line_of(a), line_of(b))};
  }

  Number called(Op op, const Number& a, const Number* b) {
    return {0, line(op, line_of(a), b ? line_of(*b) : -1)};
  }

  Number negated(const Number& a) {
    if (a.is_exact()) return {-a.exact};
    if (is_negation(a)) return {0, program_.code[static_cast<std::size_t>(a.line)].a};
    return {0, line(Op::neg, a.line, -1)};
  }
  bool is_negation(const Number& a) const {
    return !a.is_exact() && program_.code[static_cast<std::size_t>(a.line)].op == Op::neg;
  }

  void output(const Number& a) {
    program_.outputs.push_back(line_of(a));
    program_.output_names.push_back("number_" + std::to_string(program_.outputs.size()));
  }

  Program take() { return codegen::without_dead_code(program_); }

 private:
  int line_of(const Number& a) {
    if (!a.is_exact()) return a.line;
    for (std::size_t i = 0; i < program_.constants.size(); ++i)
      if (program_.constants[i] == a.exact) return line(Op::constant, static_cast<int>(i), -1);
    program_.constants.push_back(a.exact);
    return line(Op::constant, static_cast<int>(program_.constants.size()) - 1, -1);
  }

  int line(Op op, int a, int b) {
    const auto [place, is_new] =
        known_.try_emplace({op, a, b}, static_cast<int>(program_.code.size()));
    if (is_new) program_.code.push_back({op, a, b});
    return place->second;
  }

  Program program_;
  std::map<std::tuple<Op, int, int>, int> known_;
};

/// A polynomial of degree two: coefficients of the products of two of 1, x_1, .., x_n.
using LanePolynomial = std::map<std::pair<int, int>, Number>;

class LaneExpander {
 public:
  LaneExpander(const Program& program, NumberWriter& numbers, const Limits& limits)
      : program_(program),
        limits_(limits),
        numbers_(numbers),
        states_(static_cast<int>(program.outputs.size())),
        constant_(codegen::constant_instructions(program)) {}

  /// The polynomial of each output, or nothing.
  std::optional<std::vector<LanePolynomial>> run() {
    for (std::size_t i = 0; i < program_.code.size(); ++i) {
      // Roots of constants and the like are rounded far beyond double.
      std::optional<LanePolynomial> value =
          constant_[i] ? plain({codegen::constant_value(program_, static_cast<int>(i), limits_)})
                       : line(program_.code[i]);
      if (!value) return std::nullopt;
      values_.push_back(std::move(*value));
    }
    std::vector<LanePolynomial> outputs;
    for (const int output : program_.outputs) outputs.push_back(at(output));
    return outputs;
  }

 private:
  const LanePolynomial& at(int i) const { return values_[static_cast<std::size_t>(i)]; }

  static LanePolynomial plain(const Number& value) {
    if (value.is_zero()) return {};
    return {{{kNoState, kNoState}, value}};
  }
  static bool is_plain(const LanePolynomial& p) {
    return std::all_of(p.begin(), p.end(),
                       [](const auto& term) { return term.first.second == kNoState; });
  }
  static Number number_of(const LanePolynomial& p) {
    return p.empty() ? Number{} : p.begin()->second;
  }

  LanePolynomial sum(LanePolynomial a, const LanePolynomial& b, Op op) {
    for (const auto& [states, factor] : b) {
      Number& total = a[states];
      total = numbers_.combined(op, total, factor);
      if (total.is_zero()) a.erase(states);
    }
    return a;
  }

  /// Nothing if the degree of the product is more than two.
  std::optional<LanePolynomial> product(const LanePolynomial& a, const LanePolynomial& b) {
    LanePolynomial result;
    for (const auto& [u, x] : a) {
      for (const auto& [v, y] : b) {
        std::array<int, 4> states = {u.first, u.second, v.first, v.second};
        std::sort(states.begin(), states.end());
        if (states[1] != kNoState) return std::nullopt;
        result = sum(std::move(result),
                     {{{states[2], states[3]}, numbers_.combined(Op::mul, x, y)}}, Op::add);
      }
    }
    return result;
  }

  std::optional<LanePolynomial> input(int index) {
    if (index < states_) return LanePolynomial{{{kNoState, index}, {1}}};
    if (index + 1 == static_cast<int>(program_.inputs.size())) return std::nullopt;  // the time
    return plain(numbers_.input(index - states_));
  }

  std::optional<LanePolynomial> quotient(const LanePolynomial& a, const LanePolynomial& b) {
    if (!is_plain(b) || b.empty()) return std::nullopt;
    LanePolynomial result = a;
    for (auto& [states, factor] : result) factor = numbers_.combined(Op::div, factor, number_of(b));
    return result;
  }

  std::optional<LanePolynomial> line(const Instruction& code) {
    switch (code.op) {
      case Op::input:
        return input(code.a);
      case Op::add:
      case Op::sub:
        return sum(at(code.a), at(code.b), code.op);
      case Op::neg:
        return sum({}, at(code.a), Op::sub);
      case Op::mul:
        return product(at(code.a), at(code.b));
      case Op::div:
        return quotient(at(code.a), at(code.b));
      default:
        break;
    }
    if (!is_plain(at(code.a)) || (code.b >= 0 && !is_plain(at(code.b)))) return std::nullopt;
    const Number b = code.b >= 0 ? number_of(at(code.b)) : Number{};
    return plain(numbers_.called(code.op, number_of(at(code.a)), code.b >= 0 ? &b : nullptr));
  }

  const Program& program_;
  const Limits& limits_;
  NumberWriter& numbers_;
  const int states_;
  const std::vector<bool> constant_;
  std::vector<LanePolynomial> values_;
};

/// The part of a factor that a copy carries, and the sign in front of it.
struct Carried {
  Number size;
  bool negative = false;
  bool needed() const { return !(size.is_exact() && size.exact == 1); }
};

/// Puts the polynomials into the lists of a LaneForm.
class Layout {
 public:
  Layout(const std::vector<LanePolynomial>& rates, NumberWriter& numbers)
      : rates_(rates), numbers_(numbers) {
    form_.states = static_cast<int>(rates.size());
  }

  LaneForm run() {
    for (const LanePolynomial& rate : rates_)
      for (const auto& [states, factor] : rate)
        if (states.first != kNoState) ++uses_[states];
    count_carriers();
    lay_out_sums();
    for (const auto& [state, size] : copies_) numbers_.output(size);
    lay_out_shared_terms();
    lay_out_linear_terms();
    for (const LanePolynomial& rate : rates_) {
      const auto found = rate.find({kNoState, kNoState});
      numbers_.output(found == rate.end() ? Number{} : found->second);
    }
    form_.numbers = numbers_.take();
    return std::move(form_);
  }

 private:
  using States = std::pair<int, int>;
  using CopyKey = std::tuple<int, int, int>;

  Carried carried(const Number& factor) {
    if (factor.is_exact()) return {{cln::abs(factor.exact)}, factor.exact < 0};
    if (numbers_.is_negation(factor)) return {numbers_.negated(factor), true};
    return {factor, false};
  }

  /// A copy is told by its state and its factor: a line, or one of the exact sizes.
  CopyKey key_of(int state, const Number& size) {
    if (!size.is_exact()) return {state, size.line, -1};
    const auto found = std::find(sizes_.begin(), sizes_.end(), size.exact);
    const auto place = static_cast<int>(found - sizes_.begin());
    if (found == sizes_.end()) sizes_.push_back(size.exact);
    return {state, -1, place};
  }

  /// Calls `action(rate, states, factor)` for each product that only one rate has.
  template <class Action>
  void own_products(Action action) {
    for (std::size_t r = 0; r < rates_.size(); ++r)
      for (const auto& [states, factor] : rates_[r])
        if (states.first != kNoState && uses_[states] == 1) action(r, states, factor);
  }

  /// How many products each possible copy could serve.
  void count_carriers() {
    own_products([&](std::size_t, const States& states, const Number& factor) {
      const Carried c = carried(factor);
      if (!c.needed()) return;
      ++carriers_[key_of(states.first, c.size)];
      if (states.first != states.second) ++carriers_[key_of(states.second, c.size)];
    });
  }

  /// The product with its factor in a copy of the state whose copy serves more products.
  casimir_lane_product with_factor(const States& states, const Carried& c) {
    if (!c.needed()) return {states.first, states.second};
    const CopyKey left = key_of(states.first, c.size), right = key_of(states.second, c.size);
    const bool scale_left = carriers_[left] >= carriers_[right];
    const auto [place, is_new] =
        copy_of_.try_emplace(scale_left ? left : right, static_cast<int>(copies_.size()));
    if (is_new) {
      copies_.emplace_back(scale_left ? states.first : states.second, c.size);
      form_.copied.push_back(copies_.back().first);
    }
    const int row = form_.states + place->second;
    return scale_left ? casimir_lane_product{row, states.second}
                      : casimir_lane_product{states.first, row};
  }

  void lay_out_sums() {
    std::vector<std::vector<casimir_lane_product>> added(rates_.size()), taken(rates_.size());
    own_products([&](std::size_t rate, const States& states, const Number& factor) {
      const Carried c = carried(factor);
      (c.negative ? taken : added)[rate].push_back(with_factor(states, c));
    });
    auto& products = form_.products;
    for (std::size_t r = 0; r < rates_.size(); ++r) {
      form_.first.push_back(static_cast<int>(products.size()));
      products.insert(products.end(), added[r].begin(), added[r].end());
      form_.negative.push_back(static_cast<int>(products.size()));
      products.insert(products.end(), taken[r].begin(), taken[r].end());
    }
    for (const auto& [states, uses] : uses_) {
      if (uses == 1) continue;
      sum_of_[states] = form_.sums();
      form_.first.push_back(static_cast<int>(products.size()));
      products.push_back({states.first, states.second});
      form_.negative.push_back(static_cast<int>(products.size()));
    }
    form_.first.push_back(static_cast<int>(products.size()));
  }

  void lay_out_shared_terms() {
    for (const LanePolynomial& rate : rates_) {
      form_.shared.push_back(static_cast<int>(form_.shared_sum.size()));
      for (const auto& [states, factor] : rate) {
        if (states.first == kNoState || uses_[states] == 1) continue;
        form_.shared_sum.push_back(sum_of_[states]);
        numbers_.output(factor);
      }
    }
    form_.shared.push_back(static_cast<int>(form_.shared_sum.size()));
  }

  void lay_out_linear_terms() {
    for (const LanePolynomial& rate : rates_) {
      form_.linear.push_back(static_cast<int>(form_.linear_state.size()));
      for (const auto& [states, factor] : rate) {
        if (states.first != kNoState || states.second == kNoState) continue;
        form_.linear_state.push_back(states.second);
        numbers_.output(factor);
      }
    }
    form_.linear.push_back(static_cast<int>(form_.linear_state.size()));
  }

  const std::vector<LanePolynomial>& rates_;
  NumberWriter& numbers_;
  LaneForm form_;
  std::map<States, int> uses_, sum_of_;
  std::map<CopyKey, int> carriers_, copy_of_;
  std::vector<std::pair<int, Number>> copies_;
  std::vector<cln::cl_RA> sizes_;
};

}  // namespace

std::optional<LaneForm> lane_form(const Program& rhs, const Limits& limits) {
  const std::size_t states = rhs.outputs.size();
  if (states > CASIMIR_MOST_LANE_STATES || states == 0) return std::nullopt;
  NumberWriter numbers(
      {rhs.inputs.begin() + static_cast<std::ptrdiff_t>(states), rhs.inputs.end() - 1});
  const Program program = codegen::without_dead_code(rhs);
  const auto rates = LaneExpander(program, numbers, limits).run();
  if (!rates) return std::nullopt;
  return Layout(*rates, numbers).run();
}

}  // namespace casimir
