#include "tools/analysis/run/iterate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <random>

#include "codegen/compile.hpp"
#include "codegen/emit_cpp.hpp"
#include "symbolic/expression/expression_size.hpp"
#include "tools/analysis/estimate/cancelled_parts.hpp"
#include "tools/analysis/run/disturbed_map.hpp"

namespace casimir {
namespace {

using IterationClock = std::chrono::steady_clock;

double elapsed(IterationClock::time_point start) {
  return std::chrono::duration<double>(IterationClock::now() - start).count();
}

/// The map as a field, whose integrals are also those of the levels that the scene begins on.
Model with_integrals_of_level(const MapModel& map, const Scene& scene) {
  Model model = map.as_field();
  GiNaC::exmap start;
  for (std::size_t i = 0; i < model.variables.size(); ++i)
    start[model.variables[i]] = scene.initial.at(i);
  const auto vanishes = [&](const NamedExpression& f) {
    return substituted(model.at_parameters(f.value, scene), start, model.limits).expand().is_zero();
  };
  for (const LevelClaim& claim : map.base.conditionals)
    if (std::ranges::all_of(claim.on, vanishes)) model.integrals.push_back(claim.expression);
  return model;
}

/// How far the invariants have moved.
class Drift {
 public:
  Drift(const PreparedScene& run, const std::vector<double>& state)
      : terms_(run.invariant_terms()), size_(run.specialisation.invariant_names.size()) {
    initial_ = values(state);
  }

  void look(const std::vector<double>& state, std::vector<Iterated::Invariant>& invariants) {
    const std::vector<long double> now = values(state);
    for (std::size_t i = 0; i < size_; ++i) {
      const long double scale = std::max(std::abs(initial_[i]), sizes_[i]);
      const long double drift = scale > 0 ? std::abs(now[i] - initial_[i]) / scale : 0;
      invariants[i].initial = static_cast<double>(initial_[i]);
      invariants[i].final = static_cast<double>(now[i]);
      // What is not a number is no small drift.
      invariants[i].drift = std::isnan(drift)
                                ? std::numeric_limits<double>::infinity()
                                : std::max(invariants[i].drift, static_cast<double>(drift));
    }
  }

 private:
  std::vector<long double> values(const std::vector<double>& state) {
    std::vector<long double> result(size_);
    sizes_.resize(size_);
    if (size_ > 0) terms_(0, state.data(), result.data(), sizes_.data());
    return result;
  }

  InvariantTerms terms_;
  std::size_t size_;
  std::vector<long double> initial_, sizes_;
};

bool is_finite(const std::vector<double>& x) {
  return std::ranges::all_of(x, [](double value) { return std::isfinite(value); });
}

/// An orbit like that to the state `end`, but with random errors of one unit of the last digit: how
/// far its end is from that, as of Iterated. Of a long orbit the first and the last steps have them
/// in all operations, and some of those between, all along; the others in the state alone.
double distance_of_disturbed(const Module& module, const PreparedScene& run, std::uint64_t steps,
                             const std::vector<double>& end, std::uint64_t seed) {
  const auto& step = module.functions().rhs;
  std::mt19937_64 random(seed);
  std::vector<double> state = run.initial, next(state.size()), largest(state.size());
  constexpr std::uint64_t kMostOperations = 2'000'000;
  DisturbedMap disturbed(run.specialisation.rhs);
  const std::uint64_t in_all_operations =
      kMostOperations / std::max<std::size_t>(1, disturbed.operations());
  const auto disturb = [&] {
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < state.size(); ++i, bits >>= 1) {
      if (i % 64 == 0) bits = random();
      largest[i] = std::max(largest[i], std::abs(state[i]));
      state[i] *= bits % 2 == 0 ? 1 + std::numeric_limits<double>::epsilon()
                                : 1 - std::numeric_limits<double>::epsilon();
    }
  };
  const std::uint64_t stride = steps / std::max<std::uint64_t>(1, in_all_operations) + 1;
  disturb();
  for (std::uint64_t k = 0; k < steps; ++k) {
    if (k < in_all_operations || steps - k <= in_all_operations || k % stride == 0)
      disturbed(state, run.parameters, random, next);
    else
      step(0, state.data(), run.parameters.data(), next.data());
    std::swap(state, next);
    disturb();
  }
  double distance = 0;
  for (std::size_t i = 0; i < state.size(); ++i) {
    const double off = std::abs(state[i] - end[i]);
    if (!std::isfinite(off)) return 1;  // nothing is left of it
    if (off > 0) distance = std::max(distance, off / std::max(largest[i], std::abs(end[i])));
  }
  return distance;
}

std::optional<double> estimated_error(const Module& module, const PreparedScene& run,
                                      const Iterated& orbit) {
  constexpr double kLongest = 1;  // seconds of an orbit that is repeated
  constexpr int kRepeats = 3;
  if (!orbit.finite || orbit.stopped || orbit.seconds > kLongest) return std::nullopt;
  double estimate = 0;
  for (int k = 1; k <= kRepeats; ++k)
    estimate = std::max(estimate, distance_of_disturbed(module, run, orbit.steps, orbit.state,
                                                        static_cast<std::uint64_t>(k)));
  return estimate;
}

}  // namespace

