#include "symbolic/search/darboux.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>

#include "symbolic/algebra/number_text.hpp"
#include "symbolic/case/limits.hpp"
#include "symbolic/functions/short_text.hpp"
#include "symbolic/search/darboux_integrals.hpp"
#include "symbolic/search/modular/monomials.hpp"
#include "symbolic/search/polynomial_system.hpp"
#include "symbolic/search/quasi_homogeneous.hpp"
#include "symbolic/search/system.hpp"

namespace casimir::search {
namespace {

using Exponents = std::vector<unsigned long>;

class DarbouxSearch {
 public:
  DarbouxSearch(const Model& model, int degree, const Watch& watch);
  DarbouxReport run();

 private:
  void find_grading();
  int weight(const Monomials& list, std::size_t i) const;
  void search_from(std::size_t leading);
  void look_for_pencils();
  void leave_open(const std::string& reason) {
    report_.complete = false;
    report_.reason = reason;
  }
  bool set_cofactor(DarbouxPolynomial& result, const Polynomial& function);
  int degree_in_coordinates(const Polynomial& p) const;
  std::optional<Polynomial> irreducible(const Polynomial& p) const;
  void add(const Branch& branch, const Polynomial& f, const Polynomial& k);
  Polynomial in_own_ring(const Polynomial& p) const;
  Polynomial monomial(const Monomials& list, std::size_t i) const;
  std::vector<Polynomial> coefficients(const Polynomial& p) const;
  std::optional<Polynomial> in_system_ring(const Polynomial& p) const;

