#include "symbolic/search/exponents.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <set>

#include "symbolic/algebra/ideal.hpp"
#include "symbolic/algebra/number_text.hpp"
#include "symbolic/algebra/polynomial_roots.hpp"
#include "symbolic/case/limits.hpp"
#include "symbolic/search/exponents/conclusions.hpp"
#include "symbolic/search/exponents/leading_part.hpp"
#include "symbolic/search/finder.hpp"
#include "symbolic/search/generic_parameters.hpp"
#include "symbolic/search/independence.hpp"
#include "symbolic/search/polynomial_system.hpp"
#include "symbolic/search/system.hpp"

namespace casimir::search {
namespace {

class Analysis {
 public:
  Analysis(const Model& model, const std::vector<std::pair<Text, Text>>& weights,
           const Watch& watch)
      : model_(model), watch_(watch), leading_(model, weights) {
    leading_.describe(report_);
  }
  ExponentReport run();
  ExponentReport without_balances() const {
    ExponentReport report = report_;
    say_what_of_constraints(model_, report);
    return report;
  }

 private:
  void find_balances();
  std::optional<Balance> balance_of(const Branch& branch) const;
  std::vector<Exponent> exponents_of(const Branch& branch, bool& decided) const;
  bool are_conjugate(const std::vector<SolvedRelation>& relations) const;
  Exponent exponent_of(const Polynomial& factor) const;
  bool belongs_to_another(const std::vector<Branch>& branches, std::size_t b) const;
  bool divides_by_zero(const Branch& branch) const;
  bool is_irrational(const Polynomial& factor) const;

