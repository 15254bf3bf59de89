#pragma once

#include <string>

#include "tools/plot/sheet.hpp"
#include "tools/stress/matrix.hpp"

namespace casimir::tools {

/// Draws the matrix: a row for each scene, a column for each method, and in each cell what became
/// of it, so that it can be read without colour: for a right answer the digits that are right, in a
/// heavy frame where none took less time; else a word.
/// \throws SystemError  as `draw`.
void draw_matrix(const StressMatrix& matrix, const Sheet& sheet);

}  // namespace casimir::tools
