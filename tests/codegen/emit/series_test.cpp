// The recurrences of Taylor coefficients as they stand in a module.
#include <gtest/gtest.h>

#include <string>

#include "codegen/emit_cpp.hpp"
#include "tests/codegen/support.hpp"

namespace casimir {
namespace {

using Rates = std::vector<std::pair<std::string, std::string>>;

/// The struct of the recurrences alone.
std::string series_of(const Rates& rates) {
  const std::string scene = "[[scene]]\nname = \"default\"";
  const std::string module =
      emit_module(specialised(equations(rates, scene)), "", {.series = true});
  const std::size_t begin = module.find("struct Series :");
  EXPECT_NE(begin, std::string::npos);
  return module.substr(begin, module.find("\n  };\n", begin) - begin);
}

int count_of(const std::string& what, const std::string& text) {
  int count = 0;
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += what.size())
    ++count;
  return count;
}

TEST(SeriesText, AStateWhoseRateIsZeroIsInNoSum) {
  const auto sums = [](const std::string& rate) {
    const std::string text = series_of({{"x", "c*y + y"}, {"y", "-c*x"}, {"c", rate}});
    return text.substr(0, text.find('\n'));
  };
  EXPECT_NE(sums("0").find("Convolved<3, 0, "), std::string::npos) << sums("0");
  EXPECT_NE(sums("1").find("Convolved<3, 2, "), std::string::npos) << sums("1");
  EXPECT_NE(sums("x").find("Convolved<3, 2, "), std::string::npos) << sums("x");
}

TEST(SeriesText, SineAndCosineOfOneAngleAreCalledOnce) {
  const std::string text = series_of({{"u", "cos(u)"}, {"v", "sin(u)"}, {"w", "sin(v)*cos(v)"}});
  EXPECT_EQ(count_of("__builtin_sin(", text), 2) << text;
  EXPECT_EQ(count_of("__builtin_cos(", text), 2) << text;
}

TEST(SeriesText, OfFewSumsEachIsFinishedByItself) {
  const std::string few = series_of({{"x", "x*y"}, {"y", "y*x + x^2"}});
  EXPECT_NE(few.find(", true>"), std::string::npos) << few;
  EXPECT_NE(few.find("first_left_[1]"), std::string::npos) << few;
  std::string rate = "0";
  for (int i = 1; i <= 9; ++i) rate += "+ 1/(" + std::to_string(i) + " + x)";
  const std::string many = series_of({{"x", rate}});
  EXPECT_NE(many.find(", false>"), std::string::npos) << many;
  EXPECT_EQ(many.find("first_left_"), std::string::npos) << many;
}

}  // namespace
}  // namespace casimir
