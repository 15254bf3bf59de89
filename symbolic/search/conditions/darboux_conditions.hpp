#pragma once

#include <string>
#include <utility>
#include <vector>

#include "symbolic/search/darboux.hpp"

namespace casimir::search {

/// Values of parameters for which there is an additional Darboux polynomial.
struct DarbouxCondition {
  std::vector<std::pair<std::string, std::string>> parameters;  ///< name and value, over the others
  std::vector<GiNaC::ex> values;                                ///< the same values, in this order
  std::vector<std::string> relations;    ///< polynomials that vanish, where no values were found
  std::vector<DarbouxPolynomial> found;  ///< the additional ones; empty where not confirmed
  /// Whether those found are proved, and proved to be additional.
  Verdict verdict = Verdict::undecided;
};

/// What a search for values of parameters found, and whether that is all.
struct DarbouxConditionReport {
  DarbouxReport generic;  ///< for generic values of all parameters, without combinations
  std::vector<DarbouxCondition> conditions;
  bool complete = false;  ///< proved: on no other value, curve or set is there an additional one
  std::string reason;     ///< where it is not complete
  /// There, or at one of the values that were looked at, is what `has_conjugates` of a report says.
  bool has_conjugates = false;
};

/// The real values of some parameters at which there are Darboux polynomials up to a degree that
/// are no products of limits of those for generic values (and of integrals), with a cofactor that
/// is not zero: the equations for the coefficients of F and K with the parameters as further
/// unknowns, solved by cases, and each case confirmed by a search there.
/// \param free  names of parameters
/// \throws CaseError   for names that are no parameters
/// \throws ModelError  as `find_darboux`
DarbouxConditionReport find_darboux_conditions(const Model& model, int degree,
                                               const std::vector<Text>& free,
                                               const Watch& watch = {});

}  // namespace casimir::search
