#include "tools/plot/motion_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tools/analysis/quantities.hpp"
#include "tools/typeset/printed_names.hpp"

namespace casimir::tools {
namespace {

/// A step of a Taylor series may be a third of a period: so many samples make a smooth curve of it.
constexpr double kSamplesPerStep = 24;
constexpr double kFewestSamples = 2000, kMostSamplesOfPicture = 40000;

/// What a user wants drawn: `t`, a state of the run, or an expression.
std::vector<std::vector<double>> columns(const Model& model, const Scene& scene,
                                         const Motion& motion, const std::string& option,
                                         const std::vector<std::string>& what) {
  std::vector<GiNaC::ex> functions;
  std::vector<std::size_t> plain;  // the state, the time (n), or a function (n + 1)
  const std::size_t n = motion.names.size();
  for (const std::string& text : what) {
    const auto found = std::find(motion.names.begin(), motion.names.end(), text);
    if (found != motion.names.end()) {
      plain.push_back(static_cast<std::size_t>(found - motion.names.begin()));
    } else if (text == "t" || (model.time && text == model.time->get_name())) {
      plain.push_back(n);
    } else {
      plain.push_back(n + 1);
      functions.push_back(model.parse({text, {option, 1, 1}, text}));
    }
  }
  const Quantities quantities(model, scene, functions, motion.names);
  std::vector<std::vector<double>> result(what.size());
  for (std::size_t k = 0; k < motion.times.size(); ++k) {
    const std::vector<double> values =
        functions.empty() ? std::vector<double>{} : quantities(motion.times[k], motion.states[k]);
    std::size_t next = 0;
    for (std::size_t i = 0; i < what.size(); ++i)
      result[i].push_back(plain[i] < n    ? motion.states[k][plain[i]]
                          : plain[i] == n ? motion.times[k]
                                          : values[next++]);
  }
  return result;
}

}  // namespace

std::string picture_title(const Model& model, const Scene& scene) {
  return fmt::format("{}, scene {}", model.title.empty() ? model.name : model.title, scene.name);
}

Motion motion_of(const PreparedScene& run, const AssessedRun& judged, double every) {
  Motion motion{.names = run.specialisation.states, .times = {0.0}, .states = {run.initial}};
  Settings settings = judged.settings;
  settings.duration = judged.trajectory.time;
  if (settings.duration == 0) return motion;
  const double samples = std::clamp(kSamplesPerStep * static_cast<double>(judged.trajectory.steps),
                                    kFewestSamples, kMostSamplesOfPicture);
  settings.sample_every = every > 0 ? every : std::abs(settings.duration) / samples;
  settings.monitor = false;
  settings.give_up = nullptr;
  Trajectory trajectory =
      integrate(judged.compiled->module, *judged.method, settings, run.initial, run.parameters);
  motion.times = std::move(trajectory.sample_times);
  motion.states = std::move(trajectory.samples);
  return motion;
}

Plot time_picture(const Model& model, const Scene& scene, const Motion& motion,
                  const std::vector<std::string>& what) {
  const std::vector<std::string>& names = what.empty() ? motion.names : what;
  const auto values = columns(model, scene, motion, "--plot-y", names);
  Plot plot{.title = picture_title(model, scene), .x_label = "time", .y_label = "state"};
  if (names.size() == 1) plot.y_label = printed_names(names.front());
  for (std::size_t i = 0; i < names.size(); ++i) {
    Curve curve{names.size() == 1 ? "" : printed_names(names[i]), {}, Curve::Style::line};
    for (std::size_t k = 0; k < motion.times.size(); ++k)
      curve.points.emplace_back(motion.times[k], values[i][k]);
    plot.curves.push_back(std::move(curve));
  }
  return plot;
}

Plot phase_picture(const Model& model, const Scene& scene, const Motion& motion,
                   const std::string& x, const std::string& y) {
  const auto values = columns(model, scene, motion, "--plot-xy", {x, y});
  Plot plot{.title = picture_title(model, scene),
            .x_label = printed_names(x),
            .y_label = printed_names(y)};
  Curve curve{"", {}, Curve::Style::path};
  for (std::size_t k = 0; k < motion.times.size(); ++k)
    curve.points.emplace_back(values[0][k], values[1][k]);
  plot.curves.push_back(std::move(curve));
  return plot;
}

}  // namespace casimir::tools
