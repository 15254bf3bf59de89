// Estimated errors beside true ones, over the scenes of the bundled cases: see README.md.
#include <CLI/CLI.hpp>
#include <cstdlib>

#include "tests/folder.hpp"
#include "tests/traps/estimate.hpp"

int main(int argc, char** argv) {
  casimir::traps::EstimateRequest request;
  request.program = CASIMIR_PROGRAM;
  std::string cache;
  CLI::App app{"Compares the errors that casimir integrate estimates with the true ones."};
  app.add_option("--method", request.methods, "methods, one after the other")->delimiter(',');
  app.add_option("--tolerance", request.tolerances, "tolerances")->delimiter(',');
  app.add_option("--case", request.only, "this bundled case alone");
  app.add_option("--every", request.every, "each so many-th of the scenes");
  app.add_option("--seconds", request.seconds, "of a processor, for one run");
  app.add_option("--program", request.program, "casimir");
  app.add_option("--jobs", request.jobs, "runs at a time");
  app.add_option("--cache", cache, "folder for compiled modules; without it a new one");
  CLI11_PARSE(app, argc, argv);
  const casimir::test::Folder own_cache;
  setenv("CASIMIR_CACHE", cache.empty() ? own_cache.path().c_str() : cache.c_str(), 1);
  return casimir::traps::compare_estimates(request) ? 0 : 1;
}
