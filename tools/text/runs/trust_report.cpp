#include "tools/text/runs/trust_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

#include "tools/analysis/proof/exact_text.hpp"
#include "tools/text/runs/run_report.hpp"

namespace casimir::tools {
namespace {

/// Estimated errors that the user is warned of.
constexpr double kDoubtful = 1e-4;

std::string six_digits(const ErrorEstimate& trust) {
  if (!trust.six_digits_until) return "";
  return fmt::format(", and six digits hold until t = {:.6g}", *trust.six_digits_until);
}

std::vector<std::string> warnings_of_end(const ErrorEstimate& trust, bool constant_step) {
  std::vector<std::string> warnings;
  if (trust.unconfirmed)
    warnings.push_back(fmt::format(
        "a run with {}, or one by Taylor series, does not reach the end or would take too long: "
        "nothing confirms this one",
        constant_step ? "half the step" : "a hundredth of the tolerance"));
  if (!trust.known) {
    warnings.push_back(
        "how much small changes grow is not known: the variational equations could not be "
        "integrated along this run");
  } else if (trust.died_out()) {
    warnings.push_back(fmt::format(
        "on the way small changes grow {:.0e} times, beyond what double precision can hold, though "
        "they have died out at the end{}: which way the motion took is decided by rounding",
        trust.on_the_way, six_digits(trust)));
  } else if (trust.beyond_double) {
    warnings.push_back(fmt::format(
        "the end state is beyond what double precision can hold: small changes of the initial "
        "state grow {:.0e} times{}; --digits {} can hold it",
        trust.conditioning, six_digits(trust),
        static_cast<int>(20 + std::log10(trust.conditioning))));
  }
  if (trust.one_of_several) {
    warnings.push_back(fmt::format(
        "at t = {:.6g} the argument of a root comes to zero, where the equations are not Lipschitz "
        "continuous: more than one solution may go on from there, and this is one of them",
        *trust.one_of_several));
  } else if (trust.parted) {
    warnings.push_back(fmt::format(
        "on the way a run with {} is {:.0e} of the size of the state away from this one, though "
        "both end in the same place: which way the motion took is decided by the errors of the "
        "steps; --digits 30 may follow it",
        constant_step ? "half the step" : "a tighter tolerance", *trust.parted));
  } else if (!trust.beyond_double && !trust.unconfirmed && !(trust.error_estimate < kDoubtful)) {
    const bool by_rounding = trust.input_rounding > trust.error_estimate / 2;
    warnings.push_back(
        fmt::format("the end state may be off by {:.0e} of its size{}", trust.error_estimate,
                    trust.overflow > trust.error_estimate / 2
                        ? ": a number in the equations is beyond all doubles"
                    : by_rounding   ? ", since the numbers of the scene have to be "
                                      "rounded to double: --digits 30 keeps more of them"
                    : constant_step ? ": take a smaller --step"
                                    : ": tighten --tolerance"));
  }
  return warnings;
}

std::optional<std::string> warning_of_samples(const ErrorEstimate& trust) {
  constexpr double kMuchMore = 10, kRounding = 1e-14;
  if (!trust.samples_error || trust.unconfirmed ||
      !(*trust.samples_error > kMuchMore * std::max(trust.error_estimate, kRounding)))
    return std::nullopt;
  return fmt::format(
      "the samples may be off by {:.0e} of the sizes of the states, which is more than the end is",
      *trust.samples_error);
}

}  // namespace

nlohmann::ordered_json to_json(const ErrorEstimate& trust) {
  nlohmann::ordered_json json = {{"conditioning", nullptr},
                                 {"input_rounding", nullptr},
                                 {"error_estimate", nullptr},
                                 {"beyond_double", nullptr}};
  if (!trust.known) return json;
  json["conditioning"] = exact_text(trust.conditioning);
  json["input_rounding"] = exact_text(trust.input_rounding);
  json["beyond_double"] = trust.beyond_double;
  if (trust.on_the_way > 2 * trust.conditioning)
    json["conditioning_on_the_way"] = exact_text(trust.on_the_way);
  if (!trust.unconfirmed) json["error_estimate"] = exact_text(trust.error_estimate);
  if (trust.six_digits_until) json["six_digits_until"] = exact_text(*trust.six_digits_until);
  if (trust.samples_error) json["samples_error"] = exact_text(*trust.samples_error);
  if (trust.followed) json["extrapolated_from"] = exact_text(*trust.followed);
  return json;
}

std::vector<std::string> warnings_of(const ErrorEstimate& trust, bool constant_step) {
  std::vector<std::string> warnings = warnings_of_end(trust, constant_step);
  if (auto of_samples = warning_of_samples(trust)) warnings.push_back(std::move(*of_samples));
  return warnings;
}

RunWords words_of(const AssessedRun& judged, bool interrupted) {
  RunWords words{.warnings = judged.doubts, .advice = {}, .interrupted = interrupted};
  const Trajectory& trajectory = judged.trajectory;
  std::vector<std::string> of_end;
  if (judged.unestimated) of_end.push_back(*judged.unestimated);
  for (std::string& warning : warnings_of_end(judged.trust, judged.settings.fixed_step > 0))
    of_end.push_back(std::move(warning));
  if (trajectory.status == Status::ok && judged.near_singular)
    of_end.push_back(*judged.near_singular);
  words.end_in_doubt = !of_end.empty();
  std::ranges::move(of_end, std::back_inserter(words.warnings));
  if (auto of_samples = warning_of_samples(judged.trust))
    words.warnings.push_back(std::move(*of_samples));
  if (trajectory.status == Status::ok) return words;
  words.advice = trajectory.status == Status::at_jump ? advice(trajectory.status)
                 : judged.near_singular               ? *judged.near_singular
                 : trajectory.stiff ? fmt::format("--method {}, or auto", kStiffMethod)
                 : interrupted      ? "the run was interrupted: begin it again"
                                    : advice(trajectory.status);
  return words;
}

}  // namespace casimir::tools
