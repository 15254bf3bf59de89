// How far a run can be believed: what `integrate` warns of, refuses, and says of its accuracy.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/tools/program.hpp"

namespace casimir::test {
namespace {

/// A free top whose constant of motion is `integral`.
std::string top(const std::string& initial, const std::string& duration,
                const std::string& integral = "M1^2 + M2^2 + M3^2") {
  return "title = \"top\"\nhamiltonian = \"(M1^2 + 2*M2^2 + 3*M3^2)/2\"\n[phase_space]\n"
         "variables = [\"M1\", \"M2\", \"M3\"]\nalgebra = \"so(3)\"\n[integrals]\nF = \"" +
         integral + "\"\n[[scene]]\nname = \"default\"\ninitial = { " + initial +
         " }\nduration = \"" + duration + "\"\n";
}

struct Answered {
  int status;
  nlohmann::ordered_json json;
};

Answered integrated(const std::string& text, std::vector<std::string> more = {}) {
  const Folder folder;
  const std::string file = folder.write("scene.toml", text);
  std::vector<std::string> arguments{"integrate", file, "--json"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const Outcome outcome = run_in(folder, arguments);
  EXPECT_TRUE(outcome.status == 0 || outcome.status == 5) << outcome.err;
  return {outcome.status, outcome.json()};
}

TEST(Trust, InvariantsBeyondTheRangeOfDoubleAreRight) {
  for (const auto& [size, duration, square] :
       {std::tuple{"200", "10*10^(-200)", "e+400"}, std::tuple{"(-200)", "10*10^200", "e-400"},
        std::tuple{"0", "10", ""}}) {
    const std::string factor = "*10^" + std::string(size);
    const Answered run = integrated(
        top("M1 = \"3" + factor + "\", M2 = \"1/10" + factor + "\", M3 = \"4" + factor + "\"",
            duration));
    EXPECT_EQ(run.status, 0);
    const auto& invariants = run.json.at("invariants");
    for (const char* name : {"H", "F"}) {
      const std::string value = invariants.at(name).at("initial");
      // 9 + 1/100 + 16 and (9 + 2/100 + 48)/2
      EXPECT_EQ(value.substr(0, 4), name[0] == 'F' ? *square ? "2.50" : "25.0"
                                    : *square      ? "2.85"
                                                   : "28.5")
          << value;
      const double read = std::strtod(value.c_str(), nullptr);
      EXPECT_EQ(std::isinf(read) || read == 0, *square != 0) << value;
      const double drift = number(invariants.at(name).at("drift"));
      EXPECT_LT(drift, 1e-13) << size;
    }
    EXPECT_GT(number(invariants.at("H").at("drift")) + number(invariants.at("F").at("drift")), 0);
  }
}

TEST(Trust, ProvedIntegralThatDriftsTooFarEndsTheRun) {
  // A bend of the potential so narrow that the error estimate of a collocation method does not see
  // it.
  const std::string kink =
      "title = \"kink\"\nhamiltonian = \"p^2/2 + sqrt(q^2 + 10^(-16))\"\n[phase_space]\nvariables "
      "= [\"q\", "
      "\"p\"]\ncanonical = true\n[[scene]]\nname = \"default\"\ninitial = { q = \"1\", p = "
      "\"1/10\" }\nduration = \"40\"\n";
  const Answered lost = integrated(kink, {"--method", "gauss4", "--tolerance", "1e-6"});
  EXPECT_EQ(lost.status, 5);
  EXPECT_EQ(lost.json.at("status"), "drift_exceeded");
  const std::string reason = lost.json.at("stopped").at("reason");
  EXPECT_NE(reason.find("H is proved"), std::string::npos) << reason;
  EXPECT_GT(number(lost.json.at("invariants").at("H").at("drift")), 0.1);
}

TEST(Trust, FunctionThatIsNoIntegralAccusesItselfAndNotTheRun) {
  const Answered run =
      integrated(top("M1 = \"1\", M2 = \"1/2\", M3 = \"2\"", "10", "M1^2 + M2^2 + M3"));
  EXPECT_EQ(run.status, 0);
  EXPECT_EQ(run.json.at("status"), "ok");
  const std::string warnings = run.json.at("warnings").dump();
  EXPECT_NE(warnings.find("refuted"), std::string::npos) << warnings;
  EXPECT_EQ(
      integrated(top("M1 = \"1\", M2 = \"1/2\", M3 = \"2\"", "10")).json.at("warnings").size(), 0U);
}

TEST(Trust, ConditioningIsThatOfTheFlow) {
  // x'' = x: the flow's derivative is cosh and sinh, and its larger column at t = 10 is exp(10)/2,
  // along a solution that has grown as much itself; exp(-t) has not.
  const auto saddle = [](const char* p) {
    return std::string("title = \"saddle\"\nhamiltonian = \"(p^2 - q^2)/2\"\n[phase_space]\n") +
           "variables = [\"q\", \"p\"]\ncanonical = true\n[[scene]]\nname = \"default\"\ninitial = "
           "{ q = \"1\", p = \"" +
           p + "\" }\nduration = \"10\"\n";
  };
  const Answered falling = integrated(saddle("-1"));
  EXPECT_NEAR(number(falling.json.at("trust").at("conditioning")), std::cosh(10.), 200);
  const Answered rotor = integrated(
      "title = \"circle\"\nhamiltonian = \"(p^2 + q^2)/2\"\n[phase_space]\nvariables = [\"q\", "
      "\"p\"]\ncanonical = true\n[[scene]]\nname = \"default\"\ninitial = { q = \"1\", p = \"0\" "
      "}\nduration = \"1000\"\n");
  // A rotation: the sum of the entries of a row, |cos| + |sin|, is at most sqrt(2).
  EXPECT_NEAR(number(rotor.json.at("trust").at("conditioning")), 1.2, 0.25);
}

TEST(Trust, EndBeyondDoublePrecisionIsSaidWithTheTimeThatSixDigitsHold) {
  const std::string saddle =
      "title = \"saddle\"\nhamiltonian = \"(p^2 - q^2)/2\"\n[phase_space]\nvariables = [\"q\", "
      "\"p\"]\ncanonical = true\n[[scene]]\nname = \"default\"\ninitial = { q = \"1\", p = \"-1\" "
      "}\nduration = \"50\"\n";
  const Answered run = integrated(saddle);
  const auto& trust = run.json.at("trust");
  EXPECT_EQ(trust.at("beyond_double"), true);
  // 2^-53 exp(t)/2 = 1e-6
  EXPECT_NEAR(number(trust.at("six_digits_until")), std::log(2e-6 * 0x1p53), 2);
  EXPECT_NE(run.json.at("warnings").dump().find("--digits"), std::string::npos);
  EXPECT_EQ(integrated(saddle, {"--duration", "5"}).json.at("trust").at("beyond_double"), false);
}

TEST(Trust, NearlySingularCoordinatesAreNamed) {
  // A particle that passes the centre of polar coordinates at a distance of 1e-5.
  const auto passing = [](const char* momentum) {
    return "title = \"polar\"\nhamiltonian = \"(pr^2 + pphi^2/r^2)/2\"\n[phase_space]\nvariables = "
           "[\"r\", \"phi\", \"pr\", \"pphi\"]\ncanonical = true\n[[scene]]\nname = \"default\"\n"
           "initial = { r = \"1\", phi = \"0\", pr = \"-1\", pphi = \"" +
           std::string(momentum) + "\" }\nduration = \"2\"\n";
  };
  const std::string near = integrated(passing("1/100000")).json.dump();
  EXPECT_NE(near.find("nearly singular"), std::string::npos) << near;
  EXPECT_NE(near.find("r = 1.00"), std::string::npos) << near;
  EXPECT_EQ(integrated(passing("1/2")).json.dump().find("nearly singular"), std::string::npos);
}

TEST(Trust, StepOverAPoleIsSaid) {
  // 0/q^2 at q = 0: no method notices, and the equations have no value there.
  const auto through = [](const char* end) {
    return "title = \"pole\"\nhamiltonian = \"p^2/2 + s^2/q^2\"\n[phase_space]\nvariables = "
           "[\"q\", "
           "\"p\", \"s\"]\nbrackets = { \"q,p\" = \"1\" }\n[[scene]]\nname = \"default\"\ninitial "
           "= { q "
           "= \"1\", p = \"-1\", s = \"0\" }\nduration = \"" +
           std::string(end) + "\"\n";
  };
  const std::string over =
      integrated(through("3"), {"--method", "dop853"}).json.at("warnings").dump();
  EXPECT_NE(over.find("changes its sign"), std::string::npos) << over;
  const std::string before =
      integrated(through("1/2"), {"--method", "dop853"}).json.at("warnings").dump();
  EXPECT_EQ(before.find("changes its sign"), std::string::npos) << before;
}

TEST(Trust, LongRunsAreExtrapolated) {
  const std::string text = top("M1 = \"1\", M2 = \"1/2\", M3 = \"2\"", "20000");
  const Answered run = integrated(text);
  const auto& trust = run.json.at("trust");
  ASSERT_TRUE(trust.contains("extrapolated_from")) << trust;
  EXPECT_LT(number(trust.at("extrapolated_from")), 20000);
  // The phase of an integrable motion changes in proportion to the time.
  const Answered part = integrated(text, {"--duration", "1000"});
  EXPECT_FALSE(part.json.at("trust").contains("extrapolated_from"));
  const double ratio =
      number(trust.at("conditioning")) / number(part.json.at("trust").at("conditioning"));
  EXPECT_GT(ratio, 10);
  EXPECT_LT(ratio, 40);
}

TEST(Trust, RunThatATighterToleranceDoesNotConfirmIsDoubted) {
  std::vector<std::string> arguments{"integrate",   "kovalevskaya", "--method", "dop853",
                                     "--tolerance", "1e-6",         "--json"};
  const auto first = run(arguments).json();
  const int steps = first.at("steps").get<int>() + first.at("rejected").get<int>();
  // Enough for this run, and too few for one with a hundredth of the tolerance.
  arguments.insert(arguments.end(), {"--max-steps", std::to_string(steps + 1)});
  const Outcome outcome = run(arguments);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.json().at("warnings").dump().find("nothing confirms"), std::string::npos);
}

/// The equations of a top with an axis of symmetry have the square of p_phi cos(theta) - p_psi in
/// them, 10^(-16) here, which is nothing but rounding where it is multiplied out.
TEST(Trust, ATopThatPassesItsPoleIsFollowed) {
  for (const char* method : {"taylor", "dop853"}) {
    const Outcome outcome = run({"integrate", "euler-angles", "--scene", "symmetric-pole-1e-8",
                                 "--method", method, "--tolerance", "1e-12", "--json"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const auto state = outcome.json().at("state");
    EXPECT_NEAR(number(state.at("theta")), 0.0709067874831549, 1e-8) << method;
    EXPECT_NEAR(number(state.at("psi")), 25.460458122620935, 1e-6) << method;
  }
}

/// An oscillator that is pushed from rest, and comes back to it: x = (2 sin(t) - sin(2 t))/6.
TEST(Trust, StepsOfOneSizeBeginAtZero) {
  const std::string text =
      "[phase_space]\nvariables = [\"x\", \"v\"]\ntime = \"t\"\n"
      "[equations]\nx = \"v\"\nv = \"-4*x + sin(t)\"\n"
      "[[scene]]\nname = \"default\"\ninitial = { x = \"0\", v = \"0\" }\nduration = \"20\"\n";
  const double truth = (2 * std::sin(20.) - std::sin(40.)) / 6;
  for (const char* method : {"midpoint", "gauss8"}) {
    const Answered run = integrated(text, {"--method", method, "--step", "0.1"});
    ASSERT_EQ(run.status, 0) << run.json;
    const double error = std::abs(number(run.json.at("state").at("x")) - truth);
    EXPECT_LT(error, 3 * number(run.json.at("trust").at("error_estimate")) + 1e-11) << method;
    EXPECT_EQ(run.json.at("warnings").dump().find("--tolerance"), std::string::npos) << method;
  }
}

TEST(Auto, GivesStiffScenesToRadauAndSmoothOnesToTaylorSeries) {
  const Outcome stiff = run({"integrate", "robertson", "--json"});
  ASSERT_EQ(stiff.status, 0) << stiff.err;
  const auto json = stiff.json();
  EXPECT_EQ(json.at("method"), "radau9");
  EXPECT_NE(json.at("chosen").get<std::string>().find("stiff"), std::string::npos);
  // Hairer & Wanner, Solving Ordinary Differential Equations II, IV.10
  EXPECT_NEAR(number(json.at("state").at("y1")), 0.7158270687193941, 1e-13);
  EXPECT_LT(json.at("steps"), 1000);
  const Outcome smooth = run({"integrate", "kovalevskaya", "--json"});
  EXPECT_EQ(smooth.json().at("method"), "taylor");
  EXPECT_LT(number(smooth.json().at("trust").at("error_estimate")), 1e-12);
  // A fast spin is no stiffness: nothing decays.
  const Answered fast = integrated(top("M1 = \"1\", M2 = \"1/2\", M3 = \"20000\"", "1"));
  EXPECT_GT(fast.json.at("steps"), 1000);
  EXPECT_EQ(fast.json.at("method"), "taylor");
}

/// A function that is no integral changes however well the state is known.
TEST(Trust, ARefutedIntegralSaysNothingOfTheState) {
  const Folder folder;
  const auto error = [&](const std::string& more) {
    folder.write("o.toml",
                 "title = \"t\"\nhamiltonian = \"(p^2+q^2)/2\"\n[phase_space]\nvariables = [\"q\", "
                 "\"p\"]\ncanonical = true\n" +
                     more +
                     "[[scene]]\nname = \"default\"\ninitial = { q = \"1\", p = \"0\" }\nduration "
                     "= \"100\"\n");
    const auto json = run_in(folder, {"integrate", "./o.toml", "--json"}).json();
    return std::stod(json.at("trust").at("error_estimate").get<std::string>());
  };
  EXPECT_LT(error("[integrals]\nK = \"log(q + 3)\"\n"), 1e-12);
  EXPECT_LT(error(""), 1e-12);
}

/// log(x^2 + y^2) is 0 on the unit circle, acos(x^2 + y^2) on the edge of its domain, sign(x)
/// jumps, and what has no value at the start says nothing: the states are right.
TEST(Trust, IntegralsWithTheValueZeroOrJumpsDoNotRefuseARightRun) {
  for (const char* integral :
       {"log(x^2 + y^2)", "sin(x^2 + y^2 - 1)", "atan2(x^2 + y^2 - 1, 1)", "acos(x^2 + y^2)",
        "sqrt(x^2 + y^2 - 1)", "sign(x)*(x^2 + y^2)", "sqrt(x^2 + y^2 - 2)"}) {
    const Folder folder;
    folder.write(
        "o.toml",
        "title = \"t\"\n[phase_space]\nvariables = [\"x\", \"y\"]\n[equations]\nx = \"y\"\n"
        "y = \"-x\"\n[integrals]\nF = \"" +
            std::string(integral) +
            "\"\n[[scene]]\nname = \"default\"\ninitial = { x = \"3/5\", y = \"4/5\" }\n"
            "duration = \"10\"\n");
    const Outcome outcome = run_in(folder, {"integrate", "./o.toml"});
    EXPECT_EQ(outcome.status, 0) << integral << outcome.err;
  }
}

/// u is zero at the start and stays a thousand million times smaller than x.
TEST(Trust, ASmallStateThatBeginsAtZeroIsNamedToo) {
  const Folder folder;
  folder.write(
      "small.toml",
      "title = \"t\"\n[phase_space]\nvariables = [\"x\", \"y\", \"u\", \"w\"]\n[equations]\n"
      "x = \"y\"\ny = \"-x\"\nu = \"10^(-11)*x - 20*u\"\nw = \"-w*x\"\n[[scene]]\nname = "
      "\"default\"\ninitial = { x = \"1\", y = \"0\", u = \"0\", w = \"0\" }\nduration = "
      "\"20\"\n");
  const Outcome outcome = run_in(folder, {"integrate", "./small.toml"});
  EXPECT_NE(outcome.out.find("says nothing of u:"), std::string::npos) << outcome.out;
}

TEST(Trust, AToleranceBesideAConstantStepIsSaidToBoundNothing) {
  const auto warnings = [](std::vector<std::string> more) {
    std::vector<std::string> words{"integrate", "euler", "--method", "dop853", "--json"};
    words.insert(words.end(), more.begin(), more.end());
    return run(words).json().at("warnings").dump();
  };
  const char* const said = "the tolerance bounds nothing";
  EXPECT_TRUE(has(warnings({"--step", "0.25", "--rtol", "1e-9"}), said));
  EXPECT_FALSE(has(warnings({"--step", "0.25"}), said));
  EXPECT_FALSE(has(warnings({"--rtol", "1e-9"}), said));
}

}  // namespace
}  // namespace casimir::test
