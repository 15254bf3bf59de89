#pragma once

#include "symbolic/model.hpp"

namespace casimir::search {

/// What is said of generic values of the parameters is said of no values that obey an equation.
/// \throws ModelError  where an assumption is an equation between parameters
void check_parameters_are_free(const Model& model);

}  // namespace casimir::search
