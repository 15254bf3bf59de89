// Crossings of a surface by orbits in lanes: against closed forms.
#include "runtime/section.hpp"

#include <cmath>

#include "tests/codegen/run/ensemble_forms.hpp"

namespace casimir {
namespace {

using testing::equations;
using testing::lane_kernels;
using testing::specialised;

const double kPi = std::acos(-1.);

/// A system of equations with a function of its states as the integral `s`.
Specialisation with_function(const std::vector<std::pair<std::string, std::string>>& field,
                             const std::string& function) {
  SpecialiseOptions everything;
  everything.observe = std::vector<std::string>{};
  return specialised(equations(field, "[integrals]\ns = \"" + function + "\"\n"), everything);
}

SectionPlane plane_of(const Specialisation& s, bool upwards, double period = 0) {
  SectionPlane plane{s.invariants, upwards, period};
  plane.function.outputs = {s.invariants.outputs.back()};
  return plane;
}

SectionSettings section_settings(std::size_t states, std::size_t points) {
  SectionSettings settings;
  settings.points = points;
  settings.states = states;
  settings.jobs = 1;
  return settings;
}

/// x = sin(t + a), y = cos(t + a).
const std::vector<std::pair<std::string, std::string>> kCircle{{"x", "y"}, {"y", "-x"}};

TEST(Section, CrossingsOfACircleInOneDirection) {
  const Specialisation s = with_function(kCircle, "x - 1/2");
  for (const auto& [name, kernel] : lane_kernels(s)) {
    for (const bool upwards : {true, false}) {
      std::vector<double> seeds;
      for (int i = 0; i < 11; ++i)
        seeds.insert(seeds.end(), {std::sin(0.3 * i), std::cos(0.3 * i)});
      const SectionResult result =
          cut(kernel, plane_of(s, upwards), seeds, 2, section_settings(2, 50));
      for (int i = 0; i < 11; ++i) {
        const SectionOrbit& orbit = result.orbits[static_cast<std::size_t>(i)];
        ASSERT_EQ(orbit.size(), 50U) << name;
        EXPECT_EQ(orbit.status, Status::ok);
        double first = (upwards ? kPi / 6 : 5 * kPi / 6) - 0.3 * i;
        if (first <= 0) first += 2 * kPi;
        for (std::size_t n = 0; n < 50; ++n) {
          EXPECT_NEAR(orbit.times[n], first + 2 * kPi * static_cast<double>(n), 2e-12);
          EXPECT_NEAR(orbit.states[2 * n], 0.5, 1e-13);
          EXPECT_NEAR(orbit.states[2 * n + 1], (upwards ? 1 : -1) * std::sqrt(0.75), 1e-13);
        }
      }
    }
  }
}

TEST(Section, SeveralCrossingsInOneStepAreAllFound) {
  const Specialisation s = with_function(kCircle, "(x - 1/2)*(x - 51/100)*(x - 52/100)");
  const SectionResult result =
      cut(lane_kernels(s).front().second, plane_of(s, true), {0, 1}, 2, section_settings(2, 3));
  const SectionOrbit& orbit = result.orbits[0];
  ASSERT_EQ(orbit.size(), 3U);
  EXPECT_NEAR(orbit.times[0], kPi / 6, 1e-10);
  EXPECT_NEAR(orbit.times[1], std::asin(0.52), 1e-10);
  EXPECT_NEAR(orbit.times[2], kPi - std::asin(0.51), 1e-10);
  // The steps are far longer than the time between these crossings.
  EXPECT_GT(orbit.time / static_cast<double>(orbit.steps), 0.2);
}

/// Every function that a section may have: x runs evenly, so that crossings are where it says.
TEST(Section, FunctionsOfEveryKind) {
  const std::vector<std::pair<std::string, double>> functions{
      {"sqrt(1 + x^2) - 2", std::sqrt(3.)},
      {"exp(x) - 3", std::log(3.)},
      {"log(1 + x) - 1/2", std::exp(0.5) - 1},
      {"sin(x) - 1/2", kPi / 6},
      {"-cos(x)", kPi / 2},
      {"tan(x/2) - 1/3", 2 * std::atan(1. / 3)},
      {"sinh(x) - 2", std::asinh(2.)},
      {"cosh(x/2) - 3/2", 2 * std::acosh(1.5)},
      {"tanh(x) - 3/4", std::atanh(0.75)},
      {"1/2 - cot(x)", std::atan(2.)},
      {"abs(x - 3) - 3/2 + sign(x)*(2*x - 4)", 2.5},
      {"atan2(x, 1 + x) - 1/4", std::tan(0.25) / (1 - std::tan(0.25))},
      {"asin(x/4) - 1/3", 4 * std::sin(1. / 3)},
      {"-acos(x/4) + 4/3", 4 * std::cos(4. / 3)},
      {"x/(3 - x) - 1/2", 1},
      {"(1 + x)^(4/3) - 2", std::pow(2., 0.75) - 1},
      {"2 - 3/(1 + x)", 0.5},
  };
  for (const auto& [text, root] : functions) {
    const Specialisation s = with_function({{"x", "1"}}, text);
    const SectionResult result =
        cut(lane_kernels(s).front().second, plane_of(s, true), {0.1}, 1, section_settings(1, 1));
    ASSERT_EQ(result.orbits[0].size(), 1U) << text;
    EXPECT_NEAR(result.orbits[0].times[0], root - 0.1, 1e-11) << text;
  }
}

TEST(Section, AnAngleCrossesAtEveryTurn) {
  const Specialisation angle = with_function({{"x", "3"}}, "x - 1");
  SectionResult result = cut(lane_kernels(angle).front().second, plane_of(angle, true, 2 * kPi),
                             {0}, 1, section_settings(1, 20));
  ASSERT_EQ(result.orbits[0].size(), 20U);
  for (std::size_t n = 0; n < 20; ++n)
    EXPECT_NEAR(result.orbits[0].times[n], (1 + 2 * kPi * static_cast<double>(n)) / 3, 1e-11);
  // atan2 jumps where the angle goes on: that is no crossing.
  const Specialisation circle = with_function(kCircle, "atan2(x, y) - 1");
  result = cut(lane_kernels(circle).front().second, plane_of(circle, true, 2 * kPi), {0, 1}, 2,
               section_settings(2, 20));
  ASSERT_EQ(result.orbits[0].size(), 20U);
  for (std::size_t n = 0; n < 20; ++n)
    EXPECT_NEAR(result.orbits[0].times[n], 1 + 2 * kPi * static_cast<double>(n), 1e-11);
}

TEST(Section, ASeedOnThePlaneIsNoCrossing) {
  const Specialisation s = with_function(kCircle, "x");
  const SectionResult result = cut(lane_kernels(s).front().second, plane_of(s, true), {0, 1, 0, -1},
                                   2, section_settings(2, 3));
  EXPECT_NEAR(result.orbits[0].times[0], 2 * kPi, 1e-13);
  EXPECT_NEAR(result.orbits[1].times[0], kPi, 1e-13);
}

TEST(Section, AnOrbitThatDoesNotReturnIsSaidToo) {
  const Specialisation s = with_function(kCircle, "x - 2");
  SectionSettings settings = section_settings(2, 3);
  settings.steps_between = 50;
  const SectionResult result =
      cut(lane_kernels(s).front().second, plane_of(s, true), {0, 1}, 2, settings);
  EXPECT_EQ(result.orbits[0].size(), 0U);
  EXPECT_FALSE(result.orbits[0].returns);
}

/// x' = x: a deviation grows like exp(t), far beyond the range of double.
TEST(Section, GrowthOfADeviationGoesOnBeyondTheRangeOfNumbers) {
  const Specialisation s = with_function(
      {{"x", "y"}, {"y", "-x"}, {"z", "-z"}, {"dx", "dy"}, {"dy", "-dx"}, {"dz", "dz/2"}}, "x");
  const SectionResult result = cut(lane_kernels(s).front().second, plane_of(s, true),
                                   {0, 1, 0, 0, 0, 1}, 6, section_settings(3, 300));
  const SectionOrbit& orbit = result.orbits[0];
  ASSERT_EQ(orbit.growth.size(), 300U);
  for (std::size_t n = 0; n < 300; ++n) EXPECT_NEAR(orbit.growth[n] / orbit.times[n], 0.5, 1e-9);
  EXPECT_NEAR(orbit.times.back(), 600 * kPi, 1e-10);
}

/// Neither the other orbits nor the number of threads make a difference, in any bit.
TEST(Section, OrbitsDoNotDependOnEachOther) {
  const Specialisation s = specialised(testing::kKovalevskaya);
  const LaneKernel kernel = lane_kernels(s).front().second;
  std::vector<double> seeds;
  for (int i = 0; i < 9; ++i) seeds.insert(seeds.end(), {1, 0.5, 0.1 * i, 0.6, 0, 0.8});
  Program program;  // M2
  program.inputs = s.rhs.inputs;
  program.code = {{Op::input, 1}};
  program.outputs = {0};
  program.output_names = {"s"};
  const SectionPlane plane{program, true, 0};
  SectionSettings settings = section_settings(6, 20);
  const SectionResult one = cut(kernel, plane, seeds, 6, settings);
  settings.jobs = 2;
  const SectionResult two = cut(kernel, plane, seeds, 6, settings);
  for (std::size_t i = 0; i < 9; ++i) {
    const std::vector<double> seed(seeds.begin() + static_cast<std::ptrdiff_t>(6 * i),
                                   seeds.begin() + static_cast<std::ptrdiff_t>(6 * i + 6));
    const SectionResult alone = cut(kernel, plane, seed, 6, settings);
    ASSERT_EQ(one.orbits[i].size(), 20U);
    EXPECT_EQ(one.orbits[i].times, two.orbits[i].times);
    EXPECT_EQ(one.orbits[i].states, two.orbits[i].states);
    EXPECT_EQ(one.orbits[i].states, alone.orbits[0].states);
  }
}

/// q'' = -sign(q): from the height h it comes back to q = 0, upwards, at 3, 7, 11, .. sqrt(2 h).
TEST(Section, OrbitsTurnWhereTheEquationsJump) {
  const Specialisation s = with_function({{"q", "p"}, {"p", "-q/sqrt(q^2)"}}, "q");
  LaneKernel kernel = testing::lanes_of_recurrences(s);
  std::vector<double> seeds;
  for (int i = 0; i < 10; ++i) seeds.insert(seeds.end(), {0.5 + 0.25 * i, 0});
  const auto largest_error = [&] {
    const SectionResult result = cut(kernel, plane_of(s, true), seeds, 2, section_settings(2, 20));
    double error = 0;
    for (std::size_t i = 0; i < 10; ++i) {
      const SectionOrbit& orbit = result.orbits[i];
      const double speed = std::sqrt(2 * seeds[2 * i]);
      EXPECT_EQ(orbit.size(), 20U) << i;
      for (std::size_t n = 0; n < orbit.size(); ++n)
        error =
            std::max({error, std::abs(orbit.times[n] - (3 + 4 * static_cast<double>(n)) * speed),
                      std::abs(orbit.states[2 * n + 1] - speed)});
    }
    return error;
  };
  const double error = largest_error();
  EXPECT_LT(error, 5e-10);
  // The twin: steps that nobody looks at, and that the comparison with the equations alone cuts.
  kernel.watch = nullptr;
  EXPECT_GT(largest_error(), 5 * error);
}

/// The function of a section may have the sign of a state in it.
TEST(Section, AFunctionWithASign) {
  const Specialisation s = with_function({{"x", "1"}}, "x + x/sqrt(x^2)/2 - 1");
  const SectionResult result =
      cut(lane_kernels(s).front().second, plane_of(s, true), {0.1}, 1, section_settings(1, 1));
  ASSERT_EQ(result.orbits[0].size(), 1U);
  EXPECT_NEAR(result.orbits[0].times[0], 0.4, 1e-12);
}

}  // namespace
}  // namespace casimir
