#pragma once

#include <string>
#include <vector>

namespace casimir::tools {

/// The sentence that an answer is about the whole space of the variables, where a case has these
/// constraints; ends its line. Empty where there are none.
std::string whole_space_note(const std::vector<std::string>& constraints);

}  // namespace casimir::tools
