#include "tests/traps/judge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

namespace casimir::traps {
namespace {

using Json = nlohmann::ordered_json;

/// An error is not silent up to so many times the estimate, and below what nobody minds, and what
/// a tolerance as loose as this asks for.
constexpr double kMargin = 10, kUnminded = 1e-9, kOfTolerance = 100;
/// An estimate from here on claims no digit. Below, a warning does not excuse so many times of it.
constexpr double kNoDigits = 0.1, kUnderstated = 1000;
/// How near to the end of the solution a run has to get.
constexpr Real kNear = 1e-3L;
/// A state that has become small is measured against this part of the largest.
constexpr Real kSmallestPart = 1e-3L;

Real number(const Json& text) { return std::strtold(text.get<std::string>().c_str(), nullptr); }

/// The sizes that errors are relative to: of both ends, or on the way where that is less.
std::vector<Real> sizes_of(const Scene& scene, const Truth& truth) {
  std::vector<Real> sizes;
  for (std::size_t i = 0; i < truth.state.size(); ++i)
    sizes.push_back(std::max(std::abs(constant(scene.initial[i])), std::abs(truth.state[i])));
  const Real largest = *std::ranges::max_element(sizes);
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    sizes[i] = std::max(sizes[i], kSmallestPart * largest);
    if (!truth.sizes.empty()) sizes[i] = std::min(sizes[i], truth.sizes[i]);
    if (!(sizes[i] > 0)) sizes[i] = largest > 0 ? largest : 1;
  }
  return sizes;
}

Real error_of(const Scene& scene, const Truth& truth, const Json& state) {
  const std::vector<Real> sizes = sizes_of(scene, truth);
  Real error = 0;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const Real off = std::abs(number(state.at(scene.variables[i])) - truth.state[i]) / sizes[i];
    error = off <= error ? error : off;  // no number is the largest error
  }
  return error;
}

std::string first_warning(const Json& json) {
  const Json& warnings = json.at("warnings");
  return warnings.empty() ? "" : warnings.front().get<std::string>();
}

Verdict of_refusal(const Scene& scene, const Json& json) {
  const Json& stopped = json.at("stopped");
  const Real time = number(stopped.at("time"));
  Verdict v;
  v.outcome = Outcome::refused;
  v.what = fmt::format("t = {:.6g}: {}", static_cast<double>(time),
                       stopped.at("reason").get<std::string>());
  if (scene.singular_at && std::abs(time - *scene.singular_at) <= kNear * *scene.singular_at)
    v.outcome = Outcome::right;
  return v;
}

Verdict of_answer(const Scene& scene, const std::optional<Truth>& truth, const Json& json) {
  Verdict v;
  const std::string warning = first_warning(json);
  const Json& estimate = json.at("trust").at("error_estimate");
  v.estimate = estimate.is_null() ? 0 : static_cast<double>(number(estimate));
  v.what = warning.empty() ? "no warning" : warning;
  if (scene.singular_at) {
    v.error = 1;
    v.what += fmt::format(", and the solution ends at t = {:.6g}",
                          static_cast<double>(*scene.singular_at));
    v.outcome = warning.empty() ? Outcome::silent : Outcome::warned;
    return v;
  }
  if (!truth) return v;
  v.error = error_of(scene, *truth, json.at("state"));
  // What a warning goes with is right only where nobody minds the error.
  const double unminded = std::max(kUnminded, kOfTolerance * json.at("tolerance").get<double>());
  if (warning.empty())
    v.outcome =
        v.error <= std::max(kMargin * v.estimate, unminded) ? Outcome::right : Outcome::silent;
  else if (v.error <= unminded)
    v.outcome = Outcome::cautious;
  else
    v.outcome = v.estimate > 0 && v.estimate < kNoDigits && v.error > kUnderstated * v.estimate
                    ? Outcome::understated
                    : Outcome::warned;
  return v;
}

Verdict of_words(const Scene& scene, const std::optional<Truth>& truth, const Said& said) {
  constexpr int kDone = 0, kEnvironment = 4, kNotContinued = 5;
  const Json json = Json::parse(said.out, nullptr, false);
  const bool known = json.is_object() && !json.contains("error");
  if (known && said.status == kDone) return of_answer(scene, truth, json);
  if (known && said.status == kNotContinued) return of_refusal(scene, json);
  Verdict v;
  v.outcome = said.status == kEnvironment ? Outcome::refused : Outcome::broken;
  v.what = fmt::format("exit status {}: {}", said.status, said.err.substr(0, 200));
  return v;
}

}  // namespace

std::string to_string(Outcome outcome) {
  constexpr std::array<const char*, kOutcomes> names = {"right",       "cautious", "warned",
                                                        "understated", "refused",  "silent",
                                                        "hang",        "broken",   "dropped"};
  return names[static_cast<std::size_t>(outcome)];
}

bool is_failure(Outcome outcome) {
  return outcome == Outcome::silent || outcome == Outcome::hang || outcome == Outcome::broken;
}

Verdict judge(const Scene& scene, const std::optional<Truth>& truth, const Said& said) {
  if (!said.in_time) {
    Verdict v;
    v.outcome = Outcome::hang;
    v.what = "no answer in time";
    return v;
  }
  return of_words(scene, truth, said);
}

}  // namespace casimir::traps
