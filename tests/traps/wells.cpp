// Flat wells with steep walls: series with gaps, and walls that only high powers make.
#include <fmt/format.h>

#include "tests/traps/kinds.hpp"

namespace casimir::traps {
namespace {

/// x'' = -x^n.
template <int n>
Scene well(Random& random) {
  const bool from_rest = random.one_in(3);
  return {.kind = "well",
          .shape = fmt::format("well-{}", n),
          .variables = {"x", "v"},
          .equations = {"v", fmt::format("-x^{}", n)},
          .initial = {from_rest ? between(random, 0.75L, 1.25L).text : "0",
                      from_rest ? "0" : between(random, 0.5L, 1.5L).text},
          .duration = between(random, 5, 30).text,
          .limit = "1/50"};
}

template <int n>
Scene well_with_energy(Random& random) {
  return {.kind = "well",
          .shape = fmt::format("well-with-energy-{}", n),
          .variables = {"q", "p"},
          .equations = {"p", fmt::format("-q^{}", n)},
          .hamiltonian = fmt::format("p^2/2 + q^{0}/{0}", n + 1),
          .initial = {"0", between(random, 0.5L, 1.5L).text},
          .duration = between(random, 5, 50).text,
          .limit = "1/50"};
}

/// An exponential wall beside a spring.
Scene exponential_wall(Random& random) {
  return {.kind = "well",
          .shape = "exponential-wall",
          .variables = {"x", "v"},
          .parameters = {{"k", scaled(random, 10, 1000).text}},
          .equations = {"v", "-x - exp(k*(x - 1))"},
          .initial = {"0", between(random, 0.9L, 1.25L).text},
          .duration = between(random, 3, 15).text,
          .limit = "sqrt((x - 1)^2 + 1/k^2)/6"};
}

/// x' = x - x^n, which Bernoulli solved.
template <int n>
Scene bernoulli(Random& random) {
  const Number start = between(random, 0.0625L, 0.75L), end = between(random, 1, 12);
  const Real m = n - 1;
  return {.kind = "well",
          .shape = fmt::format("bernoulli-{}", n),
          .variables = {"x"},
          .equations = {fmt::format("x - x^{}", n)},
          .initial = {start.text},
          .duration = end.text,
          .exact = {
              {std::pow(1 + (std::pow(start.value, -m) - 1) * std::exp(-m * end.value), -1 / m)}}};
}

/// Two wells beside each other, of different powers.
Scene coupled(Random& random) {
  return {
      .kind = "well",
      .shape = "coupled-wells",
      .variables = {"x", "y", "u", "v"},
      .equations = {"u", "v", "-x^21 - (x - y)/10", "-y^7 + (x - y)/10"},
      .initial = {"0", "0", between(random, 0.5L, 1.25L).text, between(random, 0.5L, 1.25L).text},
      .duration = between(random, 2, 8).text,
      .limit = "1/40"};
}

/// A well in a quadratic disguise: x^8 through three squares.
Scene squared_squares(Random& random) {
  return {.kind = "well",
          .shape = "squared-squares",
          .variables = {"x", "v", "y", "z"},
          .equations = {"v", "-x*y*z", "2*x*v", "4*y*x*v"},
          .initial = {"0", between(random, 0.5L, 1.25L).text, "0", "0"},
          .duration = between(random, 2, 20).text,
          .limit = "1/40"};
}

}  // namespace

std::vector<Maker> well_shapes() {
  return {well<5>,
          well<9>,
          well<15>,
          well<21>,
          well<29>,
          well_with_energy<5>,
          well_with_energy<9>,
          well_with_energy<29>,
          exponential_wall,
          bernoulli<5>,
          bernoulli<31>,
          coupled,
          squared_squares};
}

}  // namespace casimir::traps
