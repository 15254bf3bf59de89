#include "symbolic/model/dirac_bracket.hpp"

#include <set>

#include "symbolic/algebra/ideal.hpp"
#include "symbolic/error.hpp"
#include "symbolic/expression/expression_size.hpp"
#include "symbolic/functions/function_ring.hpp"

namespace casimir {
namespace {

using GiNaC::ex;

/// Whether it is zero by all relations between functions, as sin(x)^2 + cos(x)^2 - 1 is.
bool is_identically_zero(const ex& e, const Limits& limits) {
  std::set<GiNaC::symbol, GiNaC::ex_is_less> seen;
  for (auto part = e.preorder_begin(); part != e.preorder_end(); ++part)
    if (GiNaC::is_a<GiNaC::symbol>(*part)) seen.insert(GiNaC::ex_to<GiNaC::symbol>(*part));
  FunctionRing ring({seen.begin(), seen.end()}, {}, {e}, limits);
  return ring.numerator(ring.convert(e)).is_zero();
}

/// Whether a power of it is shown to be in the ideal of the constraints: then it is zero wherever
/// they are. Beside another common zero set the bracket has poles on the whole phase space.
bool vanishes_on(const std::vector<ex>& constraints, const ex& e, const Limits& limits) {
  std::set<GiNaC::symbol, GiNaC::ex_is_less> seen;
  std::vector<ex> all = constraints;
  all.push_back(e);
  for (const ex& own : all) {
    for (auto part = own.preorder_begin(); part != own.preorder_end(); ++part)
      if (GiNaC::is_a<GiNaC::symbol>(*part)) seen.insert(GiNaC::ex_to<GiNaC::symbol>(*part));
  }
  FunctionRing ring({seen.begin(), seen.end()}, {}, all, limits);
  std::vector<Polynomial> generators;
  for (const ex& phi : constraints) generators.push_back(ring.numerator(ring.convert(phi)));
  try {
    const std::vector<Polynomial> basis = groebner_basis(generators);
    std::vector<Polynomial> quotients;
    const Polynomial own = ring.numerator(ring.convert(e)).remainder(basis, &quotients);
    return (own * own).remainder(basis, &quotients).is_zero();
  } catch (const TooLarge&) {
    return false;
  }
}

/// Without divisions: what GiNaC does not see to be zero cannot become a pivot.
ex determinant_of(const GiNaC::matrix& m) {
  return m.rows() == 0 ? ex(1) : m.determinant(GiNaC::determinant_algo::laplace).expand();
}

ex cofactor(const GiNaC::matrix& m, unsigned row, unsigned column) {
  const GiNaC::matrix minor = GiNaC::ex_to<GiNaC::matrix>(GiNaC::reduced_matrix(m, row, column));
  return ((row + column) % 2 == 0 ? 1 : -1) * determinant_of(minor);
}

}  // namespace

std::optional<DiracBracket> dirac_bracket(const PoissonStructure& written,
                                          const std::vector<ex>& constraints,
                                          const Limits& limits) {
  const std::size_t n = written.dimension(), m = constraints.size();
  if (m % 2 != 0) return std::nullopt;  // C is skew
  std::vector<std::vector<ex>> flows;   // {x_i, phi_a}
  for (const ex& phi : constraints) flows.push_back(written.flow(phi));
  GiNaC::matrix c(static_cast<unsigned>(m), static_cast<unsigned>(m));
  for (unsigned a = 0; a < m; ++a) {
    for (unsigned b = 0; b < a; ++b) {
      c(b, a) = written.bracket(constraints[b], constraints[a]).expand();
      c(a, b) = -c(b, a);
    }
  }
  const ex determinant = determinant_of(c);
  if (is_identically_zero(determinant, limits) || vanishes_on(constraints, determinant, limits))
    return std::nullopt;
  GiNaC::matrix inverse(c.rows(), c.cols());  // times the determinant
  for (unsigned a = 0; a < m; ++a)
    for (unsigned b = 0; b < m; ++b)
      if (a != b) inverse(a, b) = cofactor(c, b, a);
  std::vector<ex> upper;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      ex correction = 0;
      for (unsigned a = 0; a < m; ++a)
        for (unsigned b = 0; b < m; ++b)
          correction -= flows[a][i] * inverse(a, b) * flows[b][j];  // {phi_b, x_j} = -{x_j, phi_b}
      const ex entry = written(i, j) - correction / determinant;
      upper.push_back(fit_for_normal(entry).normal());
    }
  }
  return DiracBracket{PoissonStructure(written.coordinates(), std::move(upper)), determinant};
}

}  // namespace casimir
