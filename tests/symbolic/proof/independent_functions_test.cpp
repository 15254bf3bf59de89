// Functions that are independent over the constants on every piece, and such as are not.
#include "symbolic/proof/independent_functions.hpp"

#include <gtest/gtest.h>

#include "tests/symbolic/cases.hpp"

namespace casimir::test {
namespace {

bool are_independent(const std::vector<std::string>& texts) {
  const Model model =
      model_of("[phase_space]\nvariables = [\"x\", \"y\"]\n[equations]\nx = \"0\"\ny = \"0\"\n");
  std::vector<GiNaC::ex> expressions;
  for (const std::string& text : texts)
    expressions.push_back(model.parse({text, {"test", 1, 1}, text}));
  Prover prover(model, expressions, Subject::functions);
  prover.begin_claim(expressions, Subject::functions);
  std::vector<Polynomial> functions;
  for (const GiNaC::ex& e : expressions) functions.push_back(prover.convert(e));
  return independent_on_pieces(prover, functions);
}

TEST(IndependentFunctions, AreToldByTheirValues) {
  EXPECT_TRUE(are_independent({"sin(x)", "cos(x)", "1"}));
  EXPECT_TRUE(are_independent({"abs(x)", "x^2", "1"}));
  EXPECT_TRUE(are_independent({"sqrt(x^2 + y^2)", "x", "y"}));
  // By a relation, on each piece alone, and by one that the ring does not know.
  EXPECT_FALSE(are_independent({"sin(x)^2", "cos(x)^2", "1"}));
  EXPECT_FALSE(are_independent({"abs(x)", "x"}));
  EXPECT_FALSE(are_independent({"sqrt((1 - cos(x))/2)", "sin(x/2)"}));
  // Zero on a piece.
  EXPECT_FALSE(are_independent({"x + abs(x)"}));
}

TEST(IndependentFunctions, ExponentialsAreFreeWhereTheirExponentsAre) {
  std::vector<std::string> many;  // more than values are taken of
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < 8; ++j)
      many.push_back("exp(x)^" + std::to_string(i) + "*exp(x*y)^" + std::to_string(j) + "*y^2");
  EXPECT_TRUE(are_independent(many));
  EXPECT_TRUE(are_independent({"exp(x)", "exp(2*x)", "exp(x + y)"}));
  EXPECT_FALSE(are_independent({"exp(x)", "exp(x + 1)"}));
  EXPECT_FALSE(are_independent({"exp(x)*exp(y)", "exp(x + y)"}));
}

}  // namespace
}  // namespace casimir::test
