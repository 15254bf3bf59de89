// Case files with a table [map]: what is read, and how what is wrong is said.
#include <gtest/gtest.h>

#include "symbolic/discrete/map_model.hpp"
#include "tests/symbolic/discrete/maps.hpp"

namespace casimir::test {
namespace {

std::string error_of(const std::string& toml) {
  try {
    map_of(toml);
  } catch (const CaseError& problem) {
    return problem.what();
  }
  return "";
}

const std::string kSpace = "[phase_space]\nvariables = [\"x\", \"y\"]\n";

TEST(MapCase, HasNextValuesAndNoFlow) {
  const MapModel map =
      map_of(kSpace + "[parameters]\na = {}\n[map]\ny = \"(a + y)/x\"\nx = \"y\"\n");
  ASSERT_EQ(map.next.size(), 2U);
  EXPECT_TRUE(map.next[0].is_equal(map.base.variables[1]));
  EXPECT_TRUE(map.base.field.empty());
  EXPECT_FALSE(map.base.hamiltonian);
  EXPECT_EQ(map.base.phase_space, "map");
}

TEST(MapCase, ComposesItsSteps) {
  const MapModel map = map_of(kSpace +
                              "[[map_step]]\nexpressions = { x = \"x + y\" }\n"
                              "[[map_step]]\nexpressions = { y = \"y - x\" }\n");
  const auto& x = map.base.variables;
  EXPECT_EQ(map.steps.size(), 2U);
  EXPECT_TRUE((map.next[0] - x[0] - x[1]).expand().is_zero());
  EXPECT_TRUE((map.next[1] + x[0]).expand().is_zero());
}

TEST(MapCase, SaysWhereAnErrorIs) {
  EXPECT_NE(error_of(kSpace + "[map]\nx = \"y\"\n")
                .find("test.toml:3:1: error: the map gives no "
                      "expression for 'y'"),
            std::string::npos);
  EXPECT_NE(error_of(kSpace + "[map]\nx = \"y\"\nz = \"x\"\n").find("test.toml:5:1: error: 'z'"),
            std::string::npos);
  EXPECT_NE(error_of(kSpace + "[map]\nx = \"y\"\ny = \"x + w\"\n").find("test.toml:5:10"),
            std::string::npos);
  EXPECT_NE(error_of("hamiltonian = \"x\"\n" + kSpace + "[map]\nx = \"y\"\ny = \"x\"\n")
                .find("'hamiltonian' is about a flow"),
            std::string::npos);
  EXPECT_NE(error_of(kSpace + "[map]\nx = \"y\"\ny = \"x\"\n[equations]\nx = \"1\"\ny = \"1\"\n")
                .find("'equations' is about a flow"),
            std::string::npos);
  EXPECT_NE(error_of("map_sign = \"-\"\n" + kSpace + "[map]\nx = \"y\"\ny = \"x\"\n")
                .find("needs a bracket"),
            std::string::npos);
  EXPECT_NE(error_of(kSpace + "[map]\nx = \"y\"\ny = \"x\"\n[definitions]\nf = \"rate(x)\"\n")
                .find("the equations of motion are not known here"),
            std::string::npos);
}

TEST(MapCase, IsRefusedWhereAFlowIsNeeded) {
  try {
    parse_case(kSpace + "[map]\nx = \"y\"\ny = \"x\"\n", "test.toml");
    FAIL();
  } catch (const CaseError& problem) {
    EXPECT_EQ(std::string(problem.what()).find("test.toml:3:1: error: this is the case of a map"),
              0U)
        << problem.what();
  }
}

TEST(MapCase, KeysOfMapsAreNotForFlows) {
  EXPECT_THROW(parse_case("map_sign = \"-\"\nhamiltonian = \"x\"\n" + kSpace + "canonical = true\n",
                          "test.toml"),
               CaseError);
  // [map] with the keys of [[map]] is that one, misspelt.
  try {
    parse_case("hamiltonian = \"x\"\n" + kSpace +
                   "canonical = true\n[map]\nname = \"m\"\nto = \"so(3)\"\n[map.expressions]\nM1 = "
                   "\"x\"\n",
               "test.toml");
    FAIL();
  } catch (const CaseError& problem) {
    EXPECT_NE(std::string(problem.what()).find("[[map]]"), std::string::npos);
  }
}

}  // namespace
}  // namespace casimir::test
