// casimir sweep: grids, the same numbers as single runs, kills, MPI and HDF5.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "tests/tools/commands/sweep_arguments.hpp"
#include "tests/tools/program.hpp"

namespace casimir::test {
namespace {

std::vector<std::vector<std::string>> table_rows(const std::string& csv) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream stream(csv);
  for (std::string line; std::getline(stream, line);) {
    std::vector<std::string> fields(1);
    for (const char c : line) {
      if (c == ',')
        fields.emplace_back();
      else
        fields.back() += c;
    }
    rows.push_back(fields);
  }
  return rows;
}

TEST(Sweep, GivesTheNumbersOfAnEnsemble) {
  const Folder folder;
  ASSERT_EQ(run_in(folder, {"sweep", "kovalevskaya", "--over", "r=1/2:3/2:3", "--over", "M1=-1:1:3",
                            "--duration", "20", "--output", "s.csv", "--quiet"})
                .status,
            0);
  folder.write("members.csv", "r,M1\n0.5,-1\n0.5,0\n0.5,1\n1,-1\n1,0\n1,1\n1.5,-1\n1.5,0\n1.5,1\n");
  ASSERT_EQ(run_in(folder, {"integrate", "kovalevskaya", "--ensemble", "members.csv", "--duration",
                            "20", "--output", "e.csv", "--quiet"})
                .status,
            0);
  const auto swept = table_rows(file_text(folder.path() / "s.csv"));
  const auto members = table_rows(file_text(folder.path() / "e.csv"));
  ASSERT_EQ(swept.size(), 10U);
  ASSERT_EQ(members.size(), 10U);
  EXPECT_EQ(swept[0][0] + swept[0][1] + swept[0][2] + swept[0][3], "pointrM1(0)status");
  for (std::size_t i = 0; i < swept.size(); ++i) {
    ASSERT_EQ(swept[i].size(), members[i].size() + 2);
    for (std::size_t k = 1; k < members[i].size(); ++k)
      EXPECT_EQ(swept[i][k + 2], members[i][k]) << i << ' ' << k;
  }
}

constexpr const char* kLine =
    "[phase_space]\nvariables = [\"x\", \"v\"]\n[parameters]\na = {}\n"
    "[equations]\nx = \"v\"\nv = \"a*x\"\n"
    "[[scene]]\nname = \"default\"\nparameters = { a = \"-1\" }\n"
    "initial = { x = \"1\", v = \"0\" }\nduration = \"20\"\n";

/// The absolute tolerance of the scene would be all of the small ones: x = x(0) cos(t).
TEST(Sweep, SmallPointsHaveAllTheirDigits) {
  const Folder folder;
  folder.write("line.toml", kLine);
  const Outcome swept = run_in(
      folder, {"sweep", "line.toml", "--over", "x=1,1e-10,1e-15,1e-40", "--output", "s.csv"});
  ASSERT_EQ(swept.status, 0) << swept.err;
  const auto rows = table_rows(file_text(folder.path() / "s.csv"));
  ASSERT_EQ(rows.size(), 5U);
  for (std::size_t i = 1; i < rows.size(); ++i)
    EXPECT_NEAR(std::stod(rows[i][4]) / std::stod(rows[i][1]), std::cos(20), 1e-7) << rows[i][1];
}

constexpr const char* kPulseFromRest =
    "[phase_space]\nvariables = [\"y\", \"q\", \"p\"]\n[parameters]\nc = {}\n"
    "[equations]\ny = \"1000*p*exp(-(1000*(q - c))^2)\"\nq = \"p\"\np = \"-q\"\n"
    "[[scene]]\nname = \"default\"\nparameters = { c = \"1/3\" }\n"
    "initial = { y = \"0\", q = \"1\", p = \"0\" }\nduration = \"2\"\n";

/// A point begins at rest, and a first step that is long puts its beginning, a third of it and its
/// end about as far from the pulse as each other: the integral over the pulse is -sqrt(Pi).
TEST(Sweep, NoPointPassesAPulseOver) {
  const Folder folder;
  folder.write("pulse.toml", kPulseFromRest);
  const Outcome swept = run_in(
      folder, {"sweep", "pulse.toml", "--over", "c=-1/3:9/10:75", "--output", "s.csv", "--json"});
  ASSERT_EQ(swept.status, 0) << swept.err;
  EXPECT_TRUE(swept.json().at("warnings").empty());
  const auto rows = table_rows(file_text(folder.path() / "s.csv"));
  ASSERT_EQ(rows.size(), 76U);
  for (std::size_t i = 1; i < rows.size(); ++i)
    EXPECT_NEAR(std::stod(rows[i][4]), -std::sqrt(std::acos(-1)), 1e-9) << rows[i][1];
}

TEST(Sweep, StepsOfOneSizeArePointedOutWhereTheyMayPassSomethingOver) {
  const Folder folder;
  folder.write("pulse.toml", kPulseFromRest);
  folder.write("line.toml", kLine);
  const auto warnings = [&](const char* file, const char* over, const char* method) {
    const Outcome swept = run_in(folder, {"sweep", file, "--over", over, "--method", method,
                                          "--step", "0.05", "--output", "s.csv", "--json"});
    return swept.json().at("warnings").dump();
  };
  EXPECT_NE(warnings("pulse.toml", "c=0:1/2:5", "dop853").find("constant step"), std::string::npos);
  EXPECT_EQ(warnings("line.toml", "x=1:2:5", "dop853").find("constant step"), std::string::npos);
}

/// Points have no estimate each: what is doubtful shows where some are integrated again.
TEST(Sweep, WhatRoundingDecidesIsAWarning) {
  const Folder folder;
  folder.write("line.toml", kLine);
  const auto warnings = [&](const std::string& duration) {
    const Outcome swept =
        run_in(folder, {"sweep", "line.toml", "--param", "a=1", "--over", "x=1,2", "--let", "v=-x",
                        "--duration", duration, "--output", "s.csv", "--restart", "--json"});
    EXPECT_EQ(swept.status, 0) << swept.err;
    return swept.json().at("warnings");
  };
  const auto grown = warnings("50");
  ASSERT_EQ(grown.size(), 2U) << grown;
  EXPECT_NE(grown[1].get<std::string>().find("point 2: "), std::string::npos) << grown;
  EXPECT_TRUE(warnings("2").empty());
}

// Of the motion near the saddle of x'' = a x: the exponent is the root of a.
TEST(Sweep, ExponentsAreThoseOfALinearSaddle) {
  const Folder folder;
  const std::string file = folder.write(
      "saddle.toml",
      "title = \"saddle\"\nhamiltonian = \"(p^2 - a*x^2)/2\"\n[phase_space]\nvariables = [\"x\", "
      "\"p\"]\ncanonical = true\n[parameters]\na = {}\n[[scene]]\nname = \"default\"\nparameters = "
      "{ a = \"1\" }\ninitial = { x = \"0\", p = \"0\" }\nduration = \"2000\"\n");
  for (const char* jobs : {"1", "3"})
    ASSERT_EQ(
        run_in(folder, {"sweep", file, "--over", "a=-1,1/4,1,9/4", "--do", "exponents", "--output",
                        std::string("e") + jobs + ".csv", "--jobs", jobs, "--quiet"})
            .status,
        0);
  EXPECT_EQ(file_text(folder.path() / "e1.csv"), file_text(folder.path() / "e3.csv"));
  const auto rows = table_rows(file_text(folder.path() / "e1.csv"));
  ASSERT_EQ(rows.size(), 5U);
  ASSERT_EQ(rows[0][4], "exponent");
  EXPECT_NEAR(std::stod(rows[1][4]), 0, 1e-3);
  for (std::size_t i = 2; i < 5; ++i)
    EXPECT_NEAR(std::stod(rows[i][4]), std::sqrt(std::stod(rows[i][1])), 1e-3);
}

TEST(Sweep, SectionsCountChaoticOrbits) {
  const Folder folder;
  const std::string file = folder.write(
      "hh.toml",
      "title = \"Henon-Heiles\"\nhamiltonian = \"(px^2 + py^2 + x^2 + y^2)/2 + x^2*y + c*y^3/3\"\n"
      "[phase_space]\nvariables = [\"x\", \"y\", \"px\", \"py\"]\ncanonical = true\n"
      "[parameters]\nc = {}\n[section]\nfunction = \"x\"\nplot = [\"y\", \"py\"]\n[[scene]]\n"
      "name = \"default\"\nparameters = { c = \"-1\" }\ninitial = { x = \"0\", y = \"0\", px = "
      "\"1/2\", py = \"0\" }\nduration = \"100\"\n");
  // H = px^2/2: regular below 1/12 or so, a sea of chaos at 1/6.
  const Outcome outcome =
      run_in(folder, {"sweep", file, "--over", "px=1/5,14/25", "--do", "section", "--orbits", "12",
                      "--points", "200", "--output", "s.csv", "--quiet"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto rows = table_rows(file_text(folder.path() / "s.csv"));
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0][3], "orbits");
  EXPECT_EQ(rows[1][3] + " " + rows[1][4], "12 2400");
  EXPECT_EQ(rows[1][6], "0");  // chaotic
  EXPECT_GE(std::stod(rows[2][6]), 3);
  EXPECT_GT(std::stod(rows[2][7]), 0.05);   // exponent
  EXPECT_LT(std::stod(rows[2][8]), 1e-10);  // off the level
}

TEST(Sweep, GridValuesAreTheNearestToTheExactOnes) {
  const Folder folder;
  ASSERT_EQ(run_in(folder, {"sweep", "kovalevskaya", "--over", "r=1/10:7/10:7", "--duration", "1/8",
                            "--output", "s.csv", "--quiet"})
                .status,
            0);
  const auto rows = table_rows(file_text(folder.path() / "s.csv"));
  ASSERT_EQ(rows.size(), 8U);
  const double exact[] = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7};
  for (std::size_t i = 0; i < 7; ++i) EXPECT_EQ(std::stod(rows[i + 1][1]), exact[i]);
}

