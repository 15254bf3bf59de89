#pragma once

#include <ginac/ginac.h>

#include <string>
#include <vector>

#include "symbolic/model.hpp"

namespace casimir::tools {

/// The constraints of a case that the answer of a search is not about: it is about the whole space
/// of the variables, or about the zero level of some functions, and on the constraints too there
/// may be more.
std::vector<std::string> constraints_left_out(const Model& model,
                                              const std::vector<GiNaC::ex>& level);

/// The sentence that an answer is about the whole space of the variables, where a case has these
/// constraints; ends its line. Empty where there are none.
std::string whole_space_note(const std::vector<std::string>& constraints);

}  // namespace casimir::tools
