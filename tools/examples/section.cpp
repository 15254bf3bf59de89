// A Poincare section of two coupled oscillators: which orbits on the level are chaotic.
#include <cstdio>

#include "tools/analysis/section/section.hpp"
#include "tools/analysis/system.hpp"

int main() {
  const GiNaC::symbol x("x"), y("y"), u("u"), v("v");
  const casimir::Model model =
      casimir::hamiltonian_system("Henon-Heiles", {x, y}, {u, v},
                                  (u * u + v * v + x * x + y * y) / 2 + x * x * y - y * y * y / 3);
  const casimir::Scene scene = casimir::scene_from(model, {0, GiNaC::numeric(1, 10), 0, 0}, 1);
  casimir::PoincareOptions options;
  options.request = {{{x, "x"}}, {}, {{y, "y"}, {v, "v"}}, {}, 1. / 8, {}};
  options.orbits = 8;
  options.points = 200;
  const casimir::PoincareSection map = section(model, scene, options);
  std::printf("%s: %zu crossings\n", map.problem->level_text().c_str(), map.crossings());
  for (const casimir::OrbitReport& orbit : map.orbits)
    std::printf("from y = %6.3f, v = %6.3f: %s\n", orbit.places[0][0], orbit.places[0][1],
                orbit.chaotic ? "chaotic" : "regular");
}
