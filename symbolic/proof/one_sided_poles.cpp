#include "symbolic/proof/one_sided_poles.hpp"

#include <algorithm>

namespace casimir {
namespace {

using GiNaC::ex;

/// A term of a sum: number * coefficient / (positive functions), or with a logarithm.
struct SingularTerm {
  ex coefficient = 1;        ///< parameters, or 1
  int sign = 1;              ///< of all but the coefficient, where it is infinite
  std::vector<ex> divisors;  ///< the term is infinite where one of them is zero
  bool known = true;         ///< whether it has this form
};

bool has_variables(const ex& e, const Model& model) {
  const auto is_in = [&](const GiNaC::symbol& x) { return e.has(x); };
  return std::ranges::any_of(model.variables, is_in) || (model.time && e.has(*model.time));
}

/// Whether it has a finite value at all finite states: it divides by nothing that moves.
bool is_finite(const ex& e, const Model& model) {
  for (auto part = e.preorder_begin(); part != e.preorder_end(); ++part) {
    if (!has_variables(*part, model)) continue;
    if (GiNaC::is_a<GiNaC::power>(*part)) {
      const ex exponent = part->op(1);
      if (!GiNaC::is_a<GiNaC::numeric>(exponent) ||
          !GiNaC::ex_to<GiNaC::numeric>(exponent).is_positive())
        return false;
    } else if (GiNaC::is_a<GiNaC::function>(*part)) {
      const std::string name = GiNaC::ex_to<GiNaC::function>(*part).get_name();
      if (name != "sin" && name != "cos" && name != "exp" && name != "abs") return false;
    }
  }
  return true;
}

void take_factor(SingularTerm& term, const ex& factor, const Model& model) {
  if (GiNaC::is_a<GiNaC::numeric>(factor)) {
    term.known = term.known && factor.info(GiNaC::info_flags::real);
    if (factor.info(GiNaC::info_flags::negative)) term.sign = -term.sign;
    return;
  }
  if (!has_variables(factor, model)) {
    term.coefficient *= factor;
    return;
  }
  if (GiNaC::is_a<GiNaC::power>(factor) && GiNaC::is_a<GiNaC::numeric>(factor.op(1))) {
    const auto exponent = GiNaC::ex_to<GiNaC::numeric>(factor.op(1));
    // A root is positive, and so is an even power.
    const bool positive = exponent.is_negative() && (!exponent.is_integer() || exponent.is_even());
    term.known = term.known && positive && is_finite(factor.op(0), model);
    term.divisors.push_back(factor.op(0));
    return;
  }
  if (GiNaC::is_a<GiNaC::function>(factor) &&
      GiNaC::ex_to<GiNaC::function>(factor).get_name() == "log") {
    term.sign = -term.sign;
    term.known = term.known && term.divisors.empty() && is_finite(factor.op(0), model);
    term.divisors.push_back(factor.op(0));
    return;
  }
  term.known = false;
}

SingularTerm singular_term(const ex& term, const Model& model) {
  SingularTerm result;
  if (!GiNaC::is_a<GiNaC::mul>(term)) {
    take_factor(result, term, model);
    return result;
  }
  for (const ex& factor : term) take_factor(result, factor, model);
  // A logarithm beside another divisor has no sign.
  const bool logarithm = std::ranges::any_of(
      term, [](const ex& factor) { return GiNaC::is_a<GiNaC::function>(factor); });
  result.known = result.known && (!logarithm || result.divisors.size() == 1);
  return result;
}

}  // namespace

std::vector<Polynomial> one_sided_poles(Prover& prover) {
  const Model& model = prover.model();
  const ex energy = model.hamiltonian->expand();
  const GiNaC::exvector terms = GiNaC::is_a<GiNaC::add>(energy)
                                    ? GiNaC::exvector(energy.begin(), energy.end())
                                    : GiNaC::exvector{energy};
  std::optional<SingularTerm> first;
  std::vector<Polynomial> poles;
  for (const ex& term : terms) {
    if (is_finite(term, model)) continue;
    const SingularTerm own = singular_term(term, model);
    if (!own.known) return {};
    if (!first) first = own;
    if (own.sign != first->sign || !own.coefficient.is_equal(first->coefficient)) return {};
    for (const ex& divisor : own.divisors)
      for (const auto& [f, e] : prover.ring().lowest_terms(prover.convert(divisor)).first.factors())
        if (!f.is_constant()) poles.push_back(f);
  }
  return poles;
}

}  // namespace casimir
