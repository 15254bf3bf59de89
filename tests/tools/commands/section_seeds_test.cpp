// casimir section: tables that it writes and reads, and points that have no place in a picture.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/tools/program.hpp"

namespace casimir::test {
namespace {

TEST(SectionSeeds, PointsOfAMapWithoutAPlaceAreCounted) {
  const Folder folder;
  folder.write("shift.toml", R"toml(title = "shift"
[phase_space]
variables = ["x", "y"]
[map]
x = "x + 1/10"
y = "y"
[[scene]]
name = "default"
initial = { x = "-1", y = "-1" }
)toml");
  const Outcome outcome = run_in(folder, {"section", "./shift.toml", "--pair", "sqrt(y)", "x",
                                          "--orbits", "1", "--points", "8", "--json"});
  EXPECT_TRUE(has(outcome.json().at("warnings").dump(),
                  "at 8 of 8 points the plotted functions have no value"))
      << outcome.out;
}

/// Two of its variables are called as the columns of the plotted pair are.
TEST(SectionSeeds, WhatItWritesOfVariablesUAndVCanBeItsSeeds) {
  const Folder folder;
  folder.write("case.toml", R"toml(title = "t"
hamiltonian = "(u^2 + v^2 + x^2 + 2*y^2)/2"
[phase_space]
variables = ["x", "y", "u", "v"]
canonical = true
[[scene]]
name = "default"
initial = { x = "0", y = "1/3", u = "1", v = "0" }
duration = "1"
)toml");
  const std::vector<std::string> section{"section", "./case.toml", "--plane", "x",
                                         "--pair",  "y",           "v",       "--points"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), section.begin(), section.end());
    return run_in(folder, more);
  };
  ASSERT_EQ(with({"3", "--orbits", "2", "--output", "a.csv", "--quiet"}).status, 0);
  const std::string table = file_text(folder.path() / "a.csv");
  EXPECT_EQ(table.substr(0, table.find('\n')), "orbit,n,t,u,v,x,y,u_,v_");
  const Outcome again = with({"1", "--seeds", "a.csv", "--json"});
  ASSERT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(again.json().at("orbits").size(), 6U);
  // A column for each variable, under its own name.
  folder.write("b.csv", "x,y,u,v\n0,1/3,1,0\n");
  const Outcome own = with({"1", "--seeds", "b.csv", "--json"});
  ASSERT_EQ(own.status, 0) << own.err;
  EXPECT_NEAR(std::stod(own.json().at("orbits").at(0).at("seed").at("u").get<std::string>()), 1,
              1e-12);
}

}  // namespace
}  // namespace casimir::test
