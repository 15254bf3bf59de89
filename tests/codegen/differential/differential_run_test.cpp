// What integrates random systems, compiled or not, against exact Taylor coefficients: those in the
// lanes of registers one by one, and the end of a short motion by every form of the method; and the
// functions of modules.
#include <cmath>
#include <cstdlib>

#include "runtime/program/interpreter.hpp"
#include "tests/codegen/differential/differential.hpp"
#include "tests/codegen/run/ensemble_forms.hpp"

namespace casimir {
namespace {

using testing::Expected;
using testing::Place;
using testing::RandomSystem;
using testing::Series;

constexpr double kEpsilon = 0x1p-52;
constexpr std::size_t kOrder = 16;

/// More of them with CASIMIR_DIFFERENTIAL_SYSTEMS.
unsigned run_count() {
  const char* wanted = std::getenv("CASIMIR_DIFFERENTIAL_SYSTEMS");
  return wanted ? static_cast<unsigned>(std::atoi(wanted)) : 7;
}

double error_of_value(double value, const cln::cl_F& exact) {
  if (!std::isfinite(value)) return INFINITY;
  return std::fabs(cln::double_approx(exact - cln::cl_float(cln::cl_DF(value), exact)));
}

/// A system and the exact series of its motions from each place.
struct Motions {
  RandomSystem system;
  std::vector<std::vector<Series>> series;

  explicit Motions(unsigned seed) : system(seed, true) {
    for (const Place& place : system.places()) series.push_back(system.coefficients(place, kOrder));
  }

  /// Errors that may add up in coefficient k.
  double errors(std::size_t k) const {
    return 2 * system.operations() * static_cast<double>(k + 1) * kEpsilon;
  }

  /// A time in which no term of a state is worth much, and the last one is below rounding.
  double duration(std::size_t place) const {
    double shortest = 0.25;
    for (const Series& x : series[place])
      for (std::size_t k = 1; k <= kOrder; ++k)
        shortest = std::min(shortest, 0.05 / std::pow(x[k].size, 1. / static_cast<double>(k)));
    return shortest;
  }

  /// Whether double holds the size of what goes into every coefficient.
  bool is_moderate(std::size_t place) const {
    for (const Series& x : series[place])
      for (const testing::Sized& c : x)
        if (!(c.size < 1e100)) return false;
    return true;
  }
};

/// Shows the coefficients of the first step of every member to the exact ones.
struct Witness {
  const Motions& motions;
  Interpreter numbers_of;
  std::vector<double> numbers;
  std::size_t next = 0;
  unsigned long compared = 0;
  std::vector<bool> seen;
  std::ostringstream complaint = {};

  static long long next_member(void* self, double* x, const double** numbers) {
    auto& witness = *static_cast<Witness*>(self);
    const auto& places = witness.motions.system.places();
    if (witness.next == places.size()) return -1;
    std::ranges::copy(places[witness.next].state, x);
    if (!witness.numbers.empty()) witness.numbers_of(nullptr, witness.numbers.data());
    *numbers = witness.numbers.data();
    return static_cast<long long>(witness.next++);
  }

  static void observe(void* self, const casimir_lane_step* step) {
    auto& witness = *static_cast<Witness*>(self);
    for (int lane = 0; lane < step->lanes; ++lane) {
      if (step->member[lane] < 0 || !step->held[lane]) continue;
      step->finished[lane] = 1;
      const auto member = static_cast<std::size_t>(step->member[lane]);
      if (!witness.seen[member]) witness.compare(member, lane, *step);
      witness.seen[member] = true;
    }
  }

