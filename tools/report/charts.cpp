// The pictures of a report that are drawn here: the motion over a window that is legible, a panel
// for each group of states, and the section.
#include "tools/report/charts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>

namespace casimir::tools {
namespace {

/// Names that begin with the same letters share a panel: M1, M2, M3.
std::vector<std::vector<std::size_t>> groups_of(const std::vector<std::string>& names) {
  std::vector<std::string> stems;
  std::vector<std::vector<std::size_t>> groups;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string stem = names[i].substr(0, names[i].find_first_of("_0123456789"));
    const auto found = std::ranges::find(stems, stem);
    const auto at = static_cast<std::size_t>(found - stems.begin());
    if (found == stems.end()) {
      stems.push_back(stem);
      groups.emplace_back();
    }
    groups[at].push_back(i);
  }
  return groups;
}

Chart panel(const Motion& motion, const std::vector<std::size_t>& group, std::size_t samples) {
  Chart chart;
  std::vector<std::string> names;
  for (const std::size_t i : group) {
    Chart::Curve curve{motion.names[i], {}};
    for (std::size_t k = 0; k < samples; ++k)
      curve.points.emplace_back(motion.times[k], motion.states[k][i]);
    names.push_back(motion.names[i]);
    chart.curves.push_back(std::move(curve));
  }
  chart.title = fmt::format("{} against time", fmt::join(names, ", "));
  return chart;
}

double unit_of(const PlottedFunction& function) {
  return function.period > 0 ? std::numbers::pi : 1;
}

std::string label_of(const PlottedFunction& function) {
  if (!(function.period > 0)) return function.label;
  const bool plain = std::ranges::all_of(
      function.label, [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; });
  return (plain ? function.label : "(" + function.label + ")") + "/π";
}

}  // namespace

std::size_t legible_samples(const Motion& motion) {
  constexpr int kTurns = 30;
  std::vector<int> turns(motion.names.size(), 0);
  for (std::size_t k = 2; k < motion.times.size(); ++k) {
    for (std::size_t i = 0; i < turns.size(); ++i) {
      const double before = motion.states[k - 1][i] - motion.states[k - 2][i];
      const double after = motion.states[k][i] - motion.states[k - 1][i];
      if (before * after < 0 && ++turns[i] > kTurns) return k;
    }
  }
  return motion.times.size();
}

std::string motion_svg(const Motion& motion) {
  const std::size_t samples = legible_samples(motion);
  const auto groups = groups_of(motion.names);
  std::string text;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    Chart chart = panel(motion, groups[g], samples);
    chart.name = fmt::format("motion-{}", g + 1);
    if (g + 1 == groups.size()) chart.x_label = "time";
    text += chart_svg(chart);
  }
  return text;
}

Chart section_chart(const std::array<PlottedFunction, 2>& plotted,
                    const std::vector<OrbitReport>& orbits) {
  Chart chart{.name = "section", .title = "Poincaré section", .dots = true, .legend = false};
  chart.x_label = label_of(plotted[0]);
  chart.y_label = label_of(plotted[1]);
  chart.height = 330;
  constexpr int kDark[] = {1, 3, 7, 6, 2, 11};
  std::size_t regular = 0;
  for (const OrbitReport& orbit : orbits) {
    const bool grey = orbit.chaotic || !orbit.judged;
    Chart::Curve curve{!orbit.judged   ? "an orbit of which it is not known"
                       : orbit.chaotic ? "a chaotic orbit"
                                       : "a regular orbit",
                       {}};
    curve.colour = grey ? -1 : kDark[regular++ % std::size(kDark)];
    for (const auto& place : orbit.places)
      curve.points.emplace_back(place[0] / unit_of(plotted[0]), place[1] / unit_of(plotted[1]));
    chart.curves.push_back(std::move(curve));
  }
  // What is grey lies below.
  std::ranges::stable_sort(chart.curves, {}, [](const Chart::Curve& c) { return c.colour > 0; });
  const auto whole = [&](std::size_t i) -> std::optional<std::array<double, 2>> {
    if (!(plotted[i].period > 0)) return std::nullopt;
    return std::array{0., plotted[i].period / unit_of(plotted[i])};
  };
  chart.x_range = whole(0);
  chart.y_range = whole(1);
  return chart;
}

Chart thumbnail_of(const Motion& motion) {
  Chart chart{.name = "thumbnail", .title = "motion", .legend = false};
  const std::size_t samples = legible_samples(motion);
  const std::size_t n = motion.names.size();
  Chart::Curve curve{"", {}};
  for (std::size_t k = 0; k < samples; ++k) {
    const std::vector<double>& x = motion.states[k];
    curve.points.emplace_back(n > 1 ? x[0] : motion.times[k], n > 1 ? x[1] : x[0]);
  }
  chart.curves.push_back(std::move(curve));
  return chart;
}

}  // namespace casimir::tools
