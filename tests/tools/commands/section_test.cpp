// casimir section: other systems than those of the book's figures, files, and what is refused.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <sstream>

#include "tests/tools/program.hpp"

namespace casimir::test {
namespace {

using Json = nlohmann::ordered_json;

const double kPi = std::acos(-1.);

double field(const Json& object, const char* name) {
  return std::stod(object.at(name).get<std::string>());
}

const char* const kHenonHeiles = R"toml(
title = "Henon and Heiles"
hamiltonian = "(px^2 + py^2 + x^2 + y^2)/2 + x^2*y - y^3/3"
[phase_space]
variables = ["x", "y", "px", "py"]
canonical = true
[section]
function = "x"
plot = ["y", "py"]
[[scene]]
name = "default"
initial = { x = "0", y = "1/10", px = "1/2", py = "0" }
duration = "1"
)toml";

const char* const kSphericalPendulum = R"toml(
title = "Spherical pendulum"
hamiltonian = "(p_th^2 + p_ph^2/sin(th)^2)/2 + cos(th)"
[phase_space]
variables = ["th", "ph", "p_th", "p_ph"]
canonical = true
[integrals]
P = "p_ph"
[[scene]]
name = "default"
initial = { th = "2", ph = "0", p_th = "1/2", p_ph = "1/2" }
duration = "1"
)toml";

Outcome section_of(const char* toml, std::vector<std::string> options) {
  const Folder folder;
  folder.write("case.toml", toml);
  options.insert(options.begin(), {"section", "./case.toml"});
  return run_in(folder, options);
}

