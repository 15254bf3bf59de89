#include "symbolic/structure/separate/bivector_ansatz.hpp"

#include <algorithm>
#include <map>

#include "symbolic/search/modular/monomials.hpp"
#include "symbolic/search/modular/span.hpp"
#include "symbolic/structure/bracket_search.hpp"
#include "symbolic/structure/separate/constant_kernel.hpp"
#include "symbolic/structure/separate/roots.hpp"

namespace casimir::structure {
namespace {

constexpr std::size_t kMostOfFamilies = 12;        ///< dimensions, for which [P', P'] = 0 is solved
constexpr std::size_t kMostOfCompatible = 40;      ///< of which pairs are looked at
constexpr std::size_t kMostCompatibleSets = 3000;  ///< of compatible ones

/// A bivector with one component, and that a monomial.
struct Unknown {
  std::size_t component;
  std::vector<unsigned long> exponents;  ///< of all variables of the ring
};

class BivectorAnsatz {
 public:
  BivectorAnsatz(const Leaves& leaves, const std::vector<Polynomial>& casimirs,
                 const std::vector<Polynomial>& integrals, int degree,
                 const std::vector<Reflection>& reflections);

  BivectorSpace solve(const search::Watch& watch);

 private:
  void make_unknowns(const std::vector<Reflection>& reflections);
  bool is_standard(const std::vector<unsigned long>& exponents) const;
  Polynomial monomial(const Unknown& unknown) const;
  std::vector<Polynomial> conditions(const Unknown& unknown) const;
  std::vector<std::vector<search::Residue>> trivial(const search::Modulus& modulus,
                                                    const search::Point& point) const;
  std::optional<std::vector<search::Residue>> coordinates(const Bivector& p,
                                                          const search::Modulus& modulus,
                                                          const search::Point& point) const;
  Bivector bivector_of(const ParametricRow& solution) const;

