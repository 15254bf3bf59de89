#pragma once

#include <ginac/ginac.h>

#include <string>
#include <vector>

#include "symbolic/model.hpp"

namespace casimir {

/// A Hamiltonian system in canonical coordinates, from expressions rather than from a case file:
/// {q_i, p_i} = 1, and what is no coordinate is a parameter. Claims may be added to the model, as
/// `model.integrals.push_back({"L", x*py - y*px, {}})`, before it is verified.
/// \param q  the coordinates.
/// \param p  the momenta, one for each.
/// \param parameters  the other symbols of the Hamiltonian.
/// \throws ModelError  for expressions that exact algebra has no meaning for (`0.5` instead of
///                     `GiNaC::numeric(1, 2)`, I, functions that case files do not have), a symbol
///                     that is none of these, and momenta that are not as many as coordinates.
/// \throws CaseError   for a symbol whose name cannot stand in generated code.
Model hamiltonian_system(const std::string& name, const std::vector<GiNaC::symbol>& q,
                         const std::vector<GiNaC::symbol>& p, const GiNaC::ex& hamiltonian,
                         const std::vector<GiNaC::symbol>& parameters = {});

/// Initial data for a model: a scene, which is not added to it.
/// \param initial  an exact constant for each of its variables, in their order.
/// \param parameters  the same for its parameters.
/// \throws ModelError  for values that are not as many, not exact, not real or not constant.
Scene scene_from(const Model& model, const std::vector<GiNaC::ex>& initial,
                 const GiNaC::ex& duration, const std::vector<GiNaC::ex>& parameters = {});

}  // namespace casimir
