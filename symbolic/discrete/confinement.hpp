#pragma once

#include <optional>
#include <string>
#include <vector>

#include "symbolic/discrete/map_model.hpp"
#include "symbolic/search/watch.hpp"

namespace casimir::discrete {

/// What happens to orbits through the points of a hypersurface on which the Jacobian determinant of
/// a map has a zero or a pole, or the map a pole.
struct SingularOrbit {
  int lost = 0;                  ///< the first iterate that is not locally invertible there
  std::optional<int> recovered;  ///< the first one after it that is; empty: none was seen
  int until = 0;                 ///< the last iterate that was looked at
  int points = 0;                ///< that did so
};

/// Singularity confinement (Grammaticos, Ramani and Papageorgiou 1991), as evidence and no proof.
struct Confinement {
  /// What became of the orbits.
  enum class Kind {
    none,          ///< no iterate lost anything
    confined,      ///< what was lost came back in every orbit, of each irreducible hypersurface one
    not_confined,  ///< in some orbit it did not within the steps
    unclear  ///< too few terms of the series, too large degrees, a hypersurface without points
             ///< over the field, or a map that is invertible nowhere
  };
  Kind kind = Kind::unclear;
  std::vector<SingularOrbit> orbits;  ///< those that lost something, by `lost` and `recovered`
  int steps = 0;                      ///< that every orbit was followed, if it recovered nothing
};

/// "none", "confined", "not_confined" or "unclear".
std::string to_string(Confinement::Kind kind);

/// Points of the hypersurfaces are zeros and poles on random lines, modulo a prime and for random
/// parameters; near each the map is followed along its line x0 + eps v, with truncated Laurent
/// series in eps. An iterate F^k is regular there when, with 1/x_i in the place of coordinates that
/// are infinite, the entries of its Jacobian matrix are finite at eps = 0 and its determinant is
/// finite and not zero: then F^k is a local diffeomorphism, and all that the initial data say is
/// recovered. The order in eps along a general line is that along the hypersurface.
///
/// Confinement is neither sufficient for integrability (the map of Hietarinta and Viallet 1998 is
/// confined, with positive entropy) nor said here of hypersurfaces at infinity.
/// \throws ModelError  for a map that is not rational
/// {
Confinement confinement_of(const MapModel& map, const search::Watch& watch = {});
Confinement confinement_of_kahan(const Model& flow, const search::Watch& watch = {});
/// }

}  // namespace casimir::discrete
