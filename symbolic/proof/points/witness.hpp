#pragma once

#include <optional>
#include <vector>

#include "symbolic/proof/points/point_search.hpp"
#include "symbolic/proof/points/real_point.hpp"
#include "symbolic/prove.hpp"

namespace casimir {

/// What a witness is looked for.
struct Suspect {
  const Polynomial& numerator;  ///< in the ring, reduced; only guides the search
  GiNaC::ex expression;         ///< the expression itself
  const std::vector<GiNaC::ex>&
      domain;  ///< nothing is claimed where one of these has no real value
};

/// A point of the level inside every assumption where the expression is not zero and everything in
/// the domain has a real value, shown by GiNaC's own substitution with exact arithmetic or balls,
/// independently of the ring; empty if none was found.
/// \param brief  only at points that are quickly found
std::optional<Witness> find_witness(const Model& model, const FunctionRing& ring,
                                    PointSearch& points, RealPoints& real_points,
                                    const Suspect& suspect, const Level& level, bool brief);

}  // namespace casimir
