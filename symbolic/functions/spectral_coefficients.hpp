#pragma once

#include <cstddef>
#include <vector>

#include "symbolic/functions/generator_table.hpp"

namespace casimir::functions {

/// A function that is constant identically in a spectral parameter has constant coefficients:
/// those of its powers, and of the powers of roots that contain it, after clearing denominators
/// that are free of the coordinates.
/// \param spectral  the parameter's place among the symbols
/// \param coordinates  the first symbols are the coordinates
std::vector<Polynomial> spectral_coefficients(const GeneratorTable& table, const Polynomial& p,
                                              std::size_t spectral, std::size_t coordinates);

}  // namespace casimir::functions
