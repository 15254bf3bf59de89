#pragma once

#include <string>
#include <vector>

#include "tools/analysis/section/spread.hpp"

namespace casimir::tools {

/// The seeds of a CSV file: a column for each variable, or the columns u and v, the plotted pair,
/// for which a point of the level set is sought. What a section writes can be read.
/// \param near  points of the level set, to begin the search for u and v from.
/// \throws CaseError, UsageError  with the line: what cannot be read, a state that is not on the
///                                level, a pair that no motion has.
std::vector<LevelSet::Vector> seeds_of(const std::string& path, const LevelSet& level,
                                       const std::function<std::vector<PlacedPoint>()>& near);

}  // namespace casimir::tools
