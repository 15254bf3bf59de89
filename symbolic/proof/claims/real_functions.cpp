#include "symbolic/proof/claims/real_functions.hpp"

namespace casimir {

bool may_be_complex(const Prover& prover, const Polynomial& f) {
  if (!prover.model().complex_numbers) return false;
  const FunctionRing& ring = prover.ring();
  for (std::size_t place = ring.symbols().size(); place < ring.ring().size(); ++place)
    if (f.uses(place)) return true;
  return false;
}

bool has_complex_motion(Prover& prover) {
  const Model& model = prover.model();
  const auto complex = [](const GiNaC::ex& f) {
    for (auto part = f.preorder_begin(); part != f.preorder_end(); ++part)
      if (GiNaC::is_a<GiNaC::numeric>(*part) && !GiNaC::ex_to<GiNaC::numeric>(*part).is_real())
        return true;
    return false;
  };
  const std::size_t n = model.variables.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (complex((*model.poisson)(i, j))) return true;
  return model.hamiltonian &&  // a map has none
         (complex(*model.hamiltonian) ||
          may_be_complex(prover, prover.convert(*model.hamiltonian)));
}

std::vector<NamedExpression> real_ones(Prover& prover, std::vector<NamedExpression> functions) {
  std::erase_if(functions, [&](const NamedExpression& f) {
    return may_be_complex(prover, prover.convert(f.value));
  });
  return functions;
}

}  // namespace casimir
