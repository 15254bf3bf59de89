// Maps on the command line: `discretise`, `degrees`, `search`, `integrate`, and what refuses them.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "tests/tools/program.hpp"

namespace casimir::test {
namespace {

using Json = nlohmann::ordered_json;

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
  EXPECT_EQ(run({"discretise", "euler", "--kahan", "--moser-veselov"}).status, 2);
  EXPECT_EQ(run({"discretise", "euler", "--moser-veselov", "0"}).status, 2);
  EXPECT_TRUE(has(run({"discretise", "lagrange", "--moser-veselov"}).err, "free rigid body"));
  EXPECT_TRUE(has(run({"discretise", "euler", "--midpoint"}).err, "linear equations only"));
  EXPECT_TRUE(
      has(run({"discretise", "neumann", "--kahan"}).err, "no polynomial of degree at most 2"));
}

/// The error of Moser's and Veselov's map of Euler's top at the time 100.
double veselov_error(const Folder& folder, int steps_a_time) {
  const std::string step = "1/" + std::to_string(steps_a_time);
  const Outcome written =
      run_in(folder, {"discretise", "euler", "--moser-veselov", step, "-o", "top.toml"});
  EXPECT_EQ(written.status, 0) << written.err;
  const Json state = run_in(folder, {"integrate", "./top.toml", "--duration",
                                     std::to_string(100 * steps_a_time), "--json"})
                         .json()
                         .at("state");
  const auto value = [&](const char* name) { return std::stod(state.at(name).get<std::string>()); };
  const double m1 = value("M1"), m2 = value("M2"), m3 = value("M3");
  EXPECT_NEAR(m1 * m1 + m2 * m2 + m3 * m3, 49. / 36, 1e-11);
  EXPECT_NEAR(m1 * m1 + m2 * m2 / 2 + m3 * m3 / 3, 1 + 1. / 8 + 1. / 27, 1e-11);
  return std::hypot(m1 - 1.00934181025282139, m2 - 0.41823012840089604, m3 + 0.40917451152831920);
}

TEST(MapCommands, MoserAndVeselovsMapIsOfSecondOrderAndKeepsWhatTheTopKeeps) {
  const Folder folder;
  const double coarse = veselov_error(folder, 20), fine = veselov_error(folder, 40);
  EXPECT_NEAR(coarse / fine, 4, 0.1);
  EXPECT_LT(fine, 1e-2);
  EXPECT_EQ(run_in(folder, {"verify", "./top.toml", "--param", "a1=1", "--param", "a2=1/2",
                            "--param", "a3=1/5", "--json"})
                .status,
            0);
}

TEST(MapCommands, DegreesAreEvidence) {
  const Json euler = run({"degrees", "euler", "--kahan", "--iterates", "7", "--json"}).json();
  EXPECT_EQ(euler.at("degrees"), Json({3, 9, 19, 33, 51, 73, 99}));
  EXPECT_EQ(euler.at("growth"), "polynomial");
  EXPECT_EQ(euler.at("growth_degree"), 2);
  EXPECT_EQ(euler.at("formula"), "2*n^2 + 1");
  EXPECT_EQ(euler.at("verdict"), "evidence");
  EXPECT_EQ(euler.at("confinement"), "confined");
  EXPECT_EQ(euler.at("singularities")[0].at("recovered"), 2);
  const Outcome viallet = run({"degrees", "-"},
                              "[phase_space]\nvariables = [\"x\", \"y\"]\n[parameters]\na = {}\n"
                              "[map]\nx = \"x - y + a/x^2\"\ny = \"x\"\n");
  EXPECT_TRUE(has(viallet.out, "confined, after at most 4 steps"));
  EXPECT_TRUE(has(viallet.out, "confinement alone is no sign of integrability"));
  EXPECT_EQ(run({"degrees", "henon-area-preserving", "--json"}).json().at("confinement"), "none");
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

TEST(MapCommands, SearchFindsDarbouxPolynomials) {
  const Folder folder;
  const std::vector<std::string> command{"search",   "lyness", "--param",  "a=2",
                                         "--degree", "3",      "--darboux"};
  std::vector<std::string> in_json = command;
  in_json.emplace_back("--json");
  const nlohmann::ordered_json found = run_in(folder, in_json).json();
  EXPECT_EQ(found.at("invariant_relations")[0].at("cofactor"), "(y + 2)/x^2");
  EXPECT_EQ(found.at("integrals").size(), 1u);
  EXPECT_EQ(found.at("combinations").size(), 2u);
  EXPECT_EQ(found.at("verdict"), "proved");
  EXPECT_NE(run_in(folder, command).out.find("P = x*y   C = (y + 2)/x^2"), std::string::npos);
  const Outcome symbols = run_in(folder, {"search", "lyness", "--degree", "2", "--darboux"});
  EXPECT_EQ(symbols.status, 2);
  EXPECT_NE(symbols.err.find("'a'"), std::string::npos) << symbols.err;
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
  EXPECT_EQ(run({"integrate", "lyness", "--max-steps", "3"}).status, 2);
  EXPECT_EQ(run({"integrate", "lyness", "--keep-params"}).status, 2);
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
                                                  {"stress", "lyness"},
                                                  {"sweep", "lyness"},
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

// What is generated is the map: a program of its own that uses it comes back to where it was, and
// has the state of `integrate`.
TEST(MapCommands, GeneratedStepAndInverseUndoEachOther) {
  const Folder folder;
  const Outcome json = run_in(folder, {"generate", "kahan-euler", "-o", "k.hpp", "--with",
                                       "inverse,jacobian,invariants,variational", "--json"});
  ASSERT_EQ(json.status, 0) << json.err;
  EXPECT_TRUE(json.json().at("functions").contains("step"));
  EXPECT_TRUE(json.json().at("functions").contains("inverse"));
  ASSERT_EQ(run_in(folder, {"generate", "kahan-euler", "-o", "k.h", "--language", "c"}).status, 0);
  folder.write("main.cpp", R"(
#include <cstdio>
#include "k.hpp"
namespace c {
#include "k.h"
}
int main() {
  namespace k = kahan_euler;
  double x[3], y[3], z[3], w[3], J[9], v[3] = {1, 0, 0}, u[3], s[3];
  for (int i = 0; i < 3; ++i) x[i] = k::initial_state[i];
  k::step(x, y);
  k::inverse(y, z);
  c::kahan_euler_step(x, w);
  k::jacobian(x, J);
  k::tangent(x, v, s, u);
  for (int i = 0; i < 3; ++i) {
    std::printf("%.17g\n", y[i]);
    if (!(z[i] - x[i] < 1e-14 && x[i] - z[i] < 1e-14) || w[i] != y[i]) return 1;
    if (!(u[i] - J[i] < 1e-14 && J[i] - u[i] < 1e-14)) return 2;
  }
})");
  const std::string command = "c++ -std=c++20 -Wall -Wextra -Werror " + (folder / "main.cpp") +
                              " -o " + (folder / "main") + " && " + (folder / "main") + " > " +
                              (folder / "out.txt");
  ASSERT_EQ(std::system(command.c_str()), 0);
  const Json state = run({"integrate", "kahan-euler", "--duration", "1", "--json"}).json();
  std::istringstream lines(file_text(folder / "out.txt"));
  for (const char* name : {"M1", "M2", "M3"}) {
    double value = 0;
    ASSERT_TRUE(lines >> value);
    EXPECT_NEAR(value, std::stod(state.at("state").at(name).get<std::string>()), 1e-14);
  }
  // Henon's map has none at b = 0, where its step is as good as elsewhere.
  const std::string henon =
      "[phase_space]\nvariables = [\"x\", \"y\"]\n[parameters]\nb = {}\n[map]\n"
      "x = \"1 - x^2 + y\"\ny = \"b*x\"\n[[scene]]\nname = \"default\"\nparameters = { b = \"0\" "
      "}\n"
      "initial = { x = \"2\", y = \"1\" }\n";
  EXPECT_EQ(run({"generate", "-", "--language", "c"}, henon).status, 0);
  EXPECT_EQ(run({"generate", "-", "--with", "inverse"}, henon).status, 2);
  // (x, y) -> (x^2, y) has no inverse, and none is said.
  const std::string fold =
      "[phase_space]\nvariables = [\"x\", \"y\"]\n[map]\nx = \"x^2\"\ny = \"y\"\n"
      "[[scene]]\nname = \"default\"\ninitial = { x = \"2\", y = \"1\" }\n";
  EXPECT_EQ(run({"generate", "-", "--with", "inverse"}, fold).status, 2);
  const Outcome without = run({"generate", "-"}, fold);
  EXPECT_EQ(without.status, 0) << without.err;
  EXPECT_FALSE(has(without.out, "inverse"));
  EXPECT_FALSE(has(without.out, "rhs"));
  EXPECT_EQ(run({"generate", "lyness", "--with", "taylor"}).status, 2);
  EXPECT_EQ(run({"generate", "euler", "--with", "inverse"}).status, 2);
}

TEST(MapCommands, ConserveWatchesWhatTheMapKeeps) {
  const Json rows = run({"conserve", "--all", "--tag", "qrt", "--json"}).json();
  EXPECT_EQ(rows.at("failed"), 0);
  EXPECT_EQ(rows.at("rows").size(), 3U);
  const Json row = run({"conserve", "discrete-neumann", "--json"}).json().at("rows")[0];
  EXPECT_EQ(row.at("method"), "map");
  EXPECT_EQ(row.at("steps"), 1000);
  // The twin: what the map does not keep drifts, also where it is kept on a level only and the
  // scene begins on that.
  std::string text = file_text(CASIMIR_SOURCE_DIR "/cases/maps/discrete-neumann.toml");
  const std::string right = "y1^2 + M12^2/(j1^2 - j2^2)";
  text.replace(text.find(right), right.size(), "y1^2 - M12^2/(j1^2 - j2^2)");
  const Outcome wrong = run({"conserve", "-", "--json"}, text);
  EXPECT_EQ(wrong.status, 1);
  EXPECT_EQ(run({"conserve", "lyness", "--method", "taylor"}).status, 2);
  EXPECT_EQ(run({"conserve", "lyness", "--plot", "x.svg"}).status, 2);
}

/// The sign of 0 has no value, and an orbit may stand there: from y = 2 it comes to 0 in two steps.
TEST(MapCommands, OrbitsEndWhereTheSignOfZeroIsTaken) {
  const auto orbit = [](const char* y) {
    return run(
        {"integrate", "-", "--json"},
        std::string("[phase_space]\nvariables = [\"x\", \"y\"]\n[map]\nx = \"x + "
                    "sign(y)\"\ny = \"y - 1\"\n[[scene]]\nname = \"default\"\ninitial = { x = "
                    "\"1\", y = \"") +
            y + "\" }\nduration = \"5\"\n");
  };
  const Outcome passes = orbit("5/2");
  EXPECT_EQ(passes.status, 0) << passes.err;
  EXPECT_EQ(passes.json().at("state").at("x"), "2");
  for (const char* stands : {"0", "2"}) {
    const Outcome ended = orbit(stands);
    EXPECT_EQ(ended.status, 5) << stands;
    EXPECT_TRUE(has(ended.err, "not finite")) << ended.err;
  }
}

TEST(MapCommands, SectionFollowsOrbits) {
  const Folder folder;
  const Outcome outcome = run_in(folder, {"section", "mcmillan", "--orbits", "6", "--points", "300",
                                          "--output", "o.csv", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const Json json = outcome.json();
  EXPECT_EQ(json.at("orbits").size(), 6U);
  EXPECT_EQ(json.at("crossings"), 1800);
  EXPECT_EQ(json.at("regular"), 6);  // it has an integral
  // Every line is a point of the orbit: q' = p, and the integral is that of the first.
  std::istringstream lines(file_text(folder / "o.csv"));
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "orbit,n,t,u,v,q,p");
  int orbit = 0, last = 0;
  double q = 0, p = 0, before = 0, first = 0;
  char comma = 0;
  double n = 0, t = 0, u = 0, v = 0;
  std::size_t count = 0;
  while (std::getline(lines, line)) {
    std::istringstream fields(line);
    fields >> orbit >> comma >> n >> comma >> t >> comma >> u >> comma >> v >> comma >> q >>
        comma >> p;
    const double f = q * q * p * p + q * q + p * p - 2 * 1.6 * q * p;
    if (orbit != last) first = f;
    if (orbit == last) {
      EXPECT_EQ(q, before);
    }
    EXPECT_NEAR(f, first, 1e-12);
    EXPECT_EQ(u, q);
    last = orbit;
    before = p;
    ++count;
  }
  EXPECT_EQ(count, 1800U);
  // The standard map with a large parameter is chaotic, its orbits are not regular.
  const std::string standard =
      "[phase_space]\nvariables = [\"x\", \"y\"]\n[map]\nx = \"x + y + 7*sin(x)\"\n"
      "y = \"y + 7*sin(x)\"\n[[scene]]\nname = \"default\"\n"
      "initial = { x = \"1\", y = \"1/2\" }\n";
  const Json chaos =
      run({"section", "-", "--orbits", "1", "--pair", "sin(x)", "cos(y)", "--json"}, standard)
          .json();
  EXPECT_EQ(chaos.at("chaotic"), 1);
  EXPECT_NEAR(std::stod(chaos.at("orbits")[0].at("exponent").get<std::string>()), std::log(3.5),
              0.2);
  EXPECT_EQ(run({"section", "lyness", "--energy", "1"}).status, 2);
  EXPECT_EQ(run({"section", "lyness", "--plane", "x"}).status, 2);
  EXPECT_EQ(run({"section", "lyness", "--cycles", "2"}).status, 2);
}

// Kahan's map as a method: of order 2, exactly the map that `discretise` writes, and nothing for
// equations that are not quadratic.
TEST(MapCommands, KahanIsAMethod) {
  const Folder folder;
  ASSERT_EQ(run_in(folder, {"discretise", "euler", "--kahan", "1/10", "-o", "k.toml"}).status, 0);
  const Json map = run_in(folder, {"integrate", "./k.toml", "--duration", "100", "--json"}).json();
  const Json flow = run_in(folder, {"integrate", "euler", "--method", "kahan", "--step", "0.1",
                                    "--duration", "10", "--json"})
                        .json();
  EXPECT_EQ(flow.at("method"), "kahan");
  for (const char* name : {"M1", "M2", "M3"})
    EXPECT_NEAR(std::stod(flow.at("state").at(name).get<std::string>()),
                std::stod(map.at("state").at(name).get<std::string>()), 1e-12);
  const Outcome refused = run({"integrate", "euler-angles", "--method", "kahan"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_TRUE(has(refused.err, "degree two")) << refused.err;
  const Outcome bench = run({"bench", "lyness"});
  EXPECT_EQ(bench.status, 2);
  EXPECT_TRUE(has(bench.err, "--method kahan")) << bench.err;
}

// Moser's and Veselov's map as a method: what `discretise` writes, with added variables that hold
// the solution of a quartic, and what Newton's method finds are the same map.
TEST(MapCommands, MoserVeselovIsAMethod) {
  const Folder folder;
  ASSERT_EQ(
      run_in(folder, {"discretise", "euler", "--moser-veselov", "1/10", "-o", "mv.toml"}).status,
      0);
  const Json map = run_in(folder, {"integrate", "./mv.toml", "--duration", "100", "--json"}).json();
  const Json flow = run_in(folder, {"integrate", "euler", "--method", "moser-veselov", "--step",
                                    "0.1", "--duration", "10", "--json"})
                        .json();
  EXPECT_EQ(flow.at("method"), "moser-veselov");
  for (const char* name : {"M1", "M2", "M3"})
    EXPECT_NEAR(std::stod(flow.at("state").at(name).get<std::string>()),
                std::stod(map.at("state").at(name).get<std::string>()), 1e-12);
  const Outcome refused = run({"integrate", "kovalevskaya", "--method", "moser-veselov"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_TRUE(has(refused.err, "free rigid body")) << refused.err;
}

}  // namespace
}  // namespace casimir::test
