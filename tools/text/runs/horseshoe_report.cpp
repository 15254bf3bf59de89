// What section --horseshoe prints.
#include "tools/text/runs/horseshoe_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "symbolic/error.hpp"
#include "tools/text/runs/outward_decimals.hpp"
#include "tools/text/runs/run_report.hpp"
#include "tools/text/text_layout.hpp"

namespace casimir::tools {
namespace {

using Json = nlohmann::ordered_json;
using horseshoe::HSet;
using horseshoe::SectionSystem;

/// The number with ten digits that is next to a double, exactly.
cln::cl_RA ten_digits(double value) {
  constexpr long kAfterPoint = 9;
  std::string text = fmt::format("{:.9e}", value);
  const std::size_t mark = text.find('e');
  const long power = std::stol(text.substr(mark + 1)) - kAfterPoint;
  text.resize(mark);
  std::erase(text, '.');
  return cln::cl_I(text.c_str()) * cln::expt(cln::cl_RA(10), cln::cl_I(power));
}

/// A value of ten digits only where it is one of those for which all is proved.
std::string level_text(const SectionSystem& system) {
  std::vector<std::string> parts;
  for (std::size_t a = 0; a < system.levels.size(); ++a) {
    const RationalInterval& level = system.levels[a];
    const double middle = cln::double_approx((level.low + level.high) / 2);
    const cln::cl_RA shown = ten_digits(middle);
    const auto [low, high] = decimal_ends(level);
    const std::string& name = system.level_names[a];
    if (level.low <= shown && shown <= level.high)
      parts.push_back(fmt::format("{} = {:.10g}", name, middle));
    else if (low == high)
      parts.push_back(fmt::format("{} = {}", name, low));
    else
      parts.push_back(fmt::format("{} in [{}, {}]", name, low, high));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string surface_text(const SectionSystem& system) {
  return fmt::format("{}{} {}", printable(system.plane_text, 200),
                     system.plane_text.find('=') == std::string::npos ? " = 0" : "",
                     system.upwards ? "upwards" : "downwards");
}

Json column_json(const SectionSystem& system, const HSet& set, std::size_t column) {
  Json json = Json::object();
  for (std::size_t i = 0; i < set.states(); ++i)
    json[system.names[i]] = exact_text(set.frame(i, column));
  return json;
}

Json set_json(const SectionSystem& system, const HSet& set) {
  Json json = {{"name", set.name}, {"centre", Json::object()}};
  for (std::size_t i = 0; i < set.states(); ++i)
    json["centre"][system.names[i]] = exact_text(set.centre[i]);
  json["unstable"] = column_json(system, set, 0);
  json["stable"] = column_json(system, set, 1);
  json["others"] = Json::array();
  for (std::size_t k = 2; k < set.states(); ++k)
    json["others"].push_back(
        {{"direction", column_json(system, set, k)}, {"half_width", exact_text(set.sheet[k - 2])}});
  return json;
}

const std::vector<std::string>& hypotheses() {
  static const std::vector<std::string> all = {
      "the functions of the level are proved to be constant along solutions",
      "each h-set lies on the surface and the level: for all a, b in [-1, 1] exactly one point "
      "centre + a*unstable + b*stable + the others does (Krawczyk)",
      "the surface is crossed transversally on the h-sets and at every return",
      "the return map is the first return in this direction, on all points of the h-sets: every "
      "zero of the surface's function on the way is enclosed, none missed",
      "coverings: both unstable edges are mapped beyond the target on opposite sides, and the "
      "image meets no stable edge of it (Zgliczynski & Gidea 2004, definition 6)",
      "the h-sets are disjoint, and the graph of the coverings is strongly connected",
  };
  return all;
}

void print_paragraph(const std::string& text) {
  for (const std::string& line : wrapped(text, std::max<std::size_t>(output_width() - 4, 40)))
    fmt::print("  {}\n", line);
}

}  // namespace

std::string HorseshoeReport::theorem() const {
  const SectionSystem& system = answer.system;
  const std::string level = system.levels.empty() ? "" : " on the level " + level_text(system);
  return fmt::format(
      "The first return map P to the surface {}{} has a compact invariant set on which it is "
      "semiconjugate to the subshift of the graph of {} h-sets: for every path of the graph there "
      "is "
      "an orbit that visits the h-sets in this order, and a periodic one for every cycle of it "
      "(Zgliczynski & Gidea 2004, theorem 9). Its topological entropy is at least {}. Hence every "
      "function that is real-analytic on a connected neighbourhood{} of the orbits from the h-sets "
      "to their returns, and constant along solutions, is constant there (Bowen 1971, theorem 17): "
      "there is no further real-analytic integral.",
      surface_text(system), level, answer.sets.size(), decimal_below(answer.entropy),
      system.levels.empty() ? "" : ", in the level,");
}

nlohmann::ordered_json to_json(const HorseshoeReport& report) {
  const Horseshoe& answer = report.answer;
  const SectionSystem& system = answer.system;
  Json json = {{"case", report.case_name},
               {"scene", report.scene},
               {"verdict", answer.proved ? "proved" : "not found"},
               {"plane", system.plane_text},
               {"direction", system.upwards ? "up" : "down"},
               {"level", Json::object()}};
  for (std::size_t a = 0; a < system.levels.size(); ++a) {
    const auto [low, high] = decimal_ends(system.levels[a]);
    json["level"][system.level_names[a]] = {low, high};
  }
  if (answer.proved) {
    json["sets"] = Json::array();
    for (const HSet& set : answer.sets) json["sets"].push_back(set_json(system, set));
    json["coverings"] = Json::array();
    for (const auto& [from, to] : answer.coverings)
      json["coverings"].push_back({answer.sets[from].name, answer.sets[to].name});
    json["spectral_radius"] = decimal_below(answer.radius);
    json["entropy"] = decimal_below(answer.entropy);
    json["theorem"] = report.theorem();
    json["hypotheses"] = hypotheses();
  } else {
    json["reason"] = answer.reason;
  }
  json["search"] = {{"cycles", answer.cycles},
                    {"connections", answer.connections},
                    {"attempts", answer.attempts},
                    {"parts", answer.parts}};
  json["seconds"] = report.seconds;
  return json;
}

void print_text(const HorseshoeReport& report) {
  const Horseshoe& answer = report.answer;
  const SectionSystem& system = answer.system;
  fmt::print("{}, scene '{}', returns to {}{}\n", report.case_name, printable(report.scene),
             surface_text(system), system.levels.empty() ? "" : " on " + level_text(system));
  fmt::print("  {} hyperbolic cycles, {} orbits between them, {} attempts in {}\n", answer.cycles,
             answer.connections, answer.attempts, duration_text(report.seconds));
  if (!answer.proved) {
    fmt::print("  not found: {}\n", answer.reason);
    fmt::print("  this says nothing about whether there is chaos\n");
    return;
  }
  for (std::size_t i = 0; i < answer.sets.size(); ++i) {
    std::vector<std::string> targets;
    for (const auto& [from, to] : answer.coverings)
      if (from == i) targets.push_back(answer.sets[to].name);
    fmt::print("  {:<8} covers {}\n", answer.sets[i].name, fmt::join(targets, ", "));
  }
  fmt::print("  proved by {} enclosed images: topological entropy of the return map >= {}\n",
             answer.parts, decimal_below(answer.entropy));
  print_paragraph(report.theorem());
}

}  // namespace casimir::tools