  const Leaves& leaves_;
  std::size_t n_;
  int degree_;
  std::vector<Polynomial> casimirs_;
  std::vector<std::vector<Polynomial>> of_casimirs_, of_integrals_;  ///< gradients
  std::vector<Unknown> unknowns_;
  std::map<std::pair<std::size_t, std::vector<unsigned long>>, std::size_t> places_;
};

BivectorAnsatz::BivectorAnsatz(const Leaves& leaves, const std::vector<Polynomial>& casimirs,
                               const std::vector<Polynomial>& integrals, int degree,
                               const std::vector<Reflection>& reflections)
    : leaves_(leaves), n_(leaves.dimension()), degree_(degree), casimirs_(casimirs) {
  const FunctionRing& ring = leaves.system().functions();
  for (const Polynomial& c : casimirs)
    of_casimirs_.push_back(ring.common_numerators(leaves.gradient(c)));
  for (const Polynomial& f : leaves.ideal())
    of_casimirs_.push_back(ring.common_numerators(leaves.gradient(f)));
  for (const Polynomial& f : integrals)
    of_integrals_.push_back(ring.common_numerators(leaves.gradient(f)));
  make_unknowns(reflections);
}

/// Whether no leading monomial of the level divides it: else it is a sum of others there.
bool BivectorAnsatz::is_standard(const std::vector<unsigned long>& exponents) const {
  if (!leaves_.has_plain_leads()) return true;
  return std::ranges::none_of(leaves_.ideal(), [&](const Polynomial& f) {
    const std::vector<unsigned long> lead = f.term_list().front().second;
    for (std::size_t i = 0; i < n_; ++i)
      if (lead[i] > exponents[i]) return false;
    return true;
  });
}

void BivectorAnsatz::make_unknowns(const std::vector<Reflection>& reflections) {
  const search::Monomials monomials = search::all_monomials(std::vector<int>(n_, 1), degree_);
  const std::vector<std::vector<std::size_t>> pairs = skew_indices(n_, 2);
  for (std::size_t c = 0; c < leaves_.bivector().size(); ++c) {
    for (std::size_t m = 0; m < monomials.size(); ++m) {
      std::vector<unsigned long> exponents(leaves_.ring().size(), 0);
      for (std::size_t i = 0; i < n_; ++i) exponents[i] = monomials[m][i];
      const auto keeps = [&](const Reflection& own) {
        return own.keeps(exponents, pairs[c][0], pairs[c][1]);
      };
      if (!is_standard(exponents) || !std::ranges::all_of(reflections, keeps)) continue;
      places_.emplace(std::pair(c, exponents), unknowns_.size());
      unknowns_.push_back({c, std::move(exponents)});
    }
  }
}

Polynomial BivectorAnsatz::monomial(const Unknown& unknown) const {
  TermCollector collector(leaves_.ring());
  collector.add(1, unknown.exponents);
  return collector.finish();
}

/// What has to vanish on the level, of one summand of the ansatz.
std::vector<Polynomial> BivectorAnsatz::conditions(const Unknown& unknown) const {
  const std::vector<std::size_t> pair = skew_indices(n_, 2)[unknown.component];
  const Polynomial own = monomial(unknown);
  std::vector<Polynomial> result;
  const auto add = [&](const Polynomial& p) { result.push_back(leaves_.reduced(p)); };
  for (const std::vector<Polynomial>& slope : of_casimirs_) {
    for (std::size_t i = 0; i < n_; ++i) {
      if (i == pair[0])
        add(own * slope[pair[1]]);
      else if (i == pair[1])
        add(-(own * slope[pair[0]]));
      else
        result.emplace_back(leaves_.ring());
    }
  }
  for (std::size_t f = 0; f < of_integrals_.size(); ++f) {
    for (std::size_t g = f + 1; g < of_integrals_.size(); ++g) {
      const std::vector<Polynomial>&a = of_integrals_[f], &b = of_integrals_[g];
      add(own * (a[pair[0]] * b[pair[1]] - a[pair[1]] * b[pair[0]]));
    }
  }
  Bivector whole(leaves_.bivector().size(), Polynomial(leaves_.ring()));
  whole[unknown.component] = own;
  for (const Polynomial& defect : schouten(leaves_.bivector(), whole, n_)) add(defect);
  return result;
}

/// A bivector by its coefficients, where the parameters have values modulo a prime; empty where it
/// is none of the ansatz.
std::optional<std::vector<search::Residue>> BivectorAnsatz::coordinates(
    const Bivector& p, const search::Modulus& modulus, const search::Point& point) const {
  std::vector<search::Residue> result(unknowns_.size(), 0);
  for (std::size_t c = 0; c < p.size(); ++c) {
    for (auto [number, exponents] : leaves_.reduced(p[c]).term_list()) {
      search::Residue value = modulus.reduce(number).value_or(0);
      for (std::size_t i = n_; i < exponents.size(); ++i) {
        value = modulus.multiply(value, modulus.power(point[i], exponents[i]));
        exponents[i] = 0;
      }
      const auto place = places_.find({c, exponents});
      if (place == places_.end()) return std::nullopt;
      result[place->second] = modulus.add(result[place->second], value);
    }
  }
  return result;
}

/// The bivectors c*P with products c of Casimir functions: the roots of det(c P - u P) are all c.
std::vector<std::vector<search::Residue>> BivectorAnsatz::trivial(
    const search::Modulus& modulus, const search::Point& point) const {
  std::vector<int> degrees;
  std::vector<Polynomial> functions;
  for (const Polynomial& c : casimirs_) {
    const Polynomial own = leaves_.reduced(c);
    int size = 0;
    for (const auto& [number, exponents] : own.term_list()) {
      int sum = 0;
      for (std::size_t i = 0; i < n_; ++i) sum += static_cast<int>(exponents[i]);
      size = std::max(size, sum);
    }
    if (size == 0) continue;
    degrees.push_back(size);
    functions.push_back(own);
  }
  std::vector<std::vector<search::Residue>> result;
  for (const std::vector<int>& e : search::products_up_to(degrees, degree_, 0)) {
    Polynomial factor = leaves_.ring().constant(1);
    for (std::size_t g = 0; g < e.size(); ++g)
      factor = factor * functions[g].pow(static_cast<unsigned long>(e[g]));
    Bivector own = leaves_.bivector();
    for (Polynomial& component : own) component = component * factor;
    auto vector = coordinates(own, modulus, point);
    if (vector) result.push_back(std::move(*vector));
  }
  return result;
}

Bivector BivectorAnsatz::bivector_of(const ParametricRow& solution) const {
  Bivector result(leaves_.bivector().size(), Polynomial(leaves_.ring()));
  for (const auto& [k, number] : solution)
    result[unknowns_[k].component] += number * monomial(unknowns_[k]);
  return result;
}

BivectorSpace BivectorAnsatz::solve(const search::Watch& watch) {
  std::vector<std::vector<Polynomial>> columns;
  for (const Unknown& unknown : unknowns_) {
    columns.push_back(conditions(unknown));
    watch.tick(static_cast<double>(columns.size()) / static_cast<double>(unknowns_.size()));
  }
  const ConstantKernel kernel = constant_kernel(leaves_.system(), columns, watch);
  const search::Modulus modulus = search::usable_modulus(leaves_.system());
  std::mt19937_64 random(43);
  const std::optional<search::Point> point = leaves_.system().random_point(modulus, random);
  BivectorSpace result;
  if (!point) return result;
  search::Span span(modulus);
  for (std::vector<search::Residue>& own : trivial(modulus, *point)) span.insert(std::move(own));
  result.empty = leaves_.has_plain_leads() && kernel.bound == span.dimension();
  for (const ParametricRow& solution : kernel.basis) {
    Bivector own = bivector_of(solution);
    auto vector = coordinates(own, modulus, *point);
    if (vector && span.insert(std::move(*vector))) result.basis.push_back(std::move(own));
  }
  return result;
}

std::size_t length_of(const Bivector& p) {
  std::size_t sum = 0;
  for (const Polynomial& component : p) {
    for (const auto& [number, exponents] : component.term_list()) {
      sum += number == 1 || number == -1 ? 1 : 2;
      for (const unsigned long e : exponents) sum += e;
    }
  }
  return sum;
}

/// The sum of constants times bivectors, times what leaves no denominator; all zero where there is
/// none.
Bivector combined(const Leaves& leaves, const std::vector<Bivector>& basis,
                  const std::vector<GiNaC::ex>& constants, Prover& prover) {
  GiNaC::ex bottom = 1;
  for (const GiNaC::ex& constant : constants)
    bottom = GiNaC::lcm(bottom, constant.normal().denom());
  Bivector sum(basis.front().size(), Polynomial(leaves.ring()));
  for (std::size_t k = 0; k < basis.size(); ++k) {
    const Polynomial factor = prover.convert((constants[k] * bottom).normal().expand());
    if (factor.is_zero()) continue;
    for (std::size_t c = 0; c < sum.size(); ++c) sum[c] += factor * basis[k][c];
  }
  return sum;
}

/// Some members of each family of solutions of [P', P'] = 0.
std::vector<Bivector> members_of_families(Leaves& leaves, const std::vector<Bivector>& basis,
                                          const search::Watch& watch) {
  const std::size_t n = leaves.dimension(), triples = skew_indices(n, 3).size();
  ConstantEquations equations(leaves.system(), basis.size());
  std::vector<std::vector<ConstantEquations::Summand>> quadratic(triples);
  for (std::size_t s = 0; s < basis.size(); ++s) {
    for (std::size_t t = s; t < basis.size(); ++t) {
      const std::vector<Polynomial> defect = schouten(basis[s], basis[t], n);
      for (std::size_t c = 0; c < triples; ++c) {
        const Polynomial own = leaves.reduced(defect[c]);
        if (!own.is_zero()) quadratic[c].push_back({s == t ? own : own.scaled(2), {s, t}});
      }
    }
    watch.tick(static_cast<double>(s) / static_cast<double>(basis.size()));
  }
  for (const auto& sum : quadratic) equations.add(sum);
  std::vector<Bivector> result;
  for (const search::Branch& family : equations.solve(watch)) {
    if (!family.decided) continue;
    for (const auto& choice : simple_constants(equations.free_in(family).size())) {
      const auto constants = equations.values(family, choice);
      if (constants)
        result.push_back(combined(leaves, basis, *constants, leaves.system().prover()));
    }
  }
  return result;
}

/// The sum of bivectors times 1, 1 + step, 1 + 2*step, ..
Bivector sum_of(const std::vector<const Bivector*>& list, long step) {
  Bivector result(list.front()->size(), Polynomial(list.front()->front().ring()));
  for (std::size_t k = 0; k < list.size(); ++k) {
    const long factor = 1 + step * static_cast<long>(k);
    for (std::size_t c = 0; c < result.size(); ++c) result[c] += (*list[k])[c].scaled(factor);
  }
  return result;
}

/// Sums of vectors of the basis that are Poisson and compatible with each other.
class CompatibleSums {
 public:
  CompatibleSums(const Leaves& leaves, std::vector<Bivector> basis, const search::Watch& watch)
      : leaves_(leaves), basis_(std::move(basis)) {
    std::ranges::stable_sort(basis_, {}, length_of);
    if (basis_.size() > kMostOfCompatible) basis_.resize(kMostOfCompatible, basis_.front());
    for (const Bivector& own : basis_)
      if (compatible(own, own)) single_.push_back(&own);
    for (const Bivector* a : single_) {
      pairs_.emplace_back();
      for (const Bivector* b : single_) pairs_.back().push_back(compatible(*a, *b));
      watch.tick(static_cast<double>(pairs_.size()) / static_cast<double>(single_.size()));
    }
  }

