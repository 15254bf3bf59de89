#pragma once

#include "symbolic/model.hpp"

namespace casimir {

/// The equations of motion of a model alone, with what is assumed of variables and parameters: no
/// bracket, no Hamiltonian, no claims, no scenes.
Model bare_motion(const Model& model);

}  // namespace casimir
