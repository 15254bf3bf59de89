#pragma once

#include <vector>

#include "tests/adversary/residuals.hpp"

namespace casimir::adversary {

/// The rank of a matrix of balls by elimination with the largest pivot. What is left has to be zero
/// to 40 digits. \throws Unknown where 60 digits do not tell
std::size_t rank(std::vector<std::vector<Ball>> rows);

/// The number of functions among those of `functions_of` that commute with each other and with the
/// first, and whose flows are independent at this point: the largest.
std::size_t largest_involutive(const Case& claim, const At& at);

}  // namespace casimir::adversary
