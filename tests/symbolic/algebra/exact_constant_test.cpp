// Numbers that are zero, that are not, and that no theorem here decides.
#include "symbolic/algebra/exact_constant.hpp"

#include <gtest/gtest.h>

#include "symbolic/expression/expression.hpp"

namespace casimir::test {
namespace {

GiNaC::ex number(const std::string& text) {
  return parse_constant({text, {"test", 1, 1}, text}, {});
}

struct Known {
  const char* text;
  bool zero;
};

class ExactConstant : public testing::TestWithParam<Known> {};

TEST_P(ExactConstant, IsDecidedAndAgreesWithItsDigits) {
  const auto& [text, zero] = GetParam();
  const auto found = exact_constant(number(text));
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->zero, zero) << found->text;
  const GiNaC::numeric digits =
      GiNaC::ex_to<GiNaC::numeric>(GiNaC::abs(number(text).evalf()).evalf());
  EXPECT_EQ(digits < GiNaC::numeric(1, 100000000), zero) << digits;
}

INSTANTIATE_TEST_SUITE_P(
    Each, ExactConstant,
    testing::Values(
        Known{"sqrt(2)*sqrt(3) - sqrt(6)", true}, Known{"sqrt(2) + sqrt(3) - sqrt(5)", false},
        Known{"sqrt(8) - 2*sqrt(2)", true}, Known{"(1 + sqrt(2))*(1 - sqrt(2)) + 1", true},
        Known{"1/(1 + sqrt(2)) - sqrt(2) + 1", true}, Known{"2^(1/3)*4^(1/3) - 2", true},
        Known{"2^(1/2) - 2^(1/3)", false}, Known{"log(6) - log(2) - log(3)", true},
        Known{"log(2)/3 - 1", false}, Known{"log(2) - sqrt(2)*log(3) + Pi", false},
        Known{"exp(1/2)*exp(1/2) - exp(1)", true}, Known{"exp(1) + sqrt(2)*exp(2)", false},
        Known{"sin(1)^2 + cos(1)^2 - 1", true}, Known{"sin(2) - 2*sin(1)*cos(1)", true},
        Known{"tan(1/3) - sin(1/3)", false}, Known{"cosh(2/3)^2 - sinh(2/3)^2 - 1", true},
        Known{"cosh(1) - exp(1)/2", false}, Known{"tanh(1)*(exp(2) + 1) - exp(2) + 1", true},
        Known{"tanh(1/2)*cosh(1/2) - sinh(1)", false}, Known{"I^2 + 1", true},
        Known{"sqrt(3/4) - sqrt(3)/2", true}));

TEST(ExactConstantLimits, WhatNoTheoremCoversStaysOpen) {
  for (const char* text : {"exp(log(2)*log(3)) - 2", "log(2)*log(3) - 1", "exp(1) + Pi",
                           "sqrt(1 + sqrt(2)) - 1", "atan(2)"}) {
    EXPECT_FALSE(exact_constant(number(text)).has_value()) << text;
  }
}

}  // namespace
}  // namespace casimir::test
