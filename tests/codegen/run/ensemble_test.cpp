// Ensembles: trajectories in the lanes of registers, by every kernel that does them.
#include <array>
#include <cstring>
#include <random>

#include "tests/bundled_cases.hpp"
#include "tests/codegen/run/ensemble_forms.hpp"

namespace casimir {
namespace {

using testing::distance;
using testing::ensemble_of;
using testing::equations;
using testing::kKovalevskaya;
using testing::lane_kernels;
using testing::near;
using testing::run_lanes;
using testing::run_taylor;
using testing::settings_for;
using testing::specialised;
using testing::start_of;
using testing::truth;

using States = std::vector<std::vector<double>>;

/// The same in every bit, also where it is no number.
::testing::AssertionResult same(const MemberResult& a, const MemberResult& b) {
  if (a.status == b.status && a.steps == b.steps && a.rejected == b.rejected &&
      std::memcmp(&a.time, &b.time, sizeof a.time) == 0 && a.state.size() == b.state.size() &&
      std::memcmp(a.state.data(), b.state.data(), a.state.size() * sizeof(double)) == 0)
    return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure()
         << to_string(a.status) << " at " << a.time << " after " << a.steps << ", "
         << to_string(b.status) << " at " << b.time << " after " << b.steps;
}

TEST(EveryCase, OfItsKindAgreesWithTheReferenceInLanes) {
  constexpr double kDuration = 3;
  for (const auto& path : test::kinds_to_go_through()) {
    const Model model = build_model(read_case(path));
    const Specialisation s = specialise(model, model.scene("default"));
    States from = near(start_of(s), 11);
    from[3] = start_of(s);
    for (const auto& [name, kernel] : lane_kernels(s)) {
      const EnsembleResult result =
          run_lanes(kernel, ensemble_of(from), settings_for(kDuration, 1e-14));
      for (const std::size_t i : {std::size_t{0}, std::size_t{3}, std::size_t{10}}) {
        const std::vector<double> end = truth(s, from[i], kDuration);
        ASSERT_EQ(result.members[i].status, Status::ok) << path << name;
        EXPECT_LT(distance(result.members[i].state, end), 4e-13) << path << ' ' << name;
        // The twin: another member is another state.
        EXPECT_GT(distance(result.members[i == 0 ? 1 : i - 1].state, end), 1e-9);
      }
    }
  }
}

TEST(Ensemble, AgreesWithAnotherLibrary) {
  const Specialisation s = specialised(kKovalevskaya);
  const Module module = testing::compiled(s);
  const States from = near(start_of(s), 9);
  for (const auto& [name, kernel] : lane_kernels(s)) {
    const EnsembleResult result = run_lanes(kernel, ensemble_of(from), settings_for(5, 1e-12));
    for (std::size_t i = 0; i < from.size(); ++i) {
      const Trajectory other =
          integrate(module, *find_method("cvode-adams"), settings_for(5, 1e-12), from[i]);
      EXPECT_LT(distance(result.members[i].state, other.state), 1e-8) << name << i;
    }
  }
}

/// Members of many kinds: long and short, and some that cannot be continued.
struct Mixed {
  Specialisation spec = specialised(equations({{"x", "x^2 - y*z"}, {"y", "z"}, {"z", "-y"}}));
  States from;
  Mixed() {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double infinity = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 61; ++i) {
      const double x = -2 + 0.07 * i;  // from about 0.6 on they go to infinity before the end
      from.push_back({x, 0.3 + 0.1 * std::cos(i), 0.2 * std::sin(3. * i)});
    }
    from[5] = {nan, 0, 0};
    from[17] = {0, infinity, 1};
    from[18] = {1e200, 1, 1};
    from[40] = {0, 0, 0};
  }
};

TEST(Ensemble, NoMemberDependsOnItsNeighboursNorOnThreads) {
  const Mixed mixed;
  for (const double tolerance : {1e-5, 1e-12}) {
    Settings settings = settings_for(3, tolerance);
    for (const auto& [name, kernel] : lane_kernels(mixed.spec)) {
      const EnsembleResult all = run_lanes(kernel, ensemble_of(mixed.from), settings);
      EXPECT_EQ(all.members[5].status, Status::non_finite);
      EXPECT_EQ(all.members[60].status, Status::singularity);
      EXPECT_EQ(all.members[0].status, Status::ok);

      std::vector<std::size_t> order(mixed.from.size());
      for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
      std::mt19937 random(3);
      std::shuffle(order.begin(), order.end(), random);
      States shuffled;
      for (const std::size_t i : order) {
        shuffled.push_back(mixed.from[i]);
        shuffled.push_back(mixed.from[i]);  // and each twice
      }
      for (const int jobs : {1, 2, 5}) {
        const EnsembleResult other = run_lanes(kernel, ensemble_of(shuffled), settings, jobs);
        EXPECT_EQ(other.jobs, jobs);
        for (std::size_t i = 0; i < order.size(); ++i) {
          EXPECT_TRUE(same(other.members[2 * i], all.members[order[i]])) << name << order[i];
          EXPECT_TRUE(same(other.members[2 * i + 1], all.members[order[i]])) << name << order[i];
        }
      }
      for (std::size_t i = 0; i < mixed.from.size(); ++i) {
        const EnsembleResult alone = run_lanes(kernel, ensemble_of({mixed.from[i]}), settings);
        EXPECT_TRUE(same(alone.members[0], all.members[i])) << name << ' ' << i;
      }
    }
  }
}

TEST(Ensemble, ConstantAndRunTimeTablesGiveTheSameBits) {
  const std::vector<std::string> targets = lane_targets();
  if (targets.front() == "baseline") GTEST_SKIP() << "products and sums are not fused there";
  for (const Specialisation& s : {Mixed().spec, specialised(kKovalevskaya),
                                  specialised(equations({{"a", "b*c + d^2/3"},
                                                         {"b", "-a*c + 2*b*c"},
                                                         {"c", "e*f - a*d"},
                                                         {"d", "-a*c - c*f + 1/7"},
                                                         {"e", "-c*f + b*a - b*f"},
                                                         {"f", "-e*c + e*b + b - f/5"}}))}) {
    const LaneForm form = *lane_form(s.rhs, s.limits);
    const States from = s.states.size() == 3 ? Mixed().from : near(std::vector<double>(6, 0.5), 29);
    const EnsembleResult constants =
        run_lanes(testing::lanes_of_constants(form), ensemble_of(from), settings_for(3, 1e-11));
    for (const std::string& target : targets) {
      const EnsembleResult tables =
          run_lanes(table_driven_lanes(form, target), ensemble_of(from), settings_for(3, 1e-11));
      for (std::size_t i = 0; i < from.size(); ++i) {
        if (target != "baseline") {
          EXPECT_TRUE(same(tables.members[i], constants.members[i])) << target << i;
        } else if (tables.members[i].status == Status::ok) {
          EXPECT_LT(distance(tables.members[i].state, constants.members[i].state), 1e-9) << i;
        }
      }
    }
  }
  EXPECT_THROW(table_driven_lanes({}, "avx1024"), std::invalid_argument);
}

TEST(Ensemble, EndsAsOneTrajectoryDoes) {
  for (const char* rate : {"x^2", "-1/(2*x)", "sqrt(x) - 1", "x^3 - x", "log(x)"}) {
    const Specialisation s = specialised(equations({{"x", rate}}));
    States from;
    for (int i = 0; i < 27; ++i) from.push_back({0.1 * i});
    for (const auto& [name, kernel] : lane_kernels(s)) {
      const EnsembleResult result = run_lanes(kernel, ensemble_of(from), settings_for(1.05, 1e-10));
      const Module single = testing::compiled(s);
      for (std::size_t i = 0; i < from.size(); ++i) {
        const Trajectory one = run_taylor(single, settings_for(1.05, 1e-10), from[i]);
        const MemberResult& member = result.members[i];
        EXPECT_EQ(member.status, one.status) << rate << name << from[i][0];
        EXPECT_NEAR(member.time, one.time, 1e-6) << rate << name << from[i][0];
        if (one.status == Status::ok) {
          EXPECT_LT(distance(member.state, one.state), 1e-7) << rate << name;
        }
      }
    }
  }
}

TEST(Ensemble, StepsAreLimitedForEachMember) {
  const Specialisation s = specialised(kKovalevskaya);
  Settings settings = settings_for(100, 1e-12);
  settings.max_steps = 20;
  for (const auto& [name, kernel] : lane_kernels(s)) {
    States from = near(start_of(s), 20);
    from[7] = {0, 0, 0, 0, 0, 0};  // at rest: needs none of them
    const EnsembleResult result = run_lanes(kernel, ensemble_of(from), settings);
    for (std::size_t i = 0; i < from.size(); ++i) {
      const MemberResult& member = result.members[i];
      EXPECT_EQ(member.status, i == 7 ? Status::ok : Status::max_steps) << name << i;
      EXPECT_LE(member.steps + member.rejected, 20u);
      EXPECT_GT(member.time, 0.1);
    }
  }
}

TEST(Ensemble, StopsWhenAskedAndSaysWho) {
  const Specialisation s = specialised(equations({{"x", "y"}, {"y", "-x"}}));
  Settings settings = settings_for(1e9, 1e-14);
  settings.give_up = [] { return true; };
  for (const auto& [name, kernel] : lane_kernels(s)) {
    const EnsembleResult result = run_lanes(kernel, ensemble_of(States(100, {1, 0})), settings, 2);
    for (const MemberResult& member : result.members) {
      EXPECT_EQ(member.status, Status::stopped) << name;
      EXPECT_NEAR(member.state[0], std::cos(member.time), 1e-12);
    }
  }
}

TEST(Ensemble, BackwardsAndNowhere) {
  const Specialisation s = specialised(equations({{"x", "y"}, {"y", "-x"}}));
  for (const auto& [name, kernel] : lane_kernels(s)) {
    const EnsembleResult back = run_lanes(kernel, ensemble_of({{1, 0}}), settings_for(-2, 1e-14));
    EXPECT_NEAR(back.members[0].state[1], std::sin(2.), 1e-14) << name;
    const EnsembleResult none =
        run_lanes(kernel, ensemble_of(States(40, {1, 0})), settings_for(0, 1e-14), 3);
    for (const MemberResult& member : none.members) {
      EXPECT_EQ(member.status, Status::ok) << name;
      EXPECT_EQ(member.state, (std::vector<double>{1, 0}));
      EXPECT_EQ(member.steps, 0u);
    }
  }
}

TEST(Ensemble, ParametersMayDifferFromMemberToMember) {
  SpecialiseOptions general;
  general.fold_parameters = false;
  const std::string rest =
      "[parameters]\na = {}\nb = {}\n[[scene]]\nname = \"default\"\n"
      "parameters = { a = \"2\", b = \"1\" }\n";
  std::string with_time = equations({{"x", "a*x*cos(t) - b*x"}}, rest);
  with_time.replace(with_time.find("[equations]"), 0, "time = \"t\"\n");
  States states, values;
  for (int i = 0; i < 30; ++i) {
    states.push_back({0.5 + 0.01 * i});
    values.push_back({0.1 * i, 0.3 - 0.02 * i});
  }
  const Specialisation forced = specialised(with_time, general);
  for (const auto& [name, kernel] : lane_kernels(forced)) {
    const EnsembleResult result =
        run_lanes(kernel, ensemble_of(states, values), settings_for(3, 1e-14), 2);
    for (std::size_t i = 0; i < states.size(); ++i) {
      const double a = values[i][0], b = values[i][1];
      const double end = states[i][0] * std::exp(a * std::sin(3.) - 3 * b);
      EXPECT_NEAR(result.members[i].state[0] / end, 1, 1e-13) << name << i;
    }
  }
  // A quadratic system whose factors are functions of the parameters: x = 1/(c - sqrt(a) t) - b.
  const Specialisation square = specialised(equations({{"x", "sqrt(a)*(x + b)^2"}}, rest), general);
  EXPECT_TRUE(lane_form(square.rhs, square.limits));
  for (const auto& [name, kernel] : lane_kernels(square)) {
    const EnsembleResult result =
        run_lanes(kernel, ensemble_of(states, values), settings_for(0.3, 1e-14), 2);
    for (std::size_t i = 0; i < states.size(); ++i) {
      const double a = values[i][0], b = values[i][1];
      const double end = 1 / (1 / (states[i][0] + b) - 0.3 * std::sqrt(a)) - b;
      EXPECT_NEAR(result.members[i].state[0], end, 1e-13) << name << i;
    }
  }
}

TEST(Ensemble, EveryOperationHasItsRecurrence) {
  // Three in a system, since a compiler runs for each of these.
  for (const auto& [of_x, of_z, of_w] : std::vector<std::array<const char*, 3>>{
           {"x*y - x*x/3", "y/(1 + z*z) + 1/z", "sqrt(1 + w*w + y)"},
           {"(1 + x*x)^(1/3) - y^(-3/2)", "sin(z*y) + cos(z)", "tan(w/4)*y"},
           {"sinh(x - y)/2", "cosh(z)/3 - sinh(z)*cosh(y)/5", "tanh(2*w - y)"},
           {"exp(-x*y)", "log(1 + z + y)", "asin(w/9) + y"},
           {"acos(x/9) - y/5", "atan2(z, y)", "atan2(w, 2) + atan2(3, y)"},
           {"cos(x) + sin(x) + sin(x)*cos(y)", "-z - (-y)", "-w*y"}}) {
    const Specialisation s =
        specialised(equations({{"x", of_x}, {"y", "1"}, {"z", of_z}, {"w", of_w}}));
    const States from = {{0.75, 0.5, 0.75, 0.75}, {0.5, 0.75, 0.5, 0.5}, {1, 1.25, 1, 1}};
    for (const auto& [name, kernel] : lane_kernels(s)) {
      const EnsembleResult result = run_lanes(kernel, ensemble_of(from), settings_for(1, 1e-15));
      for (std::size_t i = 0; i < from.size(); ++i) {
        ASSERT_EQ(result.members[i].status, Status::ok) << of_x << name;
        EXPECT_LT(distance(result.members[i].state, truth(s, from[i], 1)), 1e-14) << of_x << name;
      }
    }
  }
}

TEST(Ensemble, ErrorFallsWithTheTolerance) {
  const Specialisation s = specialised(kKovalevskaya);
  const std::vector<double> from = start_of(s), end = truth(s, from, 20);
  for (const auto& [name, kernel] : lane_kernels(s)) {
    for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10, 1e-12}) {
      const EnsembleResult result =
          run_lanes(kernel, ensemble_of({from}), settings_for(20, tolerance));
      const double error = distance(result.members[0].state, end);
      EXPECT_LT(error, 100 * tolerance) << name;
      EXPECT_GT(error, 1e-5 * tolerance) << name;  // nothing is given away
    }
  }
}

