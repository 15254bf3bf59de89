// Chaos as a theorem: what is proved, and what must not be.
#include "tools/analysis/horseshoe/horseshoe.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "symbolic/case_file.hpp"
#include "tools/analysis/error.hpp"

namespace casimir::horseshoe {
namespace {

using validated::MidRad;

/// A circle that is run through once in 2 Pi, and x and y beside it: the return map to s = 0 is
/// that of x and y over this time.
Model beside_circle(const std::string& x_rate, const std::string& y_rate,
                    const std::string& plane = "s") {
  const std::string text = fmt::format(R"toml(title = "beside a circle"
[phase_space]
variables = ["c", "s", "x", "y"]
[equations]
c = "-s"
s = "c"
x = "{}"
y = "{}"
[integrals]
R = "c^2 + s^2"
[section]
function = "{}"
plot = ["x", "y"]
[[scene]]
name = "default"
initial = {{ c = "1", s = "0", x = "1/10", y = "1/7" }}
duration = "10"
)toml",
                                       x_rate, y_rate, plane);
  return build_model(parse_case(text, "beside-circle"));
}

/// A prepared system with all that proofs take.
struct Prepared {
  Model model;
  SectionSystem system;
  NumericReturn map;
  Coverings<> coverings;

  explicit Prepared(Model given, const SectionRequest& request = {},
                    const CoveringSettings& settings = {})
      : model(std::move(given)),
        system(section_system(model, model.scenes.front(), request)),
        map(system),
        coverings(system, map, settings) {}

  std::optional<HSet> set(std::vector<double> centre, std::vector<double> along,
                          std::vector<double> across) {
    const auto vector = [](std::vector<double>& x) {
      return Eigen::VectorXd(Eigen::Map<Eigen::VectorXd>(x.data(), static_cast<long>(x.size())));
    };
    return coverings.chart().embed("N", vector(centre), vector(along), vector(across), map);
  }
  /// A rectangle around (x, y) = centre, at c = 1 and s = 0.
  HSet rectangle(double x, double y, double half_x, double half_y) {
    return *set({1, 0, x, y}, {0, 0, half_x, 0}, {0, 0, 0, half_y});
  }
  bool covers(const HSet& one, const HSet& other) { return coverings.check(one, {&other}).proved; }
};

/// x grows and y decays 4.8 times in a return.
Model saddle() { return beside_circle("x/4", "-y/4"); }

TEST(Coverings, ASaddleCoversItselfAndAnInclinedOneToo) {
  Prepared p(saddle());
  const HSet square = p.rectangle(0, 0, 0.1, 0.1);
  EXPECT_TRUE(p.covers(square, square));
  const HSet inclined = *p.set({1, 0, 0, 0}, {0, 0, 0.1, 0.01}, {0, 0, -0.01, 0.1});
  EXPECT_TRUE(p.covers(inclined, inclined));
}

TEST(Coverings, AnEdgeThatIsNotMappedAcrossIsSeen) {
  Prepared p(saddle());
  const double growth = std::exp(std::acos(-1.) / 2);
  const HSet square = p.rectangle(0, 0, 0.1, 0.1);
  EXPECT_TRUE(p.covers(square, p.rectangle(0, 0, 0.0999 * growth, 0.1)));
  EXPECT_FALSE(p.covers(square, p.rectangle(0, 0, 0.1001 * growth, 0.1)));
  // The image reaches over one edge only.
  EXPECT_TRUE(p.covers(square, p.rectangle(0.37, 0, 0.1, 0.1)));
  EXPECT_FALSE(p.covers(square, p.rectangle(0.39, 0, 0.1, 0.1)));
}

TEST(Coverings, AnImageOverTheStableEdgesIsSeen) {
  Prepared p(saddle());
  const double decay = std::exp(-std::acos(-1.) / 2);
  const HSet square = p.rectangle(0, 0, 0.1, 0.1);
  EXPECT_TRUE(p.covers(square, p.rectangle(0, 0, 0.1, 0.1001 * decay)));
  EXPECT_FALSE(p.covers(square, p.rectangle(0, 0, 0.1, 0.0999 * decay)));
  EXPECT_FALSE(p.covers(square, p.rectangle(0, 0.09, 0.1, 0.1)));
  // Far away along the unstable direction it does not matter.
  EXPECT_TRUE(p.covers(p.rectangle(0, 0.1, 0.2, 0.01), p.rectangle(0, 0.03, 0.1, 0.02)));
}

/// Where both directions decay everything is mapped into the set, and no edge across it.
TEST(Coverings, WithoutTheEdgesASinkWouldCover) {
  const Model sink = beside_circle("-x/4", "-y/4");
  Prepared p(sink);
  const HSet square = p.rectangle(0, 0, 0.1, 0.1);
  EXPECT_FALSE(p.covers(square, square));
  CoveringSettings careless;
  careless.without_edges = true;
  Prepared without(sink, {}, careless);
  EXPECT_TRUE(without.covers(square, square));
}

/// The surface 2*c*s = 0 is crossed upwards at c = 1 and at c = -1: the first return of the one
/// sheet is the other, over the same x and y.
TEST(Coverings, AnImageOnAnotherSheetIsSeen) {
  const Model two = beside_circle("x/2", "-y/2", "2*c*s");
  Prepared p(two);
  const HSet here = p.rectangle(0, 0, 0.1, 0.1);
  const HSet there = *p.set({-1, 0, 0, 0}, {0, 0, 0.1, 0}, {0, 0, 0, 0.1});
  EXPECT_TRUE(p.covers(here, there));
  EXPECT_TRUE(p.covers(there, here));
  EXPECT_FALSE(p.covers(here, here));
  CoveringSettings careless;
  careless.without_sheet = true;
  Prepared without(two, {}, careless);
  EXPECT_TRUE(without.covers(here, here));
}

/// The saddle and a clock z, which a function with the angle of (c, s) seems to hold back: it jumps
/// in each turn, by what the clock has gone on.
Model saddle_with_clock(const std::string& rate, const std::string& constant) {
  return build_model(parse_case(fmt::format(R"toml(title = "clock"
[phase_space]
variables = ["c", "s", "x", "y", "z"]
[equations]
c = "-s"
s = "c"
x = "x/4"
y = "-y/4"
z = "{}"
[integrals]
R = "sqrt(c^2 + s^2)"
A = "{}"
[section]
function = "s"
plot = ["x", "y"]
[[scene]]
name = "default"
initial = {{ c = "1", s = "0", x = "1/10", y = "1/7", z = "0" }}
duration = "10"
)toml",
                                            rate, constant),
                                "clock"));
}

