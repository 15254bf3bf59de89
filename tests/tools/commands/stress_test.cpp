// casimir stress: no method is silently wrong, and what is silently wrong is called so.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "tests/bundled_cases.hpp"
#include "tests/tools/program.hpp"

namespace casimir::test {
namespace {

using Json = nlohmann::ordered_json;

/// dx/dt = x^2 from 1, at infinity at t = 1, with whatever ends the scene.
std::string escaping_case(const std::string& scene) {
  return "[phase_space]\nvariables = [\"x\"]\n[equations]\nx = \"x^2\"\n[[scene]]\nname = "
         "\"default\"\ninitial = { x = \"1\" }\n" +
         scene;
}

/// The verdicts of all rows, by method.
std::map<std::string, std::string> verdicts(const Json& document) {
  std::map<std::string, std::string> found;
  for (const Json& row : document.at("rows"))
    found[row.at("method").get<std::string>()] = row.at("verdict").get<std::string>();
  return found;
}

std::string listed(const Json& document, const std::string& verdict) {
  std::string text;
  for (const Json& row : document.at("rows"))
    if (row.at("verdict") == verdict) text += row.dump() + '\n';
  return text;
}

// The short form of `stress --all`: the modules compiled are few, and most scenes need none.
TEST(EveryCase, HasNoExtremeSceneThatIsSilentlyWrong) {
  const Folder folder;
  const std::string methods = wants_every_case() ? "taylor,dop853,gauss8" : "taylor";
  const Outcome outcome = run_in(folder, {"stress", "--all", "--tag", "extreme", "--method",
                                          methods, "--cell-limit", "2", "--json"});
  ASSERT_TRUE(outcome.status == 0 || outcome.status == 1) << outcome.err;
  const Json json = outcome.json();
  EXPECT_EQ(json.at("failed"), 0) << listed(json, "wrong");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(json.at("counts").at("wrong"), 0);
  EXPECT_EQ(json.at("counts").at("inaccurate"), 0) << listed(json, "inaccurate");
  EXPECT_EQ(json.at("counts").at("unknown"), 0) << listed(json, "unknown");
  EXPECT_GT(json.at("counts").at("right"), wants_every_case() ? 30 : 10);
  EXPECT_GT(json.at("counts").at("refused"), wants_every_case() ? 15 : 5);
}

TEST(Stress, WhatAStepDoesNotSeeIsSeenOrSaid) {
  const Folder folder;
  const Outcome outcome = run_in(folder, {"stress", CASIMIR_SOURCE_DIR "/tests/traps/hidden.toml",
                                          "--method", "taylor,dop853", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const Json json = outcome.json();
  EXPECT_EQ(json.at("counts").at("wrong"), 0) << listed(json, "wrong");
  // Eight scenes by two methods, and most of the answers are to be had.
  EXPECT_EQ(json.at("rows").size(), 16U);
  EXPECT_GE(json.at("counts").at("right"), 12);
}

TEST(Stress, FalseReferenceMakesTheAnswerWrong) {
  const Folder folder;
  folder.write(
      "half.toml",
      escaping_case("duration = \"1/2\"\nextreme = \"scale\"\nreference = { x = \"2\" }\n"));
  folder.write(
      "off.toml",
      escaping_case("duration = \"1/2\"\nextreme = \"scale\"\nreference = { x = \"2.001\" }\n"));
  const auto run = [&](const std::string& name) {
    return run_in(folder, {"stress", name, "--method", "taylor,cvode-adams", "--json"});
  };
  const Outcome right = run("half.toml");
  EXPECT_EQ(right.status, 0) << right.out;
  EXPECT_EQ(verdicts(right.json()).at("taylor"), "right");
  const Outcome wrong = run("off.toml");
  EXPECT_EQ(wrong.status, 1);
  EXPECT_EQ(verdicts(wrong.json()).at("taylor"), "wrong");
  EXPECT_EQ(verdicts(wrong.json()).at("cvode-adams"), "wrong");
  EXPECT_EQ(wrong.json().at("failed"), 1) << "other libraries' answers do not fail the command";
}

TEST(Stress, AWarningOfSomethingElseIsNoWarningOfTheEnd) {
  const Folder folder;
  const std::string scene =
      "[[scene]]\nname = \"default\"\ninitial = { q = \"1\", p = \"0\" }\nduration = \"10\"\n"
      "extreme = \"long\"\nreference = { q = \"0.1234567890123456789\", p = \"0.5\" }\n";
  folder.write(
      "refuted.toml",
      "hamiltonian = \"p^2/2 + q^4/2\"\n[phase_space]\nvariables = [\"q\", \"p\"]\ncanonical "
      "= true\n[integrals]\nF = \"q*p\"\n" +
          scene);
  const Outcome run = run_in(folder, {"integrate", "refuted.toml", "--json"});
  EXPECT_FALSE(run.json().at("warnings").empty());
  EXPECT_EQ(run.json().at("end_in_doubt"), false);
  const Outcome outcome =
      run_in(folder, {"stress", "refuted.toml", "--method", "taylor,midpoint", "--json"});
  EXPECT_EQ(outcome.status, 1) << outcome.out;
  EXPECT_EQ(verdicts(outcome.json()).at("taylor"), "wrong");
}

TEST(Stress, OkWhereTheFileSaysThatNoMotionIsLeftIsWrong) {
  const Folder folder;
  folder.write("early.toml", escaping_case("duration = \"1/2\"\nextreme = \"blowup\"\n"));
  const Outcome outcome = run_in(folder, {"stress", "early.toml", "--method", "taylor", "--json"});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(verdicts(outcome.json()).at("taylor"), "wrong");
}

TEST(Stress, MotionThatEndsIsRefusedWithItsTime) {
  const Folder folder;
  // Not called a blow-up: a run of many digits finds that it is one.
  folder.write("late.toml", escaping_case("duration = \"2\"\n"));
  const Outcome outcome = run_in(folder, {"stress", "late.toml", "--method", "taylor", "--json"});
  EXPECT_EQ(outcome.status, 0) << outcome.out;
  const Json row = outcome.json().at("rows").at(0);
  EXPECT_EQ(row.at("verdict"), "refused") << row;
  EXPECT_EQ(row.at("refusal"), "expected") << row;
  EXPECT_NE(row.at("status"), "ok");
  EXPECT_FALSE(row.at("reason").get<std::string>().empty());
  EXPECT_LT(std::stod(row.at("singular_time_error").get<std::string>()), 1e-6) << row;
}

TEST(Stress, RunThatTakesTooLongIsRefused) {
  const Folder folder;
  folder.write("slow.toml",
               "[phase_space]\nvariables = [\"x\", \"y\"]\n[equations]\nx = \"y\"\ny = \"-x\"\n"
               "[[scene]]\nname = \"default\"\ninitial = { x = \"1\", y = \"0\" }\nduration = "
               "\"3*10^5\"\nreference = { x = \"1\", y = \"0\" }\n");
  const Outcome outcome = run_in(
      folder, {"stress", "slow.toml", "--method", "taylor", "--cell-limit", "0.01", "--json"});
  const Json row = outcome.json().at("rows").at(0);
  EXPECT_EQ(row.at("verdict"), "refused") << row;
  EXPECT_EQ(row.at("refusal"), "failed") << row;
  EXPECT_EQ(row.at("status"), "stopped") << row;
}

TEST(Stress, AMethodThatIsNotDefinedForTheSystemDoesNotApply) {
  const Folder folder;
  folder.write("half.toml", escaping_case("duration = \"1/2\"\nreference = { x = \"2\" }\n"));
  const Outcome outcome =
      run_in(folder, {"stress", "half.toml", "--method", "taylor,splitting", "--json"});
  EXPECT_EQ(outcome.status, 0) << outcome.out;
  const Json rows = outcome.json().at("rows");
  EXPECT_EQ(rows.at(0).at("verdict"), "right") << rows;
  EXPECT_FALSE(rows.at(0).contains("refusal")) << rows;
  EXPECT_EQ(rows.at(1).at("refusal"), "not_applicable") << rows;
  const Outcome table = run_in(folder, {"stress", "half.toml", "--method", "taylor,splitting"});
  EXPECT_NE(table.out.find("n/a"), std::string::npos) << table.out;
}

TEST(Stress, WritesTheColumnsOfTheInterfaceAndAPictureWithWords) {
  const Folder folder;
  const std::string text =
      file_text(folder.write("case.toml", escaping_case("duration = \"2\"\n")));
  const Outcome outcome = run_in(folder,
                                 {"stress", "-", "--method", "taylor", "--tolerance", "1e-9",
                                  "--output", "rows.csv", "--plot", "matrix.svg"},
                                 text);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("refused"), std::string::npos) << outcome.out;
  const std::string csv = file_text(folder.path() / "rows.csv");
  EXPECT_TRUE(csv.starts_with(
      "case,scene,method,tolerance,error,drift,seconds,steps,evaluations,status,verdict"))
      << csv;
  EXPECT_NE(csv.find(",taylor,1e-09,"), std::string::npos) << csv;
  const std::string picture = file_text(folder.path() / "matrix.svg");
  EXPECT_NE(picture.find("refused"), std::string::npos);
  EXPECT_NE(picture.find("taylor"), std::string::npos);
  EXPECT_EQ(folder.files(), 3U) << "nothing else is left behind";
}

TEST(Stress, UnknownMethodIsRefusedBeforeAnyRun) {
  const Outcome outcome = run({"stress", "euler", "--method", "gaus8"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("gauss8"), std::string::npos) << outcome.err;
  EXPECT_EQ(run({"stress"}).status, 2);
  EXPECT_EQ(run({"stress", "--all", "euler"}).status, 2);
}

}  // namespace
}  // namespace casimir::test
