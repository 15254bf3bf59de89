#include "codegen/optimise/optimise.hpp"

#include <cln/integer.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "codegen/optimise/factor.hpp"
#include "codegen/optimise/terms.hpp"
#include "runtime/evaluate.hpp"
#include "tests/codegen/support.hpp"

namespace casimir::codegen {
namespace {

using casimir::testing::exact;
using casimir::testing::Points;
using GiNaC::ex;

class Optimise : public ::testing::Test {
 protected:
  Optimise() {
    for (const char* name : {"x", "y", "z", "u", "v"}) symbols_.emplace_back(name);
  }

  ex s(int i) const { return symbols_[static_cast<std::size_t>(i)]; }

  /// Sums of products of sums, with fractions and quotients.
  ex random_expression(Points& points, int depth) {
    const auto pick = [&](int n) {
      return static_cast<int>(cln::cl_I_to_int(cln::floor1((points.next() + 4) * 4096))) % n;
    };
    if (depth == 0) return s(pick(5)) + GiNaC::numeric(pick(5) - 2, 1 + pick(3));
    ex result = random_expression(points, depth - 1);
    for (int i = 0; i < 1 + pick(3); ++i) {
      const ex next = random_expression(points, depth - 1);
      switch (pick(5)) {
        case 0:
          result = result * next;
          break;
        case 1:
          result = result - s(pick(5)) * s(pick(5)) * next;
          break;
        case 2:
          result = result / (1 + pow(next, 2));
          break;
        case 3:
          result = pow(result, 1 + pick(3)) + next;
          break;
        default:
          result = result + GiNaC::numeric(1 + pick(4), 3) * next * s(pick(5));
          break;
      }
    }
    return result;
  }

  std::vector<cln::cl_RA> point(Points& points) {
    std::vector<cln::cl_RA> result;
    for (std::size_t i = 0; i < symbols_.size(); ++i) result.push_back(points.next());
    return result;
  }

  cln::cl_RA value(const ex& e, const std::vector<cln::cl_RA>& at) const {
    GiNaC::exmap map;
    for (std::size_t i = 0; i < at.size(); ++i) map[symbols_[i]] = GiNaC::numeric(at[i]);
    return cln::the<cln::cl_RA>(GiNaC::ex_to<GiNaC::numeric>(e.subs(map)).to_cl_N());
  }

  Program lower_plainly(const std::vector<ex>& expressions) {
    Dag dag(symbols_, symbols_.size());
    std::vector<Scaled> converted;
    for (const ex& e : expressions) converted.push_back(dag.convert(e));
    return lowered(system_of(dag, symbols_.size(), converted), names_, outputs(expressions));
  }

  Program optimise(const std::vector<ex>& expressions) {
    Dag dag(symbols_, symbols_.size());
    std::vector<Scaled> converted;
    for (const ex& e : expressions) converted.push_back(dag.convert(e));
    return optimised(dag, converted, names_, outputs(expressions));
  }

  TermSystem system(const std::vector<ex>& expressions) {
    Dag dag(symbols_, symbols_.size());
    std::vector<Scaled> converted;
    for (const ex& e : expressions) converted.push_back(dag.convert(e));
    return system_of(dag, symbols_.size(), converted);
  }

  static std::vector<std::string> outputs(const std::vector<ex>& expressions) {
    std::vector<std::string> result;
    for (std::size_t i = 0; i < expressions.size(); ++i) result.push_back("f" + std::to_string(i));
    return result;
  }

  OperationCount cost(const TermSystem& system) {
    std::vector<std::string> names(system.outputs.size(), "f");
    return count_operations(lowered(flattened(system), names_, names));
  }

