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

/// Digits that are shown beyond those asked for, where an interval is as narrow.
constexpr long kMore = 8;

cln::cl_RA power_of_ten(long exponent) {
  if (exponent == 0) return 1;
  const cln::cl_I power = cln::expt_pos(cln::cl_I(10), cln::cl_I(std::abs(exponent)));
  return exponent > 0 ? cln::cl_RA(power) : 1 / cln::cl_RA(power);
}

/// The largest e with 10^e <= x, for x > 0.
long decimal_exponent(const cln::cl_RA& x) {
  const long bits = static_cast<long>(cln::integer_length(cln::numerator(x))) -
                    static_cast<long>(cln::integer_length(cln::denominator(x)));
  auto e = static_cast<long>(std::floor(0.30102999566398120 * static_cast<double>(bits)));
  while (power_of_ten(e) > x) --e;
  while (power_of_ten(e + 1) <= x) ++e;
  return e;
}

/// digits * 10^exponent, as %g would show it.
std::string decimal_text(const cln::cl_I& digits, long exponent) {
  if (cln::zerop(digits)) return "0";
  std::ostringstream stream;
  stream << (cln::minusp(digits) ? cln::cl_I(-digits) : digits);
  std::string text = stream.str();
  while (text.size() > 1 && text.back() == '0') {
    text.pop_back();
    ++exponent;
  }
  const long leading = exponent + static_cast<long>(text.size()) - 1;
  const std::string sign = cln::minusp(digits) ? "-" : "";
  if (leading < -5 || leading > 20) {
    if (text.size() > 1) text.insert(1, ".");
    return fmt::format("{}{}e{}{:02}", sign, text, leading < 0 ? '-' : '+', std::abs(leading));
  }
  if (leading < 0)
    return sign + "0." + std::string(static_cast<std::size_t>(-leading - 1), '0') + text;
  if (exponent >= 0) return sign + text + std::string(static_cast<std::size_t>(exponent), '0');
  return sign + text.insert(static_cast<std::size_t>(leading) + 1, ".");
}

std::string rounded_down(const cln::cl_RA& value, long exponent) {
  return decimal_text(cln::floor1(value / power_of_ten(exponent)), exponent);
}
std::string rounded_up(const cln::cl_RA& value, long exponent) {
  return decimal_text(cln::ceiling1(value / power_of_ten(exponent)), exponent);
}

int least_digits(const EnclosureReport& report) { return std::max(17, report.digits.value_or(0)); }

cln::cl_RA radius_of(const StateBox& box) {
  cln::cl_RA largest = 0;
  for (const RationalInterval& x : box.states)
    largest = std::max(largest, cln::cl_RA((x.high - x.low) / 2));
  return largest;
}

/// The middle of an interval, to as many digits as it is known to.
std::string middle_text(const RationalInterval& x, int digits) {
  const cln::cl_RA middle = (x.low + x.high) / 2;
  if (cln::zerop(middle)) return "0";
  const long exponent = decimal_exponent(cln::abs(middle)) - digits + 1;
  return decimal_text(cln::round1(middle / power_of_ten(exponent)), exponent);
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

std::pair<std::string, std::string> decimal_ends(const RationalInterval& interval, int least) {
  const cln::cl_RA width = interval.high - interval.low;
  const cln::cl_RA size = std::max(cln::abs(interval.low), cln::abs(interval.high));
  if (cln::zerop(size)) return {"0", "0"};
  // Not finer than some digits more than those asked for, though the interval may be.
  long exponent = decimal_exponent(size) - least + 1;
  if (cln::plusp(width)) exponent = std::max(exponent - kMore, decimal_exponent(width) - 2);
  return {rounded_down(interval.low, exponent), rounded_up(interval.high, exponent)};
}

std::string decimal_above(const cln::cl_RA& value) {
  if (cln::zerop(value)) return "0";
  return rounded_up(value, decimal_exponent(value) - 2);
}

std::string power_of_ten_above(const cln::cl_RA& value) {
  if (cln::zerop(value)) return "0";
  const long below = decimal_exponent(value);
  return fmt::format("1e{:+03}", power_of_ten(below) == value ? below : below + 1);
}

std::string EnclosureReport::time() const {
  const cln::cl_RA& t = motion.run.end.time;
  if (cln::zerop(t)) return "0";
  const long exponent = decimal_exponent(cln::abs(t)) - std::max(17, digits.value_or(0)) + 1;
  return decimal_text(cln::truncate1(t / power_of_ten(exponent)), exponent);
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
