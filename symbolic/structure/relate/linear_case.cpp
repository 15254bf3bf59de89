#include "symbolic/structure/relate/linear_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "symbolic/functions/function_ring.hpp"
#include "symbolic/structure/relate/linear_family.hpp"

namespace casimir::structure {

Terms LinearCase::bracket(std::size_t i, std::size_t j) const {
  if (i == j) return {};
  if (i < j) return upper[i * dimension - i * (i + 1) / 2 + (j - i - 1)];
  Terms result = bracket(j, i);
  for (auto& [number, exponents] : result) number = -number;
  return result;
}

unsigned long degree_of(const Terms& terms) {
  unsigned long result = 0;
  for (const auto& [number, exponents] : terms)
    result = std::max(result, std::accumulate(exponents.begin(), exponents.end(), 0UL));
  return result;
}

Terms of_degree(const Terms& terms, unsigned long degree) {
  Terms result;
  for (const auto& term : terms)
    if (std::accumulate(term.second.begin(), term.second.end(), 0UL) == degree)
      result.push_back(term);
  return result;
}

std::vector<Terms> terms_of(const Model& model, const std::vector<GiNaC::ex>& functions) {
  const std::vector<GiNaC::symbol> symbols = model.symbols();
  FunctionRing ring(symbols, {}, functions, model.limits);
  if (!ring.is_polynomial())
    throw ModelError(fmt::format(
        "{}: the bracket and the Hamiltonian have to be polynomials in the variables", model.name));
  std::vector<Terms> result;
  for (const GiNaC::ex& f : functions) {
    result.emplace_back();
    for (auto [number, exponents] : ring.convert(f).term_list()) {
      for (std::size_t i = model.variables.size(); i < symbols.size(); ++i) {
        if (exponents[i] > 0)
          throw ModelError(fmt::format("{}: the parameter {} needs a number here", model.name,
                                       symbols[i].get_name()));
      }
      exponents.resize(model.variables.size());
      result.back().emplace_back(number, std::move(exponents));
    }
  }
  return result;
}

/// Maps of other skew products are no isomorphisms of Poisson brackets.
void require_jacobi(const Model& model) {
  const std::size_t n = model.variables.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; ++j)
      for (std::size_t k = j + 1; k < n; ++k)
        if (!model.poisson->jacobi_defect(i, j, k).expand().is_zero())
          throw ModelError(fmt::format(
              "{}: the bracket does not obey the Jacobi identity, and is no Poisson bracket",
              model.name));
}

LinearCase linear_case(const Model& model, bool with_hamiltonian) {
  if (!model.poisson)
    throw ModelError(fmt::format("{} has no bracket: its equations are given alone", model.name));
  if (model.time)
    throw ModelError(
        fmt::format("{} depends on time, and linear maps are compared where none is", model.name));
  LinearCase result;
  result.dimension = model.variables.size();
  std::vector<GiNaC::ex> functions;
  for (std::size_t i = 0; i < result.dimension; ++i)
    for (std::size_t j = i + 1; j < result.dimension; ++j)
      functions.push_back((*model.poisson)(i, j));
  if (with_hamiltonian) functions.push_back(*model.hamiltonian);
  result.upper = terms_of(model, functions);
  require_jacobi(model);
  if (with_hamiltonian) {
    result.hamiltonian = std::move(result.upper.back());
    result.upper.pop_back();
  }
  return result;
}

StructureConstants structure_constants(const LinearCase& c) {
  const std::size_t n = c.dimension;
  StructureConstants result(n, RationalMatrix(n, std::vector<cln::cl_RA>(n, 0)));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      for (const auto& [number, exponents] : of_degree(c.bracket(i, j), 1)) {
        const auto k = std::find(exponents.begin(), exponents.end(), 1UL) - exponents.begin();
        result[i][j][static_cast<std::size_t>(k)] = number;
      }
    }
  }
  return result;
}

std::vector<cln::cl_RA> commutator(const StructureConstants& c, const std::vector<cln::cl_RA>& u,
                                   const std::vector<cln::cl_RA>& v) {
  const std::size_t n = c.size();
  std::vector<cln::cl_RA> result(n, 0);
  for (std::size_t i = 0; i < n; ++i) {
    if (cln::zerop(u[i])) continue;
    for (std::size_t j = 0; j < n; ++j) {
      if (cln::zerop(v[j])) continue;
      for (std::size_t k = 0; k < n; ++k)
        if (!cln::zerop(c[i][j][k])) result[k] = result[k] + u[i] * v[j] * c[i][j][k];
    }
  }
  return result;
}

RationalMatrix adjoint(const StructureConstants& c, const std::vector<cln::cl_RA>& v) {
  RationalMatrix columns;
  for (std::size_t j = 0; j < c.size(); ++j) {
    std::vector<cln::cl_RA> unit(c.size(), 0);
    unit[j] = 1;
    columns.push_back(commutator(c, v, unit));
  }
  return transposed(columns);
}

RationalMatrix killing_form(const StructureConstants& c) {
  const std::size_t n = c.size();
  RationalMatrix result(n, std::vector<cln::cl_RA>(n, 0));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t k = 0; k < n; ++k)
        for (std::size_t l = 0; l < n; ++l)
          if (!cln::zerop(c[i][k][l]) && !cln::zerop(c[j][l][k]))
            result[i][j] = result[i][j] + c[i][k][l] * c[j][l][k];
  return result;
}

}  // namespace casimir::structure
