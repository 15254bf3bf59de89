// casimir integrate --validated: what an enclosure says.
#include "tools/text/runs/enclosure_report.hpp"

#include <cln/integer.h>
#include <cln/integer_io.h>
#include <cln/rational.h>
#include <cln/real.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "tools/tables/table.hpp"
#include "tools/text/files/generated_report.hpp"
#include "tools/text/runs/run_report.hpp"

namespace casimir::tools {
namespace {

using Json = nlohmann::ordered_json;

int least_digits(const EnclosureReport& report) { return std::max(17, report.digits.value_or(0)); }

cln::cl_RA radius_of(const StateBox& box) {
  cln::cl_RA largest = 0;
  for (const RationalInterval& x : box.states)
    largest = std::max(largest, cln::cl_RA((x.high - x.low) / 2));
  return largest;
}

std::string status_of(ValidatedStatus status) {
  switch (status) {
    case ValidatedStatus::ok:
      return "ok";
    case ValidatedStatus::max_steps:
      return "max_steps";
    case ValidatedStatus::stopped:
      return "stopped";
    default:
      return "not_enclosed";
  }
}

Json enclosure_json(const EnclosureReport& report) {
  Json json = Json::object();
  for (std::size_t i = 0; i < report.motion.names.size(); ++i) {
    const auto [low, high] = decimal_ends(report.motion.run.end.states[i], least_digits(report));
    json[report.motion.names[i]] = {low, high};
  }
  return json;
}

}  // namespace

std::string EnclosureReport::time() const {
  return decimal_towards_zero(motion.run.end.time, std::max(17, digits.value_or(0)));
}

std::string EnclosureReport::advice() const {
  switch (motion.run.status) {
    case ValidatedStatus::max_steps:
      return "--max-steps allows more";
    case ValidatedStatus::stopped:
      return "--time-limit allows more";
    case ValidatedStatus::contradiction:
      return "please report this: a proved integral is not constant";
    default:
      return digits ? "more --digits or a smaller start may reach further, where the solution does"
                    : "--digits may reach further, or a smaller start, where the solution does";
  }
}

Json to_json(const EnclosureReport& report) {
  const ValidatedMotion& motion = report.motion;
  const ValidatedRun& run = motion.run;
  const std::string radius = decimal_above(radius_of(run.end));
  Json json = {{"case", motion.specialisation.case_name},
               {"scene", motion.specialisation.scene},
               {"method", "taylor"}};
  if (report.digits) json["digits"] = *report.digits;
  json["status"] = status_of(run.status);
  json["t"] = report.time();
  json["state"] = Json::object();
  for (std::size_t i = 0; i < motion.names.size(); ++i)
    json["state"][motion.names[i]] = middle_text(run.end.states[i], least_digits(report));
  json["validated"] = {{"radius", radius},
                       {"enclosure", enclosure_json(report)},
                       {"contracted_by", run.contracted_by},
                       {"steps", run.steps}};
  json["steps"] = run.steps;
  json["rejected"] = run.rejected;
  json["seconds"] = {
      {"generate", report.seconds - run.seconds}, {"compile", 0.}, {"integrate", run.seconds}};
  json["left_out"] = left_out_json(motion.specialisation);
  json["warnings"] = motion.doubts;
  json["trust"] = {{"verdict", "proved"},
                   {"conditioning", nullptr},
                   {"input_rounding", "0"},
                   {"error_estimate", radius},
                   {"beyond_double", false}};
  if (run.status != ValidatedStatus::ok)
    json["stopped"] = {
        {"time", report.time()}, {"reason", run.reason}, {"advice", report.advice()}};
  return json;
}

void print_text(const EnclosureReport& report) {
  const ValidatedMotion& motion = report.motion;
  const ValidatedRun& run = motion.run;
  fmt::print("{}, scene '{}', enclosed by Taylor series {}\n", motion.specialisation.case_name,
             printable(motion.specialisation.scene),
             report.digits ? fmt::format("with {} digits", *report.digits) : "in double precision");
  fmt::print("  prepared in {}, enclosed in {}: {} steps, {} rejected\n",
             duration_text(report.seconds - run.seconds), duration_text(run.seconds), run.steps,
             run.rejected);
  if (!run.contracted_by.empty())
    fmt::print("  made smaller by {}, proved to be constant\n", fmt::join(run.contracted_by, ", "));
  fmt::print("  t = {}\n", report.time());
  for (std::size_t i = 0; i < motion.names.size(); ++i) {
    const auto [low, high] = decimal_ends(run.end.states[i], least_digits(report));
    fmt::print("  {:<10} [{}, {}]\n", motion.names[i], low, high);
  }
  fmt::print("  proved: the state is in this box, whose radius is {}\n",
             decimal_above(radius_of(run.end)));
  for (const LeftOut& item : motion.specialisation.left_out)
    fmt::print("  left out: {} {}, {}\n", item.kind, item.name, item.reason);
  for (const std::string& doubt : motion.doubts) fmt::print("  note: {}\n", doubt);
}

void write_boxes(const std::string& path, const EnclosureReport& report) {
  const ValidatedMotion& motion = report.motion;
  std::vector<std::string> times;
  std::vector<std::vector<std::string>> ends(2 * motion.names.size());
  for (const StateBox& box : motion.run.samples) {
    const cln::cl_RA& t = box.time;
    times.push_back(cln::zerop(t) ? "0" : middle_text({t, t}, least_digits(report)));
    for (std::size_t i = 0; i < motion.names.size(); ++i) {
      const auto [low, high] = decimal_ends(box.states[i], least_digits(report));
      ends[2 * i].push_back(low);
      ends[2 * i + 1].push_back(high);
    }
  }
  const Specialisation& s = motion.specialisation;
  Table table{{{"t", std::move(times)}}, {{"case", s.case_name}, {"scene", s.scene}}};
  for (std::size_t i = 0; i < ends.size(); ++i)
    table.columns.push_back(
        {motion.names[i / 2] + (i % 2 == 0 ? "_low" : "_high"), std::move(ends[i])});
  if (motion.run.status != ValidatedStatus::ok)
    table.note = fmt::format("enclosed up to t = {} only: {}", report.time(), motion.run.reason);
  write_table(path, table);
}

}  // namespace casimir::tools
