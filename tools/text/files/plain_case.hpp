#pragma once

#include <string>
#include <vector>

#include "symbolic/model.hpp"

namespace casimir::tools {

/// A system as a case file of nothing but equations, integrals and one scene, with the values of
/// the parameters put in.
/// \param moving     parameters that become states at rest instead.
/// \param states     those that are kept, in the order of the model; the others may not occur in
///                   their equations.
/// \param integrals  "H", or names of Casimir functions and integrals.
std::string plain_case(const Model& model, const Scene& scene,
                       const std::vector<std::string>& moving,
                       const std::vector<std::string>& states,
                       const std::vector<std::string>& integrals);

}  // namespace casimir::tools
