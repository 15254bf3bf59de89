#include "symbolic/obstruction/points/potential_in_space.hpp"

#include <algorithm>

namespace casimir::obstruction {

bool is_rational_number(const GiNaC::ex& e) {
  return GiNaC::is_a<GiNaC::numeric>(e) && GiNaC::ex_to<GiNaC::numeric>(e).is_rational();
}

namespace {

using GiNaC::ex;
using GiNaC::symbol;

/// Sums, products and integer powers only: one branch.
bool is_rational_in(const ex& e, const std::vector<symbol>& q) {
  if (is_rational_number(e)) return true;
  if (GiNaC::is_a<symbol>(e))
    return std::any_of(q.begin(), q.end(), [&](const symbol& x) { return e.is_equal(x); });
  if (GiNaC::is_a<GiNaC::power>(e))
    return e.op(1).info(GiNaC::info_flags::integer) && is_rational_in(e.op(0), q);
  if (!GiNaC::is_a<GiNaC::add>(e) && !GiNaC::is_a<GiNaC::mul>(e)) return false;
  return std::all_of(e.begin(), e.end(), [&](const ex& part) { return is_rational_in(part, q); });
}

bool is_canonical(const HamiltonianSystem& system, std::size_t n) {
  for (std::size_t i = 0; i < 2 * n; ++i)
    for (std::size_t j = 0; j < 2 * n; ++j) {
      const int expected = j == i + n ? 1 : i == j + n ? -1 : 0;
      if (!system.poisson[i][j].is_equal(expected)) return false;
    }
  return true;
}

}  // namespace

std::optional<PotentialInSpace> potential_in_space(const HamiltonianSystem& system) {
  const std::size_t n = system.variables.size() / 2;
  if (n < 3 || system.variables.size() % 2 != 0 || !system.casimirs.empty() ||
      !system.constraints.empty() || !system.further.empty() || !is_canonical(system, n))
    return std::nullopt;
  PotentialInSpace result;
  std::vector<symbol> free;
  if (system.free) free.push_back(*system.free);
  ex potential = system.hamiltonian;
  GiNaC::matrix a(static_cast<unsigned>(n), static_cast<unsigned>(n));
  for (std::size_t i = 0; i < n; ++i) {
    result.q.push_back(system.variables[i]);
    for (std::size_t j = 0; j < n; ++j) {
      const symbol &p = system.variables[n + i], &other = system.variables[n + j];
      const ex own = system.hamiltonian.diff(p).diff(other).normal();
      if (!is_rational_in(own, free)) return std::nullopt;
      a(static_cast<unsigned>(i), static_cast<unsigned>(j)) = own;
      potential -= own * p * other / 2;
    }
  }
  potential = potential.expand();
  std::vector<symbol> used = result.q;
  used.insert(used.end(), free.begin(), free.end());
  result.determinant = a.determinant().normal();
  if (result.determinant.is_zero() || !is_rational_in(potential, used)) return std::nullopt;
  ex slope = 0;
  for (const symbol& x : result.q) slope += x * potential.diff(x);
  if (potential.normal().is_zero()) return std::nullopt;
  const ex degree = (slope / potential).normal();
  if (!is_rational_number(degree) || !degree.info(GiNaC::info_flags::integer)) return std::nullopt;
  result.degree = GiNaC::ex_to<GiNaC::numeric>(degree).to_long();
  if (result.degree == 0 || result.degree == 2 || result.degree == -2) return std::nullopt;
  for (std::size_t i = 0; i < n; ++i) {
    ex own = 0;
    for (std::size_t j = 0; j < n; ++j)
      own += a(static_cast<unsigned>(i), static_cast<unsigned>(j)) * potential.diff(result.q[j]);
    result.slopes.push_back(own);
    result.curvatures.emplace_back();
    for (const symbol& x : result.q) result.curvatures.back().push_back(own.diff(x));
  }
  return result;
}

}  // namespace casimir::obstruction
