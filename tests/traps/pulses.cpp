// Peaks that are narrow against the motion: a step which sees none of their flanks passes them.
#include <fmt/format.h>

#include <array>

#include "tests/traps/kinds.hpp"

namespace casimir::traps {
namespace {

const Real kPi = std::acos(Real(-1));

/// The oscillator x'' = -x carries y' = exp(-((x - c)/w)^2)/w past the peak.
Scene in_a_state(Random& random) {
  const Number w = scaled(random, 1e-3L, 1), c = between(random, -0.9L, 0.9L);
  return {.kind = "pulse",
          .shape = "gauss-of-oscillator",
          .variables = {"x", "v", "y"},
          .parameters = {{"w", w.text}, {"c", c.text}},
          .equations = {"v", "-x", "exp(-((x - c)/w)^2)/w"},
          .initial = {"1", "0", "0"},
          .duration = between(random, 4, 25).text,
          .limit = "sqrt(w^2 + (x - c)^2)/4"};
}

/// The same with sech, whose tails are long.
Scene sech_in_a_state(Random& random) {
  return {.kind = "pulse",
          .shape = "sech-of-oscillator",
          .variables = {"x", "v", "y"},
          .parameters = {{"w", scaled(random, 0.01L, 1).text}},
          .equations = {"v", "-x", "2/(exp(x/w) + exp(-x/w))/w"},
          .initial = {"1", "0", "0"},
          .duration = between(random, 4, 25).text,
          .limit = "sqrt(w^2 + x^2)/8"};
}

struct Peak {
  Number w, c, end;
};

Peak peak(Random& random, Real narrowest) {
  Peak p{scaled(random, narrowest, 1), between(random, 1, 12), {}};
  p.end = between(random, p.c.value + 1, p.c.value + 8);
  return p;
}

Scene of_time(const char* shape, const Peak& p, const std::string& rate) {
  return {.kind = "pulse",
          .shape = shape,
          .variables = {"x"},
          .time = "t",
          .parameters = {{"w", p.w.text}, {"c", p.c.text}},
          .equations = {rate},
          .initial = {"0"},
          .duration = p.end.text,
          .limit = "sqrt(w^2 + (t - c)^2)/4"};
}

Scene gauss(Random& random) {
  const Peak p = peak(random, 1e-3L);
  Scene s = of_time("gauss-of-time", p, "exp(-((t - c)/w)^2)/w");
  s.exact = {{std::sqrt(kPi) / 2 *
              (std::erf((p.end.value - p.c.value) / p.w.value) + std::erf(p.c.value / p.w.value))}};
  return s;
}

Scene sech(Random& random) {
  const Peak p = peak(random, 1.L / 32);
  Scene s = of_time("sech-of-time", p, "2/(exp((t - c)/w) + exp(-(t - c)/w))/w");
  s.exact = {{2 * std::atan(std::exp((p.end.value - p.c.value) / p.w.value)) -
              2 * std::atan(std::exp(-p.c.value / p.w.value))}};
  return s;
}

Scene lorentz(Random& random) {
  const Peak p = peak(random, 1e-3L);
  Scene s = of_time("lorentz-of-time", p, "1/(1 + ((t - c)/w)^2)/w");
  s.exact = {{std::atan((p.end.value - p.c.value) / p.w.value) + std::atan(p.c.value / p.w.value)}};
  return s;
}

/// A front: what was switched off is switched on for good.
Scene front(Random& random) {
  const Peak p = peak(random, 1.L / 32);
  Scene s = of_time("front-of-time", p, "1/(1 + exp(-(t - c)/w))");
  const auto primitive = [&](Real t) {
    const Real u = (t - p.c.value) / p.w.value;
    return p.w.value * (u > 0 ? u + std::log1p(std::exp(-u)) : std::log1p(std::exp(u)));
  };
  s.exact = {{primitive(p.end.value) - primitive(0)}};
  return s;
}

/// The clock is a state.
Scene gauss_of_clock(Random& random) {
  const Peak p = peak(random, 1e-3L);
  Scene s = of_time("gauss-of-clock", p, "exp(-((s - c)/w)^2)/w");
  s.variables.push_back("s");
  s.equations.push_back("1");
  s.initial.push_back("0");
  s.time.clear();
  s.limit = "sqrt(w^2 + (s - c)^2)/4";
  s.exact = {
      {std::sqrt(kPi) / 2 *
           (std::erf((p.end.value - p.c.value) / p.w.value) + std::erf(p.c.value / p.w.value)),
       p.end.value}};
  return s;
}

/// Relaxing, while the pulse comes.
Scene gauss_and_decay(Random& random) {
  return of_time("gauss-and-decay", peak(random, 1e-3L), "-x + exp(-((t - c)/w)^2)/w");
}

/// A blow to an oscillator, at rest or not.
Scene gauss_on_oscillator(Random& random) {
  const Peak p = peak(random, 1e-3L);
  Scene s = of_time("gauss-on-oscillator", p, "v");
  s.variables.push_back("v");
  s.equations.push_back("-x + exp(-((t - c)/w)^2)/w");
  s.initial = {random.one_in(2) ? "0" : "1/2", "0"};
  return s;
}

/// A wide pulse, which is seen, with a narrow one on it.
Scene two_widths(Random& random) {
  const Peak p = peak(random, 1e-3L);
  Scene s = of_time("two-widths", p, "exp(-((t - b)/d)^2) + exp(-((t - c)/w)^2)/w");
  const Number b = between(random, 1, 8), d = between(random, 0.5L, 2);
  s.parameters.emplace_back("b", b.text);
  s.parameters.emplace_back("d", d.text);
  const auto part = [&](Real c, Real w) {
    return std::sqrt(kPi) / 2 * (std::erf((p.end.value - c) / w) + std::erf(c / w));
  };
  s.exact = {{part(p.c.value, p.w.value) + d.value * part(b.value, d.value)}};
  return s;
}

template <int n>
Scene sine_power(Random& random) {
  const Number a = between(random, 0.5L, 2);
  return {.kind = "pulse",
          .shape = fmt::format("sine-power-{}", n),
          .variables = {"x"},
          .time = "t",
          .parameters = {{"a", a.text}, {"b", random.one_in(2) ? "0" : between(random, 0, 3).text}},
          .equations = {fmt::format("sin(a*t + b)^{}", n)},
          .initial = {"0"},
          .duration = between(random, 5, 60).text,
          .limit = fmt::format("sqrt(1/{} + cos(a*t + b)^2)/5/a", n)};
}

Scene kicked_rotor(Random& random) {
  return {.kind = "pulse",
          .shape = "kicked-rotor",
          .variables = {"q", "p"},
          .time = "t",
          .parameters = {{"k", scaled(random, 10, 3000).text}, {"a", scaled(random, 1, 8).text}},
          .equations = {"p", "-a*sin(q)*exp(-k*(1 + cos(t)))"},
          .initial = {"1", between(random, 0.1L, 0.4L).text},
          .duration = between(random, 5, 14).text,
          .limit = "sqrt(1/k + 1 + cos(t))/6"};
}

/// A particle and a repulsive bump that it cannot, or can, pass.
Scene bump(Random& random) {
  return {
      .kind = "pulse",
      .shape = "bump",
      .variables = {"q", "p"},
      .parameters = {{"k", scaled(random, 1, 100000).text}, {"a", between(random, 0.25L, 4).text}},
      .equations = {"p", "2*a*k*q*exp(-k*q^2)"},
      .hamiltonian = "p^2/2 + a*exp(-k*q^2)",
      .initial = {between(random, -5, -2).text, between(random, 0.8L, 1.2L).text},
      .duration = between(random, 4, 9).text,
      .limit = "sqrt(1/k + q^2)/8"};
}

/// The same as equations without an integral, and with one more bump that nothing reaches.
Scene bump_unwatched(Random& random) {
  Scene s = bump(random);
  s.shape = "bump-unwatched";
  s.hamiltonian.clear();
  return s;
}

/// u = exp(-(s/w)^2) as the solution of a quadratic system: it starts from next to nothing.
Scene quadratic_gauss(Random& random) {
  const Number w = between(random, 0.5L, 1), c = between(random, 2, 5);
  const Number end = between(random, c.value + 2, c.value + 6);
  const auto bell = [&](Real s) { return std::exp(-(s / w.value) * (s / w.value)); };
  const Real far = end.value - c.value;
  return {.kind = "pulse",
          .shape = "quadratic-gauss",
          .variables = {"s", "u", "y"},
          .parameters = {{"w", w.text}},
          .equations = {"1", "-2*s*u/w^2", "u"},
          .initial = {"-" + c.text, fmt::format("exp(-(({})/({}))^2)", c.text, w.text), "0"},
          .duration = end.text,
          .exact = {{far, bell(far),
                     w.value * std::sqrt(kPi) / 2 *
                         (std::erf(far / w.value) + std::erf(c.value / w.value))}}};
}

}  // namespace

std::vector<Maker> pulse_shapes() {
  return {in_a_state,
          sech_in_a_state,
          gauss,
          sech,
          lorentz,
          front,
          gauss_of_clock,
          gauss_and_decay,
          gauss_on_oscillator,
          two_widths,
          sine_power<20>,
          sine_power<60>,
          sine_power<200>,
          kicked_rotor,
          bump,
          bump_unwatched,
          quadratic_gauss};
}

}  // namespace casimir::traps
