#pragma once

#include <cln/rational.h>

#include <optional>
#include <string>
#include <vector>

#include "codegen/dag/expression_dag.hpp"

namespace casimir::codegen {

/// An elliptic function (see EllipticFunction) by roots, sines and arcsines, so that everything
/// that is known of these holds for it: derivatives, Taylor series, generated code in any language.
///
/// Jacobi's functions by eight steps of the arithmetic-geometric mean (DLMF 22.20): for moduli up
/// to 1 - 10^-12 to the precision of doubles; by as many as 40 digits take where the modulus is a
/// number. Carlson's integrals by ten duplications and the
/// series to the seventh order (DLMF 19.36; Carlson, Numer. Algorithms 10 (1995) 13): to 20 digits
/// where the arguments are within ten orders of magnitude of each other, to 15 within forty. It is
/// an approximation all the same, and no value of more digits nor an enclosure comes from it.
/// \param name     one of `elliptic_function_names`, with as many arguments as it takes
/// \param modulus  of Jacobi's functions, where it is a number: the means are numbers then
/// \throws ModelError  for moduli that are not between -1 and 1, or too near to one of them, and for
///                     arguments of Carlson's integrals that are not positive or beyond doubles
Scaled elliptic_node(Dag& dag, const std::string& name, const std::vector<Scaled>& arguments,
                     const std::optional<cln::cl_RA>& modulus);

}  // namespace casimir::codegen
