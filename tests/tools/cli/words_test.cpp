// What commands say in words: of exponents, of equilibria, of the drift of what has many values.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/tools/program.hpp"

namespace casimir::test {
namespace {

using Json = nlohmann::ordered_json;

Json answered(const Folder& folder, std::vector<std::string> arguments, int status = 0) {
  arguments.emplace_back("--json");
  const Outcome outcome = run_in(folder, arguments);
  EXPECT_EQ(outcome.status, status) << outcome.out << outcome.err;
  return outcome.json();
}

/// A case of equations without a Hamiltonian.
std::string equations(const std::string& variables, const std::string& rates,
                      const std::string& more = "") {
  return "title = \"t\"\n[phase_space]\nvariables = [" + variables + "]\n" + more +
         "\n[equations]\n" + rates + "\n";
}

/// A canonical case with a scene.
std::string canonical(const std::string& hamiltonian, const std::string& variables,
                      const std::string& initial) {
  return "title = \"t\"\nhamiltonian = \"" + hamiltonian + "\"\n[phase_space]\nvariables = [" +
         variables + "]\ncanonical = true\n[[scene]]\nname = \"default\"\ninitial = { " + initial +
         " }\nduration = \"10\"\n";
}

bool says(const Json& found, const std::string& words) {
  return std::ranges::any_of(found.at("conclusions"), [&](const Json& sentence) {
    return sentence.get<std::string>().find(words) != std::string::npos;
  });
}

// Of this body all exponents are integers, two of them three times: rounding gives them imaginary
// parts.
TEST(ExponentWords, RoundingMakesNothingComplex) {
  const Folder folder;
  const Json found = answered(folder, {"exponents", "clebsch", "--param", "a1=1", "--param", "a2=2",
                                       "--param", "a3=4", "--param", "s=1"});
  EXPECT_FALSE(says(found, "imaginary"));
  for (const Json& balance : found.at("balances"))
    for (const Json& e : balance.at("exponents"))
      for (const Json& value : e.at("numeric")) EXPECT_EQ(number(value[1]), 0) << e;
}

/// Exponents -1 and, `blocks` times in a Jordan block, 2: x' = -x^2, y_i' = -x y_i + ...
std::string jordan(int size, const std::string& rate) {
  std::string variables = "\"x\"", rates = "x = \"-x^2\"\n";
  for (int k = 1; k <= size; ++k) {
    const std::string name = "y" + std::to_string(k);
    variables += ", \"" + name + "\"";
    rates += name + " = \"" + rate + "*x*" + name +
             (k < size ? " + x*y" + std::to_string(k + 1) : std::string()) + "\"\n";
  }
  return equations(variables, rates);
}

TEST(ExponentWords, AJordanBlockIsNotComplex) {
  const Folder folder;
  for (const int size : {2, 3, 4, 5}) {
    const Json found =
        answered(folder, {"exponents", folder.write("j.toml", jordan(size, "1")), "--numeric"});
    EXPECT_FALSE(found.at("balances").empty());
    EXPECT_FALSE(says(found, "imaginary")) << size;
  }
}

// The twin: y' = x z, z' = -x y turns, with exponents 1 +- i.
TEST(ExponentWords, WhatIsComplexIsCalledSo) {
  const Folder folder;
  const std::string file = folder.write(
      "c.toml", equations("\"x\", \"y\", \"z\"", "x = \"-x^2\"\ny = \"x*z\"\nz = \"-x*y\""));
  EXPECT_TRUE(says(answered(folder, {"exponents", file, "--numeric"}), "imaginary"));
  EXPECT_TRUE(says(answered(folder, {"exponents", file}), "not rational"));
}

// x = (t - t0)^(-1/2): the exponents are whole, and the solution has two values.
TEST(ExponentWords, WholeExponentsOfABrokenPowerAreNoSingleValuedSolution) {
  const Folder folder;
  const Json found =
      answered(folder, {"exponents", folder.write("r.toml", equations("\"x\"", "x = \"-x^3\""))});
  EXPECT_EQ(found.at("weights").at("x"), "1/2");
  EXPECT_FALSE(says(found, "necessary condition"));
  EXPECT_TRUE(says(found, "broken powers"));
}

// u^2 = 1/2 and v^2 = 1/8 are irreducible, and u v = 1/4 and u v = -1/4 are not alike. What they
// have together is said to be so.
TEST(ExponentWords, SolutionsThatAreNotConjugateShareNoExponents) {
  const Folder folder;
  const std::string file = folder.write(
      "n.toml", equations("\"u\", \"v\", \"w\"", "u = \"-u^3\"\nv = \"-4*v^3\"\nw = \"2*u*v*w\""));
  const Json found = answered(folder, {"exponents", file});
  for (const Json& balance : found.at("balances")) {
    int together = 0;
    for (const Json& e : balance.at("exponents")) {
      const int degree = e.contains("numeric") ? static_cast<int>(e.at("numeric").size()) : 1;
      const int solutions = e.value("solutions", 1);
      together += 12 * degree * e.at("multiplicity").get<int>() / solutions;
    }
    EXPECT_EQ(together, 12 * 3) << balance;
  }
}

/// The scene's state in other units: a minimum at 0 and what lies around it.
TEST(EquilibriumWords, AFlatMinimumIsOne) {
  const Folder folder;
  for (const char* potential : {"q^4", "q^6", "q^10", "(q - 1)^4", "q^3/3*q^3"}) {
    const std::string file = folder.write(
        "flat.toml",
        canonical("p^2/2 + " + std::string(potential), "\"q\", \"p\"", "q = \"1/2\", p = \"0\""));
    const Json found = answered(folder, {"equilibria", file});
    ASSERT_EQ(found.at("equilibria").size(), 1u) << potential << found;
    EXPECT_EQ(found.at("equilibria")[0].at("family"), 0) << potential;
  }
}

/// What is proved stands in the place of what Newton's iteration left, and of what the eigenvalues
/// in doubles tell.
TEST(EquilibriumWords, DoNotContradictWhatIsProved) {
  const Folder folder;
  const std::string file =
      folder.write("c.toml", canonical("p1*q2 - p2*q1 + (q1^2 + q2^2)/2 + (p1^2 + p2^2)",
                                       "\"q1\", \"q2\", "
                                       "\"p1\", \"p2\"",
                                       "q1 = \"1\", q2 = \"1/3\", p1 = \"1/7\", p2 = \"0\""));
  const Json found = answered(folder, {"equilibria", file, "--validated"});
  for (const Json& e : found.at("equilibria")) {
    const Json& proof = e.at("validated");
    ASSERT_EQ(proof.at("verdict"), "proved");
    for (const auto& [name, ends] : proof.at("enclosure").items()) {
      const double value = number(e.at("state").at(name));
      EXPECT_LE(number(ends[0]), value) << name;
      EXPECT_GE(number(ends[1]), value) << name;
    }
    if (proof.at("stability") == "unstable") {
      EXPECT_EQ(e.at("stability"), "unstable");
    }
  }
}

TEST(EquilibriumWords, AKinkHasNone) {
  const Folder folder;
  const std::string file =
      folder.write("k.toml", equations("\"u\", \"v\"",
                                       "u = \"-u + 2*abs(u)\"\nv = \"-v\"\n[[scene]]\nname = "
                                       "\"default\"\ninitial = { u = \"1\", v = \"1\" }\nduration "
                                       "= \"1\""));
  const Json found = answered(folder, {"equilibria", file});
  ASSERT_EQ(found.at("equilibria").size(), 1u);
  EXPECT_EQ(found.at("equilibria")[0].at("stability"), "no derivative");
  EXPECT_TRUE(found.at("equilibria")[0].at("eigenvalues").empty());
}

/// Where the rates themselves jump, or have no value: a quotient 0/0.
TEST(EquilibriumWords, AJumpIsNotStable) {
  const Folder folder;
  for (const char* rates :
       {"u = \"sign(u) - u\"\nv = \"-v\"", "u = \"sign(u)\"\nv = \"-v\"",
        "u = \"v\"\nv = \"sign(u)\"", "u = \"-u + 3*u^3/(u^2 + v^2)\"\nv = \"-v\"",
        // Cones that an odd function has on both sides.
        "u = \"-u + 20*(abs(u - 2*abs(v)) - abs(u + 2*abs(v)) - abs(u - 3*abs(v)) + abs(u + "
        "3*abs(v)))\"\nv = \"-2*v + u\""}) {
    const std::string file = folder.write(
        "k.toml", equations("\"u\", \"v\"", std::string(rates) +
                                                "\n[[scene]]\nname = \"default\"\ninitial = { u = "
                                                "\"0\", v = \"0\" }\nduration = \"1\""));
    int at_jump = 0;
    const Json found = answered(folder, {"equilibria", file});
    for (const Json& e : found.at("equilibria"))
      if (std::abs(number(e.at("state").at("u"))) < 1e-9) {
        EXPECT_EQ(e.at("stability"), "no derivative") << rates;
        ++at_jump;
      }
    EXPECT_EQ(at_jump, 1) << rates;
  }
}

/// Eigenvalues do not stay on the axis because a bracket has a name, or a function one.
TEST(EquilibriumWords, OnlyWhatIsProvedKeepsEigenvaluesOnTheAxis) {
  const Folder folder;
  const std::string bracket = folder.write("b.toml", R"toml(
title = "no Jacobi identity"
hamiltonian = "z + (x^2 + y^2)/2 + (x^2 + y^2)^2 + z^2/2"
[phase_space]
variables = ["x", "y", "z"]
[phase_space.brackets]
"x,y" = "1"
"y,z" = "y/10^15"
"x,z" = "x/10^15"
[[scene]]
name = "default"
initial = { x = "0", y = "0", z = "0" }
duration = "1"
)toml");
  const std::string integral = folder.write(
      "i.toml",
      equations(
          "\"x\", \"y\"",
          "x = \"y + x/10^15\"\ny = \"-x + y/10^15\"\n[integrals]\nF = \"x^2 + "
          "y^2\"\n[[scene]]\nname = \"default\"\ninitial = { x = \"0\", y = \"0\" }\nduration "
          "= \"1\""));
  for (const std::string& file : {bracket, integral}) {
    const Json found = answered(folder, {"equilibria", file});
    ASSERT_GE(found.at("equilibria").size(), 1U) << file;
    EXPECT_NE(found.at("equilibria")[0].at("stability"), "spectrally stable") << found;
  }
}

TEST(EquilibriumWords, DoNotDependOnUnits) {
  const Folder folder;
  for (const char* size : {"10^(-6)", "1", "10^6"}) {
    const std::string s = size;
    const std::string file =
        folder.write("well.toml", canonical("p^2/2 + ((q/(" + s + "))^2 - 1)^2*(" + s + ")^2",
                                            "\"q\", \"p\"", "q = \"" + s + "/3\", p = \"0\""));
    const Json found = answered(folder, {"equilibria", file});
    ASSERT_EQ(found.at("equilibria").size(), 3u) << size;
    EXPECT_EQ(std::ranges::count_if(found.at("equilibria"),
                                    [](const Json& e) { return e.at("stability") == "unstable"; }),
              1)
        << size;
  }
}

// A circle of equilibria along which the eigenvalues change, small and large.
TEST(EquilibriumWords, AFamilyIsOne) {
  const Folder folder;
  for (const char* size : {"10^(-6)", "1", "10^6"}) {
    const std::string s = std::string("(") + size + ")";
    const std::string file = folder.write(
        "hat.toml", canonical("(p1^2 + p2^2)/2 + " + s + "^2*((q1/" + s + ")^2 + (q2/" + s +
                                  ")^2 - 1)^2*(1 + q1/10/" + s + ")",
                              "\"q1\", \"q2\", \"p1\", \"p2\"",
                              "q1 = \"" + s + "\", q2 = \"" + s + "/2\", p1 = \"0\", p2 = \"0\""));
    const Json found = answered(folder, {"equilibria", file});
    EXPECT_EQ(std::ranges::count_if(found.at("equilibria"),
                                    [](const Json& e) { return e.at("family") == 1; }),
              1)
        << size << found;
  }
}

TEST(EquilibriumWords, OnALevelOfAnySizeARigidBodyHasSix) {
  const Folder folder;
  for (const char* size : {"10^(-6)", "1", "10^6"}) {
    const std::string s = size;
    const std::string file = folder.write(
        "body.toml",
        "title = \"t\"\nhamiltonian = \"(M1^2 + 2*M2^2 + 3*M3^2)/2\"\n[phase_space]\nvariables = "
        "[\"M1\", \"M2\", \"M3\"]\nalgebra = \"so(3)\"\n[casimirs]\nK = \"M1^2 + M2^2 + "
        "M3^2\"\n[[scene]]\nname = \"default\"\ninitial = { M1 = \"" +
            s + "\", M2 = \"" + s + "/2\", M3 = \"" + s + "/3\" }\nduration = \"10\"\n");
    const Json found = answered(folder, {"equilibria", file});
    ASSERT_EQ(found.at("equilibria").size(), 6u) << size;
    EXPECT_EQ(std::ranges::count_if(found.at("equilibria"),
                                    [](const Json& e) { return e.at("stability") == "unstable"; }),
              2)
        << size;
  }
}

std::string rotator(const std::string& integral, const std::string& duration) {
  return "title = \"t\"\n[phase_space]\nvariables = [\"x\", \"y\", \"w\"]\ntime = "
         "\"t\"\n[equations]\nx = \"-y*w\"\ny = \"x*w\"\nw = \"0\"\n[integrals]\nF = \"" +
         integral + "\"\n[[scene]]\nname = \"default\"\ninitial = { x = \"1\", y = \"1/3\", w = " +
         "\"7/5\" }\nduration = \"" + duration + "\"\n";
}

TEST(ManyValuedIntegrals, AreFollowedOnOneBranch) {
  const Folder folder;
  for (const char* integral : {"atan2(y, x) - w*t", "atan(y/x) - w*t", "atan2(x, y)/3 + w*t/3",
                               "w*atan2(y, x) - w^2*t", "sin(atan2(y, x)/2 - w*t/2)"}) {
    const std::string file = folder.write("r.toml", rotator(integral, "100"));
    for (const char* method : {"auto", "dop853", "gauss8"}) {
      const Json run = answered(folder, {"integrate", file, "--method", method});
      EXPECT_EQ(run.at("status"), "ok") << integral << method;
      EXPECT_LT(number(run.at("invariants").at("F").at("drift")), 1e-8) << integral << method;
    }
    const Json precise = answered(folder, {"integrate", file, "--digits", "30"});
    EXPECT_LT(number(precise.at("invariants").at("F").at("drift")), 1e-25) << integral;
    EXPECT_EQ(answered(folder, {"conserve", file}).at("failed"), 0) << integral;
  }
}

// The twins: what turns at another speed drifts, even where it ends a whole number of turns off;
// what jumps by a turn for another reason, too, whether it is proved or not.
TEST(ManyValuedIntegrals, AFalseOneDrifts) {
  const Folder folder;
  for (const char* integral : {"atan2(y, x)", "atan2(y, x) - 2*w*t"}) {
    const std::string file = folder.write("r.toml", rotator(integral, "20*Pi*5/7"));
    const Json run = answered(folder, {"integrate", file});
    EXPECT_GT(number(run.at("invariants").at("F").at("drift")), 0.05) << integral;
    EXPECT_FALSE(run.at("warnings").empty()) << integral;
    EXPECT_GT(answered(folder, {"conserve", file}, 1).at("failed"), 0) << integral;
  }
  const std::string file =
      folder.write("r.toml", rotator("atan2(y, x) - w*t + Pi*x/sqrt(x^2)", "20*Pi*5/7"));
  // An integral between its jumps: that it passes some says nothing of the run, but is said.
  const Json jumping = answered(folder, {"integrate", file});
  EXPECT_EQ(jumping.at("status"), "ok");
  EXPECT_NE(jumping.at("warnings").dump().find("between the jumps"), std::string::npos);
}

TEST(ManyValuedIntegrals, OfAnEnsembleAreComparedUpToTheirBranches) {
  const Folder folder;
  const std::string starts = folder.write("starts.csv", "x,y\n1,0\n-1,1\n0,-2\n");
  const auto largest = [&](const std::string& integral) {
    const std::string file = folder.write("r.toml", rotator(integral, "100"));
    const Json run = answered(folder, {"integrate", file, "--ensemble", starts});
    double drift = 0;
    for (const Json& member : run.at("members"))
      drift = std::max(drift, number(member.at("invariants").at("F").at("drift")));
    return drift;
  };
  EXPECT_LT(largest("w*atan2(y, x) - w^2*t"), 1e-9);
  EXPECT_LT(largest("atan(y/x) - w*t"), 1e-9);
  EXPECT_GT(largest("atan2(y, x) - w*t*1001/1000"), 1e-4);
}

}  // namespace
}  // namespace casimir::test
