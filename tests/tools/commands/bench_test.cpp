// casimir bench: what it measures, what it calls wrong, and what it leaves out.
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <set>
#include <thread>

#include "tests/tools/program.hpp"

namespace casimir::test {
namespace {

using Json = nlohmann::ordered_json;

/// A case of plain equations, with whatever follows the scene's name.
std::string equations_case(const std::string& equations, const std::string& scene) {
  std::string names;
  std::istringstream lines(equations);
  for (std::string line; std::getline(lines, line);)
    names += (names.empty() ? "\"" : ", \"") + line.substr(0, line.find(' ')) + "\"";
  return "[phase_space]\nvariables = [" + names + "]\n[equations]\n" + equations +
         "\n[[scene]]\nname = \"default\"\n" + scene + "\n";
}

std::vector<Json> rows_of(const Json& document, const std::string& method,
                          const std::string& code = "specialised") {
  std::vector<Json> rows;
  for (const auto& row : document.at("rows"))
    if (row.at("method") == method && row.at("code") == code) rows.push_back(row);
  return rows;
}

TEST(Bench, ReportsErrorBesideTime) {
  const Folder folder;
  const Outcome outcome =
      run_in(folder, {"bench", "euler", "--scene", "generic", "--method", "dop853,cvode-adams",
                      "--tolerances", "1e-6,1e-10", "--repeat", "3", "--json", "--output", "b.csv",
                      "--plot", "b.svg"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(outcome.err.empty()) << "no progress where there is no terminal: " << outcome.err;
  double loose = 0;
  const auto json = outcome.json();
  for (const auto& row : json.at("rows")) {
    const double error = number(row.at("error"));
    EXPECT_GT(row.at("seconds"), 0);
    EXPECT_GE(row.at("spread"), 0);
    EXPECT_EQ(row.at("status"), "ok");
    if (row.at("tolerance") == 1e-6)
      loose = error;
    else
      EXPECT_LT(error, loose) << row;
  }
  EXPECT_EQ(json.at("rows").size(), 6U);  // dop853 on specialised and on general code
  EXPECT_EQ(json.at("failed"), 0);
  const std::string csv = file_text(folder.path() / "b.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 7);
  std::istringstream head(csv.substr(0, csv.find('\n')));
  for (std::string column; std::getline(head, column, ',');)
    EXPECT_TRUE(json.at("rows").at(0).contains(column)) << column;
  const std::string svg = file_text(folder.path() / "b.svg");
  EXPECT_NE(svg.find("</svg>"), std::string::npos);
  EXPECT_NE(svg.find("cvode-adams"), std::string::npos);
  EXPECT_EQ(folder.files(), 2U);
}

TEST(Bench, EveryMethodAndEveryLibraryComesWithoutBeingAsked) {
  const Outcome outcome =
      run({"bench", "kovalevskaya", "--tolerances", "1e-4,1e-9", "--repeat", "3", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto json = outcome.json();
  for (const char* method :
       {"taylor", "taylor-compiled", "dop853", "gauss8", "gauss16", "cvode-adams", "cvode-bdf",
        "arkode-erk", "odeint-fehlberg78", "odeint-dopri5"}) {
    const auto rows = rows_of(json, method);
    ASSERT_EQ(rows.size(), 2U) << method;
    EXPECT_LT(number(rows[1].at("error")), 1e-3) << method;
  }
  EXPECT_FALSE(json.at("machine").at("cpu").get<std::string>().empty());
  EXPECT_GT(json.at("machine").at("cores"), 0);
  for (const char* what : {"compiler", "SUNDIALS", "Boost"})
    EXPECT_FALSE(json.at("versions").at(what).get<std::string>().empty()) << what;
}

TEST(Bench, RatiosCompareTheFastestOfOursAtEqualError) {
  const auto json = run({"bench", "euler", "--method", "dop853,gauss8,odeint-dopri5",
                         "--tolerances", "1e-3,1e-5,1e-7,1e-9,1e-11", "--repeat", "3", "--json"})
                        .json();
  double best = 1;
  for (const auto& row : rows_of(json, "odeint-dopri5"))
    best = std::min(best, number(row.at("error")));
  int seen = 0;
  for (const auto& ratio : json.at("ratios")) {
    if (ratio.at("method") != "odeint-dopri5") continue;
    ++seen;
    EXPECT_EQ(ratio.at("library"), "Boost.Odeint");
    if (ratio.at("best")) {
      EXPECT_DOUBLE_EQ(ratio.at("error"), best);
    }
    if (ratio.at("seconds").is_null()) continue;
    EXPECT_TRUE(ratio.at("fastest") == "dop853" || ratio.at("fastest") == "gauss8") << ratio;
    EXPECT_NEAR(ratio.at("ratio").get<double>(),
                ratio.at("seconds").get<double>() / ratio.at("fastest_seconds").get<double>(),
                1e-9);
  }
  EXPECT_EQ(seen, 5);  // 1e-3, 1e-6, 1e-9, 1e-12 and its best
}

TEST(Bench, ReferenceIsAtTheDurationAskedFor) {
  const Folder folder;
  const auto json = run_in(folder, {"bench", "kovalevskaya", "--duration", "7.5", "--method",
                                    "dop853", "--tolerances", "1e-12", "--repeat", "1", "--json"})
                        .json();
  EXPECT_EQ(json.at("reference").at("source").get<std::string>().find("the case file"),
            std::string::npos);
  EXPECT_LT(number(json.at("rows").at(0).at("error")), 1e-9);
}

TEST(Bench, ReferenceOfTheFileIsCheckedAndItsErrorBounded) {
  const auto json = run({"bench", "kovalevskaya", "--method", "dop853", "--tolerances", "1e-6",
                         "--repeat", "1", "--json"})
                        .json();
  const auto& reference = json.at("reference");
  EXPECT_EQ(reference.at("digits"), 30);
  EXPECT_LT(number(reference.at("error_bound")), 1e-28);
  EXPECT_GT(number(reference.at("error_bound")), 0);
  EXPECT_NE(reference.at("source").get<std::string>().find("checked"), std::string::npos);
}

TEST(Bench, ReferenceThatIsFalseIsBadInput) {
  const Folder folder;
  // The oscillator after one radian, with the ninth digit of the sine changed.
  const std::string right =
      "x = \"0.540302305868139717400936607443\", "
      "v = \"-0.841470984807896506652502321630\"";
  const std::string scene = "initial = { x = \"1\", v = \"0\" }\nduration = \"1\"\nreference = { ";
  const std::string equations = "x = \"v\"\nv = \"-x\"";
  const auto bench = [&](const std::string& reference) {
    const std::string file =
        folder.write("r.toml", equations_case(equations, scene + reference + " }"));
    return run_in(folder, {"bench", file, "--method", "dop853", "--tolerances", "1e-9", "--repeat",
                           "1", "--json"});
  };
  EXPECT_EQ(bench(right).status, 0);
  std::string wrong = right;
  wrong.replace(wrong.find("0.8414709848"), 12, "0.8414709838");
  const Outcome outcome = bench(wrong);
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("reference state in the case file is 1.2e-09 off"), std::string::npos)
      << outcome.err;
}

TEST(Bench, ToleranceTooCoarseForTheMotionIsWrongButNoFailure) {
  const auto json = run({"bench", "kovalevskaya", "--method", "dop853,cvode-bdf", "--tolerances",
                         "0.1,1e-9", "--repeat", "1", "--json"})
                        .json();
  const auto rows = rows_of(json, "cvode-bdf");
  EXPECT_EQ(rows.at(0).at("status"), "wrong") << rows.at(0);
  EXPECT_GE(number(rows.at(0).at("error")), 0.1);
  EXPECT_EQ(rows.at(0).at("failed"), false);
  EXPECT_FALSE(rows.at(0).at("reason").get<std::string>().empty());
  EXPECT_EQ(rows.at(1).at("status"), "ok");
  EXPECT_EQ(json.at("failed"), 0);
  for (const auto& ratio : json.at("ratios")) {
    // It counts in no ratio: the fastest good run of this method is the other one.
    if (ratio.at("method") == "cvode-bdf" && !ratio.at("seconds").is_null()) {
      EXPECT_EQ(ratio.at("seconds"), rows.at(1).at("seconds"));
    }
  }
}

/// A pulse as narrow as 1e-4, which step control alone passes without a notice.
std::string pulse_case() {
  return equations_case("x = \"(1/10000)/((s - 61)^2 + 1/100000000)\"\ns = \"1\"",
                        "initial = { x = \"0\", s = \"0\" }\nduration = \"100\"");
}

TEST(Bench, APulseThatALibraryMissesIsWrongAndFailsNothing) {
  const Folder folder;
  const std::string pulse = folder.write("pulse.toml", pulse_case());
  const Outcome seen = run_in(folder, {"bench", pulse, "--method", "dop853", "--tolerances", "1e-5",
                                       "--repeat", "1", "--json"});
  EXPECT_EQ(seen.status, 0) << seen.out;
  EXPECT_EQ(seen.json().at("rows").at(0).at("status"), "ok");
  const Outcome library = run_in(folder, {"bench", pulse, "--method", "odeint-fehlberg78",
                                          "--tolerances", "1e-6", "--repeat", "1", "--json"});
  EXPECT_EQ(library.status, 0);
  EXPECT_EQ(library.json().at("rows").at(0).at("status"), "wrong");
  const Outcome series = run_in(folder, {"bench", pulse, "--method", "taylor", "--tolerances",
                                         "1e-10", "--repeat", "1", "--json"});
  EXPECT_EQ(series.status, 0) << series.out;
  EXPECT_EQ(series.json().at("rows").at(0).at("status"), "ok");
}

TEST(Bench, GrowthBeyondWhatDoublesTellIsNotSaidToBeSoMuchAtMost) {
  const Folder folder;
  folder.write("lorenz.toml",
               "[phase_space]\nvariables = [\"x\", \"y\", \"z\"]\n[equations]\nx = \"10*(y - x)\"\n"
               "y = \"28*x - y - x*z\"\nz = \"x*y - 8*z/3\"\n[[scene]]\nname = \"default\"\n"
               "initial = { x = \"1\", y = \"1\", z = \"1\" }\nduration = \"60\"\n");
  const auto text = [&](const char* duration) {
    return run_in(folder, {"bench", "lorenz.toml", "--duration", duration, "--method", "dop853",
                           "--tolerances", "1e-9", "--budget", "0.1"})
        .out;
  };
  EXPECT_NE(text("60").find("beyond what runs in double precision"), std::string::npos)
      << text("60");
  EXPECT_NE(text("5").find("times along the run at most"), std::string::npos) << text("5");
  EXPECT_TRUE(run_in(folder, {"bench", "lorenz.toml", "--method", "dop853", "--tolerances", "1e-9",
                              "--budget", "0.1", "--json"})
                  .json()
                  .at("conditioning")
                  .is_null());
}

TEST(Bench, ToleranceThatIsRefusedIsARow) {
  const auto json = run({"bench", "euler", "--method", "dop853,arkode-erk", "--tolerances",
                         "1e-9,1e-17", "--repeat", "1", "--json"})
                        .json();
  for (const char* method : {"dop853", "arkode-erk"}) {
    const auto rows = rows_of(json, method);
    EXPECT_EQ(rows.at(0).at("status"), "ok");
    EXPECT_EQ(rows.at(1).at("status"), "refused");
    EXPECT_NE(rows.at(1).at("reason").get<std::string>().find("1e-15"), std::string::npos);
    EXPECT_TRUE(rows.at(1).at("error").is_null());
  }
  EXPECT_EQ(json.at("failed"), 0);
}

TEST(Bench, SpecialisedCodeStandsBesideGeneralCodeOfMoreStates) {
  const auto json = run({"bench", "euler-e3", "--scene", "momentum", "--method", "dop853",
                         "--tolerances", "1e-6,1e-10", "--repeat", "3", "--json"})
                        .json();
  EXPECT_EQ(json.at("states").at("specialised"), (std::vector<std::string>{"M1", "M2", "M3"}));
  EXPECT_EQ(json.at("states").at("general").size(), 6U);
  EXPECT_LT(json.at("operations").at("specialised").at("mul"),
            json.at("operations").at("general").at("mul"));
  const auto general = rows_of(json, "dop853", "general");
  ASSERT_EQ(general.size(), 2U);
  // Its error is on the states that both have.
  EXPECT_LT(number(general.at(1).at("error")), 1e-7);
  bool compared = false;
  for (const auto& ratio : json.at("code_ratios"))
    compared = compared || ratio.at("general_over_specialised").is_number();
  EXPECT_TRUE(compared);
}

/// A compiler that has no Boost: refuses whatever includes it, as GCC words it.
std::string compiler_without_boost(const Folder& folder) {
  const std::string path = folder.write(
      "cxx",
      "#!/bin/sh\nfor word; do\n  case $word in *.cpp)\n    if grep -q '<boost/' \"$word\"; then\n"
      "      echo \"$word:1:10: fatal error: boost/x.hpp: No such file or directory\" >&2\n"
      "      exit 1\n    fi ;;\n  esac\ndone\nexec c++ \"$@\"\n");
  std::filesystem::permissions(path, std::filesystem::perms::owner_all);
  return path;
}

TEST(Bench, LibraryThatIsNotInstalledIsLeftOut) {
  const Folder tools;
  const Folder cache;
  const Environment environment{{"CXX", compiler_without_boost(tools)},
                                {"CASIMIR_CACHE", cache.path().string()}};
  const std::vector<std::string> usual{"bench",    "euler", "--tolerances", "1e-6",
                                       "--repeat", "1",     "--json"};
  const Outcome outcome = run(usual, {}, environment);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto json = outcome.json();
  EXPECT_TRUE(rows_of(json, "odeint-fehlberg78").empty());
  EXPECT_EQ(rows_of(json, "cvode-adams").size(), 1U);
  std::string notes;
  for (const auto& note : json.at("notes")) notes += note.get<std::string>() + '\n';
  EXPECT_NE(notes.find("odeint-fehlberg78 is left out: boost/x.hpp: No such file or directory"),
            std::string::npos)
      << notes;
  // Where nothing is left, the reason is the answer.
  const Outcome alone =
      run({"bench", "euler", "--method", "odeint-dopri5", "--repeat", "1"}, {}, environment);
  EXPECT_EQ(alone.status, 4);
  EXPECT_NE(alone.err.find("boost/x.hpp"), std::string::npos) << alone.err;
}

TEST(Bench, WithoutACompilerTheTablesRemain) {
  const Folder cache;
  const Environment environment{
      {"PATH", "/nonexistent"}, {"CXX", ""}, {"CASIMIR_CACHE", cache.path().string()}};
  const Outcome outcome =
      run({"bench", "euler", "--tolerances", "1e-9", "--repeat", "1", "--json"}, {}, environment);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  std::set<std::string> methods;
  const auto json = outcome.json();
  for (const auto& row : json.at("rows")) methods.insert(row.at("method"));
  EXPECT_EQ(methods, (std::set<std::string>{"taylor"}));
  EXPECT_GE(json.at("notes").size(), 9U);
  // Asked for by name, a method of our own that cannot be had is an error.
  EXPECT_EQ(run({"bench", "euler", "--method", "taylor,dop853"}, {}, environment).status, 4);
}

TEST(Bench, MotionWithoutAnEndHasNoReference) {
  const Folder folder;
  const std::string blowup = folder.write(
      "blowup.toml", equations_case("x = \"x^2\"", "initial = { x = \"1\" }\nduration = \"2\""));
  const Outcome outcome = run_in(folder, {"bench", blowup, "--repeat", "1"});
  EXPECT_EQ(outcome.status, 5);
  EXPECT_NE(outcome.err.find("singularity"), std::string::npos) << outcome.err;
}

TEST(Bench, SeveralCasesHaveASummary) {
  const Outcome outcome =
      run({"bench", "euler", "kovalevskaya", "--method", "taylor,odeint-fehlberg78", "--tolerances",
           "1e-3,1e-6,1e-9,1e-12", "--repeat", "3", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto json = outcome.json();
  ASSERT_EQ(json.at("cases").size(), 2U);
  EXPECT_EQ(json.at("cases").at(1).at("case"), "kovalevskaya");
  int seen = 0;
  for (const auto& mean : json.at("summary")) {
    if (mean.at("error") != 1e-6) continue;
    ++seen;
    double product = 1;
    for (const auto& one : json.at("cases"))
      for (const auto& ratio : one.at("ratios"))
        if (ratio.at("method") == "odeint-fehlberg78" && ratio.at("error") == 1e-6)
          product *= ratio.at("ratio").get<double>();
    EXPECT_EQ(mean.at("cases"), 2);
    EXPECT_NEAR(mean.at("geometric_mean").get<double>(), std::sqrt(product), 1e-9 * product);
    EXPECT_LE(mean.at("least"), mean.at("geometric_mean"));
  }
  EXPECT_EQ(seen, 1);
}

TEST(Bench, TablesForPeople) {
  const std::vector<std::string> usual{"bench",        "euler",
                                       "--method",     "taylor,odeint-fehlberg78",
                                       "--tolerances", "1e-3,1e-6,1e-9,1e-12",
                                       "--repeat",     "3"};
  const Outcome text = run(usual);
  EXPECT_NE(text.out.find("odeint-fehlberg78: taylor is "), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("reference: the case file, 30 digits, checked by"), std::string::npos);
  EXPECT_NE(text.out.find("one right-hand side, specialised"), std::string::npos);
  std::vector<std::string> markdown = usual;
  markdown.insert(markdown.end(), {"--format", "markdown"});
  const Outcome table = run(markdown);
  EXPECT_NE(table.out.find("| taylor | "), std::string::npos) << table.out;
  EXPECT_NE(table.out.find("Measured on "), std::string::npos);
}

TEST(Bench, UsageThatMakesNoSenseIsRefused) {
  EXPECT_EQ(run({"bench"}).status, 2);
  EXPECT_EQ(run({"bench", "euler", "--all"}).status, 2);
  EXPECT_EQ(run({"bench", "euler", "kovalevskaya", "--plot", "p.svg"}).status, 2);
  EXPECT_EQ(run({"bench", "euler", "--method", "dop854"}).status, 2);
  EXPECT_EQ(run({"bench", "euler", "--tolerances", "-1"}).status, 2);
  EXPECT_EQ(run({"bench", "euler", "--budget", "0"}).status, 2);
  EXPECT_EQ(run({"bench", "euler", "--rtol", "1e-6"}).status, 2);
  const auto one = run({"bench", "euler", "--method", "taylor", "--tolerance", "1e-6", "--json"});
  EXPECT_EQ(one.json().at("rows").size(), 1U);
}

TEST(Bench, TimeLimitAndCtrlCEndIt) {
  const std::vector<std::string> endless{"bench", "euler", "--repeat", "1000000"};
  std::vector<std::string> limited = endless;
  limited.insert(limited.end(), {"--time-limit", "1"});
  EXPECT_EQ(run(limited).status, 4);
  const Folder folder;
  const pid_t child = start(endless, folder);
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  const auto begin = std::chrono::steady_clock::now();
  kill(child, SIGINT);
  EXPECT_EQ(finish(child, folder).status, 130);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(1));
}

}  // namespace
}  // namespace casimir::test