  void compare(std::size_t member, int lane, const casimir_lane_step& step) {
    const auto& exact = motions.series[member];
    for (std::size_t i = 0; i < exact.size(); ++i) {
      double scale = 1;
      for (std::size_t k = 0; k <= static_cast<std::size_t>(step.order);
           ++k, scale *= step.unit[lane]) {
        const double value = step.rows[i][k * static_cast<std::size_t>(step.lanes) +
                                          static_cast<std::size_t>(lane)] /
                             scale;
        const double error = error_of_value(value, exact[i][k].value);
        ++compared;
        if (error > motions.errors(k) * exact[i][k].size + 0x1p-1000)
          complaint << "coefficient " << k << " of state " << i << " is " << value << ", off by "
                    << error << '\n';
      }
    }
  }
};

unsigned long compare_lanes(const Motions& motions, const std::string& name,
                            const LaneKernel& kernel) {
  const std::size_t places = motions.system.places().size();
  Witness witness{
      motions, Interpreter(kernel.numbers), std::vector<double>(kernel.numbers.outputs.size()), 0,
      0,       std::vector<bool>(places)};
  casimir_ensemble request = {};
  request.t_end = 1e-3;
  request.rtol = request.atol = 1e-12;
  request.order = static_cast<int>(kOrder);
  request.next = Witness::next_member;
  request.done = [](void*, long long, const double*, const casimir_outcome*) {};
  request.source = &witness;
  request.observe = Witness::observe;
  kernel.run(&request);
  EXPECT_TRUE(witness.complaint.str().empty())
      << name << ": " << witness.complaint.str() << motions.system.text();
  for (std::size_t i = 0; i < places; ++i)
    EXPECT_TRUE(witness.seen[i]) << name << ": member " << i << motions.system.text();
  return witness.compared;
}

/// The state after a short time, and what its error is measured by.
std::vector<testing::Sized> exact_end(const Motions& motions, std::size_t place, double duration) {
  std::vector<testing::Sized> end;
  for (const Series& x : motions.series[place]) {
    testing::Sized sum = x[0];
    const cln::cl_F s = cln::cl_float(cln::cl_DF(duration), x[0].value);
    cln::cl_F power = s;
    for (std::size_t k = 1; k <= kOrder; ++k, power = power * s) {
      sum.value = sum.value + x[k].value * power;
      sum.size +=
          x[k].size * motions.errors(k) / kEpsilon * std::pow(duration, static_cast<double>(k));
    }
    end.push_back(sum);
  }
  return end;
}

unsigned long compare_ends(const Motions& motions, const std::string& name, const Module& module) {
  for (std::size_t place = 0; place < motions.series.size(); ++place) {
    const double duration = motions.duration(place);
    const std::vector<double>& from = motions.system.places()[place].state;
    const Trajectory run = testing::run_taylor(module, testing::settings_for(duration), from);
    EXPECT_EQ(run.status, Status::ok) << name << run.reason << motions.system.text();
    if (run.status != Status::ok) continue;
    const auto end = exact_end(motions, place, duration);
    for (std::size_t i = 0; i < end.size(); ++i) {
      // The tolerance of the run, and as much for rounding.
      const double bound =
          1e-15 * (1 + std::fabs(run.state[i])) * static_cast<double>(run.steps + 2) +
          4 * kEpsilon * end[i].size;
      EXPECT_LE(error_of_value(run.state[i], end[i].value), bound)
          << name << ": state " << i << " after " << duration << '\n'
          << motions.system.text();
    }
  }
  return motions.series.size() * motions.system.specialisation().states.size();
}

/// The plain functions of a module.
unsigned long compare_functions(const Motions& motions, const Module& module) {
  const RandomSystem& system = motions.system;
  const std::size_t n = system.specialisation().states.size();
  const std::size_t m = system.specialisation().invariant_names.size();
  for (const Place& place : system.places()) {
    std::vector<double> values(n + m + 2 * n * n + n * m);
    const double* const x = place.state.data();
    module.functions().rhs(place.time, x, nullptr, values.data());
    module.functions().invariants(place.time, x, nullptr, values.data() + n);
    module.functions().jacobian(place.time, x, nullptr, values.data() + n + m);
    const std::vector<Expected> all = system.expected(place);
    for (std::size_t i = 0; i < n + m + n * n; ++i) {
      const Expected& e = all[i < n + m ? i : i + n * m];  // there are no gradients
      EXPECT_LE(error_of_value(values[i], e.exact.value),
                2 * e.operations * (kEpsilon * e.exact.size + 0x1p-1000))
          << e.what << " of\n"
          << system.text();
    }
  }
  return system.places().size() * (n + m + n * n);
}

TEST(DifferentialRun, EveryKernelHasTheCoefficientsAndEndsOfRandomSystems) {
  unsigned long functions = 0, lanes = 0, ends = 0;
  for (unsigned seed = 1; seed <= run_count() && !HasFailure(); ++seed) {
    const Motions motions(seed);
    const Specialisation& s = motions.system.specialisation();
    bool moderate = !motions.series.empty();
    for (std::size_t place = 0; place < motions.series.size(); ++place)
      moderate = moderate && motions.is_moderate(place);
    if (!moderate) continue;
    functions += compare_functions(motions, Module::load(compile(emit_module(s)).path));
    for (const auto& [name, kernel] : testing::lane_kernels(s))
      lanes += compare_lanes(motions, name, kernel);
    for (const auto& [name, module] : testing::forms(s))
      ends += compare_ends(motions, name, module);
  }
  std::printf("%lu values of functions, %lu coefficients in lanes, %lu ends of motions\n",
              functions, lanes, ends);
  EXPECT_GT(functions, 10 * run_count());
  EXPECT_GT(lanes, 10 * run_count());
  EXPECT_GT(ends, 2 * run_count());
}

}  // namespace
}  // namespace casimir
