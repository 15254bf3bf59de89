#include "codegen/optimise.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "codegen/factor.hpp"
#include "codegen/terms.hpp"

namespace casimir::codegen {

namespace {

// An expansion that is much longer than what it expands loses, and takes long to lose.
constexpr std::size_t kAlwaysTried = 150;
constexpr std::size_t kMostTerms = 1500;
constexpr std::size_t kMostGrowth = 4;
// Of long systems only the best bet is factored.
constexpr std::size_t kLong = 400;

std::size_t term_count(const TermSystem& system) {
  std::size_t result = 0;
  for (const Variable& v : system.variables) result += v.value.size();
  return result;
}

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
  const auto consider_factored = [&](const TermSystem& system) {
    consider(factored(system, Preference::best));
    if (term_count(system) > kLong) return;
    consider(factored(system, Preference::sums));
    consider(factored(system, Preference::products));
  };
  consider_factored(structural);
  consider(structural);
  const std::size_t limit =
      std::min(kMostTerms, std::max(kAlwaysTried, kMostGrowth * term_count(structural)));
  if (const auto expansion = expanded(structural, limit)) consider_factored(*expansion);
  return without_dead_code(*best);
}

}  // namespace casimir::codegen
