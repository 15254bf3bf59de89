// Ends of the solution, or of what is real, at a known time; and what only looks like one.
#include <fmt/format.h>

#include "tests/traps/kinds.hpp"

namespace casimir::traps {
namespace {

const Real kPi = std::acos(Real(-1));

/// Ends at `at`; asked for beyond it.
Scene ends(Random& random, const char* shape, Texts variables, Texts equations, Texts initial,
           Real at) {
  return {.kind = "singular",
          .shape = shape,
          .variables = std::move(variables),
          .equations = std::move(equations),
          .initial = std::move(initial),
          .duration = between(random, 1.25L * at, 4 * at + 1).text,
          .singular_at = at};
}

Scene square(Random& random) {
  const Number x = between(random, 0.25L, 4);
  return ends(random, "square", {"x"}, {"x^2"}, {x.text}, 1 / x.value);
}

Scene tangent(Random& random) {
  const Number x = between(random, -2, 2);
  return ends(random, "tangent", {"x"}, {"1 + x^2"}, {x.text}, kPi / 2 - std::atan(x.value));
}

Scene reciprocal(Random& random) {
  const Number x = between(random, 0.25L, 4);
  return ends(random, "reciprocal", {"x"}, {"-1/x"}, {x.text}, x.value * x.value / 2);
}

Scene weierstrass(Random& random) {
  const Number c = between(random, 0.5L, 4);
  return ends(random, "double-pole", {"x", "v"}, {"v", "6*x^2"},
              {"1/(" + c.text + ")^2", "2/(" + c.text + ")^3"}, c.value);
}

Scene simple_pole(Random& random) {
  const Number c = between(random, 0.5L, 4);
  return ends(random, "simple-pole", {"x", "v"}, {"v", "2*x^3"},
              {"1/(" + c.text + ")", "1/(" + c.text + ")^2"}, c.value);
}

Scene collision(Random& random) {
  const Number x = between(random, 0.5L, 3);
  return ends(random, "collision", {"x", "v"}, {"v", "-1/x^2"}, {x.text, "0"},
              kPi / (2 * std::sqrt(Real(2))) * x.value * std::sqrt(x.value));
}

/// The root loses its real value where x = 0.
Scene root_of_state(Random& random) {
  const Number x = between(random, 0.25L, 4);
  const Real z = std::sqrt(x.value);
  return ends(random, "root-of-state", {"x"}, {"-1 - sqrt(x)"}, {x.text}, 2 * (z - std::log1p(z)));
}

Scene in_time(Random& random, const char* shape, const std::string& rate, const Number& c) {
  Scene s = ends(random, shape, {"x"}, {rate}, {"0"}, c.value);
  s.time = "t";
  s.parameters = {{"c", c.text}};
  return s;
}

Scene pole_of_time(Random& random) {
  return in_time(random, "pole-of-time", "1/(t - c)", between(random, 0.5L, 6));
}
Scene double_pole_of_time(Random& random) {
  return in_time(random, "double-pole-of-time", "1/(t - c)^2", between(random, 0.5L, 6));
}
Scene root_of_time(Random& random) {
  return in_time(random, "root-of-time-ends", "sqrt(c - t)", between(random, 0.5L, 6));
}
Scene log_of_time(Random& random) {
  return in_time(random, "log-of-time", "log(c - t)", between(random, 0.5L, 6));
}
Scene asin_of_time(Random& random) {
  return in_time(random, "asin-of-time", "asin(t/c)", between(random, 0.5L, 6));
}

Scene secant(Random& random) {
  Scene s = ends(random, "secant-squared", {"x"}, {"1/cos(t)^2"}, {"0"}, kPi / 2);
  s.time = "t";
  return s;
}

/// sin(t) + 1 - e is below zero for a moment in each turn only.
Scene dip(Random& random, const char* shape, const std::string& rate) {
  const Number e = scaled(random, 1e-4L, 0.25L);
  Scene s = ends(random, shape, {"x"}, {rate}, {"0"}, 3 * kPi / 2 - std::acos(1 - e.value));
  s.time = "t";
  s.parameters = {{"e", e.text}};
  s.duration = between(random, 6, 25).text;
  return s;
}
Scene root_dip(Random& random) { return dip(random, "root-dip", "sqrt(sin(t) + 1 - e)"); }
Scene log_dip(Random& random) { return dip(random, "log-dip", "log(sin(t) + 1 - e)"); }
Scene acos_dip(Random& random) { return dip(random, "acos-dip", "acos(-sin(t) + e)"); }
Scene pole_dip(Random& random) { return dip(random, "pole-dip", "1/(sin(t) + 1 - e)"); }

/// A root in a state that an oscillator takes below zero for a moment.
Scene root_of_oscillator(Random& random) {
  const Number e = scaled(random, 1e-4L, 0.25L);
  Scene s = ends(random, "root-of-oscillator", {"x", "v", "y"}, {"v", "-x", "sqrt(1 - e + x)"},
                 {"0", "1", "0"}, 3 * kPi / 2 - std::acos(1 - e.value));
  s.parameters = {{"e", e.text}};
  s.duration = between(random, 6, 25).text;
  return s;
}

/// Only near to a pole: it is passed.
Scene near_pole(Random& random) {
  const Number c = between(random, 1, 6), w = scaled(random, 1e-6L, 0.1L);
  const Number end = between(random, c.value + 0.5L, c.value + 5);
  return {.kind = "singular",
          .shape = "near-pole",
          .variables = {"x"},
          .time = "t",
          .parameters = {{"c", c.text}, {"w", w.text}},
          .equations = {"w/((t - c)^2 + w^2)"},
          .initial = {"0"},
          .duration = end.text,
          .exact = {{std::atan((end.value - c.value) / w.value) + std::atan(c.value / w.value)}}};
}

/// A root that comes near to zero, and stays above.
Scene near_root(Random& random) {
  return {.kind = "singular",
          .shape = "near-root",
          .variables = {"x"},
          .time = "t",
          .parameters = {{"e", scaled(random, 1e-6L, 0.25L).text}},
          .equations = {"sqrt(sin(t) + 1 + e)"},
          .initial = {"0"},
          .duration = between(random, 3, 25).text,
          .limit = "sqrt(e + 1 + sin(t))/6"};
}

/// The end is after the duration.
Scene before_the_pole(Random& random) {
  const Number x = between(random, 0.25L, 2);
  Scene s = ends(random, "square-before-its-pole", {"x"}, {"x^2"}, {x.text}, 1);
  const Number end = between(random, 0.25L / x.value, 0.96875L / x.value);
  s.duration = end.text;
  s.singular_at.reset();
  s.exact = {{x.value / (1 - x.value * end.value)}};
  return s;
}

}  // namespace

std::vector<Maker> singular_shapes() {
  return {square,        tangent,      reciprocal,
          weierstrass,   simple_pole,  collision,
          root_of_state, pole_of_time, double_pole_of_time,
          root_of_time,  log_of_time,  asin_of_time,
          secant,        root_dip,     log_dip,
          acos_dip,      pole_dip,     root_of_oscillator,
          near_pole,     near_root,    before_the_pole};
}

}  // namespace casimir::traps
