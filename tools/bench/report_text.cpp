#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "symbolic/error.hpp"
#include "tools/bench/comparison.hpp"
#include "tools/bench/report.hpp"

namespace casimir::tools {
namespace {

std::string ratio_text(double ratio) {
  return std::isnan(ratio) ? "" : fmt::format("{:.{}f}x", ratio, ratio < 100 ? 1 : 0);
}

std::string cell_text(const Cell& cell) {
  if (std::isnan(cell.seconds)) return fmt::format("{:>18}", "-");
  return fmt::format("{:>10} {:>7}", duration_text(cell.seconds), ratio_text(cell.ratio));
}

std::string equal_error_text(const MethodComparison& contest) {
  std::string text =
      "time at equal error (interpolated), and how many times as long as the fastest of ours\n";
  text += fmt::format("  {:<22}", "error");
  for (const double error : kErrorLevels) text += fmt::format("{:>18.0e}", error);
  text += fmt::format("{:>18}\n", "best it reaches");
  for (const Line& line : equal_error_lines(contest)) {
    text += fmt::format("  {:<22}", line.contender.label());
    for (const Cell& cell : line.levels) text += cell_text(cell);
    text += fmt::format("{:>10.1e} {:>7}\n", line.best.error, ratio_text(line.best.ratio));
  }
  return text;
}

std::string code_text(const MethodComparison& contest) {
  const std::size_t kept = contest.states.size(), all = contest.all_states.size();
  std::string text =
      fmt::format("specialised code beside general code, {} of {} states\n", kept, all);
  text += fmt::format("  one right-hand side, general      {}\n", operations_text(contest.general));
  text +=
      fmt::format("  one right-hand side, specialised  {}\n", operations_text(contest.specialised));
  const std::vector<CodeLine> lines = code_lines(contest);
  if (lines.empty()) return text;
  text += fmt::format("  {:<22}", "general takes, at error");
  for (const double error : kErrorLevels) text += fmt::format("{:>9.0e}", error);
  text += '\n';
  for (const CodeLine& line : lines) {
    text += fmt::format("  {:<23}", line.method);
    for (const double ratio : line.ratios)
      text += fmt::format("{:>9}", std::isnan(ratio) ? "-" : fmt::format("{:.2f}x", ratio));
    text += '\n';
  }
  return text;
}

std::string about_text(const MethodComparison& contest) {
  std::string text = fmt::format("reference: {}; its error is below {:.0e}\n", contest.reference,
                                 contest.error_bound);
  text += growth_sentence(contest) + '\n';
  const auto count = [&](bool failed) {
    return std::count_if(contest.rows.begin(), contest.rows.end(), [&](const Row& row) {
      return row.end == RowEnd::wrong && row.failed == failed;
    });
  };
  if (const auto coarse = count(false); coarse > 0)
    text += fmt::format("{} of {} rows end elsewhere and count nowhere: marked wrong\n", coarse,
                        contest.rows.size());
  if (const auto failed = count(true); failed > 0)
    text += fmt::format("{} of {} rows, of ours, are off by more than any tolerance explains\n",
                        failed, contest.rows.size());
  return text;
}

std::string notes_text(const MethodComparison& contest) {
  std::string text;
  for (const std::string& note : contest.notes) text += "note: " + note + '\n';
  return text;
}

std::string comparison_table(const MethodComparison& contest, bool with_rows) {
  std::string text;
  if (!with_rows || contest.rows.empty())
    text = fmt::format("{}, scene '{}'\n", contest.case_name, printable(contest.scene));
  if (!contest.no_reference.empty()) return text + contest.no_reference + '\n';
  if (with_rows) text += to_text(contest.rows, true) + '\n';
  text += about_text(contest) + notes_text(contest) + '\n' + equal_error_text(contest);
  const std::vector<std::string> said = sentences(contest);
  if (!said.empty()) text += fmt::format("\n{}\n", fmt::join(said, "\n"));
  return text + '\n' + code_text(contest);
}

std::string summary_text(const BenchReport& report) {
  std::string text = fmt::format(
      "how many times as long as the fastest of ours others take: geometric mean, least, cases\n"
      "  {:<20}",
      "error");
  for (const double error : kErrorLevels) text += fmt::format("{:>20.0e}", error);
  text += fmt::format("{:>20}", "best it reaches");
  std::string last;
  for (const Mean& mean : means(report.contests)) {
    if (mean.peer != last) text += fmt::format("\n  {:<20}", mean.peer);
    last = mean.peer;
    text +=
        fmt::format("{:>20}", mean.cases == 0 ? "-"
                                              : fmt::format("{} ({}) {:>3}", ratio_text(mean.ratio),
                                                            ratio_text(mean.least), mean.cases));
  }
  return text + '\n';
}

}  // namespace

std::string operations_text(const OperationCount& count) {
  const auto part = [](int n, const char* what) {
    return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
  };
  return fmt::format("{}, {}, {}, {}", part(count.mul, "multiplication"),
                     part(count.add, "addition"), part(count.div, "division"),
                     part(count.calls, "call"));
}

std::string to_text(const BenchReport& report) {
  std::string text;
  for (const MethodComparison& contest : report.contests)
    text += comparison_table(contest, !report.several) + '\n';
  if (report.several) text += summary_text(report) + '\n';
  return text + fmt::format("machine: {}\n{}\n", processor_text(report.machine),
                            versions_text(report.machine));
}

}  // namespace casimir::tools
