// Starts at rest, with f = 0 and x = 0, and at the ends of functions.
#include <fmt/format.h>

#include "tests/traps/kinds.hpp"

namespace casimir::traps {
namespace {

Scene of_time(const char* shape, const std::string& rate, const Number& end, Real value) {
  return {.kind = "rest",
          .shape = shape,
          .variables = {"x"},
          .time = "t",
          .equations = {rate},
          .initial = {"0"},
          .duration = end.text,
          .exact = {{value}}};
}

/// x'' = -w^2 x + sin t, from nothing.
Scene forced(Random& random) {
  const Number w = between(random, 1.25L, 6), end = between(random, 1, 25);
  const Real t = end.value, d = w.value * w.value - 1;
  Scene s =
      of_time("forced-from-rest", "v", end, (std::sin(t) - std::sin(w.value * t) / w.value) / d);
  s.variables.push_back("v");
  s.equations.push_back("-w^2*x + sin(t)");
  s.initial.push_back("0");
  s.parameters = {{"w", w.text}};
  s.exact->push_back((std::cos(t) - std::cos(w.value * t)) / d);
  return s;
}

Scene pushed(Random& random) {
  const Number end = between(random, 0.5L, 12);
  const Real t = end.value;
  Scene s = of_time("pushed-by-time", "v", end, t * t * t / 6);
  s.variables.push_back("v");
  s.equations.push_back("t");
  s.initial.push_back("0");
  s.exact->push_back(t * t / 2);
  return s;
}

/// x' = -x + t^3.
Scene relaxing(Random& random) {
  const Number end = between(random, 0.5L, 12);
  const Real t = end.value;
  return of_time("relaxing-from-rest", "-x + t^3", end,
                 t * t * t - 3 * t * t + 6 * t - 6 + 6 * std::exp(-t));
}

Scene logistic(Random& random) {
  const bool one = random.one_in(2);
  return {.kind = "rest",
          .shape = "logistic-equilibrium",
          .variables = {"x"},
          .parameters = {{"k", between(random, 0.5L, 5).text}},
          .equations = {"k*x*(1 - x)"},
          .initial = {one ? "1" : "0"},
          .duration = between(random, 1, 50).text,
          .exact = {{one ? Real(1) : Real(0)}}};
}

Scene pendulum(Random& random) {
  const Number end = between(random, 1, 15);
  return {.kind = "rest",
          .shape = "pendulum-upright",
          .variables = {"x", "v"},
          .equations = {"v", "sin(x)"},
          .initial = {"0", "0"},
          .duration = end.text,
          .exact = {{0, 0}}};
}

/// An equilibrium beside a motion.
Scene beside(Random& random) {
  const Number end = between(random, 1, 40);
  return {.kind = "rest",
          .shape = "equilibrium-beside-motion",
          .variables = {"x", "y", "a", "b"},
          .equations = {"x*(1 - y)", "y*(x - 1)", "b", "-a"},
          .initial = {"1", "1", "0", "1"},
          .duration = end.text,
          .exact = {{1, 1, std::sin(end.value), std::cos(end.value)}}};
}

/// Falling with drag -k |v| v.
Scene drag(Random& random) {
  const Number k = scaled(random, 0.01L, 100), g = between(random, 0.5L, 10);
  const Number end = between(random, 0.25L, 10);
  const Real rate = std::sqrt(k.value * g.value) * end.value;
  const Real log_cosh = rate + std::log1p(std::exp(-2 * rate)) - std::log(Real(2));
  return {.kind = "rest",
          .shape = "drag",
          .variables = {"x", "v"},
          .parameters = {{"k", k.text}, {"g", g.text}},
          .equations = {"v", "g - k*sqrt(v^2)*v"},
          .initial = {"0", "0"},
          .duration = end.text,
          .exact = {{log_cosh / k.value, std::sqrt(g.value / k.value) * std::tanh(rate)}}};
}

/// Thrown upwards: drag changes its sign at the top.
Scene thrown(Random& random) {
  const Number v = between(random, 0.5L, 5), end = between(random, 0.25L, 6);
  const Real up = std::atan(v.value), s = end.value - up;
  const Real top = std::log(std::sqrt(1 + v.value * v.value));
  const Real speed = s < 0 ? std::tan(-s) : -std::tanh(s);
  const Real height = s < 0 ? top + std::log(std::cos(-s)) : top - std::log(std::cosh(s));
  return {.kind = "rest",
          .shape = "thrown-up",
          .variables = {"x", "v"},
          .equations = {"v", "-1 - sqrt(v^2)*v"},
          .initial = {"0", v.text},
          .duration = end.text,
          .exact = {{height, speed}}};
}

/// x' = 1 + |x|, from below, from zero or from above.
Scene absolute(Random& random) {
  const Number start = random.one_in(3) ? Number{"0", 0} : between(random, -2, 2);
  const Number end = between(random, 0.25L, 4);
  // Below zero x' = 1 - x, above x' = 1 + x.
  const Real to_zero = start.value < 0 ? std::log1p(-start.value) : 0;
  const Real t = end.value;
  const Real x = start.value >= 0 ? (1 + start.value) * std::exp(t) - 1
                 : t < to_zero    ? 1 - (1 - start.value) * std::exp(-t)
                                  : std::exp(t - to_zero) - 1;
  return {.kind = "rest",
          .shape = "absolute-value",
          .variables = {"x"},
          .equations = {"1 + sqrt(x^2)"},
          .initial = {start.text},
          .duration = end.text,
          .exact = {{x}}};
}

/// x' = 1 + |x|^(2/3) has t = 3 (z - atan z) with z = x^(1/3).
Scene cube_root(Random& random) {
  const Number start = random.one_in(3) ? Number{"0", 0} : between(random, -2, 1);
  const Number end = between(random, 0.25L, 4);
  const auto clock = [](Real z) { return 3 * (z - std::atan(z)); };
  const Real there = clock(std::cbrt(start.value)) + end.value;
  Real low = -10, high = 10;
  for (int i = 0; i < 120; ++i) {
    const Real middle = (low + high) / 2;
    (clock(middle) < there ? low : high) = middle;
  }
  return {.kind = "rest",
          .shape = "cube-root",
          .variables = {"x"},
          .equations = {"1 + (x^2)^(1/3)"},
          .initial = {start.text},
          .duration = end.text,
          .exact = {{low * low * low}}};
}

Scene root_of_time(Random& random) {
  const Number end = between(random, 0.25L, 9);
  return of_time("root-of-time", "sqrt(t)", end, 2 * end.value * std::sqrt(end.value) / 3);
}

/// acos at exactly 1, at the start; the sphere's arc.
Scene acos_at_one(Random& random) {
  const Number end = between(random, 0.25L, 1.75L);
  const Real t = end.value, y = 1 - t;
  // The integral of acos(1 - s) from 0 to t.
  const auto primitive = [](Real u) { return u * std::acos(u) - std::sqrt(1 - u * u); };
  return of_time("acos-at-one", "acos(1 - t)", end, primitive(1) - primitive(y));
}

Scene asin_to_one(Random& random) {
  const bool all = random.one_in(2);
  const Number end = all ? Number{"1", 1} : between(random, 0.25L, 0.9375L);
  const Real t = end.value;
  return of_time("asin-to-one", "asin(t)", end, t * std::asin(t) + std::sqrt(1 - t * t) - 1);
}

/// On the way to where the root ends, and not there yet.
Scene arc(Random& random) {
  const Number end = between(random, 0.25L, 1.5L);
  return {.kind = "rest",
          .shape = "arc-before-its-end",
          .variables = {"x"},
          .equations = {"sqrt(1 - x^2)"},
          .initial = {"0"},
          .duration = end.text,
          .exact = {{std::sin(end.value)}}};
}

/// The rate and its derivative vanish at the start.
Scene late_ramp(Random& random) {
  const Number end = between(random, 1, 20);
  const Real t = end.value;
  return of_time("one-minus-cosine", "1 - cos(t)", end, t - std::sin(t));
}

}  // namespace

std::vector<Maker> rest_shapes() {
  return {forced,   pushed,    relaxing,     logistic,    pendulum,    beside, drag,     thrown,
          absolute, cube_root, root_of_time, acos_at_one, asin_to_one, arc,    late_ramp};
}

}  // namespace casimir::traps
