// Builds a system from GiNaC expressions, and proves one integral of it and refutes another.
#include <iostream>

#include "tools/analysis/system.hpp"
#include "tools/analysis/verify.hpp"

int main() {
  const GiNaC::symbol x("x"), y("y"), u("u"), v("v"), k("k");
  const GiNaC::ex r2 = x * x + y * y;
  casimir::Model model = casimir::hamiltonian_system(
      "central", {x, y}, {u, v}, (u * u + v * v) / 2 + k * r2 + r2 * r2 / 4, {k});
  model.integrals = {{"L", x * v - y * u, {}}, {"F", u * u + x * x, {}}};
  for (const casimir::Proof& proof : casimir::verify(model).proofs) {
    if (proof.kind != casimir::ClaimKind::integral) continue;
    std::cout << proof.name << ": " << to_string(proof.verdict) << '\n';
    if (!proof.witness) continue;
    std::cout << "its rate is " << proof.witness->value << " at";
    for (const auto& [name, value] : proof.witness->point)
      std::cout << ' ' << name << " = " << value;
    std::cout << '\n';
  }
}
