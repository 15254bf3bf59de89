// Searches of maps: what is found is proved, and "none" is said only where nothing is.
#include "symbolic/discrete/search_map.hpp"

#include <gtest/gtest.h>

#include "symbolic/discrete/prove_candidate.hpp"
#include "tests/symbolic/discrete/maps.hpp"

namespace casimir::test {
namespace {

using discrete::MapSearch;
using discrete::search_map;

MapModel with_values(const std::string& name,
                     const std::vector<std::pair<std::string, std::string>>& values) {
  ParameterValues fixed;
  for (const auto& [parameter, value] : values)
    fixed.push_back({{parameter, {}, {}}, {value, {}, {}}});
  return bundled_map(name, fixed);
}

MapModel plane(const std::string& text) {
  return build_map_model(std::get<MapCaseFile>(
      parse_any_case("[phase_space]\nvariables = [\"x\", \"y\"]\n" + text, "test.toml")));
}

TEST(SearchMap, FindsPolynomialsAndQuotients) {
  const MapSearch mcmillan = search_map(with_values("mcmillan", {{"mu", "2"}}), 4);
  ASSERT_EQ(mcmillan.integrals.size(), 1U);
  EXPECT_EQ(mcmillan.polynomials, 1U);
  EXPECT_EQ(mcmillan.densities.size(), 2U);
  const MapSearch lyness = search_map(with_values("lyness", {{"a", "2"}}), 3);
  ASSERT_EQ(lyness.integrals.size(), 1U);
  EXPECT_TRUE(lyness.no_polynomial);
  EXPECT_FALSE(lyness.no_fraction);
}

TEST(SearchMap, RefusesANegativeDegree) {
  EXPECT_THROW(search_map(with_values("lyness", {{"a", "2"}}), -1), ModelError);
}

TEST(SearchMap, SaysNothingWhereAParameterHasOneValueAlone) {
  // Real at a = 0 alone, where x^2 + y^2 is an integral.
  for (const char* lost : {"0*acos(1 + a^2)", "0*sqrt(-a^2)"}) {
    const MapSearch found =
        search_map(plane("[parameters]\na = {}\n[map]\nx = \"y\"\ny = \"-x + a*y^2 + " +
                         std::string(lost) + "\"\n"),
                   2);
    EXPECT_FALSE(found.no_polynomial) << lost;
    EXPECT_FALSE(found.no_fraction) << lost;
    EXPECT_FALSE(found.not_generic.empty()) << lost;
  }
  // A map of rational functions is not looked at: with 18 parameters it takes a while.
  EXPECT_TRUE(search_map(with_values("qrt", {}), 1).no_polynomial);
  EXPECT_TRUE(search_map(plane("[parameters]\na = {}\n[map]\nx = \"y\"\ny = \"-x + a*y^2\"\n"), 2)
                  .no_polynomial);
}

TEST(SearchMap, FindsTheIntegralsOfKahansEulerTop) {
  const MapModel map =
      with_values("kahan-euler", {{"a1", "1"}, {"a2", "3"}, {"a3", "2"}, {"eps", "1"}});
  const MapSearch found = search_map(map, 2);
  EXPECT_EQ(found.integrals.size(), 2U);
  EXPECT_EQ(found.relations, 2U);
  for (const auto& f : found.integrals)
    EXPECT_EQ(discrete::prove_integral(map, {f.text, f.value, {}}).verdict, Verdict::proved);
  // Symbolic parameters: the same dimensions, and no functions.
  const MapSearch generic = search_map(with_values("kahan-euler", {}), 2);
  EXPECT_EQ(generic.relations, 2U);
  EXPECT_TRUE(generic.integrals.empty());
  EXPECT_FALSE(generic.reason.empty());
}

TEST(SearchMap, SaysNoneOnlyWhereThereIsNone) {
  const MapSearch henon = search_map(with_values("henon-area-preserving", {}), 4);
  EXPECT_TRUE(henon.no_polynomial && henon.no_fraction);
  EXPECT_EQ(henon.density_space, 1U);
  const MapSearch one = search_map(plane("[map]\nx = \"x + y^2\"\ny = \"y\"\n"), 1);
  EXPECT_FALSE(one.no_polynomial);
  ASSERT_EQ(one.integrals.size(), 1U);
  EXPECT_EQ(one.integrals[0].text, "y");
  const MapSearch quotient = search_map(plane("[map]\nx = \"2*x + y\"\ny = \"2*y\"\n"), 1);
  EXPECT_TRUE(quotient.no_polynomial);
  const MapSearch ratio = search_map(plane("[map]\nx = \"2*x\"\ny = \"2*y\"\n"), 1);
  EXPECT_TRUE(ratio.no_polynomial);
  ASSERT_EQ(ratio.integrals.size(), 1U);
}

// x + 2147483659*y is kept, and no fraction below 2^30 is its coefficient: that is said.
/// Up to a higher degree an orbit lies on products of the hypersurfaces of a lower one as well.
/// The exchange of x and y keeps x + y and x*y dx dy, and also 1/(x - y) and dx dy: it reverses the
/// orientation, which a measure does not have.
TEST(SearchMap, DensitiesHaveNoOrientation) {
  const MapModel exchange = map_of(kPhaseSpaceOfPlane + "[map]\nx = \"y\"\ny = \"x\"\n");
  const auto found = discrete::search_map(exchange, 1, {});
  // Of 1, x + y and x - y.
  EXPECT_EQ(found.density_space, 3U);
  EXPECT_EQ(found.densities.size(), 3U);
  const MapModel reversing = map_of(kPhaseSpaceOfPlane + "[map]\nx = \"y\"\ny = \"x + y^2\"\n");
  EXPECT_EQ(discrete::search_map(reversing, 2, {}).density_space, 1U);
}

TEST(SearchMap, FindsQuotientsOfLowerDegreesToo) {
  const MapSearch found = search_map(plane("[map]\nx = \"x^2\"\ny = \"x*y\"\n"), 2);
  ASSERT_EQ(found.integrals.size(), 1U);
  EXPECT_EQ(found.integrals[0].text, "(y)/(x)");
  EXPECT_TRUE(found.reason.empty()) << found.reason;
  // Of period 5: what is found is a quotient of densities.
  const MapSearch pentagon = search_map(plane("[map]\nx = \"y\"\ny = \"(1 + y)/x\"\n"), 3);
  EXPECT_GE(pentagon.integrals.size(), 1U);
  EXPECT_TRUE(pentagon.reason.empty()) << pentagon.reason;
}

TEST(SearchMap, SaysThatLargeCoefficientsAreNotShown) {
  const MapSearch found =
      search_map(plane("[map]\nx = \"x + 2147483659*y^2\"\ny = \"y - y^2\"\n"), 1);
  EXPECT_EQ(found.polynomials, 1U);
  EXPECT_TRUE(found.integrals.empty());
  EXPECT_FALSE(found.reason.empty());
}

TEST(SearchMap, RefusesWhatIsNotRational) {
  EXPECT_THROW(search_map(plane("[map]\nx = \"sin(x)\"\ny = \"y\"\n"), 2), ModelError);
}

// a is 0, where x is an integral: what holds for all other values proves nothing.
TEST(SearchMap, ProvesNothingWhereTheAssumptionsLeaveOneValue) {
  const std::string equations = "[map]\nx = \"x + a\"\ny = \"2*y\"\n";
  const MapSearch one =
      search_map(plane("[parameters]\na = { assume = \"a^2 <= 0\" }\n" + equations), 1);
  EXPECT_FALSE(one.no_polynomial || one.no_fraction);
  EXPECT_FALSE(one.not_generic.empty());
  const MapSearch all =
      search_map(plane("[parameters]\na = { assume = \"a > 0\" }\n" + equations), 1);
  EXPECT_TRUE(all.no_polynomial && all.no_fraction);
}

}  // namespace
}  // namespace casimir::test
