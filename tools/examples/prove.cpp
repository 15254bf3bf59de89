// Proves the claims of a case, and refutes a candidate with a point that anybody can check.
#include <iostream>

#include "symbolic/prove.hpp"

namespace {

// What would otherwise stand in a file, for casimir::read_case.
const char* const kTop = R"toml(
title = "Free top"
hamiltonian = "(a1*M1^2 + a2*M2^2 + a3*M3^2)/2"

[phase_space]
variables = ["M1", "M2", "M3"]
algebra = "so(3)"

[parameters]
a1 = {}
a2 = {}
a3 = {}

[casimirs]
F1 = "M1^2 + M2^2 + M3^2"
)toml";

void show(const std::vector<casimir::Proof>& proofs) {
  for (const casimir::Proof& proof : proofs) {
    if (proof.note) continue;
    std::cout << to_string(proof.verdict) << "  " << to_string(proof.kind) << "  " << proof.name
              << '\n';
    if (!proof.witness) continue;
    std::cout << "  its derivative is " << proof.witness->value << " at";
    for (const auto& [symbol, value] : proof.witness->point)
      std::cout << ' ' << symbol << " = " << value;
    std::cout << '\n';
  }
}

}  // namespace

int main() try {
  const casimir::Model model = casimir::build_model(casimir::parse_case(kTop, "top.toml"));
  show(prove(model));

  // Is M3 an integral? Of a top with three moments of inertia it is not.
  casimir::Candidates candidates;
  candidates.integrals = {{"M3", {"candidate"}, "M3"}};
  show(prove(model, candidates));
} catch (const casimir::CaseError& problem) {
  std::cerr << problem.what() << '\n';  // with the line and the column
  return 2;
}
