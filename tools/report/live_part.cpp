// The part of a report that integrates by itself: data and script. Without a script nothing of it
// is seen. What a case says goes into a block of JSON, in which no character means anything to
// HTML.
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include <nlohmann/json.hpp>

#include "symbolic/error.hpp"
#include "tools/report/charts.hpp"
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

/// With as many digits as a picture shows, and so few places in the page.
double for_a_picture(double value) {
  constexpr int kDigits = 5;
  const std::string text = fmt::format("{:.{}g}", value, kDigits);
  return std::strtod(text.c_str(), nullptr);
}

/// The motion as it is drawn first, in the form in which the script has it; null where its states
/// are not those that the script integrates.
Json first_picture(const LiveSystem& live, const Motion& motion) {
  constexpr std::size_t kMost = 400;
  const std::size_t shown = std::min(legible_samples(motion), motion.times.size());
  if (motion.names != live.states || shown < 2) return nullptr;
  const std::size_t every = (shown + kMost - 1) / kMost;
  Json times = Json::array(), samples = Json::array();
  for (std::size_t k = 0; k < shown; k += every) {
    times.push_back(for_a_picture(motion.times[k]));
    Json state = Json::array();
    for (const double x : motion.states[k]) state.push_back(for_a_picture(x));
    samples.push_back(std::move(state));
  }
  return {{"times", std::move(times)}, {"samples", std::move(samples)}};
}

}  // namespace

std::string live_part(const LiveSystem& live, const Motion& motion, const std::string& scene,
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
                     {"motion", first_picture(live, motion)},
                     {"layout", layout(live.series)},
                     {"wasm", base64(live.series.bytes)}};
  return "<div id=\"live-place\"></div>\n<script type=\"application/json\" id=\"live-data\">" +
         for_a_page(data) + "</script>\n";
}

std::string page_script() { return std::string("<script>") + kReportScript + "</script>\n"; }

}  // namespace casimir::tools
