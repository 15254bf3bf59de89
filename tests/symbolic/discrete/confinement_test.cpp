// Singularities of maps: which ones lose what, and which give it back.
#include "symbolic/discrete/confinement.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "symbolic/discrete/degrees.hpp"
#include "symbolic/discrete/growth.hpp"
#include "tests/symbolic/cases.hpp"
#include "tests/symbolic/discrete/maps.hpp"

namespace casimir::test {
namespace {

using discrete::Confinement;
using discrete::confinement_of;
using Kind = Confinement::Kind;

/// x+ + x- = f(x) and others of the plane.
MapModel plane(const std::string& x, const std::string& y) {
  return map_of(
      "[phase_space]\nvariables = [\"x\", \"y\"]\n[parameters]\na = {}\nb = {}\n[map]\nx = \"" + x +
      "\"\ny = \"" + y + "\"\n");
}

/// "confined 1-4": which iterates lose and recover.
std::string text_of(const Confinement& found) {
  std::string text = to_string(found.kind);
  for (const auto& orbit : found.orbits)
    text += fmt::format(" {}-{}", orbit.lost, orbit.recovered.value_or(0));
  return text;
}

// At a = 0, the only value, the map is linear.
TEST(Degrees, OfParametersWithoutGenericValuesAreRefused) {
  const MapModel map = map_of(
      "[phase_space]\nvariables = [\"x\", \"y\"]\n[parameters]\na = { assume = \"a^2 <= 0\" }\n"
      "[map]\nx = \"y\"\ny = \"-x + y + a*y^2\"\n");
  EXPECT_THROW(discrete::degrees_of_iterates(map), ModelError);
}

TEST(Confinement, IntegrableMapsGiveBackWhatTheyLose) {
  for (const char* name : {"mcmillan", "lyness", "qrt", "kahan-euler"}) {
    const Confinement found = confinement_of(bundled_map(name));
    EXPECT_EQ(found.kind, Kind::confined) << name << " " << text_of(found);
  }
  EXPECT_EQ(confinement_of(plane("-y + a/x + b/x^2", "x")).kind, Kind::confined);
  EXPECT_EQ(confinement_of(plane("-x - y + a/x + b", "x")).kind, Kind::confined);
}

/// Confinement is not enough for integrability.
TEST(Confinement, TheMapOfHietarintaAndVialletIsConfinedAndHasEntropy) {
  const MapModel map = plane("-y + x + a/x^2", "x");
  const Confinement found = confinement_of(map);
  EXPECT_EQ(found.kind, Kind::confined);
  ASSERT_EQ(found.orbits.size(), 1U);
  EXPECT_EQ(found.orbits[0].lost, 1);
  EXPECT_EQ(found.orbits[0].recovered, 4);
  EXPECT_EQ(discrete::growth_of(discrete::degrees_of_iterates(map, {7, false})).kind,
            discrete::Growth::Kind::exponential);
}

TEST(Confinement, OthersDoNot) {
  EXPECT_EQ(confinement_of(plane("-y + a/x + b/x^3", "x")).kind, Kind::not_confined);
  EXPECT_EQ(confinement_of(plane("-y + a/x^3", "x")).kind, Kind::not_confined);
  EXPECT_EQ(confinement_of(plane("x^2 + y", "y")).kind, Kind::not_confined);
  const Model lorenz = model_of(
      "[phase_space]\nvariables = [\"x\", \"y\", \"z\"]\n[equations]\nx = \"10*(y - x)\"\ny = "
      "\"28*x - y - x*z\"\nz = \"x*y - 8*z/3\"\n");
  EXPECT_EQ(discrete::confinement_of_kahan(lorenz).kind, Kind::not_confined);
}

TEST(Confinement, OfAnInvertiblePolynomialMapThereIsNothingToConfine) {
  EXPECT_EQ(confinement_of(bundled_map("henon-area-preserving")).kind, Kind::none);
  EXPECT_EQ(confinement_of(plane("2*x + y", "x")).kind, Kind::none);
}

/// Its determinant has no zeros, since it is zero everywhere.
TEST(Confinement, OfAMapThatIsInvertibleNowhereNothingIsSaid) {
  EXPECT_EQ(confinement_of(plane("x*y", "x*y")).kind, Kind::unclear);
}

/// Poles whose orders grow by a factor of about thirty in a step.
TEST(Confinement, SaysHowFarItLooked) {
  const Confinement found = confinement_of(plane("-y + x^31 + a/x", "x"));
  ASSERT_EQ(found.kind, Kind::not_confined);
  EXPECT_LT(found.steps, 12);
  for (const auto& orbit : found.orbits) EXPECT_GE(orbit.until, found.steps);
}

/// Both ways to Kahan's map.
TEST(Confinement, OfKahansMap) {
  const Confinement flow = discrete::confinement_of_kahan(bundled("euler"));
  EXPECT_EQ(flow.kind, Kind::confined);
  EXPECT_EQ(text_of(flow), text_of(confinement_of(bundled_map("kahan-euler"))));
}

/// The critical points of x^6/6 - c x^2/2 - x are no numbers of the field for some c: where no
/// point was found, nothing is said.
TEST(Confinement, AHypersurfaceWithoutPointsIsNotCalledHarmless) {
  bool met = false;
  for (int c = 1; c < 400 && !met; ++c) {
    const MapModel map = map_of(fmt::format(
        "[phase_space]\nvariables = [\"x\"]\n[map]\nx = \"x^6/6 - {}*x^2/2 - x\"\n", c));
    const Confinement found = confinement_of(map);
    EXPECT_NE(found.kind, Kind::none) << c;
    met = found.kind == Kind::unclear;
  }
  EXPECT_TRUE(met);
}

/// y^2 = 17 has no points over the field, where y^2 = 4 has, and the map does the same there.
TEST(Confinement, ThatOfOneHypersurfaceSaysNothingOfAnother) {
  EXPECT_EQ(confinement_of(plane("y", "-x + 1/y + y + y/(y^2-4)^2")).kind, Kind::not_confined);
  EXPECT_EQ(confinement_of(plane("y", "-x + 1/y + y + y/(y^2-17)^2")).kind, Kind::unclear);
  // With a parameter there are points for some of its values.
  EXPECT_EQ(confinement_of(plane("y", "-x + 1/y + y + y/(y^2-a)^2")).kind, Kind::not_confined);
  EXPECT_EQ(confinement_of(plane("-y + 2*a*x/(x^2 - b)", "x")).kind, Kind::confined);
}

}  // namespace
}  // namespace casimir::test
