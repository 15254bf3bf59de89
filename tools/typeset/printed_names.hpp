#pragma once

#include <string>

namespace casimir::tools {

/// An expression of a case file as a figure has it, in UTF-8: M1 as M₁, gamma1 as γ₁, products with
/// a dot. Functions keep their names.
std::string printed_names(const std::string& expression);

/// Text of a figure for LaTeX: what means something there does not, and letters with lowered digits
/// and Greek ones stand in mathematics. The result holds nothing but text: of a backslash, a brace
/// or a dollar sign no more is left than that it is printed.
std::string latex_text(const std::string& text);

}  // namespace casimir::tools
