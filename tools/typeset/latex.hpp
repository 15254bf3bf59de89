#pragma once

#include <string>

#include "tools/typeset/math.hpp"

namespace casimir::tools::typeset {

/// A formula in LaTeX's mathematical mode; amsmath is all that it needs.
std::string latex(const Math& formula);

}  // namespace casimir::tools::typeset
