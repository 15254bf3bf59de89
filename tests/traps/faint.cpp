// Poles, walls and fronts whose factors are so small, or whose slopes are so large, that what
// announces them is below the tolerance until they are there.
#include <fmt/format.h>

#include <algorithm>

#include "tests/traps/kinds.hpp"

namespace casimir::traps {
namespace {

const Real kPi = std::acos(Real(-1));

/// A number of three digits and a power of two, from `least` to `most`: `scaled` has no bits for
/// it.
Number tiny(Random& random, int least, int most) {
  const int power = least + random(most - least + 1), digits = 512 + random(512);
  return {fmt::format("{}/2^{}", digits, 10 + power), std::ldexp(Real(digits), -10 - power)};
}

/// p^2/2 + g/(2 q^2): q^2 = (q0 + p0 t)^2 + g t^2/q0^2.
Scene inverse_square(Random& random) {
  const Number g = tiny(random, 20, 66), q = between(random, 1, 4), end = between(random, 5, 9);
  const Real t = end.value, first = q.value - t, bend = g.value / (q.value * q.value);
  const Real at = std::sqrt(first * first + bend * t * t);
  return {.kind = "faint",
          .shape = "wall-of-inverse-square",
          .variables = {"q", "p"},
          .parameters = {{"g", g.text}},
          .equations = {"p", "g/q^3"},
          .initial = {q.text, "-1"},
          .duration = end.text,
          .exact = {{at, (-first + bend * t) / at}}};
}

/// p^2/2 + g/(2 cos(q)^2): sin(q) is a sine of the time.
Scene between_walls(Random& random, const char* shape, const char* force) {
  const Number g = tiny(random, 14, 50), end = between(random, 2, 20);
  const Real w = std::sqrt(1 + g.value), k = 1 / w;
  const Real turn = std::fmod(end.value * w, 2 * kPi);
  const Real s = k * std::sin(turn), q = std::asin(s);
  return {.kind = "faint",
          .shape = shape,
          .variables = {"q", "p"},
          .parameters = {{"g", g.text}},
          .equations = {"p", force},
          .initial = {"0", "1"},
          .duration = end.text,
          .exact = {{q, std::cos(turn) / std::cos(q)}}};
}

Scene wall_of_cosine(Random& random) {
  return between_walls(random, "wall-of-cosine", "-g*sin(q)/cos(q)^3");
}

Scene wall_of_tangent(Random& random) {
  return between_walls(random, "wall-of-tangent", "-g*tan(q)*(1 + tan(q)^2)");
}

/// y' = 1 + w/(x^2 + w^2) along x = t - c.
Scene lorentzian(Random& random) {
  const Number w = tiny(random, 8, 36), c = between(random, 1, 6), end = between(random, 7, 12);
  const Real x = end.value - c.value;
  const Real area = std::atan(x / w.value) + std::atan(c.value / w.value);
  return {.kind = "faint",
          .shape = "lorentzian",
          .variables = {"x", "y"},
          .parameters = {{"w", w.text}},
          .equations = {"1", "1 + w/(x^2 + w^2)"},
          .initial = {"-(" + c.text + ")", "0"},
          .duration = end.text,
          .exact = {{x, end.value + area}}};
}

/// Narrow peaks with nothing between them: cos(t)^8000.
Scene power_of_cosine(Random& random) {
  constexpr Real n = 4000;
  const int turns = 1 + random(6);
  const Number end = between(random, 3.1416L * turns + 0.5L, 3.1416L * turns + 2.6L);
  const Real whole =
      std::sqrt(kPi) * std::exp(std::lgamma(n + Real(0.5)) - std::lgamma(n + Real(1)));
  const Number k = between(random, 1, 100);
  return {.kind = "faint",
          .shape = "power-of-cosine",
          .variables = {"x"},
          .time = "t",
          .parameters = {{"k", k.text}},
          .equations = {"k*cos(t)^8000"},
          .initial = {"0"},
          .duration = end.text,
          .exact = {{k.value * whole * (turns + Real(0.5))}}};
}

/// log(cosh(z)), where cosh(z) is no number either.
Real log_cosh(Real z) {
  return std::abs(z) + std::log1p(std::exp(-2 * std::abs(z))) - std::log(Real(2));
}

/// x' = 1 + tanh((t - c)/w)
Scene front(Random& random) {
  const Number w = scaled(random, 1e-4L, 0.25L), c = between(random, 1, 8);
  const Number end = between(random, c.value + 0.5L, c.value + 6);
  const Real t = end.value;
  return {
      .kind = "faint",
      .shape = "front",
      .variables = {"x"},
      .time = "t",
      .parameters = {{"w", w.text}, {"c", c.text}},
      .equations = {"1 + tanh((t - c)/w)"},
      .initial = {"0"},
      .duration = end.text,
      .exact = {{t + w.value * (log_cosh((t - c.value) / w.value) - log_cosh(c.value / w.value))}}};
}

/// x' = 1/(1 + exp((t - c)/w)), whose exponential is beyond all numbers for most of the time.
Scene switched_off(Random& random) {
  Scene s = front(random);
  const Real w = constant(s.parameters[0].second), c = constant(s.parameters[1].second);
  const Real t = constant(s.duration);
  s.shape = "switched-off";
  s.equations = {"1/(1 + exp((t - c)/w))"};
  // Half of t less what the front of width 2 w gains.
  s.exact = {{t / 2 - w * (log_cosh((t - c) / (2 * w)) - log_cosh(c / (2 * w)))}};
  return s;
}

/// Roots that turn like kinks.
Scene soft_corner(Random& random) {
  const Number w = tiny(random, 10, 40), c = between(random, 1, 8);
  const Number end = between(random, c.value + 0.5L, c.value + 6);
  const auto primitive = [&](Real z) {
    return (z * std::sqrt(z * z + w.value * w.value) +
            w.value * w.value * std::asinh(z / w.value)) /
           2;
  };
  return {.kind = "faint",
          .shape = "soft-corner",
          .variables = {"x"},
          .time = "t",
          .parameters = {{"w", w.text}, {"c", c.text}},
          .equations = {"sqrt((t - c)^2 + w^2)"},
          .initial = {"0"},
          .duration = end.text,
          .exact = {{primitive(end.value - c.value) - primitive(-c.value)}}};
}

}  // namespace

std::vector<Maker> faint_shapes() {
  return {inverse_square,  wall_of_cosine, wall_of_tangent, lorentzian,
          power_of_cosine, front,          switched_off,    soft_corner};
}

}  // namespace casimir::traps