TEST(Ensemble, SystemsOfAnotherKindHaveNoTables) {
  const auto has_form = [](const std::string& toml) {
    return lane_form(specialised(toml).rhs, {}).has_value();
  };
  EXPECT_TRUE(has_form(equations({{"x", "(x + 2*y)^2/3 - x/sqrt(2)"}, {"y", "1"}})));
  EXPECT_FALSE(has_form(equations({{"x", "x^3"}})));
  EXPECT_FALSE(has_form(equations({{"x", "1/x"}})));
  EXPECT_FALSE(has_form(equations({{"x", "sin(x)"}})));
  for (const int states : {24, 25}) {
    std::vector<std::pair<std::string, std::string>> field;
    for (int i = 0; i < states; ++i) {
      const std::string next = "x" + std::to_string((i + 1) % states);
      field.emplace_back("x" + std::to_string(i), next + "*x" + std::to_string((i + 5) % states));
    }
    const Specialisation s = specialised(equations(field));
    EXPECT_EQ(lane_form(s.rhs, s.limits).has_value(), states == 24);
    const std::vector<double> from(static_cast<std::size_t>(states), 0.25);
    for (const auto& [name, kernel] : lane_kernels(s)) {
      const EnsembleResult result = run_lanes(kernel, ensemble_of({from}), settings_for(1, 1e-14));
      // All are equal and stay so: x' = x^2.
      for (const double x : result.members[0].state) EXPECT_NEAR(x, 1 / 3., 1e-14) << name;
    }
  }
}

