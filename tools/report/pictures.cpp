#include "tools/report/pictures.hpp"

#include <algorithm>
#include <cmath>

#include "tools/bench/report.hpp"
#include "tools/cli/errors.hpp"
#include "tools/report/charts.hpp"

namespace casimir::tools {
namespace {

/// Without a title, which the page has.
std::string drawn(Plot plot, const std::string& name, const std::string& beside) {
  plot.title.clear();
  return page_svg(plot, name, beside);
}

/// Its label is short enough for the height that it has in a page.
Plot drift_of(const Findings& findings) {
  Plot plot = drift_picture("", findings.drifts);
  plot.y_label = findings.drifts.size() == 1 ? "relative drift" : "largest relative drift";
  return plot;
}

/// General code has a table of its own, and would lie on top of the specialised.
Plot method_comparison_of(const Findings& findings) {
  Plot plot = tools::picture_of(*findings.contest);
  std::erase_if(plot.curves,
                [](const Curve& curve) { return curve.style == Curve::Style::variant; });
  return plot;
}

}  // namespace

Pictures draw_pictures(const CaseFile& file, const Model& model, const Findings& findings,
                       const std::string& beside) {
  Pictures pictures;
  const bool moves = findings.motion && findings.motion->times.size() > 1;
  if (moves) {
    pictures.motion = motion_svg(*findings.motion);
    pictures.thumbnail = thumbnail_svg(thumbnail_of(*findings.motion));
  }
  if (findings.scene && model.section) {
    try {
      cut_section(file, model, *findings.scene, pictures);
    } catch (const SystemError& problem) {
      pictures.problem = problem.what();
    } catch (const std::runtime_error& problem) {
      pictures.section_note = std::string("section: ") + problem.what();
    }
  }
  try {
    if (moves) {
      const Motion& motion = *findings.motion;
      const Scene& scene = *findings.scene;
      if (has_sphere(motion))
        pictures.sphere = drawn(sphere_picture(model, scene, motion, ""), "sphere", beside);
      if (has_apex(model, motion))
        pictures.apex = drawn(apex_picture(model, scene, motion, ""), "apex", beside);
    }
    // Where there is no invariant, the axes would be all.
    const bool drifts =
        std::ranges::any_of(findings.runs, [](const Row& row) { return std::isfinite(row.drift); });
    if (drifts && !findings.drifts.empty())
      pictures.drift = drawn(drift_of(findings), "drift", beside);
    if (findings.contest)
      pictures.work_precision = drawn(method_comparison_of(findings), "work-precision", beside);
  } catch (const SystemError& problem) {
    pictures.problem = problem.what();
  }
  return pictures;
}

}  // namespace casimir::tools
