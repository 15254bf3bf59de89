// Sweeps: grids, what is done at their points, and what is kept of a sweep that was ended.
#include "tools/analysis/sweep/sweep.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/folder.hpp"
#include "tests/tools/analysis/systems.hpp"
#include "tools/analysis/error.hpp"
#include "tools/analysis/sweep/indicators.hpp"
#include "tools/analysis/sweep/integrations.hpp"
#include "tools/analysis/sweep/lyapunov.hpp"

namespace casimir::test {
namespace {

/// Oscillators from several places on the axis of q.
struct Line {
  Oscillator oscillator;
  Scene scene = oscillator.scene(3);
  PreparedScene run = prepare(oscillator.model, scene);
  Grid grid{{{"q", Axis::Kind::state, {0.5, 1, 2, 3}}}};
  GridPoints places{oscillator.model, scene, run, grid, {{oscillator.q}}};
  Settings settings = settings_for({}, run);
};

TEST(Grid, TheLastAxisRunsFastest) {
  const Grid grid{{{"a", Axis::Kind::parameter, {1, 2}}, {"b", Axis::Kind::state, {5, 6, 7}}}};
  EXPECT_EQ(grid.points(), 6U);
  EXPECT_EQ(grid.at(0), (std::vector<double>{1, 5}));
  EXPECT_EQ(grid.at(2), (std::vector<double>{1, 7}));
  EXPECT_EQ(grid.at(3), (std::vector<double>{2, 5}));
}

TEST(GridPoints, LetsAreFunctionsOfTheAxes) {
  const Oscillator oscillator;
  const Scene scene = oscillator.scene(1);
  const PreparedScene run = prepare(oscillator.model, scene);
  const Grid grid{{{"phi", Axis::Kind::free, {0, 1}}}};
  const GiNaC::symbol phi("phi");
  const GridPoints places(
      oscillator.model, scene, run, grid,
      {{phi}, {{"p", GiNaC::sin(phi)}, {"q", GiNaC::cos(phi)}}, "p=sin(phi), q=cos(phi)"});
  const auto [state, parameters] = places.at(1);
  EXPECT_NEAR(state[0], std::cos(1), 1e-15);
  EXPECT_NEAR(state[1], std::sin(1), 1e-15);
  EXPECT_TRUE(parameters.empty());
  const Scene there = places.scene_at(1, oscillator.model, scene);
  EXPECT_NEAR(GiNaC::ex_to<GiNaC::numeric>(there.initial[1]).to_double(), std::sin(1), 1e-15);
}

TEST(Sweep, EachPointIsItsOwnRun) {
  const Line row;
  const Integrations task(row.run, row.places, *find_method("taylor"), row.settings,
                          row.grid.points());
  const std::vector<PointResult> all = task.run({0, 1, 2, 3}, 2, {});
  const std::vector<std::string> columns = task.columns();
  const auto column = static_cast<std::size_t>(std::ranges::find(columns, "q") - columns.begin());
  for (std::size_t k = 0; k < all.size(); ++k) {
    EXPECT_EQ(all[k].status, Status::ok);
    EXPECT_NEAR(all[k].values.at(column), row.grid.at(k)[0] * std::cos(3), 1e-9);
    // Not a bit depends on the other points.
    EXPECT_EQ(task.run({k}, 1, {})[0].values, all[k].values);
  }
}

TEST(Sweep, OneThatWasEndedGoesOnFromWhatItKept) {
  const Line row;
  const Folder folder;
  const Ranks alone;
  const Integrations task(row.run, row.places, *find_method("taylor"), row.settings,
                          row.grid.points());
  SweepOptions options{.output = folder / "out.csv", .threads = 1};
  bool finished = false;
  const auto finish = [&](const std::vector<PointResult>& rows) {
    finished = true;
    EXPECT_EQ(rows.size(), 4U);
  };
  options.give_up = [] { return true; };
  const SweepOutcome ended = sweep_over(task, alone, options, finish);
  EXPECT_FALSE(ended.complete);
  EXPECT_FALSE(finished);
  options.give_up = {};
  const SweepOutcome whole = sweep_over(task, alone, options, finish);
  EXPECT_TRUE(whole.complete);
  EXPECT_TRUE(finished);
  EXPECT_EQ(whole.computed, 4U);
  EXPECT_EQ(whole.rows.size(), 4U);
  EXPECT_FALSE(std::filesystem::exists(folder / "out.csv.journal"));
}

TEST(Sweep, WhatWasKeptOfAnotherSweepIsRefused) {
  const Line row;
  const Folder folder;
  folder.write("out.csv.journal", "casimir sweep 1,something else\n");
  const Ranks alone;
  const Integrations task(row.run, row.places, *find_method("taylor"), row.settings,
                          row.grid.points());
  SweepOptions options{.output = folder / "out.csv", .threads = 1};
  EXPECT_THROW(sweep_over(task, alone, options, [](const auto&) {}), RequestError);
  options.restart = true;
  EXPECT_TRUE(sweep_over(task, alone, options, [](const auto&) {}).complete);
}

/// Whatever is done at the points, results of other steps are no part of this sweep.
TEST(Sweep, FollowsFromAllThatSteersTheMethod) {
  const Line row;
  const Model& model = row.oscillator.model;
  const Method& method = *find_method("gauss4");
  const std::vector<std::function<std::string(const Settings&)>> tasks = {
      [&](const Settings& settings) {
        return Integrations(row.run, row.places, method, settings, 4).fingerprint();
      },
      [&](const Settings& settings) {
        return LyapunovExponents(model, row.scene, row.run, row.places, method, settings)
            .fingerprint();
      },
      [&](const Settings& settings) {
        return Indicators(model, row.scene, row.run, row.places, method, settings).fingerprint();
      }};
  const auto other = [&](auto Settings::*member, auto value) {
    Settings settings = row.settings;
    settings.*member = value;
    return settings;
  };
  std::set<std::string> seen;
  for (const auto& fingerprint : tasks)
    for (const Settings& settings :
         {row.settings, other(&Settings::fixed_step, 0.5), other(&Settings::max_steps, 77ULL),
          other(&Settings::rtol, 1e-5), other(&Settings::atol, 1e-5),
          other(&Settings::duration, 77.)})
      EXPECT_TRUE(seen.insert(fingerprint(settings)).second);
}

/// What was kept of a sweep with other values, or other lets, is no part of this one.
TEST(Sweep, FollowsFromItsLets) {
  const Oscillator oscillator;
  const Scene scene = oscillator.scene(1);
  const PreparedScene run = prepare(oscillator.model, scene);
  const Grid grid{{{"phi", Axis::Kind::free, {0, 1}}}}, other{{{"phi", Axis::Kind::free, {0, 2}}}};
  const GiNaC::symbol phi("phi");
  const auto fingerprint = [&](const Grid& points, const std::string& text) {
    const Lets lets{{phi}, {{"p", GiNaC::sin(phi)}}, text};
    return GridPoints(oscillator.model, scene, run, points, lets).fingerprint();
  };
  const std::string own = fingerprint(grid, "p=sin(phi)");
  EXPECT_EQ(own, fingerprint(grid, "p=sin(phi)"));
  EXPECT_NE(own, fingerprint(grid, "p=sin(phi)/2"));
  EXPECT_NE(own, fingerprint(other, "p=sin(phi)"));
  EXPECT_THROW(fingerprint(grid, ""), std::invalid_argument);
}

TEST(Exponents, OfASaddleIsItsEigenvalueAndOfACentreNone) {
  const auto exponent = [](const GiNaC::ex& square, int duration = 200) {
    const GiNaC::symbol q("q"), p("p");
    const Model model = hamiltonian_system("h", {q}, {p}, (p * p + square * q * q) / 2);
    const Scene scene = scene_from(model, {1, 0}, duration);
    const PreparedScene run = prepare(model, scene);
    const Grid grid{{{"q", Axis::Kind::state, {1}}}};
    const GridPoints places(model, scene, run, grid, {{q}});
    const Settings settings = settings_for({}, run);
    const LyapunovExponents task(model, scene, run, places, *find_method("taylor"), settings);
    const PointResult result = task.run({0}, 1, {})[0];
    EXPECT_EQ(result.status, Status::ok);
    return result.values.at(1);
  };
  EXPECT_NEAR(exponent(-4), 2, 0.02);
  EXPECT_NEAR(exponent(4), 0, 0.02);
  EXPECT_NEAR(exponent(-4, -200), 2, 0.02);  // what grows back in time grows
}

TEST(Indicators, KeepToIntegralsThatHoldWhereverTheMotionGoes) {
  const Model model = model_of(kLeavesItsDomain);
  const Scene& scene = model.scene("default");
  const PreparedScene run = prepare(model, scene);
  const Grid grid{{{"x", Axis::Kind::state, {1}}}};
  const GridPoints places(model, scene, run, grid, {{model.variables[0]}});
  const Settings settings = settings_for({}, run);
  const Indicators task(model, scene, run, places, *find_method("taylor"), settings);
  EXPECT_EQ(task.proved(), std::vector<std::string>{"F"});
  EXPECT_EQ(task.left_out(), std::vector<std::string>{"G"});
  const PointResult result = task.run({0}, 1, {}).front();
  EXPECT_EQ(result.status, Status::ok);
  EXPECT_NEAR(result.values[1], 0, 0.1);  // deviations of a rotation do not grow
}

TEST(Exponents, EquationsThatDependOnTheTimeHaveNone) {
  const Model model = driven_equation("t - x");
  const Scene& scene = model.scene("default");
  const PreparedScene run = prepare(model, scene);
  const Grid grid{{{"x", Axis::Kind::state, {1}}}};
  const GridPoints places(model, scene, run, grid, {{model.variables[0]}});
  const Settings settings = settings_for({}, run);
  EXPECT_THROW(LyapunovExponents(model, scene, run, places, *find_method("taylor"), settings),
               RequestError);
}

}  // namespace
}  // namespace casimir::test
