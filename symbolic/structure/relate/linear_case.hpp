#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "symbolic/algebra/rational_matrix.hpp"
#include "symbolic/model.hpp"

namespace casimir::structure {

/// A polynomial with rational coefficients: a number and one exponent for each variable.
using Terms = std::vector<std::pair<cln::cl_RA, std::vector<unsigned long>>>;

/// What of a case a linear map is compared with: its bracket and its Hamiltonian as polynomials
/// with numbers for coefficients.
struct LinearCase {
  std::size_t dimension = 0;
  std::vector<Terms> upper;          ///< {x_i, x_j}, i < j, row by row
  std::optional<Terms> hamiltonian;  ///< where the case has one

  /// {x_i, x_j}.
  Terms bracket(std::size_t i, std::size_t j) const;
};

/// The degree; 0 for zero.
unsigned long degree_of(const Terms& terms);

/// The terms of one degree.
Terms of_degree(const Terms& terms, unsigned long degree);

/// Functions of a case as polynomials in its variables.
/// \throws ModelError  where one is none, or has a parameter: then numbers have to be given
std::vector<Terms> terms_of(const Model& model, const std::vector<GiNaC::ex>& functions);

/// \param with_hamiltonian  whether that is asked for
/// \throws ModelError  as `terms_of`; for a case without a bracket; for one that depends on time
LinearCase linear_case(const Model& model, bool with_hamiltonian);

/// The skew product [x_i, x_j] = sum_k c[i][j][k] x_k that the terms of degree 1 of a bracket are.
/// Where the bracket is linear this is a Lie algebra, and the variables are its elements.
using StructureConstants = std::vector<RationalMatrix>;
StructureConstants structure_constants(const LinearCase& c);

/// The matrix of u -> [v, u] on columns.
RationalMatrix adjoint(const StructureConstants& c, const std::vector<cln::cl_RA>& v);

/// [u, v].
std::vector<cln::cl_RA> commutator(const StructureConstants& c, const std::vector<cln::cl_RA>& u,
                                   const std::vector<cln::cl_RA>& v);

/// tr(ad x_i ad x_j).
RationalMatrix killing_form(const StructureConstants& c);

}  // namespace casimir::structure
