#include "symbolic/search/darboux.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "symbolic/algebra/number_text.hpp"
#include "symbolic/case/limits.hpp"
#include "symbolic/functions/short_text.hpp"
#include "symbolic/model/bare_motion.hpp"
#include "symbolic/search/conditions/special_values.hpp"
#include "symbolic/search/darboux_equations.hpp"
#include "symbolic/search/darboux_integrals.hpp"
#include "symbolic/search/finder.hpp"
#include "symbolic/search/polynomial_system.hpp"

namespace casimir::search {
namespace {

class DarbouxSearch {
 public:
  DarbouxSearch(const Model& model, int degree, const Watch& watch);
  DarbouxReport run();

 private:
  void search_from(std::size_t leading);
  void look_for_pencils();
  void leave_open(const std::string& reason) {
    report_.complete = false;
    report_.reason = reason;
  }
  bool set_cofactor(DarbouxPolynomial& result, const Polynomial& function);
  Verdict prove_rate(const DarbouxPolynomial& polynomial) const;
  bool hides_integral(const Polynomial& relation, std::size_t root,
                      const Polynomial& product) const;
  bool follows_from_others(const Branch& branch, const Polynomial& function) const;
  void add(const Branch& branch, const Polynomial& f, const Polynomial& k);

  const Model& model_;
  const Watch& watch_;
  DarbouxEquations equations_;
  System& system_;
  std::vector<std::pair<Polynomial, Polynomial>> found_;  ///< with the cofactors
  DarbouxReport report_;
};

DarbouxSearch::DarbouxSearch(const Model& model, int degree, const Watch& watch)
    : model_(model), watch_(watch), equations_(model, degree), system_(equations_.system()) {
  report_.generic = system_.generic_parameters();
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

/// dF/dt = K F as an identity: F w is an integral of the equations with dw/dt = -K w beside them.
/// That F = 0 is an invariant level is less, and empty where F has no real zeros.
Verdict DarbouxSearch::prove_rate(const DarbouxPolynomial& polynomial) const {
  Model extended = bare_motion(model_);
  const GiNaC::symbol factor("<w>");
  extended.variables.push_back(factor);
  extended.field.push_back(-polynomial.cofactor_value * factor);
  return prove_claim(extended, ClaimKind::integral,
                     {polynomial.text, polynomial.value * factor, {}})
      .verdict;
}

/// Whether a product of conjugates has an integral for a factor, where one of them may be real.
/// \param relation  of the root in the coefficients
bool DarbouxSearch::hides_integral(const Polynomial& relation, std::size_t root,
                                   const Polynomial& product) const {
  std::size_t unknowns = 0;
  for (std::size_t place = 0; place < equations_.ring().size(); ++place)
    unknowns += relation.uses(place) ? 1 : 0;
  if (unknowns == 1 && real_roots(relation, root) == 0) return false;
  return std::ranges::any_of(product.factors(), [&](const auto& own) {
    return equations_.degree_in_coordinates(own.first) > 0 && equations_.rate(own.first).is_zero();
  });
}

/// Whether all factors of functions with coefficients that are free, or roots of an irreducible
/// polynomial, are integrals or factors of polynomials without such coefficients, which are found
/// on their own. With a root: of the product of all conjugates, as x*(y + i*z), of which it is one.
/// With free ones: for a Darboux polynomial of the family that is irreducible is one of the
/// factors.
///
/// An integral is none of those that are found: x - sqrt(2)*y, of x^2 - 2*y^2 that is one, would
/// leave no trace (hides_integral).
bool DarbouxSearch::follows_from_others(const Branch& branch, const Polynomial& function) const {
  if (branch.rest.size() > 1) return false;
  Polynomial product = function;
  if (branch.rest.size() == 1) {
    const Polynomial& relation = branch.rest[0];
    std::vector<std::size_t> roots;
    for (std::size_t place = system_.ring().size(); place < equations_.ring().size(); ++place)
      if (relation.uses(place)) roots.push_back(place);
    if (roots.size() != 1) return false;
    if (function.uses(roots[0])) {
      product = resultant(relation, function, roots[0]);
      if (hides_integral(relation, roots[0], product)) return false;
    }
  }
  const Monomials& monomials = equations_.monomials();
  for (const auto& [factor, exponent] : product.factors()) {
    const int degree = equations_.degree_in_coordinates(factor);
    if (degree == 0) continue;
    if (degree > monomials.degree(monomials.size() - 1)) return false;
    if (equations_.in_system_ring(factor)) continue;
    // With a root as well, factors of an integral over the rational numbers need not be integrals.
    if (!branch.rest.empty() || !equations_.rate(factor).is_zero()) return false;
  }
  return true;
}

void DarbouxSearch::add(const Branch& branch, const Polynomial& f, const Polynomial& k) {
  const Polynomial function = branch.reduced(f), cofactor = branch.reduced(k);
  if (cofactor.is_zero()) return;  // an integral
  if (!branch.decided) {
    leave_open("some equations for the coefficients could not be solved exactly");
    return;
  }
  const std::optional<Polynomial> own = equations_.in_system_ring(function);
  if (!own) {
    // Coefficients that are algebraic numbers, or free: complex conjugates, or a pencil.
    if (follows_from_others(branch, function)) {
      for (const Polynomial& relation : branch.rest) {
        report_.has_conjugates = true;
        for (std::size_t place = model_.variables.size(); place < system_.ring().size(); ++place)
          if (relation.uses(place)) report_.has_moving_conjugates = true;
      }
      return;
    }
    leave_open(
        "there are Darboux polynomials with coefficients that are algebraic numbers, or families "
        "of them; these are not shown");
    return;
  }
  const std::optional<Polynomial> primitive = equations_.irreducible(*own);
  if (!primitive) return;
  DarbouxPolynomial result;
  result.degree = equations_.degree_in_coordinates(*primitive);
  result.value = system_.expression(*primitive);
  result.text = short_text(system_.prover().ring(), *primitive, system_.is_constant());
  const auto same = [&](const auto& other) { return other.first == *primitive; };
  if (std::ranges::any_of(found_, same)) return;
  Polynomial rate(system_.ring()), quotient(system_.ring());  // of the search's own fields
  for (std::size_t i = 0; i < model_.variables.size(); ++i)
    rate += primitive->derivative(i) * system_.flow()[i];
  if (!set_cofactor(result, *primitive) || !rate.divide(*primitive, &quotient)) {
    leave_open(fmt::format("'{}' was found and its cofactor was not", result.text));
    return;
  }
  result.verdict = prove_rate(result);
  report_.found.push_back(std::move(result));
  found_.emplace_back(*primitive, quotient);
}

/// A sum of quasi-homogeneous ones of different weights that have one cofactor was not looked for.
/// It is irreducible only if two of its parts, without what they have in common, are products of
/// those found with one cofactor; where one of them is 1, the sum is an integral.
void DarbouxSearch::look_for_pencils() {
  std::vector<int> degrees;
  for (const auto& [function, cofactor] : found_)
    degrees.push_back(equations_.degree_in_coordinates(function));
  const int degree = equations_.monomials().degree(equations_.monomials().size() - 1);
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

void DarbouxSearch::search_from(std::size_t leading) {
  const auto [f, k, unknowns, equations] = equations_.of(leading, equations_.has_weights());
  for (const Branch& branch : solve_system(equations, unknowns, watch_)) add(branch, f, k);
}

DarbouxReport DarbouxSearch::run() {
  report_.complete = true;
  const Monomials& monomials = equations_.monomials();
  watch_.begin("Darboux polynomials");
  const WorkMeter meter(system_.model().limits);  // of all systems of equations together
  for (std::size_t leading = 1; leading < monomials.size(); ++leading) {
    watch_.tick(static_cast<double>(leading) / static_cast<double>(monomials.size()));
    try {
      search_from(leading);
    } catch (const TooLarge& limit) {
      leave_open(limit.what());
    }
  }
  if (equations_.has_weights()) look_for_pencils();
  // Roots and functions of parameters are taken as free of relations.
  for (const std::size_t place : system_.parameters()) {
    if (place >= system_.functions().symbols().size())
      leave_open(fmt::format("'{}' is taken as a parameter of its own", system_.name(place)));
  }
  for (const DarbouxPolynomial& found : report_.found) {
    if (found.verdict != Verdict::proved)
      leave_open(fmt::format("'{}' was found but not proved", found.text));
  }
  // Last, since it takes time.
  if (report_.complete) {
    if (const auto doubt = thin_domain(system_)) leave_open(*doubt);
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

DarbouxReport find_darboux_polynomials(const Model& model, int degree, const Watch& watch) {
  constexpr int kHighest = 6;
  if (degree > kHighest)
    throw ModelError(fmt::format("Darboux polynomials are searched up to degree {}", kHighest));
  return DarbouxSearch(model, degree, watch).run();
}

DarbouxReport find_darboux(const Model& model, int degree, const Watch& watch) {
  DarbouxReport report = find_darboux_polynomials(model, degree, watch);
  report.combinations = combine(model, report.found, degree, watch, &report.all_integrals_combined);
  // (y + i*z)/(y - i*z) is a product of factors, none of which is among those found.
  if (report.has_conjugates) report.all_integrals_combined = false;
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
