#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <span>
#include <string_view>

#include "runtime/program.hpp"

namespace casimir {

/// How the Taylor coefficients of a series y follow from those of others, for k > 0 (automatic
/// differentiation: Griewank & Walther, Evaluating Derivatives, 2008, Tables 13.1 and 13.2).
enum class SeriesRule : unsigned char {
  integral,  ///< y' = s f a':     k y_k = s sum over j = 1..k of j a_j f_{k-j}
  quotient,  ///< f y' = s a':     k f_0 y_k = s k a_k - sum over j = 1..k-1 of j y_j f_{k-j}
  root,      ///< y y = a:         2 y_0 y_k = a_k - sum over j = 1..k-1 of y_j y_{k-j}
  squares,   ///< y = 1 + s a a:   y_k = s sum over j = 0..k of a_j a_{k-j}
  // Those of one function each.
  power,  ///< y = a^e:            a y' = e y a'
  angle,  ///< y = atan2(a, b):    r y' = b a' - a b' with the helper r = a a + b b
  side,   ///< y = |a|:            y = u a with the helper u = sign a, a constant
  constant
};

/// A series in the recurrence of a function. The helpers are series that nobody asked for.
enum class Slot : unsigned char { argument, second, value, helper, inner };

/// One line of a recurrence: the series `target`, by a rule from the series a = `of` and f = `by`
/// and the sign s.
struct SeriesStep {
  SeriesRule rule;
  Slot target = Slot::value, of = Slot::argument, by = Slot::argument;
  int sign = 1;
};

enum class Parity : unsigned char { none, odd, even };

/// An elementary function of the programs: all that depends on which one it is, except for the
/// values themselves, which the libraries of the number types know (`Arithmetic`). The derivative
/// is that of its recurrence.
struct FunctionRow {
  Op op;
  std::string_view name;     ///< in case files
  std::string_view c_name;   ///< in the mathematical library of C
  std::string_view printed;  ///< in formulas on paper
  Parity parity = Parity::none;
  /// Whether its series may end sooner than that of its argument: at a singularity of its own.
  bool singular = false;
  /// What the helper is called in generated code.
  std::string_view helper = {};
  /// Two functions each of which is the helper of the other have one recurrence, that of the first:
  /// `first` is that one, `partner` the other function.
  Op first = op, partner = op;
  /// In the order in which coefficient k is worked out.
  std::array<SeriesStep, 3> step = {};
  std::size_t steps = 1;
};

namespace function_rows {
using enum Slot;
using enum SeriesRule;

inline constexpr FunctionRow kTable[] = {
    {.op = Op::pow,
     .name = "pow",
     .c_name = "pow",
     .printed = "",
     .singular = true,
     .step = {{{power}}}},
    {.op = Op::sqrt,
     .name = "sqrt",
     .c_name = "sqrt",
     .printed = "sqrt",
     .singular = true,
     .step = {{{root}}}},
    {.op = Op::sin,
     .name = "sin",
     .c_name = "sin",
     .printed = "sin",
     .parity = Parity::odd,
     .partner = Op::cos,
     .step = {{{integral, value, argument, helper}, {integral, helper, argument, value, -1}}},
     .steps = 2},
    {.op = Op::cos,
     .name = "cos",
     .c_name = "cos",
     .printed = "cos",
     .parity = Parity::even,
     .first = Op::sin,
     .partner = Op::sin,
     .steps = 0},
    {.op = Op::tan,
     .name = "tan",
     .c_name = "tan",
     .printed = "tan",
     .parity = Parity::odd,
     .singular = true,
     .helper = "slope",
     .step = {{{integral, value, argument, helper}, {squares, helper, value}}},
     .steps = 2},
    {.op = Op::sinh,
     .name = "sinh",
     .c_name = "sinh",
     .printed = "sinh",
     .parity = Parity::odd,
     .partner = Op::cosh,
     .step = {{{integral, value, argument, helper}, {integral, helper, argument, value}}},
     .steps = 2},
    {.op = Op::cosh,
     .name = "cosh",
     .c_name = "cosh",
     .printed = "cosh",
     .parity = Parity::even,
     .first = Op::sinh,
     .partner = Op::sinh,
     .steps = 0},
    {.op = Op::tanh,
     .name = "tanh",
     .c_name = "tanh",
     .printed = "tanh",
     .parity = Parity::odd,
     .singular = true,
     .helper = "slope",
     .step = {{{integral, value, argument, helper}, {squares, helper, value, argument, -1}}},
     .steps = 2},
    {.op = Op::exp,
     .name = "exp",
     .c_name = "exp",
     .printed = "exp",
     .step = {{{integral, value, argument, value}}}},
    {.op = Op::log,
     .name = "log",
     .c_name = "log",
     .printed = "ln",
     .singular = true,
     .step = {{{quotient, value, argument, argument}}}},
    {.op = Op::asin,
     .name = "asin",
     .c_name = "asin",
     .printed = "arcsin",
     .parity = Parity::odd,
     .singular = true,
     .helper = "root",
     .step = {{{squares, inner, argument, argument, -1},
               {root, helper, inner},
               {quotient, value, argument, helper}}},
     .steps = 3},
    {.op = Op::acos,
     .name = "acos",
     .c_name = "acos",
     .printed = "arccos",
     .singular = true,
     .helper = "root",
     .step = {{{squares, inner, argument, argument, -1},
               {root, helper, inner},
               {quotient, value, argument, helper, -1}}},
     .steps = 3},
    {.op = Op::atan2,
     .name = "atan2",
     .c_name = "atan2",
     .printed = "atan2",
     .singular = true,
     .step = {{{angle, value, argument, second}}}},
    {.op = Op::abs, .name = "abs", .c_name = "fabs", .printed = "abs", .step = {{{side}}}},
    {.op = Op::sign,
     .name = "sign",
     .c_name = "copysign",
     .printed = "sign",
     .step = {{{constant}}}},
};

constexpr bool in_order() {
  for (std::size_t i = 0; i < std::size(kTable); ++i)
    if (static_cast<int>(kTable[i].op) != static_cast<int>(Op::pow) + static_cast<int>(i))
      return false;
  return kTable[std::size(kTable) - 1].op == Op::sign;
}
static_assert(in_order(), "the rows stand in the order of Op, and none is missing");
}  // namespace function_rows

/// All functions, in the order of Op.
constexpr std::span<const FunctionRow> function_table() { return function_rows::kTable; }

/// Whether an operation is a function of the table: anything but a leaf and the four operations.
constexpr bool is_function(Op op) { return op >= Op::pow; }

/// The row of a function.
constexpr const FunctionRow& function_row(Op op) {
  assert(is_function(op));
  return function_rows::kTable[static_cast<std::size_t>(op) - static_cast<std::size_t>(Op::pow)];
}

/// The recurrence of a function: its own, or that of the function whose helper it is.
constexpr std::span<const SeriesStep> series_steps(Op op) {
  const FunctionRow& first = function_row(function_row(op).first);
  return {first.step.data(), first.steps};
}

/// Where a slot of the recurrence stands for a function: the helper of its partner is its value.
constexpr Slot own_slot(Op op, Slot slot) {
  if (function_row(op).first == op) return slot;
  return slot == Slot::value ? Slot::helper : slot == Slot::helper ? Slot::value : slot;
}

/// Whether the recurrence of a function has series of its own beside the result.
constexpr bool has_helpers(Op op) {
  for (const SeriesStep& step : series_steps(op))
    if (step.target != Slot::value || step.rule == SeriesRule::angle ||
        step.rule == SeriesRule::side)
      return true;
  return false;
}

}  // namespace casimir