  /// Of one vector, of sets of as many as there are degrees of freedom, and of those that cannot be
  /// made larger.
  std::vector<Bivector> run() {
    for (std::size_t first = 0; first < single_.size(); ++first) {
      take({first}, 0);
      std::vector<std::size_t> set{first};
      for (std::size_t k = 0; k < single_.size(); ++k)
        if (k != first && fits(set, k)) set.push_back(k);
      take(set, 0);
      take(set, 1);
    }
    extend({}, 0);
    return std::move(result_);
  }

 private:
  bool compatible(const Bivector& a, const Bivector& b) const {
    return std::ranges::all_of(schouten(a, b, leaves_.dimension()),
                               [&](const Polynomial& p) { return leaves_.vanishes(p); });
  }
  bool fits(const std::vector<std::size_t>& set, std::size_t k) const {
    return std::ranges::all_of(set, [&](std::size_t s) { return pairs_[s][k]; });
  }
  void take(const std::vector<std::size_t>& set, long step) {
    std::vector<const Bivector*> list;
    for (const std::size_t s : set) list.push_back(single_[s]);
    Bivector sum = sum_of(list, step);
    if (may_have_distinct_roots(leaves_, sum)) result_.push_back(std::move(sum));
  }
  void extend(const std::vector<std::size_t>& set, std::size_t next) {
    if (set.size() == leaves_.degrees_of_freedom()) {
      ++sets_;
      take(set, 0);
      return;
    }
    for (std::size_t k = next; k < single_.size() && sets_ < kMostCompatibleSets; ++k) {
      if (!fits(set, k)) continue;
      std::vector<std::size_t> longer = set;
      longer.push_back(k);
      extend(longer, k + 1);
    }
  }

