// Scenes that a step may not see, with known ends, against `casimir integrate`: see README.md.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdlib>

#include "tests/folder.hpp"
#include "tests/traps/fixed.hpp"
#include "tests/traps/reference.hpp"
#include "tests/traps/run.hpp"

namespace {

/// The end state of a file by the reference integrator, for the `reference` in it.
int print_reference(const std::string& file) {
  using namespace casimir::traps;
  const Scene scene = read_scene(file);
  const auto truth = reference(scene);
  if (!truth) {
    fmt::print("not certain\n");
    return 1;
  }
  for (std::size_t i = 0; i < scene.variables.size(); ++i)
    fmt::print("{}{} = \"{:.18g}\"", i == 0 ? "reference = { " : ", ", scene.variables[i],
               truth->state[i]);
  fmt::print(" }}\n");
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  casimir::traps::Request request;
  request.program = CASIMIR_PROGRAM;
  std::string reference, cache;
  CLI::App app{"Judges what casimir integrate says of scenes that a step may not see."};
  app.add_option("--count", request.count, "how many scenes");
  app.add_option("--seed", request.seed, "of the random numbers");
  app.add_option("--first", request.first, "number of the first scene");
  app.add_option("--method", request.methods, "methods, one after the other")->delimiter(',');
  app.add_option("--kind", request.kind, "only this kind, or shape");
  app.add_option("--keep", request.keep, "folder for the case files of what fails");
  app.add_option("--show", request.show, "lists what is right, cautious, warned, .. as well");
  app.add_option("--fixed", request.fixed, "the scenes of this folder instead of generated ones");
  app.add_option("--program", request.program, "casimir");
  app.add_option("--option", request.options, "one more word for the program");
  app.add_option("--seconds", request.seconds, "of a processor, after which a run hangs");
  app.add_option("--jobs", request.jobs, "runs at a time");
  app.add_option("--cache", cache, "folder for compiled modules; without it a new one");
  app.add_flag("--folded", request.folded, "parameters are compiled in: a module for each scene");
  app.add_flag("--print", request.print, "prints the scenes instead of judging them");
  app.add_option("--reference", reference, "prints the end state of this file, and nothing else");
  CLI11_PARSE(app, argc, argv);
  if (!reference.empty()) return print_reference(reference);
  const casimir::test::Folder own_cache;
  setenv("CASIMIR_CACHE", cache.empty() ? own_cache.path().c_str() : cache.c_str(), 1);
  return casimir::traps::run(request) ? 0 : 1;
}
