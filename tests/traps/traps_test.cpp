// The tester itself: its expressions, its integrator, its judgement.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <csignal>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>

#include "tests/folder.hpp"
#include "tests/traps/fixed.hpp"
#include "tests/traps/generate.hpp"
#include "tests/traps/judge.hpp"
#include "tests/traps/reference.hpp"

namespace casimir::traps {
namespace {

TEST(TrapsFormula, HasThePrecedenceOfCaseFiles) {
  EXPECT_EQ(constant("-2^2"), -4);
  EXPECT_EQ(constant("2^-2"), 0.25L);
  EXPECT_EQ(constant("12/2/3*2 - 1 - 1"), 2);
  EXPECT_EQ(constant("2^3^2"), 512);
  EXPECT_EQ(constant("0.25e1"), 2.5L);
  EXPECT_EQ(constant("8^(1/3)"), 2);
  EXPECT_NEAR(static_cast<double>(constant("atan2(1, -1)/Pi")), 0.75, 1e-17);
  EXPECT_NEAR(static_cast<double>(constant("cosh(2)^2 - sinh(2)^2")), 1, 1e-17);
  EXPECT_NEAR(static_cast<double>(constant("tanh(2)*cosh(2)/sinh(2)")), 1, 1e-17);
  EXPECT_NEAR(static_cast<double>(constant("cot(1)*tan(1)")), 1, 1e-17);
  EXPECT_EQ(constant("abs(-3)*sign(-5) + sign(0)"), -3);
}

TEST(TrapsFormula, RefusesWhatIsNoExpression) {
  for (const char* text : {"", "1 +", "y", "sin 1", "(1", "1)", "f(1)"})
    EXPECT_THROW(constant(text), std::runtime_error) << text;
}

TEST(TrapsFormula, KnowsDefinitionsInTheirOrder) {
  Formulas f({"x"}, {{"a", "x + 1"}, {"b", "a^2"}}, {"b - a"});
  const Real x = 2;
  Real value = 0;
  f(&x, &value);
  EXPECT_EQ(value, 6);
}

Real distance(const std::vector<Real>& a, const Truth& b) {
  Real largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    largest = std::max(largest, std::abs(a[i] - b.state[i]) / std::max(b.sizes[i], 1e-300L));
  return largest;
}

/// Every shape that has a closed form, without it, where the integrator can know how to step.
TEST(TrapsReference, AgreesWithEveryClosedForm) {
  std::map<std::string, int> certain;
  int uncertain = 0;
  for (std::uint64_t i = 0; i < 400; ++i) {
    const Scene scene = generated(5, i);
    if (!scene.exact || scene.limit.empty() || certain[scene.shape] >= 3) continue;
    const auto truth = reference(scene);
    if (!truth) {
      ++uncertain;
      continue;
    }
    ++certain[scene.shape];
    EXPECT_LT(distance(*scene.exact, *truth), 1e-10L) << scene.text();
  }
  EXPECT_GE(certain.size(), 6U);
  EXPECT_EQ(uncertain, 0);
}

/// The same of shapes whose time scale is 1, with kinks or not.
TEST(TrapsReference, AgreesWithClosedFormsAcrossKinks) {
  const std::set<std::string> shapes = {
      "sign-of-state", "ramp", "dead-zone-1", "dead-zone-2",    "parabola-dip", "absolute-value",
      "thrown-up",     "beat", "saddle",      "pushed-by-time", "asin-to-one"};
  std::set<std::string> seen;
  for (std::uint64_t i = 0; i < 400; ++i) {
    Scene scene = generated(6, i);
    if (!shapes.contains(scene.shape) || seen.contains(scene.shape)) continue;
    seen.insert(scene.shape);
    scene.limit = "1/500";
    const auto truth = reference(scene);
    ASSERT_TRUE(truth) << scene.text();
    EXPECT_LT(distance(*scene.exact, *truth), 1e-10L) << scene.text();
  }
  EXPECT_EQ(seen, shapes);
}

/// What the limit is for: the reference, too, sees no pulse between its points.
TEST(TrapsReference, IsBlindWithoutItsLimit) {
  Scene scene = {.kind = "",
                 .shape = "",
                 .variables = {"x"},
                 .time = "t",
                 .equations = {"1 + exp(-((t - 7)*1000)^2)*1000"},
                 .initial = {"0"},
                 .duration = "10"};
  const Real pulse = std::sqrt(std::acos(Real(-1)));
  const auto blind = integrate(scene);
  ASSERT_TRUE(blind);
  EXPECT_NEAR(static_cast<double>(blind->state[0]), 10, 1e-9);
  scene.limit = "sqrt(1/1000^2 + (t - 7)^2)/4";
  const auto truth = reference(scene);
  ASSERT_TRUE(truth);
  EXPECT_NEAR(static_cast<double>(truth->state[0] - 10 - pulse), 0, 1e-12);
}

/// A kink in the last part of a step, which the midpoint rule alone never asks for.
TEST(TrapsReference, SeesAKinkAtTheEndOfAStep) {
  for (const char* at : {"0.97", "0.99", "0.999"}) {
    Scene scene = {.kind = "",
                   .shape = "",
                   .variables = {"x"},
                   .time = "t",
                   .equations = {fmt::format("sqrt((t - {0})^2) + t - {0}", at)},
                   .initial = {"0"},
                   .duration = "1",
                   .limit = "1"};
    const auto truth = integrate(scene);
    ASSERT_TRUE(truth);
    const Real rest = 1 - constant(at);
    EXPECT_NEAR(static_cast<double>(truth->state[0] - rest * rest), 0, 1e-13) << at;
  }
}

TEST(TrapsReference, FollowsWhatDiesOutAndComesBack) {
  Scene scene = {.kind = "",
                 .shape = "",
                 .variables = {"x"},
                 .time = "t",
                 .equations = {"600*(t - 1)*x"},
                 .initial = {"1"},
                 .duration = "2",
                 .limit = "1/1000",
                 .small_matters = true};
  const auto truth = reference(scene);
  ASSERT_TRUE(truth);
  EXPECT_NEAR(static_cast<double>(truth->state[0]), 1, 1e-12);
}

TEST(TrapsReference, HasNoAnswerBeyondAPole) {
  const Scene scene = {.kind = "",
                       .shape = "",
                       .variables = {"x"},
                       .equations = {"x^2"},
                       .initial = {"1"},
                       .duration = "2",
                       .limit = "1/10"};
  EXPECT_FALSE(reference(scene));
}

TEST(TrapsScenes, AreTheSameEverywhereAndHaveEveryKind) {
  std::set<std::string> found;
  for (std::uint64_t i = 0; i < 200; ++i) {
    const Scene scene = generated(1, i);
    found.insert(scene.kind);
    EXPECT_EQ(scene.text(), generated(1, i).text());
    EXPECT_TRUE(scene.exact || scene.singular_at || !scene.limit.empty()) << scene.text();
    if (scene.exact) {
      EXPECT_EQ(scene.exact->size(), scene.variables.size()) << scene.text();
    }
  }
  const Texts names = kinds();
  EXPECT_EQ(found, std::set<std::string>(names.begin(), names.end()));
  EXPECT_NE(generated(1, 0).text(), generated(2, 0).text());
}

/// Scenes of one shape share a module: the files differ in the numbers of the scene alone.
TEST(TrapsScenes, OfOneShapeDifferInTheirNumbersAlone) {
  std::map<std::string, std::string> system;
  for (std::uint64_t i = 0; i < 800; ++i) {
    const Scene scene = generated(3, i);
    const std::string text = scene.text();
    const std::string head = text.substr(0, text.find("[[scene]]"));
    const auto [known, is_new] = system.emplace(scene.shape, head);
    EXPECT_EQ(known->second, head) << text;
  }
}

/// The published values, and those that the reference integrator gave.
TEST(TrapsScenes, OfFixedFilesEndWhereTheySay) {
  int compared = 0;
  for (Scene& scene : read_scenes(CASIMIR_SOURCE_DIR "/tests/traps/scenes")) {
    ASSERT_TRUE(scene.exact) << scene.shape;
    if (scene.limit.empty()) continue;
    const auto truth = integrate(scene);
    ASSERT_TRUE(truth) << scene.shape;
    EXPECT_LT(distance(*scene.exact, *truth), 1e-9L) << scene.shape;
    ++compared;
  }
  EXPECT_GE(compared, 30);
}

/// An oscillator at t = 1 with what a program says of it.
class TrapsJudge : public ::testing::Test {
 protected:
  TrapsJudge() { truth.state = {std::sin(Real(1))}; }

