// Compiles the equations of a scene with the kernel of a method, and integrates it.
#include <cstdio>
#include <iostream>

#include "codegen/compile.hpp"
#include "codegen/emit_cpp.hpp"
#include "runtime/evaluate.hpp"
#include "runtime/integrate.hpp"
#include "runtime/methods.hpp"
#include "runtime/module.hpp"
#include "symbolic/case_file.hpp"

namespace {

const char* const kOscillators = R"toml(
title = "Two oscillators with a cubic coupling"
hamiltonian = "(p1^2 + p2^2 + q1^2 + q2^2)/2 + q1^2*q2 - q2^3/3"

[phase_space]
variables = ["q1", "q2", "p1", "p2"]
canonical = true

[[scene]]
name = "default"
initial = { q1 = "0", q2 = "1/10", p1 = "1/2", p2 = "0" }
duration = "100"
)toml";

}  // namespace

int main() try {
  const casimir::Model model = casimir::build_model(casimir::parse_case(kOscillators, "two.toml"));
  const casimir::Specialisation system = casimir::specialise(model, model.scene("default"));

  // The exact initial state and the duration, rounded.
  std::vector<double> initial = casimir::evaluate<double>(system.start, {});
  casimir::Settings settings;
  settings.rtol = settings.atol = 1e-12;
  settings.duration = initial.back();
  initial.pop_back();

  const casimir::Method& method = *casimir::find_method("dop853");
  const std::string text = emit_module(system, kernel_source(method));
  const casimir::Module module = casimir::Module::load(casimir::compile(text).path);
  const casimir::Trajectory motion = integrate(module, method, settings, initial);

  if (motion.status != casimir::Status::ok) {
    std::cerr << motion.reason << '\n';
    return 5;
  }
  for (std::size_t i = 0; i < system.states.size(); ++i)
    std::printf("%s = %.9f\n", system.states[i].c_str(), motion.state[i]);
  std::printf("%llu steps, the energy drifts by less than 1e-10: %s\n", motion.steps,
              motion.invariants[0].drift < 1e-10 ? "yes" : "no");
} catch (const casimir::EnvironmentError& problem) {
  std::cerr << problem.what() << '\n';  // no compiler, or nowhere to write
  return 4;
}
