#pragma once

#include <cln/rational.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

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

/// The eigenvalues that all k points of a generic planar potential may have together, less 1: the
/// lists of k numbers that are not zero, in order, with sum 1/number = -1 and number + 1 in the
/// table (Maciejewski and Przybylska, Phys. Lett. A 327 (2004) 461). There are finitely many: a
/// least positive number is at most n/rest, where n of them have to add up to the rest.
/// \param k  3 or more
std::vector<std::vector<cln::cl_RA>> darboux_relation_solutions(long k);

}  // namespace casimir::obstruction
