#include "symbolic/search/polynomial_system.hpp"

#include <algorithm>
#include <set>
#include <utility>

namespace casimir::search {
namespace {

constexpr std::size_t kMostTermsOfEquation = 3000;  // of an equation
constexpr std::size_t kMostCases = 1000;
constexpr int kDeepest = 60;
// Beyond these a Groebner basis is given up: it would not be short.
constexpr GroebnerLimits kBasisLimits{.reductions = 600, .elements = 100, .terms = 1000};

class Solver {
 public:
  Solver(const std::vector<std::size_t>& unknowns, const std::vector<std::size_t>& last,
         const Watch& watch, const NormalForm& normal_form)
      : unknowns_(unknowns), last_(last), watch_(watch), normal_form_(normal_form) {}

  std::vector<Branch> branches;

  void solve(std::vector<Polynomial> equations, Branch branch, int depth, bool based);

 private:
  bool has_unknowns(const Polynomial& p) const {
    return std::any_of(unknowns_.begin(), unknowns_.end(),
                       [&](std::size_t u) { return p.uses(u); });
  }
  Polynomial normal(Polynomial p) const { return normal_form_ ? normal_form_(p) : p; }
  std::vector<Polynomial> factors_of(const Polynomial& p,
                                     const std::vector<Polynomial>& nonzero) const;
  bool assume(Branch& branch, const Polynomial& nonzero) const;
  struct Linear {
    std::size_t equation, place;
  };
  std::optional<Linear> find_linear(const std::vector<Polynomial>& equations,
                                    bool with_unknowns) const;
  void eliminate(const std::vector<Polynomial>& equations, const Linear& linear, Branch branch,
                 int depth);
  void finish(std::vector<Polynomial> equations, Branch branch, int depth);
  void give_up(Branch branch, std::vector<Polynomial> equations) {
    branch.rest = std::move(equations);
    branch.decided = false;
    branches.push_back(std::move(branch));
  }

