// Which products of sums lose digits when they are written out.
#include "codegen/expansion_loss.hpp"

#include <gtest/gtest.h>

#include "tests/codegen/support.hpp"

namespace casimir {
namespace {

using testing::equations;
using testing::kKovalevskaya;
using testing::specialised;

bool loses(const std::string& rate) {
  return expansion_loses_digits(
      specialised(equations({{"x", rate}, {"y", "x"}, {"z", "y"}, {"w", "z"}})).rhs);
}

TEST(ExpansionLoss, SumsThatMayVanishTogetherLoseDigits) {
  for (const char* rate : {"-100*(x - 1)^2", "(x - y)^2/3", "(x - y)*(x - z)", "(x - 1)*(y - 2)",
                           "x + (Pi*x - y)*(3*y + 2)", "(x*sqrt(2) - y)^2"})
    EXPECT_TRUE(loses(rate)) << rate;
}

TEST(ExpansionLoss, SumsTimesOneStateDoNot) {
  for (const char* rate :
       {"10*(y - x)", "x*(y - 1)", "x^2 - y^2 - 1", "(1 + Pi)*(x - 1)", "x*(1 + sqrt(2))*y"})
    EXPECT_FALSE(loses(rate)) << rate;
  EXPECT_FALSE(expansion_loses_digits(specialised(kKovalevskaya).rhs));
}

TEST(ExpansionLoss, SumsOfOtherStatesVanishTogetherByChance) {
  EXPECT_FALSE(loses("(x - y)*(z + 2*w)"));
}

}  // namespace
}  // namespace casimir
