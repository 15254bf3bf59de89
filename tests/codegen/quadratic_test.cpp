// Which systems have tables, and that the tables say what the program says.
#include "codegen/quadratic.hpp"

#include <gtest/gtest.h>

#include "runtime/evaluate.hpp"
#include "runtime/taylor/quadratic_layout.hpp"
#include "tests/codegen/support.hpp"

namespace casimir {
namespace {

using testing::equations;
using testing::kKovalevskaya;
using testing::specialised;

/// The right-hand side by the tables: register by register, as the kernel does it.
std::vector<double> rates(const casimir_quadratic& tables, const std::vector<double>& x) {
  std::vector<double> result(tables.constant, tables.constant + tables.states);
  const auto at = [&](long long i) { return x[static_cast<std::size_t>(i)]; };
  for (int i = 0; i < tables.states; ++i) {
    double& rate = result[static_cast<std::size_t>(i)];
    for (int m = 0; m < tables.products; ++m) {
      const auto product = [&](long long lane) {
        return at(tables.left[m][lane]) * at(tables.right[m][lane]);
      };
      rate += tables.own[m][i] * product(i);
      for (int e = 0; e < tables.moves[m]; ++e)
        rate += tables.move[m][e].factor[i] * product(tables.move[m][e].from[i]);
    }
    for (int d = 0; d < tables.diagonals; ++d) rate += tables.fixed[d][i] * at(tables.column[d][i]);
  }
  return result;
}

/// Twice the quadratic and once the linear part, by the diagonals of the Jacobian.
std::vector<double> jacobian_times_state(const casimir_quadratic& tables,
                                         const std::vector<double>& x) {
  std::vector<double> result(x.size());
  const auto at = [&](long long i) { return x[static_cast<std::size_t>(i)]; };
  for (int i = 0; i < tables.states; ++i) {
    for (int d = 0; d < tables.diagonals; ++d) {
      double entry = tables.fixed[d][i];
      for (int q = 0; q < tables.parts[d]; ++q)
        entry += tables.part[d][q].factor[i] * at(tables.part[d][q].from[i]);
      result[static_cast<std::size_t>(i)] += entry * at(tables.column[d][i]);
    }
  }
  return result;
}

void expect_tables_of(const Program& rhs, int registers, int moves) {
  const auto form = quadratic_form(rhs, {});
  ASSERT_TRUE(form);
  const auto tables = narrow_tables(*form);
  ASSERT_TRUE(tables);
  EXPECT_EQ(tables->products, registers);
  int total = 0;
  for (int m = 0; m < tables->products; ++m) total += tables->moves[m];
  EXPECT_EQ(total, moves);
  std::vector<double> x, inputs;
  for (int i = 0; i < tables->states; ++i) x.push_back(1.25 + i * i - 3 * i);
  const auto truth = [&](double scale) {
    std::vector<double> scaled = x;
    for (double& value : scaled) value *= scale;
    scaled.push_back(0);
    return evaluate(rhs, scaled);
  };
  const std::vector<double> plain = rates(*tables, x),
                            by_jacobian = jacobian_times_state(*tables, x);
  for (std::size_t i = 0; i < x.size(); ++i) {
    EXPECT_NEAR(plain[i], truth(1)[i], 1e-12);
    // f = c + L x + Q(x, x): f(x) - f(-x) is 2 L x, f(x) + f(-x) is 2 c + 2 Q(x, x).
    const double twice_linear = truth(1)[i] - truth(-1)[i];
    const double twice_quadratic = truth(1)[i] + truth(-1)[i] - 2 * truth(0)[i];
    EXPECT_NEAR(by_jacobian[i], twice_linear / 2 + twice_quadratic, 1e-12);
  }
}

TEST(QuadraticForm, KeepsWhatRoundingAFactorLoses) {
  Program rhs;  // x' = 1/3 - x/7 + x^2/10
  rhs.inputs = {"x", "t"};
  rhs.constants = {cln::cl_RA("1/3"), cln::cl_RA("1/7"), cln::cl_RA("1/10")};
  rhs.code = {{Op::input, 0},    {Op::constant, 0}, {Op::constant, 1},
              {Op::constant, 2}, {Op::mul, 0, 2},   {Op::sub, 1, 4},
              {Op::mul, 0, 0},   {Op::mul, 6, 3},   {Op::add, 5, 7}};
  rhs.outputs = {8};
  const auto form = quadratic_form(rhs, {});
  ASSERT_TRUE(form);
  const auto expect = [](double factor, double rest, const char* exact) {
    const auto rational = [](double value) { return cln::rational(cln::cl_DF(value)); };
    EXPECT_NE(rest, 0);
    EXPECT_LT(cln::abs(rational(factor) + rational(rest) - cln::cl_RA(exact)),
              cln::cl_RA("1/1000000000000000000000000000000"));
  };
  expect(form->constant[0], form->constant_rest[0], "1/3");
  expect(form->linear[0][0], form->linear_rest[0][0], "-1/7");
  expect(form->products[0].factor[0], form->products[0].rest[0], "1/10");
}

TEST(QuadraticTables, KovalevskayaFillsOneRegister) {
  expect_tables_of(specialised(kKovalevskaya).rhs, 1, 1);
}

TEST(QuadraticTables, ConstantsLinearTermsAndSquares) {
  expect_tables_of(specialised(equations({{"x", "1 + 2*y"}, {"y", "x^2 - y^2/3 + x*y - x"}})).rhs,
                   1, 2);
  expect_tables_of(specialised(equations({{"x", "y"}, {"y", "-x"}})).rhs, 1, 0);
  expect_tables_of(specialised(equations({{"x", "(x + y)*(x - y)"}, {"y", "sqrt(2)*x/Pi"}})).rhs, 1,
                   1);
}

TEST(QuadraticTables, OtherSystemsHaveNone) {
  for (const char* rate : {"x^3", "1/x", "sin(x)", "sqrt(x)", "x*y^2"})
    EXPECT_FALSE(quadratic_form(specialised(equations({{"x", rate}, {"y", "x"}})).rhs, {})) << rate;
  // The twin: what only looks like a cube.
  EXPECT_TRUE(quadratic_form(
      specialised(equations({{"x", "(x + y)^3 - x^3 - 3*x^2*y - 3*x*y^2 - y^3"}, {"y", "x"}})).rhs,
      {}));
}

TEST(QuadraticTables, ParametersAtRunTimeAreNumbers) {
  SpecialiseOptions general;
  general.fold_parameters = false;
  const Specialisation s = specialised(kKovalevskaya, general);
  const auto form = quadratic_form(s.rhs, s.limits, {3});
  ASSERT_TRUE(form);
  EXPECT_EQ(form->linear[1][5], -3);
  EXPECT_EQ(form->linear[2][4], 3);
}

}  // namespace
}  // namespace casimir