  std::vector<GiNaC::symbol> symbols_;
  std::vector<std::string> names_{"x", "y", "z", "u", "v"};
};

/// The expansion of (1 - x/10)^2000 has terms of thousands of digits.
TEST_F(Optimise, HighPowersOfSumsAreNotMultipliedOut) {
  EXPECT_FALSE(expanded(system({pow(1 - s(0) / 10, 2000)}), 3000));
  EXPECT_TRUE(expanded(system({pow(1 - s(0) / 10, 20)}), 3000));
}

/// GiNaC writes (x/2000 + 1)^2000 as (x + 2000)^2000/2000^2000: neither is a number that doubles
/// have. The value stays exactly what it was.
TEST_F(Optimise, HighPowersHaveNumbersThatDoublesHave) {
  const GiNaC::numeric n = 2000;
  const std::vector<ex> all{pow(s(0) / n + 1, n), 7 * pow(1 - pow(s(1) / 10, 2), n),
                            pow(s(2) / 10, 3000) + s(3), 5 * pow(s(0) + s(1) / 3, 1500)};
  Points points;
  for (const ex& e : all) {
    const Program program = optimise({e});
    for (const cln::cl_RA& constant : program.constants) EXPECT_FALSE(beyond_range(constant)) << e;
    const std::vector<cln::cl_RA> at = point(points);
    EXPECT_EQ(exact(program, at)[0], value(e, at)) << e;
  }
  EXPECT_TRUE(beyond_range(cln::expt(cln::cl_RA(2000), -2000)));
  EXPECT_FALSE(beyond_range(cln::expt(cln::cl_RA(10), -100)));
}

TEST_F(Optimise, ProgramsEqualTheExpressionsExactly) {
  Points points;
  for (int round = 0; round < 60; ++round) {
    const std::vector<ex> expressions{random_expression(points, 1), random_expression(points, 2),
                                      random_expression(points, 2)};
    const Program program = optimise(expressions);
    EXPECT_LE(weight(count_operations(program)),
              weight(count_operations(lower_plainly(expressions))));
    for (int k = 0; k < 5; ++k) {
      const std::vector<cln::cl_RA> at = point(points);
      const std::vector<cln::cl_RA> values = exact(program, at);
      for (std::size_t i = 0; i < values.size(); ++i) {
        EXPECT_EQ(values[i], value(expressions[i], at)) << expressions[i];
      }
    }
  }
}

TEST_F(Optimise, ABentProgramIsNotEqual) {
  Points points;
  const ex e = (s(0) - s(1)) * s(2) + s(3);
  Program program = optimise({e});
  for (Instruction& c : program.code) {
    if (c.op == Op::sub) c.op = Op::add;
  }
  const std::vector<cln::cl_RA> at = point(points);
  EXPECT_NE(exact(program, at)[0], value(e, at));
  EXPECT_EQ(exact(program, at)[0] - value(e, at), 2 * at[1] * at[2]);
}

TEST_F(Optimise, FactoringTakesOutCommonFactors) {
  // x*y + x*z + x*u = x*(y + z + u)
  EXPECT_EQ(cost(factored(system({(s(0) * s(1) + s(0) * s(2) + s(0) * s(3)).expand()}),
                          Preference::best)),
            (OperationCount{1, 2, 0, 0}));
  // Horner: x^3 + 2*x^2 + 3*x + 4
  const ex x = s(0);
  EXPECT_EQ(cost(factored(system({pow(x, 3) + 2 * pow(x, 2) + 3 * x + 4}), Preference::best)),
            (OperationCount{2, 3, 0, 0}));
  // A sum that two outputs share up to a factor: (y + 3*z)*x and -2*y - 6*z + u.
  EXPECT_EQ(
      cost(factored(system({(s(0) * (s(1) + 3 * s(2))).expand(), -2 * s(1) - 6 * s(2) + s(3)}),
                    Preference::best)),
      (OperationCount{3, 2, 0, 0}));
}

TEST_F(Optimise, FactoringTakesOutCommonProducts) {
  // x*y*z and y*z*u
  EXPECT_EQ(cost(factored(system({s(0) * s(1) * s(2), s(1) * s(2) * s(3)}), Preference::best)),
            (OperationCount{3, 0, 0, 0}));
  EXPECT_EQ(cost(system({s(0) * s(1) * s(2), s(1) * s(2) * s(3)})), (OperationCount{4, 0, 0, 0}));
  EXPECT_EQ(cost(factored(system({2 * s(0) * s(1), 2 * s(0) * s(2)}), Preference::best)),
            (OperationCount{3, 0, 0, 0}));
}

TEST_F(Optimise, ExpansionMultipliesOutAndCancels) {
  const auto zero = expanded(system({(s(0) + s(1)) * s(2) - s(0) * s(2) - s(1) * s(2)}), 100);
  ASSERT_TRUE(zero);
  EXPECT_TRUE(zero->variables[static_cast<std::size_t>(zero->outputs[0])].value.empty());
  EXPECT_FALSE(expanded(system({pow(s(0) + s(1) + s(2) + s(3) + s(4), 12)}), 100));
}

TEST_F(Optimise, PowersShareTheirSquares) {
  EXPECT_EQ(count_operations(optimise({pow(s(0), 8)})), (OperationCount{3, 0, 0, 0}));
  EXPECT_EQ(count_operations(optimise({pow(s(0), 4), pow(s(0), 6)})), (OperationCount{3, 0, 0, 0}));
  EXPECT_EQ(count_operations(optimise({pow(s(0), ex(3) / 2)})), (OperationCount{1, 0, 0, 1}));
  // 1/r and 1/r^3 from one root and one division.
  const ex r2 = pow(s(0), 2) + pow(s(1), 2);
  const OperationCount count =
      count_operations(optimise({pow(r2, ex(-1) / 2), s(0) * pow(r2, ex(-3) / 2)}));
  EXPECT_EQ(count.calls, 1);
  EXPECT_EQ(count.div, 1);
}

TEST_F(Optimise, DivisionsAreNotMultiplied) {
  EXPECT_EQ(count_operations(optimise({s(0) / s(1)})), (OperationCount{0, 0, 1, 0}));
  EXPECT_EQ(count_operations(optimise({s(0) / (s(1) * s(2))})), (OperationCount{1, 0, 1, 0}));
  EXPECT_EQ(count_operations(optimise({s(0) / s(1), s(2) / s(1), s(3) / s(1)})),
            (OperationCount{3, 0, 1, 0}));
}

/// Multiplied out, the square of a sum loses its digits where the sum is small: (x y - z)^2 =
/// 10^(-16) is then the difference of numbers that are rounded to 10^(-16).
TEST_F(Optimise, PowersOfSumsThatAreMultipliedOutAreFoldedAgain) {
  const ex sum = s(0) * s(1) - s(2);
  const std::vector<ex> all{sum * s(3), (s(4) * sum + s(3) * sum * sum + s(0)).expand()};
  const Program program = optimise(all);
  EXPECT_LE(weight(count_operations(program)),
            weight(count_operations(optimise({sum * s(3), s(4) * sum + s(3) * sum * sum + s(0)}))));
  Points points;
  const std::vector<cln::cl_RA> at = point(points);
  EXPECT_EQ(exact(program, at)[1], value(all[1], at));
  const ex square = (s(3) * sum * sum).expand();
  const double x = 1 + 1e-8, y = 1 - 2e-8, z = 1;
  const double near =
      evaluate(optimise({sum * s(4), square}), std::vector<double>{x, y, z, 1, 1})[1];
  EXPECT_NEAR(near / ((x * y - z) * (x * y - z)), 1, 1e-6);
  const double lost = evaluate(optimise({square}), std::vector<double>{x, y, z, 1, 0})[0];
  EXPECT_GT(std::abs(lost / ((x * y - z) * (x * y - z)) - 1), 1e-3);  // nothing says what it was
}

TEST_F(Optimise, SumsAreTakenOutOfAnExpansionWhereThatIsShorter) {
  const ex sum = s(0) * s(1) - s(2);
  const TermSystem folded = with_sums_taken_out(
      *expanded(system({s(3) * sum, s(4) * sum * (sum - 2 * s(1)), s(0) * s(1) + s(2)}), 100), 30);
  EXPECT_TRUE(has_power_of_sum(folded));
  const auto terms = [&](std::size_t i) {
    return folded.variables[static_cast<std::size_t>(folded.outputs[i])].value.size();
  };
  EXPECT_EQ(terms(0), 1U);
  EXPECT_EQ(terms(1), 2U);
  EXPECT_EQ(terms(2), 2U);  // another sum
}

TEST_F(Optimise, SquaresOfSineAndCosineAreJoined) {
  const ex a = s(0) * sin(s(1)) + s(2) * cos(s(1)), b = s(0) * cos(s(1)) - s(2) * sin(s(1));
  const OperationCount rotated = count_operations(optimise({a * a + b * b}));
  EXPECT_EQ(rotated, (OperationCount{2, 1, 0, 0}));
  const OperationCount hyperbolic =
      count_operations(optimise({s(0) * pow(cosh(s(1)), 2) - s(0) * pow(sinh(s(1)), 2)}));
  EXPECT_EQ(hyperbolic, (OperationCount{0, 0, 0, 0}));
  // The twins: another sign, another angle, another factor.
  for (const ex& other :
       {pow(sin(s(1)), 2) - pow(cos(s(1)), 2), pow(sin(s(1)), 2) + pow(cos(s(2)), 2),
        pow(cosh(s(1)), 2) + pow(sinh(s(1)), 2), pow(sin(s(1)), 2) + 2 * pow(cos(s(1)), 2)})
    EXPECT_EQ(count_operations(optimise({other})).calls, 2) << other;
}

// Written so, whoever follows the signs of a motion sees that these jump, or turn, where x = 0.
TEST_F(Optimise, SquaresComeOutOfRoots) {
  const ex x = s(0), y = s(1);
  const auto uses = [](const Program& program, Op op) {
    return std::ranges::count(program.code, op, &Instruction::op);
  };
  struct Root {
    ex value;
    Op of_x;
    double expected;
  };
  const double a = -0.75, b = 1.5;
  const std::vector<Root> roots{
      {x / sqrt(x * x + pow(x, 4)), Op::sign, -1 / std::sqrt(1 + a * a)},
      {sqrt(x * x) / x, Op::sign, -1},
      {pow(x * x, ex(3) / 2) / x, Op::abs, a * -a},
      {pow(x * x, ex(1) / 2) / pow(x, 3), Op::sign, -1 / (a * a)},
      {x / pow(pow(x, 4) * y, ex(1) / 4), Op::sign, -std::pow(b, -0.25)},
      {y / sqrt(x * x * y + x * x * y * y), Op::abs, b / (-a * std::sqrt(b + b * b))},
      {sqrt(pow(x, 2) - pow(x, 3) * y), Op::abs, -a * std::sqrt(1 - a * b)},
      {sin(x) / sqrt(pow(sin(x), 2) + pow(sin(x), 4)), Op::sign,
       -1 / std::sqrt(1 + std::sin(a) * std::sin(a))},
      {sqrt((x * x + pow(x, 4)) * (1 + y * y)), Op::abs,
       -a * std::sqrt((1 + a * a) * (1 + b * b))}};
  for (const Root& root : roots) {
    const Program program = optimise({root.value});
    EXPECT_EQ(uses(program, root.of_x), 1) << root.value;
    std::vector<double> inputs(program.inputs.size());
    inputs[0] = a;
    inputs[1] = b;
    EXPECT_NEAR(evaluate(program, inputs)[0], root.expected, 1e-14) << root.value;
  }
  // The twins: no factor is a square.
  for (const ex& other : {sqrt(x * x + pow(x, 3) + y), sqrt(x * y), sqrt(x * x + y * y)})
    EXPECT_EQ(uses(optimise({other}), Op::abs), 0) << other;
}

TEST_F(Optimise, DeadCodeGoesAway) {
  Program program{
      {"x"},
      {2, 5},
      {{Op::input, 0}, {Op::constant, 0}, {Op::constant, 1}, {Op::mul, 0, 1}, {Op::add, 0, 2}},
      {4},
      {"f"}};
  const Program live = without_dead_code(program);
  EXPECT_EQ(live.code.size(), 3u);
  EXPECT_EQ(live.constants.size(), 1u);
  EXPECT_EQ(exact(live, {7})[0], 12);
}

TEST(OptimiseKovalevskaya, IsWhatAPersonWouldWrite) {
  const Specialisation spec = casimir::testing::specialised(casimir::testing::kKovalevskaya);
  EXPECT_LE(spec.specialised.mul, 9);
  EXPECT_LE(spec.specialised.add, 5);
  EXPECT_EQ(spec.specialised.div, 0);
  EXPECT_GT(spec.general.mul, spec.specialised.mul);
}

}  // namespace
}  // namespace casimir::codegen