/// A ball between two inclined planes, q'' = -sign(q): parabolas from turn to turn.
std::vector<double> bounced(double height, double t) {
  const double quarter = std::sqrt(2 * height);
  const double turns = std::floor((t + quarter) / (2 * quarter));
  const double since = t - 2 * turns * quarter;
  const double side = std::fmod(turns, 2) == 0 ? 1 : -1;
  return {side * (height - since * since / 2), -side * since};
}

TEST(Ensemble, StepsEndWhereTheEquationsJump) {
  const Specialisation s = specialised(equations({{"q", "p"}, {"p", "-q/sqrt(q^2)"}}));
  LaneKernel kernel = testing::lanes_of_recurrences(s);
  States from;
  for (int i = 0; i < 19; ++i) from.push_back({0.5 + 0.1 * i, 0});
  const auto largest_error = [&] {
    const EnsembleResult result = run_lanes(kernel, ensemble_of(from), settings_for(20, 1e-14));
    double error = 0;
    for (std::size_t i = 0; i < from.size(); ++i) {
      EXPECT_EQ(result.members[i].status, Status::ok) << i;
      error = std::max(error, distance(result.members[i].state, bounced(from[i][0], 20)));
    }
    return error;
  };
  EXPECT_LT(largest_error(), 1e-11);
  // The twin: steps that nobody looks at.
  kernel.watch = nullptr;
  EXPECT_GT(largest_error(), 1e-10);
}

