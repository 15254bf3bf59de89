#include "symbolic/algebra/zero_sets.hpp"

#include <algorithm>
#include <functional>

#include "symbolic/algebra/ideal.hpp"

namespace casimir {
namespace {

using Polynomials = std::vector<Polynomial>;

bool use_common_variable(const Polynomial& a, const Polynomial& b) {
  for (std::size_t v = 0; v < a.ring().size(); ++v)
    if (a.uses(v) && b.uses(v)) return true;
  return false;
}

/// The polynomials that have a variable in common, also through others.
std::vector<Polynomials> connected(Polynomials rest) {
  std::vector<Polynomials> groups;
  while (!rest.empty()) {
    Polynomials group{std::move(rest.back())};
    rest.pop_back();
    for (std::size_t i = 0; i < group.size(); ++i) {
      const auto joins = [&](const Polynomial& p) { return use_common_variable(p, group[i]); };
      const auto first = std::stable_partition(rest.begin(), rest.end(), std::not_fn(joins));
      const Polynomials more(first, rest.end());
      rest.erase(first, rest.end());
      group.insert(group.end(), more.begin(), more.end());
    }
    groups.push_back(std::move(group));
  }
  return groups;
}

/// Whether so few variables occur in all of the monomials, one at least in each.
bool are_hit(const std::vector<std::vector<unsigned long>>& monomials, std::size_t most,
             std::vector<bool>& chosen) {
  const auto missed = std::ranges::find_if(monomials, [&](const auto& powers) {
    for (std::size_t v = 0; v < powers.size(); ++v)
      if (powers[v] > 0 && chosen[v]) return false;
    return true;
  });
  if (missed == monomials.end()) return true;
  if (most == 0) return false;
  for (std::size_t v = 0; v < missed->size(); ++v) {
    if ((*missed)[v] == 0) continue;
    chosen[v] = true;
    const bool hit = are_hit(monomials, most - 1, chosen);
    chosen[v] = false;
    if (hit) return true;
  }
  return false;
}

/// Where f = a v + b with a variable v that the others do not have: around the points where a is
/// not zero the set is the graph of a function over that of the others. Each part of a set of k
/// equations has k dimensions less than the space or fewer; if a = b = 0 and the others leave a
/// smaller set, no part lies where a is zero.
bool is_graph(const Polynomials& set, std::size_t place, bool geometrically) {
  const Polynomial& f = set[place];
  Polynomials others = set;
  others.erase(others.begin() + static_cast<std::ptrdiff_t>(place));
  for (std::size_t v = 0; v < f.ring().size(); ++v) {
    if (f.degree(v) != 1) continue;
    if (std::ranges::any_of(others, [&](const Polynomial& p) { return p.uses(v); })) continue;
    Polynomials where = others;
    for (Polynomial& part : f.coefficients(v)) where.push_back(std::move(part));
    if (has_codimension_above(set.size(), where) && has_irreducible_zeros(others, geometrically))
      return true;
  }
  return false;
}

bool is_irreducible(const Polynomials& set, bool geometrically) {
  if (set.size() == 1) {
    const auto factors = set[0].factors();
    return std::ranges::count_if(factors, [](const auto& f) { return !f.first.is_constant(); }) ==
           1;
  }
  for (std::size_t place = 0; place < set.size(); ++place)
    if (is_graph(set, place, geometrically)) return true;
  return false;
}

}  // namespace

bool has_codimension_above(std::size_t bound, const std::vector<Polynomial>& polynomials) {
  constexpr GroebnerLimits kShort{.reductions = 400, .elements = 100, .terms = 2000};
  std::vector<std::vector<unsigned long>> leading;
  for (const Polynomial& p : groebner_basis(polynomials, kShort))
    if (!p.is_zero()) leading.push_back(p.term_list()[0].second);
  std::vector<bool> chosen(polynomials[0].ring().size());
  return !are_hit(leading, bound, chosen);
}

bool has_irreducible_zeros(const std::vector<Polynomial>& polynomials, bool geometrically) {
  const std::vector<Polynomials> groups = connected(polynomials);
  if (groups.size() > 1 && !geometrically) return false;
  return std::ranges::all_of(
      groups, [&](const Polynomials& group) { return is_irreducible(group, geometrically); });
}

}  // namespace casimir
