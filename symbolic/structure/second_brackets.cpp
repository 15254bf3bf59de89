// Second Poisson brackets that are compatible with a first one.
#include <algorithm>

#include "symbolic/algebra/rational_matrix.hpp"
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
  void take(const std::vector<Bivector>& basis, const std::vector<search::Branch>& families);
  void compare();
  std::vector<std::vector<std::string>> chains_of(const Bivector& p);
  void add_links(ConstantEquations& equations, const Bivector& p, std::size_t length);
  std::optional<std::vector<cln::cl_RA>> at_simple_parameters(
      const std::vector<GiNaC::ex>& constants) const;
  std::vector<std::string> chain_text(const Bivector& p, const std::vector<GiNaC::ex>& constants,
                                      std::size_t length);

  const search::Watch& watch_;
  const Model& model_;
  BracketSearch search_;
  Bivector first_;
  std::vector<Bivector> taken_;
  bool unshown_ = false;  ///< of some family no member was found
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
      report_.invariant = own.invariant;
      report_.complete = own.complete;
      report_.reason = own.reason;
      return false;
    }
    upper = own.found.front().upper;
  }
  std::optional<Bivector> first = search_.space().polynomials(upper);
  if (!first || !search_.space().add_tensor(upper)) {
    report_.reason = "the bracket is not one of polynomials that the motion keeps";
    return false;
  }
  first_ = std::move(*first);
  report_.first = search_.described(first_, search_.hamiltonian_of(first_));
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

/// The equations P' dC_k = P dC_(k-1) for chains C_0, .., C_length, where C_-1 and C_(length+1)
/// are zero. The unknowns are the constants of C_0, then those of C_1, ..
void PencilSearch::add_links(ConstantEquations& equations, const Bivector& p, std::size_t length) {
  const std::size_t n = search_.dimension();
  const std::vector<Polynomial>& integrals = search_.integrals();
  for (std::size_t k = 0; k <= length + 1; ++k) {
    std::vector<std::vector<ConstantEquations::Summand>> link(n);
    for (std::size_t f = 0; f < integrals.size(); ++f) {
      const auto add = [&](const Bivector& bracket, std::size_t function, int sign) {
        const std::vector<Polynomial> field = hamiltonian_field(bracket, n, integrals[f]);
        for (std::size_t i = 0; i < n; ++i)
          if (!field[i].is_zero())
            link[i].push_back({field[i].scaled(sign), {function * integrals.size() + f}});
      };
      if (k <= length) add(p, k, 1);
      if (k > 0) add(first_, k - 1, -1);
    }
    for (const auto& sum : link) equations.add(sum);
  }
}

/// Chains that are not made of shorter ones: of these, with zeros before and behind them, they are
/// no linear combination, at simple values of the parameters.
std::vector<std::vector<std::string>> PencilSearch::chains_of(const Bivector& p) {
  constexpr std::size_t kLongest = 3, kMostUnknowns = 60;
  const std::size_t count = search_.integrals().size();
  std::vector<std::vector<std::string>> result;
  std::vector<std::vector<cln::cl_RA>> shorter;
  for (std::size_t length = 0; length <= kLongest; ++length) {
    if (count * (length + 1) > kMostUnknowns) break;
    RationalMatrix rows;
    for (const std::vector<cln::cl_RA>& chain : shorter) {
      for (std::size_t shift = 0; chain.size() + shift * count <= count * (length + 1); ++shift) {
        rows.emplace_back(count * (length + 1), 0);
        std::copy(chain.begin(), chain.end(),
                  rows.back().begin() + static_cast<std::ptrdiff_t>(shift * count));
      }
    }
    std::size_t known = rank(rows);
    ConstantEquations own(search_.space().system(), count * (length + 1));
    add_links(own, p, length);
    for (const search::Branch& family : own.solve(watch_)) {
      const std::size_t free = own.free_in(family).size();
      for (std::size_t one = 0; one < free; ++one) {
        std::vector<GiNaC::ex> values(free, 0);
        values[one] = 1;
        const auto constants = own.values(family, values);
        if (!constants) continue;
        const auto numbers = at_simple_parameters(*constants);
        if (!numbers) continue;
        rows.push_back(*numbers);
        if (rank(rows) == known) {
          rows.pop_back();
          continue;
        }
        ++known;
        shorter.push_back(*numbers);
        std::vector<std::string> chain = chain_text(p, *constants, length);
        if (!chain.empty()) result.push_back(std::move(chain));
      }
    }
  }
  return result;
}