  const Model& model_;
  const Watch& watch_;
  System system_;
  std::size_t dimension_;
  Monomials monomials_, cofactor_monomials_;
  std::size_t first_f_, first_k_;
  /// Where the whole field is quasi-homogeneous: then the cofactor has the weight of 1/t, and the
  /// parts of one weight of a Darboux polynomial are some themselves, all with its cofactor.
  std::optional<Weights> weights_;
  PolynomialRing ring_;  ///< that of the system, the coefficients of F and those of the cofactor
  std::vector<Polynomial> field_;
  std::vector<std::pair<Polynomial, Polynomial>> found_;  ///< with the cofactors
  DarbouxReport report_;
};

int field_growth(const System& system) {
  long degree = 1;
  for (const Polynomial& rate : system.flow()) {
    for (const auto& [number, exponents] : rate.term_list()) {
      long own = 0;
      for (const std::size_t atom : system.atoms()) own += static_cast<long>(exponents[atom]);
      degree = std::max(degree, own);
    }
  }
  return static_cast<int>(degree - 1);
}

std::size_t room_for(const System& system, const Monomials& a, const Monomials& b) {
  return system.ring().size() + a.size() + b.size();
}

DarbouxSearch::DarbouxSearch(const Model& model, int degree, const Watch& watch)
    : model_(model),
      watch_(watch),
      system_(model, {}, {}),
      dimension_(model.variables.size()),
      monomials_(all_monomials(std::vector<int>(dimension_, 1), degree)),
      cofactor_monomials_(all_monomials(std::vector<int>(dimension_, 1), field_growth(system_))),
      first_f_(system_.ring().size()),
      first_k_(first_f_ + monomials_.size()),
      ring_(room_for(system_, monomials_, cofactor_monomials_)) {
  if (model.time || system_.atoms().size() > dimension_)
    throw ModelError(
        "Darboux polynomials need equations of motion that are rational in the variables");
  for (const Polynomial& rate : system_.flow()) field_.push_back(in_own_ring(rate));
  for (const std::size_t place : system_.parameters())
    report_.generic.push_back(system_.name(place));
  find_grading();
}

void DarbouxSearch::find_grading() {
  std::vector<std::string> names;
  for (const GiNaC::symbol& s : model_.variables) names.push_back(s.get_name());
  weights_ = find_weights(field_, names);
  for (std::size_t i = 0; weights_ && i < dimension_; ++i) {
    for (const auto& [number, exponents] : field_[i].term_list()) {
      if (excess(*weights_, i, exponents) == 0) continue;
      weights_.reset();
      break;
    }
  }
}

int DarbouxSearch::weight(const Monomials& list, std::size_t i) const {
  int sum = 0;
  for (std::size_t v = 0; v < dimension_; ++v) sum += weights_->numerators[v] * list[i][v];
  return sum;
}

Polynomial DarbouxSearch::in_own_ring(const Polynomial& p) const {
  TermCollector collector(ring_);
  for (auto [number, exponents] : p.term_list()) {
    exponents.resize(ring_.size(), 0);
    collector.add(number, exponents);
  }
  return collector.finish();
}

/// Empty where coefficients are left.
std::optional<Polynomial> DarbouxSearch::in_system_ring(const Polynomial& p) const {
  TermCollector collector(system_.ring());
  for (auto [number, exponents] : p.term_list()) {
    if (std::any_of(exponents.begin() + static_cast<std::ptrdiff_t>(first_f_), exponents.end(),
                    [](unsigned long e) { return e != 0; }))
      return std::nullopt;
    exponents.resize(first_f_);
    collector.add(number, exponents);
  }
  return collector.finish();
}

Polynomial DarbouxSearch::monomial(const Monomials& list, std::size_t i) const {
  Polynomial result = ring_.constant(1);
  for (std::size_t v = 0; v < dimension_; ++v) result = result * ring_.variable(v).pow(list[i][v]);
  return result;
}

/// Those of the monomials in the coordinates.
std::vector<Polynomial> DarbouxSearch::coefficients(const Polynomial& p) const {
  std::map<Exponents, std::vector<std::pair<cln::cl_RA, Exponents>>> parts;
  for (auto [number, exponents] : p.term_list()) {
    const Exponents own(exponents.begin(),
                        exponents.begin() + static_cast<std::ptrdiff_t>(dimension_));
    std::fill(exponents.begin(), exponents.begin() + static_cast<std::ptrdiff_t>(dimension_), 0);
    parts[own].emplace_back(number, exponents);
  }
  std::vector<Polynomial> result;
  for (const auto& [own, terms] : parts) {
    TermCollector collector(ring_);
    for (const auto& [number, exponents] : terms) collector.add(number, exponents);
    result.push_back(collector.finish());
  }
  return result;
}

/// Read off the rate by the equations of motion. The fields of the search are a multiple of them
/// where these have denominators: that has the same Darboux polynomials, but other cofactors.
bool DarbouxSearch::set_cofactor(DarbouxPolynomial& result, const Polynomial& function) {
  Prover& prover = system_.prover();
  const auto rate = prover.ring().lowest_terms(prover.convert(model_.rate(result.value)));
  Polynomial top(system_.ring());
  if (!rate.first.divide(function, &top)) return false;
  const cln::cl_RA number = rate.second.content();
  top = top.scaled(1 / number);
  const Polynomial bottom = rate.second.scaled(1 / number);
  const auto text = [&](const Polynomial& p) { return prover.ring().text(p); };
  result.cofactor =
      bottom.is_constant() ? text(top) : quotient_text(text(top), top.terms() > 1, text(bottom));
  result.cofactor_value = system_.expression(top) / system_.expression(bottom);
  return true;
}

/// The degree in the coordinates: parameters are elements of the field.
int DarbouxSearch::degree_in_coordinates(const Polynomial& p) const {
  unsigned long degree = 0;
  for (const auto& [number, exponents] : p.term_list()) {
    const auto end = exponents.begin() + static_cast<std::ptrdiff_t>(dimension_);
    degree = std::max(degree, std::accumulate(exponents.begin(), end, 0UL));
  }
  return static_cast<int>(degree);
}

/// The irreducible polynomial over the field of the parameters that p is up to a factor from that
/// field; empty where p is a product of others, which are found on their own. Gauss's lemma: what
/// is irreducible over Q, and has a coordinate, is irreducible over Q(parameters).
std::optional<Polynomial> DarbouxSearch::irreducible(const Polynomial& p) const {
  std::optional<Polynomial> result;
  for (const auto& [factor, exponent] : p.factors()) {
    if (degree_in_coordinates(factor) == 0) continue;
    if (result || exponent > 1) return std::nullopt;
    result = factor.scaled(1 / factor.content());
  }
  return result;
}

void DarbouxSearch::add(const Branch& branch, const Polynomial& f, const Polynomial& k) {
  const Polynomial function = branch.reduced(f), cofactor = branch.reduced(k);
  if (cofactor.is_zero()) return;  // an integral
  if (!branch.decided) {
    leave_open("some equations for the coefficients could not be solved exactly");
    return;
  }
  const std::optional<Polynomial> own = in_system_ring(function);
  if (!own) {
    // Coefficients that are algebraic numbers, or free: complex conjugates, or a pencil.
    leave_open(
        "there are Darboux polynomials with coefficients that are algebraic numbers, or families "
        "of them; these are not shown");
    return;
  }
  const std::optional<Polynomial> primitive = irreducible(*own);
  if (!primitive) return;
  DarbouxPolynomial result;
  result.degree = degree_in_coordinates(*primitive);
  result.value = system_.expression(*primitive);
  result.text = short_text(system_.prover().ring(), *primitive, system_.is_constant());
  const auto same = [&](const auto& other) { return other.first == *primitive; };
  if (std::ranges::any_of(found_, same)) return;
  Polynomial rate(system_.ring()), quotient(system_.ring());  // of the search's own fields
  for (std::size_t i = 0; i < dimension_; ++i) rate += primitive->derivative(i) * system_.flow()[i];
  if (!set_cofactor(result, *primitive) || !rate.divide(*primitive, &quotient)) {
    leave_open(fmt::format("'{}' was found and its cofactor was not", result.text));
    return;
  }
  result.verdict =
      prove_claim(model_, ClaimKind::invariant_relation, {result.text, result.value, {}}).verdict;
  report_.found.push_back(std::move(result));
  found_.emplace_back(*primitive, quotient);
}

/// A sum of quasi-homogeneous ones of different weights that have one cofactor was not looked for.
/// It is irreducible only if two of its parts, without what they have in common, are products of
/// those found with one cofactor; where one of them is 1, the sum is an integral.
void DarbouxSearch::look_for_pencils() {
  std::vector<int> degrees;
  for (const auto& [function, cofactor] : found_)
    degrees.push_back(degree_in_coordinates(function));
  const int degree = monomials_.degree(monomials_.size() - 1);
  const std::vector<std::vector<int>> products = products_up_to(degrees, degree, 0);
  std::vector<Polynomial> cofactors;
  for (const std::vector<int>& exponents : products) {
    Polynomial sum(system_.ring());
    for (std::size_t i = 0; i < exponents.size(); ++i) sum += found_[i].second.scaled(exponents[i]);
    cofactors.push_back(std::move(sum));
  }
  const auto is_one = [](const std::vector<int>& exponents) {
    return std::ranges::all_of(exponents, [](int e) { return e == 0; });
  };
  const auto coprime = [](const std::vector<int>& a, const std::vector<int>& b) {
    for (std::size_t k = 0; k < a.size(); ++k)
      if (a[k] > 0 && b[k] > 0) return false;
    return true;
  };
  for (std::size_t i = 0; i < products.size(); ++i) {
    for (std::size_t j = 0; j < i && !is_one(products[i]); ++j) {
      if (is_one(products[j]) || !(cofactors[i] == cofactors[j])) continue;
      if (!coprime(products[i], products[j])) continue;
      leave_open(
          "products of those found have the same cofactor, and their sums are further ones, which "
          "are not shown");
      return;
    }
  }
}

/// All with this leading monomial: its coefficient is 1, and those of later monomials are 0.
void DarbouxSearch::search_from(std::size_t leading) {
  Polynomial f = monomial(monomials_, leading);
  std::vector<std::size_t> unknowns;
  for (std::size_t i = 0; i < leading; ++i) {
    if (weights_ && weight(monomials_, i) != weight(monomials_, leading)) continue;
    f += ring_.variable(first_f_ + i) * monomial(monomials_, i);
    unknowns.push_back(first_f_ + i);
  }
  Polynomial k(ring_);
  for (std::size_t i = 0; i < cofactor_monomials_.size(); ++i) {
    if (weights_ && weight(cofactor_monomials_, i) != weights_->denominator) continue;
    k += ring_.variable(first_k_ + i) * monomial(cofactor_monomials_, i);
    unknowns.push_back(first_k_ + i);
  }
  Polynomial residual = -(k * f);
  for (std::size_t i = 0; i < dimension_; ++i) residual += f.derivative(i) * field_[i];
  for (const Branch& branch : solve_system(coefficients(residual), unknowns, watch_))
    add(branch, f, k);
}

DarbouxReport DarbouxSearch::run() {
  report_.complete = true;
  watch_.begin("Darboux polynomials");
  const WorkMeter meter(system_.model().limits);  // of all systems of equations together
  for (std::size_t leading = 1; leading < monomials_.size(); ++leading) {
    watch_.tick(static_cast<double>(leading) / static_cast<double>(monomials_.size()));
    try {
      search_from(leading);
    } catch (const TooLarge& limit) {
      leave_open(limit.what());
    }
  }
  if (weights_) look_for_pencils();
  // Roots and functions of parameters are taken as free of relations.
  for (const std::size_t place : system_.parameters()) {
    if (place >= system_.functions().symbols().size())
      leave_open(fmt::format("'{}' is taken as a parameter of its own", system_.name(place)));
  }
  for (const DarbouxPolynomial& found : report_.found) {
    if (found.verdict != Verdict::proved)
      leave_open(fmt::format("'{}' was found but not proved", found.text));
  }
  return report_;
}

}  // namespace

std::string to_string(DarbouxCombination::Kind kind) {
  switch (kind) {
    case DarbouxCombination::Kind::integral:
      return "integral";
    case DarbouxCombination::Kind::multiplier:
      return "multiplier";
    case DarbouxCombination::Kind::time_dependent:
      break;
  }
  return "time_dependent";
}

DarbouxReport find_darboux(const Model& model, int degree, const Watch& watch) {
  constexpr int kHighest = 6;
  if (degree > kHighest)
    throw ModelError(fmt::format("Darboux polynomials are searched up to degree {}", kHighest));
  DarbouxReport report = DarbouxSearch(model, degree, watch).run();
  report.combinations = combine(model, report.found, degree, watch, &report.all_integrals_combined);
  return report;
}

RationalReport find_rational(const Model& model, int degree, const Watch& watch) {
  DarbouxReport report = find_darboux(model, degree, watch);
  const bool only_rational = std::ranges::none_of(report.combinations, [](const auto& own) {
    return own.kind == DarbouxCombination::Kind::integral && !own.rational;
  });
  RationalReport result;
  result.complete = report.complete && report.all_integrals_combined && only_rational;
  result.reason = report.reason;
  if (result.reason.empty() && !result.complete)
    result.reason = "whether other products are integrals was not decided";
  result.generic = report.generic;
  for (DarbouxCombination& own : report.combinations)
    if (own.rational) result.integrals.push_back(std::move(own));
  return result;
}

}  // namespace casimir::search
