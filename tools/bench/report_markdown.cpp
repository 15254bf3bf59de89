#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "tools/bench/comparison.hpp"
#include "tools/bench/report.hpp"

namespace casimir::tools {
namespace {

/// Text of a case file in a table: nothing in it is markup there.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (std::string("\\`*_{}[]<>()#+-.!|~&").find(c) != std::string::npos) result += '\\';
    result += c < ' ' && c >= 0 ? ' ' : c;
  }
  return result;
}

std::string cell_markdown(const Cell& cell) {
  if (std::isnan(cell.seconds)) return "-";
  const std::string ratio =
      std::isnan(cell.ratio) ? "" : fmt::format(" ({:.{}f})", cell.ratio, cell.ratio < 100 ? 1 : 0);
  return duration_text(cell.seconds) + ratio;
}

std::string head() {
  std::string text = "| method |";
  std::string rule = "| --- |";
  for (const double error : kErrorLevels) {
    text += fmt::format(" {:.0e} |", error);
    rule += " ---: |";
  }
  return text + " best error (time) |\n" + rule + " ---: |\n";
}

std::string table(const MethodComparison& contest) {
  std::string text = head();
  for (const Line& line : equal_error_lines(contest)) {
    if (line.contender.code == "general") continue;
    text += fmt::format("| {} |", line.contender.label());
    for (const Cell& cell : line.levels) text += fmt::format(" {} |", cell_markdown(cell));
    text += fmt::format(" {:.1e}: {} |\n", line.best.error, cell_markdown(line.best));
  }
  return text;
}

std::string summary_table(const BenchReport& report) {
  std::string text = head();
  std::string last;
  for (const Mean& mean : means(report.contests)) {
    if (mean.peer != last) text += fmt::format("{}| {} |", last.empty() ? "" : "\n", mean.peer);
    last = mean.peer;
    text += mean.cases == 0 ? " - |"
                            : fmt::format(" {:.{}f} ({} cases, least {:.1f}) |", mean.ratio,
                                          mean.ratio < 100 ? 1 : 0, mean.cases, mean.least);
  }
  return text + '\n';
}

/// Half the distance of the quartiles, relative to the time: in the middle of all rows, and at
/// most.
std::string spread_text(const BenchReport& report) {
  std::vector<double> spreads;
  for (const Row& row : report.rows())
    if (row.ok() && row.seconds > 0) spreads.push_back(100 * row.spread / row.seconds);
  if (spreads.empty()) return "";
  std::sort(spreads.begin(), spreads.end());
  return fmt::format("; times have a spread of {:.1f} % in the median and {:.1f} % at most",
                     spreads[spreads.size() / 2], spreads.back());
}

}  // namespace

std::string to_markdown(const BenchReport& report) {
  std::string text;
  for (const MethodComparison& contest : report.contests) {
    text += fmt::format("{}, scene `{}`", escaped(contest.title), escaped(contest.scene));
    if (!contest.no_reference.empty()) {
      text += fmt::format(": {}\n\n", escaped(contest.no_reference));
      continue;
    }
    text +=
        ": time for an error at the end, and in brackets how many times as long\nas the fastest "
        "of ours.\n\n";
    text += table(contest) + '\n';
  }
  if (report.several)
    text += "Geometric means of how many times as long as the fastest of ours:\n\n" +
            summary_table(report) + '\n';
  return text + fmt::format("Measured on {}; {}{}.\n", processor_text(report.machine),
                            versions_text(report.machine), spread_text(report));
}

}  // namespace casimir::tools
