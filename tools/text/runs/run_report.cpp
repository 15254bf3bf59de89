#include "tools/text/runs/run_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace casimir::tools {
namespace {

using Json = nlohmann::ordered_json;

Json exact_number(double value) {
  return std::isfinite(value) ? Json(exact_text(value)) : Json(nullptr);
}

std::string short_number(double value) {
  return std::isnan(value) ? "-" : fmt::format("{:.1e}", value);
}

std::string spread_text(const Row& row) {
  return row.rounds < 2 ? "-" : fmt::format("{:.1f} %", 100 * row.spread / row.seconds);
}

}  // namespace

std::string status_text(const Row& row) {
  switch (row.end) {
    case RowEnd::ran:
      break;
    case RowEnd::wrong:
      return "wrong";
    case RowEnd::too_slow:
      return "too_slow";
    case RowEnd::refused:
      return "refused";
    case RowEnd::crashed:
      return "crashed";
    case RowEnd::does_not_split:
      return "does not split";
    case RowEnd::drifted:
      return fmt::format("drift above {:g}", row.bound);
    case RowEnd::lost:
      return fmt::format("{} has no value at some state, and cannot be watched", row.reason);
    case RowEnd::changes:
      return fmt::format("{} is not kept: its rate is not zero", row.reason);
    case RowEnd::changes_in_step:
      return fmt::format("{} is not kept: it has another value at the next point", row.reason);
  }
  return to_string(row.status);
}

Json to_json(const std::vector<Row>& rows) {
  Json list = Json::array();
  int failed = 0;
  for (const Row& row : rows) {
    failed += row.failed ? 1 : 0;
    list.push_back({{"case", row.case_name},
                    {"scene", row.scene},
                    {"method", row.method},
                    {"code", row.code},
                    {"tolerance", row.tolerance},
                    {"error", exact_number(row.error)},
                    {"drift", exact_number(row.drift)},
                    {"seconds", row.seconds},
                    {"spread", row.spread},
                    {"rounds", row.rounds},
                    {"steps", row.steps},
                    {"evaluations", row.evaluations},
                    {"status", status_text(row)},
                    {"failed", row.failed}});
    if (!row.reason.empty()) list.back()["reason"] = row.reason;
  }
  return {{"rows", list}, {"failed", failed}};
}

std::string to_text(const std::vector<Row>& rows, bool with_error) {
  const bool repeated =
      std::any_of(rows.begin(), rows.end(), [](const Row& row) { return row.spread > 0; });
  // Columns that are there or not.
  const auto error_column = [&](const std::string& content) {
    return with_error ? fmt::format("{:>9}  ", content) : "";
  };
  const auto spread_column = [&](const std::string& content) {
    return repeated ? fmt::format("{:>7} ", content) : "";
  };
  std::string text;
  std::string head;
  for (const Row& row : rows) {
    const std::string title = fmt::format("{}, scene '{}'\n", row.case_name, row.scene);
    if (title != head) {
      head = title;
      text +=
          title + fmt::format("  {:<18} {:<12} {:>9} {}{:>9} {:>10} {}{:>9} {:>11}  {}\n", "method",
                              "code", "tolerance", error_column("error"), "drift", "time",
                              spread_column("spread"), "steps", "evaluations", "status");
    }
    text +=
        fmt::format("  {:<18} {:<12} {:>9.0e} {}{:>9} {:>10} {}{:>9} {:>11}  {}\n", row.method,
                    row.code, row.tolerance, error_column(short_number(row.error)),
                    short_number(row.drift), duration_text(row.seconds),
                    spread_column(spread_text(row)), row.steps, row.evaluations, status_text(row));
  }
  return text;
}

std::string conservation_sentence(const std::vector<Row>& rows, double bound) {
  const auto count = [&](const auto& which) {
    return static_cast<std::size_t>(std::count_if(rows.begin(), rows.end(), which));
  };
  const auto keeps = [](const Row& row) {
    return !row.failed && !row.refused && !std::isnan(row.drift);
  };
  const std::size_t refused = count([](const Row& row) { return row.refused; });
  const std::size_t missing =
      count([](const Row& row) { return !row.refused && row.status != Status::ok; });
  const std::size_t unwatched =
      count([](const Row& row) { return !row.failed && !row.refused && std::isnan(row.drift); });
  std::string text = unwatched == rows.size()
                         ? fmt::format("{} run{} arrived, and there is no invariant to look at",
                                       rows.size(), rows.size() == 1 ? "" : "s")
                         : fmt::format("{} of {} runs keep every invariant to {:g}", count(keeps),
                                       rows.size(), bound);
  if (unwatched > 0 && unwatched < rows.size())
    text += fmt::format("; {} {} none", unwatched, unwatched == 1 ? "has" : "have");
  if (missing > 0) text += fmt::format("; {} did not arrive", missing);
  if (refused > 0)
    text += fmt::format(
        "; {} {} refused: an extreme scene, one that the method is not made for, or "
        "no time was left",
        refused, refused == 1 ? "is" : "are");
  return text;
}

std::string advice(Status status) {
  switch (status) {
    case Status::non_finite:
      return "a number that the equations need has no value here, or is beyond all doubles: try "
             "--digits 20 or other variables, or shorten --duration";
    case Status::singularity:
      return "the motion has no value further on in these variables: shorten --duration, or use "
             "other variables";
    case Status::step_underflow:
      return "loosen --tolerance or try another --method";
    case Status::max_steps:
      return "raise --max-steps";
    case Status::no_convergence:
      return "try a smaller --step, or --method dop853";
    case Status::drift_exceeded:
      return "tighten --tolerance, or try another --method";
    case Status::stopped:
      return "raise --time-limit";
    case Status::at_jump:
      return "end the run before it, or take a smooth function for the sign, as tanh(1000*v)";
    default:
      return "";
  }
}

std::string duration_text(double seconds) {
  if (seconds < 1e-3) return fmt::format("{:.1f} us", seconds * 1e6);
  if (seconds < 1) return fmt::format("{:.2f} ms", seconds * 1e3);
  return fmt::format("{:.2f} s", seconds);
}

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

}  // namespace casimir::tools
