#include "codegen/optimise.hpp"

#include <optional>
#include <utility>

#include "codegen/factor.hpp"
#include "codegen/terms.hpp"

namespace casimir::codegen {

namespace {

constexpr std::size_t kMostTerms = 3000;  // beyond this an expansion is not worth its time

}  // namespace

Program optimised(const Dag& dag, const std::vector<Scaled>& expressions,
                  const std::vector<std::string>& inputs, const std::vector<std::string>& outputs) {
  const TermSystem structural = system_of(dag, inputs.size(), expressions);
  std::optional<Program> best;
  int least = 0;
  const auto consider = [&](const TermSystem& system) {
    Program candidate = lowered(flattened(system), inputs, outputs);
    const int cost = weight(count_operations(candidate));
    if (best && cost >= least) return;
    best = std::move(candidate);
    least = cost;
  };
  constexpr Preference kPreferences[] = {Preference::best, Preference::sums, Preference::products};
  for (const Preference preference : kPreferences) consider(factored(structural, preference));
  consider(structural);
  if (const auto expansion = expanded(structural, kMostTerms)) {
    for (const Preference preference : kPreferences) consider(factored(*expansion, preference));
  }
  return without_dead_code(*best);
}

}  // namespace casimir::codegen
