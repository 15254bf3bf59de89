#pragma once

#include <ginac/ginac.h>

#include <string>
#include <vector>

#include "symbolic/algebra/ideal.hpp"
#include "symbolic/algebra/polynomial.hpp"

namespace casimir {

/// Vectors among the coordinates that the level makes orthogonal to each other and gives lengths:
/// each is a list of coordinates, all lists of one size.
struct OrthogonalVectors {
  std::vector<std::vector<std::size_t>> vectors;
  std::vector<Polynomial> squared_lengths;  ///< one for each vector; free of the coordinates
};

/// The common zero level of some functions.
struct Level {
  std::vector<std::string> texts;
  std::vector<GiNaC::ex> functions;
  std::vector<Polynomial> numerators;  ///< of the functions
  std::vector<SolvedRelation> solved;  ///< the same relations as a triangular set, if they are one
  std::vector<OrthogonalVectors> orthogonal;
  bool empty() const { return functions.empty(); }
};

/// The spheres, and frames such as the columns of a rotation, among the relations of a level: those
/// have rational points that no equation solver finds by chance.
/// \param coordinates  the first variables of the ring
std::vector<OrthogonalVectors> orthogonal_vectors(const std::vector<Polynomial>& relations,
                                                  std::size_t coordinates);

}  // namespace casimir
