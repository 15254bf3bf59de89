#include "codegen/free_body.hpp"

#include <fmt/format.h>

#include "codegen/dag/expression_dag.hpp"
#include "codegen/optimise/optimise.hpp"
#include "symbolic/discrete/free_body.hpp"
#include "symbolic/error.hpp"
#include "symbolic/expression/expression_size.hpp"

namespace casimir {
namespace {

using codegen::is_null;
using discrete::refuse_free_body;
using GiNaC::ex;

constexpr unsigned kAxes = 3;

/// c of {m_i, m_j} = -c m_k, the same for all three.
ex bracket_factor(const SceneHamiltonian& source) {
  const ex factor = -source.bracket(0, 1).diff(source.states[2]).expand();
  if (!factor.info(GiNaC::info_flags::rational) || factor.is_zero())
    refuse_free_body("the bracket is not that of so(3)");
  for (unsigned i = 0; i < kAxes; ++i) {
    const ex expected = -factor * source.states[(i + 2) % kAxes];
    if (!is_null(source.bracket(i, (i + 1) % kAxes) - expected))
      refuse_free_body("the bracket is not that of so(3)");
  }
  return factor;
}

/// A_i of H = sum A_i m_i^2/2.
ex coefficient(const SceneHamiltonian& source, const GiNaC::symbol& m) {
  const ex slope = source.hamiltonian.diff(m);
  const ex twice = normal_form(slope.diff(m));
  for (const GiNaC::symbol& state : source.states)
    if (twice.has(state))
      refuse_free_body("the Hamiltonian is no sum of squares in " + m.get_name());
  if (!is_null(slope - twice * m))
    refuse_free_body("the Hamiltonian is no sum of squares in " + m.get_name());
  if (twice.is_zero()) refuse_free_body(fmt::format("the coefficient of {}^2 is 0", m.get_name()));
  return twice;
}

}  // namespace

Program free_body_moments(const SceneHamiltonian& source) {
  if (source.states.size() != kAxes)
    refuse_free_body(fmt::format("the case has {} variables, not 3", source.states.size()));
  const ex factor = bracket_factor(source);
  std::vector<ex> values;
  for (const GiNaC::symbol& m : source.states) values.push_back(1 / coefficient(source, m));
  values.push_back(factor);
  std::vector<GiNaC::symbol> symbols = source.states;
  symbols.insert(symbols.end(), source.parameters.begin(), source.parameters.end());
  symbols.emplace_back("t");
  std::vector<std::string> inputs;
  for (const GiNaC::symbol& symbol : symbols) inputs.push_back(symbol.get_name());
  codegen::Dag dag(symbols, kAxes);
  std::vector<codegen::Scaled> converted;
  for (const ex& value : values) converted.push_back(dag.convert(value));
  return codegen::optimised(dag, converted, inputs, {"moment 1", "moment 2", "moment 3", "factor"});
}

}  // namespace casimir