  const Leaves& leaves_;
  std::vector<Bivector> basis_;
  std::vector<const Bivector*> single_;
  std::vector<std::vector<bool>> pairs_;
  std::vector<Bivector> result_;
  std::size_t sets_ = 0;
};

}  // namespace

BivectorSpace compatible_bivectors(const Leaves& leaves, const std::vector<Polynomial>& casimirs,
                                   const std::vector<Polynomial>& integrals, int degree,
                                   const std::vector<Reflection>& reflections,
                                   const search::Watch& watch) {
  return BivectorAnsatz(leaves, casimirs, integrals, degree, reflections).solve(watch);
}

std::vector<Bivector> poisson_members(Leaves& leaves, const std::vector<Bivector>& basis,
                                      const search::Watch& watch) {
  std::vector<Bivector> all = basis.size() <= kMostOfFamilies
                                  ? members_of_families(leaves, basis, watch)
                                  : CompatibleSums(leaves, basis, watch).run();
  std::ranges::stable_sort(all, {}, length_of);
  std::vector<Bivector> result;
  for (Bivector& own : all) {
    if (std::ranges::all_of(own, [](const Polynomial& c) { return c.is_zero(); })) continue;
    if (std::ranges::none_of(result, [&](const Bivector& p) { return are_proportional(p, own); }))
      result.push_back(std::move(own));
  }
  return result;
}

}  // namespace casimir::structure
