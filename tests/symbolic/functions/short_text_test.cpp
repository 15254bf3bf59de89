// Polynomials as a person would write them.
#include "symbolic/functions/short_text.hpp"

#include <gtest/gtest.h>

#include <random>

#include "symbolic/search/system.hpp"
#include "tests/bundled_cases.hpp"
#include "tests/symbolic/cases.hpp"
#include "tests/symbolic/search/search_cases.hpp"

namespace casimir::test {
namespace {

TEST(ShortText, IsTheIntegralInFewLetters) {
  const auto found = [](const std::string& name, int degree) {
    return search::find_integrals(
               build_model(read_case(CASIMIR_SOURCE_DIR "/cases/" + std::string(name) + ".toml")),
               up_to(degree))
        .found.at(0)
        .text;
  };
  EXPECT_EQ(found("kovalevskaya", 4), "(M2^2 + M3^2 - 2*g1*r)*(M1^2 + M3^2) - (M1*M2 + g2*r)^2");
  EXPECT_EQ(found("clebsch", 2), "s*(a1 - a3)*(a1 - a2)*p1^2 - (a1 - a2)*M2^2 - (a1 - a3)*M3^2");
}

TEST(ShortText, HasTheValueOfThePolynomial) {
  const Model model = model_of(euler_poisson("a*M1^2 + b*M2^2 + M3^2 + g1^2", "a = {}\nb = {}\n"));
  search::System system(model, {}, {});
  std::mt19937_64 random(7);
  const auto small = [&] { return static_cast<int>(random() % 5) - 2; };
  for (int round = 0; round < 30; ++round) {
    // A square and a product and some terms more, with parameters in them.
    std::vector<std::string> sums(4);
    for (std::string& sum : sums) {
      sum = "0";
      for (const char* name : {"M1", "M2", "M3*a", "g1*b", "g2", "g3*(a - b)"})
        sum += "+(" + std::to_string(small()) + ")*" + name;
    }
    const GiNaC::ex value = model.parse(text(std::to_string(small()) + "*(" + sums[0] + ")^2 + (" +
                                             sums[1] + ")*(" + sums[2] + ") + " + sums[3]));
    const Polynomial p = system.prover().convert(value);
    const std::string written = search::short_text(system.prover().ring(), p, system.is_constant());
    const GiNaC::ex back = model.parse(text(written));
    EXPECT_TRUE((value - back).expand().is_zero() || (value + back).expand().is_zero())
        << value << " is not " << written;
  }
}

}  // namespace
}  // namespace casimir::test
