#include <cmath>

#include "tools/bench/comparison.hpp"
#include "tools/bench/report.hpp"
#include "tools/text/files/generated_report.hpp"

namespace casimir::tools {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json ratios_json(const MethodComparison& contest) {
  Json list = Json::array();
  for (const Line& line : equal_error_lines(contest)) {
    const auto add = [&](const Cell& cell, bool best) {
      list.push_back({{"method", line.contender.method},
                      {"code", line.contender.code},
                      {"library", line.contender.outside},
                      {"error", number(cell.error)},
                      {"best", best},
                      {"seconds", number(cell.seconds)},
                      {"fastest", cell.fastest},
                      {"fastest_seconds", number(cell.fastest_seconds)},
                      {"ratio", number(cell.ratio)}});
    };
    for (const Cell& cell : line.levels) add(cell, false);
    add(line.best, true);
  }
  return list;
}

Json code_json(const MethodComparison& contest) {
  Json list = Json::array();
  for (const CodeLine& line : code_lines(contest)) {
    for (std::size_t i = 0; i < line.ratios.size(); ++i)
      list.push_back({{"method", line.method},
                      {"error", kErrorLevels[i]},
                      {"general_over_specialised", number(line.ratios[i])}});
  }
  return list;
}

Json method_comparison_json(const MethodComparison& contest) {
  Json json = {{"case", contest.case_name}, {"title", contest.title}, {"scene", contest.scene}};
  json["operations"] = {{"general", to_json(contest.general)},
                        {"specialised", to_json(contest.specialised)}};
  json["states"] = {{"general", contest.all_states}, {"specialised", contest.states}};
  json["notes"] = contest.notes;
  if (!contest.no_reference.empty()) {
    json["no_reference"] = contest.no_reference;
    return json;
  }
  json["reference"] = {{"source", contest.reference},
                       {"error_bound", exact_text(contest.error_bound)},
                       {"digits", contest.digits}};
  json["conditioning"] = number(contest.conditioning);
  json["ratios"] = ratios_json(contest);
  json["code_ratios"] = code_json(contest);
  return json;
}

Json summary_json(const BenchReport& report) {
  Json list = Json::array();
  for (const Mean& mean : means(report.contests)) {
    list.push_back({{"method", mean.peer},
                    {"error", mean.at_best ? Json("best") : Json(mean.error)},
                    {"geometric_mean", number(mean.ratio)},
                    {"cases", mean.cases},
                    {"least", number(mean.least)},
                    {"least_case", mean.least_case}});
  }
  return list;
}

}  // namespace

Json to_json(const BenchReport& report) {
  Json json = to_json(report.rows());
  if (report.several) {
    json["cases"] = Json::array();
    for (const MethodComparison& contest : report.contests)
      json["cases"].push_back(method_comparison_json(contest));
    json["summary"] = summary_json(report);
  } else {
    for (const MethodComparison& contest : report.contests)
      json.update(method_comparison_json(contest));
  }
  add_to_json(json, report.machine);
  return json;
}

std::vector<Row> BenchReport::rows() const {
  std::vector<Row> all;
  for (const MethodComparison& contest : contests)
    all.insert(all.end(), contest.rows.begin(), contest.rows.end());
  return all;
}

}  // namespace casimir::tools
