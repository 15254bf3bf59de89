#include "runtime/program/exact_number.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <random>

namespace casimir::test {
namespace {

TEST(ExactNumber, IsWhatTheDoubleIs) {
  EXPECT_EQ(exact_number(0.1), cln::cl_I("3602879701896397") / cln::cl_RA(cln::ash(1, 55)));
  const double least = std::numeric_limits<double>::denorm_min();
  EXPECT_EQ(exact_number(least) * cln::ash(1, 1074), 1);
  EXPECT_EQ(exact_number(-least) * cln::ash(1, 1074), -1);
  EXPECT_EQ(exact_number(0), 0);
}

TEST(ExactNumber, OfEveryFiniteDoubleIsNearestToItself) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 20000; ++i) {
    // Every fourth a subnormal one.
    const auto double_of = [](std::uint64_t bits) { return std::bit_cast<double>(bits); };
    const double x = double_of(random() & (i % 4 == 0 ? 0x800fffffffffffffU : ~std::uint64_t{0}));
    if (!std::isfinite(x)) continue;
    EXPECT_EQ(nearest_double(exact_number(x)), x);
  }
}

TEST(ExactNumber, NearestIsRoundedToEven) {
  const double least = std::numeric_limits<double>::denorm_min();
  const cln::cl_RA unit = exact_number(least);
  EXPECT_EQ(nearest_double(unit / 2), 0);
  EXPECT_EQ(nearest_double(unit * 3 / 4), least);
  EXPECT_EQ(nearest_double(unit * 3 / 2), 2 * least);
  EXPECT_EQ(nearest_double(unit * 5 / 2), 2 * least);
  EXPECT_EQ(nearest_double(exact_number(std::numeric_limits<double>::min()) - unit / 4),
            std::numeric_limits<double>::min());
}

}  // namespace
}  // namespace casimir::test