TEST(Ensemble, NoMemberStepsOverAPulse) {
  const Specialisation s =
      specialised(equations({{"x", "10000*exp(-(10000*(s - 3))^2)"}, {"s", "1"}}));
  LaneKernel kernel = testing::lanes_of_recurrences(s);
  States from;
  for (int i = 0; i < 9; ++i) from.push_back({0.25 * i, -0.3 * i});
  EnsembleResult result = run_lanes(kernel, ensemble_of(from), settings_for(8, 1e-12));
  for (std::size_t i = 0; i < from.size(); ++i)
    EXPECT_NEAR(result.members[i].state[0] - from[i][0], std::sqrt(std::acos(-1.)), 1e-10) << i;
  kernel.watch = nullptr;
  result = run_lanes(kernel, ensemble_of(from), settings_for(8, 1e-12));
  EXPECT_LT(result.members[0].state[0], 1);
}

/// q^2 = (3 - t)^2 + c t^2/9: each member turns at a wall of its own width, which no tail
/// announces.
TEST(Ensemble, NoMemberPassesAFaintWall) {
  const Specialisation s = specialised(equations({{"q", "p"}, {"p", "1/(10^16*q^3)"}}));
  LaneKernel kernel = testing::lanes_of_recurrences(s);
  States from;
  for (int i = 0; i < 9; ++i) from.push_back({2 + 0.25 * i, -1});
  EnsembleResult result = run_lanes(kernel, ensemble_of(from), settings_for(8, 1e-10));
  for (std::size_t i = 0; i < from.size(); ++i) {
    ASSERT_EQ(result.members[i].status, Status::ok) << i;
    EXPECT_NEAR(result.members[i].state[0], 8 - from[i][0], 1e-5) << i;
  }
  kernel.watch = nullptr;
  result = run_lanes(kernel, ensemble_of(from), settings_for(8, 1e-10));
  EXPECT_LT(result.members[0].state[0], 0);
}

