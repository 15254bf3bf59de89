#pragma once

#include "symbolic/obstruction/family/riemann_family.hpp"
#include "symbolic/obstruction/obstruct.hpp"

namespace casimir::obstruction {

/// A normal variational equation for every value of the free parameter, with what is shown of it.
struct FamilyEquation {
  Examined shown;
  RiemannFamily family;
};

/// The same for all values of several parameters.
struct GeneralEquation {
  Examined shown;
  GeneralFamily family;
};

}  // namespace casimir::obstruction
