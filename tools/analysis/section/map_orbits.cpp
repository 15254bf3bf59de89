#include "tools/analysis/section/map_orbits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>

#include "codegen/compile.hpp"
#include "codegen/emit_cpp.hpp"
#include "codegen/specialise_map.hpp"
#include "runtime/evaluate.hpp"
#include "symbolic/case/limits.hpp"
#include "symbolic/expression/decimal.hpp"
#include "symbolic/expression/expression_size.hpp"
#include "tools/analysis/error.hpp"

namespace casimir {
namespace {

/// As they were written, and no angles: a map need not know that its variables are.
std::array<PlottedFunction, 2> plotted_functions(const std::vector<FunctionText>& pair) {
  std::array<PlottedFunction, 2> result;
  for (std::size_t i = 0; i < 2; ++i) result[i] = {pair[i].text, pair[i].text, 0};
  return result;
}

PreparedScene prepared_with_pair(const MapModel& map, const Scene& scene,
                                 const std::vector<FunctionText>& pair) {
  MapModel plotted = map;
  plotted.base.casimirs.clear();
  plotted.base.integrals = {{"the first plotted function", pair[0].function, {}},
                            {"the second plotted function", pair[1].function, {}}};
  PreparedScene run = prepare(plotted.as_field(), scene, {.observe = std::vector<std::string>{}});
  SpecialiseOptions what;
  what.observe = std::vector<std::string>{};
  what.jacobian = false;
  what.variational = true;
  run.specialisation = specialise_map(plotted, scene, what);
  if (run.specialisation.invariant_names.size() != 2)
    throw RequestError("one of the plotted functions is a constant, or both are the same");
  return run;
}

/// The step and the image of a deviation, as one map of twice as many states.
Specialisation with_deviation(const Specialisation& s) {
  Specialisation twice = s;
  twice.rhs = s.variational;
  twice.invariants = {};
  twice.invariants.inputs = s.variational.inputs;
  twice.invariant_names.clear();
  for (const std::string& name : s.states) twice.states.push_back("delta_" + name);
  return twice;
}

CompiledModule compiled_step(const Specialisation& specialisation) {
  const auto begin = std::chrono::steady_clock::now();
  const CompiledObject object = compile(emit_module(with_deviation(specialisation)));
  CompiledModule result{.module = loaded([&] { return Module::load(object.path); }),
                        .from_cache = object.from_cache};
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

bool are_finite(const double* x, std::size_t n) {
  return std::all_of(x, x + n, [](double value) { return std::isfinite(value); });
}

/// Points that fill a box evenly: multiples of powers of the root of x^(n+1) = x + 1 (Roberts).
double fraction_of(std::size_t point, std::size_t coordinate, std::size_t n) {
  double root = 1.5;
  for (int k = 0; k < 60; ++k) root = std::pow(1 + root, 1. / static_cast<double>(n + 1));
  const double value =
      0.5 + static_cast<double>(point) * std::pow(root, -1. - static_cast<double>(coordinate));
  return value - std::floor(value);
}

}  // namespace

MapOrbits::MapOrbits(const MapModel& map, const Scene& scene, const std::vector<FunctionText>& pair,
                     std::function<bool()> give_up)
    : map_(map),
      scene_(scene),
      give_up_(std::move(give_up)),
      run_(prepared_with_pair(map, scene, pair)),
      plotted_(plotted_functions(pair)),
      step_(compiled_step(run_.specialisation)) {}

OrbitReport MapOrbits::orbit(const std::vector<double>& seed, std::size_t points) const {
  const std::size_t n = seed.size();
  OrbitReport report;
  report.seed = Eigen::Map<const LevelSet::Vector>(seed.data(), static_cast<Eigen::Index>(n));
  SectionOrbit& orbit = report.orbit;
  orbit.status = Status::ok;
  std::vector<double> state(seed), next(2 * n);
  // A direction that no symmetry singles out.
  for (std::size_t i = 0; i < n; ++i) state.push_back(std::sin(1 + 2.3 * static_cast<double>(i)));
  double growth = 0;
  for (std::size_t k = 1; k <= points; ++k) {
    step_.module.functions().rhs(0, state.data(), run_.parameters.data(), next.data());
    double size = 0;
    for (std::size_t i = n; i < 2 * n; ++i) size = std::max(size, std::abs(next[i]));
    if (!are_finite(next.data(), 2 * n) || !(size > 0)) {
      orbit.status = Status::non_finite;
      break;
    }
    for (std::size_t i = n; i < 2 * n; ++i) next[i] /= size;
    growth += std::log(size);
    std::swap(state, next);
    std::vector<double> inputs(state.begin(), state.begin() + static_cast<std::ptrdiff_t>(n));
    inputs.insert(inputs.end(), run_.parameters.begin(), run_.parameters.end());
    inputs.push_back(0);
    std::array<double, 2> place{NAN, NAN};
    try {
      const std::vector<double> values = evaluate(run_.specialisation.invariants, inputs);
      place = {values[0], values[1]};
    } catch (const std::domain_error&) {
      // The plotted pair has no value here; the orbit goes on.
    }
    orbit.times.push_back(static_cast<double>(k));
    orbit.growth.push_back(growth);
    orbit.states.insert(orbit.states.end(), inputs.begin(),
                        inputs.begin() + static_cast<std::ptrdiff_t>(n));
    report.places.push_back(place);
    ++orbit.steps;
    constexpr std::size_t kBetween = 4096;
    if (k % kBetween == 0 && interrupted()) {
      orbit.status = Status::stopped;
      break;
    }
  }
  orbit.time = static_cast<double>(orbit.size());
  orbit.state.assign(state.begin(), state.begin() + static_cast<std::ptrdiff_t>(n));
  judge_growth(report);
  return report;
}

bool MapOrbits::allowed(const std::vector<double>& x) const {
  const Limits& limits = map_.base.limits;
  GiNaC::exmap point;
  for (std::size_t i = 0; i < x.size(); ++i) point[map_.base.variables[i]] = GiNaC::numeric(x[i]);
  for (const Assumption& a : map_.base.assumptions) {
    const auto value = real_decimal(
        substituted(map_.base.at_parameters(a.difference, scene_), point, limits), limits.bits);
    if (!value) return false;
    const int sign = value->is_zero() ? 0 : value->is_negative() ? -1 : 1;
    if (!holds(a.comparison, sign)) return false;
  }
  return true;
}

std::vector<std::vector<double>> MapOrbits::spread(std::size_t orbits, std::size_t points) const {
  const std::size_t n = run_.initial.size();
  constexpr std::size_t kLook = 2000, kTries = 40;
  constexpr double kLarger = 1.5, kFar = 10;
  const OrbitReport first = orbit(run_.initial, std::min(points, kLook));
  std::vector<double> low = run_.initial, high = run_.initial;
  for (std::size_t k = 0; k < first.orbit.size(); ++k) {
    for (std::size_t i = 0; i < n; ++i) {
      low[i] = std::min(low[i], first.orbit.states[k * n + i]);
      high[i] = std::max(high[i], first.orbit.states[k * n + i]);
    }
  }
  std::vector<std::vector<double>> seeds{run_.initial};
  for (std::size_t k = 0; seeds.size() < orbits && k < kTries * orbits && !interrupted(); ++k) {
    std::vector<double> x(n);
    for (std::size_t i = 0; i < n; ++i)
      x[i] =
          (low[i] + high[i]) / 2 + kLarger * (high[i] - low[i]) * (fraction_of(k + 1, i, n) - 0.5);
    if (!allowed(x)) continue;
    const OrbitReport tried = orbit(x, std::min(points, kLook));
    bool stays = tried.orbit.status != Status::non_finite;
    for (std::size_t j = 0; stays && j < tried.orbit.size(); ++j) {
      for (std::size_t i = 0; stays && i < n; ++i)
        stays = std::abs(tried.orbit.states[j * n + i] - (low[i] + high[i]) / 2) <=
                kFar * std::max(high[i] - low[i], 1e-300);
    }
    if (stays) seeds.push_back(std::move(x));
  }
  return seeds;
}

}  // namespace casimir
