// Figures 1.4 and 1.5 of the book: what can be measured of them.
#include <gtest/gtest.h>

#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <map>

#include "tests/tools/program.hpp"

namespace casimir::test {
namespace {

using Json = nlohmann::ordered_json;

const double kPi = std::acos(-1.);

double number(const Json& object, const char* name) {
  return std::stod(object.at(name).get<std::string>());
}

/// The chaotic scene of the heavy body, with cycles up to length 3: computed once.
const Json& figure_15() {
  static const Json kResult = run({"section", "euler-poisson", "--scene", "chaotic", "--orbits",
                                   "40", "--points", "150", "--cycles", "3", "--json"})
                                  .json();
  return kResult;
}

struct Row {
  std::vector<std::pair<double, double>> points;  ///< l / Pi and L/G
  double period, trace;
};

/// Computed by a program that has nothing in common with this one.
const std::vector<Row> kRows{
    {{{1.113683, 0}}, 3.856323, -2.0130},
    {{{1.919851, 0}}, 3.856323, -2.0130},
    {{{1.073913, 0}, {1.152489, 0}}, 7.704519, 1.8965},
    {{{1.920426, 0.086384}, {1.920426, -0.086384}}, 7.704519, 1.8965},
    {{{0.458794, 0}}, 3.855050, 6.5301},
    {{{1.568020, 0}}, 5.218634, 11.7953},
    {{{1.208645, 0.501496}, {0.784303, -0.184003}, {1.361454, -0.365354}}, 11.648438, 1.4683},
    {{{1.208645, -0.501496}, {0.784303, 0.184003}, {1.361454, 0.365354}}, 11.648438, 1.4683},
    {{{0.408698, 0.971606}}, 4.954053, -1.9777},
    {{{0.408698, -0.971606}}, 4.954053, -1.9777},
};

/// How far a cycle is from a row, in l / Pi and L/G, for the best order of its points.
double distance(const Json& cycle, const Row& row) {
  if (cycle.at("points").size() != row.points.size()) return 1;
  double farthest = 0;
  for (const auto& [l, x] : row.points) {
    double nearest = 1;
    for (const Json& point : cycle.at("points"))
      nearest = std::min(nearest, std::max(std::abs(number(point, "u") / kPi - l),
                                           std::abs(number(point, "v") - x)));
    farthest = std::max(farthest, nearest);
  }
  return farthest;
}

TEST(SectionFigures, CyclesOfFigure15) {
  for (const Row& row : kRows) {
    const Json* best = nullptr;
    for (const Json& cycle : figure_15().at("cycles"))
      if (!best || distance(cycle, row) < distance(*best, row)) best = &cycle;
    ASSERT_NE(best, nullptr);
    EXPECT_LT(distance(*best, row), 1.1e-6) << row.points[0].first << ' ' << row.points[0].second;
    EXPECT_NEAR(number(*best, "period"), row.period, 1.1e-6) << row.points[0].first;
    EXPECT_NEAR(number(*best, "trace"), row.trace, 1.01e-4) << row.points[0].first;
    EXPECT_NEAR(number(*best, "determinant"), 1, 1e-8);
    EXPECT_EQ(best->at("stable"), std::abs(row.trace) < 2);
  }
}

TEST(SectionFigures, EveryPointOfFigure15IsOnItsLevelAndTheCylinderIsCovered) {
  EXPECT_LT(number(figure_15(), "off_level"), 1e-10);
  double top = 0, bottom = 0;
  for (const Json& orbit : figure_15().at("orbits")) {
    EXPECT_EQ(orbit.at("points"), 150);
    for (const Json& point : orbit.at("crossings")) {
      top = std::max(top, number(point, "v"));
      bottom = std::min(bottom, number(point, "v"));
      EXPECT_GE(number(point, "u"), 0);
      EXPECT_LT(number(point, "u"), 2 * kPi);
    }
  }
  EXPECT_GT(top, 0.95);
  EXPECT_LT(bottom, -0.95);
}

TEST(SectionFigures, ExponentsOfSeaAndIslandsOfFigure15) {
  const Folder folder;
  // A saddle, which the sea contains, and the islands of the three-cycle.
  folder.write("seeds.csv", "u,v\n0.4588*Pi,1/1000\n1.208645*Pi,0.51\n");
  const Outcome outcome =
      run_in(folder, {"section", "euler-poisson", "--scene", "chaotic", "--seeds", "seeds.csv",
                      "--points", "5200", "--json", "--output", "points.csv"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const Json result = outcome.json();
  const Json &sea = result.at("orbits")[0], &island = result.at("orbits")[1];
  EXPECT_TRUE(sea.at("chaotic"));
  EXPECT_FALSE(island.at("chaotic"));
  EXPECT_GT(number(sea, "exponent"), 0.05);
  EXPECT_LT(number(sea, "exponent"), 0.08);
  EXPECT_GT(number(island, "t"), 19000);
  EXPECT_LT(std::abs(number(island, "exponent")), 1e-3);
}

using State = std::array<double, 6>;

/// Fig. 1.5's equations, written here once more.
void heavy_body(const State& x, State& d, double) {
  const double w1 = 2. / 3 * x[0], w2 = x[1], w3 = x[2] / 2, r = -0.5;
  d[0] = x[1] * w3 - x[2] * w2;
  d[1] = x[2] * w1 - x[0] * w3 + x[5] * r;
  d[2] = x[0] * w2 - x[1] * w1 - x[4] * r;
  d[3] = x[4] * w3 - x[5] * w2;
  d[4] = x[5] * w1 - x[3] * w3;
  d[5] = x[3] * w2 - x[4] * w1;
}

double plane(const State& x) {
  const double c = x[0] * x[3] + x[1] * x[4] + x[2] * x[5];
  return x[2] * c - (x[0] * x[0] + x[1] * x[1] + x[2] * x[2]) * x[5];
}

/// Boost.Odeint's Runge-Kutta-Fehlberg method, by small steps, and bisection in a step.
TEST(SectionFigures, AnotherLibraryCrossesAtTheSameTimes) {
  const Folder folder;
  folder.write("seeds.csv", "M1,M2,M3,g1,g2,g3\n0,1,2,0,1,0\n");
  const Outcome outcome = run_in(folder, {"section", "euler-poisson", "--scene", "chaotic",
                                          "--seeds", "seeds.csv", "--points", "12", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const Json orbit = outcome.json().at("orbits")[0];
  boost::numeric::odeint::runge_kutta_fehlberg78<State> stepper;
  State x{0, 1, 2, 0, 1, 0};
  double t = 0;
  const double h = 1. / 128;
  std::size_t found = 0;
  while (found < 12 && t < 100) {
    State next = x;
    stepper.do_step(heavy_body, next, t, h);
    if (plane(x) > 0 && plane(next) <= 0) {
      double low = 0, high = h;
      for (int round = 0; round < 60; ++round) {
        State middle = x;
        stepper.do_step(heavy_body, middle, t, (low + high) / 2);
        (plane(middle) > 0 ? low : high) = (low + high) / 2;
      }
      State there = x;
      stepper.do_step(heavy_body, there, t, high);
      const Json& crossing = orbit.at("crossings").at(found++);
      EXPECT_NEAR(number(crossing, "t"), t + high, 1e-9);
      EXPECT_NEAR(std::remainder(number(crossing, "u") - std::atan2(there[0], there[1]), 2 * kPi),
                  0, 1e-9);
      EXPECT_NEAR(number(crossing, "v"), there[2] / std::hypot(there[0], there[1], there[2]), 1e-9);
    }
    x = next;
    t += h;
  }
  EXPECT_EQ(found, 12U);
}

/// The reversor (M3, g3, t) -> -(M3, g3, t): what is returned to from the image of a point is the
/// image of what came before it.
TEST(SectionFigures, Figure15IsSymmetric) {
  const auto section = [](const std::string& seeds, const char* points) {
    const Folder folder;
    folder.write("seeds.csv", seeds);
    return run_in(folder, {"section", "euler-poisson", "--scene", "chaotic", "--seeds", "seeds.csv",
                           "--points", points, "--json"})
        .json()
        .at("orbits")[0]
        .at("crossings");
  };
  const Json forth = section("u,v\n3.7,0.3\n", "6");
  const Json& last = forth.at(5);
  char image[100];
  std::snprintf(image, sizeof image, "u,v\n%.17g,%.17g\n", number(last, "u"), -number(last, "v"));
  const Json back = section(image, "6");
  for (std::size_t n = 0; n < 5; ++n) {
    EXPECT_NEAR(number(back.at(n), "u"), number(forth.at(4 - n), "u"), 1e-6);
    EXPECT_NEAR(number(back.at(n), "v"), -number(forth.at(4 - n), "v"), 1e-6);
  }
}

TEST(SectionFigures, Figure14AreTheLevelLinesOfTheFreeTop) {
  const Outcome outcome = run({"section", "euler-e3", "--scene", "figure-1.4", "--orbits", "30",
                               "--points", "100", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const Json result = outcome.json();
  EXPECT_EQ(result.at("chaotic"), 0);
  double highest_of_ovals = 0;
  for (const Json& orbit : result.at("orbits")) {
    // (1-x^2)*(a1*sin(l)^2 + a2*cos(l)^2) + a3*x^2 is the same all along an orbit: 2 h / G^2.
    double least = 10, largest = 0, top = 0;
    for (const Json& point : orbit.at("crossings")) {
      const double l = number(point, "u"), x = number(point, "v");
      const double level =
          (1 - x * x) * (2. / 3 * std::pow(std::sin(l), 2) + std::pow(std::cos(l), 2)) + x * x / 2;
      least = std::min(least, level);
      largest = std::max(largest, level);
      top = std::max(top, std::abs(x));
    }
    EXPECT_LT(largest - least, 1e-11);
    // The separatrix is the level of the saddles, 2/3; inside it |x| is at most sqrt(2/3).
    if (least > 2. / 3) highest_of_ovals = std::max(highest_of_ovals, top);
  }
  EXPECT_LT(highest_of_ovals, std::sqrt(2. / 3));
  EXPECT_GT(highest_of_ovals, 0.6);
}

/// Centres at l = 0 and Pi, saddles between them, with the frequency and the exponent that the
/// quadratic form has there.
TEST(SectionFigures, FixedPointsOfFigure14) {
  const Outcome outcome = run({"section", "euler-e3", "--scene", "figure-1.4", "--orbits", "20",
                               "--points", "100", "--fixed-points", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  std::map<int, int> found;  // by l in units of Pi/2
  const Json result = outcome.json();
  for (const Json& cycle : result.at("cycles")) {
    const double l = number(cycle.at("points")[0], "u"), x = number(cycle.at("points")[0], "v");
    const int quarter = static_cast<int>(std::lround(2 * l / kPi)) % 4;
    if (std::abs(x) > 0.99) continue;  // the poles, where l is no coordinate
    EXPECT_NEAR(std::remainder(l - quarter * kPi / 2, 2 * kPi), 0, 1e-7);
    EXPECT_NEAR(x, 0, 1e-7);
    ++found[quarter];
    // 2 h / G^2 is a2 at the centres and a1 at the saddles; the rates are G*sqrt(..).
    const bool centre = quarter % 2 == 0;
    const double size = std::sqrt(3 / (centre ? 1. : 2. / 3));
    const double rate = size * std::sqrt(centre ? (1. / 3) * (1. / 2) : (1. / 3) * (1. / 6));
    const double angle = rate * number(cycle, "period");
    EXPECT_NEAR(number(cycle, "trace"), 2 * (centre ? std::cos(angle) : std::cosh(angle)), 1e-6);
    const nlohmann::ordered_json& multiplier = cycle.at("multipliers").at(0);
    EXPECT_NEAR(std::stod(multiplier[0].get<std::string>()),
                centre ? std::cos(angle) : std::exp(std::abs(angle)), 1e-5);
    EXPECT_NEAR(std::abs(std::stod(multiplier[1].get<std::string>())),
                centre ? std::abs(std::sin(angle)) : 0, 1e-5);
  }
  EXPECT_EQ(found, (std::map<int, int>{{0, 1}, {1, 1}, {2, 1}, {3, 1}}));
}

}  // namespace
}  // namespace casimir::test