TEST(Coverings, AFunctionThatJumpsOnTheWayIsNoLevel) {
  const auto covers_itself = [](Prepared& p) {
    const HSet set = *p.set({1, 0, 0, 0, 0}, {0, 0, 0.1, 0, 0}, {0, 0, 0, 0.1, 0});
    return p.coverings.check(set, {&set});
  };
  Prepared still(saddle_with_clock("0", "z"));
  const CoveringOutcome of_still = covers_itself(still);
  EXPECT_TRUE(of_still.proved) << of_still.reason;
  Prepared growing(saddle_with_clock("10^(-12)", "z - 10^(-12)*atan2(s, c)"));
  const CoveringOutcome outcome = covers_itself(growing);
  EXPECT_FALSE(outcome.proved);
  EXPECT_NE(outcome.reason.find("jump"), std::string::npos) << outcome.reason;
}

/// s (c - 1/2)^2 touches zero at a third of a half turn: the return map has no certain first
/// return.
TEST(Coverings, ASurfaceThatMayBeTouchedIsRefused) {
  Prepared touched(beside_circle("x/4", "-y/4", "s*(c - 1/2)^2"));
  EXPECT_FALSE(
      touched.covers(touched.rectangle(0, 0, 0.1, 0.1), touched.rectangle(0, 0, 0.1, 0.1)));
  Prepared beside(beside_circle("x/4", "-y/4", "s*((c - 1/2)^2 + 1/100)"));
  EXPECT_TRUE(beside.covers(beside.rectangle(0, 0, 0.1, 0.1), beside.rectangle(0, 0, 0.1, 0.1)));
}

validated::SectionReturn<MidRad> return_of(const SectionSystem& system,
                                           const validated::FlowProgram& flow,
                                           const std::vector<validated::Integral>& integrals) {
  std::vector<validated::ArbBall> levels;
  for (const RationalInterval& level : system.levels) levels.emplace_back(level.low);
  return {flow, integrals, levels, system.plane, {}};
}

