// Poisson brackets of given equations of motion.
#include "symbolic/structure/brackets.hpp"

#include <algorithm>
#include <numeric>

#include "symbolic/structure/bracket_search.hpp"

namespace casimir::structure {
namespace {

class HamiltonianSearch {
 public:
  HamiltonianSearch(const Model& model, int degree, const search::Watch& watch)
      : watch_(watch), search_(model, degree_of_motion(model) + 1, watch) {
    report_.degree = degree;
    report_.hamiltonian_degree = degree_of_motion(model) + 1;
  }

  BracketReport run();

 private:
  void search_degree(int degree, bool last);
  void add_jacobi(std::size_t first);
  void add_motion();
  void try_simple_brackets();
  std::vector<search::Branch> solve_all();
  bool collect(const search::Branch& family);
  void take();

  const search::Watch& watch_;
  BracketSearch search_;
  std::vector<Bivector> basis_;       ///< of the invariant bivectors
  std::vector<Bivector> candidates_;  ///< that solve all equations
  std::vector<GiNaC::ex> hamiltonians_;
  std::vector<Bivector> taken_;
  bool unshown_ = false;                        ///< of some family no member was found
  std::optional<ConstantEquations> equations_;  ///< whose ring the families of solutions use
  BracketReport report_;
};

/// The Jacobi identity for the constants of a bracket, which are the unknowns from `first` on.
void HamiltonianSearch::add_jacobi(std::size_t first) {
  const std::size_t n = search_.dimension();
  std::vector<std::vector<ConstantEquations::Summand>> jacobi(skew_indices(n, 3).size());
  for (std::size_t t = 0; t < basis_.size(); ++t) {
    for (std::size_t s = t; s < basis_.size(); ++s) {
      watch_.tick(static_cast<double>(t) / static_cast<double>(basis_.size()));
      const std::vector<Polynomial> defect = schouten(basis_[t], basis_[s], n);
      for (std::size_t c = 0; c < defect.size(); ++c) {
        if (!defect[c].is_zero())
          jacobi[c].push_back({s == t ? defect[c] : defect[c].scaled(2), {first + t, first + s}});
      }
    }
  }
  for (const auto& sum : jacobi) equations_->add(sum);
}

/// P dH = X; the constants of the Hamiltonian are the first unknowns.
void HamiltonianSearch::add_motion() {
  const std::size_t n = search_.dimension(), functions = search_.all_integrals().size();
  std::vector<std::vector<ConstantEquations::Summand>> motion(n);
  for (std::size_t i = 0; i < n; ++i) motion[i].push_back({-search_.motion()[i], {}});
  for (std::size_t t = 0; t < basis_.size(); ++t) {
    for (std::size_t f = 0; f < functions; ++f) {
      const std::vector<Polynomial> field =
          hamiltonian_field(basis_[t], n, search_.all_integrals()[f]);
      for (std::size_t i = 0; i < n; ++i)
        if (!field[i].is_zero()) motion[i].push_back({field[i], {f, functions + t}});
    }
  }
  for (const auto& sum : motion) equations_->add(sum);
}

/// Simple solutions of the Jacobi identity that have a Hamiltonian. This finds most brackets at
/// once, and where they span all invariant bivectors there is nothing else to solve.
void HamiltonianSearch::try_simple_brackets() {
  equations_.emplace(search_.space().system(), basis_.size());
  add_jacobi(0);
  for (const search::Branch& family : equations_->solve(watch_)) {
    if (!family.decided) continue;
    const std::size_t free = equations_->free_in(family).size();
    std::size_t found = 0;
    for (const std::vector<GiNaC::ex>& choice : simple_constants(free)) {
      if (found > 2 * free) break;
      watch_.tick(0.5);
      const auto constants = equations_->values(family, choice);
      if (!constants) continue;
      auto [bracket, factor] = search_.combination(basis_, *constants);
      if (factor.is_zero()) continue;
      const std::optional<GiNaC::ex> h = search_.hamiltonian_of(bracket);
      if (!h) continue;
      ++found;
      candidates_.push_back(std::move(bracket));
      hamiltonians_.push_back(*h);
    }
  }
  take();
}

/// Simple members of a family, with their Hamiltonians; false where none was found.
bool HamiltonianSearch::collect(const search::Branch& family) {
  const std::size_t functions = search_.all_integrals().size(), before = candidates_.size();
  const std::vector<std::size_t> free = equations_->free_in(family);
  // The constants of the bracket first: those of the Hamiltonian may well be zero.
  std::vector<std::size_t> order(free.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_partition(order.begin(), order.end(),
                        [&](std::size_t k) { return free[k] >= functions; });
  for (const std::vector<GiNaC::ex>& choice : simple_constants(free.size())) {
    std::vector<GiNaC::ex> values(free.size());
    for (std::size_t k = 0; k < order.size(); ++k) values[order[k]] = choice[k];
    const auto constants = equations_->values(family, values);
    if (!constants) continue;
    const auto middle = constants->begin() + static_cast<std::ptrdiff_t>(functions);
    auto [bracket, factor] = search_.combination(basis_, {middle, constants->end()});
    if (factor.is_zero()) continue;
    const GiNaC::ex h = search_.combination(search_.all_integrals(), {constants->begin(), middle}) /
                        (factor * search_.factor_of_motion());
    candidates_.push_back(std::move(bracket));
    hamiltonians_.push_back(h.normal());
  }
  return candidates_.size() > before;
}

void HamiltonianSearch::take() {
  if (candidates_.empty()) return;
  for (const Bivector& p : search_.shortest_independent(candidates_, taken_)) {
    const auto place = std::find(candidates_.begin(), candidates_.end(), p);
    const GiNaC::ex h = hamiltonians_[static_cast<std::size_t>(place - candidates_.begin())];
    Bracket found = search_.described(p, h);
    if (found.jacobi != Verdict::proved || found.motion != Verdict::proved) continue;
    taken_.push_back(p);
    report_.found.push_back(std::move(found));
  }
}

void HamiltonianSearch::search_degree(int degree, bool last) {
  search_.space().search_up_to(degree, watch_);
  report_.invariant = search_.space().dimensions().back();
  basis_.clear();
  candidates_.clear();
  hamiltonians_.clear();
  for (const Polynomial& t : search_.space().basis(degree))
    basis_.push_back(search_.space().components(t));
  if (!basis_.empty() && !search_.integrals().empty()) try_simple_brackets();
  if (!last) return;
  report_.spanned = report_.found.size() == report_.invariant;
  if (search_.space().complete() && report_.spanned && !basis_.empty()) {
    report_.families = 1;
    report_.complete = true;
    return;
  }
  const std::vector<search::Branch> families = solve_all();
  report_.families = families.size();
  report_.spanned = report_.found.size() == report_.invariant;
  const std::optional<std::string> doubt = search_.doubt(families);
  report_.whatever_hamiltonian = basis_.empty();
  if (doubt)
    report_.reason = *doubt;
  else if (basis_.size() != report_.invariant)
    report_.reason = "the invariant bivectors were not all put together";
  else if (!basis_.empty() && !search_.integrals_are_all())
    report_.reason = "the polynomial integrals, of which the Hamiltonian is one, may not be all";
  else if (unshown_ || (report_.found.empty() && !families.empty()))
    report_.reason = "no simple values of the constants give a bracket that was proved";
  report_.complete = report_.reason.empty();
}

/// The equations for bracket and Hamiltonian together, solved by cases.
std::vector<search::Branch> HamiltonianSearch::solve_all() {
  if (basis_.empty() || search_.integrals().empty()) return {};
  const std::size_t functions = search_.all_integrals().size();
  equations_.emplace(search_.space().system(), functions + basis_.size());
  add_motion();
  add_jacobi(functions);
  std::vector<search::Branch> families = equations_->solve(watch_);
  candidates_.clear();
  hamiltonians_.clear();
  for (const search::Branch& family : families)
    if (family.decided && !collect(family)) unshown_ = true;
  take();
  return families;
}

BracketReport HamiltonianSearch::run() {
  for (int degree = 0; degree <= report_.degree; ++degree)
    search_degree(degree, degree == report_.degree);
  const search::System& system = search_.space().system();
  report_.generic = system.generic_parameters();
  return report_;
}

}  // namespace

BracketReport find_brackets(const Model& model, int degree, const search::Watch& watch) {
  return HamiltonianSearch(model, degree, watch).run();
}

}  // namespace casimir::structure
