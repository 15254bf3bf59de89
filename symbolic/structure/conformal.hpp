#pragma once

#include <string>
#include <utility>
#include <vector>

#include "symbolic/model.hpp"
#include "symbolic/prove.hpp"
#include "symbolic/search/watch.hpp"
#include "symbolic/structure/lift.hpp"

namespace casimir::structure {

/// A skew tensor T with L_X T = f T, X being the motion and f a polynomial that is not zero.
struct ConformalTensor {
  std::vector<GiNaC::ex> components;  ///< in the order of `skew_indices`
  /// Those that are not zero, with the names of their variables.
  std::vector<std::pair<std::string, std::string>> texts;
  GiNaC::ex factor;         ///< f
  std::string factor_text;  ///< in the notation of case files
  int degree = 0;           ///< of the components
  Verdict verdict = Verdict::undecided;
};

/// What a search for them found, and whether that is all.
struct ConformalReport {
  TensorType type;
  int degree = 0;
  /// With the invariant tensors, Darboux polynomials and integrals they generate all of these
  /// factors: T times a polynomial F with dF/dt = K F has the factor f + K.
  std::vector<ConformalTensor> found;
  /// Dimension of the space of what those generate, over all factors that are not zero.
  std::size_t trivial = 0;
  bool complete = false;  ///< proved: there are no others
  /// .. there are no others with coefficients in Q(parameters), that is without algebraic numbers
  bool complete_rational = false;
  bool complete_constants = false;   ///< .. nor with a constant factor, where that is all
  std::string reason;                ///< where not
  std::vector<std::string> generic;  ///< parameters that it is about generic values of
};

/// All skew tensors up to a degree whose Lie derivative along the motion is a multiple of them by a
/// polynomial that is not zero. Those that are found have coefficients in the field
/// of the rational numbers and the parameters, and so has f, whose degree is less than that of the
/// motion. Where there may be others with algebraic numbers, as sqrt(2), the answer says so. Of
/// volume forms f is the divergence of the motion or differs from it by the cofactor of a Darboux
/// polynomial; of a bracket and of a symplectic form it is constant where friction is proportional
/// to momenta. Each is proved by multiplying out.
/// \throws ModelError  where the equations of motion are no polynomials, or zero, or too many
ConformalReport find_conformal_tensors(const Model& model, TensorType type, int degree,
                                       const search::Watch& watch = {});

}  // namespace casimir::structure
