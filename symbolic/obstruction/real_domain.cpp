#include "symbolic/obstruction/real_domain.hpp"

#include <algorithm>

#include "symbolic/functions/function_ring.hpp"
#include "symbolic/proof/points/real_point.hpp"

namespace casimir::obstruction {
namespace {

using GiNaC::ex;

std::vector<ex> functions_of(const HamiltonianSystem& system) {
  std::vector<ex> functions{system.hamiltonian};
  for (const auto& row : system.poisson) functions.insert(functions.end(), row.begin(), row.end());
  for (const ex& part : system.lost) functions.push_back(part.subs(system.numbers));
  return functions;
}

std::vector<GiNaC::symbol> symbols_of(const HamiltonianSystem& system) {
  std::vector<GiNaC::symbol> symbols = system.variables;
  if (system.free) symbols.push_back(*system.free);
  symbols.insert(symbols.end(), system.further.begin(), system.further.end());
  return symbols;
}

}  // namespace

bool has_inner_points(const HamiltonianSystem& system) {
  const std::vector<ex> functions = functions_of(system);
  Model domain;
  domain.assumptions = system.domain;
  domain.assumptions.insert(domain.assumptions.end(), system.of_free.begin(), system.of_free.end());
  const auto is_rational = [](const ex& f) { return f.info(GiNaC::info_flags::rational_function); };
  if (domain.assumptions.empty() && std::all_of(functions.begin(), functions.end(), is_rational))
    return true;
  domain.variables = symbols_of(system);
  Scene start;
  for (const GiNaC::symbol& x : domain.variables)
    if (const auto value = system.start.find(x); value != system.start.end())
      start.initial.push_back(value->second);
  domain.scenes.push_back(start);
  const FunctionRing ring(domain.variables, domain.assumptions, {}, system.limits);
  return RealPoints(domain, ring).has_inner_point(functions);
}

}  // namespace casimir::obstruction