TEST(Section, HenonAndHeiles) {
  const Outcome outcome = section_of(kHenonHeiles, {"--energy", "1/12", "--orbits", "25",
                                                    "--points", "60", "--fixed-points", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const Json result = outcome.json();
  EXPECT_EQ(result.at("orbits").size(), 25U);
  EXPECT_LT(field(result, "off_level"), 1e-10);
  for (const Json& orbit : result.at("orbits"))
    for (const Json& point : orbit.at("crossings")) {
      const double y = field(point, "u"), py = field(point, "v");
      EXPECT_LE(py * py / 2 + y * y / 2 - y * y * y / 3, 1. / 12 + 1e-10);  // px^2 >= 0
    }
  // The four fixed points of this section at 1/12: three stable, one not, the latter and one
  // stable one on py = 0, the other two mirror images.
  const Json& cycles = result.at("cycles");
  ASSERT_GE(cycles.size(), 4U);
  int stable = 0;
  for (const Json& cycle : cycles) stable += cycle.at("stable") ? 1 : 0;
  EXPECT_GE(stable, 3);
}

/// The fixed points of Fig. 1.5 of the book, with the periods and traces that CAPD encloses.
TEST(Section, TheFixedPointsOfTheHeavyTopAreProved) {
  const Outcome outcome = run({"section", "euler-poisson", "--scene", "chaotic", "--orbits", "8",
                               "--points", "50", "--fixed-points", "--validated", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const std::map<std::string, std::pair<double, double>> known = {
      {"3.8550", {3.85504982, 6.530}},
      {"5.2186", {5.21863364, 11.795}},
      {"3.8563", {3.85632298, -2.01298}},
      {"4.9540", {4.95405306, -1.97774}}};
  const Json result = outcome.json();
  std::size_t proved = 0;
  for (const Json& cycle : result.at("cycles")) {
    const Json& validated = cycle.at("validated");
    ASSERT_EQ(validated.at("verdict"), "proved") << validated;
    const std::string low = validated.at("period").at(0), high = validated.at("period").at(1);
    const auto found = known.find(low.substr(0, 6));
    ASSERT_NE(found, known.end()) << low;
    EXPECT_NEAR(std::stod(low), found->second.first, 1e-8);
    EXPECT_NEAR(std::stod(high), found->second.first, 1e-8);
    EXPECT_NEAR(std::stod(validated.at("trace").at(0).get<std::string>()), found->second.second,
                1e-3);
    ++proved;
  }
  EXPECT_GE(proved, 4U);
  EXPECT_EQ(run({"section", "euler-poisson", "--validated", "--points", "3"}).status, 2);
}

TEST(Section, TheOtherDirectionIsTheMirrorImage) {
  // x -> -x, t -> t: orbits that cross downwards are mirror images of those upwards.
  const Folder folder;
  folder.write("case.toml", kHenonHeiles);
  folder.write("up.csv", "x,y,px,py\n0,0.1,0.4,0.1\n");
  folder.write("down.csv", "x,y,px,py\n0,0.1,-0.4,0.1\n");
  const std::vector<std::string> rest{"--energy", "0.08966666666666666666", "--points", "30",
                                      "--json"};
  std::vector<std::string> up{"section", "./case.toml", "--seeds", "up.csv"},
      down{"section", "./case.toml", "--seeds", "down.csv", "--direction", "down"};
  for (const std::string& word : rest) {
    up.push_back(word);
    down.push_back(word);
  }
  const Outcome first = run_in(folder, up), second = run_in(folder, down);
  ASSERT_EQ(first.status, 0) << first.err;
  ASSERT_EQ(second.status, 0) << second.err;
  const Json a = first.json().at("orbits")[0].at("crossings"),
             b = second.json().at("orbits")[0].at("crossings");
  ASSERT_EQ(a.size(), 30U);
  for (std::size_t n = 0; n < 30; ++n) {
    EXPECT_NEAR(field(a[n], "u"), field(b[n], "u"), 1e-9);
    EXPECT_NEAR(field(a[n], "v"), field(b[n], "v"), 1e-9);
  }
}

TEST(Section, AnAngleIsAPlaneAtEveryTurnAndPlottedOverOne) {
  const Outcome turns = section_of(
      kSphericalPendulum,
      {"--plane", "ph = 1", "--pair", "th", "p_th", "--orbits", "5", "--points", "40", "--json"});
  ASSERT_EQ(turns.status, 0) << turns.err;
  const Json every = turns.json();
  for (const Json& orbit : every.at("orbits")) EXPECT_EQ(orbit.at("points"), 40);
  const Outcome plotted = section_of(
      kSphericalPendulum,
      {"--plane", "p_th", "--pair", "ph", "th", "--orbits", "5", "--points", "40", "--json"});
  ASSERT_EQ(plotted.status, 0) << plotted.err;
  const Json round = plotted.json();
  for (const Json& orbit : round.at("orbits"))
    for (const Json& point : orbit.at("crossings")) {
      EXPECT_GE(field(point, "u"), 0);
      EXPECT_LT(field(point, "u"), 2 * kPi);
    }
}

/// Eight crossings say nothing of Kovalevskaya's top, which is integrable.
TEST(Section, APictureCallsNothingChaoticThatIsTooShortToTell) {
  const Folder folder;
  const Outcome outcome = run_in(
      folder, {"section", "kovalevskaya", "--points", "8", "--orbits", "4", "--output", "k.svg"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const std::string picture = file_text(folder.path() / "k.svg");
  EXPECT_EQ(picture.find("chaotic orbits"), std::string::npos);
  EXPECT_NE(picture.find("not known"), std::string::npos);
}

TEST(Section, WhatItWritesCanBeItsSeeds) {
  const Folder folder;
  folder.write("case.toml", kHenonHeiles);
  const std::vector<std::string> first{"section",  "./case.toml", "--energy", "1/10",
                                       "--orbits", "3",           "--points", "5",
                                       "--output", "a.csv",       "--quiet"};
  ASSERT_EQ(run_in(folder, first).status, 0);
  const std::string table = file_text(folder.path() / "a.csv");
  EXPECT_EQ(table.substr(0, table.find('\n')), "orbit,n,t,u,v,x,y,px,py");
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 16);
  const Outcome again = run_in(folder, {"section", "./case.toml", "--energy", "1/10", "--seeds",
                                        "a.csv", "--points", "2", "--json"});
  ASSERT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(again.json().at("orbits").size(), 15U);
}

TEST(Section, LevelsWithoutMotionAreRefused) {
  const Outcome low = section_of(kHenonHeiles, {"--energy", "-1/10", "--orbits", "5"});
  EXPECT_EQ(low.status, 2);
  const Outcome top =
      run({"section", "kovalevskaya", "--energy", "-5", "--plane", "g3", "--pair", "g1", "g2"});
  EXPECT_EQ(top.status, 2);
  EXPECT_NE(top.err.find("no motion with H = -5"), std::string::npos) << top.err;
  EXPECT_NE(top.err.find("begin at"), std::string::npos) << top.err;
}

// Far from the scene, where no random point of its size is on the level.
TEST(Section, LevelsFarFromTheSceneAreFound) {
  for (const char* energy : {"10000", "749999.4"}) {
    const Outcome far = run({"section", "kovalevskaya", "--energy", energy, "--casimir", "F2=0",
                             "--orbits", "2", "--points", "5", "--json"});
    ASSERT_EQ(far.status, 0) << far.err;
    EXPECT_EQ(far.json().at("orbits").size(), 2U);
  }
}

// What is constant for the values of a scene is left out of the programs: what stands behind it
// may not take its place.
TEST(Section, FunctionsThatAreConstantHaveNoPlace) {
  const char* const kDead = R"toml(
hamiltonian = "(M1^2 + M2^2 + 2*M3^2)/2 - g1"
[phase_space]
variables = ["M1", "M2", "M3", "g1", "g2", "g3"]
algebra = "e(3)"
[parameters]
k = {}
[casimirs]
Z = "k*(g1^2 + g2^2 + g3^2)"
F1 = "g1^2 + g2^2 + g3^2"
F2 = "M1*g1 + M2*g2 + M3*g3"
[section]
function = "M3"
plot = ["g1", "M2"]
[[scene]]
name = "default"
parameters = { k = "0" }
initial = { M1 = "1", M2 = "1/2", M3 = "1/3", g1 = "3/5", g2 = "0", g3 = "4/5" }
duration = "100"
)toml";
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.end(), {"--orbits", "2", "--points", "2", "--json"});
    return section_of(kDead, more);
  };
  const Outcome half = with({"--casimir", "F1=1/2"});
  ASSERT_EQ(half.status, 0) << half.err;
  EXPECT_EQ(field(half.json().at("level"), "F1"), 0.5);
  const Outcome last = with({"--casimir", "F2=1/10"});
  ASSERT_EQ(last.status, 0) << last.err;
  EXPECT_EQ(field(last.json().at("level"), "F2"), 0.1);
  EXPECT_EQ(field(last.json().at("level"), "F1"), 1);
  const Outcome dead = with({"--casimir", "Z=3"});
  EXPECT_EQ(dead.status, 2);
  EXPECT_NE(dead.err.find("'Z' is a constant for the parameters of the scene"), std::string::npos)
      << dead.err;
  for (const char* constant : {"k*g1", "7/2"}) {
    const Outcome flat = with({"--pair", constant, "M2"});
    EXPECT_EQ(flat.status, 2);
    EXPECT_NE(flat.err.find("is the same everywhere in phase space"), std::string::npos)
        << flat.err;
  }
}

TEST(Section, CrossingsWithoutAPlaceInThePictureAreCounted) {
  const Outcome outcome = section_of(kHenonHeiles, {"--energy", "1/12", "--orbits", "2", "--points",
                                                    "20", "--pair", "sqrt(y)", "py", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const std::string warnings = outcome.json().at("warnings").dump();
  EXPECT_NE(warnings.find("of 40 crossings the plotted functions have no value"), std::string::npos)
      << warnings;
}

TEST(Section, APairWithoutAnyValueIsNoPlaneThatIsNotCrossed) {
  const Outcome outcome = section_of(kHenonHeiles, {"--energy", "1/12", "--orbits", "2", "--points",
                                                    "20", "--pair", "sqrt(-1 - y^2)", "py"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_TRUE(has(outcome.err, "functions sqrt(-1 - y^2) and py have no values")) << outcome.err;
  EXPECT_FALSE(has(outcome.err, "no motion")) << outcome.err;
}

TEST(Section, SystemsWithoutASectionAreRefused) {
  const auto refused = [](const std::vector<std::string>& command, const std::string& text) {
    const Outcome outcome = run(command);
    EXPECT_EQ(outcome.status, 2) << outcome.err;
    EXPECT_NE(outcome.err.find(text), std::string::npos) << outcome.err;
  };
  refused({"section", "euler", "--plane", "M1", "--pair", "M2", "M3"}, "one degree of freedom");
  refused({"section", "van-der-pol", "--plane", "x", "--pair", "x", "y"}, "Hamiltonian");
  refused({"section", "neumann-sphere"}, "no [section]");
  refused({"section", "kovalevskaya", "--plane", "g33", "--pair", "g1", "g2"}, "did you mean 'g3'");
  refused({"section", "kovalevskaya", "--plane", "r + 1", "--pair", "g1", "g2"},
          "the same everywhere");
  refused({"section", "euler-poisson", "--casimir", "F3=1"}, "did you mean 'F1'");
  refused({"section", "euler-poisson", "--casimir", "F1"}, "NAME=VALUE");
  refused({"section", "euler-poisson", "--energy", "M1"}, "--energy:1:1");
  refused({"section", "euler-poisson", "--output", "a.gif"},
          ".csv, .npz, .h5, .svg, .png, .pdf or .tex");
}

TEST(Section, PointsOffTheLevelAreDroppedAndFail) {
  const Outcome outcome = run({"section", "euler-poisson", "--scene", "chaotic", "--orbits", "5",
                               "--points", "50", "--tolerance", "1e-6", "--json"});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.err.find("left its level"), std::string::npos) << outcome.err;
  const Json result = outcome.json();
  EXPECT_LT(field(result, "off_level"), 1e-10);
  EXPECT_EQ(result.at("orbits")[0].at("status"), "drift_exceeded");
}

/// The cycles of a system of two degrees of freedom with such a bracket.
Outcome section_with(const std::string& bracket, const std::string& hamiltonian,
                     const std::string& plane, std::vector<std::string> more) {
  const std::string text = fmt::format(R"toml(
title = "t"
hamiltonian = "{}"
[phase_space]
variables = ["q1", "q2", "p1", "p2"]
[phase_space.brackets]
{}
[section]
function = "{}"
plot = ["q1", "p1"]
[[scene]]
name = "default"
initial = {{ q1 = "1/10", q2 = "0", p1 = "1/10", p2 = "1" }}
duration = "20"
)toml",
                                       hamiltonian, bracket, plane);
  more.insert(more.end(), {"--orbits", "3", "--points", "20"});
  return section_of(text.c_str(), more);
}

Json cycles_with(const std::string& bracket, const std::string& hamiltonian,
                 const std::string& plane, std::vector<std::string> more = {}) {
  more.insert(more.end(), {"--fixed-points", "--json"});
  const Outcome outcome = section_with(bracket, hamiltonian, plane, more);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return outcome.json().at("cycles");
}

/// Without the Jacobi identity a flow keeps H and no area: |trace| < 2 is no sign of stability. On
/// q1 = p1 = 0 the multipliers have the product exp(2 k H Pi), by Liouville's formula.
TEST(Section, CyclesAreEllipticOnlyWhereAreasAreKept) {
  const auto cycle = [](const std::string& k) {
    return cycles_with("\"q1,p1\" = \"1\"\n\"q2,p2\" = \"1\"\n\"p1,p2\" = \"" + k + "*p1*p2\"",
                       "(p1^2 + p2^2 + 2*q1^2 + q2^2)/2", "q2", {"--validated"})
        .at(0);
  };
  const Json kept = cycle("0");
  EXPECT_EQ(kept.at("kind"), "elliptic") << kept;
  EXPECT_EQ(kept.at("validated").at("kind"), "elliptic") << kept;
  const Json slowly = cycle("1/100000");
  EXPECT_EQ(slowly.at("stability"), "not decided") << slowly;
  EXPECT_EQ(slowly.at("validated").at("verdict"), "proved") << slowly;
  EXPECT_EQ(slowly.at("validated").at("kind"), "undecided") << slowly;
  const Json growing = cycle("1/10");
  EXPECT_EQ(growing.at("kind"), "unstable") << growing;
  EXPECT_NEAR(field(growing, "determinant"), std::exp(1.03 * kPi / 10), 1e-6) << growing;
}

/// What jumps: a bracket, which satisfies the identity on each side of q2 = 0, and a force.
/// Deviations of orbits in lanes know nothing of that, and with them no derivative of the return.
TEST(Section, WhereTheEquationsJumpNothingIsSaidOfGrowth) {
  const char* const canonical = "\"q1,p1\" = \"1\"\n\"q2,p2\" = \"1\"";
  const std::pair<const char*, const char*> systems[] = {
      {"\"q1,p1\" = \"2 + sign(q2)*q1/200000\"\n\"q2,p2\" = \"1\"",
       "(p1^2 + 2*q1^2 + p2^2 + q2^2)/2 + q1*p2/2"},
      {canonical, "(p1^2 + p2^2 + q1^2 + 2*q2^2)/2 + abs(q1)/20"}};
  for (const auto& [bracket, hamiltonian] : systems) {
    const Outcome orbits = section_with(bracket, hamiltonian, "q2 - 1/10", {});
    EXPECT_EQ(orbits.status, 0) << orbits.err;
    EXPECT_TRUE(has(orbits.out, "which are regular and which chaotic is not told")) << orbits.out;
    const Json json = section_with(bracket, hamiltonian, "q2 - 1/10", {"--json"}).json();
    EXPECT_EQ(json.at("chaotic"), nullptr);
    EXPECT_EQ(json.at("orbits").at(0).at("chaotic"), nullptr);
    const Outcome cycles = section_with(bracket, hamiltonian, "q2 - 1/10", {"--fixed-points"});
    EXPECT_EQ(cycles.status, 2);
    EXPECT_TRUE(has(cycles.err, "where the equations jump")) << cycles.err;
  }
}

TEST(Section, ALevelThatIsNotFixedOrChangesIsRefused) {
  std::string text = kHenonHeiles;
  text.replace(text.find("- y^3/3"), 7, "- y^3/3 + cos(t)*x");
  text.replace(text.find("canonical = true"), 16, "canonical = true\ntime = \"t\"");
  const Outcome driven = section_of(text.c_str(), {});
  EXPECT_EQ(driven.status, 2);
  EXPECT_NE(driven.err.find("time 't'"), std::string::npos) << driven.err;
  const Outcome unnamed = section_of(
      "title = \"t\"\nhamiltonian = \"(M1^2 + M2^2 + 2*M3^2)/2 - g1\"\n[phase_space]\n"
      "variables = [\"M1\", \"M2\", \"M3\", \"g1\", \"g2\", \"g3\"]\nalgebra = \"e(3)\"\n"
      "[[scene]]\nname = \"default\"\nduration = \"1\"\n"
      "initial = { M1 = \"1\", M2 = \"1/2\", M3 = \"1/3\", g1 = \"3/5\", g2 = \"0\", g3 = \"4/5\" "
      "}\n",
      {"--plane", "M1", "--pair", "M2", "M3"});
  EXPECT_EQ(unnamed.status, 2);
  EXPECT_NE(unnamed.err.find("names 0"), std::string::npos) << unnamed.err;
}

TEST(Section, SeedsOffTheLevelAreRefused) {
  const Folder folder;
  folder.write("off.csv", "M1,M2,M3,g1,g2,g3\n0,1,2,0,1,0\n0,1,2.1,0,1,0\n");
  Outcome outcome = run_in(folder, {"section", "euler-poisson", "--scene", "chaotic", "--seeds",
                                    "off.csv", "--points", "3"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("seed 2"), std::string::npos) << outcome.err;
  folder.write("few.csv", "M1,M2\n0,1\n");
  outcome =
      run_in(folder, {"section", "euler-poisson", "--scene", "chaotic", "--seeds", "few.csv"});
  EXPECT_EQ(outcome.status, 2);
  folder.write("none.csv", "u,v\n0,3\n");
  outcome =
      run_in(folder, {"section", "euler-poisson", "--scene", "chaotic", "--seeds", "none.csv"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("no motion on this level"), std::string::npos) << outcome.err;
}

/// Functions that are something else where an orbit is for a moment only: a series about the
/// beginning of a step knows nothing of that, and crossings were missed without a word. x = cos(t).
TEST(Section, NoCrossingOfANarrowPlaneIsMissed) {
  const Folder folder;
  folder.write("pair.toml",
               "hamiltonian = \"(px^2 + x^2)/2 + (py^2 + 2*y^2)/2\"\n"
               "[phase_space]\nvariables = [\"x\", \"y\", \"px\", \"py\"]\ncanonical = true\n"
               "[[scene]]\nname = \"default\"\nduration = \"1\"\n"
               "initial = { x = \"1\", y = \"1\", px = \"0\", py = \"0\" }\n");
  folder.write("seed.csv", "x,y,px,py\n1,1,0,0\n");
  for (const double width : {1e-2, 1e-4, 1e-6}) {
    const double half = width * std::sqrt(std::log(2.));
    const struct {
      std::string plane;
      double down, up;  ///< where x is at a crossing, on its way down and up
    } planes[] = {{fmt::format("exp(-((x - 1/3)/{:f})^2) - 1/2", width), half, -half},
                  {fmt::format("abs(x - 1/3) - {:f}", width), -width, width}};
    for (const auto& [plane, down, up] : planes) {
      const Outcome outcome =
          run_in(folder, {"section", "pair.toml", "--plane", plane, "--pair", "y", "py", "--seeds",
                          "seed.csv", "--points", "8", "--output", "out.csv"});
      ASSERT_EQ(outcome.status, 0) << plane << outcome.err;
      EXPECT_EQ(outcome.out.find("warning"), std::string::npos) << outcome.out;
      std::istringstream table(file_text(folder.path() / "out.csv"));
      std::string line;
      std::getline(table, line);
      for (int n = 0; std::getline(table, line); ++n) {
        const double time = std::stod(line.substr(line.find(',', line.find(',') + 1) + 1));
        const double place = std::acos(1. / 3 + (n % 2 == 0 ? down : up));
        const double turn = 2 * kPi * (n / 2);
        EXPECT_NEAR(time, turn + (n % 2 == 0 ? place : 2 * kPi - place), 1e-9) << plane;
      }
    }
  }
}

TEST(Section, PicturesAreDrawn) {
  const Folder folder;
  folder.write("case.toml", kHenonHeiles);
  const Outcome outcome = run_in(
      folder, {"section", "./case.toml", "--energy", "1/8", "--orbits", "6", "--points", "30",
               "--output", "a.svg", "--output", "a.png", "--output", "a.csv", "--quiet"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(outcome.out.empty());
  EXPECT_NE(file_text(folder.path() / "a.svg").find("</svg>"), std::string::npos);
  EXPECT_EQ(file_text(folder.path() / "a.png").substr(1, 3), "PNG");
  // Without gnuplot: the points are there, and it is said what to install.
  const Outcome without = run_in(folder,
                                 {"section", "./case.toml", "--energy", "1/8", "--orbits", "6",
                                  "--points", "30", "--output", "b.svg", "--output", "b.csv"},
                                 {}, {{"PATH", "/nowhere"}});
  EXPECT_EQ(without.status, 4);
  EXPECT_NE(without.err.find("apt-get install gnuplot"), std::string::npos) << without.err;
  EXPECT_FALSE(file_text(folder.path() / "b.csv").empty());
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "b.svg"));
}

}  // namespace
}  // namespace casimir::test