/// Where a divisor passes zero the solution ends, and nobody would say of a member that a step went
/// on.
TEST(Ensemble, MembersEndAtFaintPoles) {
  const Specialisation s = specialised(equations({{"x", "1"}, {"y", "1 + 1/(10^20*x)"}}));
  LaneKernel kernel = testing::lanes_of_recurrences(s);
  const Ensemble ensemble = ensemble_of({{-1.0 / 3, 0}, {-0.7, 0}, {0.5, 0}});
  EnsembleResult result = run_lanes(kernel, ensemble, settings_for(4, 1e-10));
  for (const std::size_t i : {0, 1}) {
    EXPECT_NE(result.members[i].status, Status::ok) << i;
    EXPECT_NEAR(result.members[i].time, -ensemble.state(i)[0], 1e-9) << i;
  }
  EXPECT_EQ(result.members[2].status, Status::ok);
  kernel.watch = nullptr;
  EXPECT_EQ(run_lanes(kernel, ensemble, settings_for(4, 1e-10)).members[0].status, Status::ok);
}

TEST(Ensemble, NoMemberPassesThePeaksOfAHighPower) {
  const Specialisation s = specialised(equations({{"x", "v"}, {"v", "-x"}, {"y", "x^8000"}}));
  LaneKernel kernel = testing::lanes_of_recurrences(s);
  const EnsembleResult result =
      run_lanes(kernel, ensemble_of({{1, 0, 0}, {-1, 0, 0}}), settings_for(10, 1e-12));
  const double n = 4000;
  const double area =
      std::sqrt(std::acos(-1.)) * std::exp(std::lgamma(n + 0.5) - std::lgamma(n + 1));
  for (const MemberResult& member : result.members)  // half a peak at the start, and three
    EXPECT_NEAR(member.state[2] / area, 3.5, 1e-6);
}

}  // namespace
}  // namespace casimir
