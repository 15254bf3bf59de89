// One motion in all the variables of section 1.3, and the points where some of them are singular.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/tools/program.hpp"

namespace casimir::test {
namespace {

using Json = nlohmann::ordered_json;

double coordinate(const Json& json, const std::string& name) {
  return std::stod(json.at("state").at(name).get<std::string>());
}

Json end_state(const std::vector<std::string>& more) {
  std::vector<std::string> arguments{
      "integrate", "direction-cosines", "--tolerance", "1e-13", "--duration", "20", "--json"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const Outcome outcome = run(arguments);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return outcome.status == 0 ? outcome.json() : Json{};
}

class EverySet : public testing::TestWithParam<const char*> {};

TEST_P(EverySet, CarriesTheMotionOfTheDirectionCosines) {
  const Json own = end_state({});
  const Json other = end_state({"--in", GetParam(), "--as", "direction-cosines"});
  ASSERT_EQ(own.at("state").size(), 12U);
  for (const auto& [name, value] : own.at("state").items())
    EXPECT_NEAR(coordinate(other, name), coordinate(own, name), 1e-10) << name;
}

/// What cancels in the case, or in what is carried, is needed in the new variables too.
TEST(Coordinates, WhatIsCarriedHasTheConditionsOfTheCase) {
  const Folder folder;
  folder.write("c.toml", R"toml(title = "t"
hamiltonian = "(M1^2 + M2^2 + M3^2)/2"
[phase_space]
variables = ["M1", "M2", "M3", "g1", "g2", "g3"]
algebra = "e(3)"
[integrals]
K = "M1*g1 + M2*g2 + M3*g3 + log(-1 - M1^2) - log(-1 - M1^2)"
L = "M1*g1 + M2*g2 + M3*g3 + log(M1) - log(M1)"
)toml");
  int seen = 0;
  const Json proofs =
      run_in(folder, {"verify", "./c.toml", "--in", "euler-angles", "--json"}).json();
  for (const Json& claim : proofs.at("claims")) {
    if (claim.at("kind") != "integral") continue;
    ++seen;
    EXPECT_EQ(claim.at("verdict"), claim.at("name") == "K" ? "undecided" : "proved") << claim;
    if (claim.at("verdict") == "proved") EXPECT_FALSE(claim.at("positive").empty()) << claim;
  }
  EXPECT_EQ(seen, 2);
}

INSTANTIATE_TEST_SUITE_P(Coordinates, EverySet,
                         testing::Values("quaternions", "cayley-klein", "euler-angles", "andoyer",
                                         "fixed-frame", "body-e3"),
                         [](const auto& set) {
                           std::string name = set.param;
                           std::erase(name, '-');
                           return name;
                         });

TEST(Coordinates, AnswerInStereographicProjection) {
  const Json own = end_state({});
  const Json other = end_state({"--as", "stereographic"});
  const double x = coordinate(other, "x"), y = coordinate(other, "y");
  EXPECT_NEAR(2 * x / (x * x + y * y + 1), coordinate(own, "gamma1"), 1e-14);
  EXPECT_NEAR(2 * y / (x * x + y * y + 1), coordinate(own, "gamma2"), 1e-14);
}

TEST(Coordinates, ClaimsHoldInOtherVariables) {
  EXPECT_EQ(run({"verify", "clebsch", "--in", "quaternions"}).status, 0);
  EXPECT_EQ(run({"verify", "kovalevskaya", "--in", "quaternions"}).status, 0);
}

/// (M, g) say nothing of the precession: each state has one for itself, which is no motion.
TEST(Coordinates, WhatTheOldVariablesDoNotDetermineIsSaid) {
  const auto warning = [](const char* name, const char* set) {
    const Json json = run({"integrate", name, "--as", set, "--duration", "2", "--json"}).json();
    for (const Json& one : json.at("warnings"))
      if (const std::string text = one; text.find("not determined") != std::string::npos)
        return text.substr(0, text.find(':'));
    return std::string();
  };
  EXPECT_EQ(warning("kovalevskaya", "euler-angles"), "psi");
  EXPECT_EQ(warning("kovalevskaya", "andoyer"), "h");
  EXPECT_NE(warning("kovalevskaya", "quaternions").find("lam0"), std::string::npos);
  EXPECT_EQ(warning("direction-cosines", "euler-angles"), "");
  EXPECT_EQ(warning("euler-angles", "direction-cosines"), "");
}

/// Near the vertical, angles are worse known than the state by as much as the derivatives are
/// large.
TEST(Coordinates, TheErrorIsThatOfTheNewVariables) {
  const Folder folder;
  const std::string file = folder.write("near.toml", R"toml(
title = "Near the vertical"
hamiltonian = "(M1^2 + M2^2 + M3^2/2)/2"
[phase_space]
variables = ["M1", "M2", "M3", "g1", "g2", "g3"]
algebra = "e(3)"
[[scene]]
name = "default"
initial = { M1 = "1", M2 = "0", M3 = "10^(-8)", g1 = "0", g2 = "sin(10^(-7)-50)", g3 = "cos(10^(-7)-50)" }
duration = "50"
)toml");
  const auto error = [&](std::vector<std::string> more) {
    more.insert(more.begin(),
                {"integrate", file, "--method", "dop853", "--tolerance", "1e-12", "--json"});
    return std::stod(run(more).json().at("trust").at("error_estimate").get<std::string>());
  };
  EXPECT_GT(error({"--as", "euler-angles"}), 1e5 * error({}));
}

TEST(Coordinates, TheVerticalAxisIsRefusedInEulerAngles) {
  const Folder folder;
  const std::string file = folder.write("upright.toml", R"toml(
title = "Upright"
hamiltonian = "(M1^2 + M2^2 + M3^2)/2 + g3"
[phase_space]
variables = ["M1", "M2", "M3", "g1", "g2", "g3"]
algebra = "e(3)"
[[scene]]
name = "default"
initial = { M1 = "1", M2 = "0", M3 = "1", g1 = "0", g2 = "0", g3 = "1" }
duration = "1"
[[scene]]
name = "long"
initial = { M1 = "1", M2 = "0", M3 = "1", g1 = "0", g2 = "0", g3 = "2" }
duration = "1"
)toml");
  for (const char* how : {"--in", "--as"}) {
    const Outcome outcome = run({how[2] == 'i' ? "integrate" : "show", file, how, "euler-angles"});
    EXPECT_EQ(outcome.status, 5) << how;
    EXPECT_NE(outcome.err.find("singular"), std::string::npos) << outcome.err;
  }
  const Outcome off = run({"integrate", file, "--scene", "long", "--in", "euler-angles"});
  EXPECT_EQ(off.status, 5);
  EXPECT_NE(off.err.find("not in the image"), std::string::npos) << off.err;
  EXPECT_EQ(run({"integrate", file, "--in", "quaternions"}).status, 0);
}

TEST(Coordinates, AnUnknownSetIsNamedWithTheNearest) {
  const Outcome outcome = run({"show", "kovalevskaya", "--as", "euler-angle"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("euler-angles"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace casimir::test
