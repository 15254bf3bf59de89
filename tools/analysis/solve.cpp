#include "tools/analysis/solve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tools/analysis/error.hpp"

namespace casimir {

Solution solve(const Model& model, const Scene& scene, const SolveOptions& options) {
  Solution solution;
  solution.scene_ = std::make_unique<const PreparedScene>(prepare(model, scene, options.code));
  AssessmentOptions how{.method = options.method,
                        .run = options.run,
                        .time_limit = options.time_limit,
                        .sample_every = options.sample_every};
  how.around = [&](Settings& settings, const std::function<void()>& run) {
    if (options.give_up)
      settings.give_up = [first = settings.give_up, &options] {
        return options.give_up() || (first && first());
      };
    if (options.progress)
      settings.progress = [&options, duration = std::abs(settings.duration)](double t) {
        options.progress(duration > 0 ? std::abs(t) / duration : 1);
      };
    if (options.dense) {
      // `auto` may begin anew with another method.
      solution.steps_ = {{settings.begin, solution.scene_->initial}};
      settings.watch = [&solution, see = settings.watch](double t, const double* x) {
        if (see) see(t, x);
        solution.steps_.push_back({t, {x, x + solution.scene_->initial.size()}});
      };
    }
    run();
  };
  solution.run_ = integrate_assessed(model, scene, *solution.scene_, how);
  // The end may be before the last step, and within one: see CancelledParts.
  const double end = std::abs(solution.run_.trajectory.time);
  while (solution.steps_.size() > 1 && std::abs(solution.steps_.back().time) > end)
    solution.steps_.pop_back();
  if (!solution.steps_.empty() && solution.steps_.back().time != solution.run_.trajectory.time)
    solution.steps_.push_back({solution.run_.trajectory.time, solution.run_.trajectory.state});
  return solution;
}

std::vector<double> Solution::operator()(double t) const {
  if (steps_.empty()) throw RequestError("the solution was not asked to be dense");
  const double end = run_.trajectory.time;
  if (!(std::min(0., end) <= t && t <= std::max(0., end)))
    throw RequestError(fmt::format("the run goes from 0 to {:g}, and not to {:g}", end, t));
  const auto after = std::ranges::partition_point(
      steps_, [&](const Step& step) { return end >= 0 ? step.time <= t : step.time >= t; });
  const Step& from = *(after == steps_.begin() ? after : after - 1);
  if (from.time == t) return from.state;
  const bool own = run_.method->outside.empty();
  if (!own && scene_->specialisation.uses_time)
    throw RequestError("methods of other libraries begin at the time 0 only");
  Settings settings = run_.settings;
  settings.begin = own ? from.time : 0;
  settings.duration = t - from.time;
  settings.sample_every = 0;
  settings.monitor = false;
  settings.give_up = nullptr;
  settings.max_steps = 0;
  return integrate(run_.compiled->module, *run_.method, settings, from.state, scene_->parameters)
      .state;
}

}  // namespace casimir
