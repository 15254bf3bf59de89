// Integrates a case file: the method is chosen, the error is estimated, any time can be asked for.
#include <cstdio>

#include "symbolic/case_file.hpp"
#include "tools/analysis/solve.hpp"

int main(int, char** arguments) try {
  const casimir::Model model = casimir::build_model(casimir::read_case(arguments[1]));
  casimir::SolveOptions options;
  options.run.duration = 20;
  options.dense = true;
  const casimir::Solution motion = solve(model, model.scene("default"), options);
  std::printf("%s: %s\n", motion.run().method->name.data(), motion.run().chosen.c_str());
  for (const double t : {5., 10., 20.})
    std::printf("%s(%g) = %.12f\n", motion.names()[0].c_str(), t, motion(t)[0]);
  std::printf("H drifts by %.0e\n", motion.trajectory().invariants[0].drift);
  std::printf("error about %.0e, changes grow %.0f times\n", motion.trust().error_estimate,
              motion.trust().conditioning);
} catch (const casimir::CaseError& problem) {
  std::puts(problem.what());  // with the line and the column
  return 2;
}
