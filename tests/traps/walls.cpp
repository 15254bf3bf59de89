// Kinks of the right-hand side, C0 to C2 and jumps, where a smooth step does not see them.
#include <fmt/format.h>

#include "tests/traps/kinds.hpp"

namespace casimir::traps {
namespace {

/// |a| and max(a, 0) in the notation of case files.
std::string absolute(const std::string& a) { return "sqrt((" + a + ")^2)"; }
std::string positive(const std::string& a) { return "((" + absolute(a) + " + " + a + ")/2)"; }

/// An oscillator that a wall touches at the end of its swing.
template <int n>
Scene contact(Random& random) {
  return {
      .kind = "wall",
      .shape = fmt::format("contact-c{}", n - 1),
      .variables = {"x", "v"},
      .parameters = {{"k", scaled(random, 10, 1e6L).text}, {"b", between(random, 0.9L, 1).text}},
      .equations = {"v", fmt::format("-x - k*{}^{}", positive("(x - b)"), n)},
      .initial = {"0", between(random, 1, 1.25L).text},
      .duration = between(random, 3, 16).text,
      .limit = "1/(50 + 4*k^(1/2))"};
}

/// The same where the wall is as a Hamiltonian knows it, so that the drift of the energy is seen.
Scene contact_with_energy(Random& random) {
  Scene s = contact<3>(random);
  s.shape = "contact-with-energy";
  s.variables = {"q", "p"};
  s.hamiltonian = "p^2/2 + q^2/2 + k*" + positive("(q - b)") + "^4/4";
  s.equations = {"p", "-q - k*" + positive("(q - b)") + "^3"};
  return s;
}

Scene bouncing(Random& random) {
  return {.kind = "wall",
          .shape = "bouncing",
          .variables = {"x", "v"},
          .parameters = {{"k", scaled(random, 10, 1e5L).text}},
          .equations = {"v", "-1 + k*" + positive("(-x)")},
          .initial = {between(random, 0.25L, 3).text, "0"},
          .duration = between(random, 2, 12).text,
          .limit = "1/(50 + 4*k^(1/2))"};
}

/// |x| as a potential: the force is a sign.
Scene sign_of_state(Random& random) {
  const Number h = between(random, 0.25L, 4), end = between(random, 1, 15);
  const Real quarter = std::sqrt(2 * h.value), phase = std::fmod(end.value, 4 * quarter);
  const bool above = phase <= quarter || phase >= 3 * quarter;
  const Real s = above ? (phase <= quarter ? phase : phase - 4 * quarter) : phase - 2 * quarter;
  const Real x = h.value - s * s / 2;
  return {.kind = "wall",
          .shape = "sign-of-state",
          .variables = {"x", "v"},
          .equations = {"v", "-x/" + absolute("x")},
          .initial = {h.text, "0"},
          .duration = end.text,
          .exact = {{above ? x : -x, above ? -s : s}}};
}

Scene of_time(const std::string& shape, const std::string& rate, const Number& end) {
  return {.kind = "wall",
          .shape = shape,
          .variables = {"x"},
          .time = "t",
          .equations = {rate},
          .initial = {"0"},
          .duration = end.text};
}

const Real kPi = std::acos(Real(-1));

/// The sum over all arcs |t - first - 2 pi k| < half up to `end` of what a primitive gains there.
template <class Primitive>
Real over_arcs(Real first, Real half, Real end, const Primitive& primitive) {
  Real sum = 0;
  for (Real at = first; at - half < end; at += 2 * kPi)
    sum += primitive(std::min(at + half, end)) - primitive(at - half);
  return sum;
}

/// |sin(t) + a| dips, a little below 1 in a.
Scene absolute_dip(Random& random) {
  const Number e = scaled(random, 1e-5L, 0.5L), end = between(random, 5, 25);
  Scene s = of_time("absolute-dip", absolute("sin(t) + 1 - e"), end);
  const auto primitive = [&](Real t) { return 1 - std::cos(t) + (1 - e.value) * t; };
  s.exact = {{primitive(end.value) -
              2 * over_arcs(3 * kPi / 2, std::acos(1 - e.value), end.value, primitive)}};
  s.parameters = {{"e", e.text}};
  s.limit = "sqrt(e + 1 + sin(t))/8";
  return s;
}

/// |(t - c)^2 - e^2|, which is negative inside for a short time only.
Scene parabola_dip(Random& random) {
  const Number c = between(random, 1, 8), e = scaled(random, 1e-3L, 0.5L);
  const Number end = between(random, c.value + 1, c.value + 5);
  Scene s = of_time("parabola-dip", absolute("(t - c)^2 - e^2"), end);
  s.parameters = {{"c", c.text}, {"e", e.text}};
  const auto primitive = [&](Real t) {
    const Real u = t - c.value;
    return u * u * u / 3 - e.value * e.value * u;
  };
  s.exact = {{primitive(end.value) - primitive(0) + 8 * e.value * e.value * e.value / 3}};
  return s;
}

/// Nothing happens until c; then a power of t - c.
template <int n>
Scene dead_zone(Random& random) {
  const Number c = between(random, 1, 9), end = between(random, c.value + 0.25L, c.value + 5);
  Scene s =
      of_time(fmt::format("dead-zone-{}", n), positive("(t - c)") + fmt::format("^{}", n), end);
  s.parameters = {{"c", c.text}};
  s.exact = {{std::pow(end.value - c.value, Real(n + 1)) / (n + 1)}};
  return s;
}

/// A narrow arc is cut off by a threshold.
Scene threshold(Random& random) {
  const Number e = scaled(random, 1e-4L, 0.5L), k = scaled(random, 1, 1000);
  const Number end = between(random, 5, 25);
  Scene s = of_time("threshold", "k*" + positive("(sin(t) - 1 + e)"), end);
  s.parameters = {{"e", e.text}, {"k", k.text}};
  s.exact = {{k.value * over_arcs(kPi / 2, std::acos(1 - e.value), end.value,
                                  [&](Real t) { return -std::cos(t) - (1 - e.value) * t; })}};
  s.limit = "sqrt(e + 1 - sin(t))/8";
  return s;
}

/// Switched on for a short time in each turn.
Scene switched(Random& random) {
  const Number e = scaled(random, 1e-4L, 0.5L), end = between(random, 5, 25);
  Scene s = of_time("switched", "1 + (sin(t) - 1 + e)/" + absolute("sin(t) - 1 + e"), end);
  s.parameters = {{"e", e.text}};
  s.exact = {{2 * over_arcs(kPi / 2, std::acos(1 - e.value), end.value, [](Real t) { return t; })}};
  s.limit = "sqrt(e + 1 - sin(t))/8";
  return s;
}

/// A state that meets a kink while it moves on.
Scene ramp(Random& random) {
  const Number a = between(random, 0.25L, 4), c = between(random, 0.25L, 6);
  const Real z = c.value, k = 2 * a.value, at = std::log1p(k * z) / k;
  const Number end = between(random, 0.25L, 4);
  const Real before = c.value - ((z + 1 / k) * std::exp(-k * end.value) - 1 / k);
  return {.kind = "wall",
          .shape = "ramp",
          .variables = {"x"},
          .parameters = {{"a", a.text}, {"c", c.text}},
          .equations = {"1 + a*" + absolute("x - c") + " - a*(x - c)"},
          .initial = {"0"},
          .duration = end.text,
          .exact = {{end.value > at ? c.value + end.value - at : before}}};
}

/// An oscillator beside a wall that a slower one touches.
Scene kink_of_slow(Random& random) {
  return {.kind = "wall",
          .shape = "kink-of-slow",
          .variables = {"x", "v", "y"},
          .parameters = {{"e", scaled(random, 1e-4L, 0.3L).text}},
          .equations = {"v", "-x", positive("(x - 1 + e)") + "^2/e^2"},
          .initial = {"0", "1", "0"},
          .duration = between(random, 3, 25).text,
          .limit = "sqrt(e + (1 - x)^2)/10"};
}

/// Motion that turns back before the wall: a refusal would be false.
Scene wall_never_reached(Random& random) {
  const Number end = between(random, 5, 25);
  return {.kind = "wall",
          .shape = "wall-never-reached",
          .variables = {"x", "v"},
          .parameters = {{"b", between(random, 1.0625L, 2).text}},
          .equations = {"v", "-x - 1000*" + positive("(x - b)")},
          .initial = {"0", "1"},
          .duration = end.text,
          .exact = {{std::sin(end.value), std::cos(end.value)}}};
}

}  // namespace

std::vector<Maker> wall_shapes() {
  return {contact<1>,   contact<2>,    contact<3>,   contact_with_energy,
          bouncing,     sign_of_state, absolute_dip, parabola_dip,
          dead_zone<1>, dead_zone<2>,  dead_zone<3>, threshold,
          switched,     ramp,          kink_of_slow, wall_never_reached};
}

}  // namespace casimir::traps