  const std::vector<std::size_t>&unknowns_, &last_;
  const Watch& watch_;
  const NormalForm& normal_form_;
  std::size_t cases_ = 0;
};

/// The different factors that may be zero; none for a polynomial without unknowns.
std::vector<Polynomial> Solver::factors_of(const Polynomial& p,
                                           const std::vector<Polynomial>& nonzero) const {
  std::vector<Polynomial> result;
  for (const auto& [factor, exponent] : p.factors())
    if (has_unknowns(factor) && std::find(nonzero.begin(), nonzero.end(), factor) == nonzero.end())
      result.push_back(factor);
  return result;
}

/// Whether that can be.
bool Solver::assume(Branch& branch, const Polynomial& nonzero) const {
  const Polynomial value = normal(nonzero);
  if (value.is_zero()) return false;
  for (const Polynomial& factor : factors_of(value, branch.nonzero))
    branch.nonzero.push_back(factor);
  return true;
}

/// An equation that is linear in an unknown; the shortest one with the simplest coefficient.
std::optional<Solver::Linear> Solver::find_linear(const std::vector<Polynomial>& equations,
                                                  bool with_unknowns) const {
  std::optional<Linear> best;
  std::size_t best_cost = 0;
  for (std::size_t e = 0; e < equations.size(); ++e) {
    for (const std::size_t u : unknowns_) {
      if (equations[e].degree(u) != 1) continue;
      const Polynomial leading = equations[e].coefficients(u)[1];
      if (has_unknowns(leading) != with_unknowns) continue;
      const bool late = std::find(last_.begin(), last_.end(), u) != last_.end();
      const std::size_t cost = equations[e].terms() + (leading.is_constant() ? 0 : 20) +
                               (late ? kMostTermsOfEquation : 0) +
                               (with_unknowns ? leading.terms() * leading.terms() : 0);
      if (best && cost >= best_cost) continue;
      best = Linear{e, u};
      best_cost = cost;
    }
  }
  return best;
}

void Solver::solve(std::vector<Polynomial> equations, Branch branch, int depth, bool based) {
  watch_.tick(0.5);
  if (++cases_ > kMostCases || depth > kDeepest) {
    give_up(std::move(branch), std::move(equations));
    return;
  }
  // Square-free parts; an equation without unknowns has no solution, for generic parameters.
  std::vector<Polynomial> clean;
  for (Polynomial& p : equations) p = normal(std::move(p));
  for (const Polynomial& p : equations) {
    if (p.is_zero()) continue;
    if (!has_unknowns(p)) return;
    if (p.terms() > kMostTermsOfEquation) {
      give_up(std::move(branch), std::move(equations));
      return;
    }
    const std::vector<Polynomial> factors = factors_of(p, branch.nonzero);
    if (factors.empty()) return;
    if (factors.size() > 1) {
      std::vector<Polynomial> others;
      for (const Polynomial& q : equations)
        if (!(q == p)) others.push_back(q);
      for (const Polynomial& factor : factors) {
        std::vector<Polynomial> own = others;
        own.push_back(factor);
        solve(std::move(own), branch, depth + 1, false);
        branch.nonzero.push_back(factor);  // the other case is done
      }
      return;
    }
    if (std::none_of(clean.begin(), clean.end(),
                     [&](const Polynomial& q) { return q == factors[0]; }))
      clean.push_back(factors[0]);
  }
  if (clean.empty()) return finish({}, std::move(branch), depth);
  if (const std::optional<Linear> linear = find_linear(clean, false))
    return eliminate(clean, *linear, std::move(branch), depth);
  if (!based && clean.size() > 1)
    return solve(groebner_basis(clean, kBasisLimits), std::move(branch), depth + 1, true);
  finish(std::move(clean), std::move(branch), depth);
}

/// Puts the unknown into the other equations; its coefficient is not zero.
void Solver::eliminate(const std::vector<Polynomial>& equations, const Linear& linear,
                       Branch branch, int depth) {
  const std::vector<Polynomial> parts = equations[linear.equation].coefficients(linear.place);
  SolvedUnknown solved{linear.place, -parts[0], parts[1]};
  if (parts[1].is_constant()) {
    solved.numerator = solved.numerator.scaled(1 / parts[1].term_list()[0].first);
    solved.denominator = parts[1].ring().constant(1);
  }
  std::vector<Polynomial> rest;
  for (std::size_t e = 0; e < equations.size(); ++e) {
    if (e != linear.equation)
      rest.push_back(substituted(equations[e], solved.place, solved.numerator, solved.denominator));
  }
  const std::vector<Polynomial> nonzero = std::exchange(branch.nonzero, {});
  assume(branch, solved.denominator);
  for (const Polynomial& p : nonzero)
    if (!assume(branch, substituted(p, solved.place, solved.numerator, solved.denominator))) return;
  branch.solved.push_back(std::move(solved));
  solve(std::move(rest), std::move(branch), depth + 1, false);
}

/// Equations that neither elimination nor a Groebner basis simplifies.
void Solver::finish(std::vector<Polynomial> equations, Branch branch, int depth) {
  if (const auto relations = triangular(equations, unknowns_)) {
    const bool empty = std::any_of(
        branch.nonzero.begin(), branch.nonzero.end(),
        [&](const Polynomial& p) { return normal(pseudo_remainder(p, *relations)).is_zero(); });
    branch.rest = std::move(equations);
    if (!empty) branches.push_back(std::move(branch));
    return;
  }
  const std::optional<Linear> linear = find_linear(equations, true);
  if (!linear) return give_up(std::move(branch), std::move(equations));
  eliminate(equations, *linear, branch, depth);
  for (const Polynomial& part : equations[linear->equation].coefficients(linear->place))
    equations.push_back(part);
  equations.erase(equations.begin() + static_cast<std::ptrdiff_t>(linear->equation));
  solve(std::move(equations), std::move(branch), depth + 1, false);
}

}  // namespace

Polynomial Branch::reduced(Polynomial p) const {
  for (const SolvedUnknown& s : solved) p = substituted(p, s.place, s.numerator, s.denominator);
  return p;
}

std::optional<std::vector<SolvedRelation>> triangular(std::vector<Polynomial> equations,
                                                      const std::vector<std::size_t>& unknowns) {
  std::vector<SolvedRelation> set;
  std::set<std::size_t> covered;
  const auto fresh = [&](const Polynomial& p) {
    std::vector<std::size_t> result;
    for (const std::size_t v : unknowns)
      if (p.uses(v) && covered.count(v) == 0) result.push_back(v);
    return result;
  };
  const auto leading_in = [](const Polynomial& p, std::size_t v) {
    return p.coefficients(v).back();
  };
  while (!equations.empty()) {
    const auto best =
        std::min_element(equations.begin(), equations.end(), [&](const auto& a, const auto& b) {
          return std::pair(fresh(a).size(), a.total_degree()) <
                 std::pair(fresh(b).size(), b.total_degree());
        });
    const Polynomial equation = *best;
    equations.erase(best);
    const std::vector<std::size_t> candidates = fresh(equation);
    if (candidates.empty()) {
      if (!pseudo_remainder(equation, set).is_zero()) return std::nullopt;
      continue;
    }
    std::optional<std::size_t> main;
    for (const std::size_t v : candidates) {
      const Polynomial leading = leading_in(equation, v);
      const bool has_none = std::none_of(unknowns.begin(), unknowns.end(),
                                         [&](std::size_t u) { return leading.uses(u); });
      if (has_none && (!main || equation.degree(v) < equation.degree(*main))) main = v;
    }
    if (!main) return std::nullopt;
    covered.insert(candidates.begin(), candidates.end());
    set.insert(set.begin(), {equation, *main, leading_in(equation, *main)});
  }
  return set;
}

bool contains(const Branch& family, const Branch& part, const std::vector<std::size_t>& unknowns) {
  const auto relations = triangular(part.rest, unknowns);
  if (!relations) return false;
  const auto vanishes = [&](const Polynomial& p) {
    return pseudo_remainder(part.reduced(p), *relations).is_zero();
  };
  for (const SolvedUnknown& s : family.solved) {
    const Polynomial& bottom = s.denominator;
    if (vanishes(bottom)) return false;
    if (!vanishes(bottom * bottom.ring().variable(s.place) - s.numerator)) return false;
  }
  return std::all_of(family.rest.begin(), family.rest.end(), vanishes);
}

std::vector<Branch> solve_system(std::vector<Polynomial> equations,
                                 const std::vector<std::size_t>& unknowns, const Watch& watch,
                                 const std::vector<std::size_t>& last,
                                 const NormalForm& normal_form) {
  Solver solver(unknowns, last, watch, normal_form);
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

void put(const SolvedUnknown& solved, Polynomial& top, Polynomial& bottom) {
  const auto power = [&](const Polynomial& of) {
    const long degree = of.uses(solved.place) ? of.degree(solved.place) : 0;  // of zero it is -1
    return solved.denominator.pow(static_cast<unsigned long>(degree));
  };
  const Polynomial below = power(top), above = power(bottom);
  top = substituted(top, solved.place, solved.numerator, solved.denominator) * above;
  bottom = substituted(bottom, solved.place, solved.numerator, solved.denominator) * below;
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
