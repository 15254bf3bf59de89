// The part of a report that integrates by itself: data and script. Without a script nothing of it
// is seen. What a case says goes into a block of JSON, in which no character means anything to
// HTML.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "symbolic/error.hpp"
#include "tools/report/page.hpp"
#include "tools/report/script/script.hpp"

namespace casimir::tools {
namespace {

using Json = nlohmann::ordered_json;

std::string base64(const std::string& bytes) {
  constexpr const char* kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned group = 0;
    for (std::size_t j = 0; j < 3; ++j)
      group = group << 8U | (i + j < bytes.size() ? static_cast<unsigned char>(bytes[i + j]) : 0U);
    for (std::size_t j = 0; j < 4; ++j)
      text += i + j > bytes.size() ? '=' : kDigits[group >> (18 - 6 * j) & 63U];
  }
  return text;
}

/// JSON to stand in a page: ASCII, and nothing in it ends the element or begins another.
std::string for_a_page(const Json& json) {
  std::string result;
  for (const char c : json.dump(-1, ' ', true, Json::error_handler_t::replace)) {
    if (c == '<' || c == '>' || c == '&' || c == '\'')
      result += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    else
      result += c;
  }
  return result;
}

Json layout(const WasmSeries& series) {
  return {{"order", series.order},
          {"inputs", series.inputs},
          {"unit", series.unit},
          {"rates", series.rates},
          {"values", series.values},
          {"stride", series.stride},
          {"states", series.states},
          {"followed", series.followed},
          {"singular", series.singular},
          {"kinks", series.kinks},
          {"compared", series.needs_comparison}};
}

Json watched(const std::vector<LiveSystem::Watched>& list) {
  Json json = Json::array();
  for (const LiveSystem::Watched& one : list)
    json.push_back({{"text", printable(one.text, 200)},
                    {"at", one.at},
                    {"comparison", to_string(one.comparison)}});
  return json;
}

Json cut(const LiveSystem::Cut& section) {
  const DrawnSection& drawn = section.drawn;
  Json json = {{"plane", section.plane}, {"pair", section.pair}, {"upwards", drawn.upwards}};
  for (const PlottedFunction& function : drawn.plotted) {
    json["labels"].push_back(printable(function.label, 200));
    json["periods"].push_back(function.period);
  }
  json["levels"] = drawn.level_names.size();
  json["fixed"] = drawn.levels ? Json(*drawn.levels) : Json(nullptr);
  json["seeds"] = drawn.seeds;
  return json;
}

}  // namespace

std::string live_part(const LiveSystem& live, const std::string& scene,
                      const std::string& command) {
  Json functions = Json::array();
  for (const std::string& name : live.functions) functions.push_back(printable(name, 200));
  const Json data = {{"scene", printable(scene, 200)},
                     {"command", command},
                     {"states", live.states},
                     {"initial", live.initial},
                     {"parameters", live.parameters},
                     {"values", live.values},
                     {"duration", live.duration},
                     {"functions", functions},
                     {"invariants", live.invariants},
                     {"conditions", watched(live.conditions)},
                     {"constraints", watched(live.constraints)},
                     {"section", live.section ? cut(*live.section) : Json(nullptr)},
                     {"layout", layout(live.series)},
                     {"wasm", base64(live.series.bytes)}};
  return "<div id=\"live-place\"></div>\n<script type=\"application/json\" id=\"live-data\">" +
         for_a_page(data) + "</script>\n";
}

std::string page_script() { return std::string("<script>") + kReportScript + "</script>\n"; }

}  // namespace casimir::tools
