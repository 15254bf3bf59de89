#pragma once

#include <string>
#include <utility>
#include <vector>

#include "symbolic/model.hpp"
#include "symbolic/prove.hpp"
#include "symbolic/search/watch.hpp"
#include "symbolic/structure/lift.hpp"

namespace casimir::structure {

/// An invariant tensor that was found.
struct Tensor {
  std::vector<GiNaC::ex> components;  ///< in the order of `skew_indices`
  /// Those that are not zero, with the names of their variables: "M1,M2" and "-M3".
  std::vector<std::pair<std::string, std::string>> texts;
  int degree = 0;  ///< of the components
  Verdict verdict = Verdict::undecided;
};

/// What a search for invariant tensors found, and whether that is all.
struct TensorReport {
  TensorType type;
  int degree = 0;
  std::vector<Tensor> found;  ///< without what the known ones generate
  /// Of the space of invariant tensors with polynomial components of degree 0, 1, .. at most.
  std::vector<std::size_t> dimensions;
  bool complete = false;             ///< proved: there are no others, and the dimensions are right
  std::string reason;                ///< where not
  std::vector<std::string> generic;  ///< parameters that it is about generic values of
  /// What the components are polynomials in beside the variables and the time.
  std::vector<std::string> functions;
};

/// All skew tensors T with L_X T = 0 and components of a degree, X being the motion, less those
/// that known ones generate over the polynomial integrals: the motion, the bracket, Hamiltonian
/// fields and differentials of the integrals, wedge products of tensors of lower rank, and
/// differentials of forms. Each is proved: `Lift` says how.
/// \throws ModelError, TooMuchMemory, TimeUp
TensorReport find_tensors(const Model& model, TensorType type, int degree,
                          const search::Watch& watch = {});

}  // namespace casimir::structure
