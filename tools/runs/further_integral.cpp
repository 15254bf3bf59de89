#include "tools/runs/further_integral.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "symbolic/error.hpp"
#include "tools/cli/stopwatch.hpp"

namespace casimir::tools {

std::optional<obstruction::Obstruction> further_integral(const Model& model,
                                                         const std::string& scene,
                                                         const std::vector<Proof>& proofs,
                                                         double seconds) {
  const bool suffices = std::any_of(proofs.begin(), proofs.end(), [](const Proof& proof) {
    return proof.kind == ClaimKind::liouville && proof.verdict == Verdict::proved && !proof.note;
  });
  if (suffices || model.integrable || !model.hamiltonian || !model.poisson || model.time)
    return std::nullopt;
  const bool known = std::any_of(model.scenes.begin(), model.scenes.end(),
                                 [&](const Scene& s) { return s.name == scene; });
  obstruction::ObstructionRequest request;
  request.scene = known || model.scenes.empty() ? scene : model.scenes.front().name;
  const Stopwatch watch;
  const search::Watch limit{.tick = [&](double) {
    if (watch.seconds() > seconds) throw search::TimeUp();
  }};
  obstruction::Obstruction answer;
  try {
    answer = find_obstruction(model, request, limit);
  } catch (const search::NoAnswer& problem) {
    answer.reason = problem.what();
  } catch (const ModelError& problem) {
    answer.reason = problem.what();
  } catch (const CaseError& problem) {
    answer.reason = problem.what();
  }
  return answer;
}

std::string further_integral_text(const obstruction::Obstruction& answer) {
  std::string at;
  for (const auto& [name, value] : answer.parameters)
    at += fmt::format("{}{} = {}", at.empty() ? " at " : ", ", name, value);
  if (!answer.proved || answer.examined.empty())
    return fmt::format("not known whether there is one{}: {}", at, answer.reason);
  const obstruction::Examined& last = answer.examined.back();
  return fmt::format("excluded{}, along {}, {}: {}. {}.", at, last.along, last.level,
                     answer.excluded, answer.theorem);
}

}  // namespace casimir::tools
