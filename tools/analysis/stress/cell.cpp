#include "tools/analysis/stress/cell.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tools/analysis/scene_run.hpp"

namespace casimir::tools {
namespace {

using Json = nlohmann::json;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// A number as `integrate` writes it; not a number where it wrote none.
double number(const Json& value) {
  if (value.is_number()) return value.get<double>();
  return value.is_string() ? std::strtod(value.get<std::string>().c_str(), nullptr) : kNaN;
}

/// The first line of what the program said on standard error, without its name.
std::string complaint(const std::string& text) {
  constexpr std::string_view kBefore = "casimir: error: ";
  std::string line = text.substr(0, text.find('\n'));
  if (line.starts_with(kBefore)) line.erase(0, kBefore.size());
  return printable(line, 200);
}

/// Without an answer that can be read: a run that was refused, took too long, or crashed.
StressCell without_answer(StressCell cell, const Reply& reply) {
  cell.row.error = cell.row.drift = kNaN;
  if (reply.killed) {
    cell.row.status = to_string(Status::stopped);
    cell.row.reason = "it took too long and did not stop by itself";
  } else if (reply.exit >= 0) {
    cell.row.status = "refused";
    cell.row.reason = complaint(reply.err);
  } else {
    cell.row.status = "crashed";
    cell.row.reason = "the process ended without a word";
  }
  const bool clear = reply.killed || (reply.exit > 0 && !cell.row.reason.empty());
  cell.verdict = clear ? Judgement::refused : Judgement::wrong;
  cell.row.failed = !cell.outside && !clear;
  return cell;
}

/// Whether the run said that its end state is not to be trusted. That the equations were
/// interpreted is said beside, and no such warning.
bool warned(const Json& answer) {
  if (answer.at("trust").at("beyond_double") == true) return true;
  return std::ranges::any_of(answer.at("warnings"),
                             [](const Json& warning) { return warning != kInterpretedWarning; });
}

/// What could explain an error of this run.
double explained(const Json& answer, const SceneTruth& truth) {
  Entrant entrant = {};
  entrant.settings.rtol = number(answer.at("rtol"));
  entrant.settings.atol = number(answer.at("atol"));
  Sample sample;
  sample.steps = answer.at("steps").get<unsigned long long>();
  return explained_error(entrant, sample, *truth.truth, truth.growth);
}

void fill(Row& row, const Json& answer) {
  row.tolerance = number(answer.at("tolerance"));
  row.drift = 0;
  for (const auto& [name, record] : answer.at("invariants").items()) {
    const double drift = number(record.at("drift"));
    if (!(drift <= row.drift)) row.drift = drift;  // one that is no number stays
    if (std::isnan(row.drift)) break;
  }
  row.seconds = answer.at("seconds").at("integrate").get<double>();
  row.steps = answer.at("steps").get<unsigned long long>();
  row.evaluations = answer.at("evaluations").get<unsigned long long>();
  row.status = answer.at("status").get<std::string>();
}

/// Why a cell is what it is, where its status does not tell.
std::string reason_of(const StressCell& cell, const Answer& answer, const Json& said,
                      const SceneTruth& truth) {
  if (cell.verdict == Judgement::refused)
    return said.contains("stopped") ? said.at("stopped").value("reason", "") : "";
  if (cell.verdict == Judgement::unknown) return truth.source;
  if (cell.verdict == Judgement::right) return "";
  if (!answer.has_end) return "says ok, and the motion does not reach that time";
  if (answer.meets_pole && cell.verdict == Judgement::wrong)
    return "says ok, having gone over a pole of the equations";
  if (!answer.finite) return "says ok with a number that is not finite";
  if (cell.verdict == Judgement::warned) return said.at("warnings").dump();
  return fmt::format("says ok with an error of {:.1e}; tolerance and conditioning explain {:.1e}",
                     answer.error, answer.explained);
}

}  // namespace

StressCell cell_of(const Row& asked, bool outside, const SceneTruth& truth, const Reply& reply) {
  StressCell cell{.row = asked, .outside = outside};
  const Json said = Json::parse(reply.out, nullptr, false);
  if (said.is_discarded() || reply.killed) return without_answer(cell, reply);
  fill(cell.row, said);
  Answer answer{.ok = cell.row.status == "ok" && reply.exit == 0,
                .warned = warned(said),
                .finite = std::isfinite(cell.row.drift),
                .has_end = truth.has_end,
                .meets_pole = truth.singular_time.has_value(),
                .error = kNaN,
                .explained = 0,
                .tolerance = cell.row.tolerance};
  std::vector<double> state;
  for (const std::string& name : truth.states) {
    state.push_back(number(said.at("state").value(name, Json())));
    answer.finite = answer.finite && std::isfinite(state.back());
  }
  if (answer.ok && truth.truth) {
    answer.error = error_of(state, *truth.truth);
    answer.explained = explained(said, truth);
  }
  cell.row.error = answer.error;
  if (!answer.ok && truth.singular_time && said.contains("stopped"))
    cell.time_error = std::abs(number(said.at("stopped").at("time")) / *truth.singular_time - 1);
  cell.verdict = judge(answer);
  cell.row.failed = cell.verdict == Judgement::wrong && !outside;
  cell.row.reason = reason_of(cell, answer, said, truth);
  return cell;
}

}  // namespace casimir::tools
