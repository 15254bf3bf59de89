#pragma once

#include <string>
#include <vector>

#include "codegen/dag/expression_dag.hpp"

namespace casimir::codegen {

/// An elliptic function (see EllipticFunction) by roots, sines and arcsines, so that everything
/// that is known of these holds for it: derivatives, Taylor series, generated code in any language.
///
/// Jacobi's functions by seven steps of the arithmetic-geometric mean (DLMF 22.20): for moduli up
/// to 1 - 10^-12 to the precision of doubles. Carlson's integrals by ten duplications and the
/// series to the seventh order (DLMF 19.36; Carlson, Numer. Algorithms 10 (1995) 13): to 20 digits
/// where the arguments are within ten orders of magnitude of each other, to 15 within forty. It is
/// an approximation all the same, and no value of more digits nor an enclosure comes from it.
/// \param name  one of `elliptic_function_names`, with as many arguments as it takes
Scaled elliptic_node(Dag& dag, const std::string& name, const std::vector<Scaled>& arguments);

}  // namespace casimir::codegen
