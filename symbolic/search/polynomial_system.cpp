#include "symbolic/search/polynomial_system.hpp"

#include <algorithm>
#include <optional>

#include "symbolic/ideal.hpp"

namespace casimir::search {
namespace {

constexpr std::size_t kMostTerms = 3000;  // of an equation
constexpr std::size_t kMostBranches = 400;
constexpr int kDeepest = 60;

class Solver {
 public:
  Solver(const std::vector<std::size_t>& unknowns, const Watch& watch)
      : unknowns_(unknowns), watch_(watch) {}

  std::vector<Branch> branches;

  void solve(std::vector<Polynomial> equations, Branch branch, int depth, bool based);

 private:
  bool has_unknowns(const Polynomial& p) const {
    return std::any_of(unknowns_.begin(), unknowns_.end(),
                       [&](std::size_t u) { return p.uses(u); });
  }
  std::vector<Polynomial> factors_of(const Polynomial& p) const;
  struct Linear {
    std::size_t equation, place;
  };
  std::optional<Linear> find_linear(const std::vector<Polynomial>& equations) const;
  void give_up(Branch branch, std::vector<Polynomial> equations) {
    branch.rest = std::move(equations);
    branch.decided = false;
    branches.push_back(std::move(branch));
  }

  const std::vector<std::size_t>& unknowns_;
  const Watch& watch_;
};

/// The different factors with unknowns; none for a polynomial without.
std::vector<Polynomial> Solver::factors_of(const Polynomial& p) const {
  std::vector<Polynomial> result;
  for (const auto& [factor, exponent] : p.factors())
    if (has_unknowns(factor)) result.push_back(factor);
  return result;
}

/// An equation that is linear in an unknown; the shortest one with the simplest coefficient.
std::optional<Solver::Linear> Solver::find_linear(const std::vector<Polynomial>& equations) const {
  std::optional<Linear> best;
  std::size_t best_cost = 0;
  for (std::size_t e = 0; e < equations.size(); ++e) {
    for (const std::size_t u : unknowns_) {
      if (equations[e].degree(u) != 1) continue;
      const Polynomial leading = equations[e].coefficients(u)[1];
      if (has_unknowns(leading)) continue;
      const std::size_t cost = equations[e].terms() + (leading.is_constant() ? 0 : 20);
      if (best && cost >= best_cost) continue;
      best = Linear{e, u};
      best_cost = cost;
    }
  }
  return best;
}

void Solver::solve(std::vector<Polynomial> equations, Branch branch, int depth, bool based) {
  watch_.tick(0.5);
  if (branches.size() >= kMostBranches || depth > kDeepest) {
    give_up(std::move(branch), std::move(equations));
    return;
  }
  // Square-free parts; an equation without unknowns has no solution, for generic parameters.
  std::vector<Polynomial> clean;
  for (const Polynomial& p : equations) {
    if (p.is_zero()) continue;
    if (!has_unknowns(p)) return;
    if (p.terms() > kMostTerms) {
      give_up(std::move(branch), std::move(equations));
      return;
    }
    const std::vector<Polynomial> factors = factors_of(p);
    if (factors.size() > 1) {
      std::vector<Polynomial> others;
      for (const Polynomial& q : equations)
        if (!(q == p)) others.push_back(q);
      for (const Polynomial& factor : factors) {
        std::vector<Polynomial> own = others;
        own.push_back(factor);
        solve(std::move(own), branch, depth + 1, false);
      }
      return;
    }
    if (std::none_of(clean.begin(), clean.end(),
                     [&](const Polynomial& q) { return q == factors[0]; }))
      clean.push_back(factors[0]);
  }
  if (clean.empty()) {
    branches.push_back(std::move(branch));
    return;
  }
  if (const std::optional<Linear> linear = find_linear(clean)) {
    const std::vector<Polynomial> parts = clean[linear->equation].coefficients(linear->place);
    SolvedUnknown solved{linear->place, -parts[0], parts[1]};
    if (parts[1].is_constant()) {
      solved.numerator = solved.numerator.scaled(1 / parts[1].term_list()[0].first);
      solved.denominator = parts[1].ring().constant(1);
    }
    std::vector<Polynomial> rest;
    for (std::size_t e = 0; e < clean.size(); ++e) {
      if (e != linear->equation)
        rest.push_back(substituted(clean[e], solved.place, solved.numerator, solved.denominator));
    }
    branch.solved.push_back(std::move(solved));
    solve(std::move(rest), std::move(branch), depth + 1, false);
    return;
  }
  if (!based && clean.size() > 1) {
    solve(groebner_basis(clean), std::move(branch), depth + 1, true);
    return;
  }
  branch.rest = std::move(clean);
  branches.push_back(std::move(branch));
}

}  // namespace

Polynomial Branch::reduced(Polynomial p) const {
  for (const SolvedUnknown& s : solved) p = substituted(p, s.place, s.numerator, s.denominator);
  return p;
}

std::vector<Branch> solve_system(std::vector<Polynomial> equations,
                                 const std::vector<std::size_t>& unknowns, const Watch& watch) {
  Solver solver(unknowns, watch);
  solver.solve(std::move(equations), {}, 0, false);
  return std::move(solver.branches);
}

Polynomial substituted(const Polynomial& p, std::size_t place, const Polynomial& numerator,
                       const Polynomial& denominator) {
  if (!p.uses(place)) return p;
  const std::vector<Polynomial> parts = p.coefficients(place);
  Polynomial result = parts.back();
  Polynomial power = p.ring().constant(1);
  for (std::size_t k = parts.size() - 1; k-- > 0;) {
    power = power * denominator;
    result = result * numerator + parts[k] * power;
  }
  return result;
}

Polynomial determinant_without_sign(std::vector<std::vector<Polynomial>> m,
                                    const PolynomialRing& ring) {
  Polynomial previous = ring.constant(1);
  const std::size_t n = m.size();
  for (std::size_t k = 0; k + 1 < n; ++k) {
    // The shortest pivot keeps the rest short.
    std::size_t pivot = n;
    for (std::size_t i = k; i < n; ++i) {
      if (!m[i][k].is_zero() && (pivot == n || m[i][k].terms() < m[pivot][k].terms())) pivot = i;
    }
    if (pivot == n) return Polynomial(ring);
    std::swap(m[pivot], m[k]);
    for (std::size_t i = k + 1; i < n; ++i) {
      for (std::size_t j = k + 1; j < n; ++j) {
        const Polynomial top = m[k][k] * m[i][j] - m[i][k] * m[k][j];
        top.divide(previous, &m[i][j]);
      }
    }
    previous = m[k][k];
  }
  return m[n - 1][n - 1];
}

Polynomial resultant(const Polynomial& a, const Polynomial& b, std::size_t place) {
  Polynomial result(a.ring());
  fmpq_mpoly_resultant(result.raw(), a.raw(), b.raw(), static_cast<slong>(place),
                       a.ring().context());
  return result;
}

}  // namespace casimir::search
