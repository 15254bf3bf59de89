#pragma once

#include <optional>

#include "symbolic/search/watch.hpp"
#include "symbolic/structure/separate/leaves.hpp"

namespace casimir::structure {

/// The Hamiltonian, the integrals and those on the level that the case claims and, where the degree
/// is not 0, those that a search up to it finds: none of them is proved here.
std::vector<GiNaC::ex> possible_integrals(const Model& model, const std::vector<Text>& on,
                                          int degree, const search::Watch& watch);

/// Casimir functions: those that the case claims and all polynomials of a low degree. None of them
/// is proved here.
std::vector<GiNaC::ex> possible_casimirs(const Model& model, const search::Watch& watch);

/// Exact points of the level, inside all assumptions.
std::vector<RealPoint> points_of(Leaves& leaves, std::size_t count);

/// Choices of n functions, the first (the Hamiltonian) always among them, that are in involution on
/// the level and whose flows are independent at one of the points.
/// \param most  of the choices
std::vector<std::vector<Polynomial>> commuting_choices(const Leaves& leaves,
                                                       const std::vector<Polynomial>& functions,
                                                       std::vector<RealPoint>& points,
                                                       std::size_t most);

}  // namespace casimir::structure