std::optional<std::vector<cln::cl_RA>> PencilSearch::at_simple_parameters(
    const std::vector<GiNaC::ex>& constants) const {
  GiNaC::exmap values;
  int next = 3;
  for (const GiNaC::symbol& parameter : model_.parameters) {
    values[parameter] = GiNaC::numeric(next, next + 2);
    next = next * 2 + 1;
  }
  std::vector<cln::cl_RA> result;
  for (const GiNaC::ex& constant : constants) {
    const GiNaC::ex parts = constant.numer_denom().subs(values);
    if (!GiNaC::is_a<GiNaC::numeric>(parts.op(0)) || !GiNaC::is_a<GiNaC::numeric>(parts.op(1)) ||
        parts.op(1).is_zero())
      return std::nullopt;
    const GiNaC::numeric number =
        GiNaC::ex_to<GiNaC::numeric>(parts.op(0)) / GiNaC::ex_to<GiNaC::numeric>(parts.op(1));
    if (!number.is_rational()) return std::nullopt;
    result.push_back(cln::the<cln::cl_RA>(number.to_cl_N()));
  }
  return result;
}

/// All functions of a chain times one constant, so that they have no denominators; empty where the
/// links are not what they have to be.
std::vector<std::string> PencilSearch::chain_text(const Bivector& p,
                                                  const std::vector<GiNaC::ex>& constants,
                                                  std::size_t length) {
  const std::size_t n = search_.dimension();
  std::vector<Bivector> basis;
  for (std::size_t k = 0; k <= length; ++k) {
    for (const Polynomial& f : search_.integrals()) {
      basis.emplace_back(length + 1, Polynomial(f.ring()));
      basis.back()[k] = f;
    }
  }
  const std::vector<Polynomial> chain = search_.combination(basis, constants).first;
  std::vector<Polynomial> rest(n, Polynomial(chain.front().ring()));
  for (const Polynomial& f : chain) {
    if (!(hamiltonian_field(p, n, f) == rest)) return {};
    rest = hamiltonian_field(first_, n, f);
  }
  if (!std::ranges::all_of(rest, [](const Polynomial& entry) { return entry.is_zero(); }))
    return {};
  std::vector<std::string> result;
  for (const Polynomial& f : chain)
    result.push_back(search_.text_of(search_.space().system().expression(f)));
  return result;
}

/// The shortest members of all families that are no combinations of others.
void PencilSearch::take(const std::vector<Bivector>& basis,
                        const std::vector<search::Branch>& families) {
  std::vector<Bivector> candidates;
  unshown_ = false;
  for (const search::Branch& family : families) {
    if (!family.decided) continue;
    const std::size_t before = candidates.size(), free = equations_->free_in(family).size();
    bool only_zero = free == 0;
    for (const auto& choice : simple_constants(free)) {
      const auto constants = equations_->values(family, choice);
      if (!constants) continue;
      auto [bracket, factor] = search_.combination(basis, *constants);
      if (!factor.is_zero()) {
        candidates.push_back(std::move(bracket));
        only_zero = false;
      }
    }
    unshown_ = unshown_ || (!only_zero && candidates.size() == before);
  }
  std::vector<Bivector> known = taken_;
  known.push_back(first_);
  for (const Bivector& p : search_.shortest_independent(std::move(candidates), known)) {
    Bracket second = search_.described(p, search_.hamiltonian_of(p));
    if (second.jacobi != Verdict::proved) continue;
    second.chains = chains_of(p);
    taken_.push_back(p);
    report_.found.push_back(std::move(second));
  }
}

void PencilSearch::compare() {
  for (std::size_t i = 0; i < taken_.size(); ++i) {
    for (std::size_t j = 0; j < taken_.size(); ++j) {
      if (i == j) continue;
      const std::vector<Polynomial> both = schouten(taken_[i], taken_[j], search_.dimension());
      if (std::all_of(both.begin(), both.end(), [](const Polynomial& c) { return c.is_zero(); }))
        report_.found[i].compatible.push_back(j);
    }
  }
}

BracketReport PencilSearch::run() {
  const search::System& system = search_.space().system();
  report_.generic = system.generic_parameters();
  if (!take_first()) return report_;
  std::vector<search::Branch> families;
  for (int degree = 0; degree <= report_.degree; ++degree) {
    search_.space().search_up_to(degree, watch_);
    report_.invariant = search_.space().dimensions().back();
    const std::vector<Bivector> basis = others(degree);
    families.clear();
    if (basis.empty()) continue;
    families = solve(basis);
    take(basis, families);
  }
  compare();
  report_.families = families.size();
  const std::size_t own = report_.first->degree <= report_.degree ? 1 : 0;
  report_.spanned = report_.found.size() + own == report_.invariant;
  // Where the invariant bivectors are spanned, the equations need not have been solved.
  if (search_.space().complete() && report_.spanned) {
    report_.complete = true;
    return report_;
  }
  const std::optional<std::string> doubt = search_.doubt(families);
  if (doubt)
    report_.reason = *doubt;
  else if (search_.space().basis(report_.degree).size() != report_.invariant)
    report_.reason = "the invariant bivectors were not all put together";
  else if (unshown_)
    report_.reason = "no simple values of the constants give a bracket that was proved";
  report_.complete = report_.reason.empty();
  return report_;
}

}  // namespace

BracketReport find_second_brackets(const Model& model, int degree, const search::Watch& watch) {
  return PencilSearch(model, degree, watch).run();
}

}  // namespace casimir::structure
