#include "tools/analysis/sweep/lyapunov.hpp"

#include <cmath>
#include <limits>

#include "tools/analysis/sweep/deviations.hpp"

namespace casimir {
namespace {

/// After each such part of the time the deviation is made small again.
constexpr int kPartsOfRun = 256;
constexpr double kNoExponent = std::numeric_limits<double>::quiet_NaN();

}  // namespace

LyapunovExponents::LyapunovExponents(const Model& model, const Scene& scene,
                                     const PreparedScene& run, const GridPoints& places,
                                     const Method& method, const Settings& settings)
    : places_(places),
      method_(deviation_method(run, method)),
      settings_(settings),
      rates_(run.specialisation.rhs),
      deviating_(with_deviation(model, scene, run)) {}

std::vector<std::string> LyapunovExponents::columns() const {
  return {"t", "exponent", "exponent_half", "steps"};
}

std::string LyapunovExponents::reason(Status status) const { return reason_of_deviations(status); }

std::string LyapunovExponents::fingerprint() const {
  return "exponents " + run_fingerprint(deviating_, method_, settings_);
}

PointResult LyapunovExponents::follow(const Module& module, Saltation& saltation, std::size_t point,
                                      const std::function<bool()>& give_up) const {
  const auto [start, parameters] = places_.at(point);
  const std::size_t n = start.size();
  std::vector<double> state = deviating_.initial;
  std::copy(start.begin(), start.end(), state.begin());
  Settings settings = settings_;
  settings.duration /= kPartsOfRun;
  settings.monitor = false;
  settings.give_up = give_up;
  saltation.begin();
  settings.after_step = saltation.hook(parameters, state.size());
  double growth = 0, half = kNoExponent, time = 0, steps = 0;
  for (int part = 0; part < kPartsOfRun; ++part) {
    const Trajectory piece = integrate(module, method_, settings, state, parameters);
    time += piece.time;
    steps += static_cast<double>(piece.steps);
    if (piece.status != Status::ok) return {piece.status, {time, kNoExponent, kNoExponent, steps}};
    state = piece.state;
    double size = 0;
    for (std::size_t i = n; i < state.size(); ++i) size = std::hypot(size, state[i]);
    if (!(size > 0) || !std::isfinite(size))
      return {Status::non_finite, {time, kNoExponent, kNoExponent, steps}};
    growth += std::log(size);
    for (std::size_t i = n; i < state.size(); ++i) state[i] /= size;
    if (2 * (part + 1) == kPartsOfRun) half = growth / std::abs(time);
  }
  // A motion that is followed back in time is chaotic where its deviations grow all the same.
  return {Status::ok, {settings_.duration, growth / std::abs(settings_.duration), half, steps}};
}

std::vector<PointResult> LyapunovExponents::run(const std::vector<std::size_t>& points, int threads,
                                                const std::function<bool()>& give_up) const {
  std::vector<Saltation> saltations(threads_for(points, threads), Saltation(rates_));
  return each_with_module(deviating_, method_, points, threads, give_up,
                          {Status::stopped, {kNoExponent, kNoExponent, kNoExponent, kNoExponent}},
                          [&](const Module& module, std::size_t thread, std::size_t point) {
                            return follow(module, saltations[thread], point, give_up);
                          });
}

}  // namespace casimir
