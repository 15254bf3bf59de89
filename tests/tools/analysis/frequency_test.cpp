// Frequencies and rotation numbers, against closed forms and signals that are known.
#include <gtest/gtest.h>

#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/ellint_3.hpp>
#include <cmath>
#include <numbers>

#include "tests/tools/analysis/systems.hpp"
#include "tools/analysis/frequency/analysed_motion.hpp"
#include "tools/analysis/frequency/motion_frequencies.hpp"
#include "tools/analysis/frequency/rotation.hpp"
#include "tools/analysis/frequency/spectrum.hpp"

namespace casimir::test {
namespace {

constexpr double kTurns = 2 * std::numbers::pi;
const double kGolden = (std::sqrt(5.) - 1) / 2;

TEST(Spectrum, TellsEachLineOfAQuasiperiodicSignal) {
  std::vector<double> signal;
  for (int j = 0; j < 2000; ++j)
    signal.push_back(0.3 + std::cos(kTurns * (kGolden - 0.4) * j + 0.3) /
                               (1.3 + std::sin(kTurns * 0.0831234567 * j)));
  const Spectrum spectrum = spectrum_of(std::span<const double>(signal), 6);
  ASSERT_EQ(spectrum.lines.size(), 6U);
  for (const SpectralLine& line : spectrum.lines) {
    double nearest = 1;
    for (int a = 0; a <= 1; ++a)
      for (int b = -8; b <= 8; ++b) {
        const double f = a * (kGolden - 0.4) + b * 0.0831234567;
        nearest = std::min(nearest, std::abs(std::remainder(std::abs(f) - line.frequency, 1)));
      }
    EXPECT_LT(nearest, 1e-8);
    EXPECT_LT(nearest, 10 * line.error + 1e-15);
    EXPECT_TRUE(line.in_both_halves);
  }
}

TEST(Spectrum, LinesOfNoiseAreNotInBothHalves) {
  std::vector<double> signal;
  double x = 0.3;
  for (int j = 0; j < 2000; ++j) signal.push_back(x = 3.99 * x * (1 - x));
  const Spectrum spectrum = spectrum_of(std::span<const double>(signal), 6);
  int settled = 0;
  for (const SpectralLine& line : spectrum.lines)
    settled += line.frequency > 0 && line.error < 1e-6 ? 1 : 0;
  EXPECT_EQ(settled, 0);
}

TEST(Spectrum, SaysWhereLinesMayBeFoldedBack) {
  std::vector<double> slow, fast;
  for (int j = 0; j < 1000; ++j) {
    slow.push_back(std::sin(0.1 * j));
    fast.push_back(1 / (1.01 + std::sin(1.3 * j)));
  }
  EXPECT_LT(spectrum_of(std::span<const double>(slow), 2).near_folding, kFolded);
  EXPECT_GT(spectrum_of(std::span<const double>(fast), 2).near_folding, 0.01);
}

/// An orbit on a closed curve: not a circle, and not run through evenly.
OrbitPoints on_curve(double number, int count, int waves) {
  OrbitPoints points{.dimension = 2, .coordinates = {}, .places = {}, .periods = {}};
  for (int j = 0; j < count; ++j) {
    const double angle = kTurns * number * j + 0.3, radius = 1 + 0.3 * std::cos(waves * angle);
    const double x = 2 * radius * std::cos(angle), y = radius * std::sin(angle) / 2;
    points.coordinates.insert(points.coordinates.end(), {x, y});
    points.places.push_back({x, y});
  }
  return points;
}

TEST(Rotation, IsTheTurnOfTheCurveAndNoMultipleOfIt) {
  for (const double number : {kGolden, 1 - kGolden, std::numbers::pi - 3, std::sqrt(2.) / 3})
    for (const int waves : {1, 2, 3, 5}) {
      const Rotation rotation = rotation_of(on_curve(number, 500, waves));
      EXPECT_EQ(rotation.kind, Rotation::Kind::curve) << number << " " << waves;
      EXPECT_NEAR(rotation.number, number, 1e-12) << waves;
      EXPECT_TRUE(rotation.directed);
    }
}

TEST(Rotation, SaysNothingWhereTheOrbitIsTooShort) {
  EXPECT_EQ(rotation_of(on_curve(1e-4, 500, 1)).kind, Rotation::Kind::none);
  EXPECT_EQ(rotation_of(on_curve(kGolden, 20, 1)).kind, Rotation::Kind::none);
  // Next to a resonance the points leave the curve open.
  EXPECT_EQ(rotation_of(on_curve(1. / 3 + 1e-5, 500, 2)).kind, Rotation::Kind::none);
}

TEST(Rotation, CyclesAndFixedPointsAreNamed) {
  const Rotation cycle = rotation_of(on_curve(2. / 5, 200, 1));
  EXPECT_EQ(cycle.kind, Rotation::Kind::cycle);
  EXPECT_EQ(cycle.parts, 5U);
  EXPECT_NEAR(cycle.number, 0.4, 1e-15);
  EXPECT_EQ(rotation_of(on_curve(1, 200, 1)).parts, 1U);
}

/// Chirikov's standard map; the angle goes to 2 Pi.
OrbitPoints standard_map(double strength, double angle, double action, int count,
                         double* lift = nullptr) {
  OrbitPoints points{.dimension = 3, .coordinates = {}, .places = {}, .periods = {kTurns, 0}};
  double sum = 0;
  for (int j = 0; j < count; ++j) {
    action += strength * std::sin(angle);
    angle = std::remainder(angle + action, kTurns);
    sum += action;
    points.coordinates.insert(points.coordinates.end(), {std::cos(angle), std::sin(angle), action});
    points.places.push_back({angle, action});
  }
  if (lift) *lift = sum / count / kTurns;
  return points;
}

TEST(Rotation, AgreesWithTheMeanAdvanceOfTheStandardMap) {
  for (const double action : {2., 2.5, 3.88}) {
    double lift = 0;
    const Rotation rotation = rotation_of(standard_map(0.5, 0.3, action, 2000, &lift));
    EXPECT_EQ(rotation.kind, Rotation::Kind::curve);
    EXPECT_NEAR(rotation.number, lift, 1e-4);
    EXPECT_LT(rotation.error, 1e-12);
  }
}

TEST(Rotation, IslandsAreNoCurve) {
  const Rotation rotation = rotation_of(standard_map(0.5, 0.3, 3, 2000));
  EXPECT_EQ(rotation.kind, Rotation::Kind::islands);
  EXPECT_EQ(rotation.parts, 2U);
  EXPECT_NEAR(rotation.number, 0.5, 1e-15);
}

TEST(Rotation, ChaosHasNone) {
  EXPECT_EQ(rotation_of(standard_map(5, 0.3, 1, 2000)).kind, Rotation::Kind::none);
  EXPECT_EQ(rotation_of(standard_map(0.9716, 0.01, 0.01, 2000)).kind, Rotation::Kind::none);
}

/// What is found in the scene 'default'.
MotionFrequencies found_in(const Model& model, std::size_t lines,
                           const std::string& method = "auto") {
  const Scene& scene = model.scene("default");
  const PreparedScene run = prepare(model, scene);
  return analysed_motion(model, scene, run, {.method = method}, lines).found;
}

/// q'' = -w^2 q from (1, 0), up to a time.
MotionFrequencies of_oscillator(const std::string& w, const std::string& duration,
                                std::size_t lines, const std::string& method = "auto") {
  const Model model =
      model_of("title = \"t\"\n[phase_space]\nvariables = [\"q\", \"p\"]\n[equations]\nq = \"" + w +
               "*p\"\np = \"-" + w + "*q\"\n[[scene]]\nname = \"default\"\n" +
               "initial = { q = \"1\", p = \"0\" }\nduration = \"" + duration + "\"\n");
  return found_in(model, lines, method);
}

/// A method moves the frequency, sharply in both halves of the run.
TEST(AnalysedMotion, ErrorsHoldWhatTheMethodAdds) {
  for (const char* method : {"dop853", "dopri5", "gauss8", "cvode-bdf", "auto"}) {
    const MotionFrequencies found = of_oscillator("sqrt(2)", "1000", 1, method);
    ASSERT_EQ(found.base.size(), 1U) << method;
    EXPECT_NEAR(found.base[0], std::numbers::sqrt2, found.base_errors[0]) << method;
    EXPECT_LT(found.base_errors[0], 1e-8) << method;
    const MotionLine& line = found.variables[0].lines.at(0);
    EXPECT_NEAR(line.frequency, std::numbers::sqrt2, line.error) << method;
    EXPECT_LT(line.error, 1e-8) << method;
  }
  EXPECT_LT(of_oscillator("sqrt(2)", "1000", 1, "auto").base_errors[0], 1e-13);
}

TEST(AnalysedMotion, WhatIsNotKnownOfTinyVariablesIsSaid) {
  const auto warnings = [](const std::string& size) {
    const Model model = model_of(
        "title = \"t\"\n[phase_space]\nvariables = [\"x\", \"y\", \"u\", \"v\"]\n[equations]\n"
        "x = \"y\"\ny = \"-x\"\nu = \"v\"\nv = \"-2*u\"\n[[scene]]\nname = \"default\"\n"
        "initial = { x = \"1\", y = \"0\", u = \"" +
        size + "\", v = \"0\" }\nduration = \"1000\"\n");
    return found_in(model, 1, "dop853").warnings;
  };
  EXPECT_TRUE(warnings("1/10").empty());
  const std::vector<std::string> said = warnings("10^(-10)");
  ASSERT_FALSE(said.empty());
  EXPECT_NE(said.back().find("tiny"), std::string::npos) << said.back();
}

/// The second line is of the size of the method's error, and no sign of faster motion.
TEST(AnalysedMotion, ALineThatTheMethodMakesHidesNoBase) {
  for (const char* method : {"dop853", "gauss8"}) {
    const MotionFrequencies found = of_oscillator("sqrt(2)", "300", 2, method);
    ASSERT_FALSE(found.base.empty()) << method;
    EXPECT_NEAR(found.base[0], std::numbers::sqrt2, found.base_errors[0]) << method;
    EXPECT_LT(found.base_errors[0], 1e-8) << method;
  }
}

/// Samples at 4096 times in 1000 would show 20 at 5.7359, as sharply as if it were there.
TEST(AnalysedMotion, AFastLineIsNotSeenFolded) {
  for (const char* w : {"20", "100"}) {
    const MotionFrequencies found = of_oscillator(w, "1000", 2);
    ASSERT_EQ(found.base.size(), 1U) << w;
    EXPECT_NEAR(found.base[0], std::stod(w), 1e-10);
    EXPECT_TRUE(found.settled);
    EXPECT_TRUE(found.warnings.empty()) << found.warnings.front();
  }
}

/// The strong line is in its place and would hide that the weak one, of the force, is not.
TEST(AnalysedMotion, AWeakFastLineIsNotSeenFolded) {
  for (const char* force : {"1/10*cos(40*t)", "10^(-3)*cos(40*t)", "1/10*cos((47 + 1/7)*t)"}) {
    const Model model = model_of(
        "title = \"t\"\n[phase_space]\nvariables = [\"x\", \"u\"]\ntime = \"t\"\n[equations]\nx = "
        "\"u\"\nu = \"-x + " +
        std::string(force) +
        "\"\n[[scene]]\nname = \"default\"\ninitial = { x = \"1\", u = \"0\" }\nduration = "
        "\"500\"\n");
    const MotionFrequencies found = found_in(model, 3);
    ASSERT_EQ(found.base.size(), 2U) << force;
    const double fast = std::string(force).find("47") == std::string::npos ? 40 : 47 + 1. / 7;
    EXPECT_NEAR(found.base[0], 1, 1e-10);
    EXPECT_NEAR(found.base[1], fast, 1e-9);
  }
}

TEST(AnalysedMotion, WhatIsFasterThanAnySamplesIsSaidToBe) {
  const MotionFrequencies found = of_oscillator("1000", "830", 1);  // 262144 samples tell 992
  EXPECT_FALSE(found.settled);
  EXPECT_TRUE(found.base.empty());
  ASSERT_FALSE(found.warnings.empty());
}

TEST(AnalysedMotion, RoundingIsNoBase) {
  for (const char* duration : {"200", "1000", "3000"}) {
    const MotionFrequencies found = of_oscillator("1", duration, 4);
    ASSERT_EQ(found.base.size(), 1U) << duration;
    EXPECT_NEAR(found.base[0], 1, 1e-10);
  }
}

/// Two lines of which the run sees no beat are one, which is told.
TEST(MotionFrequencies, LinesThatAreTooNearToBeToldApartAreAWarning) {
  for (const double apart : {1e-3, 1e-4, 1e-5}) {
    SampledMotion motion{{"w"}, {false}, {}, 0.25};
    for (int j = 0; j < 4096; ++j)
      motion.states.push_back({std::cos(0.25 * j) + std::cos((1 + apart) * 0.25 * j)});
    EXPECT_FALSE(frequencies_of(motion, 3).warnings.empty()) << apart;
  }
}

// Lines at w and -w of one size: the last that is asked for may be either.
TEST(MotionFrequencies, TwinsAreOneLineInBothHalves) {
  const Model pendulum = model_of(
      "hamiltonian = \"p^2/2 - cos(q)\"\n[phase_space]\ncanonical = true\n"
      "variables = [\"q\", \"p\"]\n[[scene]]\nname = \"default\"\n"
      "initial = { q = \"0\", p = \"1\" }\nduration = \"300\"\n");
  for (const std::size_t lines : {2U, 4U, 5U, 6U}) {
    const MotionFrequencies found = found_in(pendulum, lines);
    ASSERT_EQ(found.base.size(), 1U) << lines;
    // pi/(2 K(1/2)), of which the lines of the angle are multiples
    const double w = std::numbers::pi / (2 * boost::math::ellint_1(0.5));
    EXPECT_NEAR(std::remainder(found.base[0], w / 2), 0, 1e-10) << lines;
  }
}

// 1 and 1.001 in two variables: the base may not have one of them alone.
TEST(MotionFrequencies, LinesOfTwoVariablesThatAreNearAreNotOne) {
  SampledMotion motion{{"q1", "q2"}, {false, false}, {}, 0.25};
  for (int j = 0; j < 801; ++j)
    motion.states.push_back({std::cos(0.25 * j), 0.6 * std::sin(1.001 * 0.25 * j + 1)});
  const MotionFrequencies found = frequencies_of(motion, 1);
  EXPECT_NE(found.base.size(), 1U);
  EXPECT_TRUE(found.base.size() == 2 || !found.warnings.empty());
}

}  // namespace
}  // namespace casimir::test
