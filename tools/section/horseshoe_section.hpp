#pragma once

#include "tools/analysis/section/problem.hpp"
#include "tools/cli/cli.hpp"

namespace casimir::tools {

/// `section --horseshoe`: a theorem on chaos, or that none was found.
/// \param longest  the length of cycles that are looked for; 0: as the search has it.
/// \param certificate  the file for what others can verify it by; empty: none.
/// \return exit status: 0 or 3; 5 where there is a theorem and its certificate does not hold.
int prove_horseshoe(const Common& common, const Model& model, const SectionRequest& request,
                    std::size_t longest, const std::string& certificate);

}  // namespace casimir::tools
