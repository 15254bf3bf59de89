#include <fmt/format.h>

#include "tools/bench/report.hpp"

namespace casimir::tools {

Plot picture_of(const MethodComparison& contest) {
  Plot plot{.title = fmt::format("{}, scene {}", contest.title, contest.scene),
            .x_label = "error at the end, relative to the size of the motion",
            .y_label = "run time",
            .log_x = true,
            .log_y = true,
            .y_unit = "s"};
  for (const ComparedMethod& contender : contest.contenders) {
    Curve curve{contender.label(), {}, Curve::Style::plain};
    if (!contender.own()) curve.style = Curve::Style::outside;
    if (contender.code == "general") curve.style = Curve::Style::variant;
    for (const Row& row : contest.rows) {
      if (row.method == contender.method && row.code == contender.code && row.ok())
        curve.points.emplace_back(row.error, row.seconds);
    }
    if (!curve.points.empty()) plot.curves.push_back(std::move(curve));
  }
  return plot;
}

}  // namespace casimir::tools
