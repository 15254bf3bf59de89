// How narrow enclosures are, and in what time, beside the figures of CAPD 6.1 on the same problems.
#include <cln/float.h>
#include <cln/real.h>
#include <fmt/format.h>

#include <ctime>
#include <filesystem>
#include <string>
#include <vector>

#include "symbolic/case_file.hpp"
#include "symbolic/expression/expression.hpp"
#include "tools/analysis/run/validated.hpp"

namespace {

using namespace casimir;

struct Problem {
  const char *file, *scene, *duration;
  double initial_radius;
  double bound;  ///< of the radius at the end
  bool quick;
};

const std::vector<Problem>& problems() {
  static const std::vector<Problem> all = {
      {"kovalevskaya", "default", "100", 0, 5e-12, true},
      {"kovalevskaya", "default", "1000", 0, 1e-9, false},
      {"kovalevskaya", "default", "10000", 0, 4e-6, false},
      {"kovalevskaya", "default", "20", 1e-6, 1.8e-5, true},
      {"euler-poisson", "chaotic", "200", 0, 1e-5, true},
  };
  return all;
}

double seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Whether the box is as narrow as it has to be.
bool measure(const Problem& problem, const std::filesystem::path& folder) {
  const Model model = build_model(read_case((folder / problem.file).string() + ".toml"));
  const Scene& scene = model.scene(problem.scene);
  ValidatedOptions options;
  options.duration = parse_real_constant({problem.duration, {"duration", 1, 1}, problem.duration});
  if (problem.initial_radius > 0)
    options.initial_radius = cln::rational(cln::cl_DF(problem.initial_radius));
  const double start = seconds();
  enclose(model, scene, [&] {
    ValidatedOptions nothing = options;
    nothing.run.max_steps = 1;
    return nothing;
  }());
  const double prepared = seconds();
  const ValidatedMotion motion = enclose(model, scene, options);
  const double spent = (seconds() - prepared) - (prepared - start);
  const ValidatedRun& run = motion.run;
  const bool good = run.status == ValidatedStatus::ok && run.radius() <= problem.bound;
  fmt::print("{:<14} {:<8} {:>6} {:>8.0e}  {:>9.2e} {:>9.0e} {:>8} {:>9.1f} ms  {}\n", problem.file,
             problem.scene, problem.duration, problem.initial_radius, run.radius(), problem.bound,
             run.steps, 1e3 * spent, good ? "ok" : "TOO WIDE: " + run.reason);
  return good;
}

}  // namespace

int main(int argc, char** argv) {
  const bool quick = argc > 1 && std::string(argv[1]) == "--quick";
  const std::filesystem::path folder = argc > (quick ? 2 : 1) ? argv[quick ? 2 : 1] : "cases";
  fmt::print(
      "case           scene    duration  start     radius     bound    steps  processor time\n");
  bool good = true;
  for (const Problem& problem : problems())
    if (problem.quick || !quick) good = measure(problem, folder) && good;
  return good ? 0 : 1;
}
