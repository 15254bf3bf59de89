// Boxes that provably contain the state, from the command line.
#include <gtest/gtest.h>

#include <cstdio>
#include <sstream>

#include "tests/tools/program.hpp"

namespace casimir::test {
namespace {

Outcome enclosed(const std::string& name, std::vector<std::string> more) {
  const Folder folder;
  std::vector<std::string> arguments{"integrate", name, "--validated", "--json"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run_in(folder, arguments);
}

double end(const nlohmann::ordered_json& run, const char* variable, int which) {
  return std::stod(run.at("validated").at("enclosure").at(variable).at(which).get<std::string>());
}

TEST(ValidatedCommand, SaysWhatTheInterfacePromises) {
  const Outcome outcome = enclosed("kovalevskaya", {});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const nlohmann::ordered_json run = outcome.json();
  const nlohmann::ordered_json& validated = run.at("validated");
  EXPECT_EQ(validated.at("contracted_by"), (nlohmann::ordered_json{"H", "F1", "F2", "K"}));
  EXPECT_LT(std::stod(validated.at("radius").get<std::string>()), 5e-12);
  EXPECT_GT(validated.at("steps"), 100);
  EXPECT_EQ(run.at("trust").at("verdict"), "proved");
  EXPECT_EQ(run.at("status"), "ok");
  EXPECT_EQ(run.at("t"), "100");
  // From the case file, thirty digits that another program has confirmed.
  EXPECT_LE(end(run, "M1", 0), 0.327423205235939805);
  EXPECT_GE(end(run, "M1", 1), 0.327423205235939805);
}

TEST(ValidatedCommand, RefusesWithTheTimeReached) {
  const Outcome outcome = enclosed("riccati", {"--scene", "pole"});
  EXPECT_EQ(outcome.status, 5);
  const nlohmann::ordered_json run = outcome.json();
  EXPECT_EQ(run.at("status"), "not_enclosed");
  EXPECT_GT(std::stod(run.at("stopped").at("time").get<std::string>()), 0);
  EXPECT_NE(outcome.err.find("enclosed up to t = "), std::string::npos) << outcome.err;
}

TEST(ValidatedCommand, NoDurationLeavesTheStart) {
  const Folder folder;
  folder.write("steep.toml",
               "[phase_space]\nvariables = [\"y\"]\n[equations]\ny = \"1/y^7\"\n[[scene]]\n"
               "name = \"default\"\ninitial = { y = \"1/1000\" }\nduration = \"0\"\n");
  const Outcome outcome =
      run_in(folder, {"integrate", "steep.toml", "--validated", "--json", "--time-limit", "20"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(end(outcome.json(), "y", 0), 1e-3);
  EXPECT_EQ(end(outcome.json(), "y", 1), 1e-3);
}

TEST(ValidatedCommand, RangesContainWhatTheirMembersDo) {
  const Outcome wide = enclosed("kovalevskaya", {"--param", "r=1..1.001", "--duration", "5"});
  const Outcome start = enclosed("kovalevskaya", {"--initial-radius", "1e-3", "--duration", "5"});
  ASSERT_EQ(wide.status, 0) << wide.err;
  ASSERT_EQ(start.status, 0) << start.err;
  for (const char* r : {"1", "1.0003", "1.001"}) {
    const nlohmann::ordered_json one =
        enclosed("kovalevskaya", {"--param", std::string("r=") + r, "--duration", "5"}).json();
    for (const char* name : {"M1", "M2", "M3", "g1", "g2", "g3"}) {
      EXPECT_LE(end(wide.json(), name, 0), end(one, name, 0));
      EXPECT_GE(end(wide.json(), name, 1), end(one, name, 1));
    }
  }
  for (const char* from : {"M1=1.001", "M2=0.499", "M3=0.334"}) {
    const nlohmann::ordered_json one =
        enclosed("kovalevskaya", {"--initial", from, "--duration", "5"}).json();
    for (const char* name : {"M1", "M2", "M3", "g1", "g2", "g3"}) {
      EXPECT_LE(end(start.json(), name, 0), end(one, name, 0));
      EXPECT_GE(end(start.json(), name, 1), end(one, name, 1));
    }
  }
}

TEST(ValidatedCommand, WhatIsNotProvedDoesNotMakeTheBoxSmaller) {
  const Folder folder;
  const std::string file = folder.write("oscillator.toml", R"toml(title = "Oscillator"
[phase_space]
variables = ["x", "y"]
[equations]
x = "y"
y = "-x"
[integrals]
circle = "x^2 + y^2"
wrong = "x^2 + 2*y^2"
[[scene]]
name = "default"
initial = { x = "3", y = "sqrt(2)" }
duration = "Pi"
)toml");
  const Outcome outcome = run_in(folder, {"integrate", file, "--validated", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const nlohmann::ordered_json run = outcome.json();
  EXPECT_EQ(run.at("validated").at("contracted_by"), nlohmann::ordered_json{"circle"});
  ASSERT_EQ(run.at("warnings").size(), 1U);
  EXPECT_NE(run.at("warnings")[0].get<std::string>().find("wrong"), std::string::npos);
  // Half a turn, though neither pi nor the root of two is a double.
  EXPECT_LE(end(run, "x", 0), -3);
  EXPECT_GE(end(run, "x", 1), -3);
  EXPECT_LT(end(run, "x", 1) - end(run, "x", 0), 1e-14);
}

TEST(ValidatedCommand, WritesABoxForEachSample) {
  const Folder folder;
  const Outcome outcome = run_in(folder, {"integrate", "kovalevskaya", "--validated", "--duration",
                                          "1", "--every", "0.1", "--output", "boxes.csv"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  std::istringstream lines(file_text(folder.path() / "boxes.csv"));
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line.substr(0, 22), "t,M1_low,M1_high,M2_lo");
  int count = 0;
  while (std::getline(lines, line)) {
    double t = 0, low = 0, high = 0;
    ASSERT_EQ(std::sscanf(line.c_str(), "%lf,%lf,%lf,", &t, &low, &high), 3) << line;
    EXPECT_NEAR(t, 0.1 * count, 1e-15);
    EXPECT_LE(low, high);
    EXPECT_LT(high - low, 1e-14);
    EXPECT_LT(line.size(), 400U);
    ++count;
  }
  EXPECT_EQ(count, 11);
}

TEST(ValidatedCommand, SaysWhichOptionsDoNotGoTogether) {
  const Folder folder;
  const auto refused = [&](std::vector<std::string> more) {
    std::vector<std::string> arguments{"integrate", "kovalevskaya"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_in(folder, arguments).status;
  };
  EXPECT_EQ(refused({"--validated", "--method", "dop853"}), 2);
  EXPECT_EQ(refused({"--validated", "--tolerance", "1e-9"}), 2);
  EXPECT_EQ(refused({"--validated", "--project"}), 2);
  EXPECT_EQ(refused({"--validated", "--initial-radius", "-1"}), 2);
  EXPECT_EQ(refused({"--validated", "--param", "r=2..1"}), 2);
  EXPECT_EQ(refused({"--validated", "--param", "s=1..2"}), 2);
  EXPECT_EQ(refused({"--initial-radius", "1e-3"}), 2);
  EXPECT_EQ(refused({"--param", "r=1..2"}), 2);
}

}  // namespace
}  // namespace casimir::test
