// How narrow enclosures are, and in what time, beside the figures of CAPD 6.1 on the same problems.
#include <cln/float.h>
#include <cln/real.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "runtime/trace_check.hpp"
#include "symbolic/case_file.hpp"
#include "symbolic/expression/expression.hpp"
#include "tools/analysis/estimate/reference_state.hpp"
#include "tools/analysis/run/validated.hpp"
#include "tools/analysis/section/orbits.hpp"
#include "tools/analysis/section/validated_cycles.hpp"

namespace {

using namespace casimir;

struct Problem {
  const char *file, *scene, *duration;
  double initial_radius;
  double bound;  ///< of the radius at the end
  bool quick;
  const char* text = nullptr;  ///< of a case that is not bundled
};

constexpr const char* kHenonHeiles = R"toml(title = "Henon-Heiles"
hamiltonian = "(px^2 + py^2 + x^2 + y^2)/2 + x^2*y - y^3/3"
[phase_space]
variables = ["x", "y", "px", "py"]
canonical = true
[[scene]]
name = "default"
initial = { x = "0", y = "1/10", px = "49057/100000", py = "0" }
duration = "2000"
)toml";
constexpr const char* kLorenz = R"toml(title = "Lorenz"
[phase_space]
variables = ["x", "y", "z"]
[equations]
x = "10*(y - x)"
y = "x*(28 - z) - y"
z = "x*y - 8/3*z"
[[scene]]
name = "default"
initial = { x = "15", y = "15", z = "36" }
duration = "20"
)toml";
constexpr const char* kRoessler = R"toml(title = "Roessler"
[phase_space]
variables = ["x", "y", "z"]
[equations]
x = "-y - z"
y = "x + y/5"
z = "1/5 + z*(x - 57/10)"
[[scene]]
name = "default"
initial = { x = "0", y = "-8.38", z = "0.0296" }
duration = "100"
)toml";

const std::vector<Problem>& problems() {
  static const std::vector<Problem> all = {
      {"kovalevskaya", "default", "100", 0, 5e-12, true},
      {"kovalevskaya", "default", "1000", 0, 1e-9, false},
      {"kovalevskaya", "default", "10000", 0, 4e-6, false},
      {"kovalevskaya", "default", "20", 1e-6, 1.8e-5, true},
      {"euler-poisson", "chaotic", "200", 0, 1e-5, true},
      {"henon-heiles", "default", "2000", 0, 1e-7, true, kHenonHeiles},
      {"lorenz", "default", "20", 0, 2.5e-4, true, kLorenz},
      {"roessler", "default", "100", 0, 8e-7, true, kRoessler},
  };
  return all;
}

double seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Seconds of a run of the same in doubles by Taylor series at the tolerance 1e-15, which proves
/// nothing.
double plain_seconds(const Model& model, Scene scene, const GiNaC::ex& duration) {
  scene.duration = duration;
  const PreparedScene run = prepare(model, scene);
  Settings settings;
  settings.duration = run.duration;
  settings.rtol = settings.atol = 1e-15;
  settings.monitor = false;
  return good_run(run, settings).trajectory.seconds;
}

/// A run, and the least processor time of some of the same: what disturbs the machine only adds.
std::pair<ValidatedRun, double> enclosed(const ValidatedProblem& problem,
                                         const ValidatedSettings& settings) {
  constexpr int kRuns = 7;
  constexpr double kEnough = 1;
  ValidatedRun run;
  double least = INFINITY, all = 0;
  for (int k = 0; k < kRuns && all < kEnough; ++k) {
    const double start = seconds();
    run = validated_run(problem, settings);
    const double spent = seconds() - start;
    least = std::min(least, spent);
    all += spent;
  }
  return {std::move(run), least};
}

/// Whether the box is as narrow as it has to be.
bool measure(const Problem& problem, const std::filesystem::path& folder) {
  const Model model =
      build_model(problem.text ? parse_case(problem.text, problem.file)
                               : read_case((folder / problem.file).string() + ".toml"));
  const Scene& scene = model.scene(problem.scene);
  ValidatedOptions options;
  options.duration =
      parse_real_constant({problem.duration, {"duration", 1, 1}, problem.duration}, model.limits);
  if (problem.initial_radius > 0)
    options.initial_radius = cln::rational(cln::cl_DF(problem.initial_radius));
  const PreparedEnclosure plain = prepare_enclosure(model, scene, options);
  const auto [run, spent] = enclosed(plain.problem, options.run);
  // The same with every step written down, and what it takes to verify them.
  ValidatedOptions traced = options;
  RunTrace trace;
  traced.run.trace = &trace;
  const PreparedEnclosure enclosure = prepare_enclosure(model, scene, traced);
  validated_run(enclosure.problem, traced.run);
  const double written = seconds();
  const bool checked = check_trace(enclosure.problem, trace).fault == TraceFault::none;
  const double check = seconds() - written;
  const bool good = checked && run.status == ValidatedStatus::ok && run.radius() <= problem.bound;
  fmt::print(
      "{:<14} {:<8} {:>6} {:>8.0e}  {:>9.2e} {:>9.0e} {:>8} {:>9.1f} ms {:>8.2f} ms {:>9.1f} ms "
      "{:>5.1f}  {}\n",
      problem.file, problem.scene, problem.duration, problem.initial_radius, run.radius(),
      problem.bound, run.steps, 1e3 * spent, 1e3 * plain_seconds(model, scene, *options.duration),
      1e3 * check, check / spent,
      good      ? "ok"
      : checked ? "TOO WIDE: " + run.reason
                : "NOT CHECKED");
  return good;
}

/// The fixed points of the return map of figure 1.5, each proved by itself.
bool measure_cycles(const std::filesystem::path& folder) {
  const Model model = build_model(read_case((folder / "euler-poisson").string() + ".toml"));
  const Scene& scene = model.scene("chaotic");
  const SectionProblem problem = section_problem(model, scene);
  const LevelSet level(problem);
  constexpr std::size_t kStarts = 100;
  const OrbitCutter cutter(problem, {1e-14, 1, {}}, kStarts);
  const std::vector<PlacedPoint> domain = points_of_domain(level, cutter.returning(), {});
  const CycleSearch found =
      find_cycles(level, cutter, spread_out(level, domain, kStarts), 1, true, [](double) {});
  bool good = !found.cycles.empty();
  for (const Cycle& cycle : found.cycles) {
    const double start = seconds();
    const ProvedCycle proof = enclose_cycles(model, scene, problem, {cycle}).front();
    good = good && proof.proved;
    fmt::print("fixed point of figure 1.5, period {:.8f}: radius {:.1e}, {:.0f} ms  {}\n",
               cycle.period, cln::double_approx(proof.radius), 1e3 * (seconds() - start),
               proof.proved ? "ok" : "NOT PROVED: " + proof.reason);
  }
  return good;
}

}  // namespace

int main(int argc, char** argv) {
  const bool quick = argc > 1 && std::string(argv[1]) == "--quick";
  const std::filesystem::path folder = argc > (quick ? 2 : 1) ? argv[quick ? 2 : 1] : "cases";
  fmt::print(
      "case           scene    duration  start     radius     bound    steps  processor time   "
      "plain "
      "run        check ratio\n");
  bool good = true;
  for (const Problem& problem : problems())
    if (problem.quick || !quick) good = measure(problem, folder) && good;
  good = measure_cycles(folder) && good;
  return good ? 0 : 1;
}
