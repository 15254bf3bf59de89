#pragma once

#include <string>
#include <vector>

#include "tests/adversary/case.hpp"
#include "tests/adversary/evaluate.hpp"
#include "tests/adversary/random.hpp"

namespace casimir::adversary {

/// What 60 digits say of a claim.
enum class Finding {
  holds,    ///< at every real point that was tried, and there were some
  fails,    ///< certainly, at some real point inside of every assumption, or along an orbit
  nowhere,  ///< no real point was met
  unclear,  ///< too few points, or none where 60 digits suffice
};

std::string to_string(Finding finding);

/// Decides a claim by its value at random real points, from the trees, in Arb: what should vanish
/// is zero to 40 digits, or certainly not zero. Ranks are found by elimination with balls, and a
/// claim on a level by following orbits that start there.
/// \param more  further conditions on the points, as those that a proof names
Finding examine(const Case& claim, Random& random, const std::vector<Assumption>& more = {});

/// Whether the claim fails at a point that someone shows: inside of every assumption, on the level,
/// and with a residual that is certainly not zero.
/// \return empty if so, else what is wrong with the point
std::string examine_witness(const Case& claim, const Point& point);

/// Of a condition: one of these parts, each with all of its inequalities.
using Alternatives = std::vector<std::vector<Assumption>>;

/// The number N of "rank N" is the rank of the bracket at almost every point at which all
/// conditions hold.
Finding examine_rank(const Case& claim, std::size_t rank, Random& random,
                     const std::vector<Alternatives>& where);

}  // namespace casimir::adversary
