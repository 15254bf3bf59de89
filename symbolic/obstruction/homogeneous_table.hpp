#pragma once

#include <cln/rational.h>

#include <array>
#include <optional>
#include <string>

namespace casimir::obstruction {

/// Whether a homogeneous potential of the integer degree k may have the eigenvalue lambda at a
/// point c with V'(c) = c and be integrable (Morales-Ruiz and Ramis, Methods Appl. Anal. 8 (2001)
/// 97): the table's rows are numbers A + B (a + b p)^2 with integers p.
/// \param k  not 0
/// \return  the row and p, as "-1/24 + 1/6*(1 + 3*p)^2 with p = 2"; empty where none has it
std::optional<std::string> integrable_eigenvalue(long k, const cln::cl_RA& lambda);

/// The squares of the differences of exponents of the normal variational equation along that
/// point's straight line: 1/k, 1/2, sqrt((k - 2)^2 + 8 k lambda)/(2 k).
std::array<cln::cl_RA, 3> straight_line_differences(long k, const cln::cl_RA& lambda);

}  // namespace casimir::obstruction
