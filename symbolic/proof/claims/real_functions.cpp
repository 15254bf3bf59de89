#include "symbolic/proof/claims/real_functions.hpp"

#include <fmt/format.h>

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

namespace {

/// Few motions come to such a place, if any does: the others are counted.
bool has_hamiltonian_pole(Prover& prover, const Polynomial& f) {
  const auto& hamiltonian = prover.model().hamiltonian;
  return hamiltonian && prover.seems_to_have_pole(prover.convert(*hamiltonian), f);
}

}  // namespace

std::string take_out_jumping(Prover& prover, std::vector<NamedExpression>& functions) {
  std::string which;
  std::erase_if(functions, [&](const NamedExpression& f) {
    const Polynomial value = prover.convert(f.value);
    for (const Polynomial& jump : prover.passed_jumps(value, true)) {
      if (prover.seems_to_have_pole(value, jump) || has_hamiltonian_pole(prover, jump)) continue;
      which +=
          fmt::format("; {} is not counted, since it may jump where {} = 0, which motions pass",
                      f.name, prover.ring().text(jump));
      return true;
    }
    return false;
  });
  return which;
}

std::vector<std::string> where_beside_poles(Prover& prover,
                                            const std::vector<NamedExpression>& functions) {
  std::vector<std::string> where;
  for (const NamedExpression& f : functions)
    for (const Polynomial& pole : prover.passed_jumps(prover.convert(f.value), true))
      where.push_back(fmt::format("on motions that do not cross {} = 0", prover.ring().text(pole)));
  return where;
}

}  // namespace casimir
