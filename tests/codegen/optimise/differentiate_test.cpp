// Derivatives of straight-line programs against those that GiNaC takes of the expressions.
#include "codegen/optimise/differentiate.hpp"

#include <cln/integer.h>
#include <gtest/gtest.h>

#include <map>

#include "codegen/optimise/optimise.hpp"
#include "runtime/evaluate.hpp"
#include "tests/codegen/support.hpp"

namespace casimir::codegen {
namespace {

using casimir::testing::exact;
using casimir::testing::Points;
using GiNaC::ex;

int pick(Points& points, int n) {
  return static_cast<int>(cln::cl_I_to_int(cln::floor1((points.next() + 4) * 4096))) % n;
}

/// Programs over the inputs x1, x2, .. and the time, which nothing is differentiated by.
Program program_of(std::size_t variables, const std::vector<Instruction>& code,
                   const std::vector<cln::cl_RA>& constants, const std::vector<int>& outputs) {
  Program program;
  for (std::size_t i = 0; i < variables; ++i) program.inputs.push_back("x" + std::to_string(i + 1));
  program.inputs.emplace_back("t");
  program.constants = constants;
  program.code = code;
  program.outputs = outputs;
  for (std::size_t k = 0; k < outputs.size(); ++k)
    program.output_names.push_back("f" + std::to_string(k));
  return program;
}

/// Lines that take any two earlier ones, of which the first are the inputs and some constants.
Program random_program(Points& points, std::size_t variables, int lines,
                       const std::vector<Op>& operations) {
  std::vector<Instruction> code;
  std::vector<cln::cl_RA> constants{1, -2, cln::cl_RA(3) / 7, 0};
  for (int i = 0; i <= static_cast<int>(variables); ++i) code.push_back({Op::input, i});
  for (int i = 0; i < 4; ++i) code.push_back({Op::constant, i});
  for (int i = 0; i < lines; ++i) {
    const Op op =
        operations[static_cast<std::size_t>(pick(points, static_cast<int>(operations.size())))];
    const int size = static_cast<int>(code.size());
    // Late lines more often, so that programs become deep.
    const auto operand = [&] { return std::max(pick(points, size), pick(points, size)); };
    code.push_back({op, operand(), op == Op::neg ? -1 : operand()});
  }
  const int size = static_cast<int>(code.size());
  return program_of(variables, code, constants, {size - 1, size - 2, size / 2});
}

/// The outputs as expressions, line by line, and the symbols of the inputs.
struct Expressions {
  std::vector<GiNaC::symbol> symbols;
  std::vector<ex> outputs;
};

ex line(const Program& program, const Instruction& c, const std::vector<ex>& values,
        const std::vector<GiNaC::symbol>& symbols) {
  const auto at = [&](int i) { return values[static_cast<std::size_t>(i)]; };
  switch (c.op) {
    case Op::input:
      return symbols[static_cast<std::size_t>(c.a)];
    case Op::constant:
      return GiNaC::numeric(program.constants[static_cast<std::size_t>(c.a)]);
    case Op::pi:
      return GiNaC::Pi;
    case Op::add:
      return at(c.a) + at(c.b);
    case Op::sub:
      return at(c.a) - at(c.b);
    case Op::mul:
      return at(c.a) * at(c.b);
    case Op::div:
      return at(c.a) / at(c.b);
    case Op::neg:
      return -at(c.a);
    case Op::pow:
      return pow(at(c.a), at(c.b));
    case Op::abs:
      return abs(at(c.a));
    case Op::sign:
      return csgn(at(c.a));
    case Op::sqrt:
      return sqrt(at(c.a));
    case Op::sin:
      return sin(at(c.a));
    case Op::cos:
      return cos(at(c.a));
    case Op::tan:
      return tan(at(c.a));
    case Op::sinh:
      return sinh(at(c.a));
    case Op::cosh:
      return cosh(at(c.a));
    case Op::tanh:
      return tanh(at(c.a));
    case Op::exp:
      return exp(at(c.a));
    case Op::log:
      return log(at(c.a));
    case Op::asin:
      return asin(at(c.a));
    case Op::acos:
      return acos(at(c.a));
    case Op::atan2:
      return atan2(at(c.a), at(c.b));
  }
  return 0;
}

Expressions expressions_of(const Program& program) {
  Expressions result;
  for (const std::string& name : program.inputs) result.symbols.emplace_back(name);
  std::vector<ex> values;
  for (const Instruction& c : program.code)
    values.push_back(line(program, c, values, result.symbols));
  for (const int output : program.outputs)
    result.outputs.push_back(values[static_cast<std::size_t>(output)]);
  return result;
}

std::map<std::pair<int, int>, cln::cl_RA> entries_at(const SparseProgram& matrix,
                                                     const std::vector<cln::cl_RA>& at) {
  const std::vector<cln::cl_RA> values = exact(matrix.program, at);
  std::map<std::pair<int, int>, cln::cl_RA> result;
  for (std::size_t k = 0; k < values.size(); ++k) result[matrix.entries[k]] = values[k];
  EXPECT_EQ(result.size(), values.size()) << "an entry is there twice";
  return result;
}

cln::cl_RA value(const ex& e, const GiNaC::exmap& at) {
  return cln::the<cln::cl_RA>(GiNaC::ex_to<GiNaC::numeric>(e.subs(at)).to_cl_N());
}

/// All derivatives of a rational program at one point; false where it has a pole there.
bool expect_exact_at(const Program& program, std::size_t n, Points& points) {
  const Expressions expressions = expressions_of(program);
  std::vector<cln::cl_RA> at;
  GiNaC::exmap map;
  for (const GiNaC::symbol& symbol : expressions.symbols) {
    at.push_back(points.next());
    map[symbol] = GiNaC::numeric(at.back());
  }
  std::vector<cln::cl_RA> deviation, both = at;
  for (std::size_t i = 0; i < n; ++i) deviation.push_back(points.next());
  both.insert(both.begin() + static_cast<std::ptrdiff_t>(n), deviation.begin(), deviation.end());
  std::map<std::pair<int, int>, cln::cl_RA> forward, reverse;
  std::vector<cln::cl_RA> along;
  try {
    forward = entries_at(jacobian(program, n), at);
    reverse = entries_at(gradients(program, n), at);
    along = exact(variational(program, n), both);
  } catch (const cln::division_by_0_exception&) {
    return false;
  }
  for (std::size_t k = 0; k < program.outputs.size(); ++k) {
    EXPECT_EQ(along[k], value(expressions.outputs[k], map));
    cln::cl_RA directional = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const cln::cl_RA expected = value(expressions.outputs[k].diff(expressions.symbols[i]), map);
      const std::pair<int, int> place{static_cast<int>(k), static_cast<int>(i)};
      EXPECT_EQ(forward.contains(place) ? forward[place] : 0, expected);
      const std::pair<int, int> transposed{static_cast<int>(i), static_cast<int>(k)};
      EXPECT_EQ(reverse.contains(transposed) ? reverse[transposed] : 0, expected);
      directional = directional + expected * deviation[i];
    }
    EXPECT_EQ(along[program.outputs.size() + k], directional);
  }
  return true;
}

TEST(Differentiate, PiMayComeFirst) {
  const Program program = program_of(1, {{Op::pi}, {Op::input, 0}, {Op::mul, 0, 1}}, {}, {2});
  const SparseProgram matrix = jacobian(program, 1);
  ASSERT_EQ(matrix.entries.size(), 1U);
  const Instruction& entry =
      matrix.program.code[static_cast<std::size_t>(matrix.program.outputs[0])];
  EXPECT_EQ(entry, (Instruction{Op::pi}));
}

TEST(Differentiate, RandomPolynomialsExactly) {
  Points points;
  for (int round = 0; round < 150; ++round) {
    const Program program =
        random_program(points, 3, 4 + round % 9, {Op::add, Op::sub, Op::mul, Op::mul, Op::neg});
    EXPECT_TRUE(expect_exact_at(program, 3, points));
    if (HasFailure()) FAIL() << "round " << round;
  }
}

TEST(Differentiate, RandomRationalFunctionsExactly) {
  Points points;
  int checked = 0;
  for (int round = 0; round < 150; ++round) {
    const Program program =
        random_program(points, 3, 4 + round % 7, {Op::add, Op::sub, Op::mul, Op::div, Op::neg});
    try {
      checked += expect_exact_at(program, 3, points) ? 1 : 0;
    } catch (const std::exception&) {  // GiNaC refuses 1/0 when the expression is made
    }
    if (HasFailure()) FAIL() << "round " << round;
  }
  EXPECT_GT(checked, 60);
}

TEST(Differentiate, OptimisedDerivativesAreTheSameFunctions) {
  Points points;
  for (int round = 0; round < 60; ++round) {
    const std::size_t n = 3;
    const Program program =
        random_program(points, n, 4 + round % 8, {Op::add, Op::sub, Op::mul, Op::mul, Op::neg});
    std::vector<GiNaC::symbol> symbols;
    for (const std::string& name : program.inputs) symbols.emplace_back(name);
    Dag dag(symbols, n);
    const SparseProgram plain = gradients(program, n);
    const SparseProgram shorter = optimised(dag, std::vector<SparseProgram>{plain});
    EXPECT_LE(weight(count_operations(shorter.program)), weight(count_operations(plain.program)));
    std::vector<cln::cl_RA> at;
    for (std::size_t i = 0; i <= n; ++i) at.push_back(points.next());
    auto expected = entries_at(plain, at);
    auto values = entries_at(shorter, at);
    for (const auto& [place, derivative] : expected)
      EXPECT_EQ(values.contains(place) ? values[place] : 0, derivative) << "round " << round;
    for (const auto& [place, derivative] : values) EXPECT_TRUE(expected.contains(place));
  }
}

/// f(u, v) of one operation inside a product and a sum, with arguments where every function has a
/// value: 0 < u, v < 1.
Program program_with(Op op) {
  const bool binary = op == Op::atan2 || op == Op::pow || op == Op::div;
  return program_of(2,
                    {{Op::input, 0},
                     {Op::input, 1},
                     {Op::constant, 0},
                     {Op::mul, 0, 1},  // 3: x1*x2
                     {op, 3,
                      !binary         ? -1
                      : op == Op::pow ? 2
                                      : 1},  // 4
                     {Op::mul, 4, 0},        // 5
                     {Op::sub, 5, 1},        // 6
                     {op, 0,
                      !binary         ? -1
                      : op == Op::pow ? 2
                                      : 6}},  // 7
                    {cln::cl_RA(-4) / 3}, {6, 7});
}

TEST(Differentiate, EveryFunctionToThirtyDigits) {
  constexpr int kDigits = 45;
  GiNaC::Digits = kDigits;
  const Arithmetic<cln::cl_F> arithmetic(kDigits);
  for (const Op op : {Op::pow, Op::sqrt, Op::sin, Op::cos, Op::tan, Op::sinh, Op::cosh, Op::tanh,
                      Op::exp, Op::log, Op::asin, Op::acos, Op::atan2, Op::div}) {
    const Program program = program_with(op);
    const Expressions expressions = expressions_of(program);
    const cln::cl_RA x[] = {cln::cl_RA(3) / 8, cln::cl_RA(5) / 8};
    const GiNaC::exmap map{{expressions.symbols[0], GiNaC::numeric(x[0])},
                           {expressions.symbols[1], GiNaC::numeric(x[1])}};
    std::vector<cln::cl_F> at{arithmetic.from(x[0]), arithmetic.from(x[1]),
                              arithmetic.from(cln::cl_RA(0))};
    const auto check = [&](const SparseProgram& matrix, bool transposed) {
      const auto values = evaluate(matrix.program, at, arithmetic);
      for (std::size_t k = 0; k < values.size(); ++k) {
        auto [of, by] = matrix.entries[k];
        if (transposed) std::swap(of, by);
        const ex derivative = expressions.outputs[static_cast<std::size_t>(of)].diff(
            expressions.symbols[static_cast<std::size_t>(by)]);
        const ex difference = derivative.subs(map).evalf() - GiNaC::numeric(values[k]);
        EXPECT_LT(abs(GiNaC::ex_to<GiNaC::numeric>(difference.evalf())).to_double(), 1e-30)
            << "operation " << static_cast<int>(op) << ", entry " << of << ", " << by;
      }
      EXPECT_EQ(values.size(), matrix.entries.size());
    };
    check(jacobian(program, 2), false);
    check(gradients(program, 2), true);
    EXPECT_GE(jacobian(program, 2).entries.size(), 3U);
  }
}

TEST(Differentiate, ValuesAreSharedWithTheFunction) {
  const auto calls = [](Op op) {
    const Program single = program_of(1, {{Op::input, 0}, {op, 0}}, {}, {1});
    return count_operations(variational(single, 1));
  };
  EXPECT_EQ(calls(Op::exp), (OperationCount{1, 0, 0, 1}));
  EXPECT_EQ(calls(Op::tan), (OperationCount{2, 1, 0, 1}));
  EXPECT_EQ(calls(Op::sqrt), (OperationCount{1, 0, 1, 1}));
  EXPECT_EQ(calls(Op::sin), (OperationCount{1, 0, 0, 2}));
  EXPECT_EQ(calls(Op::log), (OperationCount{1, 0, 1, 1}));
  // sin(x) and cos(x) need no further call.
  const Program pair = program_of(1, {{Op::input, 0}, {Op::sin, 0}, {Op::cos, 0}}, {}, {1, 2});
  EXPECT_EQ(count_operations(variational(pair, 1)).calls, 2);
  // 1/x and its derivative need one division.
  const Program inverse =
      program_of(1, {{Op::input, 0}, {Op::constant, 0}, {Op::div, 1, 0}}, {1}, {2});
  EXPECT_EQ(count_operations(variational(inverse, 1)).div, 1);
  // x^(4/3) and its derivative need one power.
  const Program power =
      program_of(1, {{Op::input, 0}, {Op::constant, 0}, {Op::pow, 0, 1}}, {cln::cl_RA(4) / 3}, {2});
  Dag dag({GiNaC::symbol("x"), GiNaC::symbol("d"), GiNaC::symbol("t")}, 2);
  EXPECT_EQ(count_operations(optimised(dag, std::vector<Program>{variational(power, 1)})).calls, 1);
}

TEST(Differentiate, StructuralZerosAreLeftOut) {
  // f0 = x1*t + 3, f1 = x2 - x2, f2 = t^2
  const Program program = program_of(2,
                                     {{Op::input, 0},
                                      {Op::input, 1},
                                      {Op::input, 2},
                                      {Op::constant, 0},
                                      {Op::mul, 0, 2},
                                      {Op::add, 4, 3},
                                      {Op::sub, 1, 1},
                                      {Op::mul, 2, 2}},
                                     {3}, {5, 6, 7});
  EXPECT_EQ(jacobian(program, 2).entries, (std::vector<std::pair<int, int>>{{0, 0}}));
  EXPECT_EQ(gradients(program, 2).entries, (std::vector<std::pair<int, int>>{{0, 0}}));
  EXPECT_EQ(jacobian(program, 2).program.output_names, (std::vector<std::string>{"f0/dx1"}));
}

/// The product of all variables.
Program product(int n) {
  std::vector<Instruction> code;
  for (int i = 0; i < n; ++i) code.push_back({Op::input, i});
  code.push_back({Op::mul, 0, 1});
  for (int i = 2; i < n; ++i) code.push_back({Op::mul, static_cast<int>(code.size()) - 1, i});
  return program_of(static_cast<std::size_t>(n), code, {}, {static_cast<int>(code.size()) - 1});
}

TEST(Differentiate, GradientsCostAFewFunctionsWhateverTheNumberOfVariables) {
  for (const int n : {5, 10, 40}) {
    const auto size = static_cast<std::size_t>(n);
    const Program function = product(n);
    const SparseProgram gradient = gradients(function, size);
    EXPECT_EQ(gradient.entries.size(), size);
    EXPECT_LE(count_operations(gradient.program).mul, 3 * n);
    // What the optimiser makes of it is no longer.
    std::vector<GiNaC::symbol> symbols;
    for (const std::string& name : function.inputs) symbols.emplace_back(name);
    Dag dag(symbols, size);
    EXPECT_LE(count_operations(optimised(dag, std::vector<SparseProgram>{gradient}).program).mul,
              3 * n);
  }
  Points points;
  for (int round = 0; round < 100; ++round) {
    Program program = random_program(points, 4, 40, {Op::add, Op::sub, Op::mul, Op::div, Op::neg});
    program.outputs.resize(1);
    program.output_names.resize(1);
    const auto operations = [](const OperationCount& c) { return c.mul + c.add + c.div; };
    const Program function = without_dead_code(program);
    EXPECT_LE(operations(count_operations(gradients(function, 4).program)),
              5 * operations(count_operations(function)));
  }
}

TEST(Differentiate, EulersIdentityForHomogeneousFunctions) {
  // sum x_i df/dx_i = d f for x1^2*x2 - x2^3 + 5*x1*x2^2/(x1 + x2)*x1 of degree 3.
  const Program program = program_of(2,
                                     {{Op::input, 0},
                                      {Op::input, 1},
                                      {Op::constant, 0},
                                      {Op::mul, 0, 1},
                                      {Op::mul, 0, 3},
                                      {Op::mul, 1, 1},
                                      {Op::mul, 5, 1},
                                      {Op::sub, 4, 6},
                                      {Op::add, 0, 1},
                                      {Op::div, 3, 8},
                                      {Op::mul, 9, 3},
                                      {Op::mul, 2, 10},
                                      {Op::add, 7, 11}},
                                     {5}, {12});
  Points points;
  for (int round = 0; round < 10; ++round) {
    std::vector<cln::cl_RA> at{points.next(), points.next()};
    at.push_back(0);
    cln::cl_RA sum = 0;
    for (const auto& [place, derivative] : entries_at(gradients(program, 2), at))
      sum = sum + derivative * at[static_cast<std::size_t>(place.first)];
    EXPECT_EQ(sum, 3 * exact(program, at)[0]);
    const std::vector<cln::cl_RA> along{at[0], at[1], at[0], at[1], 0};
    EXPECT_EQ(exact(variational(program, 2), along)[1], sum);
  }
}

}  // namespace
}  // namespace casimir::codegen
