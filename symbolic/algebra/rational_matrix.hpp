#pragma once

#include <cln/integer.h>
#include <cln/rational.h>

#include <optional>
#include <vector>

namespace casimir {

/// A matrix of exact rationals, by rows.
using RationalMatrix = std::vector<std::vector<cln::cl_RA>>;

std::size_t rank(const RationalMatrix& rows);

/// The solution of the equations whose rows are the coefficients and then the right-hand side;
/// empty if there is none or more than one.
std::optional<std::vector<cln::cl_RA>> solve_unique(const RationalMatrix& equations);

/// The first columns, from the left, that make a regular minor of full rank.
std::vector<std::size_t> independent_columns(const RationalMatrix& rows);

/// A basis of the vectors that all rows, of so many columns, are orthogonal to: whole numbers
/// without a common divisor.
std::vector<std::vector<cln::cl_I>> null_space(const RationalMatrix& rows, std::size_t columns);

}  // namespace casimir
