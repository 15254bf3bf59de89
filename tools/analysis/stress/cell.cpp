#include "tools/analysis/stress/cell.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace casimir {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Without an answer that can be read: a run that was refused, took too long, or crashed.
StressCell without_answer(StressCell cell, const StressAnswer& answer) {
  using Kind = StressAnswer::Kind;
  cell.row.error = cell.row.drift = kNaN;
  bool clear = false;
  if (answer.kind == Kind::killed) {
    cell.row.status = Status::stopped;
    cell.row.reason = "it took too long and did not stop by itself";
    clear = true;
  } else if (answer.kind == Kind::refused) {
    cell.row.end = RowEnd::refused;
    cell.row.reason = answer.complaint;
    clear = !answer.says_done && !answer.complaint.empty();
  } else {
    cell.row.end = RowEnd::crashed;
    cell.row.reason = "the process ended without a word";
  }
  cell.verdict = clear ? Judgement::refused : Judgement::wrong;
  if (clear)
    cell.refusal = answer.kind == Kind::refused && answer.unsuitable ? Refusal::not_applicable
                                                                     : Refusal::failed;
  cell.row.failed = !cell.outside && !clear;
  return cell;
}

/// What could explain an error of this run.
double explained(const StressAnswer& answer, const SceneReference& truth) {
  Entrant entrant = {};
  entrant.settings.rtol = answer.rtol;
  entrant.settings.atol = answer.atol;
  Sample sample;
  sample.steps = answer.steps;
  return explained_error(entrant, sample, *truth.truth, truth.growth);
}

void fill(Row& row, const StressAnswer& answer) {
  row.tolerance = answer.tolerance;
  row.drift = answer.drift;
  row.seconds = answer.seconds;
  row.steps = answer.steps;
  row.evaluations = answer.evaluations;
  row.status = answer.status;
}

/// Why a cell is what it is, where its status does not tell.
std::string reason_of(const StressCell& cell, const Answer& judged, const StressAnswer& answer,
                      const SceneReference& truth) {
  if (cell.verdict == Judgement::refused) return answer.stop_reason;
  if (cell.verdict == Judgement::unknown) return truth.source;
  if (cell.verdict == Judgement::right) return "";
  if (!judged.has_end) return "says ok, and the motion does not reach that time";
  if (judged.meets_pole && cell.verdict == Judgement::wrong)
    return "says ok, having gone over a pole of the equations";
  if (!judged.finite) return "says ok with a number that is not finite";
  if (cell.verdict == Judgement::warned) return answer.warnings;
  return fmt::format("says ok with an error of {:.1e}; tolerance and conditioning explain {:.1e}",
                     judged.error, judged.explained);
}

/// Whether the motion reaches the end, as far as is known: one over a pole that can be removed
/// does.
bool ends(const SceneReference& truth) {
  return truth.has_end && (truth.truth || !truth.singular_time);
}

double value_of(const StressAnswer& answer, const std::string& name) {
  const auto found = std::ranges::find(answer.state, name, &std::pair<std::string, double>::first);
  return found == answer.state.end() ? kNaN : found->second;
}

}  // namespace

std::string to_string(Refusal refusal) {
  switch (refusal) {
    case Refusal::expected:
      return "expected";
    case Refusal::not_applicable:
      return "not_applicable";
    case Refusal::failed:
      return "failed";
    default:
      return "none";
  }
}

StressCell cell_of(const Row& asked, bool outside, const SceneReference& truth,
                   const StressAnswer& answer) {
  StressCell cell{.row = asked, .outside = outside};
  if (answer.kind != StressAnswer::Kind::answered) return without_answer(cell, answer);
  fill(cell.row, answer);
  Answer judged{.ok = answer.status == Status::ok && answer.says_done,
                .warned = answer.warned,
                .finite = std::isfinite(cell.row.drift),
                .has_end = truth.has_end,
                .meets_pole = truth.singular_time.has_value(),
                .error = kNaN,
                .explained = 0,
                .tolerance = cell.row.tolerance};
  std::vector<double> state;
  for (const std::string& name : truth.states) {
    state.push_back(value_of(answer, name));
    judged.finite = judged.finite && std::isfinite(state.back());
  }
  if (judged.ok && truth.truth) {
    judged.error = error_of(state, *truth.truth);
    judged.explained = explained(answer, truth);
  }
  cell.row.error = judged.error;
  if (!judged.ok && truth.singular_time && answer.stopped_at)
    cell.time_error = std::abs(*answer.stopped_at / *truth.singular_time - 1);
  cell.verdict = judge(judged);
  if (cell.verdict == Judgement::refused)
    cell.refusal = ends(truth) ? Refusal::failed : Refusal::expected;
  cell.row.failed = cell.verdict == Judgement::wrong && !outside;
  cell.row.reason = reason_of(cell, judged, answer, truth);
  return cell;
}

}  // namespace casimir