  Said answer(double x, const char* estimate, const char* warnings = "") const {
    Said said;
    said.status = 0;
    said.out = fmt::format(R"({{"state":{{"x":"{:.17g}"}},"tolerance":1e-15,"warnings":[{}],)"
                           R"("trust":{{"error_estimate":{}}}}})",
                           x, warnings, estimate);
    return said;
  }
  Said refusal(double time) const {
    Said said;
    said.status = 5;
    said.out = fmt::format(
        R"({{"state":{{"x":"0"}},"stopped":{{"time":"{:.17g}","reason":"a pole"}}}})", time);
    return said;
  }
  Outcome outcome(const Said& said) const { return judge(scene, truth, said).outcome; }

  Scene scene = {.kind = "",
                 .shape = "",
                 .variables = {"x"},
                 .time = "t",
                 .equations = {"cos(t)"},
                 .initial = {"0"},
                 .duration = "1"};
  Truth truth;
  const double good = std::sin(1.);
};

TEST_F(TrapsJudge, CallsATrueAnswerRight) {
  EXPECT_EQ(outcome(answer(good, "\"1e-16\"")), Outcome::right);
  EXPECT_EQ(outcome(answer(good, "null")), Outcome::right);
  EXPECT_EQ(outcome(answer(good, "\"1e-16\"", "\"in doubt\"")), Outcome::cautious);
}

TEST_F(TrapsJudge, CallsAWrongAnswerSilent) {
  const Verdict v = judge(scene, truth, answer(good + 1e-5, "\"1e-16\""));
  EXPECT_EQ(v.outcome, Outcome::silent);
  EXPECT_NEAR(static_cast<double>(v.error), 1e-5 / good, 1e-12);
  EXPECT_TRUE(is_failure(v.outcome));
  EXPECT_EQ(outcome(answer(good + 1e-5, "null")), Outcome::silent);
  EXPECT_EQ(outcome(answer(std::numeric_limits<double>::quiet_NaN(), "\"1\"")), Outcome::silent);
}

TEST_F(TrapsJudge, AcceptsAnErrorThatIsAdmitted) {
  EXPECT_EQ(outcome(answer(good + 1e-5, "\"1e-5\"")), Outcome::right);
  EXPECT_EQ(outcome(answer(good + 1e-3, "\"1e-5\"")), Outcome::silent);
  EXPECT_EQ(outcome(answer(good + 1e-3, "\"1e-5\"", "\"in doubt\"")), Outcome::warned);
  EXPECT_EQ(outcome(answer(good + 1, "\"1e-5\"", "\"in doubt\"")), Outcome::understated);
  EXPECT_EQ(outcome(answer(good + 1e9, "\"0.5\"", "\"in doubt\"")), Outcome::warned);
  EXPECT_EQ(outcome(answer(good + 1, "null", "\"in doubt\"")), Outcome::warned);
}

TEST_F(TrapsJudge, KnowsWhereASolutionEnds) {
  EXPECT_EQ(outcome(refusal(0.5)), Outcome::refused);
  scene.singular_at = 0.5L;
  EXPECT_EQ(outcome(refusal(0.4999)), Outcome::right);
  EXPECT_EQ(outcome(refusal(0.3)), Outcome::refused);
  EXPECT_EQ(outcome(answer(good, "\"1e-16\"")), Outcome::silent);
  EXPECT_EQ(outcome(answer(good, "\"1e-16\"", "\"in doubt\"")), Outcome::warned);
}

TEST_F(TrapsJudge, TellsCrashesAndHangsFromRefusals) {
  Said said;
  said.status = 128 + SIGSEGV;
  EXPECT_EQ(outcome(said), Outcome::broken);
  said.status = 0;
  said.out = "no JSON";
  EXPECT_EQ(outcome(said), Outcome::broken);
  said.status = 4;
  EXPECT_EQ(outcome(said), Outcome::refused);
  said.in_time = false;
  EXPECT_EQ(outcome(said), Outcome::hang);
}

TEST(TrapsProgram, IsEndedWhereItHangs) {
  const test::Folder folder;
  const std::string path = folder.path().string();
  const Said loop = run_program({"/bin/sh", "-c", "while :; do :; done"}, path, 1);
  EXPECT_FALSE(loop.in_time);
  EXPECT_GE(loop.seconds, 0.5);  // clocks of processors tick coarsely
  const Said says = run_program({"/bin/sh", "-c", "echo out; echo err >&2; exit 7"}, path, 5);
  EXPECT_TRUE(says.in_time);
  EXPECT_EQ(says.status, 7);
  EXPECT_EQ(says.out, "out\n");
  EXPECT_EQ(says.err, "err\n");
}

}  // namespace
}  // namespace casimir::traps
