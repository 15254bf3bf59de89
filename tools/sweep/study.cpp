#include "tools/sweep/study.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>

#include "tools/analysis/error.hpp"
#include "tools/analysis/estimate/cancelled_parts.hpp"
#include "tools/analysis/run/doubted_invariants.hpp"
#include "tools/analysis/sweep/indicators.hpp"
#include "tools/analysis/sweep/lyapunov.hpp"
#include "tools/analysis/sweep/rotations.hpp"
#include "tools/analysis/sweep/sections.hpp"
#include "tools/sweep/grid_options.hpp"
#include "tools/text/runs/checked_members.hpp"
#include "tools/text/runs/trust_report.hpp"

namespace casimir::tools {
namespace {

/// Of a step in a section: every crossing keeps the level to 1e-10.
constexpr double kSectionTolerance = 1e-14;

SceneOptions how_to_prepare(const Model& model, const Grid& grid, const StudyRequest& asked) {
  SceneOptions how;
  const std::vector<std::string> set = names_set(grid, asked.lets);
  for (const GiNaC::symbol& p : model.parameters)
    if (std::ranges::find(set, p.get_name()) != set.end())
      how.keep_parameters.push_back(p.get_name());
  if (asked.observe) how.observe = *asked.observe;
  return how;
}

std::vector<std::string> warnings_on(const Integrations& task,
                                     const std::vector<CheckedMember>& checked) {
  std::vector<std::string> warnings;
  if (!task.warning().empty()) warnings.push_back(task.warning());
  if (task.passes_over()) warnings.emplace_back(kUnseenBetweenSteps);
  for (std::string& warning : warnings_of(checked, "point", task.constant_step()))
    warnings.push_back(std::move(warning));
  return warnings;
}

/// On what the deviations keep to.
std::vector<std::string> warnings_on(const Indicators& task) {
  if (task.left_out().empty()) return {};
  return {fmt::format("deviations keep to the level of what is proved alone, which {} {} not",
                      fmt::join(task.left_out(), ", "),
                      task.left_out().size() == 1 ? "is" : "are")};
}

}  // namespace

bool follows_crossings(const std::string& task) { return task == kSection || task == kRotation; }

SweepStudy::SweepStudy(const Model& model, const Scene& scene, const StudyRequest& asked)
    : model_(model),
      scene_(scene),
      grid_(read_grid(asked.over, asked.lets, model)),
      method_(&method_named(asked.method)) {
  if (grid_.axes.empty()) throw RequestError("a sweep goes over at least one name");
  run_ = prepare(model, scene, how_to_prepare(model, grid_, asked));
  RunRequest how_far = asked.run;
  const bool crossings = follows_crossings(asked.task);
  // A section goes on until it has its points.
  if (crossings && !scene.duration) how_far.duration = 0;
  settings_ = settings_for(how_far, run_);
  settings_.invariant_terms = nullptr;
  if (crossings && method_->name != "taylor")
    throw RequestError(fmt::format(
        "'{}' follows orbits by Taylor series: no other method goes with it", asked.task));
  if (crossings) settings_.rtol = kSectionTolerance;
  places_ =
      std::make_unique<GridPoints>(model, scene, run_, grid_, read_lets(asked.lets, grid_, model));
  task_ = task_of(asked);
}

/// A new task is a file in `analysis/sweep/` and a line here.
std::unique_ptr<SweepTask> SweepStudy::task_of(const StudyRequest& asked) const {
  if (asked.task == kIntegrate)
    return std::make_unique<Integrations>(run_, *places_, *method_, settings_, grid_.points(),
                                          asked.run);
  if (asked.task == kSection)
    return std::make_unique<Sections>(model_, scene_, *places_, asked.section, asked.orbits,
                                      asked.points, kSectionTolerance);
  if (asked.task == kRotation)
    return std::make_unique<Rotations>(model_, scene_, *places_, asked.section, asked.points,
                                       kSectionTolerance);
  if (asked.task != kExponents && asked.task != kIndicators)
    throw RequestError(
        "'" + printable(asked.task) + "' is nothing that a sweep does: " +
        suggest_or_list(asked.task, {kIntegrate, kSection, kExponents, kIndicators, kRotation}));
  if (run_.specialisation.uses_time)
    throw RequestError(fmt::format(
        "'{}' is for equations that do not depend on the time, and these do", asked.task));
  if (asked.task == kIndicators)
    return std::make_unique<Indicators>(model_, scene_, run_, *places_, *method_, settings_);
  return std::make_unique<LyapunovExponents>(model_, scene_, run_, *places_, *method_, settings_);
}

int SweepStudy::lanes() const {
  const auto* integrations = dynamic_cast<const Integrations*>(task_.get());
  return integrations ? integrations->lanes() : 1;
}

std::vector<CheckedMember> SweepStudy::check(const std::vector<PointResult>& rows) const {
  const auto* integrations = dynamic_cast<const Integrations*>(task_.get());
  return integrations ? integrations->check(rows) : std::vector<CheckedMember>{};
}

std::vector<std::string> SweepStudy::warnings(const std::vector<PointResult>& rows,
                                              const std::vector<CheckedMember>& checked) const {
  std::vector<std::string> result;
  if (const auto* integrations = dynamic_cast<const Integrations*>(task_.get())) {
    result = warnings_on(*integrations, checked);
    std::ranges::move(doubts_of_drifts(model_, scene_, run_.specialisation.invariant_names,
                                       integrations->largest_drifts(rows), settings_.rtol),
                      std::back_inserter(result));
  }
  if (const auto* indicators = dynamic_cast<const Indicators*>(task_.get()))
    result = warnings_on(*indicators);
  if (std::string unwatched = unwatched_parts(model_, scene_); !unwatched.empty())
    result.push_back(std::move(unwatched));
  return result;
}

}  // namespace casimir::tools
