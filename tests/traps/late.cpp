// What has died out and grows back, and solutions that stay on what has long been unstable.
#include <fmt/format.h>

#include "tests/traps/kinds.hpp"

namespace casimir::traps {
namespace {

/// x' = (t - a)/b (x - sin t) + cos t has x = sin t + d exp(((t - a)^2 - a^2)/2b).
Scene delayed_loss(Random& random) {
  const Number a = between(random, 5, 30), b = between(random, 2, 20);
  const Number end = between(random, a.value, 1.75L * a.value);
  const Number d = random.one_in(2) ? Number{"0", 0} : between(random, 0.5L, 1);
  const Real s = end.value - a.value;
  return {.kind = "late",
          .shape = "delayed-loss",
          .variables = {"x"},
          .time = "t",
          .parameters = {{"a", a.text}, {"b", b.text}},
          .equations = {"(t - a)/b*(x - sin(t)) + cos(t)"},
          .initial = {d.text},
          .duration = end.text,
          .exact = {{std::sin(end.value) +
                     d.value * std::exp((s * s - a.value * a.value) / (2 * b.value))}}};
}

/// The same with the clock as a state.
Scene delayed_loss_of_clock(Random& random) {
  Scene s = delayed_loss(random);
  s.shape = "delayed-loss-of-clock";
  s.time.clear();
  s.variables.push_back("s");
  s.equations = {"(s - a)/b*(x - sin(s)) + cos(s)", "1"};
  s.initial.push_back("0");
  s.exact->push_back(constant(s.duration));
  return s;
}

/// Beside a fast oscillator, whose growth of errors hides the other.
template <int w>
Scene delayed_loss_beside(Random& random) {
  Scene s = delayed_loss(random);
  s.shape = fmt::format("delayed-loss-beside-{}", w);
  s.variables = {"x", "c", "d"};
  s.equations.push_back(fmt::format("{}*d", w));
  s.equations.push_back(fmt::format("-{}*c", w));
  s.initial.insert(s.initial.end(), {"1", "0"});
  const Real angle = w * constant(s.duration);
  s.exact->insert(s.exact->end(), {std::cos(angle), -std::sin(angle)});
  return s;
}

/// A pitchfork that is passed slowly: x is next to nothing for a while.
Scene pitchfork(Random& random) {
  const Number k = scaled(random, 50, 1200);
  return {.kind = "late",
          .shape = "pitchfork",
          .variables = {"x", "s"},
          .parameters = {{"k", k.text}},
          .equations = {"k*(s - 1)*x - x^3", "1"},
          .initial = {"1", "0"},
          .duration = between(random, 1.5L, 2.5L).text,
          .limit = "1/(3*k)",
          .small_matters = true};
}

Scene pitchfork_of_time(Random& random) {
  Scene s = pitchfork(random);
  s.shape = "pitchfork-of-time";
  s.variables = {"x"};
  s.time = "s";
  s.equations.pop_back();
  s.initial.pop_back();
  return s;
}

Scene transcritical(Random& random) {
  Scene s = pitchfork(random);
  s.shape = "transcritical";
  s.equations[0] = "k*(s - 1)*x - x^2";
  return s;
}

/// x' = -k cos(t) x: down to exp(-k) and back.
Scene breathing(Random& random) {
  const Number k = scaled(random, 5, 700), end = between(random, 1, 12);
  return {.kind = "late",
          .shape = "breathing",
          .variables = {"x"},
          .time = "t",
          .parameters = {{"k", k.text}},
          .equations = {"-k*cos(t)*x"},
          .initial = {"1"},
          .duration = end.text,
          .exact = {{std::exp(-k.value * std::sin(end.value))}}};
}

/// x' = 2k (t - c) x: down to exp(-k c^2) and back.
Scene down_and_up(Random& random) {
  const Number c = between(random, 1, 4), end = between(random, c.value, 2 * c.value + 0.25L);
  const Number k = scaled(random, 2, 700 / (c.value * c.value));
  const Real s = end.value - c.value;
  return {.kind = "late",
          .shape = "down-and-up",
          .variables = {"x", "y"},
          .time = "t",
          .parameters = {{"k", k.text}, {"c", c.text}},
          .equations = {"2*k*(t - c)*x", "cos(t)"},
          .initial = {"1", "0"},
          .duration = end.text,
          .exact = {{std::exp(k.value * (s * s - c.value * c.value)), std::sin(end.value)}}};
}

/// A carrier that dies out and comes back, and is what drives a logistic growth.
Scene spark(Random& random) {
  const Number k = between(random, 5, 30), e = between(random, 10, 300);
  const Number end = between(random, 1, 60);
  // x0 = exp(-e), written out so that it is exact in the file.
  const Real x0 = std::exp(-e.value), g = k.value / 10 * end.value;
  return {.kind = "late",
          .shape = "spark",
          .variables = {"x"},
          .parameters = {{"k", k.text}},
          .equations = {"k/10*x*(1 - x)"},
          .initial = {"exp(-(" + e.text + "))"},
          .duration = end.text,
          .exact = {{1 / (1 + std::exp(-g) * (1 / x0 - 1))}}};
}

/// The stable branch of a saddle.
Scene saddle(Random& random) {
  const Number end = between(random, 2, 45);
  return {.kind = "late",
          .shape = "saddle",
          .variables = {"x", "v"},
          .equations = {"v", "x"},
          .initial = {"1", "-1"},
          .duration = end.text,
          .exact = {{std::exp(-end.value), -std::exp(-end.value)}}};
}

/// e x' = x^2 - y, y' = x has the canard x = s/2, y = s^2/4 - e/2, which attracts up to s = 0 and
/// then is as unstable.
Scene canard(Random& random) {
  const Number e = scaled(random, 0.01L, 0.25L), b = between(random, 1, 3);
  const Number end = between(random, b.value, 1.875L * b.value);
  const Real s = end.value - b.value;
  return {.kind = "late",
          .shape = "canard",
          .variables = {"x", "y"},
          .parameters = {{"e", e.text}},
          .equations = {"(x^2 - y)/e", "x"},
          .initial = {"-(" + b.text + ")/2", "(" + b.text + ")^2/4 - (" + e.text + ")/2"},
          .duration = end.text,
          .exact = {{s / 2, s * s / 4 - e.value / 2}}};
}

/// A small state that feeds a large one only after it has grown.
Scene seed(Random& random) {
  const Number e = between(random, 20, 250), end = between(random, 2, 40);
  const Real k = 8, x = std::exp(k * end.value - e.value);
  const Real y = (x - std::exp(-e.value)) / k;
  return {.kind = "late",
          .shape = "seed",
          .variables = {"x", "y", "c", "d"},
          .equations = {"8*x", "x", "d", "-c"},
          .initial = {"exp(-(" + e.text + "))", "0", "1", "0"},
          .duration = end.text,
          .exact = {{x, y, std::cos(end.value), -std::sin(end.value)}}};
}

}  // namespace

std::vector<Maker> late_shapes() {
  return {delayed_loss,
          delayed_loss_of_clock,
          delayed_loss_beside<3>,
          delayed_loss_beside<300>,
          pitchfork,
          pitchfork_of_time,
          transcritical,
          breathing,
          down_and_up,
          spark,
          saddle,
          canard,
          seed};
}

}  // namespace casimir::traps
