// Fast beside slow, and resonances. All of them are tame: a refusal is false.
#include <fmt/format.h>

#include "tests/traps/kinds.hpp"

namespace casimir::traps {
namespace {

/// Two oscillators that know nothing of each other.
Scene two_frequencies(Random& random) {
  const Number w = scaled(random, 10, 3000), end = between(random, 1, 12);
  const Real angle = w.value * end.value;
  return {
      .kind = "scales",
      .shape = "two-frequencies",
      .variables = {"a", "b", "x", "v"},
      .parameters = {{"w", w.text}},
      .equations = {"w*b", "-w*a", "v", "-x"},
      .initial = {"1", "0", "1", "0"},
      .duration = end.text,
      .exact = {{std::cos(angle), -std::sin(angle), std::cos(end.value), -std::sin(end.value)}}};
}

/// The slow state sums what the fast one does.
Scene rectified(Random& random) {
  const Number w = scaled(random, 10, 3000), end = between(random, 1, 12);
  const Real angle = w.value * end.value;
  return {.kind = "scales",
          .shape = "rectified",
          .variables = {"a", "b", "y"},
          .parameters = {{"w", w.text}},
          .equations = {"w*b", "-w*a", "a^2"},
          .initial = {"1", "0", "0"},
          .duration = end.text,
          .exact = {{std::cos(angle), -std::sin(angle),
                     end.value / 2 + std::sin(2 * angle) / (4 * w.value)}}};
}

/// Prothero and Robinson's stiff problem.
Scene stiff(Random& random) {
  const Number l = scaled(random, 10, 1e6L), end = between(random, 1, 12);
  const Number d = random.one_in(2) ? Number{"0", 0} : Number{"1", 1};
  return {.kind = "scales",
          .shape = "prothero-robinson",
          .variables = {"x"},
          .time = "t",
          .parameters = {{"l", l.text}},
          .equations = {"-l*(x - cos(t)) - sin(t)"},
          .initial = {d.value > 0 ? "2" : "1"},
          .duration = end.text,
          .exact = {{std::cos(end.value) + d.value * std::exp(-l.value * end.value)}}};
}

/// Ever faster.
Scene chirp(Random& random) {
  const Number end = between(random, 1, 40);
  const Real angle = end.value * end.value;
  return {.kind = "scales",
          .shape = "chirp",
          .variables = {"x"},
          .time = "t",
          .equations = {"2*t*cos(t^2)"},
          .initial = {"0"},
          .duration = end.text,
          .exact = {{std::sin(angle)}}};
}

/// An oscillator that a chirp meets for a moment.
Scene passage(Random& random) {
  return {.kind = "scales",
          .shape = "passage-of-resonance",
          .variables = {"x", "v"},
          .time = "t",
          .parameters = {{"w", between(random, 5, 15).text}},
          .equations = {"v", "-w^2*x + sin(t^2/2)"},
          .initial = {"0", "0"},
          .duration = between(random, 5, 25).text,
          .limit = "1/20"};
}

/// Near resonance: the beat is long.
Scene beat(Random& random) {
  const Number e = scaled(random, 1e-6L, 0.25L), end = between(random, 5, 60);
  const Real w = 1 + e.value, t = end.value, d = 1 - w * w;
  return {.kind = "scales",
          .shape = "beat",
          .variables = {"x", "v"},
          .time = "t",
          .parameters = {{"e", e.text}},
          .equations = {"v", "-x + cos((1 + e)*t)"},
          .initial = {"0", "0"},
          .duration = end.text,
          .exact = {{-2 * std::sin((w + 1) / 2 * t) * std::sin((w - 1) / 2 * t) / d,
                     (std::sin(t) - w * std::sin(w * t)) / d}}};
}

/// A narrow resonance in a state that passes it again and again.
Scene thin_resonance(Random& random) {
  return {.kind = "scales",
          .shape = "thin-resonance",
          .variables = {"x", "v", "y"},
          .parameters = {{"w", scaled(random, 1e-4L, 0.25L).text},
                         {"c", between(random, -0.75L, 0.75L).text}},
          .equations = {"v", "-x", "w/((x - c)^2 + w^2)"},
          .initial = {"1", "0", "0"},
          .duration = between(random, 3, 20).text,
          .limit = "sqrt(w^2 + (x - c)^2)/6"};
}

/// A small fast oscillation on a large slow one.
Scene ripple(Random& random) {
  const Number w = scaled(random, 50, 2000), end = between(random, 1, 12);
  const Number a = scaled(random, 1e-9L, 1e-2L);
  const Real t = end.value;
  return {.kind = "scales",
          .shape = "ripple",
          .variables = {"x"},
          .time = "t",
          .parameters = {{"w", w.text}, {"a", a.text}},
          .equations = {"cos(t) + a*w*cos(w*t)"},
          .initial = {"0"},
          .duration = end.text,
          .exact = {{std::sin(t) + a.value * std::sin(w.value * t)}}};
}

}  // namespace

std::vector<Maker> scale_shapes() {
  return {two_frequencies, rectified, stiff, chirp, passage, beat, thin_resonance, ripple};
}

}  // namespace casimir::traps
