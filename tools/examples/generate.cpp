// Writes a scene of a case as a C++ header, in a form for doubles with the parameter left open.
#include <iostream>

#include "codegen/emit_cpp.hpp"
#include "symbolic/case_file.hpp"

namespace {

const char* const kPendulum = R"toml(
title = "Pendulum"
hamiltonian = "p^2/2 - w^2*cos(q)"

[phase_space]
variables = ["q", "p"]
canonical = true

[parameters]
w = {}

[[scene]]
name = "default"
parameters = { w = "3/2" }
initial = { q = "1", p = "0" }
duration = "10"
)toml";

}  // namespace

int main() try {
  const casimir::Model model =
      casimir::build_model(casimir::parse_case(kPendulum, "pendulum.toml"));
  casimir::SpecialiseOptions what;
  what.keep_parameters = {"w"};
  const casimir::Specialisation pendulum = casimir::specialise(model, model.scene("default"), what);
  std::cerr << casimir::cost_text(pendulum.specialised) << '\n';
  std::cout << casimir::emit_header(pendulum);
} catch (const casimir::CaseError& problem) {
  std::cerr << problem.what() << '\n';
  return 2;
}
