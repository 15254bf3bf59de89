// casimir check: what is said of a certificate.
#include "tools/text/runs/certificate_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <sstream>

#include "tools/cli/errors.hpp"
#include "tools/text/runs/outward_decimals.hpp"
#include "tools/text/runs/run_report.hpp"

namespace casimir::tools {
namespace {

std::string words_of(TraceFault fault) {
  switch (fault) {
    case TraceFault::shape:
      return "the numbers of states, integrals and coordinates do not go together";
    case TraceFault::start:
      return "the start is not certain to be in the first set";
    case TraceFault::time:
      return "the lengths of the steps do not lead to the duration";
    case TraceFault::no_value:
      return "the equations are not certain to have a value on the set";
    case TraceFault::not_enclosed:
      return "a solution is not certain to stay in the rough enclosure";
    case TraceFault::frame:
      return "the frame of the next set is not certain to be regular";
    case TraceFault::outside:
      return "the flow is not certain to take the set into the next one";
    case TraceFault::level:
      return "an integral has another value in all of the set";
    case TraceFault::not_smooth:
      return "a function of the level is not certain to be smooth there";
    case TraceFault::end:
      return "the last set is not in the box at the end";
    case TraceFault::stopped:
      return "the time limit was reached";
    default:
      return {};
  }
}

/// Where so many letters of UTF-8 end that begin at a place.
std::size_t end_of_letters(const std::string& text, std::size_t begin, std::size_t letters) {
  const auto continues = [&](std::size_t i) {
    return (static_cast<unsigned char>(text[i]) & 0xC0U) == 0x80U;
  };
  std::size_t end = begin;
  for (; end < text.size() && letters > 0; --letters) {
    ++end;
    while (end < text.size() && continues(end)) ++end;
  }
  return end;
}

/// Whole, in lines that a terminal shows: what is checked is what they say.
void print_equations(const std::string& equations) {
  constexpr std::size_t kWidth = 92;
  std::istringstream lines(equations);
  for (std::string line; std::getline(lines, line);) {
    const std::string shown = printable(line, line.size());
    for (std::size_t at = 0; at < shown.size();) {
      const std::size_t end = end_of_letters(shown, at, kWidth);
      fmt::print("    {}{}\n", at > 0 ? "  " : "", shown.substr(at, end - at));
      at = end;
    }
  }
}

/// The equations without the scene, which is where one cycle was looked for: all of the text,
/// where something else stands behind it.
std::string motion_of(const CycleCertificate& certificate) {
  const std::string scene = "\n[[scene]]", &text = certificate.equations;
  const auto at = text.rfind(scene);
  if (at == std::string::npos || text.find('[', at + scene.size()) != std::string::npos)
    return text;
  return text.substr(0, at);
}

bool is_of_the_same(const CycleCertificate& a, const CycleCertificate& b) {
  return a.of_case == b.of_case && a.plane == b.plane && motion_of(a) == motion_of(b);
}

nlohmann::ordered_json intervals(const std::vector<std::string>& names,
                                 const std::vector<RationalInterval>& values) {
  auto json = nlohmann::ordered_json::object();
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto [low, high] = decimal_ends(values[i]);
    json[names[i]] = {low, high};
  }
  return json;
}

void print_intervals(const char* indent, const std::vector<std::string>& names,
                     const std::vector<RationalInterval>& values, int digits = 17) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto [low, high] = decimal_ends(values[i], digits);
    fmt::print("{}{:<10} [{}, {}]\n", indent, names[i], low, high);
  }
}

std::string duration_of(const CheckedCertificate& checked) {
  std::ostringstream text;
  text << checked.duration;
  return text.str();
}

}  // namespace

std::string CertificateReport::reason() const {
  if (!checked.unproved.empty())
    return fmt::format("{} is not proved to be constant", printable(checked.unproved));
  const TraceCheck& check = checked.check;
  if (check.fault == TraceFault::none) return {};
  return check.step > 0 ? fmt::format("step {}: {}", check.step, words_of(check.fault))
                        : words_of(check.fault);
}

nlohmann::ordered_json to_json(const CertificateReport& report) {
  const CheckedCertificate& checked = report.checked;
  nlohmann::ordered_json json = {
      {"certificate", "run"},
      {"case", report.certificate.of_case},
      {"scene", report.certificate.scene},
      {"verdict", checked.holds()                              ? "checked"
                  : checked.check.fault == TraceFault::stopped ? "stopped"
                                                               : "refuted"},
      {"equations", report.certificate.equations},
      {"steps", report.certificate.trace.steps.size()},
      {"integrals", checked.integrals},
      {"t", duration_of(checked)}};
  if (checked.holds()) {
    json["radius"] = decimal_above(checked.radius);
    for (std::size_t i = 0; i < report.certificate.radii.size(); ++i)
      json["start_radii"][checked.names[i]] = decimal_above(report.certificate.radii[i]);
    json["enclosure"] = intervals(checked.names, checked.check.end);
  } else {
    json["reason"] = report.reason();
    json["failed_step"] = checked.check.step > 0 ? nlohmann::ordered_json(checked.check.step)
                                                 : nlohmann::ordered_json(nullptr);
  }
  json["seconds"] = report.seconds;
  return json;
}