/// The first return is the one that a closed form has, also where it is the second of two zeros
/// that are next to each other.
TEST(SectionReturn, IsTheFirstOne) {
  for (const auto& [plane, time] :
       {std::pair{"s", 2 * std::acos(-1.)}, std::pair{"s*((c - 1/2)^2 - 1/100)", std::acos(0.4)},
        std::pair{"s*((c - 1/2)^2 + 1/100)", 2 * std::acos(-1.)}}) {
    const Model model = beside_circle("x/4", "-y/4", plane);
    const SectionSystem system = section_system(model, model.scenes.front(), {});
    const auto flow =
        validated::joined(system.rates, system.jacobian.program, system.jacobian.entries);
    std::vector<validated::Integral> integrals;
    for (const KnownIntegral& one : system.integrals)
      integrals.push_back({one.name, one.value, one.gradient, one.states});
    auto found = return_of(system, flow, integrals);
    validated::AffineSet set{{1, 0, 0.5, 0.25},
                             validated::Matrix<double>(4, 2),
                             {MidRad(0, 1), MidRad(0, 1)},
                             std::vector<MidRad>(4)};
    set.directions(2, 0) = 0.01;
    set.directions(3, 1) = 0.02;
    // A wrong guess of the time costs nothing but a longer way.
    ASSERT_TRUE(found.find(set, 3)) << plane << found.reason();
    EXPECT_NEAR(found.result().time.mid, time, 1e-12 + found.result().time.rad);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> side(-1, 1);
    for (int k = 0; k < 20; ++k) {
      const double a = side(random), b = side(random);
      const double x = (0.5 + 0.01 * a) * std::exp(time / 4),
                   y = (0.25 + 0.02 * b) * std::exp(-time / 4);
      validated::FirstReturn<MidRad> image = found.result();
      image.along = {MidRad(a), MidRad(b)};
      const MidRad x_ball =
          image.along_row({MidRad(0), MidRad(0), MidRad(1), MidRad(0)}, {0, 0, 0, 0});
      const MidRad y_ball =
          image.along_row({MidRad(0), MidRad(0), MidRad(0), MidRad(1)}, {0, 0, 0, 0});
      EXPECT_LE(std::abs(x_ball.mid - x), x_ball.rad + 1e-15);
      EXPECT_LE(std::abs(y_ball.mid - y), y_ball.rad + 1e-15);
      EXPECT_LT(x_ball.rad, 1e-11);
    }
  }
}

constexpr const char* kHenonHeiles = R"toml(title = "Henon-Heiles"
hamiltonian = "(px^2 + py^2 + x^2 + y^2)/2 + x^2*y + {}*y^3/3"
[phase_space]
variables = ["x", "y", "px", "py"]
canonical = true
[section]
function = "x"
plot = ["y", "py"]
[[scene]]
name = "default"
initial = {{ x = "0", y = "1/10", px = "49057/100000", py = "0" }}
duration = "20"
)toml";

Model henon_heiles(const std::string& c) {
  return build_model(parse_case(fmt::format(kHenonHeiles, c), "henon-heiles"));
}

/// px is solved for on the level: the points of a patch are in its set, and a set that is larger
/// than the level cannot be put onto it.
TEST(SurfaceChart, PutsSetsOntoTheLevelOrRefuses) {
  SectionRequest request;
  request.energy = 0.125;
  Prepared p(henon_heiles("-1"), request);
  const std::vector<double> centre{0, 0, 0.5, 0};
  const auto set = p.set(centre, {0, 0.05, 0, 0.02}, {0, 0, 0, 0.05});
  ASSERT_TRUE(set);
  const Patch patch{0.25, 0.25, -0.5, 0.5};
  const validated::AffineSet part = p.coverings.chart().part(*set, patch);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> side(-1, 1);
  for (int k = 0; k < 50; ++k) {
    const double s = side(random) * 0.25, t = side(random) * 0.5;
    // The coordinate along W_1 = the flow may move y and py: the point is solved for by Newton.
    double w1 = 0, w2 = 0, x[4];
    for (int round = 0; round < 20; ++round) {
      const double a = patch.a + s, b = patch.b + t;
      for (std::size_t i = 0; i < 4; ++i)
        x[i] = set->centre[i] + a * set->frame(i, 0) + b * set->frame(i, 1) +
               w1 * set->frame(i, 2) + w2 * set->frame(i, 3);
      const double g1 = x[0], g2 = (x[2] * x[2] + x[3] * x[3] + x[0] * x[0] + x[1] * x[1]) / 2 +
                                   x[0] * x[0] * x[1] - x[1] * x[1] * x[1] / 3 - 0.125;
      const double d[4] = {x[0] + 2 * x[0] * x[1], x[1] + x[0] * x[0] - x[1] * x[1], x[2], x[3]};
      double a11 = set->frame(0, 2), a12 = set->frame(0, 3), a21 = 0, a22 = 0;
      for (std::size_t i = 0; i < 4; ++i) {
        a21 += d[i] * set->frame(i, 2);
        a22 += d[i] * set->frame(i, 3);
      }
      const double det = a11 * a22 - a12 * a21;
      w1 -= (g1 * a22 - g2 * a12) / det;
      w2 -= (g2 * a11 - g1 * a21) / det;
    }
    for (std::size_t i = 0; i < 4; ++i) {
      const double off =
          x[i] - part.middle[i] - part.directions(i, 0) * s - part.directions(i, 1) * t;
      EXPECT_LE(std::abs(off), part.rest[i].rad + 1e-15) << i;
      EXPECT_LT(part.rest[i].rad, 3e-3);
    }
  }
  EXPECT_FALSE(p.set(centre, {0, 0.6, 0, 0}, {0, 0, 0, 0.05}));
  // Off the level by more than its sheet could make up for.
  EXPECT_FALSE(p.set({0, 0, 1.5, 0}, {0, 0.05, 0, 0}, {0, 0, 0, 0.05}));
}

