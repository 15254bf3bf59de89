#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "tests/adversary/random.hpp"
#include "tests/traps/scene.hpp"

namespace casimir::traps {

using adversary::Random;

/// A number that a double holds, and its text.
struct Number {
  std::string text;
  Real value = 0;
};

/// From `least` to `most`, evenly, in steps of 2^-10 of the larger.
Number between(Random& random, Real least, Real most);
/// From `least` to `most`, both positive, evenly in the logarithm, with ten bits.
Number scaled(Random& random, Real least, Real most);

/// Makes a scene of one shape with random numbers in it.
using Maker = Scene (*)(Random&);

/// Peaks in time or in a state that are narrow against the motion.
std::vector<Maker> pulse_shapes();
/// Solutions whose first Taylor coefficients say nothing of what comes.
std::vector<Maker> quiet_shapes();
/// Kinks of the right-hand side in places that a smooth step jumps over.
std::vector<Maker> wall_shapes();
/// Potentials x^(2n) and lacunary series.
std::vector<Maker> well_shapes();
/// What has died out and grows back, or is lost long after it became unstable.
std::vector<Maker> late_shapes();
/// Fast beside slow, resonances: a refusal would be false.
std::vector<Maker> scale_shapes();
/// Starts at rest, in an equilibrium, or where a function has its end.
std::vector<Maker> rest_shapes();
/// What announces itself below any tolerance: walls and peaks with factors next to nothing.
std::vector<Maker> faint_shapes();
/// Ends of the solution, or of what is real, at a known time; and what only looks like one.
std::vector<Maker> singular_shapes();

}  // namespace casimir::traps
