#include "tools/analysis/sweep/lyapunov.hpp"

#include <fmt/format.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <thread>

#include "codegen/emit_cpp.hpp"
#include "tools/analysis/error.hpp"
#include "tools/analysis/proof/exact_text.hpp"

namespace casimir {
namespace {

/// After each such part of the time the deviation is made small again.
constexpr int kParts = 256;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

}  // namespace

LyapunovExponents::LyapunovExponents(const Model& model, const Scene& scene,
                                     const PreparedScene& run, const GridPoints& places,
                                     const Method& method, const Settings& settings)
    : places_(places),
      // The tables of the method that needs no compiler hold the values of the parameters.
      method_(method.name == "taylor" && !run.parameters.empty() ? *find_method("taylor-compiled")
                                                                 : method),
      settings_(settings),
      deviating_(run) {
  const Specialisation& s = run.specialisation;
  if (s.uses_time) throw RequestError("the equations depend on the time: no exponents");
  SpecialiseOptions what;
  what.keep_parameters = s.parameters;
  what.observe = s.states;
  what.invariants = what.jacobian = false;
  what.variational = true;
  Specialisation& twice = deviating_.specialisation;
  twice = specialise(model, scene, what);
  twice.rhs = twice.variational;
  for (const std::string& name : s.states) twice.states.push_back("delta_" + name);
  // The same direction everywhere, and none that a system is likely to single out.
  double norm = 0;
  std::vector<double> deviation;
  for (std::size_t i = 0; i < s.states.size(); ++i) {
    deviation.push_back(1 + 0.618 * static_cast<double>(i % 3) - 0.27 * static_cast<double>(i));
    norm = std::hypot(norm, deviation.back());
  }
  for (const double d : deviation) deviating_.initial.push_back(d / norm);
  deviating_.rounding.resize(deviating_.initial.size());
}

std::vector<std::string> LyapunovExponents::columns() const {
  return {"t", "exponent", "exponent_half", "steps"};
}

std::string LyapunovExponents::fingerprint() const {
  std::string text = fmt::format("exponents {} {} rtol {} atol {} duration {}\n", method_.name,
                                 CASIMIR_VERSION, exact_text(settings_.rtol),
                                 exact_text(settings_.atol), exact_text(settings_.duration));
  text += emit_module(deviating_.specialisation, {}, false);
  for (const double x : deviating_.initial) text += exact_text(x) + " ";
  for (const double p : deviating_.parameters) text += exact_text(p) + " ";
  return text;
}

PointResult LyapunovExponents::follow(const Module& module, std::size_t point,
                                      const std::function<bool()>& give_up) const {
  const auto [start, parameters] = places_.at(point);
  const std::size_t n = start.size();
  std::vector<double> state = deviating_.initial;
  std::copy(start.begin(), start.end(), state.begin());
  Settings settings = settings_;
  settings.duration /= kParts;
  settings.monitor = false;
  settings.give_up = give_up;
  double growth = 0, half = kNone, time = 0, steps = 0;
  for (int part = 0; part < kParts; ++part) {
    const Trajectory piece = integrate(module, method_, settings, state, parameters);
    time += piece.time;
    steps += static_cast<double>(piece.steps);
    if (piece.status != Status::ok) return {piece.status, {time, kNone, kNone, steps}};
    state = piece.state;
    double size = 0;
    for (std::size_t i = n; i < state.size(); ++i) size = std::hypot(size, state[i]);
    if (!(size > 0) || !std::isfinite(size))
      return {Status::non_finite, {time, kNone, kNone, steps}};
    growth += std::log(size);
    for (std::size_t i = n; i < state.size(); ++i) state[i] /= size;
    if (2 * (part + 1) == kParts) half = growth / time;
  }
  return {Status::ok, {settings_.duration, growth / settings_.duration, half, steps}};
}

std::vector<PointResult> LyapunovExponents::run(const std::vector<std::size_t>& points, int threads,
                                                const std::function<bool()>& give_up) const {
  std::vector<PointResult> results(points.size(), {Status::stopped, {kNone, kNone, kNone, kNone}});
  // Exact numbers are counted without locks: whatever holds any is made in this thread.
  std::vector<CompiledModule> modules;
  const std::size_t workers =
      std::min<std::size_t>(static_cast<std::size_t>(threads), points.size());
  for (std::size_t i = 0; i < workers; ++i) modules.push_back(compile_for(deviating_, method_));
  std::atomic<std::size_t> next = 0;
  std::vector<std::exception_ptr> problems(workers);
  std::vector<std::jthread> pool;
  for (std::size_t i = 0; i < workers; ++i)
    pool.emplace_back([&, i] {
      try {
        for (std::size_t k = next++; k < points.size() && !(give_up && give_up()); k = next++)
          results[k] = follow(modules[i].module, points[k], give_up);
      } catch (...) {
        problems[i] = std::current_exception();
      }
    });
  pool.clear();
  for (const std::exception_ptr& problem : problems) {
    if (!problem) continue;
    try {
      std::rethrow_exception(problem);
    } catch (const std::invalid_argument& said) {
      throw RequestError(said.what());
    }
  }
  return results;
}

}  // namespace casimir
