// Maps on the command line: `discretise`, `degrees`, `search`, `integrate`, and what refuses them.
#include <gtest/gtest.h>

#include "tests/tools/program.hpp"

namespace casimir::test {
namespace {

using Json = nlohmann::json;

TEST(MapCommands, WhatDiscretiseWritesIsACase) {
  const Folder folder;
  const Outcome written = run_in(folder, {"discretise", "euler", "--kahan", "-o", "kahan.toml"});
  EXPECT_EQ(written.status, 0) << written.err;
  const Outcome kept = run_in(
      folder, {"verify", "./kahan.toml", "--integral",
               "(4 - eps^2*(a1-a3)*(a2-a1)*M1^2)/(4 - eps^2*(a3-a2)*(a1-a3)*M3^2)", "--json"});
  EXPECT_EQ(kept.status, 0) << kept.err;
  EXPECT_EQ(kept.json().at("claims")[0].at("kind"), "integral");
  const Outcome refuted = run_in(folder, {"verify", "./kahan.toml", "--integral", "M1", "--json"});
  EXPECT_EQ(refuted.status, 1);
  EXPECT_TRUE(refuted.json().at("claims")[0].contains("witness"));
  const Outcome printed = run({"discretise", "euler", "--kahan", "1/10"});
  EXPECT_FALSE(has(printed.out, "eps^"));
  EXPECT_EQ(run_in(folder, {"verify", "-"}, printed.out).status, 0);
}

TEST(MapCommands, DiscretiseRefusesWhatIsNoMap) {
  EXPECT_EQ(run({"discretise", "euler"}).status, 2);
  EXPECT_EQ(run({"discretise", "euler", "--kahan", "--midpoint"}).status, 2);
  EXPECT_EQ(run({"discretise", "euler", "--kahan", "0"}).status, 2);
  EXPECT_EQ(run({"discretise", "euler", "--moser-veselov"}).status, 2);
  EXPECT_TRUE(has(run({"discretise", "euler", "--midpoint"}).err, "linear equations only"));
  EXPECT_TRUE(
      has(run({"discretise", "neumann", "--kahan"}).err, "no polynomial of degree at most 2"));
}

TEST(MapCommands, DegreesAreEvidence) {
  const Json euler = run({"degrees", "euler", "--kahan", "--iterates", "7", "--json"}).json();
  EXPECT_EQ(euler.at("degrees"), Json({3, 9, 19, 33, 51, 73, 99}));
  EXPECT_EQ(euler.at("growth"), "polynomial");
  EXPECT_EQ(euler.at("growth_degree"), 2);
  EXPECT_EQ(euler.at("formula"), "2*n^2 + 1");
  EXPECT_EQ(euler.at("verdict"), "evidence");
  const Json henon = run({"degrees", "henon-area-preserving", "--json"}).json();
  EXPECT_EQ(henon.at("growth"), "exponential");
  EXPECT_EQ(run({"degrees", "euler"}).status, 2);
  EXPECT_EQ(run({"degrees", "lyness", "--kahan"}).status, 2);
  EXPECT_EQ(run({"degrees"}).status, 2);
  const Outcome sine =
      run({"degrees", "-"}, "[phase_space]\nvariables = [\"x\"]\n[map]\nx = \"sin(x)\"\n");
  EXPECT_EQ(sine.status, 2);
}

TEST(MapCommands, SearchPrintsWhatIsProved) {
  const Json found = run({"search", "lyness", "--degree", "3", "--param", "a=2", "--json"}).json();
  EXPECT_EQ(found.at("integrals").size(), 1U);
  EXPECT_EQ(found.at("none").at("polynomial"), "proved");
  EXPECT_EQ(run({"search", "lyness", "--degree", "3"}).status, 3);
  EXPECT_EQ(run({"search", "lyness", "--degree", "3", "--darboux"}).status, 2);
}

TEST(MapCommands, IntegrateIterates) {
  const Folder folder;
  const Outcome run_of = run_in(folder, {"integrate", "lyness", "--duration", "5", "--param", "a=1",
                                         "--initial", "x=2", "--initial", "y=3", "--json"});
  ASSERT_EQ(run_of.status, 0) << run_of.err;
  // a = 1: every orbit has the period 5.
  const Json json = run_of.json();
  EXPECT_EQ(json.at("steps"), 5);
  EXPECT_EQ(json.at("t"), "5");
  EXPECT_NEAR(std::stod(json.at("state").at("x").get<std::string>()), 2, 1e-14);
  EXPECT_NEAR(std::stod(json.at("state").at("y").get<std::string>()), 3, 1e-14);
  EXPECT_LT(std::stod(json.at("invariants").at("F").at("drift").get<std::string>()), 1e-14);
  EXPECT_EQ(run_in(folder, {"integrate", "lyness", "--duration", "4", "--every", "2", "--output",
                            "o.csv", "--quiet"})
                .status,
            0);
  EXPECT_EQ(run({"integrate", "lyness", "--duration", "1.5"}).status, 2);
  EXPECT_EQ(run({"integrate", "lyness", "--method", "taylor"}).status, 2);
  const Outcome pole = run(
      {"integrate", "lyness", "--param", "a=-1", "--initial", "x=1", "--initial", "y=1", "--json"});
  EXPECT_EQ(pole.status, 5);
  EXPECT_EQ(pole.json().at("status"), "non_finite");
  EXPECT_TRUE(has(pole.err, "after step 2"));
}

TEST(MapCommands, OthersRefuseMaps) {
  const Folder folder;
  for (const std::vector<std::string>& command : {std::vector<std::string>{"exponents", "lyness"},
                                                  {"obstruct", "lyness"},
                                                  {"equilibria", "lyness"},
                                                  {"conserve", "lyness"},
                                                  {"section", "lyness"},
                                                  {"generate", "lyness", "-o", "x.hpp"},
                                                  {"report", "lyness"},
                                                  {"bench", "lyness"},
                                                  {"verify", "lyness", "--in", "andoyer"},
                                                  {"verify", "lyness", "--certificate", "a.v"}}) {
    const Outcome outcome = run_in(folder, command);
    EXPECT_EQ(outcome.status, 2) << command[0];
    EXPECT_NE(outcome.err, "") << command[0];
  }
  EXPECT_EQ(folder.files(), 0U);
  EXPECT_EQ(run({"show", "lyness"}).status, 0);
  EXPECT_EQ(run({"show", "lyness", "--json"}).json().at("map").at("x"), "y");
  EXPECT_TRUE(has(run({"show", "lyness", "--format", "latex"}).out, "x'"));
}

}  // namespace
}  // namespace casimir::test