void print_text(const CertificateReport& report) {
  const CheckedCertificate& checked = report.checked;
  const std::string of = fmt::format("{}, scene '{}'", printable(report.certificate.of_case, 100),
                                     printable(report.certificate.scene, 100));
  if (!checked.holds()) {
    fmt::print("{}: not proved\n  {}\n", of, report.reason());
    return;
  }
  fmt::print("{}: checked, {} steps in {}\n", of, report.certificate.trace.steps.size(),
             duration_text(report.seconds));
  print_equations(report.certificate.equations);
  if (!checked.integrals.empty())
    fmt::print("  proved again to be constant: {}\n", fmt::join(checked.integrals, ", "));
  if (!report.certificate.radii.empty())
    fmt::print("  for every start that differs by no more than\n");
  for (std::size_t i = 0; i < report.certificate.radii.size(); ++i)
    fmt::print("  {:<10} {}\n", checked.names[i], decimal_above(report.certificate.radii[i]));
  fmt::print("  t = {}\n", duration_of(checked));
  print_intervals("  ", checked.names, checked.check.end);
  fmt::print("  proved: the state is in this box, whose radius is {}\n",
             decimal_above(checked.radius));
}

bool CyclesReport::holds() const {
  return std::ranges::all_of(checked, [](const CheckedCycle& cycle) { return cycle.holds(); });
}

nlohmann::ordered_json to_json(const CyclesReport& report) {
  const bool stopped = std::ranges::any_of(report.checked, &CheckedCycle::stopped);
  nlohmann::ordered_json json = {{"certificate", "cycles"},
                                 {"verdict", report.holds() ? "checked"
                                             : stopped      ? "stopped"
                                                            : "refuted"},
                                 {"cycles", nlohmann::ordered_json::array()}};
  for (std::size_t k = 0; k < report.checked.size(); ++k) {
    const CheckedCycle& cycle = report.checked[k];
    nlohmann::ordered_json one = {{"case", report.certificates[k].of_case},
                                  {"verdict", cycle.holds()   ? "checked"
                                              : cycle.stopped ? "stopped"
                                                              : "refuted"},
                                  {"equations", report.certificates[k].equations},
                                  {"plane", report.certificates[k].plane}};
    if (cycle.holds()) {
      one["level"] = intervals(cycle.level_names, cycle.levels);
      const auto [low, high] = decimal_ends(cycle.period);
      one["period"] = {low, high};
      one["enclosure"] = intervals(cycle.names, cycle.state);
    } else {
      one["reason"] = cycle.reason;
    }
    json["cycles"].push_back(std::move(one));
  }
  json["seconds"] = report.seconds;
  return json;
}

void print_text(const CyclesReport& report) {
  fmt::print("{} certificates of cycles, looked through in {}\n", report.checked.size(),
             duration_text(report.seconds));
  const CycleCertificate* said = nullptr;
  for (std::size_t k = 0; k < report.checked.size(); ++k) {
    const CycleCertificate& certificate = report.certificates[k];
    const CheckedCycle& cycle = report.checked[k];
    if (!said || !is_of_the_same(*said, certificate)) {
      fmt::print("  of {}\n", printable(certificate.of_case, 100));
      print_equations(motion_of(certificate));
      fmt::print("  through {} = 0\n", printable(certificate.plane, 400));
      said = &certificate;
    }
    if (!cycle.holds()) {
      fmt::print("  {:>3}  not proved: {}\n", k + 1, cycle.reason);
      continue;
    }
    constexpr int kDigits = 13;
    const auto [low, high] = decimal_ends(cycle.period, kDigits);
    fmt::print("  {:>3}  proved: one orbit with a period in [{}, {}] through\n", k + 1, low, high);
    print_intervals("       ", cycle.names, cycle.state, kDigits);
    if (!cycle.levels.empty()) fmt::print("       for all values of\n");
    print_intervals("       ", cycle.level_names, cycle.levels);
  }
}

nlohmann::ordered_json to_json(const CheckedHorseshoeReport& report) {
  const CheckedHorseshoe& checked = report.checked;
  nlohmann::ordered_json json = {{"certificate", "horseshoe"},
                                 {"case", report.certificate.of_case},
                                 {"verdict", checked.holds()   ? "checked"
                                             : checked.stopped ? "stopped"
                                                               : "refuted"},
                                 {"equations", report.certificate.equations},
                                 {"plane", report.certificate.plane},
                                 {"sets", report.certificate.sets.size()},
                                 {"coverings", report.certificate.coverings.size()},
                                 {"integrals", checked.level_names}};
  if (checked.holds()) {
    json["level"] = intervals(checked.level_names, checked.levels);
    json["parts"] = checked.parts;
    json["entropy"] = decimal_below(checked.entropy);
  } else {
    json["reason"] = checked.stopped ? "the time limit was reached" : checked.reason;
  }
  json["seconds"] = report.seconds;
  return json;
}

void print_text(const CheckedHorseshoeReport& report) {
  const CheckedHorseshoe& checked = report.checked;
  const HorseshoeCertificate& certificate = report.certificate;
  const std::string of = printable(certificate.of_case, 100);
  if (!checked.holds()) {
    fmt::print("{}: not proved\n  {}\n", of,
               checked.stopped ? "the time limit was reached" : checked.reason);
    return;
  }
  fmt::print("{}: checked, {} coverings of {} h-sets by {} enclosed images in {}\n", of,
             certificate.coverings.size(), certificate.sets.size(), checked.parts,
             duration_text(report.seconds));
  print_equations(certificate.equations);
  fmt::print("  returns to {} = 0, upwards\n", printable(certificate.plane, 400));
  print_intervals("  ", checked.level_names, checked.levels);
  fmt::print(
      "  proved: the first return map has an orbit for every path of the graph of the coverings; "
      "its\n  topological entropy is at least {}\n",
      decimal_below(checked.entropy));
}

}  // namespace casimir::tools
