#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/analysis/section/spread.hpp"
#include "tools/text/files/ensemble_file.hpp"

namespace casimir::tools {

/// A CSV file with columns of states, and those that a table of `section` has beside them.
/// \throws CaseError, UsageError  as `read_ensemble`
EnsembleFile read_seeds(const std::string& path, const std::vector<std::string>& states,
                        const Limits& limits);

/// Where the file has the states, some of which `section` may have given another name, as one that
/// is called u; nothing for those that it does not have.
std::vector<std::optional<std::size_t>> columns_of(const EnsembleFile& file,
                                                   const std::vector<std::string>& states);

/// The seeds of a CSV file: a column for each variable, or the columns u and v, the plotted pair,
/// for which a point of the level set is sought. What a section writes can be read.
/// \param near  points of the level set, to begin the search for u and v from.
/// \throws CaseError, UsageError  with the line: what cannot be read, a state that is not on the
///                                level, a pair that no motion has.
std::vector<LevelSet::Vector> seeds_of(const std::string& path, const LevelSet& level,
                                       const std::function<std::vector<PlacedPoint>()>& near);

}  // namespace casimir::tools
