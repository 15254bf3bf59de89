#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "symbolic/search/modular/linear_map.hpp"
#include "symbolic/search/modular/samples.hpp"
#include "symbolic/search/watch.hpp"

namespace casimir::search {

/// The function with coefficients in Q[parameters] and the given monomials that the fields
/// annihilate (up to cofactors): of least degree in the parameters, without common integer factor.
/// \param support  monomials over `fields.places`, among which there is one such function up to a
///     factor, for generic parameters
/// \param parameters  places of those that the coefficients may contain
/// \return  empty where none of a moderate degree and with moderate numbers was found.
std::optional<Polynomial> reconstruct(const System& system, const Fields& fields,
                                      const Monomials& support,
                                      const std::vector<Relation>& relations,
                                      const std::vector<std::size_t>& parameters,
                                      const Watch& watch);

/// The same from values at random points, for fields whose functions obey relations: what the
/// fields annihilate, or what is zero.
std::optional<Polynomial> reconstruct_from_values(const System& system, const Fields& fields,
                                                  Samples::Goal goal, const Monomials& support,
                                                  const std::vector<std::size_t>& parameters,
                                                  const Watch& watch);

}  // namespace casimir::search
