// Certificates of runs and crossings that are proved, from the command line.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "tests/tools/program.hpp"
#include "tools/analysis/certificate/certificate_file.hpp"

namespace casimir::test {
namespace {

/// A certificate of a short run, in the folder.
Outcome certify(const Folder& folder, std::vector<std::string> more) {
  std::vector<std::string> arguments{
      "integrate", "kovalevskaya", "--validated", "--certificate", "run.json", "--duration", "3"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run_in(folder, arguments);
}

TEST(CheckCommand, ChecksWhatIntegrateWrites) {
  const Folder folder;
  for (const std::vector<std::string>& more : {std::vector<std::string>{},
                                               {"--initial-radius", "1e-6"},
                                               {"--param", "r=1..1.001"},
                                               {"--digits", "30"}}) {
    const Outcome written = certify(folder, more);
    ASSERT_EQ(written.status, 0) << written.err;
    const Outcome outcome = run_in(folder, {"check", "run.json", "--json"});
    ASSERT_EQ(outcome.status, 0) << outcome.err << outcome.out;
    const nlohmann::ordered_json checked = outcome.json();
    EXPECT_EQ(checked.at("verdict"), "checked");
    EXPECT_EQ(checked.at("case"), "kovalevskaya");
    EXPECT_EQ(checked.at("t"), "3");
    EXPECT_GT(checked.at("steps"), 5);
    EXPECT_EQ(checked.at("integrals").size(), 4U);
    // A parameter with a range is a state at rest.
    const bool ranged = !more.empty() && more.front() == "--param";
    EXPECT_EQ(checked.at("enclosure").size(), ranged ? 7U : 6U);
    // Each start is said: the theorem is about all of these.
    const bool of_box = !more.empty() && more.front() == "--initial-radius";
    EXPECT_EQ(checked.contains("start_radii"), of_box || ranged);
    if (of_box) EXPECT_EQ(number(checked.at("start_radii").begin().value()), 1e-6);
  }
}

TEST(CheckCommand, WhatIsFalseIsRefutedWithItsStep) {
  const Folder folder;
  ASSERT_EQ(certify(folder, {}).status, 0);
  const std::string text = file_text(folder.path() / "run.json");
  std::string body = text.substr(0, text.rfind(",\n\"digest\""));
  const std::size_t steps = body.find("\"steps\"");
  const std::size_t place = body.find("\"middle\": [\"0x", body.find('\n', steps + 20)) + 14;
  body[place] = body[place] == '8' ? '9' : '8';
  folder.write("false.json", with_digest(body));
  const Outcome refuted = run_in(folder, {"check", "false.json", "--json"});
  ASSERT_EQ(refuted.status, 1) << refuted.err;
  EXPECT_EQ(refuted.json().at("verdict"), "refuted");
  EXPECT_EQ(refuted.json().at("failed_step"), 2);
  EXPECT_NE(run_in(folder, {"check", "false.json"}).out.find("step 2: "), std::string::npos);

  folder.write("changed.json", body + text.substr(text.rfind(",\n\"digest\"")));
  const Outcome changed = run_in(folder, {"check", "changed.json"});
  EXPECT_EQ(changed.status, 2);
  EXPECT_NE(changed.err.find("the file has been changed"), std::string::npos) << changed.err;
  folder.write("cut.json", text.substr(0, text.size() / 2));
  EXPECT_EQ(run_in(folder, {"check", "cut.json"}).status, 2);
  EXPECT_EQ(run_in(folder, {"check", "none.json"}).status, 2);
  EXPECT_EQ(run_in(folder, {"check", "run.json", "--scene", "default"}).status, 2);
  EXPECT_EQ(run_in(folder, {"integrate", "kovalevskaya", "--certificate", "c.json"}).status, 2);
}

// The verification of what was enclosed takes many times as long as the run: the limit is for both.
// What is checked is what the equations say, to the end of each line.
TEST(CheckCommand, ShowsLinesWhole) {
  const Folder folder;
  folder.write("blank.toml", "[phase_space]\nvariables = [\"x\"]\n[equations]\nx = \"-x" +
                                 std::string(500, ' ') +
                                 "*2\"\n[[scene]]\nname = \"s\"\ninitial = { x = \"1\" }\n"
                                 "duration = \"1\"\n");
  ASSERT_EQ(run_in(folder, {"integrate", "./blank.toml", "--validated", "--certificate", "c.json"})
                .status,
            0);
  std::string text = file_text(folder.path() / "c.json");
  std::string body = text.substr(0, text.rfind(",\n\"digest\""));
  const std::string written = R"(x = \"-2*x)";
  const std::size_t rate = body.find(written);
  ASSERT_NE(rate, std::string::npos) << body.substr(0, 400);
  body.replace(rate, written.size(), R"(x = \"-x)" + std::string(500, ' ') + "*2");
  folder.write("blank.json", with_digest(body));
  const Outcome shown = run_in(folder, {"check", "blank.json"});
  ASSERT_EQ(shown.status, 0) << shown.err << shown.out;
  EXPECT_NE(shown.out.find("*2"), std::string::npos) << shown.out;
}

TEST(CheckCommand, TheTimeLimitEndsTheVerificationBeforeACertificateIsWritten) {
  const Folder folder;
  const Outcome late = run_in(folder, {"integrate", "kovalevskaya", "--validated", "--duration",
                                       "5000", "--certificate", "late.json", "--time-limit", "2"});
  EXPECT_EQ(late.status, 4) << late.err;
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "late.json"));
}

TEST(ValidatedSection, EnclosesEveryCrossingOfTheOrbit) {
  const Folder folder;
  const std::string oscillator = folder.write("two.toml", R"toml(title = "Two oscillators"
hamiltonian = "(u^2 + x^2 + v^2 + 2*y^2)/2"
[phase_space]
variables = ["x", "u", "y", "v"]
brackets = { "x,u" = "1", "y,v" = "1" }
[section]
function = "x - y"
direction = "up"
plot = ["y", "v"]
[[scene]]
name = "default"
initial = { x = "0", u = "1", y = "0", v = "3/4" }
duration = "40"
)toml");
  const Outcome outcome = run_in(folder, {"section", oscillator, "--validated", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err << outcome.out;
  const nlohmann::ordered_json proved = outcome.json().at("validated");
  EXPECT_TRUE(proved.at("starts_on_plane"));
  // x - y = sin t - 3 sin(sqrt(2) t) / (4 sqrt(2)), which a fine grid finds the zeros of.
  const auto s = [](double t) {
    return std::sin(t) - 0.75 / std::sqrt(2.) * std::sin(std::sqrt(2.) * t);
  };
  std::vector<double> up;
  std::size_t down = 0;
  constexpr double kStep = 1e-4;
  for (double t = 0.01; t < 40; t += kStep) {
    if (s(t) < 0 && s(t + kStep) >= 0) up.push_back(t);
    if (s(t) > 0 && s(t + kStep) <= 0) ++down;
  }
  ASSERT_EQ(proved.at("count"), up.size());
  EXPECT_EQ(proved.at("count_back"), down);
  for (std::size_t i = 0; i < up.size(); ++i) {
    const nlohmann::ordered_json& t = proved.at("crossings")[i].at("t");
    const double low = std::stod(t[0].get<std::string>()),
                 high = std::stod(t[1].get<std::string>());
    EXPECT_LT(s(low - 1e-9), 0);
    EXPECT_GT(s(high + 1e-9), 0);
    EXPECT_LT(high - low, 1e-10);
    EXPECT_NEAR(low, up[i], 2e-4);
  }
  // The orbit never leaves |x| <= 1, and touches x = 1.
  const Outcome touching =
      run_in(folder, {"section", oscillator, "--validated", "--plane", "x - 1", "--json"});
  EXPECT_EQ(touching.status, 5) << touching.out;
  EXPECT_EQ(run_in(folder, {"section", oscillator, "--validated", "--points", "3"}).status, 2);
  EXPECT_EQ(run_in(folder, {"section", oscillator, "--duration", "3"}).status, 2);
}

}  // namespace
}  // namespace casimir::test
