// Monomials within several limits of degrees, against trying all of a box.
#include "symbolic/search/degree_limit.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <random>
#include <set>

namespace casimir::test {
namespace {

using search::DegreeLimit;
using Exponents = std::vector<std::uint8_t>;

/// All of a box that is larger than the limits allow.
std::set<Exponents> by_trying(const std::vector<DegreeLimit>& limits, std::size_t places,
                              int largest) {
  std::set<Exponents> result;
  Exponents own(places, 0);
  const std::function<void(std::size_t)> choose = [&](std::size_t i) {
    if (i == places) {
      if (std::ranges::all_of(limits, [&](const DegreeLimit& limit) {
            return limit.of(own.data()) <= limit.degree;
          }))
        result.insert(own);
      return;
    }
    for (int power = 0; power <= largest; ++power) {
      own[i] = static_cast<std::uint8_t>(power);
      choose(i + 1);
    }
    own[i] = 0;
  };
  choose(0);
  return result;
}

std::set<Exponents> set_of(const search::Monomials& list) {
  std::set<Exponents> result;
  for (std::size_t c = 0; c < list.size(); ++c)
    result.insert(Exponents(list[c], list[c] + list.variables()));
  return result;
}

TEST(DegreeLimits, MonomialsWithinThemAreThoseOfABoxThatObeyThem) {
  std::mt19937_64 random(4);
  const auto number = [&](int least, int most) {
    return std::uniform_int_distribution<int>(least, most)(random);
  };
  int limited = 0;
  for (int k = 0; k < 300; ++k) {
    std::vector<DegreeLimit> limits;
    for (int l = number(1, 3); l > 0; --l) {
      DegreeLimit limit{{}, number(0, 4)};
      for (int i = 0; i < 3; ++i) limit.weights.push_back(number(-1, 2));
      limits.push_back(limit);
    }
    std::vector<int> highest;
    constexpr int kBox = 14;
    if (search::unbounded_place(limits, highest)) continue;
    const auto list = search::monomials_within(limits, {1, 2, 1}, 1e6);
    ASSERT_TRUE(list);
    ++limited;
    if (std::ranges::max(highest) > kBox) continue;
    EXPECT_EQ(set_of(*list), by_trying(limits, 3, kBox));
    EXPECT_EQ(set_of(*list).size(), list->size());
    const int most = search::highest_degree_within(limits, {1, 2, 1}, highest);
    for (std::size_t c = 0; c < list->size(); ++c) {
      EXPECT_EQ(list->degree(c), (*list)[c][0] + 2 * (*list)[c][1] + (*list)[c][2]);
      EXPECT_LE(list->degree(c), most);
      if (c > 0) {
        EXPECT_GE(list->degree(c), list->degree(c - 1));
      }
    }
  }
  EXPECT_GT(limited, 50);
}

/// Of one limit that all weigh 1 in: the list of `all_monomials`, in its order.
TEST(DegreeLimits, OneOfTheWholeDegreeIsNoLimit) {
  const search::Monomials all = search::all_monomials({1, 2, 3}, 9);
  const auto own = search::monomials_within({{{1, 2, 3}, 9}}, {1, 2, 3}, 1e6);
  ASSERT_TRUE(own);
  ASSERT_EQ(own->size(), all.size());
  for (std::size_t c = 0; c < all.size(); ++c)
    EXPECT_EQ(Exponents(all[c], all[c] + 3), Exponents((*own)[c], (*own)[c] + 3));
}

TEST(DegreeLimits, APlaceWithoutABoundIsNamed) {
  std::vector<int> highest;
  EXPECT_EQ(search::unbounded_place({{{1, 0, 1}, 4}}, highest), 1U);
  EXPECT_EQ(search::unbounded_place({{{2, -1, 0}, 4}, {{0, 0, 1}, 1}}, highest), 0U);
  EXPECT_EQ(search::unbounded_place({{{2, -1, 0}, 4}, {{0, 1, 1}, 3}}, highest), std::nullopt);
  EXPECT_EQ(highest, (std::vector<int>{3, 3, 3}));
  EXPECT_FALSE(search::monomials_within({{{1, 0, 1}, 4}}, {1, 1, 1}, 1e6));
}

TEST(DegreeLimits, TooManyMonomialsAreNotListed) {
  EXPECT_FALSE(search::monomials_within({{{1, 1, 1}, 30}}, {1, 1, 1}, 100));
}

}  // namespace
}  // namespace casimir::test
