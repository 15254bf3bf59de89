#pragma once

#include <string>

#include "tools/typeset/math.hpp"

namespace casimir::tools::typeset {

/// A formula as MathML, which browsers typeset themselves.
///
/// \return  an inline formula as several <math> elements, so that the line may break between the
///          terms of a long sum.
std::string mathml(const Math& formula);

/// A matrix in round brackets, as one <math> element.
std::string mathml(const MathMatrix& entries);

}  // namespace casimir::tools::typeset