  const Model& model_;
  const Watch& watch_;
  LeadingPart leading_;
  ExponentReport report_;
};

/// Whether what the branch divides by may vanish at one of its solutions: over the field of
/// sqrt(2), x^2 = 2 has factors, and x - sqrt(2) is zero at one of two. The product of its values
/// at all of them, which is a power of leading coefficients times the resultant, tells.
bool Analysis::divides_by_zero(const Branch& branch) const {
  const std::optional<std::vector<SolvedRelation>> relations =
      triangular(branch.rest, leading_.unknowns());
  if (!relations) return true;
  const auto vanishes = [&](Polynomial p) {
    for (const SolvedRelation& r : *relations)
      if (p.uses(r.variable)) p = leading_.normal_form(resultant(p, r.relation, r.variable));
    return leading_.normal_form(p).is_zero();
  };
  for (const SolvedRelation& r : *relations)
    if (leading_.normal_form(r.leading).is_zero()) return true;
  return std::ranges::any_of(branch.solved, [&](const SolvedUnknown& s) {
    return vanishes(branch.reduced(s.denominator));
  });
}

/// Whether an irreducible factor in normal form has no parameters but roots of numbers, and no
/// rational zero. At a rational c its value is in normal form, and so zero as a function only where
/// it is zero as a polynomial: then rho - c divides it, and is all of it.
bool Analysis::is_irrational(const Polynomial& factor) const {
  using Kind = FunctionRing::Origin::Kind;
  bool has_roots = false;
  for (std::size_t k = 0; k < leading_.rho(); ++k) {
    if (!factor.uses(k)) continue;
    if (!leading_.system().is_number(k)) return false;
    const Kind kind = leading_.system().functions().origin(k).kind;
    if (kind != Kind::root && kind != Kind::imaginary) return false;
    has_roots = true;
  }
  return has_roots;
}

Exponent Analysis::exponent_of(const Polynomial& factor) const {
  Exponent result;
  const std::vector<Polynomial> parts = factor.coefficients(leading_.rho());
  const bool constant = std::all_of(parts.begin(), parts.end(), [](const Polynomial& p) {
    return p.is_zero() || p.is_constant();
  });
  const auto number = [](const Polynomial& p) {
    return p.is_zero() ? cln::cl_RA(0) : p.term_list()[0].first;
  };
  if (parts.size() == 2) {
    if (constant) {
      const cln::cl_RA value = -number(parts[0]) / number(parts[1]);
      result.kind =
          cln::denominator(value) == 1 ? Exponent::Kind::integer : Exponent::Kind::rational;
      result.value = value;
      result.text = rational_text(value);
    } else {
      result.kind = Exponent::Kind::parametric;
      result.is_irrational = is_irrational(factor);
      result.text = leading_.quotient(-parts[0], parts[1]);
    }
    return result;
  }
  result.kind = constant ? Exponent::Kind::algebraic : Exponent::Kind::parametric;
  result.is_root = true;
  result.is_irrational = !constant && is_irrational(factor);
  const cln::cl_RA content = factor.content();
  result.text = leading_.text(factor.scaled(1 / content));
  if (constant) {
    std::vector<cln::cl_I> coefficients;
    for (const Polynomial& p : parts) coefficients.push_back(cln::numerator(number(p) / content));
    result.values = complex_roots(coefficients);
  }
  return result;
}

/// Whether all solutions of the relations are conjugate over the rationals (with the parameters),
/// so that each has the same rational exponents equally often. One irreducible relation says so; of
/// c^2 = 2, d^2 = 8 each is irreducible, and the solutions d = 2c and d = -2c are not alike. There
/// the polynomial of a combination w of the unknowns tells: if it is irreducible for some numbers
/// in place of the parameters, then the solutions are conjugate. False where that is not found out.
bool Analysis::are_conjugate(const std::vector<SolvedRelation>& relations) const {
  const auto is_linear = [](const SolvedRelation& r) { return r.relation.degree(r.variable) == 1; };
  if (std::ranges::count_if(relations, std::not_fn(is_linear)) <= 1) return true;
  for (const long trial : {1, 2, 3}) {
    Polynomial combination = leading_.ring().variable(leading_.rho());
    long factor = 1, expected = 1;
    for (const SolvedRelation& r : relations) {
      combination = combination - leading_.ring().variable(r.variable).scaled(cln::cl_RA(factor));
      factor = factor * 3 + trial;
    }
    for (const SolvedRelation& r : relations) {
      Polynomial relation = r.relation;
      for (std::size_t v = 0; v < leading_.rho(); ++v) {
        const bool solved = std::ranges::any_of(
            relations, [&](const SolvedRelation& other) { return other.variable == v; });
        if (solved || !relation.uses(v)) continue;
        const long number = trial * 7 + static_cast<long>(v * v) * 3 + 2;
        relation =
            substituted(relation, v, leading_.ring().constant(number), leading_.ring().constant(1));
      }
      expected *= static_cast<long>(relation.degree(r.variable));
      combination = resultant(combination, relation, r.variable);
    }
    const auto factors = combination.factors();
    const bool single = std::ranges::count_if(factors, [&](const auto& f) {
                          return f.first.uses(leading_.rho()) && f.second == 1 &&
                                 static_cast<long>(f.first.degree(leading_.rho())) == expected;
                        }) == 1;
    if (single) return true;
  }
  return false;
}

/// The roots of det(dF/dx(c) + diag(g) - rho), by factors over the rationals; where a coefficient
/// is an algebraic number, of the norm.
std::vector<Exponent> Analysis::exponents_of(const Branch& branch, bool& decided) const {
  const bool simple =
      std::all_of(branch.solved.begin(), branch.solved.end(),
                  [](const SolvedUnknown& s) { return s.denominator.is_constant(); });
  std::vector<std::vector<Polynomial>> matrix;
  for (std::size_t i = 0; i < leading_.dimension(); ++i) {
    auto& row = matrix.emplace_back();
    for (std::size_t j = 0; j < leading_.dimension(); ++j) {
      Polynomial entry = leading_.field()[i].derivative(j);
      if (i == j)
        entry += leading_.factor().scaled(leading_.weight(i)) -
                 leading_.factor() * leading_.ring().variable(leading_.rho());
      row.push_back(simple ? branch.reduced(entry) : entry);
    }
  }
  Polynomial characteristic = determinant_without_sign(matrix, leading_.ring());
  if (!simple) characteristic = branch.reduced(characteristic);
  characteristic = leading_.normal_form(characteristic);
  const std::optional<std::vector<SolvedRelation>> relations =
      triangular(branch.rest, leading_.unknowns());
  if (!relations) {
    decided = false;
    return {};
  }
  unsigned long norm = 1;
  for (const SolvedRelation& r : *relations) {
    if (!characteristic.uses(r.variable)) continue;
    characteristic = leading_.normal_form(resultant(characteristic, r.relation, r.variable));
    norm *= static_cast<unsigned long>(r.relation.degree(r.variable));
  }
  if (characteristic.is_zero()) {
    decided = false;
    return {};
  }
  // Over the field of sqrt(2) the solutions of x^2 = 2 are not conjugate.
  const bool conjugate = norm == 1 || (!leading_.has_functions() && are_conjugate(*relations));
  std::vector<Exponent> result;
  unsigned long degree = 0;
  for (const auto& [factor, power] : characteristic.factors()) {
    if (!factor.uses(leading_.rho())) continue;
    Exponent exponent = exponent_of(factor);
    const bool alike = conjugate && power % norm == 0;
    exponent.multiplicity = alike ? power / norm : power;
    exponent.solutions = alike ? 1 : norm;
    degree += power * static_cast<unsigned long>(factor.degree(leading_.rho()));
    result.push_back(std::move(exponent));
  }
  if (degree != norm * leading_.dimension()) decided = false;
  std::sort(result.begin(), result.end(), [](const Exponent& a, const Exponent& b) {
    return std::pair(a.kind, std::pair(a.text.size(), a.text)) <
           std::pair(b.kind, std::pair(b.text.size(), b.text));
  });
  return result;
}

std::optional<Balance> Analysis::balance_of(const Branch& branch) const {
  Balance balance;
  balance.decided = branch.decided && !(leading_.has_functions() && divides_by_zero(branch));
  bool zero = true;
  std::set<std::size_t> free;
  for (std::size_t i = 0; i < leading_.dimension(); ++i) {
    Polynomial top = leading_.ring().variable(i), bottom = leading_.ring().constant(1);
    for (const SolvedUnknown& s : branch.solved) put(s, top, bottom);
    const std::vector<Polynomial> parts = leading_.normal_forms({top, bottom});
    top = parts[0];
    if (!parts[1].is_zero()) bottom = parts[1];  // else the branch is not decided
    if (!top.is_zero()) zero = false;
    balance.is_nonzero.push_back(!top.is_zero());
    for (std::size_t v = 0; v < leading_.dimension(); ++v)
      if (top.uses(v)) free.insert(v);
    balance.coefficients.emplace_back(model_.variables[i].get_name(),
                                      leading_.quotient(top, bottom));
  }
  if (zero) return std::nullopt;
  if (const auto relations = triangular(branch.rest, leading_.unknowns());
      relations && balance.decided) {
    for (const SolvedRelation& r : *relations) {
      balance.relations.push_back(leading_.text(r.relation) + " = 0");
      free.erase(r.variable);
    }
  } else {
    balance.decided = false;
  }
  for (const std::size_t v : free) balance.free.push_back(model_.variables[v].get_name());
  if (balance.decided) balance.exponents = exponents_of(branch, balance.decided);
  return balance;
}

/// Of two branches that are one, the first remains.
bool Analysis::belongs_to_another(const std::vector<Branch>& branches, std::size_t b) const {
  const auto decides = [](const Branch& branch) { return branch.decided; };
  if (!decides(branches[b])) return false;
  for (std::size_t other = 0; other < branches.size(); ++other) {
    if (other == b || !decides(branches[other])) continue;
    if (!contains(branches[other], branches[b], leading_.unknowns())) continue;
    if (other < b || !contains(branches[b], branches[other], leading_.unknowns())) return true;
  }
  return false;
}

/// No balance is known where the equations are too large.
ExponentReport Analysis::run() {
  try {
    const WorkMeter meter(leading_.system().model().limits);
    find_balances();
  } catch (const TooLarge& limit) {
    report_.complete = false;
    report_.reason = limit.what();
  }
  conclude(leading_, report_);
  return report_;
}

void Analysis::find_balances() {
  if (leading_.doubt()) {
    report_.reason = *leading_.doubt() + ", and what is divided by might be zero";
    return;
  }
  if (!report_.generic.empty()) {
    if (const auto thin = thin_domain(leading_.system())) {
      report_.reason = *thin;
      return;
    }
  }
  std::vector<Polynomial> equations;
  for (std::size_t i = 0; i < leading_.dimension(); ++i)
    equations.push_back(leading_.field()[i] +
                        leading_.factor().scaled(leading_.weight(i)) * leading_.ring().variable(i));
  watch_.begin("balances");
  report_.complete = true;
  NormalForm normal;
  if (leading_.has_functions())
    normal = [this](const Polynomial& p) { return leading_.normal_form(p); };
  const std::vector<Branch> branches =
      solve_system(equations, leading_.unknowns(), watch_, {}, normal);
  for (std::size_t b = 0; b < branches.size(); ++b) {
    if (belongs_to_another(branches, b)) continue;
    const std::optional<Balance> balance = balance_of(branches[b]);
    if (!balance) continue;
    // An exponent -1 belongs to every balance, as the origin of time is arbitrary.
    const auto is_minus_one = [](const Exponent& e) {
      return e.kind == Exponent::Kind::integer && e.value == -1;
    };
    if (balance->decided &&
        std::none_of(balance->exponents.begin(), balance->exponents.end(), is_minus_one))
      throw std::logic_error("a balance without the exponent -1");
    if (!balance->decided) {
      report_.complete = false;
      report_.reason = "some equations of the balances could not be solved exactly";
    }
    if (balance->decided) report_.balances.push_back(*balance);
  }
}

}  // namespace

ExponentReport kovalevskaya_exponents(const Model& model,
                                      const std::vector<std::pair<Text, Text>>& weights,
                                      const Watch& watch) {
  check_parameters_are_free(model);
  return Analysis(model, weights, watch).run();
}

ExponentReport leading_terms(const Model& model,
                             const std::vector<std::pair<Text, Text>>& weights) {
  return Analysis(model, weights, {}).without_balances();
}

}  // namespace casimir::search
