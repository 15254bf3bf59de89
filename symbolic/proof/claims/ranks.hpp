#pragma once

#include <optional>
#include <string>
#include <vector>

#include "symbolic/proof/claims/claim.hpp"
#include "symbolic/proof/generic_rank.hpp"

namespace casimir {

/// The functions with the Hamiltonian, where it is an integral, and the integrals behind them.
std::vector<NamedExpression> with_hamiltonian(const Model& model,
                                              std::vector<NamedExpression> functions);

/// "H, F1, F2".
std::string listed(const std::vector<NamedExpression>& functions);

PolynomialRows gradients(Prover& prover, const std::vector<NamedExpression>& functions);

/// Adds conditions of a fact about some pieces of the domain, or some values of parameters, only.
void say_where(Proof& proof, const std::string& where,
               const std::vector<std::string>& nonzero = {});

/// Those of the functions whose rows add nothing to the ones before them, at all of these points;
/// nothing where a row adds something at some of them only, as that of |p| - p does for p < 0.
std::optional<std::vector<NamedExpression>> dependent(const std::vector<NamedExpression>& functions,
                                                      const PolynomialRows& rows,
                                                      std::vector<RealPoint>& points);

/// Whether rows that contain arbitrary functions are independent for every choice of these, and all
/// values of the parameters.
bool are_always_independent(const Prover& prover, const PolynomialRows& rows);

/// The rank of the bracket, which is the dimension of the generic symplectic leaf.
std::optional<GenericRank> bracket_rank(Prover& prover);

}  // namespace casimir
