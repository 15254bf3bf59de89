#pragma once

#include <string>
#include <vector>

#include "symbolic/model.hpp"
#include "tools/analysis/sweep/grid.hpp"

namespace casimir::tools {

/// The grid of `--over NAME=FROM:TO:N` and `--over NAME=A,B,C`.
/// \param lets  the texts of `--let`: names in an axis that the model does not have are free only
///     if these use them.
/// \throws CaseError   with the place in the option: an unknown or repeated name, a bad number, N
/// \throws UsageError  for more points than a sweep can hold
Grid read_grid(const std::vector<std::string>& over, const std::vector<std::string>& lets,
               const Model& model);

/// The expressions of `--let NAME=EXPR`, over the names of the axes.
/// \throws CaseError   with the place in the option
Lets read_lets(const std::vector<std::string>& lets, const Grid& grid, const Model& model);

/// Names that a grid and its lets set: parameters among them must be known at run time only.
std::vector<std::string> names_set(const Grid& grid, const std::vector<std::string>& lets);

}  // namespace casimir::tools
