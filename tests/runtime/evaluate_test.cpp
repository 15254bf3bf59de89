#include "runtime/evaluate.hpp"

#include <cln/float_io.h>
#include <cln/rational_io.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/runtime/programs.hpp"

namespace casimir::test {
namespace {

TEST(Evaluate, RationalsStayExact) {
  const std::vector<cln::cl_RA> x = {
      1, cln::cl_RA("1/2"), cln::cl_RA("1/3"), cln::cl_RA("3/5"), 0, cln::cl_RA("4/5"), 0};
  const std::vector<cln::cl_RA> slope = evaluate(kovalevskaya_program(), x);
  EXPECT_EQ(slope[0], cln::cl_RA("1/6"));
  EXPECT_EQ(slope[1], cln::cl_RA("-17/15"));
  EXPECT_EQ(slope[4], cln::cl_RA("2/5"));
  EXPECT_EQ(slope[5], cln::cl_RA("3/10"));
  const std::vector<double> same =
      evaluate<double>(kovalevskaya_program(), {1, 0.5, 1. / 3, 0.6, 0, 0.8, 0});
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(same[i], cln::double_approx(slope[i]), 1e-15);
}

/// The value of one operation at an argument.
template <class Number>
Number apply(Op op, const cln::cl_RA& a, const cln::cl_RA& b,
             const Arithmetic<Number>& arithmetic) {
  Builder builder({});
  const int first = builder.number(a), second = builder.number(b);
  const bool binary = op == Op::add || op == Op::sub || op == Op::mul || op == Op::div ||
                      op == Op::pow || op == Op::atan2;
  Program program = builder.program();
  program.code.push_back({op, first, binary ? second : -1});
  program.outputs = {static_cast<int>(program.code.size()) - 1};
  return evaluate<Number>(program, {arithmetic.from(cln::cl_RA(0))}, arithmetic)[0];
}

TEST(Evaluate, OperationsAgreeWithTheBuiltInOnes) {
  const Arithmetic<cln::cl_F> wide(40);
  const Arithmetic<double> narrow;
  const Arithmetic<long double> extended;
  const cln::cl_RA a("3/7"), b("2/5");
  for (const Op op : {Op::add, Op::sub, Op::mul, Op::div, Op::neg, Op::pow, Op::sqrt, Op::sin,
                      Op::cos, Op::tan, Op::exp, Op::log, Op::asin, Op::acos, Op::atan2}) {
    const cln::cl_F exact = apply(op, a, b, wide);
    EXPECT_NEAR(apply(op, a, b, narrow), cln::double_approx(exact), 3e-16) << static_cast<int>(op);
    // long double has 64 bits: its error is far below that of a double.
    const long double value = apply(op, a, b, extended);
    const double high = static_cast<double>(value);
    const double low = static_cast<double>(value - high);
    const cln::cl_F sum = cln::cl_float(cln::rational(cln::cl_DF(high)), exact) +
                          cln::cl_float(cln::rational(cln::cl_DF(low)), exact);
    EXPECT_LT(std::abs(cln::double_approx(cln::cl_F(sum - exact))), 1e-18) << static_cast<int>(op);
  }
  EXPECT_EQ(apply(Op::pow, 2, cln::cl_RA("3/2"), narrow), std::pow(2., 1.5));
  EXPECT_EQ(apply(Op::atan2, 1, -1, narrow), std::atan2(1., -1.));
  EXPECT_NEAR(cln::double_approx(apply(Op::atan2, -1, -1, wide)), std::atan2(-1., -1.), 1e-15);
}

TEST(Evaluate, ExactTypesRefuseWhatIsNoNumber) {
  const Arithmetic<cln::cl_F> wide(40);
  const Arithmetic<cln::cl_RA> exact;
  EXPECT_THROW(apply(Op::div, 1, 0, wide), std::domain_error);
  EXPECT_THROW(apply(Op::div, 1, 0, exact), std::domain_error);
  EXPECT_THROW(apply(Op::sqrt, -1, 0, wide), std::domain_error);
  EXPECT_THROW(apply(Op::sqrt, 2, 0, exact), std::domain_error);
  EXPECT_EQ(apply(Op::sqrt, cln::cl_RA("4/9"), 0, exact), cln::cl_RA("2/3"));
  EXPECT_THROW(apply(Op::log, -1, 0, wide), std::domain_error);
  EXPECT_THROW(apply(Op::log, 0, 0, wide), std::domain_error);
  EXPECT_THROW(apply(Op::pow, -1, cln::cl_RA("1/3"), wide), std::domain_error);
  EXPECT_THROW(apply(Op::asin, 2, 0, wide), std::domain_error);
  EXPECT_THROW(apply(Op::atan2, 0, 0, wide), std::domain_error);
  EXPECT_THROW(apply(Op::sin, 1, 0, exact), std::domain_error);
  EXPECT_TRUE(std::isnan(apply(Op::sqrt, -1, 0, Arithmetic<double>{})));  // IEEE does not throw
}

}  // namespace
}  // namespace casimir::test