Iterated iterate(const MapModel& map, const Scene& scene, std::uint64_t steps, std::uint64_t every,
                 const std::function<bool()>& give_up, bool with_estimate) {
  const Model model = with_integrals_of_level(map, scene);
  const PreparedScene run = prepare(model, scene);
  Specialisation s = run.specialisation;
  s.has_jacobian = false;
  Iterated result;
  result.names = s.states;
  for (const std::string& name : s.invariant_names) result.invariants.push_back({name});
  result.generate_seconds = run.generate_seconds;
  auto start = IterationClock::now();
  const CompiledObject object = compile(emit_module(s));
  const Module module = loaded([&] { return Module::load(object.path); });
  result.from_cache = object.from_cache;
  result.compile_seconds = elapsed(start);

  constexpr std::uint64_t kLooks = 1000, kChunk = 4096;
  const std::uint64_t look = std::max<std::uint64_t>(1, steps / kLooks);
  result.state = run.initial;
  Drift drift(run, result.state);
  drift.look(result.state, result.invariants);
  if (every > 0) {
    result.sample_steps.push_back(0);
    result.samples.push_back(result.state);
  }
  start = IterationClock::now();
  std::vector<double> next(result.state.size());
  const auto& step = module.functions().rhs;
  CancelledParts parts(model, run, States::apart);
  while (result.steps < steps) {
    // Those that the next state was written with, in terms of this one.
    if (parts.any() && !parts.see(static_cast<double>(result.steps), result.state.data())) {
      result.finite = false;
      result.reason = fmt::format(
          "{}, which the map was written with, has no value; it cancels in what is computed",
          parts.lost_part());
      break;
    }
    step(0, result.state.data(), run.parameters.data(), next.data());
    if (!is_finite(next)) {
      result.finite = false;
      result.reason = "the next state is not finite";
      break;
    }
    std::swap(result.state, next);
    ++result.steps;
    if (every > 0 && result.steps % every == 0) {
      result.sample_steps.push_back(result.steps);
      result.samples.push_back(result.state);
    }
    if (result.steps % look == 0) drift.look(result.state, result.invariants);
    if (result.steps % kChunk == 0 && give_up && give_up()) {
      result.stopped = true;
      break;
    }
  }
  result.seconds = elapsed(start);
  if (every > 0 && result.sample_steps.back() != result.steps) {
    result.sample_steps.push_back(result.steps);
    result.samples.push_back(result.state);
  }
  drift.look(result.state, result.invariants);
  if (with_estimate) result.error_estimate = estimated_error(module, run, result);
  return result;
}

}  // namespace casimir
