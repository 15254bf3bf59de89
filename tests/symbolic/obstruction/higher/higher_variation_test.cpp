// Systems whose variational equations of first order say nothing.
#include "symbolic/obstruction/higher/higher_variation.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

#include "symbolic/case_file.hpp"
#include "symbolic/obstruction/obstruct.hpp"

namespace casimir::obstruction {
namespace {

Obstruction of(const std::string& hamiltonian, unsigned order = 3,
               const std::vector<std::string>& along = {}) {
  const Model model = build_model(
      parse_case(fmt::format("title = \"A test\"\nsource = \"a test\"\nhamiltonian = \"{}\"\n"
                             "[phase_space]\nvariables = [\"x\", \"y\", \"px\", \"py\"]\n"
                             "canonical = true\n",
                             hamiltonian),
                 "test.toml"));
  ObstructionRequest request;
  request.order = order;
  for (const std::string& text : along) request.along.push_back({text, {"--along", 1, 1}, {}});
  return find_obstruction(model, request);
}

std::string family(const char* a, const char* b, const char* c) {
  return fmt::format("(px^2 + py^2 + {}*x^2 + {}*y^2)/2 + x^2*y + {}*y^3/3", a, b, c);
}

TEST(HigherVariation, ExcludesTheCaseOfHenonAndHeilesThatTheFirstOrderLeaves) {
  // Morales-Ruiz, Ramis and Simo 2007: c = 2, by the third order.
  for (const char* b : {"1", "2", "5"}) {
    const Obstruction answer = of(family("1", b, "2"));
    ASSERT_TRUE(answer.proved) << b;
    EXPECT_EQ(answer.examined.back().order, 3u);
    EXPECT_NE(answer.theorem.find("each order"), std::string::npos);
    EXPECT_FALSE(of(family("1", b, "2"), 2).proved) << b;
  }
  // n = 4 of Lame's equation, and the potential without quadratic terms.
  EXPECT_TRUE(of(family("1", "1", "3/5")).proved);
  EXPECT_TRUE(of("(px^2 + py^2)/2 + x^2*y/2 + y^3/3").proved);
}

using State = std::array<std::complex<double>, 4>;

/// x'' = -x y, y'' = -c y^2/2 - x^2/2, once around t = 0 from t = 1 by Runge and Kutta's method.
State once_around(double c, State state) {
  constexpr int kSteps = 4000;
  const double h = 2 * std::acos(-1.0) / kSteps;
  const std::complex<double> i(0, 1);
  const auto rate = [&](double angle, const State& s) {
    const std::complex<double> slope = i * std::exp(i * angle);
    return State{slope * s[2], slope * s[3], -slope * s[0] * s[1],
                 -slope * (c * s[1] * s[1] + s[0] * s[0]) / 2.0};
  };
  const auto moved = [](State s, double step, const State& by) {
    for (std::size_t k = 0; k < 4; ++k) s[k] += step * by[k];
    return s;
  };
  for (int n = 0; n < kSteps; ++n) {
    const double angle = n * h;
    const State a = rate(angle, state), b = rate(angle + h / 2, moved(state, h / 2, a)),
                d = rate(angle + h / 2, moved(state, h / 2, b)),
                e = rate(angle + h, moved(state, h, d));
    for (std::size_t k = 0; k < 4; ++k) state[k] += h / 6 * (a[k] + 2.0 * (b[k] + d[k]) + e[k]);
  }
  return state;
}

TEST(HigherVariation, TheLogarithmIsThatOfTheMonodromyInNumbers) {
  // y = -12/(c t^2), x = eps t^(-n): what is gained around t = 0, by eps^3.
  const auto gained = [](double c, double n) {
    constexpr double kEps = 0.01;
    const State start{kEps, -12 / c, -n * kEps, 24 / c};
    return (once_around(c, start)[0] - start[0]) / std::pow(kEps, 3);
  };
  // c3 belongs to p = t^(-3), x = -t^(-2)/2: eps = -c3/2 gains 2 pi i eps^3/60.
  const Obstruction answer = of("(px^2 + py^2)/2 + x^2*y/2 + y^3/3");
  ASSERT_TRUE(answer.proved);
  EXPECT_NE(answer.examined.back().cases.back().second.find("c3: 1/240*c3^3;"), std::string::npos);
  EXPECT_NEAR(std::abs(gained(2, 2) - std::complex<double>(0, std::acos(-1.0) / 30)), 0, 1e-4);
  EXPECT_NEAR(std::abs(gained(1, 3)), 0, 1e-4);
  EXPECT_NEAR(std::abs(gained(6, 1)), 0, 1e-4);
}

TEST(HigherVariation, DecidesInTurnedVariablesToo) {
  const std::string turned =
      "(px^2 + py^2 + x^2 + y^2)/2 + (3*x + 4*y)^2*(4*x - 3*y)/125 + 2*(4*x - 3*y)^3/375";
  EXPECT_TRUE(of(turned, 3, {"3*x + 4*y = 0"}).proved);
  // A canonical change: px is px + 2 x y, py is py + x^2.
  EXPECT_TRUE(of("((px + 2*x*y)^2 + (py + x^2)^2 + x^2 + y^2)/2 + x^2*y + 2*y^3/3").proved);
}

TEST(HigherVariation, FindsNoLogarithmInIntegrableSystems) {
  for (const std::string& h :
       {family("1", "1", "1"), family("1", "1", "6"), family("3", "2", "6"), family("0", "0", "1"),
        family("0", "0", "6"), std::string("(px^2 + py^2)/2 + (x + y)^3 + 3*(x - y)^3 + x*y")}) {
    const Obstruction answer = of(h, 5);
    EXPECT_FALSE(answer.proved) << h;
    // Not for want of a question.
    EXPECT_TRUE(std::any_of(answer.examined.begin(), answer.examined.end(), [](const auto& e) {
      return std::any_of(e.cases.begin(), e.cases.end(),
                         [](const auto& c) { return c.second == "no logarithm up to order 5"; });
    })) << h;
  }
}

TEST(HigherVariation, AsksForAnEquationOfFirstOrderWithoutALogarithm) {
  // c = 16: n = 1/2, whose solutions are no Laurent series.
  const Obstruction answer = of(family("1", "16", "16"));
  EXPECT_FALSE(answer.proved);
  EXPECT_TRUE(std::any_of(answer.examined.begin(), answer.examined.end(), [](const auto& e) {
    return e.cases.back().second.find("order 1 has a logarithm") != std::string::npos;
  }));
}

}  // namespace
}  // namespace casimir::obstruction
