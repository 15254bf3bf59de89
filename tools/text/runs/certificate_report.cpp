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
    json["enclosure"] = nlohmann::ordered_json::object();
    for (std::size_t i = 0; i < checked.names.size(); ++i) {
      const auto [low, high] = decimal_ends(checked.check.end[i]);
      json["enclosure"][checked.names[i]] = {low, high};
    }
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
  std::istringstream lines(report.certificate.equations);
  for (std::string line; std::getline(lines, line);)
    if (!line.empty()) fmt::print("    {}\n", printable(line, 400));
  if (!checked.integrals.empty())
    fmt::print("  proved again to be constant: {}\n", fmt::join(checked.integrals, ", "));
  if (!report.certificate.radii.empty())
    fmt::print("  for every start within the radii that the certificate gives\n");
  fmt::print("  t = {}\n", duration_of(checked));
  for (std::size_t i = 0; i < checked.names.size(); ++i) {
    const auto [low, high] = decimal_ends(checked.check.end[i]);
    fmt::print("  {:<10} [{}, {}]\n", checked.names[i], low, high);
  }
  fmt::print("  proved: the state is in this box, whose radius is {}\n",
             decimal_above(checked.radius));
}

bool CyclesReport::holds() const {
  return std::ranges::all_of(checked, [](const CheckedCycle& cycle) { return cycle.holds(); });
}

nlohmann::ordered_json to_json(const CyclesReport& report) {
  nlohmann::ordered_json json = {{"certificate", "cycles"},
                                 {"verdict", report.holds() ? "checked" : "refuted"},
                                 {"cycles", nlohmann::ordered_json::array()}};
  for (std::size_t k = 0; k < report.checked.size(); ++k) {
    const CheckedCycle& cycle = report.checked[k];
    nlohmann::ordered_json one = {{"case", report.certificates[k].of_case},
                                  {"verdict", cycle.holds() ? "checked" : "refuted"},
                                  {"equations", report.certificates[k].equations},
                                  {"plane", report.certificates[k].plane}};
    if (cycle.holds()) {
      const auto [low, high] = decimal_ends(cycle.period);
      one["period"] = {low, high};
      one["enclosure"] = nlohmann::ordered_json::object();
      for (std::size_t i = 0; i < cycle.state.size(); ++i) {
        const auto [least, most] = decimal_ends(cycle.state[i]);
        one["enclosure"][cycle.names[i]] = {least, most};
      }
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
  for (std::size_t k = 0; k < report.checked.size(); ++k) {
    const CheckedCycle& cycle = report.checked[k];
    if (!cycle.holds()) {
      fmt::print("  {:>3}  not proved: {}\n", k + 1, cycle.reason);
      continue;
    }
    const auto [low, high] = decimal_ends(cycle.period, 13);
    fmt::print("  {:>3}  proved: one orbit with a period in [{}, {}] through\n", k + 1, low, high);
    for (std::size_t i = 0; i < cycle.state.size(); ++i) {
      const auto [least, most] = decimal_ends(cycle.state[i], 13);
      fmt::print("       {:<10} [{}, {}]\n", cycle.names[i], least, most);
    }
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
    json["level"] = nlohmann::ordered_json::object();
    for (std::size_t a = 0; a < checked.levels.size(); ++a) {
      const auto [low, high] = decimal_ends(checked.levels[a]);
      json["level"][checked.level_names[a]] = {low, high};
    }
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
  std::istringstream lines(certificate.equations);
  for (std::string line; std::getline(lines, line);)
    if (!line.empty()) fmt::print("    {}\n", printable(line, 400));
  fmt::print("  returns to {} = 0, upwards\n", printable(certificate.plane, 400));
  for (std::size_t a = 0; a < checked.levels.size(); ++a) {
    const auto [low, high] = decimal_ends(checked.levels[a]);
    fmt::print("  {:<10} [{}, {}]\n", checked.level_names[a], low, high);
  }
  fmt::print(
      "  proved: the first return map has an orbit for every path of the graph of the coverings; "
      "its\n  topological entropy is at least {}\n",
      decimal_below(checked.entropy));
}

}  // namespace casimir::tools
