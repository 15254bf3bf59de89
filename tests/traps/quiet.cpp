// Solutions whose first Taylor coefficients say nothing of what comes.
#include <fmt/format.h>

#include "tests/traps/kinds.hpp"

namespace casimir::traps {
namespace {

Scene of_time(const std::string& shape, const std::string& rate, const Number& end) {
  return {.kind = "quiet",
          .shape = shape,
          .variables = {"x"},
          .time = "t",
          .equations = {rate},
          .initial = {"0"},
          .duration = end.text};
}

template <int n>
Scene power_of_time(Random& random) {
  const Number a = between(random, 0.5L, 2), end = between(random, 0.5L, 4);
  Scene s = of_time(fmt::format("power-of-time-{}", n), fmt::format("(t/a)^{}", n), end);
  s.parameters = {{"a", a.text}};
  s.exact = {{std::pow(end.value / a.value, Real(n)) * end.value / (n + 1)}};
  return s;
}

/// Away from where it is flat, at first.
template <int n>
Scene power_of_state(Random& random) {
  const Number c = random.one_in(3) ? Number{"0", 0} : between(random, 0.25L, 2);
  const Number end = between(random, c.value + 0.5L, c.value + 2);
  const Real far = end.value - c.value;
  return {
      .kind = "quiet",
      .shape = fmt::format("power-of-state-{}", n),
      .variables = {"x", "s"},
      .equations = {fmt::format("s^{}", n), "1"},
      .initial = {"0", "-(" + c.text + ")"},
      .duration = end.text,
      .exact = {{(std::pow(far, Real(n + 1)) + std::pow(c.value, Real(n + 1))) / (n + 1), far}}};
}

template <int n>
Scene one_minus_cosine(Random& random) {
  const Number end = between(random, 1, 40);
  Scene s =
      of_time(fmt::format("one-minus-cosine-{}", n), fmt::format("((1 - cos(a*t))/2)^{}", n), end);
  s.parameters = {{"a", between(random, 0.5L, 2).text}};
  s.limit = fmt::format("sqrt(1/{} + 1 + cos(a*t))/6/a", n);
  return s;
}

/// A window with a flat floor before, in and after it.
template <int n>
Scene window(Random& random) {
  const Number c = between(random, 3, 9), w = between(random, 0.25L, 2);
  Scene s = of_time(fmt::format("window-{}", n), fmt::format("1/(1 + ((t - c)/w)^{})", n),
                    between(random, c.value, c.value + 5));
  s.parameters = {{"c", c.text}, {"w", w.text}};
  s.limit = fmt::format("w/{}", n);
  return s;
}

/// At rest, and forced later by a power of time.
template <int n>
Scene forced_later(Random& random) {
  Scene s = of_time(fmt::format("forced-later-{}", n), "v", between(random, 2, 12));
  s.variables.push_back("v");
  s.equations.push_back(fmt::format("-a*x + (t/b)^{}", n));
  s.initial.push_back("0");
  s.parameters = {{"a", between(random, 0.5L, 9).text}, {"b", between(random, 4, 10).text}};
  s.limit = "1/10";
  return s;
}

/// x'' = -x^4 and x'' = -x^5 as quadratic systems: their series have gaps.
Scene quadratic_quartic(Random& random) {
  const Number v = between(random, 0.25L, 1.5L);
  return {.kind = "quiet",
          .shape = "quadratic-quartic",
          .variables = {"x", "v", "y"},
          .equations = {"v", "-y^2", "2*x*v"},
          .initial = {"0", v.text, "0"},
          .duration = between(random, 1, 2.5L).text,
          .limit = "1/20"};
}

Scene quadratic_quintic(Random& random) {
  return {.kind = "quiet",
          .shape = "quadratic-quintic",
          .variables = {"x", "v", "y", "z", "u"},
          .equations = {"v", "-x*z", "2*u", "4*y*u", "v^2 - y*z"},
          .initial = {"0", between(random, 0.25L, 1.5L).text, "0", "0", "0"},
          .duration = between(random, 1, 20).text,
          .limit = "1/20"};
}

/// A quadratic system whose cubic terms come only through a second state.
Scene quadratic_cubic(Random& random) {
  return {.kind = "quiet",
          .shape = "quadratic-cubic",
          .variables = {"x", "v", "y"},
          .parameters = {{"a", scaled(random, 0.1L, 100).text}},
          .equations = {"v", "-a*x*y", "2*x*v"},
          .initial = {"0", between(random, 0.25L, 1.5L).text, "0"},
          .duration = between(random, 1, 20).text,
          .limit = "1/50"};
}

/// A polynomial of high degree in the time, with a wide gap between two powers.
Scene gap(Random& random) {
  const Number a = scaled(random, 1e-3L, 1), end = between(random, 0.5L, 3);
  Scene s = of_time("gap", "1 + a*t^45", end);
  s.parameters = {{"a", a.text}};
  s.exact = {{end.value + a.value * std::pow(end.value, Real(46)) / 46}};
  return s;
}

}  // namespace

std::vector<Maker> quiet_shapes() {
  return {power_of_time<12>,    power_of_time<40>,
          power_of_state<30>,   power_of_state<60>,
          one_minus_cosine<15>, one_minus_cosine<60>,
          window<12>,           window<40>,
          forced_later<20>,     forced_later<50>,
          quadratic_quartic,    quadratic_quintic,
          quadratic_cubic,      gap};
}

}  // namespace casimir::traps
