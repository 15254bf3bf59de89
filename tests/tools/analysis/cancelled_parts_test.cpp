// Equations in which a part cancels that need not have a value: sqrt(x)^2 is x where x is not
// negative, and nothing elsewhere.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/tools/analysis/systems.hpp"
#include "tools/analysis/error.hpp"
#include "tools/analysis/estimate/cancelled_parts.hpp"
#include "tools/analysis/run/conservation.hpp"
#include "tools/analysis/run/validated.hpp"
#include "tools/analysis/solve.hpp"

namespace casimir::test {
namespace {

double value(const cln::cl_RA& x) { return cln::double_approx(x); }

ValidatedMotion enclosed(const Model& model, const ValidatedOptions& options = {}) {
  return enclose(model, model.scene("default"), options);
}

/// What cancels to x, is to have values, and has none for x < 0.
const char* const kParts[] = {"sqrt(x)^2",     "sqrt(x)*sqrt(x)", "exp(log(x))",
                              "(x^(1/2))^4/x", "x + 0*log(x)",    "x + sqrt(x) - sqrt(x)"};

TEST(CancelledParts, EndAnEnclosureWhereTheyHaveNoValue) {
  for (const char* part : kParts) {
    // x = 2 - exp(t)
    const Model model = one_equation(std::string(part) + " - 2", "2");
    const ValidatedMotion motion = enclosed(model);
    EXPECT_EQ(motion.run.status, ValidatedStatus::no_enclosure) << part;
    EXPECT_LE(value(motion.run.end.time), std::log(2.)) << part;
    EXPECT_GT(value(motion.run.end.time), std::log(2.) - 1e-6) << part;
    EXPECT_EQ(motion.names, std::vector<std::string>{"x"}) << part;
    EXPECT_EQ(motion.run.end.states.size(), 1U) << part;
  }
}

/// x' = .. - 2 with a parameter a and a function U of the scene.
Model equation_in_scene(const std::string& rate, const std::string& a, const std::string& u) {
  return model_of(
      "title = \"t\"\n[phase_space]\nvariables = [\"x\"]\n[parameters]\na = {}\n[functions]\n"
      "U = [\"r\"]\n[equations]\nx = \"" +
      rate +
      " - 2\"\n[[scene]]\nname = \"default\"\ninitial = { x = \"1\" }\nparameters = { a = \"" + a +
      "\" }\nfunctions = { U = \"" + u + "\" }\nduration = \"1\"\n");
}

/// exp(a*log(x)) becomes x where the scene says that a is 1: still it has a value for x > 0 only.
TEST(CancelledParts, OfAScenesParametersAndFunctionsEndAnEnclosureAndARun) {
  const auto ends_early = [](const Model& model) {
    const Scene& scene = model.scene("default");
    const Solution motion = solve(model, scene, {});
    return motion.trajectory().status == Status::singularity &&
           motion.trajectory().time < std::log(2.) &&
           enclosed(model).run.status == ValidatedStatus::no_enclosure;
  };
  EXPECT_TRUE(ends_early(equation_in_scene("exp(a*log(x))", "1", "r")));
  EXPECT_TRUE(ends_early(equation_in_scene("sqrt(x)^a", "2", "r")));
  EXPECT_TRUE(ends_early(equation_in_scene("U(sqrt(x))", "1", "r^2")));
  EXPECT_TRUE(ends_early(equation_in_scene("a*U(exp(log(x)))", "1", "r")));
  // Terms that the scene makes zero are not there; the root of a square is real everywhere.
  for (const auto& [rate, a, u] : {std::tuple{"a*log(x) + x", "0", "r"},
                                   {"a*U(sqrt(x)) + x", "0", "r"},
                                   {"U(sqrt(x)) + x", "0", "0"},
                                   {"U(sqrt(x^2 + a)) + x - x^2", "0", "r^2"}}) {
    const Model model = equation_in_scene(rate, a, u);
    EXPECT_TRUE(cancelled_parts(model, model.scene("default")).empty()) << rate;
  }
}

/// Of H, q(0) = 1 and p(0) = 0.
Model of_hamiltonian(const std::string& potential, const std::string& more = "",
                     const std::string& of_scene = "") {
  return model_of("title = \"t\"\nhamiltonian = \"p^2/2 + " + potential +
                  "\"\n[phase_space]\nvariables = [\"q\", \"p\"]\ncanonical = true\n" + more +
                  "[[scene]]\nname = \"default\"\ninitial = { q = \"1\", p = \"0\" }\n" + of_scene +
                  "duration = \"4\"\n");
}

/// In the equations log(q) - log(5*q) leaves nothing, nor does sign(q); q = cos(sqrt(2) t) comes to
/// 0 at t = 1.1107.
TEST(CancelledParts, OfAHamiltonianAreThoseThatItsDerivativesLoseToo) {
  const std::string functions = "[functions]\nU = [\"r\"]\n";
  const double zero = std::acos(-1.) / std::sqrt(8.);
  const auto ends_there = [&](const Model& model) {
    const ValidatedMotion motion = enclosed(model);
    return motion.run.status == ValidatedStatus::no_enclosure && value(motion.run.end.time) <= zero;
  };
  EXPECT_TRUE(ends_there(of_hamiltonian("q^2 + log(5*q) - log(q)")));
  EXPECT_TRUE(ends_there(of_hamiltonian("q^2 + log(1/q) + log(q)")));
  EXPECT_TRUE(ends_there(of_hamiltonian("q^2 + sign(q)")));
  EXPECT_TRUE(ends_there(of_hamiltonian("q^4/q^2")));
  EXPECT_TRUE(ends_there(of_hamiltonian("U(q)", functions, "functions = { U = \"sqrt(r)^4\" }\n")));
  EXPECT_TRUE(ends_there(of_hamiltonian("U(q)", functions, "functions = { U = \"r^4/r^2\" }\n")));
  EXPECT_TRUE(ends_there(of_hamiltonian("q^2*(q/abs(q))^a", "[parameters]\na = {}\n",
                                        "parameters = { a = \"2\" }\n")));
  const Model even = of_hamiltonian("q^4/q^2");
  EXPECT_EQ(solve(even, even.scene("default"), {}).trajectory().status, Status::singularity);
}

/// Within one step of a Taylor series, that ends where the part has a value again.
TEST(CancelledParts, AreLookedAtWithinSteps) {
  // y = 1 - t comes to 1/2 at t = 1/2, and to -1/2 at 3/2.
  const Model model = model_of(
      "title = \"t\"\n[phase_space]\nvariables = [\"x\", \"y\"]\n[equations]\n"
      "x = \"sqrt(y^2 - 1/4)^2\"\ny = \"-1\"\n[[scene]]\nname = \"default\"\n"
      "initial = { x = \"0\", y = \"1\" }\nduration = \"2\"\n");
  const Solution motion = solve(model, model.scene("default"), {});
  EXPECT_EQ(motion.trajectory().status, Status::singularity);
  EXPECT_LT(motion.trajectory().time, 0.5 + 1e-9);
  EXPECT_GT(motion.trajectory().time, 0.3);
  const Conservation kept =
      conserve(model, model.scene("default"), *find_method("taylor"), {.run = {}, .code = {}});
  EXPECT_EQ(kept.row.status, Status::singularity);
  EXPECT_TRUE(kept.row.failed);
}

/// A dip of 10^-4 below zero, of a width of 0.02 in a step of the length 2.
TEST(CancelledParts, AreLookedAtWhereTheyComeNearestToTheirEnd) {
  const auto status = [](const char* radicand) {
    const Model model = model_of(
        "title = \"t\"\n[phase_space]\nvariables = [\"x\", \"y\"]\n[equations]\nx = \"sqrt(" +
        std::string(radicand) +
        ")^2\"\ny = \"-1\"\n[[scene]]\nname = \"default\"\n"
        "initial = { x = \"0\", y = \"1\" }\nduration = \"2\"\n");
    return solve(model, model.scene("default"), {}).trajectory().status;
  };
  EXPECT_EQ(status("(y - 1/7)^2 - 1/10000"), Status::singularity);
  EXPECT_EQ(status("(y - 1/7)^2 + 1/10000"), Status::ok);
}

/// z' of a circle (x, y) of radius 1.
Model on_circle(const std::string& rate) {
  return model_of(
      "title = \"t\"\n[phase_space]\nvariables = [\"x\", \"y\", \"z\"]\n[equations]\nx = \"y\"\n"
      "y = \"-x\"\nz = \"" +
      rate +
      "\"\n[[scene]]\nname = \"default\"\ninitial = { x = \"0\", y = \"1\", z = \"0\" }\n"
      "duration = \"20\"\n");
}

Status end_of(const Model& model, const std::string& method) {
  SolveOptions options;
  options.method = method;
  return solve(model, model.scene("default"), options).trajectory().status;
}

TEST(CancelledParts, MayTouchTheEndOfTheirValues) {
  for (const char* method : {"auto", "dop853"}) {
    for (const char* rate : {"sqrt(1 - x^2)^2", "sqrt(1 - x)^2", "cos(acos(x))", "sin(asin(y))",
                             "sqrt(1 - x^2 - y^2)^2"})
      EXPECT_EQ(end_of(on_circle(rate), method), Status::ok) << rate << ' ' << method;
    for (const char* rate : {"sqrt(99/100 - x^2)^2", "sqrt(9/10 - x)^2", "cos(acos(x + 1/10))",
                             "sqrt(99/100 - x^2 - y^2)^2", "exp(log(x + 999/1000))"})
      EXPECT_EQ(end_of(on_circle(rate), method), Status::singularity) << rate << ' ' << method;
  }
}

/// GiNaC writes 1/(x - 1/2) as 2/(2*x - 1).
TEST(CancelledParts, ArePolesWithFractions) {
  for (const char* rate : {"(x - 1/2)^2/(x - 1/2)", "(x - 9/10)^2/(x - 9/10)", "1/(1/(x - 1/2))",
                           "(x - 2/5)^3/(x - 2/5)^2"})
    for (const char* method : {"auto", "dop853"})
      EXPECT_EQ(end_of(on_circle(rate), method), Status::singularity) << rate << ' ' << method;
}

/// Poles of polynomials over the real numbers, which GiNaC does not factor.
TEST(CancelledParts, MayHaveIrrationalCoefficients) {
  for (const char* potential : {"(q + sqrt(2))^2/(q + sqrt(2))", "(q + Pi)^2/(q + Pi)^2 + q",
                                "(q^2 - 2*sqrt(2)*q + 2)^2/(q^2 - 2*sqrt(2)*q + 2)"}) {
    const Model model = of_hamiltonian(potential);
    EXPECT_NO_THROW(solve(model, model.scene("default"), {})) << potential;
  }
  // q = 1 - t^2/2 comes to -sqrt(2) at t = 2.2.
  const Model pole = of_hamiltonian("(q + sqrt(2))^2/(q + sqrt(2))");
  EXPECT_EQ(solve(pole, pole.scene("default"), {}).trajectory().status, Status::singularity);
}

/// What the equations show is noticed without being watched, and has its certificate.
TEST(CancelledParts, AreNotWhatTheEquationsShow) {
  for (const char* potential : {"q^2 - log(q)", "q^2 + 1/q", "q^2 + sqrt(q^2 + 1)", "q^2 + abs(q)",
                                "q^2 + asin(q/2)", "q^2 + 1/sqrt(q)", "q^2 + exp(q) + sin(q)",
                                "q^2 + atan2(q, 2)", "q^2 + tan(q/4)", "q^(3/2)"}) {
    const Model model = of_hamiltonian(potential);
    EXPECT_EQ(unwatched_parts(model, model.scene("default")), "") << potential;
  }
}

TEST(CancelledParts, LeaveAnEnclosureAloneWhereTheyHaveValues) {
  const ValidatedMotion motion = enclosed(one_equation("sqrt(x)^2 - 2", "1/2"));
  ASSERT_EQ(motion.run.status, ValidatedStatus::ok) << motion.run.reason;
  const RationalInterval& x = motion.run.end.states[0];
  EXPECT_LE(value(x.low), 2 - std::exp(0.5));
  EXPECT_GE(value(x.high), 2 - std::exp(0.5));
  EXPECT_LT(motion.run.radius(), 1e-13);
}

TEST(CancelledParts, OfEveryStartAreWanted) {
  ValidatedOptions options;
  options.initial_radius = 2;
  const ValidatedMotion motion = enclosed(one_equation("sqrt(x)^2", "1"), options);
  EXPECT_NE(motion.run.status, ValidatedStatus::ok);
  EXPECT_EQ(motion.run.end.time, 0);
}

TEST(CancelledParts, OfEveryParameterAreWanted) {
  const Model model = model_of(
      "title = \"t\"\n[phase_space]\nvariables = [\"x\"]\n[parameters]\na = {}\n[equations]\n"
      "x = \"x*a/a\"\n[[scene]]\nname = \"default\"\ninitial = { x = \"1\" }\n"
      "parameters = { a = \"1\" }\nduration = \"1\"\n");
  ValidatedOptions options;
  options.ranges = {{"a", cln::cl_RA(1) / 2}};
  EXPECT_EQ(enclosed(model, options).run.status, ValidatedStatus::ok);
  options.ranges = {{"a", cln::cl_RA(2)}};
  EXPECT_NE(enclosed(model, options).run.status, ValidatedStatus::ok);
}

TEST(CancelledParts, HaveNoCertificates) {
  const Model model = one_equation("sqrt(x)^2 - 2", "1/2");
  try {
    prepare_enclosure(model, model.scene("default"));
    FAIL() << "was prepared";
  } catch (const RequestError& problem) {
    EXPECT_NE(std::string(problem.what()).find("sqrt(x)"), std::string::npos) << problem.what();
  }
}

TEST(CancelledParts, EndARunWithTheTimesBetweenWhichTheyCease) {
  for (const char* part : kParts) {
    const Model model = one_equation(std::string(part) + " - 2", "2");
    for (const char* method : {"auto", "dop853"}) {
      SolveOptions options;
      options.method = method;
      options.dense = true;
      options.sample_every = 0.125;
      const Solution motion = solve(model, model.scene("default"), options);
      EXPECT_EQ(motion.trajectory().status, Status::singularity) << part << ' ' << method;
      EXPECT_LE(motion.trajectory().time, std::log(2.)) << part << ' ' << method;
      EXPECT_EQ(motion.steps().back().time, motion.trajectory().time) << part << ' ' << method;
      for (const std::vector<double>& x : motion.trajectory().samples)
        EXPECT_GE(x[0], 0) << part << ' ' << method;
    }
  }
  const Model pole = one_equation("x/x - 3", "2");
  const Solution motion = solve(pole, pole.scene("default"), {});
  EXPECT_EQ(motion.trajectory().status, Status::singularity);
  const Model never = one_equation("sqrt(x - 5)^2", "1");
  const Solution none = solve(never, never.scene("default"), {});
  EXPECT_EQ(none.trajectory().status, Status::singularity);
  EXPECT_EQ(none.trajectory().time, 0);
  EXPECT_EQ(none.trajectory().state, std::vector<double>{1});
  const Model fine = one_equation("sqrt(x)^2 - 2", "1/2");
  EXPECT_TRUE(solve(fine, fine.scene("default"), {}).ok());
}

/// What a parameter makes of them may be a constant that is no real number, or none at all.
TEST(CancelledParts, OfAParameterHaveToBeReal) {
  const auto motion_with = [](const std::string& rate, const std::string& value) {
    const Model model = model_of(
        "title = \"t\"\n[phase_space]\nvariables = [\"x\"]\n[parameters]\na = {}\n"
        "[equations]\nx = \"" +
        rate + "\"\n[[scene]]\nname = \"default\"\ninitial = { x = \"1\" }\nparameters = { a = \"" +
        value + "\" }\nduration = \"1\"\n");
    return solve(model, model.scene("default"), {}).ok();
  };
  EXPECT_TRUE(motion_with("sqrt(a)*sqrt(a)", "2"));
  EXPECT_THROW(motion_with("sqrt(a)*sqrt(a)", "-1"), ModelError);
  EXPECT_TRUE(motion_with("acos(a) + acos(-a)", "1/2"));
  EXPECT_THROW(motion_with("acos(a) + acos(-a)", "2"), ModelError);
  EXPECT_TRUE(motion_with("1 + atan2(a, a)", "1"));
  EXPECT_THROW(motion_with("1 + atan2(a, a)", "0"), ModelError);
  EXPECT_THROW(motion_with("sn(1, a)", "1"), ModelError);
}

TEST(CancelledParts, ThatEveryStateHasAreNone) {
  const Model model = one_equation("x*2/2 + sqrt(4)", "1");
  EXPECT_TRUE(cancelled_parts(model, model.scene("default")).empty());
  EXPECT_TRUE(unwatched_parts(model, model.scene("default")).empty());
  const Model root = one_equation("sqrt(x)^2", "1");
  EXPECT_NE(unwatched_parts(root, root.scene("default")).find("sqrt(x)"), std::string::npos);
}

/// y + |x| is an integral where x > 0 alone, and the motion leaves that: a box around the motion is
/// made no smaller by it.
// Numbers in front of them, and other powers, are no reason to think that they cancel.
TEST(CancelledParts, AreNotThoseThatStandThereInAnotherForm) {
  for (const char* rate : {"-x/(1/100 + x^2)", "3*x^2/(2*x + 1/3)^3", "1/(2*x) + 1/(x/3 + 1)^2"}) {
    const Model model = one_equation(rate, "1");
    EXPECT_EQ(unwatched_parts(model, model.scene("default")), "") << rate;
  }
  const Model cancels = one_equation("x*(x + 1)/(x + 1)", "1");
  EXPECT_NE(unwatched_parts(cancels, cancels.scene("default")), "");
}

TEST(Validated, AnIntegralThatNeedsAnAssumptionOnVariablesContractsNothing) {
  const Model model = model_of(
      "title = \"t\"\n[phase_space]\nvariables = [\"x\", \"y\"]\ndomain = [\"x > "
      "0\"]\n[equations]\n"
      "x = \"-1\"\ny = \"1\"\n[integrals]\nF = \"y + abs(x)\"\n[[scene]]\nname = \"default\"\n"
      "initial = { x = \"1\", y = \"0\" }\nduration = \"2\"\n");
  ValidatedOptions options;
  options.initial_radius = cln::cl_RA(1) / 10;
  const ValidatedMotion motion = enclosed(model, options);
  ASSERT_EQ(motion.run.status, ValidatedStatus::ok) << motion.run.reason;
  EXPECT_TRUE(motion.run.contracted_by.empty());
  ASSERT_EQ(motion.doubts.size(), 1U);
  EXPECT_LE(value(motion.run.end.states[1].low), 1.9);
  EXPECT_GE(value(motion.run.end.states[1].high), 2.1);
}

}  // namespace
}  // namespace casimir::test