TEST(SurfaceChart, TellsDisjointSetsFromOthers) {
  Prepared p(saddle());
  const HSet one = p.rectangle(0, 0, 0.1, 0.1);
  EXPECT_TRUE(p.coverings.chart().disjoint(one, p.rectangle(0.21, 0, 0.1, 0.1)));
  EXPECT_TRUE(p.coverings.chart().disjoint(one, p.rectangle(0.05, -0.3, 0.1, 0.1)));
  EXPECT_FALSE(p.coverings.chart().disjoint(one, p.rectangle(0.19, 0.1, 0.1, 0.1)));
  EXPECT_FALSE(p.coverings.chart().disjoint(one, one));
}

TEST(Entropy, IsNotAboveThatOfTheGraph) {
  const auto near_below = [](const cln::cl_RA& x, double value) {
    const double d = cln::double_approx(x);
    return d <= value + 1e-15 && d > value - 1e-9;
  };
  const Arrows golden{{0, 0}, {0, 1}, {1, 0}}, full{{0, 0}, {0, 1}, {1, 0}, {1, 1}},
      ring{{0, 1}, {1, 2}, {2, 0}};
  EXPECT_TRUE(near_below(spectral_radius_above(2, golden), (1 + std::sqrt(5.)) / 2));
  EXPECT_TRUE(near_below(spectral_radius_above(2, full), 2));
  EXPECT_EQ(spectral_radius_above(3, ring), 1);
  EXPECT_EQ(spectral_radius_above(1, {{0, 0}, {0, 0}}), 1);
  EXPECT_TRUE(near_below(logarithm_below(2), std::log(2.)));
  EXPECT_TRUE(strongly_connected(2, golden));
  EXPECT_FALSE(strongly_connected(2, {{0, 0}, {0, 1}, {1, 1}}));
}

/// Duffing's equation in slow time: the separatrix is a double loop, and splits where it is forced.
Model duffing(const std::string& force) { return beside_circle("y/4", "(x - x^3)/4 + " + force); }

TEST(Horseshoe, IsProvedForForcedDuffingAndNotWithoutForce) {
  const Model forced = duffing("c/12");
  const Horseshoe found = find_horseshoe(forced, forced.scenes.front());
  ASSERT_TRUE(found.proved) << found.reason;
  EXPECT_TRUE(found.entropy > 0);
  EXPECT_GE(found.coverings.size(), found.sets.size() + 1);
  // A twist map of which nobody has told the integral: its separatrices are one curve.
  const Model free = duffing("0");
  HorseshoeOptions options;
  options.longest_cycle = 1;
  const Horseshoe nothing = find_horseshoe(free, free.scenes.front(), options);
  EXPECT_FALSE(nothing.proved);
  EXPECT_FALSE(nothing.reason.empty());
}

TEST(Horseshoe, IsProvedForHenonHeilesAndNotForItsIntegrableMembers) {
  const Model model = henon_heiles("-1");
  HorseshoeOptions options;
  options.request.energy = 0.125;
  options.longest_cycle = 1;
  const Horseshoe found = find_horseshoe(model, model.scenes.front(), options);
  ASSERT_TRUE(found.proved) << found.reason;
  EXPECT_EQ(found.system.level_names, std::vector<std::string>{"H"});
  for (const char* c : {"1", "6"}) {
    const Model integrable = henon_heiles(c);
    options.request.energy = c[0] == '1' ? 0.1 : 0.004;
    EXPECT_FALSE(find_horseshoe(integrable, integrable.scenes.front(), options).proved) << c;
  }
}

TEST(Horseshoe, RefusesWhatHasNoReturnMapOfASurface) {
  const auto refuses = [](const Model& model) {
    EXPECT_THROW(section_system(model, model.scenes.front(), {}), RequestError);
  };
  // The level of one function more than there is room for.
  Model known = beside_circle("y", "-x");
  known.integrals.push_back(
      {"J", GiNaC::pow(known.variables[2], 2) + GiNaC::pow(known.variables[3], 2), {}});
  refuses(known);
  refuses(beside_circle("y", "-x", "atan2(s, c)"));
  Model bare = saddle();
  bare.section.reset();
  refuses(bare);
}

}  // namespace
}  // namespace casimir::horseshoe
