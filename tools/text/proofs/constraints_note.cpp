#include "tools/text/proofs/constraints_note.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace casimir::tools {

std::string whole_space_note(const std::vector<std::string>& constraints) {
  if (constraints.empty()) return {};
  return fmt::format(
      "This is about the whole space of the variables, and not about the constraints alone, on "
      "which there may be more: {}\n",
      fmt::join(constraints, ", "));
}

}  // namespace casimir::tools
