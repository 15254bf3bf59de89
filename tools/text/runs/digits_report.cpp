// casimir integrate --digits: what a multiprecision run says.
#include "tools/text/runs/digits_report.hpp"

#include <cln/integer_io.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "runtime/evaluate.hpp"
#include "runtime/program/term_size.hpp"
#include "tools/show/notation.hpp"
#include "tools/tables/table.hpp"
#include "tools/text/files/generated_report.hpp"
#include "tools/text/runs/run_report.hpp"

namespace casimir::tools {
namespace {

using Json = nlohmann::ordered_json;

/// The digits of round(|x| 10^shift).
std::string scaled_digits(const cln::cl_RA& x, long shift) {
  const cln::cl_I power = cln::expt_pos(cln::cl_I(10), cln::cl_I(std::max(std::abs(shift), 1L)));
  const cln::cl_RA scaled = shift > 0   ? cln::cl_RA(cln::abs(x) * power)
                            : shift < 0 ? cln::cl_RA(cln::abs(x) / power)
                                        : cln::abs(x);
  std::ostringstream text;
  text << cln::round1(scaled);
  return text.str();
}

/// Mantissa digits and a decimal exponent in the style of printf's %g.
std::string laid_out(std::string digits, long exponent, long most) {
  digits.erase(std::max<std::size_t>(digits.find_last_not_of('0') + 1, 1));
  if (exponent < -5 || exponent >= most) {
    if (digits.size() > 1) digits.insert(1, ".");
    return fmt::format("{}e{}{:02}", digits, exponent < 0 ? '-' : '+', std::abs(exponent));
  }
  if (exponent < 0)
    return "0." + std::string(static_cast<std::size_t>(-exponent - 1), '0') + digits;
  const auto whole = static_cast<std::size_t>(exponent) + 1;
  if (digits.size() <= whole) return digits + std::string(whole - digits.size(), '0');
  return digits.insert(whole, ".");
}

/// A power of ten of any size: "3.2e-61".
std::string power_text(double log10_value) {
  const double whole = std::floor(log10_value);
  return fmt::format("{:.1f}e{:+03}", std::pow(10., log10_value - whole), static_cast<long>(whole));
}

/// The digits of `value` in which the check agrees; "0" if there are none.
std::string sure_text(const cln::cl_F& value, const cln::cl_F& check, int most) {
  const int digits = agreed_digits(check, value, most);
  return digits == 0 ? "0" : decimal_text(value, digits);
}

std::vector<std::string> sure_texts(const std::vector<cln::cl_F>& values,
                                    const std::vector<cln::cl_F>* check, int most) {
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < values.size(); ++i)
    texts.push_back(check ? sure_text(values[i], (*check)[i], most)
                          : decimal_text(values[i], most));
  return texts;
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
  if (std::isfinite(size)) scale = cln::max(scale, cln::cl_float(cln::cl_DF(size), scale));
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

std::string decimal_text(const cln::cl_F& value, int digits) {
  if (cln::zerop(value)) return "0";
  const cln::cl_RA x = cln::rational(value);
  const cln::decoded_float parts = cln::decode_float(value);
  constexpr double kLog10Of2 = 0.30102999566398120;
  auto exponent = static_cast<long>(
      std::floor(kLog10Of2 * static_cast<double>(cln::cl_I_to_long(parts.exponent)) +
                 std::log10(cln::double_approx(parts.mantissa))));
  std::string text = scaled_digits(x, digits - 1 - exponent);
  // The logarithm may be off beside a power of ten, and rounding may reach one.
  for (; static_cast<int>(text.size()) > digits; text = scaled_digits(x, digits - 1 - exponent))
    ++exponent;
  for (; static_cast<int>(text.size()) < digits; text = scaled_digits(x, digits - 1 - exponent))
    --exponent;
  return (cln::minusp(value) ? "-" : "") + laid_out(text, exponent, digits);
}

Status DigitsReport::status() const {
  const bool short_of_digits = agreed.run.status == Status::ok && agreed.digits < digits;
  return short_of_digits ? Status::no_convergence : agreed.run.status;
}

std::string DigitsReport::reason() const {
  if (status() != Status::no_convergence) return agreed.run.reason;
  return fmt::format("runs with {} and {} digits agree in {} of the {} digits asked for only",
                     agreed.check.digits, agreed.run.digits, agreed.digits, digits);
}

std::string DigitsReport::advice() const {
  if (status() == Status::no_convergence)
    return "the digits shown are right; a shorter --duration leaves more of them";
  return tools::advice(status());
}

std::string DigitsReport::stop_time() const {
  const auto &time = agreed.run.singular_time, &check = agreed.check.singular_time;
  if (!time) return decimal_text(agreed.run.time, digits);
  return check ? sure_text(*time, *check, digits) : decimal_text(*time, digits);
}

std::vector<std::string> DigitsReport::warnings() const {
  std::vector<std::string> warnings;
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
