// casimir integrate --ensemble: the file of members, the forms of the answer, what is refused.
#include <gtest/gtest.h>

#include <fstream>

#include "tests/tools/program.hpp"

namespace casimir::test {
namespace {

void write(const Folder& folder, const std::string& name, const std::string& text) {
  std::ofstream(folder.path() / name) << text;
}

/// The outcome of a run over members written to a file.
Outcome members(const Folder& folder, const std::string& text, std::vector<std::string> more,
                const Environment& environment = {}) {
  write(folder, "members.csv", text);
  more.insert(more.begin() + 2, {"--ensemble", "members.csv"});
  return run_in(folder, more, {}, environment);
}

constexpr const char* kBlowUp =
    "title = \"Riccati\"\n[phase_space]\nvariables = [\"x\"]\n[equations]\nx = \"1 + x^2\"\n"
    "[[scene]]\nname = \"default\"\ninitial = { x = \"0\" }\nduration = \"2\"\n";

TEST(EnsembleFile, MembersAreTheSceneButForTheirColumns) {
  const Folder folder;
  const Outcome outcome = members(folder, "M1, r\r\n1,1\r\n1/2,2\r\n\"75*10^(-2)\",1\r\n",
                                  {"integrate", "kovalevskaya", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto json = outcome.json();
  EXPECT_EQ(json.at("ensemble"), 3);
  EXPECT_EQ(json.at("status"), "ok");
  EXPECT_EQ(json.at("counts").at("ok"), 3);
  ASSERT_EQ(json.at("members").size(), 3U);
  // Each is what a run of its own gives: the parameter from its line, the rest from the scene.
  write(folder, "one.toml", [] {
    std::string text = file_text(CASIMIR_SOURCE_DIR "/cases/kovalevskaya.toml");
    const std::string from = "M1 = \"1\", M2 = \"1/2\"";
    return text.replace(text.find(from), from.size(), "M1 = \"1/2\", M2 = \"1/2\"");
  }());
  const Outcome single = run_in(folder, {"integrate", "./one.toml", "--param", "r=2", "--json"});
  ASSERT_EQ(single.status, 0) << single.err;
  for (const auto& [name, value] : single.json().at("state").items()) {
    EXPECT_NEAR(std::stod(json.at("members")[1].at("state").at(name).get<std::string>()),
                std::stod(value.get<std::string>()), 1e-6)
        << name;
  }
  // .. and it is not the member before it.
  EXPECT_NE(json.at("members")[0].at("state"), json.at("members")[1].at("state"));
}

/// As a scene has to.
TEST(EnsembleFile, MembersObeyTheAssumptionsAndAreNamedOffTheConstraints) {
  const Folder folder;
  const auto refused = [&](const char* file, const char* why) {
    const Outcome outcome = members(folder, file, {"integrate", "kovalevskaya"});
    EXPECT_EQ(outcome.status, 2) << file;
    EXPECT_NE(outcome.err.find(why), std::string::npos) << outcome.err;
  };
  refused("r\n1\n0\n", "member 2: the assumption r != 0 does not hold");
  const auto warnings = [&](const char* file) {
    const Outcome outcome = members(folder, file, {"integrate", "kovalevskaya", "--json"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return outcome.json().at("warnings").dump();
  };
  EXPECT_NE(warnings("g1,g2,g3\n1,0,0\n0,3/5,4/5\n1,1,1\n").find("member 3: the constraint"),
            std::string::npos);
  EXPECT_EQ(warnings("g1,g2,g3\n1,0,0\n0,3/5,4/5\n").find("constraint"), std::string::npos);
}

/// A declared integral that changes is no fault of the members: it is none.
/// A power with a whole exponent that the scene gives has a value for each base.
TEST(EnsembleFile, ParametersThatNoColumnGivesAreThoseOfTheScene) {
  const Folder folder;
  folder.write("power.toml", R"toml(title = "power"
[phase_space]
variables = ["x"]
[parameters]
a = {}
n = {}
[equations]
x = "a^n"
[[scene]]
name = "default"
initial = { x = "0" }
parameters = { a = "-2", n = "3" }
duration = "1"
)toml");
  folder.write("a.csv", "a\n-2\n-3\n");
  const Outcome outcome = run_in(
      folder, {"integrate", "./power.toml", "--ensemble", "a.csv", "--output", "x.csv", "--quiet"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const std::string table = file_text(folder / "x.csv");
  EXPECT_TRUE(has(table, ",-8")) << table;
  EXPECT_TRUE(has(table, ",-27")) << table;
  const Outcome sweep =
      run_in(folder, {"sweep", "./power.toml", "--over", "a=-3:-2:2", "--output", "s.csv"});
  EXPECT_EQ(sweep.status, 0) << sweep.err;
  // The exponent is known at run time only: then the code takes a logarithm of the base.
  folder.write("n.csv", "n\n2\n3\n");
  EXPECT_EQ(run_in(folder, {"integrate", "./power.toml", "--ensemble", "n.csv"}).status, 2);
}

TEST(EnsembleFile, AnIntegralThatIsRefutedIsNamed) {
  const Folder folder;
  write(folder, "turn.toml",
        "title = \"t\"\n[phase_space]\nvariables = [\"x\", \"y\"]\n[equations]\nx = \"y\"\n"
        "y = \"-x\"\n[integrals]\nE = \"x^2 + y^2\"\nK = \"x*y\"\n[[scene]]\nname = \"default\"\n"
        "initial = { x = \"1\", y = \"1/2\" }\nduration = \"1\"\n");
  const Outcome outcome = members(folder, "x\n1\n2\n", {"integrate", "./turn.toml", "--json"});
  const std::string warnings = outcome.json().at("warnings").dump();
  EXPECT_NE(warnings.find("K changes by"), std::string::npos) << warnings;
  EXPECT_NE(warnings.find("it is refuted to be an integral"), std::string::npos) << warnings;
  EXPECT_EQ(warnings.find("E changes by"), std::string::npos) << warnings;
}

/// A level of small terms is as sharp as any; the rounding of a direction is no fault.
TEST(EnsembleFile, ConstraintsAreHeldBesideTheirTerms) {
  const Folder folder;
  const auto is_off = [&](const std::string& constraint, const char* initial, const char* file) {
    write(folder, "level.toml",
          "title = \"t\"\n[phase_space]\nvariables = [\"x\", \"y\"]\nconstraints = [\"" +
              constraint +
              "\"]\n[equations]\nx = \"-y*(x^2+y^2)\"\ny = \"x*(x^2+y^2)\"\n[[scene]]\nname = "
              "\"default\"\ninitial = " +
              initial + "\nduration = \"1\"\n");
    return members(folder, file, {"integrate", "./level.toml"}).out.find("the constraint") !=
           std::string::npos;
  };
  const char* const small = "{ x = \"10^(-7)\", y = \"0\" }";
  EXPECT_FALSE(is_off("x^2 + y^2 - 10^(-14)", small, "x,y\n1e-7,0\n0,1e-7\n"));
  EXPECT_TRUE(is_off("x^2 + y^2 - 10^(-14)", small, "x,y\n1e-7,0\n3e-7,0\n"));
  const char* const unit = "{ x = \"1\", y = \"0\" }";
  EXPECT_FALSE(is_off("x^2 + y^2 - 1", unit, "x,y\n0.28366218546322625,-0.9589242746631385\n"));
}

/// The check repeats the motion of the member, not that of the scene.
TEST(EnsembleFile, MembersOfAClosedFormAreCheckedFromTheirOwnStarts) {
  const Folder folder;
  const auto json =
      members(folder, "M1,M2\n3/5,4/5\n1,0\n",
              {"integrate", "euler", "--method", "exact", "--duration", "3", "--json"})
          .json();
  ASSERT_EQ(json.at("checked").size(), 2U);
  for (const auto& one : json.at("checked")) EXPECT_LT(one.at("error_estimate"), 1e-10);
}

TEST(EnsembleFile, TableHasALineForEachMember) {
  const Folder folder;
  const Outcome outcome =
      members(folder, "M1\n1\n2\n", {"integrate", "euler", "--output", "o.csv"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  std::istringstream table(file_text(folder.path() / "o.csv"));
  std::string line;
  std::getline(table, line);
  EXPECT_EQ(line, "member,status,t,M1,M2,M3,drift_H,drift_F1,steps");
  std::getline(table, line);
  EXPECT_TRUE(line.starts_with("1,ok,100,")) << line;
  std::getline(table, line);
  EXPECT_TRUE(line.starts_with("2,ok,100,")) << line;
  EXPECT_FALSE(std::getline(table, line));
}

TEST(EnsembleFile, ThreadsDoNotChangeWhatComesOut) {
  const Folder folder;
  std::string text = "M1,M3\n";
  for (int i = 0; i < 300; ++i) text += std::to_string(1 + i) + "/300,1/3\n";
  std::vector<std::string> tables;
  for (const char* jobs : {"1", "3"}) {
    const Outcome outcome =
        members(folder, text, {"integrate", "euler", "--jobs", jobs, "--output", "o.csv"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    tables.push_back(file_text(folder.path() / "o.csv"));
  }
  EXPECT_EQ(tables[0], tables[1]);
}

TEST(EnsembleFile, MemberThatStopsIsNamedAndLosesNoOther) {
  const Folder folder;
  write(folder, "riccati.toml", kBlowUp);
  const Outcome outcome =
      members(folder, "x\n-1\n0\n-2\n", {"integrate", "./riccati.toml", "--output", "o.csv"});
  EXPECT_EQ(outcome.status, 5);
  EXPECT_NE(outcome.err.find("1 of 3 members"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("member 2, at t = 1.570796"), std::string::npos) << outcome.err;
  const std::string table = file_text(folder.path() / "o.csv");
  EXPECT_NE(table.find("\n1,ok,2,"), std::string::npos) << table;
  EXPECT_NE(table.find("\n2,singularity,1.570796"), std::string::npos) << table;
  EXPECT_NE(table.find("\n3,ok,2,"), std::string::npos) << table;
}

TEST(EnsembleFile, OtherMethodsAndOtherSystemsGiveTheSame) {
  const Folder folder;
  for (const char* name : {"euler", "lagrange-euler-angles"}) {
    const std::string column = name == std::string("euler") ? "M1\n1\n4/5\n" : "theta\n1\n6/5\n";
    const auto state = [&](const char* method) {
      const Outcome outcome =
          members(folder, column,
                  {"integrate", name, "--method", method, "--tolerance", "1e-13", "--json"});
      EXPECT_EQ(outcome.status, 0) << outcome.err;
      return outcome.json().at("members")[1].at("state");
    };
    const auto lanes = state("taylor"), other = state("dop853");
    for (const auto& [variable, value] : lanes.items()) {
      EXPECT_NEAR(std::stod(value.get<std::string>()),
                  std::stod(other.at(variable).get<std::string>()), 1e-8)
          << name << ' ' << variable;
    }
  }
}

TEST(EnsembleFile, WithoutACompilerLanesStillRun) {
  const Folder folder, cache;
  const Environment none{
      {"PATH", "/nonexistent"}, {"CXX", ""}, {"CASIMIR_CACHE", cache.path().string()}};
  const Outcome tables = members(folder, "M1\n1\n2\n", {"integrate", "euler", "--json"}, none);
  ASSERT_EQ(tables.status, 0) << tables.err;
  EXPECT_TRUE(tables.json().at("warnings").empty());
  const Outcome interpreted =
      members(folder, "theta\n1\n", {"integrate", "lagrange-euler-angles", "--json"}, none);
  ASSERT_EQ(interpreted.status, 0) << interpreted.err;
  EXPECT_FALSE(interpreted.json().at("warnings").empty());
  EXPECT_EQ(members(folder, "M1\n1\n", {"integrate", "euler", "--method", "dop853"}, none).status,
            4);
}

struct BadFile {
  const char* text;
  const char* place;
  const char* says;
};

/// Members have no estimate each: what is doubtful shows where some are integrated again.
TEST(EnsembleFile, WhatRoundingDecidesIsAWarning) {
  const Folder folder;
  write(folder, "saddle.toml",
        "[phase_space]\nvariables = [\"x\", \"v\"]\n[equations]\nx = \"v\"\nv = \"x\"\n"
        "[[scene]]\nname = \"default\"\ninitial = { x = \"1\", v = \"-1\" }\nduration = \"50\"\n");
  const Outcome grown =
      members(folder, "x,v\n1,-1\n2,-2\n", {"integrate", "saddle.toml", "--json"});
  ASSERT_EQ(grown.status, 0) << grown.err;
  const auto warnings = grown.json().at("warnings");
  ASSERT_EQ(warnings.size(), 2U) << warnings;
  EXPECT_NE(warnings[0].get<std::string>().find("member 1: "), std::string::npos) << warnings;
  const Outcome calm = members(folder, "x,v\n1,-1\n2,-2\n",
                               {"integrate", "saddle.toml", "--duration", "2", "--json"});
  EXPECT_TRUE(calm.json().at("warnings").empty()) << calm.json().at("warnings");
}

/// .. and which these are is said.
TEST(EnsembleFile, SaysWhichMembersHaveAnEstimate) {
  const Folder folder;
  const std::string five = "M1\n1\n2\n3\n4\n5\n";
  const auto checked = members(folder, five, {"integrate", "euler", "--json"}).json().at("checked");
  ASSERT_EQ(checked.size(), 3U) << checked;
  EXPECT_EQ(checked[0].at("member"), 1);
  EXPECT_EQ(checked[2].at("member"), 5);
  for (const auto& member : checked) EXPECT_LT(member.at("error_estimate"), 1e-8);
  const Outcome text = members(folder, five, {"integrate", "euler"});
  EXPECT_NE(text.out.find("errors estimated of members 1, 4, 5 alone: at most about "),
            std::string::npos)
      << text.out;
}

/// x = 1 - sqrt(1 - 2t): the field points at the pole from both sides, so that steps of a loose
/// tolerance would go over it, and come back.
TEST(EnsembleFile, MembersEndAtPolesAtEveryTolerance) {
  const Folder folder;
  write(folder, "pole.toml",
        "[phase_space]\nvariables = [\"x\"]\n[parameters]\na = {}\n[equations]\n"
        "x = \"a/(1 - x)\"\n[[scene]]\nname = \"default\"\nparameters = { a = \"1\" }\n"
        "initial = { x = \"0\" }\nduration = \"2\"\n");
  for (const char* method : {"taylor", "dop853"})
    for (const char* tolerance : {"1e-3", "1e-5", "1e-8", "1e-12"}) {
      const Outcome all = members(folder, "x\n0\n1/2\n2\n",
                                  {"integrate", "pole.toml", "--tolerance", tolerance, "--method",
                                   method, "--json", "--time-limit", "20"});
      EXPECT_EQ(all.status, 5) << method << ' ' << tolerance;
      const double within = 10 * std::stod(tolerance);
      const auto run = all.json();
      const std::vector<double> ends{0.5, 0.125, 0.5};
      for (std::size_t i = 0; i < ends.size(); ++i) {
        const auto& member = run.at("members")[i];
        EXPECT_EQ(member.at("status"), "singularity") << method << ' ' << tolerance;
        EXPECT_NEAR(number(member.at("t")), ends[i], within) << method << ' ' << tolerance;
      }
    }
  EXPECT_EQ(run_in(folder, {"sweep", "pole.toml", "--over", "a=1,2", "--tolerance", "1e-3",
                            "--time-limit", "20", "--quiet"})
                .status,
            5);
}

/// The absolute tolerance is in units of each start: that of the scene would be all of the small
/// ones. They are members of one linear system, so each is the first, made smaller.
TEST(EnsembleFile, SmallMembersHaveAllTheirDigits) {
  const Folder folder;
  write(folder, "line.toml",
        "[phase_space]\nvariables = [\"x\", \"v\"]\n[equations]\nx = \"v\"\nv = \"-x\"\n"
        "[[scene]]\nname = \"default\"\ninitial = { x = \"1\", v = \"0\" }\nduration = \"20\"\n");
  for (const char* method : {"taylor", "gauss8"}) {
    const Outcome all = members(folder, "x\n1\n1e-3\n1e-10\n1e-15\n1e-40\n1\n",
                                {"integrate", "line.toml", "--json", "--method", method});
    ASSERT_EQ(all.status, 0) << all.err;
    const std::vector<double> starts{1, 1e-3, 1e-10, 1e-15, 1e-40, 1};
    for (std::size_t i = 0; i < starts.size(); ++i) {
      const std::string x = all.json().at("members")[i].at("state").at("x");
      EXPECT_NEAR(std::stod(x) / starts[i], std::cos(20), 1e-7) << method << ' ' << starts[i];
    }
    EXPECT_TRUE(all.json().at("warnings").empty()) << all.json().at("warnings");
  }
}

TEST(EnsembleFile, BadOnesAreRefusedAtTheirPlace) {
  const Folder folder;
  for (const BadFile& bad : {BadFile{"M1,gg3\n1,2\n", "members.csv:1:4: error:", "mean 'g3'"},
                             BadFile{"M1,g3\n1,2\n1,x+\n", "members.csv:3:3: error:", "1,x+"},
                             BadFile{"M1,M1\n1,2\n", "members.csv:1:4: error:", "M1"},
                             BadFile{"M1,g3\n1\n", "members.csv:2:", "1 fields"},
                             BadFile{"M1,g3\n", "members.csv:1:1: error:", "no members"},
                             BadFile{"", "members.csv:1:1: error:", "empty"},
                             BadFile{"M1\n1/0\n", "members.csv:2:", "1/0"},
                             BadFile{"M1\nsqrt(-1)\n", "members.csv:2:", "sqrt(-1)"}}) {
    const Outcome outcome =
        members(folder, bad.text, {"integrate", "kovalevskaya", "--output", "o.csv"});
    EXPECT_EQ(outcome.status, 2) << bad.text;
    EXPECT_NE(outcome.err.find(bad.place), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find(bad.says), std::string::npos) << outcome.err;
    EXPECT_EQ(folder.files(), 1U) << bad.text;
  }
  EXPECT_EQ(run_in(folder, {"integrate", "euler", "--ensemble", "none.csv"}).status, 2);
  EXPECT_EQ(run_in(folder, {"integrate", "euler", "--jobs", "2"}).status, 2);
}

}  // namespace
}  // namespace casimir::test
