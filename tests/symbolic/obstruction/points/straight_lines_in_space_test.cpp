// Homogeneous potentials of three and more degrees of freedom.
#include "symbolic/obstruction/points/straight_lines_in_space.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "symbolic/case_file.hpp"

namespace casimir::obstruction {
namespace {

Obstruction of(const std::string& potential,
               const std::string& kinetic = "(px^2 + py^2 + pz^2)/2") {
  return find_obstruction(
      build_model(parse_case(
          fmt::format("title = \"A test\"\nsource = \"a test\"\nhamiltonian = \"{} + {}\"\n"
                      "[phase_space]\nvariables = [\"x\", \"y\", \"z\", \"px\", \"py\", \"pz\"]\n"
                      "canonical = true\n",
                      kinetic, potential),
          "test.toml")),
      {});
}

TEST(LinesInSpace, IntegrablePotentialsHaveEigenvaluesOfTheTable) {
  for (const char* v :
       {"x^3 + 2*y^3 + 5*z^3", "(x^2 + y^2 + z^2)^2", "(x^2 + y^2)^2 + z^4", "x^2*y + 2*y^3 + z^3",
        "(x^2 + y^2)*z + 2*z^3", "x^4 + 6*x^2*y^2 + y^4 + z^4",
        "1/(x - y)^2 + 1/(y - z)^2 + 1/(z - x)^2", "(x - y)^4 + (y - z)^4 + (z - x)^4",
        "((x + 2*y + 2*z)/3)^4 + 3*((2*x + y - 2*z)/3)^4 + 7*((2*x - 2*y + z)/3)^4"})
    EXPECT_FALSE(of(v).proved) << v;
}

TEST(LinesInSpace, OneEigenvalueOutsideOfTheTableExcludes) {
  for (const char* v : {"x*y*z", "x^3 + y^3 + z^3 + x*y*z", "(x^2*y^2 + y^2*z^2 + z^2*x^2)/2",
                        "x^4 + y^4 + z^4 + x^2*y^2"})
    EXPECT_TRUE(of(v).proved) << v;
  const Obstruction answer = of("x*y*z");
  EXPECT_NE(answer.excluded.find("3 functionally independent integrals"), std::string::npos);
}

TEST(LinesInSpace, MassesCount) {
  EXPECT_FALSE(of("x^4 + 6*x^2*y^2 + y^4 + z^4").proved);
  EXPECT_TRUE(of("x^4 + 6*x^2*y^2 + y^4 + z^4", "(px^2 + 2*py^2 + pz^2)/2").proved);
}

bool says_that_every_line_is_one(const Obstruction& answer) {
  return std::ranges::any_of(answer.left_out, [](const std::string& line) {
    return line.find("every line is one") != std::string::npos;
  });
}

TEST(LinesInSpace, OfARadiusAloneEveryLineIsOne) {
  const Obstruction answer = of("(x^2 + y^2 + z^2)^3");
  EXPECT_FALSE(answer.proved);
  EXPECT_TRUE(says_that_every_line_is_one(answer));
}

/// The only equation in the chart (0, 1, t) is t = 0.
TEST(LinesInSpace, OfOneCoordinateAloneOneLineIsOne) {
  EXPECT_FALSE(says_that_every_line_is_one(of("-y^3/3")));
}

}  // namespace
}  // namespace casimir::obstruction
