#pragma once

#include <string>

namespace casimir::tools {

/// The reference of case files as a manual page of section 5, in the man macros of roff.
/// \param markdown  cases/FORMAT.md: headings, paragraphs, blocks of code, and tables of two columns
/// \param date      of the release, as pages show it
std::string case_page(const std::string& markdown, const std::string& version,
                      const std::string& date);

}  // namespace casimir::tools
