#include "tools/analysis/run/iterate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <random>

#include "codegen/compile.hpp"
#include "codegen/emit_cpp.hpp"
#include "codegen/specialise_map.hpp"
#include "runtime/evaluate.hpp"
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
      const long double change = std::abs(now[i] - initial_[i]);
      const long double drift = change == 0 ? 0 : change / scale;
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

/// Orbits like one that is known, but with errors as rounding makes them.
class DisturbedOrbits {
 public:
  DisturbedOrbits(const Module& module, const PreparedScene& run, const Specialisation& code,
                  const Iterated& orbit)
      : module_(module), run_(run), code_(code), orbit_(orbit) {
    constexpr std::uint64_t kMostOperations = 2'000'000;
    in_all_operations_ = kMostOperations / std::max<std::size_t>(1, code.rhs.code.size());
  }

  /// How far the end is from that of the orbit with longer numbers, where that does not take long.
  /// Errors of many steps that are not random, as those of adding 1/3 again and again, are in no
  /// other.
  double distance_to_longer() const {
    constexpr double kMostLines = 1e8;
    const Program& program = code_.rhs;
    if (static_cast<double>(orbit_.steps) * static_cast<double>(program.code.size()) > kMostLines)
      return 0;
    std::vector<long double> state = evaluate<long double>(code_.start, {});
    const std::vector<long double> parameters(run_.parameters.begin(), run_.parameters.end());
    state.resize(orbit_.state.size());
    std::vector<double> largest(state.size());
    LongerMap map(program, parameters);
    for (std::uint64_t k = 0; k < orbit_.steps; ++k) {
      map(state);
      for (std::size_t i = 0; i < state.size(); ++i)
        largest[i] = std::max(largest[i], static_cast<double>(std::abs(state[i])));
    }
    return distance_between({state.begin(), state.end()}, largest);
  }

  /// How far the end is, as of Iterated. The numbers of the map are others, as of
  /// `with_moved_constants`: all of those that are no doubles where `seed` is 1, some where it
  /// is 2. Errors of single steps are random: of a long orbit the first and the last steps have
  /// them in all operations, and some of those between, all along; the others in the state alone.
  double distance(std::uint64_t seed) const {
    std::mt19937_64 random(seed);
    std::optional<Program> moved;
    if (seed <= 2) moved = with_moved_constants(code_.rhs, random, seed == 1);
    std::optional<Module> of_moved;
    if (moved && orbit_.steps > 2 * in_all_operations_) {
      Specialisation other = code_;
      other.rhs = *moved;
      const CompiledObject object = compile(emit_module(other));
      of_moved = loaded([&] { return Module::load(object.path); });
    }
    DisturbedMap disturbed(moved ? *moved : code_.rhs);
    return distance_of((of_moved ? *of_moved : module_).functions().rhs, disturbed, random);
  }

 private:
  template <class Step>
  double distance_of(const Step& step, DisturbedMap& disturbed, std::mt19937_64& random) const {
    const std::uint64_t steps = orbit_.steps;
    std::vector<double> state = run_.initial, next(state.size()), largest(state.size());
    const auto disturb = [&] {
      std::uint64_t bits = 0;
      for (std::size_t i = 0; i < state.size(); ++i, bits >>= 1) {
        if (i % 64 == 0) bits = random();
        largest[i] = std::max(largest[i], std::abs(state[i]));
        state[i] *= bits % 2 == 0 ? 1 + std::numeric_limits<double>::epsilon()
                                  : 1 - std::numeric_limits<double>::epsilon();
      }
    };
    const std::uint64_t stride = steps / std::max<std::uint64_t>(1, in_all_operations_) + 1;
    disturb();
    for (std::uint64_t k = 0; k < steps; ++k) {
      if (k < in_all_operations_ || steps - k <= in_all_operations_ || k % stride == 0)
        disturbed(state, run_.parameters, random, next);
      else
        step(0, state.data(), run_.parameters.data(), next.data());
      std::swap(state, next);
      disturb();
    }
    return distance_between({state.begin(), state.end()}, largest);
  }

  /// Relative to the size of each variable at the end, or of all of them there and one step before
  /// where it passes zero: near a pole on the way, as of a singularity that is confined, they were
  /// larger, and it is over.
  double distance_between(const std::vector<long double>& state,
                          const std::vector<double>& largest) const {
    double distance = 0, size = 0;
    for (const double end : orbit_.state) size = std::max(size, std::abs(end));
    for (const double before : orbit_.before) size = std::max(size, std::abs(before));
    for (std::size_t i = 0; i < state.size(); ++i) {
      const double end = orbit_.state[i], off = static_cast<double>(std::abs(state[i] - end));
      if (!std::isfinite(off)) return 1;  // nothing is left of it
      const double own = std::max(std::abs(end), std::min(largest[i], size));
      if (off > 0) distance = std::max(distance, own > 0 ? off / own : 1.);
    }
    return distance;
  }

  const Module& module_;
  const PreparedScene& run_;
  const Specialisation& code_;
  const Iterated& orbit_;
  std::uint64_t in_all_operations_ = 0;  ///< steps at either end
};

std::optional<double> estimated_error(const DisturbedOrbits& others, const Iterated& orbit) {
  if (!orbit.finite || orbit.stopped || orbit.seconds > kLongestRepeated) return std::nullopt;
  constexpr std::uint64_t kRepeats = 3;
  double estimate = others.distance_to_longer();
  for (std::uint64_t seed = 1; seed <= kRepeats; ++seed)
    estimate = std::max(estimate, others.distance(seed));
  return estimate;
}

}  // namespace

Iterated iterate(const MapModel& map, const Scene& scene, std::uint64_t steps, std::uint64_t every,
                 const std::function<bool()>& give_up, bool with_estimate) {
  const Model model = with_integrals_of_level(map, scene);
  const PreparedScene run = prepare(model, scene);
  Specialisation s = run.specialisation;
  s.has_jacobian = false;
  s.rhs = without_signs_of_zero(s.rhs);
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
  // At random steps: at each hundredth an orbit of period 2 would always be the same.
  std::mt19937_64 random;
  std::uniform_int_distribution<std::uint64_t> gap(
      1, std::max<std::uint64_t>(1, 2 * (steps / kLooks)));
  std::uint64_t next_look = 1;
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
    if (result.steps == next_look) {
      drift.look(result.state, result.invariants);
      next_look += gap(random);
    }
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
  if (result.steps > 0) result.before = std::move(next);
  if (with_estimate)
    result.error_estimate = estimated_error(DisturbedOrbits(module, run, s, result), result);
  return result;
}

}  // namespace casimir
