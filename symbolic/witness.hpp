#pragma once

#include <functional>
#include <optional>

#include "symbolic/point_search.hpp"
#include "symbolic/prove.hpp"

namespace casimir {

/// A point of the level inside every assumption where an expression is not zero, shown by GiNaC's
/// own substitution and exact arithmetic, independently of the ring; empty if none was found.
/// \param numerator  the expression in the ring, reduced; only guides the search
/// \param by_ginac   the expression itself, called at most once
std::optional<Witness> find_witness(const Model& model, const FunctionRing& ring,
                                    PointSearch& points, const Polynomial& numerator,
                                    const std::function<GiNaC::ex()>& by_ginac, const Level& level);

}  // namespace casimir
