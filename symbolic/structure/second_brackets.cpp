// Second Poisson brackets that are compatible with a first one.
#include <algorithm>

#include "symbolic/structure/bracket_search.hpp"

namespace casimir::structure {
namespace {

class PencilSearch {
 public:
  PencilSearch(const Model& model, int degree, const search::Watch& watch)
      : watch_(watch), model_(model), search_(model, degree_of_motion(model) + 1, watch) {
    report_.degree = degree;
    report_.hamiltonian_degree = degree_of_motion(model) + 1;
  }

  BracketReport run();

 private:
  bool take_first();
  std::vector<Bivector> others(int degree);
  std::vector<search::Branch> solve(const std::vector<Bivector>& basis);
  void take(const ConstantEquations& equations, const std::vector<Bivector>& basis,
            const search::Branch& family);
  std::optional<GiNaC::ex> hamiltonian_of(const Bivector& p);
  std::vector<std::vector<std::string>> chains_of(const Bivector& p);
  std::vector<std::vector<std::string>> chains_of_length(const Bivector& p, std::size_t length);

  const search::Watch& watch_;
  const Model& model_;
  BracketSearch search_;
  Bivector first_;
  std::vector<Bivector> taken_;
  std::optional<ConstantEquations> equations_;
  BracketReport report_;
};

/// The bracket of the case, or the first one that its equations have.
bool PencilSearch::take_first() {
  const std::size_t n = search_.dimension();
  std::vector<GiNaC::ex> upper;
  if (model_.poisson && model_.hamiltonian) {
    for (const auto& pair : skew_indices(n, 2))
      upper.push_back((*model_.poisson)(pair[0], pair[1]));
  } else {
    const BracketReport own = find_brackets(model_, report_.degree, watch_);
    if (own.found.empty()) {
      report_.complete = own.complete;
      report_.reason = own.reason;
      return false;
    }
    upper = own.found.front().upper;
  }
  if (!search_.space().add_tensor(upper)) {
    report_.reason = "the bracket is not one of polynomials that the motion keeps";
    return false;
  }
  search::System& system = search_.space().system();
  for (const GiNaC::ex& component : upper)
    first_.push_back(system.functions().reduced(system.prover().convert(component)));
  report_.first = search_.described(first_, hamiltonian_of(first_));
  if (report_.first->jacobi != Verdict::proved) {
    report_.reason = "the bracket does not obey the Jacobi identity";
    return false;
  }
  return true;
}

/// The invariant bivectors without the first bracket.
std::vector<Bivector> PencilSearch::others(int degree) {
  std::vector<Bivector> result;
  for (const Polynomial& t : search_.space().basis(degree)) {
    Bivector own = search_.space().components(t);
    if (!are_proportional(first_, own)) result.push_back(std::move(own));
  }
  return result;
}

std::vector<search::Branch> PencilSearch::solve(const std::vector<Bivector>& basis) {
  const std::size_t n = search_.dimension(), triples = skew_indices(n, 3).size();
  equations_.emplace(search_.space().system(), basis.size());
  std::vector<std::vector<ConstantEquations::Summand>> linear(triples), quadratic(triples);
  for (std::size_t t = 0; t < basis.size(); ++t) {
    const std::vector<Polynomial> with_first = schouten(first_, basis[t], n);
    for (std::size_t c = 0; c < triples; ++c)
      if (!with_first[c].is_zero()) linear[c].push_back({with_first[c], {t}});
    for (std::size_t s = t; s < basis.size(); ++s) {
      const std::vector<Polynomial> defect = schouten(basis[t], basis[s], n);
      for (std::size_t c = 0; c < triples; ++c) {
        if (!defect[c].is_zero())
          quadratic[c].push_back({s == t ? defect[c] : defect[c].scaled(2), {t, s}});
      }
    }
    watch_.tick(static_cast<double>(t) / static_cast<double>(basis.size()));
  }
  for (const auto& sum : linear) equations_->add(sum);
  for (const auto& sum : quadratic) equations_->add(sum);
  return equations_->solve(watch_);
}

/// H with P dH = X, among the integrals.
std::optional<GiNaC::ex> PencilSearch::hamiltonian_of(const Bivector& p) {
  const std::size_t n = search_.dimension();
  const std::vector<Polynomial>& integrals = search_.integrals();
  ConstantEquations own(search_.space().system(), integrals.size());
  std::vector<std::vector<ConstantEquations::Summand>> motion(n);
  for (std::size_t i = 0; i < n; ++i) motion[i].push_back({-search_.motion()[i], {}});
  for (std::size_t f = 0; f < integrals.size(); ++f) {
    const std::vector<Polynomial> field = hamiltonian_field(p, n, integrals[f]);
    for (std::size_t i = 0; i < n; ++i)
      if (!field[i].is_zero()) motion[i].push_back({field[i], {f}});
  }
  for (const auto& sum : motion) own.add(sum);
  for (const search::Branch& family : own.solve(watch_)) {
    const auto constants = own.values(
        family, std::vector<GiNaC::ex>(own.free_in(family).size(), 0));
    if (constants)
      return (search_.combination(integrals, *constants) / search_.factor_of_motion()).normal();
  }
  return std::nullopt;
}

/// Chains C_0, .., C_length that are no shorter ones.
std::vector<std::vector<std::string>> PencilSearch::chains_of_length(const Bivector& p,
                                                                     std::size_t length) {
  const std::size_t n = search_.dimension();
  const std::vector<Polynomial>& integrals = search_.integrals();
  const std::size_t count = integrals.size();
  ConstantEquations own(search_.space().system(), count * (length + 1));
  // P' dC_k - P dC_(k-1), where C_-1 and C_(length+1) are zero.
  for (std::size_t k = 0; k <= length + 1; ++k) {
    std::vector<std::vector<ConstantEquations::Summand>> link(n);
    for (std::size_t f = 0; f < count; ++f) {
      const auto add = [&](const Bivector& bracket, std::size_t function, int sign) {
        const std::vector<Polynomial> field = hamiltonian_field(bracket, n, integrals[f]);
        for (std::size_t i = 0; i < n; ++i)
          if (!field[i].is_zero())
            link[i].push_back({field[i].scaled(sign), {function * count + f}});
      };
      if (k <= length) add(p, k, 1);
      if (k > 0) add(first_, k - 1, -1);
    }
    for (const auto& sum : link) own.add(sum);
  }
  std::vector<std::vector<std::string>> result;
  for (const search::Branch& family : own.solve(watch_)) {
    const std::size_t free = own.free_in(family).size();
    for (std::size_t one = 0; one < free; ++one) {
      std::vector<GiNaC::ex> values(free, 0);
      values[one] = 1;
      const auto constants = own.values(family, values);
      if (!constants) continue;
      std::vector<std::string> chain;
      for (std::size_t k = 0; k <= length; ++k) {
        const auto begin = constants->begin() + static_cast<std::ptrdiff_t>(k * count);
        const GiNaC::ex function =
            search_.combination(integrals, {begin, begin + static_cast<std::ptrdiff_t>(count)});
        // Where a link is a Casimir function of both, the chain is put together of shorter ones.
        const Polynomial p_function =
            search_.space().system().prover().convert(function.normal().numer().expand());
        const auto kills = [&](const Bivector& bracket) {
          const std::vector<Polynomial> field = hamiltonian_field(bracket, n, p_function);
          return std::all_of(field.begin(), field.end(),
                             [](const Polynomial& entry) { return entry.is_zero(); });
        };
        const bool starts = k == 0 || !kills(p), ends = k == length || !kills(first_);
        if (function.is_zero() || !starts || !ends) break;
        chain.push_back(search_.space().system().text_of(function.expand()));
      }
      if (chain.size() == length + 1) result.push_back(std::move(chain));
    }
  }
  return result;
}

std::vector<std::vector<std::string>> PencilSearch::chains_of(const Bivector& p) {
  constexpr std::size_t kLongest = 3, kMostUnknowns = 60;
  std::vector<std::vector<std::string>> result;
  for (std::size_t length = 1; length <= kLongest; ++length) {
    if (search_.integrals().size() * (length + 1) > kMostUnknowns) break;
    for (auto& chain : chains_of_length(p, length)) result.push_back(std::move(chain));
  }
  return result;
}

/// One member for each free constant, the others zero where they may be.
void PencilSearch::take(const ConstantEquations& equations, const std::vector<Bivector>& basis,
                        const search::Branch& family) {
  const std::size_t free = equations.free_in(family).size();
  std::size_t found = 0;
  for (const std::vector<GiNaC::ex>& choice : simple_constants(free)) {
    if (found == free) return;
    const auto constants = equations.values(family, choice);
    if (!constants) continue;
    const auto [bracket, factor] = search_.combination(basis, *constants);
    if (factor.is_zero()) continue;
    ++found;
    const auto is_known = [&, &own = bracket](const Bivector& other) {
      return are_proportional(other, own);
    };
    if (std::any_of(taken_.begin(), taken_.end(), is_known)) continue;
    taken_.push_back(bracket);
    Bracket second = search_.described(bracket, hamiltonian_of(bracket));
    second.free = free;
    second.chains = chains_of(bracket);
    if (second.jacobi == Verdict::proved) report_.found.push_back(std::move(second));
  }
}

BracketReport PencilSearch::run() {
  const search::System& system = search_.space().system();
  for (const std::size_t place : system.parameters())
    report_.generic.push_back(system.name(place));
  if (!take_first()) return report_;
  std::vector<search::Branch> families;
  for (int degree = 0; degree <= report_.degree; ++degree) {
    search_.space().search_up_to(degree, watch_);
    report_.invariant = search_.space().dimensions().back();
    const std::vector<Bivector> basis = others(degree);
    families.clear();
    if (basis.empty()) continue;
    families = solve(basis);
    for (const search::Branch& family : families)
      if (family.decided) take(*equations_, basis, family);
  }
  const std::optional<std::string> doubt = search_.doubt(families);
  report_.complete = !doubt;
  if (doubt) report_.reason = *doubt;
  return report_;
}

}  // namespace

BracketReport find_second_brackets(const Model& model, int degree, const search::Watch& watch) {
  return PencilSearch(model, degree, watch).run();
}

}  // namespace casimir::structure
