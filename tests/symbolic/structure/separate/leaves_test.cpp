// Symplectic leaves of a bracket.
#include <gtest/gtest.h>

#include <algorithm>

#include "symbolic/structure/separate/leaves.hpp"
#include "tests/symbolic/structure/separations.hpp"

namespace casimir::test {
namespace {

/// On the leaves of e(3): M1, g1 are not tangent to them, the bracket and its multiples are.
TEST(LeavesOfABracket, KnowWhichBivectorsAreTangent) {
  const Model model = bundled("goryachev-chaplygin");
  structure::Leaves leaves(model, {}, {});
  EXPECT_EQ(leaves.degrees_of_freedom(), 2U);
  structure::Bivector p = leaves.bivector();
  int minors = 0;
  for (const std::vector<std::size_t>& rows : leaves.choices(4)) {
    if (leaves.vanishes(structure::pfaffian(p, 6, rows))) continue;
    ++minors;
    EXPECT_TRUE(leaves.is_tangent(p, rows));
    structure::Bivector changed = p;
    changed[2] += leaves.ring().constant(1);
    EXPECT_FALSE(leaves.is_tangent(changed, rows));
  }
  EXPECT_GT(minors, 0);
}

}  // namespace
}  // namespace casimir::test
