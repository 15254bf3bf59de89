// casimir integrate --digits: what a multiprecision run says.
#include "tools/text/runs/digits_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "runtime/evaluate.hpp"
#include "runtime/program/exact_number.hpp"
#include "runtime/program/term_size.hpp"
#include "tools/show/notation.hpp"
#include "tools/tables/table.hpp"
#include "tools/text/files/generated_report.hpp"
#include "tools/text/runs/run_report.hpp"
#include "tools/text/runs/sure_decimals.hpp"

namespace casimir::tools {
namespace {

using Json = nlohmann::ordered_json;

/// A power of ten of any size: "3.2e-61".
std::string power_text(double log10_value) {
  const double whole = std::floor(log10_value);
  return fmt::format("{:.1f}e{:+03}", std::pow(10., log10_value - whole), static_cast<long>(whole));
}

/// The sizes of the largest terms of each invariant at the end, as far as doubles reach.
std::vector<double> term_sizes(const DigitsReport& report) {
  using Sized = Arithmetic<SizedNumber>;
  std::vector<SizedNumber> inputs;
  for (const cln::cl_F& x : report.agreed.run.state)
    inputs.push_back(Sized::from(cln::rational(x)));
  inputs.push_back(Sized::from(cln::rational(report.agreed.run.time)));
  if (inputs.size() != report.spec.invariants.inputs.size())
    return std::vector<double>(report.spec.invariant_names.size());
  std::vector<double> sizes;
  for (const SizedNumber& value : evaluate(report.spec.invariants, inputs))
    sizes.push_back(static_cast<double>(std::abs(value.size)));
  return sizes;
}

/// The largest change relative to the first value, or to the terms of a value that is small.
std::string drift_text(const PreciseInvariant& invariant, double size) {
  if (cln::zerop(invariant.change)) return "0";
  cln::cl_F scale = cln::abs(invariant.initial);
  if (std::isfinite(size)) scale = cln::max(scale, cln::cl_float(exact_number(size), scale));
  if (cln::zerop(scale)) return decimal_text(invariant.change, 2);
  return decimal_text(invariant.change / scale, 2);
}

/// Initial value, final value and drift of each invariant.
struct InvariantTexts {
  std::string initial, final, drift;
};
std::vector<InvariantTexts> invariant_texts(const DigitsReport& report) {
  const AgreedRun& agreed = report.agreed;
  const std::vector<double> sizes = term_sizes(report);
  std::vector<InvariantTexts> texts;
  for (std::size_t i = 0; i < agreed.run.invariants.size(); ++i) {
    const PreciseInvariant& one = agreed.run.invariants[i];
    const PreciseInvariant& other = agreed.checked ? agreed.check.invariants[i] : one;
    texts.push_back({sure_text(one.initial, other.initial, report.digits),
                     sure_text(one.final, other.final, report.digits), drift_text(one, sizes[i])});
  }
  return texts;
}

Json trust_json(const DigitsReport& report) {
  const AgreedRun& agreed = report.agreed;
  // What is read is exact, and nothing of it is held in doubles.
  Json trust = {{"conditioning", nullptr}, {"input_rounding", "0"}, {"error_estimate", nullptr},
                {"beyond_double", false},  {"digits", nullptr},     {"digits_lost", nullptr},
                {"checked_by", nullptr},   {"runs", agreed.runs}};
  if (!agreed.checked) return trust;
  trust["error_estimate"] = power_text(agreed.log10_error);
  trust["digits"] = agreed.digits;
  trust["digits_lost"] = agreed.lost;
  trust["checked_by"] = {agreed.check.digits, agreed.run.digits};
  return trust;
}

}  // namespace

Status DigitsReport::status() const {
  const bool short_of_digits = agreed.run.status == Status::ok && agreed.digits < digits;
  return short_of_digits ? Status::no_convergence : agreed.run.status;
}

std::string DigitsReport::reason() const {
  if (agreed.run.status != Status::ok) return agreed.run.reason;
  if (status() == Status::ok) return {};
  return fmt::format("runs with {} and {} digits agree in {} of the {} digits asked for only",
                     agreed.check.digits, agreed.run.digits, agreed.digits, digits);
}

std::string DigitsReport::advice() const {
  if (status() == Status::no_convergence && agreed.digits == 0)
    return "nothing is known of the state there; a shorter --duration may leave digits";
  if (status() == Status::no_convergence)
    return fmt::format("{} digits are right; a shorter --duration leaves more of them",
                       agreed.digits);
  return tools::advice(status());
}

std::string DigitsReport::stop_time() const {
  const auto &time = agreed.run.singular_time, &check = agreed.check.singular_time;
  if (!time) return decimal_text(agreed.run.time, digits);
  return check ? sure_text(*time, *check, digits) : decimal_text(*time, digits);
}

std::vector<std::string> DigitsReport::warnings() const {
  std::vector<std::string> warnings;
  if (!doubt.empty()) warnings.push_back(doubt);
  if (!agreed.checked) {
    warnings.emplace_back("no second run has checked these digits");
  } else if (agreed.digits < digits) {
    warnings.push_back(fmt::format("{} of {} digits are sure", agreed.digits, digits));
  }
  return warnings;
}

std::vector<std::string> DigitsReport::state() const {
  return sure_texts(agreed.run.state, agreed.checked ? &agreed.check.state : nullptr, digits);
}

Json to_json(const DigitsReport& report) {
  const AgreedRun& agreed = report.agreed;
  const Specialisation& s = report.spec;
  const double tolerance = std::pow(10., -report.digits);
  Json json = {{"case", s.case_name},
               {"scene", s.scene},
               {"method", "taylor"},
               {"digits", report.digits},
               {"tolerance", tolerance},
               {"rtol", tolerance},
               {"atol", 0.},
               {"status", to_string(report.status())},
               {"t", decimal_text(agreed.run.time, report.digits)}};
  json["state"] = Json::object();
  const std::vector<std::string> state = report.state();
  for (std::size_t i = 0; i < state.size(); ++i) json["state"][s.states[i]] = state[i];
  json["invariants"] = Json::object();
  const std::vector<InvariantTexts> invariants = invariant_texts(report);
  for (std::size_t i = 0; i < invariants.size(); ++i) {
    json["invariants"][s.invariant_names[i]] = {{"initial", invariants[i].initial},
                                                {"final", invariants[i].final},
                                                {"drift", invariants[i].drift}};
  }
  json["steps"] = agreed.run.steps;
  json["rejected"] = 0;
  json["evaluations"] = agreed.run.steps;
  json["seconds"] = {
      {"generate", report.generate_seconds}, {"compile", 0.}, {"integrate", report.seconds}};
  json["from_cache"] = false;
  json["left_out"] = left_out_json(s);
  json["warnings"] = report.warnings();
  json["trust"] = trust_json(report);
  if (report.status() != Status::ok) {
    json["stopped"] = {
        {"time", report.stop_time()}, {"reason", report.reason()}, {"advice", report.advice()}};
  }
  return json;
}

void print_text(const DigitsReport& report) {
  const AgreedRun& agreed = report.agreed;
  const Specialisation& s = report.spec;
  fmt::print("{}, scene '{}', taylor with {} digits\n", s.case_name, printable(s.scene),
             report.digits);
  fmt::print("  generated in {}, integrated in {}: {} steps in the last of {} runs\n",
             duration_text(report.generate_seconds), duration_text(report.seconds),
             agreed.run.steps, agreed.runs);
  fmt::print("  t = {}\n", decimal_text(agreed.run.time, report.digits));
  const std::vector<std::string> state = report.state();
  for (std::size_t i = 0; i < state.size(); ++i) fmt::print("  {:<10} {}\n", s.states[i], state[i]);
  const std::vector<InvariantTexts> invariants = invariant_texts(report);
  for (std::size_t i = 0; i < invariants.size(); ++i) {
    fmt::print("  {:<10} {}   drift {}\n", s.invariant_names[i], invariants[i].final,
               invariants[i].drift);
  }
  for (const LeftOut& item : s.left_out)
    fmt::print("  left out: {} {}, {}\n", item.kind, item.name, item.reason);
  if (agreed.checked) {
    fmt::print("  checked: runs with {} and {} digits differ by {}; the motion costs {} digits\n",
               agreed.check.digits, agreed.run.digits, power_text(agreed.log10_error), agreed.lost);
  }
}

void write_samples(const std::string& path, const DigitsReport& report) {
  const AgreedRun& agreed = report.agreed;
  const std::size_t checked = agreed.checked ? agreed.check.samples.size() : 0;
  const std::vector<std::string>& states = report.spec.states;
  std::vector<std::string> times;
  std::vector<std::vector<std::string>> columns(states.size());
  for (std::size_t k = 0; k < agreed.run.samples.size(); ++k) {
    const bool same_time =
        k < checked && agreed_digits(agreed.check.sample_times[k], agreed.run.sample_times[k],
                                     report.digits) == report.digits;
    times.push_back(decimal_text(agreed.run.sample_times[k], report.digits));
    const auto texts = sure_texts(agreed.run.samples[k],
                                  same_time ? &agreed.check.samples[k] : nullptr, report.digits);
    for (std::size_t i = 0; i < states.size(); ++i) columns[i].push_back(texts[i]);
  }
  Table table{{{"t", std::move(times)}},
              {{"case", report.spec.case_name}, {"scene", report.spec.scene}}};
  for (std::size_t i = 0; i < states.size(); ++i)
    table.columns.push_back({states[i], std::move(columns[i])});
  write_table(path, table);
}

}  // namespace casimir::tools
