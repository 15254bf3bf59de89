#include "tools/bench/comparison.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace casimir::tools {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

struct ErrorCurve {
  ComparedMethod contender;
  WorkPrecision runs;
};

std::vector<ErrorCurve> curves_of(const MethodComparison& contest) {
  std::vector<ErrorCurve> curves;
  for (const ComparedMethod& contender : contest.contenders)
    curves.push_back({contender, contest.curve(contender)});
  return curves;
}

Cell cell_at(const std::vector<ErrorCurve>& curves, const ErrorCurve& curve, double error) {
  Cell cell{error, curve.runs.seconds_at(error), kNaN, "", kNaN};
  for (const ErrorCurve& ours : curves) {
    if (!ours.contender.own() || ours.contender.code == "general") continue;
    const double seconds = ours.runs.seconds_at(error);
    if (std::isnan(seconds) || seconds >= cell.fastest_seconds) continue;
    cell.fastest_seconds = seconds;
    cell.fastest = ours.contender.method;
  }
  cell.ratio = cell.seconds / cell.fastest_seconds;
  return cell;
}

/// All ratios of a peer at one level, with the names of the cases.
Mean mean_of(const std::vector<MethodComparison>& contests, const std::string& peer, int level) {
  Mean mean{.peer = peer, .at_best = level < 0, .least = kNaN};
  if (level >= 0) mean.error = kErrorLevels[static_cast<std::size_t>(level)];
  std::vector<double> ratios;
  for (const MethodComparison& contest : contests) {
    for (const Line& line : equal_error_lines(contest)) {
      if (line.contender.label() != peer) continue;
      const Cell& cell = level < 0 ? line.best : line.levels[static_cast<std::size_t>(level)];
      if (std::isnan(cell.ratio)) continue;
      ratios.push_back(cell.ratio);
      if (cell.ratio >= mean.least) continue;
      mean.least = cell.ratio;
      mean.least_case = contest.case_name;
    }
  }
  mean.ratio = geometric_mean(ratios);
  mean.cases = static_cast<int>(ratios.size());
  return mean;
}

}  // namespace

std::vector<Line> equal_error_lines(const MethodComparison& contest) {
  const std::vector<ErrorCurve> curves = curves_of(contest);
  std::vector<Line> lines;
  for (const ErrorCurve& curve : curves) {
    if (curve.runs.envelope().empty()) continue;
    Line line{curve.contender, {}, cell_at(curves, curve, curve.runs.best_error())};
    for (const double error : kErrorLevels) line.levels.push_back(cell_at(curves, curve, error));
    lines.push_back(std::move(line));
  }
  return lines;
}

std::vector<CodeLine> code_lines(const MethodComparison& contest) {
  const std::vector<ErrorCurve> curves = curves_of(contest);
  std::vector<CodeLine> lines;
  for (const ErrorCurve& general : curves) {
    if (general.contender.code != "general") continue;
    const auto specialised =
        std::find_if(curves.begin(), curves.end(), [&](const ErrorCurve& curve) {
          return curve.contender.method == general.contender.method &&
                 curve.contender.code == "specialised";
        });
    if (specialised == curves.end()) continue;
    CodeLine line{general.contender.method, {}};
    for (const double error : kErrorLevels)
      line.ratios.push_back(general.runs.seconds_at(error) / specialised->runs.seconds_at(error));
    lines.push_back(std::move(line));
  }
  return lines;
}

std::vector<Mean> means(const std::vector<MethodComparison>& contests) {
  std::vector<std::string> peers;
  for (const MethodComparison& contest : contests) {
    for (const ComparedMethod& contender : contest.contenders) {
      if (!contender.own() &&
          std::find(peers.begin(), peers.end(), contender.label()) == peers.end())
        peers.push_back(contender.label());
    }
  }
  std::vector<Mean> result;
  for (const std::string& peer : peers) {
    for (int level = 0; level < static_cast<int>(kErrorLevels.size()); ++level)
      result.push_back(mean_of(contests, peer, level));
    result.push_back(mean_of(contests, peer, -1));
  }
  return result;
}

std::string growth_sentence(const MethodComparison& contest) {
  if (!std::isfinite(contest.conditioning))
    return "small changes of the state grow beyond what runs in double precision can tell";
  return fmt::format("small changes of the state grow {:.2g} times along the run at most",
                     contest.conditioning);
}

std::vector<std::string> sentences(const MethodComparison& contest) {
  std::vector<std::string> result;
  for (const Line& line : equal_error_lines(contest)) {
    if (line.contender.own()) continue;
    std::vector<std::string> parts;
    std::string subject;
    const auto add = [&](const Cell& cell, const std::string& where) {
      if (std::isnan(cell.ratio)) return;
      // A new subject only where another of our methods is the fastest.
      parts.push_back(cell.fastest == subject ? fmt::format("{:.1f} {}", cell.ratio, where)
                                              : fmt::format("{} is {:.1f} times as fast {}",
                                                            cell.fastest, cell.ratio, where));
      subject = cell.fastest;
    };
    for (const Cell& cell : line.levels) add(cell, fmt::format("at {:.0e}", cell.error));
    add(line.best, fmt::format("at its best, {:.1e}", line.best.error));
    if (!parts.empty())
      result.push_back(fmt::format("{}: {}", line.contender.label(), fmt::join(parts, ", ")));
  }
  return result;
}

}  // namespace casimir::tools
