#pragma once

#include <ginac/ginac.h>

#include <optional>
#include <vector>

#include "symbolic/search/search.hpp"

namespace casimir::search {

/// The model where a parameter has a value, which may contain the others. Only what a search needs:
/// definitions, Casimir functions and integrals that have no value then are left out. Empty where
/// an assumption excludes the value, and where the equations of motion have no real value.
/// \throws ModelError  where a constraint of the phase space has no value
std::optional<Model> with_value(const Model& model, const GiNaC::symbol& parameter,
                                const GiNaC::ex& value);

/// Where the named parameters stand in the ring of a search.
/// \throws CaseError  for what is no parameter, and for one that is named twice
std::vector<std::size_t> free_places(const Model& model, const std::vector<Text>& free);

/// Whether the equations of motion have a value nowhere, as a denominator vanishes identically.
/// \throws ModelError  for what exact algebra cannot treat, which says nothing of values
bool is_meaningless(const Model& special);

/// Whether some assumption cannot hold where all others do, by the signs that these give: for no
/// c > 0 is d = c where c - d vanishes nowhere, so that d > 0 holds nowhere. False says nothing.
bool contradict(const Model& model);

/// Those that are no linear combinations of the known ones, 1 and those before them, with numbers.
/// The search compares them as polynomials in what it was given, where exp(7*x) is not exp(x/2)^14.
/// \throws ModelError  for functions that cannot be converted, as the prover does
std::vector<Found> additional(const Model& model, const std::vector<Found>& found,
                              const std::vector<NamedExpression>& known);

}  // namespace casimir::search
