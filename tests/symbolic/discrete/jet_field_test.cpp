// Jets against derivatives that GiNaC writes down.
#include "symbolic/discrete/jet_field.hpp"

#include <gtest/gtest.h>

#include "symbolic/discrete/modular_program.hpp"

namespace casimir::test {
namespace {

using discrete::Element;
using discrete::Jet;
using discrete::JetField;
using discrete::ModularProgram;

TEST(JetField, HasTheDerivativesOfRationalFunctions) {
  const GiNaC::symbol x("x"), y("y"), a("a");
  const std::vector<GiNaC::ex> functions{
      (x * GiNaC::pow(y, 3) + a) / (1 + x * x - a * y),
      GiNaC::pow(x - GiNaC::numeric(2, 7) * y, 5) * GiNaC::pow(a + y, -2), x * x * x + a, a, y};
  std::vector<GiNaC::ex> slopes;
  for (const GiNaC::ex& f : functions)
    for (const GiNaC::symbol& s : {x, y}) slopes.push_back(f.diff(s));
  std::mt19937_64 random(7);
  const discrete::PrimeField field;
  for (int trial = 0; trial < 20; ++trial) {
    const std::vector<Element> at{field.random(random), field.random(random), field.random(random)};
    const auto expected = ModularProgram({x, y, a}, slopes).run(at);
    const auto jets =
        ModularProgram({x, y, a}, functions)
            .run_over(std::vector<Jet>{JetField::variable(at[0], 0, 2),
                                       JetField::variable(at[1], 1, 2), JetField::constant(at[2])},
                      JetField());
    ASSERT_TRUE(expected && jets);
    for (std::size_t i = 0; i < functions.size(); ++i)
      for (std::size_t j = 0; j < 2; ++j)
        EXPECT_EQ((*jets)[i].slopes.empty() ? 0 : (*jets)[i].slopes[j], (*expected)[2 * i + j])
            << functions[i] << " by the variable " << j;
  }
}

TEST(JetField, HasNoInverseOfZero) {
  EXPECT_FALSE(JetField().inverse(JetField::variable(0, 0, 1)));
  EXPECT_TRUE(JetField().inverse(JetField::variable(3, 0, 1)));
}

}  // namespace
}  // namespace casimir::test
