#pragma once

#include <string>
#include <vector>

#include "runtime/kernels/lanes/jet_tables.h"
#include "runtime/program.hpp"

namespace casimir {

/// A function of the states as the kernels for Taylor series in lanes want it.
struct JetLayout {
  std::vector<casimir_jet_line> lines;
  int rows = 0;

  /// Points into this object.
  casimir_jet_tables tables() const { return {static_cast<int>(lines.size()), rows, lines.data()}; }
};

/// \param program  with the inputs of a right-hand side; its first output is the function.
/// \throws std::invalid_argument  if the function depends on more than the first `states` inputs.
JetLayout jet_layout(const Program& program, std::size_t states);

/// The function at a point.
/// \param values  room for one number for each line.
double value_of(const JetLayout& layout, const double* states, std::vector<double>& values);

/// The kernel for registers of so many lanes: 2, 4 or 8.
/// \throws std::invalid_argument  if there is none.
casimir_jet_kernel* jet_kernel(int lanes);

}  // namespace casimir