TEST(Sweep, LetsAnInitialStateFollowAnAngle) {
  const Folder folder;
  const std::vector<std::string> arguments{
      "sweep",    "kovalevskaya", "--over", "theta=0:Pi:5",  "--let",      "g1=sin(theta)",
      "--let",    "g2=0",         "--let",  "g3=cos(theta)", "--duration", "5",
      "--output", "s.csv",        "--quiet"};
  ASSERT_EQ(run_in(folder, arguments).status, 0);
  EXPECT_EQ(table_rows(file_text(folder.path() / "s.csv")).size(), 6U);
  // Without it the constraint of the case is left, and that is said.
  const Outcome off = run_in(folder, {"sweep", "kovalevskaya", "--over", "g1=0:1:3"});
  EXPECT_EQ(off.status, 2);
  EXPECT_NE(off.err.find("at g1 = 0"), std::string::npos) << off.err;
  EXPECT_NE(off.err.find("g1=sin(theta)"), std::string::npos) << off.err;
  const Outcome zero = run_in(folder, {"sweep", "kovalevskaya", "--over", "r=-1:1:3"});
  EXPECT_EQ(zero.status, 2);
  EXPECT_NE(zero.err.find("r != 0"), std::string::npos) << zero.err;
}

TEST(Sweep, SaysWhatIsWrongWithAGrid) {
  const Folder folder;
  const auto error = [&](const std::vector<std::string>& options) {
    std::vector<std::string> arguments{"sweep", "clebsch"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Outcome outcome = run_in(folder, arguments);
    EXPECT_EQ(outcome.status, 2) << outcome.err;
    return outcome.err;
  };
  EXPECT_NE(error({}).find("--over"), std::string::npos);
  EXPECT_NE(error({"--over", "a4=1:2:3"}).find("did you mean"), std::string::npos);
  EXPECT_NE(error({"--over", "a1=1:2"}).find("FROM:TO:N"), std::string::npos);
  EXPECT_NE(error({"--over", "a1=1:2:0"}).find("--over:1:8"), std::string::npos);
  EXPECT_NE(error({"--over", "a1=1:two:3"}).find("--over:1:6"), std::string::npos);
  EXPECT_NE(error({"--over", "a1=1:2:1"}).find("at least 2"), std::string::npos);
  EXPECT_NE(error({"--over", "a1=1:2:3", "--over", "a1=1:2:3"}).find("two 'a1'"),
            std::string::npos);
  EXPECT_NE(error({"--over", "a1=1:2:3", "--param", "a1=1"}).find("--param"), std::string::npos);
  EXPECT_NE(error({"--over", "a1=1:2:99999999"}).find("more than"), std::string::npos);
  EXPECT_NE(error({"--over", "a1=1:2:3", "--output", "x.txt"}).find(".csv"), std::string::npos);
  EXPECT_EQ(folder.files(), 0U);
}

TEST(Sweep, DoubtsWhatChangesAndIsNoIntegral) {
  const Folder folder;
  folder.write("a.toml", R"toml(
hamiltonian = "(p^2 + q^2)/2"
[phase_space]
variables = ["q", "p"]
canonical = true
[integrals]
F = "p^2"
G = "(p^2 + q^2)^2"
[[scene]]
name = "default"
initial = { q = "1", p = "0" }
duration = "10"
)toml");
  const Outcome outcome =
      run_in(folder, {"sweep", "./a.toml", "--over", "q=1/2:1:3", "--json", "--output", "s.csv"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const std::string warnings = outcome.json().at("warnings").dump();
  EXPECT_NE(warnings.find("F changes by 1.0e+00 of its size, and it is refuted"), std::string::npos)
      << warnings;
  EXPECT_EQ(warnings.find("G changes"), std::string::npos) << warnings;
}

TEST(Sweep, PointsThatCannotBeIntegratedAreToldAndTheRestIsThere) {
  const Folder folder;
  const Outcome outcome = run_in(folder, {"sweep", "riccati", "--scene", "pole", "--over",
                                          "sigma=-1:1:3", "--duration", "1", "--output", "s.csv"});
  EXPECT_EQ(outcome.status, 5) << outcome.err;
  EXPECT_NE(outcome.err.find("sigma(0) = 1"), std::string::npos) << outcome.err;
  EXPECT_EQ(table_rows(file_text(folder.path() / "s.csv")).size(), 4U);
}

/// The colours of the cells of an SVG whose cells are drawn one by one, in their order: a row after
/// the other from below.
std::vector<std::string> cell_colours(const std::string& svg, std::size_t cells) {
  std::vector<std::string> colours;
  const std::string before = "<polygon fill = '";
  for (std::size_t at = svg.find(before); at != std::string::npos && colours.size() < cells;
       at = svg.find(before, at + 1)) {
    const std::size_t from = at + before.size();
    colours.push_back(svg.substr(from, svg.find('\'', from) - from));
  }
  return colours;
}

/// x(1/10) = x(0) cos(sqrt(-a)/10) grows with both axes.
TEST(Sweep, AMapHasAColourForEachPointOfTwoAxes) {
  const Folder folder;
  folder.write("line.toml", kLine);
  const std::vector<std::string> sweep = {"sweep",      "line.toml", "--over",   "x=4,1,2",
                                          "--over",     "a=-5,-1",   "--output", "s.csv",
                                          "--duration", "1/10",      "--json"};
  std::vector<std::string> drawn = sweep;
  drawn.insert(drawn.end(), {"--plot", "map.svg", "--colour", "x"});
  const Outcome outcome = run_in(folder, drawn);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.json().at("plot"), "map.svg");
  const std::string svg = file_text(folder.path() / "map.svg");
  const std::vector<std::string> colours = cell_colours(svg, 6);
  ASSERT_EQ(colours.size(), 6U);
  EXPECT_EQ(colours.front(), "rgb( 68,   1,  84)") << "x = 1, a = -5: the least";
  EXPECT_EQ(colours.back(), "rgb(253, 231,  37)") << "x = 4, a = -1: the largest";
  EXPECT_NE(svg.find("x(0)"), std::string::npos);
  EXPECT_NE(svg.find("3 by 2 points"), std::string::npos);
  EXPECT_FALSE(run_in(folder, sweep).json().contains("plot"));
}

TEST(Sweep, PointsOfAMapThatEndedEarlyAreWhiteAndCounted) {
  const Folder folder;
  const Outcome outcome = run_in(
      folder, {"sweep", "riccati", "--scene", "pole", "--over", "sigma=-1,0,2", "--over", "w1=1,2",
               "--duration", "1", "--output", "s.csv", "--plot", "map.svg", "--colour", "steps"});
  EXPECT_EQ(outcome.status, 5) << outcome.err;
  const auto rows = table_rows(file_text(folder.path() / "s.csv"));
  std::size_t ended = 0;
  for (std::size_t i = 1; i < rows.size(); ++i) ended += rows[i][3] == "ok" ? 0 : 1;
  ASSERT_GT(ended, 0U);
  EXPECT_NE(file_text(folder.path() / "map.svg")
                .find(std::to_string(ended) + " not done to the end are white"),
            std::string::npos);
}

TEST(Sweep, WhatIsNoMapIsRefusedBeforeItIsDone) {
  const Folder folder;
  folder.write("line.toml", kLine);
  const std::vector<std::pair<std::vector<std::string>, std::string>> refused = {
      {{"--over", "x=1,2", "--plot", "m.svg", "--colour", "x"}, "two axes, and this sweep has 1"},
      {{"--over", "x=1,2", "--over", "a=-1", "--plot", "m.svg", "--colour", "x"},
       "a has one twice"},
      {{"--over", "x=1,2", "--over", "a=-1,-1", "--plot", "m.svg", "--colour", "x"}, "a has one"},
      {{"--over", "x=1,2", "--over", "a=-1,-2", "--plot", "m.svg"},
       "--colour COLUMN, one of: t, x, v"},
      {{"--over", "x=1,2", "--over", "a=-1,-2", "--plot", "m.svg", "--colour", "stpes"}, "'steps'"},
      {{"--over", "x=1,2", "--over", "a=-1,-2", "--plot", "m.txt", "--colour", "x"},
       ".svg, .png, .pdf or .tex"},
      {{"--over", "x=1,2", "--over", "a=-1,-2", "--colour", "x"}, "goes with --plot"},
      {{"--over", "x=1,2", "--over", "a=-1,-2", "--monochrome"}, "are of a picture"},
      {{"--over", "x=1:2:300", "--over", "a=-1,-2,-4", "--over", "v=0:1:50", "--plot", "m.svg"},
       "has 3"}};
  for (const auto& [options, words] : refused) {
    std::vector<std::string> arguments = {"sweep", "line.toml", "--output", "s.csv"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Outcome outcome = run_in(folder, arguments);
    EXPECT_EQ(outcome.status, 2) << words;
    EXPECT_NE(outcome.err.find(words), std::string::npos) << outcome.err;
  }
  EXPECT_EQ(folder.files(), 1U) << "the case";
}

int run_mpi(const Folder& folder, const std::vector<std::string>& arguments) {
  std::string command = "cd '" + folder.path().string() + "' && '" + CASIMIR_MPIEXEC +
                        "' --allow-run-as-root --oversubscribe -n 2 '" + CASIMIR_PROGRAM + "'";
  for (const std::string& argument : arguments) command += " '" + argument + "'";
  const int status = std::system((command + " > out.txt 2> err.txt").c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(Sweep, OnTwoMpiRanksIsTheSameToTheBit) {
  const Folder folder;
  if (std::string(CASIMIR_MPIEXEC).empty()) {
    // Without MPI each process would do the whole sweep, and all write the same file.
    const Outcome outcome =
        run_in(folder, sweep_arguments("3", "one.csv"), "", {{"OMPI_COMM_WORLD_SIZE", "2"}});
    EXPECT_EQ(outcome.status, 4);
    EXPECT_NE(outcome.err.find("built without MPI"), std::string::npos) << outcome.err;
    return;
  }
  ASSERT_EQ(run_in(folder, sweep_arguments("40", "one.csv")).status, 0);
  std::vector<std::string> arguments = sweep_arguments("40", "two.csv");
  arguments.back() = "--json";
  ASSERT_EQ(run_mpi(folder, arguments), 0) << file_text(folder.path() / "err.txt");
  const auto json = nlohmann::ordered_json::parse(file_text(folder.path() / "out.txt"));
  EXPECT_EQ(json.at("ranks"), 2);
  EXPECT_EQ(json.at("points"), 280);
  const std::string one = file_text(folder.path() / "one.csv");
  EXPECT_EQ(std::count(one.begin(), one.end(), '\n'), 281);
  EXPECT_TRUE(one == file_text(folder.path() / "two.csv"));
  // What is wrong is said once.
  EXPECT_EQ(run_mpi(folder, {"sweep", "clebsch", "--over", "nothing=1:2:3"}), 2);
  const std::string error = file_text(folder.path() / "err.txt");
  const std::size_t at = error.find("there is no parameter");
  ASSERT_NE(at, std::string::npos) << error;
  EXPECT_EQ(error.find("there is no parameter", at + 1), std::string::npos) << error;
}

/// What was written with a parameter has values where that is computed: a*x/a is x, and at a = 0
/// nothing.
TEST(Sweep, ParametersForWhichACaseHasNoValuesAreRefused) {
  for (const auto& [rate, values, said] :
       std::vector<std::array<std::string, 3>>{{"sign(a*x) + x", "-1,0,1", "a != 0"},
                                               {"a*x/a", "-1,0,1", "a != 0"},
                                               {"sqrt(a)^2*x", "-1,1", "a >= 0"},
                                               {"x + log(a)*0", "0,1", "a > 0"}}) {
    const Folder folder;
    folder.write("w.toml",
                 "[phase_space]\nvariables = [\"x\", \"y\"]\n[parameters]\na = {}\n"
                 "[equations]\nx = \"1\"\ny = \"" +
                     rate +
                     "\"\n[[scene]]\nname = \"default\"\nparameters = { a = \"1\" }\n"
                     "initial = { x = \"1\", y = \"0\" }\nduration = 1\n");
    const Outcome swept = run_in(folder, {"sweep", "./w.toml", "--over", "a=" + values, "--json"});
    EXPECT_EQ(swept.status, 2) << rate;
    EXPECT_TRUE(has(swept.err, said)) << rate << swept.err;
    folder.write("m.csv", "a\n" + values.substr(0, values.find(',')) + "\n");
    folder.write("good.csv", "a\n1\n2\n");
    EXPECT_EQ(run_in(folder, {"integrate", "./w.toml", "--ensemble", "good.csv"}).status, 0)
        << rate;
    if (rate.starts_with("a") || rate.starts_with("sign")) continue;  // -1 is no bad one
    EXPECT_EQ(run_in(folder, {"integrate", "./w.toml", "--ensemble", "m.csv"}).status, 2) << rate;
  }
}

TEST(Sweep, AsHdf5HasArraysOfTheGridsShape) {
  const Folder folder;
  const Outcome outcome = run_in(folder, sweep_arguments("3", "s.h5"));
  if (std::string(CASIMIR_H5DUMP).empty()) {
    EXPECT_EQ(outcome.status, 4);
    EXPECT_NE(outcome.err.find("HDF5"), std::string::npos) << outcome.err;
    return;
  }
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  ASSERT_EQ(run_in(folder, sweep_arguments("3", "s.csv")).status, 0);
  const std::string command = std::string("'") + CASIMIR_H5DUMP + "' -y -w 1 -m %.17g -d /g1 '" +
                              folder / "s.h5" + "' > '" + folder / "dump" + "'";
  ASSERT_EQ(std::system(command.c_str()), 0);
  const std::string dump = file_text(folder.path() / "dump");
  EXPECT_NE(dump.find("( 3, 7 ) / ( 3, 7 )"), std::string::npos) << dump;
  const auto rows = table_rows(file_text(folder.path() / "s.csv"));
  const auto column =
      static_cast<std::size_t>(std::find(rows[0].begin(), rows[0].end(), "g1") - rows[0].begin());
  std::istringstream data(dump.substr(dump.find("DATA {") + 6));
  for (std::size_t i = 1; i < rows.size(); ++i) {
    std::string number;
    data >> number;
    EXPECT_EQ(std::stod(number), std::stod(rows[i][column])) << i;
  }
}

}  // namespace
}  // namespace casimir::test
