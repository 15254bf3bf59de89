// casimir conserve: what is said of runs that have nothing to keep, or do not arrive.
#include <gtest/gtest.h>

#include "tests/tools/program.hpp"

namespace casimir::test {
namespace {

const char* const kWithoutInvariants = R"toml(
[phase_space]
variables = ["x", "y"]
[equations]
x = "y"
y = "-x + y*(1 - x^2)"
[[scene]]
name = "default"
initial = { x = "1", y = "0" }
duration = "5"
)toml";

// Three runs that arrive keep no invariant where there is none.
TEST(Conserve, CountsRunsByWhatBecameOfThem) {
  const Outcome none = run({"conserve", "-"}, kWithoutInvariants);
  EXPECT_EQ(none.status, 0) << none.err;
  EXPECT_NE(none.out.find("3 runs arrived, and there is no invariant to look at\n"),
            std::string::npos)
      << none.out;
  const Outcome rows = run({"conserve", "-", "--json"}, kWithoutInvariants);
  EXPECT_TRUE(rows.json().at("rows")[0].at("drift").is_null());
  // x' = x^2 has no value from t = 1 on.
  const Outcome pole = run({"conserve", "-"}, R"toml(
[phase_space]
variables = ["x", "y"]
[equations]
x = "x^2"
y = "-y*x"
[integrals]
F = "x*y"
[[scene]]
name = "default"
initial = { x = "1", y = "1" }
duration = "2"
)toml");
  EXPECT_EQ(pole.status, 1);
  EXPECT_NE(pole.out.find("0 of 3 runs keep every invariant to 1e-09; 3 did not arrive\n"),
            std::string::npos)
      << pole.out;
}

}  // namespace
}  // namespace casimir::test
