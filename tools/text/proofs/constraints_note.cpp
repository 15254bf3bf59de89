#include "tools/text/proofs/constraints_note.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace casimir::tools {
namespace {

/// Whether two functions vanish at the same points, as one is a multiple of the other by a number.
bool have_one_zero_set(const GiNaC::ex& f, const GiNaC::ex& g) {
  if (f.is_equal(g)) return true;
  if (f.is_zero() || g.is_zero()) return false;
  const GiNaC::ex ratio = (f / g).normal();
  return GiNaC::is_a<GiNaC::numeric>(ratio) && !ratio.is_zero();
}

}  // namespace

std::vector<std::string> constraints_left_out(const Model& model,
                                              const std::vector<GiNaC::ex>& level) {
  std::vector<std::string> left;
  for (const NamedExpression& constraint : model.constraints) {
    if (std::ranges::none_of(
            level, [&](const GiNaC::ex& f) { return have_one_zero_set(f, constraint.value); }))
      left.push_back(constraint.name);
  }
  return left;
}

std::string whole_space_note(const std::vector<std::string>& constraints) {
  if (constraints.empty()) return {};
  return fmt::format(
      "This is about the whole space of the variables, and not about the constraints alone, on "
      "which there may be more: {}\n",
      fmt::join(constraints, ", "));
}

}  // namespace casimir::tools
