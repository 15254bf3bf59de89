#pragma once

#include <string>
#include <vector>

namespace casimir::tools {

/// The LaTeX of `show` as MathML, which browsers typeset themselves. Only what `show` writes is
/// understood: letters, numbers, indices, \frac, \sqrt, \left( \right), \boldsymbol, \dot, Greek
/// letters and the names of functions; anything else is shown as it stands.
///
/// \return  an inline formula as several <math> elements, so that the line may break between the
///          terms of a long sum.
std::string mathml(const std::string& latex);

/// A matrix in round brackets, as one <math> element.
std::string mathml_matrix(const std::vector<std::vector<std::string>>& entries);

}  // namespace casimir::tools
