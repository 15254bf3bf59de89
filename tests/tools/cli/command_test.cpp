// What each command prints, writes and returns, as the interface promises.
#include <gtest/gtest.h>

#include <signal.h>
#include <set>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <sstream>
#include <thread>

#include "tests/bundled_cases.hpp"
#include "tests/tools/program.hpp"

namespace casimir::test {
namespace {

TEST(Help, IsThereWithoutAnOption) {
  const Outcome first = run({});
  EXPECT_EQ(first.status, 0) << first.err;
  EXPECT_NE(first.out.find("casimir help [COMMAND]"), std::string::npos) << first.out;
  EXPECT_EQ(run({"help"}).out, run({"--help"}).out);
  EXPECT_EQ(run({"help", "verify"}).out, run({"verify", "--help"}).out);
  const Outcome unknown = run({"help", "verfy"});
  EXPECT_EQ(unknown.status, 2);
  EXPECT_NE(unknown.err.find("'verify'"), std::string::npos) << unknown.err;
}

TEST(Help, SaysOfEachCommandOneLine) {
  std::istringstream help(run({"help"}).out);
  std::string line;
  while (std::getline(help, line) && line != "Subcommands:") {
  }
  int commands = 0;
  while (std::getline(help, line) && !line.empty()) {
    EXPECT_TRUE(line.starts_with("  ") && line.size() > 2 && line[2] != ' ') << line;
    EXPECT_LE(line.size(), 120U) << line;
    ++commands;
  }
  EXPECT_GT(commands, 20);
}

/// What is written is CSV, whatever the name says.
TEST(Output, OtherEndingsAreRefused) {
  const Folder folder;
  for (const char* command : {"integrate", "conserve"}) {
    const std::string path = (folder.path() / "x.json").string();
    const Outcome outcome = run({command, "euler", "--output", path});
    EXPECT_EQ(outcome.status, 2) << command;
    EXPECT_NE(outcome.err.find("FILE.csv"), std::string::npos) << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(path));
  }
}

TEST(Equilibria, AreProvedWhereThatIsAskedFor) {
  const Outcome outcome = run({"equilibria", "kovalevskaya", "--validated", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto json = outcome.json();
  std::set<std::string> stability;
  for (const auto& entry : json.at("equilibria")) {
    const auto& validated = entry.at("validated");
    EXPECT_EQ(validated.at("verdict"), "proved");
    EXPECT_LT(std::stod(validated.at("radius").get<std::string>()), 1e-30);
    const auto& ends = validated.at("enclosure").at("g1");
    const double at = std::stod(entry.at("state").at("g1").get<std::string>());
    EXPECT_LE(std::stod(ends.at(0).get<std::string>()), at);
    EXPECT_GE(std::stod(ends.at(1).get<std::string>()), at);
    stability.insert(validated.at("stability"));
  }
  EXPECT_EQ(stability, (std::set<std::string>{"stable", "unstable"}));
}

TEST(List, NamesEveryCaseAndItsScenes) {
  const Outcome outcome = run({"list", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  std::vector<std::string> names;
  const auto json = outcome.json();
  for (const auto& entry : json.at("cases")) {
    names.push_back(entry.at("name"));
    EXPECT_GT(entry.at("dimension"), 0);
    EXPECT_TRUE(entry.at("tags").is_array());
    EXPECT_EQ(entry.at("scenes").at(0), "default") << names.back();
  }
  for (const char* name : {"kovalevskaya", "clebsch", "steklov", "euler", "lagrange"}) {
    EXPECT_NE(std::find(names.begin(), names.end(), name), names.end()) << name;
  }
  EXPECT_LT(run({"list", "--tag", "kirchhoff", "--json"}).json().at("cases").size(), names.size());
}

TEST(List, CasesOfAFolderInTheEnvironmentComeFirst) {
  const Folder folder;
  folder.write(
      "mine.toml",
      "hamiltonian = \"p^2\"\n[phase_space]\nvariables = [\"q\",\"p\"]\ncanonical = true\n");
  const Outcome outcome = run({"verify", "mine"}, {}, {{"CASIMIR_CASES", folder.path().string()}});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
}

TEST(Verify, ExitStatusFollowsTheVerdict) {
  EXPECT_EQ(run({"verify", "kovalevskaya", "--quiet"}).status, 0);
  EXPECT_EQ(run({"verify", "kovalevskaya", "--integral", "M1"}).status, 1);
  EXPECT_EQ(run({"verify", "kovalevskaya", "--integral", "(M1+M2+M3+g1+g2+g3+r)^300"}).status, 3);
  EXPECT_EQ(run({"verify", "kovalevskaya", "--integral", "M4"}).status, 2);
}

TEST(Verify, JsonHasTheKeysOfTheInterface) {
  const Outcome outcome = run({"verify", "kovalevskaya", "--json"});
  const auto json = outcome.json();
  EXPECT_EQ(json.at("case"), "kovalevskaya");
  EXPECT_EQ(json.at("verdict"), "proved");
  EXPECT_GT(json.at("seconds"), 0);
  for (const auto& claim : json.at("claims")) EXPECT_EQ(claim.at("verdict"), "proved");
  std::vector<std::string> facts;
  for (const auto& fact : json.at("facts")) facts.push_back(fact.at("kind"));
  EXPECT_EQ(facts, (std::vector<std::string>{"independence", "rank", "liouville"}));
}

TEST(Verify, RefutedCandidateCarriesAWitness) {
  const auto json = run({"verify", "kovalevskaya", "--json", "--integral", "M1^2 + g1"}).json();
  const auto& claim = json.at("claims").at(0);
  EXPECT_EQ(claim.at("kind"), "integral");
  EXPECT_EQ(claim.at("verdict"), "refuted");
  for (const char* name : {"M1", "M2", "M3", "g1", "g2", "g3", "r"})
    EXPECT_TRUE(claim.at("witness").contains(name)) << name;
  EXPECT_NE(claim.at("witness").at("value"), "0");
  EXPECT_FALSE(claim.at("residual").get<std::string>().empty());
}

TEST(Verify, CandidatesOnALevel) {
  const std::string g = "M3*(M1^2 + M2^2) + r*M1*g3";
  EXPECT_EQ(run({"verify", "goryachev-chaplygin", "--integral", g, "--on", "M1*g1 + M2*g2 + M3*g3"})
                .status,
            0);
  EXPECT_EQ(run({"verify", "goryachev-chaplygin", "--integral", g}).status, 1);
  EXPECT_EQ(run({"verify", "euler", "--casimir", "M1^2 + M2^2 + M3^2", "--casimir", "M1^2"}).status,
            1);
}

TEST(Verify, AllCasesAreProvedAndTheDocumentIsTheWholeOutput) {
  const Outcome outcome = run({"verify", "--all", "--json"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.json().at("verdict"), "proved");
  EXPECT_GE(outcome.json().at("cases").size(), 10U);
  EXPECT_TRUE(outcome.err.empty()) << outcome.err;
}

TEST(Verify, ParametersCanBeFixed) {
  const std::string k = "(M1^2 - M2^2 + 2*r*g1)^2 + (2*M1*M2 + 2*r*g2)^2";
  EXPECT_EQ(run({"verify", "kovalevskaya", "--param", "r=0.5", "--integral", k}).status, 0);
  EXPECT_EQ(run({"verify", "kovalevskaya", "--param", "q=1"}).status, 2);
  EXPECT_EQ(run({"verify", "kovalevskaya", "--param", "r"}).status, 2);
}

TEST(Verify, TimeLimitLeavesTheRestUndecided) {
  const Outcome outcome = run({"verify", "kovalevskaya", "--json", "--time-limit", "0.2",
                               "--integral", "(M1+2*M2+3*M3+5*g1+7*g2+11*g3+r)^18"});
  EXPECT_EQ(outcome.status, 3) << outcome.out;
  EXPECT_EQ(outcome.json().at("claims").at(0).at("verdict"), "undecided");
  const Outcome fast = run({"verify", "kovalevskaya", "--json", "--time-limit", "60"});
  EXPECT_EQ(fast.status, 0);
  EXPECT_EQ(fast.json().at("facts").size(), 3U);
}

TEST(Verify, CaseFromStandardInput) {
  const std::string text = file_text(CASIMIR_SOURCE_DIR "/cases/euler.toml");
  EXPECT_EQ(run({"verify", "-"}, text).status, 0);
  EXPECT_EQ(run({"verify", "-"}, "title = ").status, 2);
}

TEST(Verify, CtrlCExitsWith130WithinASecond) {
  const Folder folder;
  const pid_t child = start(
      {"verify", "kovalevskaya", "--integral", "(M1+2*M2+3*M3+5*g1+7*g2+11*g3+r)^22"}, folder);
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  const auto start = std::chrono::steady_clock::now();
  kill(child, SIGINT);
  EXPECT_EQ(finish(child, folder).status, 130);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(1));
}

TEST(Integrate, CtrlCLeavesTheStatesSoFarInTheFile) {
  const Folder folder;
  const pid_t child = start({"integrate", "euler", "--method", "taylor", "--duration", "1e9",
                             "--output", "states.csv", "--every", "1e3", "--json"},
                            folder);
  std::this_thread::sleep_for(std::chrono::milliseconds(1000));
  kill(child, SIGINT);
  const Outcome outcome = finish(child, folder);
  EXPECT_EQ(outcome.status, 130) << outcome.err;
  EXPECT_EQ(outcome.json().at("status"), "stopped");
  const std::string text = file_text(folder.path() / "states.csv");
  EXPECT_GT(std::count(text.begin(), text.end(), '\n'), 10);
  const std::string end = "# stopped at t = " + outcome.json().at("t").get<std::string>();
  EXPECT_NE(text.find(end), std::string::npos) << text.substr(text.size() - 200);
  EXPECT_LT(std::stod(outcome.json().at("t").get<std::string>()), 1e9);
}

TEST(Integrate, CtrlCWithoutAFileExitsWith130) {
  const Folder folder;
  const pid_t child =
      start({"integrate", "euler", "--method", "taylor", "--duration", "1e9"}, folder);
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  kill(child, SIGINT);
  EXPECT_EQ(finish(child, folder).status, 130);
}

TEST(Generate, PlainCIsAnotherLanguage) {
  const Folder folder;
  const Outcome outcome =
      run_in(folder, {"generate", "euler-angles", "--language", "C", "-o", "top.h", "--json"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.json().at("file"), "top.h");
  const std::string header = file_text(folder.path() / "top.h");
  EXPECT_NE(header.find("static inline void euler_angles_rhs("), std::string::npos) << header;
  EXPECT_EQ(header.find("namespace"), std::string::npos);
  EXPECT_EQ(run({"generate", "euler", "--language", "c", "--with", "taylor"}).status, 2);
  EXPECT_EQ(run({"generate", "euler", "--language", "c", "--scalar", "template"}).status, 2);
  const Outcome unknown = run({"generate", "euler", "--language", "fortran"});
  EXPECT_EQ(unknown.status, 2);
  EXPECT_NE(unknown.err.find("'fortran' is none of c, c++"), std::string::npos) << unknown.err;
}

TEST(Generate, WritesAHeaderAndSaysWhatWasLeftOut) {
  const Folder folder;
  const auto json = run_in(folder, {"generate", "kovalevskaya", "-o", "k.hpp", "--json"}).json();
  EXPECT_EQ(json.at("case"), "kovalevskaya");
  EXPECT_EQ(json.at("scene"), "default");
  EXPECT_EQ(json.at("file"), "k.hpp");
  EXPECT_EQ(json.at("left_out").at(0).at("name"), "r");
  EXPECT_LT(json.at("operations").at("specialised").at("mul"),
            json.at("operations").at("general").at("mul"));
  EXPECT_NE(file_text(folder.path() / "k.hpp").find("inline void rhs(const double* x, double* dx)"),
            std::string::npos);
  EXPECT_EQ(folder.files(), 1U);
}

TEST(Generate, LeavesOutTheStatesThatAreNotObserved) {
  const Folder folder;
  const auto json =
      run_in(folder, {"generate", "euler-e3", "--observe", "M1", "-o", "e.hpp", "--json"}).json();
  std::vector<std::string> states;
  for (const auto& item : json.at("left_out")) {
    if (item.at("kind") == "state") states.push_back(item.at("name"));
  }
  EXPECT_EQ(states, (std::vector<std::string>{"g1", "g2", "g3"}));
  EXPECT_EQ(run({"generate", "euler-e3", "--observe", "M9"}).status, 2);
}

TEST(Integrate, ReachesTheReferenceState) {
  const Folder folder;
  const auto json = run_in(folder, {"integrate", "kovalevskaya", "--scene", "generic",
                                    "--tolerance", "1e-12", "--json"})
                        .json();
  EXPECT_EQ(json.at("status"), "ok");
  EXPECT_EQ(json.at("t"), "100");
  // Reference: two Taylor series in 45 and 90 digits.
  EXPECT_NEAR(std::stod(json.at("state").at("M1").get<std::string>()), 0.9314032994660502, 1e-9);
  EXPECT_NEAR(std::stod(json.at("state").at("g3").get<std::string>()), -0.7221564930330076, 1e-9);
  for (const char* key : {"steps", "rejected", "evaluations", "left_out", "warnings"})
    EXPECT_TRUE(json.contains(key)) << key;
  for (const char* key : {"generate", "compile", "integrate"})
    EXPECT_GE(json.at("seconds").at(key), 0) << key;
  EXPECT_LT(std::stod(json.at("invariants").at("K").at("drift").get<std::string>()), 1e-9);
}

TEST(Integrate, SaysHowFarTheResultCanBeTrusted) {
  const auto good = run({"integrate", "kovalevskaya", "--scene", "generic", "--json"}).json();
  const double estimate = std::stod(good.at("trust").at("error_estimate").get<std::string>());
  const double error =
      std::abs(std::stod(good.at("state").at("M1").get<std::string>()) - 0.9314032994660502);
  EXPECT_LE(error, 3 * estimate);
  EXPECT_LT(estimate, 1e-5);
  EXPECT_EQ(good.at("trust").at("beyond_double"), false);
  EXPECT_TRUE(good.at("warnings").empty());
  // The instability of the middle axis, for long enough to lose every digit.
  const Folder folder;
  const std::string hard = folder.write(
      "hard.toml",
      "hamiltonian = \"(M1^2 + 2*M2^2 + 3*M3^2)/2\"\n[phase_space]\nvariables = "
      "[\"M1\",\"M2\",\"M3\"]\nalgebra = \"so(3)\"\n[[scene]]\nname = \"default\"\ninitial = { M1 "
      "= \"10^(-14)\", M2 = \"1\", M3 = \"10^(-14)\" }\nduration = \"33\"\n");
  const auto doubtful =
      run_in(folder, {"integrate", hard, "--tolerance", "1e-10", "--json"}).json();
  EXPECT_EQ(doubtful.at("status"), "ok");
  EXPECT_FALSE(doubtful.at("warnings").empty());
}

TEST(Integrate, EveryMethodAgrees) {
  const Folder folder;
  for (const char* method : {"dop853", "taylor", "taylor-compiled", "gauss4", "gauss6", "gauss8",
                             "gauss12", "gauss16", "radau5", "radau9", "odeint-fehlberg78",
                             "odeint-dopri5", "cvode-adams", "cvode-bdf", "arkode-erk", "auto"}) {
    const Outcome outcome = run_in(folder, {"integrate", "kovalevskaya", "--method", method,
                                            "--tolerance", "1e-9", "--duration", "5", "--json"});
    ASSERT_EQ(outcome.status, 0) << method << outcome.err;
    static const double expected =
        std::stod(outcome.json().at("state").at("M1").get<std::string>());
    EXPECT_NEAR(std::stod(outcome.json().at("state").at("M1").get<std::string>()), expected, 1e-6)
        << method;
  }
}

TEST(Integrate, WritesStatesAtTheTimesAskedFor) {
  const Folder folder;
  const Outcome outcome = run_in(
      folder, {"integrate", "euler", "--duration", "1", "--every", "0.25", "--output", "e.csv"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  std::istringstream csv(file_text(folder.path() / "e.csv"));
  std::string line;
  std::getline(csv, line);
  EXPECT_EQ(line, "t,M1,M2,M3");
  std::vector<double> times;
  while (std::getline(csv, line)) times.push_back(std::stod(line));
  EXPECT_EQ(times, (std::vector<double>{0, 0.25, 0.5, 0.75, 1}));
}

TEST(Integrate, StopsAtASingularityWithTheTimeAndTheState) {
  const Folder folder;
  const std::string blowup =
      folder.write("blowup.toml",
                   "[phase_space]\nvariables = [\"x\"]\n[equations]\nx = \"x^2\"\n[[scene]]\nname "
                   "= \"default\"\ninitial = { x = \"1\" }\nduration = \"2\"\n");
  const Outcome outcome = run_in(folder, {"integrate", blowup, "--json"});
  EXPECT_EQ(outcome.status, 5);
  const auto json = outcome.json();
  EXPECT_EQ(json.at("status"), "singularity");
  EXPECT_NEAR(std::stod(json.at("stopped").at("time").get<std::string>()), 1, 1e-3);
  EXPECT_FALSE(json.at("stopped").at("advice").get<std::string>().empty());
  EXPECT_NE(outcome.err.find("stopped at t = "), std::string::npos) << outcome.err;
  EXPECT_EQ(run_in(folder, {"integrate", blowup, "--duration", "1/2"}).status, 0);
}

TEST(Integrate, TimeLimitEndsWithTheStateReached) {
  const Folder folder;
  const Outcome outcome = run_in(
      folder, {"integrate", "kovalevskaya", "--duration", "1e9", "--time-limit", "0.3", "--json"});
  EXPECT_EQ(outcome.status, 4);
  const auto json = outcome.json();
  EXPECT_EQ(json.at("status"), "stopped");
  EXPECT_GT(std::stod(json.at("t").get<std::string>()), 0);
}

TEST(Conserve, ReferenceBelongsToItsParameters) {
  // With r = 2 the motion is another one: the state in the file is no reference for it.
  const Folder folder;
  const auto own = run_in(folder, {"conserve", "kovalevskaya", "--scene", "default", "--param",
                                   "r=1", "--method", "dop853", "--json"})
                       .json();
  EXPECT_LT(std::stod(own.at("rows").at(0).at("error").get<std::string>()), 1e-8);
  const auto other = run_in(folder, {"conserve", "kovalevskaya", "--scene", "default", "--param",
                                     "r=2", "--method", "dop853", "--json"})
                         .json();
  EXPECT_TRUE(other.at("rows").at(0).at("error").is_null());
}

TEST(Conserve, PassesAndFailsByItsBound) {
  const Folder folder;
  const Outcome good = run_in(folder, {"conserve", "clebsch", "--scene", "default", "--json"});
  EXPECT_EQ(good.status, 0) << good.err;
  EXPECT_EQ(good.json().at("failed"), 0);
  EXPECT_EQ(good.json().at("rows").size(), 3U);
  const Outcome strict = run_in(folder, {"conserve", "clebsch", "--scene", "default", "--method",
                                         "dop853", "--tolerance", "1e-4", "--json"});
  EXPECT_EQ(strict.status, 1);
  EXPECT_EQ(strict.json().at("failed"), 1);
}

/// No integral, and infinite from the start: what it changes by is no number.
/// One step of the series goes from t = 0 to 1, where sin(Pi*t)^2 is zero again.
TEST(Conserve, AnIntegralThatReturnsAtTheEndsOfStepsIsNotKept) {
  const Folder folder;
  const auto run = [&](const std::string& integral) {
    folder.write("returns.toml",
                 "[phase_space]\nvariables = [\"x\", \"y\"]\n[equations]\nx = \"1\"\ny = \"0\"\n"
                 "[integrals]\nA = \"" +
                     integral +
                     "\"\n[[scene]]\nname = \"default\"\ninitial = { x = \"0\", y = \"1\" }\n"
                     "duration = 1\n");
    return run_in(folder, {"conserve", "./returns.toml", "--method", "taylor", "--json"});
  };
  const Outcome returning = run("y + sin(Pi*x)^2");
  EXPECT_EQ(returning.status, 1);
  EXPECT_NE(returning.out.find("A is not kept"), std::string::npos) << returning.out;
  EXPECT_EQ(run("y").status, 0);
}

/// At a = 0 the integral has values, and its derivative is 0/0.
TEST(Conserve, ARateWithoutAValueIsNoFault) {
  const Folder folder;
  folder.write("edge.toml",
               "[phase_space]\nvariables = [\"x\", \"y\"]\n[parameters]\na = {}\n[equations]\n"
               "x = \"1\"\ny = \"-y\"\n[integrals]\nF = \"y*exp(x)*(1 + sqrt(a*y*exp(x)))\"\n"
               "[[scene]]\nname = \"default\"\nparameters = { a = \"0\" }\n"
               "initial = { x = \"1\", y = \"1\" }\nduration = 1\n");
  const Outcome outcome = run_in(folder, {"conserve", "./edge.toml", "--method", "taylor"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
}

TEST(Conserve, ADriftThatIsNoNumberFails) {
  const Folder folder;
  std::ofstream(folder.path() / "infinite.toml") << R"toml(title = "infinite"
[phase_space]
variables = ["x", "y"]
[equations]
x = "y"
y = "-x"
[integrals]
A = "exp(1000*(x^2 + 2*y^2 + 1))"
[[scene]]
name = "default"
initial = { x = "10", y = "0" }
duration = "10"
)toml";
  const Outcome outcome =
      run_in(folder, {"conserve", "./infinite.toml", "--method", "taylor", "--json"});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(outcome.json().at("failed"), 1);
}

/// Half of the cases need no compiler by this method.
TEST(EveryCase, KeepsEveryBoundOfItsIntegrals) {
  const Folder folder;
  std::size_t rows = 0, kept = 0;
  const auto look = [&](const std::string& which) {
    const Outcome outcome = run_in(folder, {"conserve", which, "--method", "taylor", "--json"});
    EXPECT_EQ(outcome.status, 0) << which << outcome.err;
    const auto json = outcome.json();
    EXPECT_EQ(json.at("failed"), 0) << which;
    std::set<std::string> cases;
    for (const auto& row : json.at("rows")) {
      cases.insert(row.at("case"));
      kept += row.at("status") == "ok";
    }
    rows += json.at("rows").size();
    return cases.size();
  };
  if (wants_every_case()) {
    EXPECT_EQ(look("--all"), run({"list", "--json"}).json().at("cases").size());
  } else {
    for (const auto& path : cases_to_go_through()) EXPECT_EQ(look(path.stem().string()), 1U);
  }
  EXPECT_GT(kept, rows * 9 / 10);
}

TEST(Conserve, DrawsDriftAgainstTime) {
  const Folder folder;
  const Outcome one = run_in(folder, {"conserve", "clebsch", "--scene", "default", "--method",
                                      "taylor", "--plot", "one.svg"});
  ASSERT_EQ(one.status, 0) << one.err;
  const std::string picture = file_text(folder.path() / "one.svg");
  for (const char* name : {">H<", ">F1<", ">F2<", ">F<", "clebsch, scene default, taylor"})
    EXPECT_NE(picture.find(name), std::string::npos) << name;
  const Outcome two = run_in(folder, {"conserve", "clebsch", "--scene", "default", "--method",
                                      "taylor,dop853", "--plot", "two.svg"});
  ASSERT_EQ(two.status, 0) << two.err;
  const std::string methods = file_text(folder.path() / "two.svg");
  for (const char* name : {">taylor<", ">dop853<"})
    EXPECT_NE(methods.find(name), std::string::npos) << name;
  EXPECT_EQ(run({"conserve", "clebsch", "--plot", "drift.gif"}).status, 2);
  EXPECT_EQ(run({"conserve", "--all", "--plot", "drift.svg"}).status, 2);
}

}  // namespace
}  // namespace casimir::test
