// What Newton's polytope of a field says of cofactors.
#include "symbolic/search/newton_faces.hpp"

#include <gtest/gtest.h>

#include "symbolic/search/darboux.hpp"
#include "symbolic/search/system.hpp"
#include "tests/symbolic/cases.hpp"

namespace casimir::test {
namespace {

Model convection() {
  return model_of(
      "[phase_space]\nvariables = [\"x\", \"y\", \"z\"]\n[parameters]\ns = {}\nr = {}\nb = {}\n"
      "[equations]\nx = \"s*(y - x)\"\ny = \"r*x - y - x*z\"\nz = \"x*y - b*z\"\n");
}

/// -x*z d/dy and x*y d/dz are x^a D with a = (1, -1, 1) and (1, 1, -1), between which is x alone.
TEST(NewtonFaces, LeaveACofactorTheMonomialsOfThePolytope) {
  const Model model = convection();
  const search::System system(model, {}, {});
  const search::NewtonFaces faces(system.flow(), 3);
  EXPECT_TRUE(faces.allows({0, 0, 0}));
  EXPECT_TRUE(faces.allows({1, 0, 0}));
  EXPECT_FALSE(faces.allows({0, 1, 0}));
  EXPECT_FALSE(faces.allows({0, 0, 1}));
  EXPECT_EQ(faces.vertex({1, 0, 0}), nullptr);
  ASSERT_NE(faces.vertex({1, 1, -1}), nullptr);
  EXPECT_TRUE((*faces.vertex({1, 1, -1}))[2].is_constant());
}

/// x*y d/dx alone has the vector (0, 1), and x*y d/dx + x*y d/dy two with (1, 0) in the second.
TEST(NewtonFaces, CountAVariableLessForItsOwnRate) {
  const PolynomialRing ring(2);
  const Polynomial x = ring.variable(0), y = ring.variable(1), zero(ring);
  const search::NewtonFaces one({x * y, zero}, 2), two({x * y, x * y}, 2);
  EXPECT_TRUE(one.allows({0, 1}));
  EXPECT_FALSE(one.allows({1, 0}));
  EXPECT_TRUE(two.allows({1, 0}));
  EXPECT_NE(two.vertex({1, 0}), nullptr);
}

TEST(NewtonFaces, MakeTheSearchForDarbouxPolynomialsDecide) {
  const auto report = search::find_darboux_polynomials(convection(), 3);
  EXPECT_TRUE(report.complete) << report.reason;
  EXPECT_TRUE(report.found.empty());
}

}  // namespace
}  // namespace casimir::test
