// Discrete Darboux polynomials of maps, and what they are put together to.
#include "symbolic/discrete/map_darboux.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/symbolic/discrete/maps.hpp"

namespace casimir::test {
namespace {

using Combination = search::DarbouxCombination::Kind;

std::pair<Text, Text> value(const std::string& name, const std::string& number) {
  return {Text{name, {}, name}, Text{number, {}, number}};
}

MapModel rational_plane(const std::string& x, const std::string& y) {
  return map_of(kPhaseSpaceOfPlane + "[map]\nx = \"" + x + "\"\ny = \"" + y + "\"\n");
}

std::vector<std::pair<std::string, std::string>> texts_of(const discrete::MapDarboux& found) {
  std::vector<std::pair<std::string, std::string>> result;
  for (const search::DarbouxPolynomial& own : found.found)
    result.emplace_back(own.text, own.cofactor);
  return result;
}

long count_of(const discrete::MapDarboux& found, Combination kind) {
  return std::ranges::count(found.combinations, kind, &search::DarbouxCombination::kind);
}

/// P(x') = C P at a point, by GiNaC alone.
void expect_darboux(const MapModel& map, const discrete::MapDarboux& found) {
  GiNaC::exmap point;
  for (std::size_t i = 0; i < map.base.variables.size(); ++i)
    point[map.base.variables[i]] = GiNaC::numeric(static_cast<long>(3 * i + 2), 7);
  for (const search::DarbouxPolynomial& own : found.found)
    EXPECT_TRUE(
        (map.composed(own.value) - own.cofactor_value * own.value).subs(point).normal().is_zero())
        << own.text;
}

TEST(MapDarboux, OfATriangularMapHaveNumbersAsCofactors) {
  const MapModel map = rational_plane("2*x", "3*y + x^2");
  const auto found = discrete::find_map_darboux(map, 3);
  EXPECT_TRUE(found.complete) << found.reason;
  using Texts = std::vector<std::pair<std::string, std::string>>;
  EXPECT_EQ(texts_of(found), (Texts{{"x", "2"}, {"x^2 - y", "3"}}));
  EXPECT_EQ(count_of(found, Combination::integral), 0);
  EXPECT_EQ(count_of(found, Combination::multiplier), 1);
}

/// C = x is made of a factor of a denominator, with a positive exponent.
TEST(MapDarboux, OfAMapWithAPoleMayVanishThere) {
  const auto found = discrete::find_map_darboux(rational_plane("1/x", "x*y"), 1);
  EXPECT_TRUE(std::ranges::any_of(
      found.found, [](const auto& own) { return own.text == "y" && own.cofactor == "x"; }));
}

/// Of these P is a factor of the denominator of C, or C has no other: x, y and z = 1 - x - y of
/// Cremona's involution, x' = y z/f, y' = x z/f, with f = x y + y z + z x; x of 1/x.
TEST(MapDarboux, MayBeFactorsOfTheDenominatorsOfCofactors) {
  const auto has = [](const discrete::MapDarboux& found, const std::string& p) {
    return std::ranges::any_of(found.found, [&](const auto& own) { return own.text == p; });
  };
  const std::string f = "(y*(1 - x - y) + x*(1 - x - y) + x*y)";
  const MapModel cremona = rational_plane("y*(1 - x - y)/" + f, "x*(1 - x - y)/" + f);
  const auto linear = discrete::find_map_darboux(cremona, 1);
  for (const char* p : {"x", "y", "x + y - 1", "x - y"}) EXPECT_TRUE(has(linear, p)) << p;
  expect_darboux(cremona, linear);
  EXPECT_TRUE(has(discrete::find_map_darboux(cremona, 2), "x^2 + x*y + y^2 - x - y"));
  const auto cycle = discrete::find_map_darboux(rational_plane("y", "1/(x*y)"), 1);
  EXPECT_TRUE(has(cycle, "x") && has(cycle, "y"));
  const auto squares = discrete::find_map_darboux(rational_plane("y^2", "x^2"), 1);
  EXPECT_TRUE(has(squares, "x") && has(squares, "y"));
  EXPECT_TRUE(has(discrete::find_map_darboux(rational_plane("1/x", "y"), 1), "x"));
}

/// The factors x and y, and the three of the cubic, are exchanged by the map.
TEST(MapDarboux, OfLynessMapGiveItsIntegralAndItsMeasure) {
  const MapModel map = rational_plane("y", "(5/7 + y)/x");
  const auto found = discrete::find_map_darboux(map, 3);
  EXPECT_TRUE(found.complete) << found.reason;
  ASSERT_EQ(found.found.size(), 2U);
  EXPECT_EQ(found.found[0].text, "x*y");
  EXPECT_EQ(found.found[0].cofactor, "1/7*(7*y + 5)/x^2");
  EXPECT_EQ(found.found[1].degree, 3);
  expect_darboux(map, found);
  EXPECT_EQ(count_of(found, Combination::integral), 1);
  EXPECT_EQ(count_of(found, Combination::multiplier), 1);
  for (const search::DarbouxCombination& own : found.combinations) {
    if (own.kind == Combination::multiplier) {
      EXPECT_EQ(own.text, "1/(x*y)");
    }
  }
}

/// Hirota's and Kimura's top: two integrals and a measure from four polynomials.
TEST(MapDarboux, OfKahansEulerTopGiveBothIntegrals) {
  const MapModel map = bundled_map(
      "kahan-euler", {value("a1", "1"), value("a2", "2"), value("a3", "-3"), value("eps", "1/2")});
  const auto found = discrete::find_map_darboux(map, 2);
  EXPECT_TRUE(found.complete) << found.reason;
  EXPECT_EQ(found.found.size(), 4U);
  EXPECT_TRUE(found.has_jacobian);
  expect_darboux(map, found);
  EXPECT_EQ(count_of(found, Combination::integral), 2);
  EXPECT_EQ(count_of(found, Combination::multiplier), 1);
}

/// Kahan's map of Lotka and Volterra keeps dx dy/(x y) and no integral.
TEST(MapDarboux, OfLotkaAndVolterraAreTheAxes) {
  const MapModel map =
      rational_plane("x*(7*x + 5*y - 49)/(5*x - 7*y - 35)", "-y*(7*x + 5*y + 25)/(5*x - 7*y - 35)");
  const auto found = discrete::find_map_darboux(map, 3);
  EXPECT_TRUE(found.complete) << found.reason;
  EXPECT_EQ(found.found.size(), 2U);
  EXPECT_EQ(count_of(found, Combination::integral), 0);
  EXPECT_EQ(count_of(found, Combination::multiplier), 1);
}

/// x - y changes its sign: its square is kept.
TEST(MapDarboux, ACofactorOfMinusOneGivesASquare) {
  const auto found = discrete::find_map_darboux(rational_plane("y", "x"), 1);
  ASSERT_EQ(found.found.size(), 1U);
  EXPECT_EQ(found.found[0].cofactor, "-1");
  ASSERT_EQ(count_of(found, Combination::integral), 1);
  EXPECT_EQ(found.combinations[0].text, "(x - y)^2");
}

/// The eigenvalues of the rotation are no rational numbers, and those of its squares are: x^2 +
/// y^2. y - sqrt(3) x is real.
TEST(MapDarboux, WithAlgebraicCofactorsAreSaidToBe) {
  const auto found = discrete::find_map_darboux(rational_plane("x - y", "x + y"), 2);
  EXPECT_TRUE(std::ranges::any_of(
      found.found, [](const auto& own) { return own.text == "x^2 + y^2" && own.cofactor == "2"; }));
  EXPECT_TRUE(found.has_conjugates);
  const auto real = discrete::find_map_darboux(rational_plane("y", "3*x"), 1);
  EXPECT_TRUE(real.found.empty());
  EXPECT_TRUE(real.has_conjugates);
  EXPECT_FALSE(discrete::find_map_darboux(rational_plane("y", "4*x"), 1).has_conjugates);
}

/// y/2 doubles areas backwards, where both preimages of 2 x/(1 - x^2) make up for each other.
TEST(MapDarboux, DensitiesSayWhereTheyAreKept) {
  const auto found = discrete::find_map_darboux(rational_plane("2*x/(1-x^2)", "y/2"), 2);
  ASSERT_EQ(count_of(found, Combination::multiplier), 1);
  EXPECT_NE(found.combinations[0].evidence.find("one to one"), std::string::npos);
}

/// On the line y = 0, which is all there is, x is one more.
TEST(MapDarboux, AreNotAllWhereTheDomainIsThin) {
  const MapModel map = map_of(
      "[phase_space]\nvariables = [\"x\", \"y\"]\ndomain = [\"-(y^2) >= 0\"]\n[map]\nx = \"2*x + "
      "y\"\ny = \"y^2\"\n");
  const auto found = discrete::find_map_darboux(map, 1);
  EXPECT_FALSE(found.complete);
  EXPECT_FALSE(found.reason.empty());
}

TEST(MapDarboux, AreLookedForWithNumbers) {
  EXPECT_THROW(discrete::find_map_darboux(bundled_map("lyness"), 2), ModelError);
  EXPECT_THROW(discrete::find_map_darboux(rational_plane("sin(x)", "y"), 1), ModelError);
}

}  // namespace
}  // namespace casimir::test
