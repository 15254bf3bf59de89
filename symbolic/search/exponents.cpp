#include "symbolic/search/exponents.hpp"

#include <cln/rational_io.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <numeric>
#include <set>

#include "symbolic/algebra/ideal.hpp"
#include "symbolic/algebra/number_text.hpp"
#include "symbolic/algebra/polynomial_roots.hpp"
#include "symbolic/case/limits.hpp"
#include "symbolic/expression/expression.hpp"
#include "symbolic/search/finder.hpp"
#include "symbolic/search/generic_parameters.hpp"
#include "symbolic/search/independence.hpp"
#include "symbolic/search/polynomial_system.hpp"
#include "symbolic/search/quasi_homogeneous.hpp"
#include "symbolic/search/system.hpp"

namespace casimir::search {
namespace {

class Analysis {
 public:
  Analysis(const Model& model, const std::vector<std::pair<Text, Text>>& weights,
           const Watch& watch);
  ExponentReport run();
  ExponentReport without_balances() const { return report_; }

 private:
  void find_balances();
  void read_weights(const std::vector<std::pair<Text, Text>>& weights);
  void keep_leading_terms();
  std::optional<Balance> balance_of(const Branch& branch);
  std::vector<Exponent> exponents_of(const Branch& branch, bool& decided);
  bool are_conjugate(const std::vector<SolvedRelation>& relations) const;
  Exponent exponent_of(const Polynomial& factor) const;
  Polynomial in_own_ring(const Polynomial& p) const;
  std::string text(const Polynomial& p) const;
  std::string quotient(const Polynomial& top, const Polynomial& bottom) const;
  bool belongs_to_another(const std::vector<Branch>& branches, std::size_t b) const;
  bool leading_terms_use(std::size_t place) const;
  std::optional<double> value_of(std::size_t place) const;
  void look_at_constants();
  std::vector<Polynomial> normal_forms(const std::vector<Polynomial>& row) const;
  Polynomial normal_form(const Polynomial& p) const { return normal_forms({p})[0]; }
  bool divides_by_zero(const Branch& branch) const;
  bool is_irrational(const Polynomial& factor) const;
  void describe_leading();
  long root_of_time() const;
  bool branches_itself(const Balance& balance) const;
  void conclude();
  cln::cl_RA weight(std::size_t i) const {
    return cln::cl_RA(weights_.numerators[i]) / weights_.denominator;
  }

  const Model& model_;
  const Watch& watch_;
  System system_;
  std::size_t dimension_;
  PolynomialRing ring_;  ///< that of the system, with rho at the end
  std::size_t rho_;
  std::vector<std::size_t> unknowns_;  ///< the places of the coordinates
  std::vector<Polynomial> field_;      ///< times factor_
  Polynomial factor_;                  ///< made of parameters
  Weights weights_;
  bool has_functions_ = false;          ///< of parameters or numbers, in the leading terms
  std::optional<std::string> doubt_{};  ///< why it is not known what these obey
  ExponentReport report_;
};

Analysis::Analysis(const Model& model, const std::vector<std::pair<Text, Text>>& weights,
                   const Watch& watch)
    : model_(model),
      watch_(watch),
      system_(model, {}, {}),
      dimension_(model.variables.size()),
      ring_(system_.ring().size() + 1),
      rho_(system_.ring().size()),
      factor_(ring_.constant(1)) {
  if (model.time) throw ModelError("exponents need equations that do not depend on the time");
  for (std::size_t i = 0; i < dimension_; ++i) unknowns_.push_back(i);
  std::vector<Polynomial> row = system_.prover().field();
  for (const Polynomial& rate : row) {
    for (std::size_t g = 0; g < system_.ring().size(); ++g) {
      if (g >= system_.prover().ring().symbols().size() && !system_.is_constant()[g] &&
          rate.uses(g))
        throw ModelError(
            "exponents need equations of motion that are polynomials in the variables");
    }
  }
  row.push_back(system_.ring().constant(1));
  if (!system_.prover().ring().is_polynomial())
    row = system_.prover().ring().common_numerators(std::move(row));
  factor_ = in_own_ring(row.back());
  row.pop_back();
  for (const Polynomial& p : row) field_.push_back(in_own_ring(p));
  read_weights(weights);
  keep_leading_terms();
  look_at_constants();
  describe_leading();
}

bool Analysis::leading_terms_use(std::size_t place) const {
  return factor_.uses(place) ||
         std::ranges::any_of(field_, [&](const Polynomial& p) { return p.uses(place); });
}

/// Of a real number.
std::optional<double> Analysis::value_of(std::size_t place) const {
  if (!system_.is_number(place)) return std::nullopt;
  const GiNaC::ex value = system_.functions().variable_value(place).evalf();
  if (!GiNaC::is_a<GiNaC::numeric>(value)) return std::nullopt;
  const GiNaC::numeric& number = GiNaC::ex_to<GiNaC::numeric>(value);
  return number.is_real() ? std::optional(number.to_double()) : std::nullopt;
}

void Analysis::look_at_constants() {
  for (std::size_t k = system_.functions().symbols().size(); k < rho_; ++k)
    has_functions_ = has_functions_ || leading_terms_use(k);
  if (has_functions_) doubt_ = unknown_relations(system_);
}

/// All of them times one parameter that is not zero, by what functions of parameters obey.
///
/// Where these are known to obey nothing else (`unknown_relations`), the polynomials in them modulo
/// their relations have no divisors of zero: a polynomial is zero as a function exactly where this
/// is zero, and a product only where a factor is.
std::vector<Polynomial> Analysis::normal_forms(const std::vector<Polynomial>& row) const {
  if (!has_functions_) return row;
  std::vector<Polynomial> parts;
  std::vector<std::size_t> counts;
  for (const Polynomial& p : row) {
    const std::vector<Polynomial> own = p.coefficients(rho_);
    counts.push_back(own.size());
    for (const Polynomial& part : own) parts.push_back(in_ring(part, system_.ring()));
  }
  parts = system_.functions().common_numerators(std::move(parts));
  std::vector<Polynomial> result;
  std::size_t next = 0;
  for (const std::size_t count : counts) {
    Polynomial sum(ring_);
    for (std::size_t k = 0; k < count; ++k)
      sum += in_ring(parts[next++], ring_) * ring_.variable(rho_).pow(k);
    result.push_back(std::move(sum));
  }
  return result;
}

/// Whether what the branch divides by may vanish at one of its solutions: over the field of
/// sqrt(2), x^2 = 2 has factors, and x - sqrt(2) is zero at one of two. The product of its values
/// at all of them, which is a power of leading coefficients times the resultant, tells.
bool Analysis::divides_by_zero(const Branch& branch) const {
  const std::optional<std::vector<SolvedRelation>> relations = triangular(branch.rest, unknowns_);
  if (!relations) return true;
  const auto vanishes = [&](Polynomial p) {
    for (const SolvedRelation& r : *relations)
      if (p.uses(r.variable)) p = normal_form(resultant(p, r.relation, r.variable));
    return normal_form(p).is_zero();
  };
  for (const SolvedRelation& r : *relations)
    if (normal_form(r.leading).is_zero()) return true;
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
  for (std::size_t k = 0; k < rho_; ++k) {
    if (!factor.uses(k)) continue;
    if (!system_.is_number(k)) return false;
    const Kind kind = system_.functions().origin(k).kind;
    if (kind != Kind::root && kind != Kind::imaginary) return false;
    has_roots = true;
  }
  return has_roots;
}

Polynomial Analysis::in_own_ring(const Polynomial& p) const {
  TermCollector collector(ring_);
  for (auto [number, exponents] : p.term_list()) {
    exponents.push_back(0);
    collector.add(number, exponents);
  }
  return collector.finish();
}

std::string Analysis::text(const Polynomial& p) const {
  std::string result;
  for (const auto& [number, exponents] : p.term_list()) {
    std::string factors;
    for (std::size_t i = 0; i < exponents.size(); ++i) {
      if (exponents[i] == 0) continue;
      if (!factors.empty()) factors += "*";
      if (i != rho_)
        factors += system_.functions().text(system_.ring().variable(i).pow(exponents[i]));
      else
        factors += exponents[i] > 1 ? fmt::format("rho^{}", exponents[i]) : "rho";
    }
    append_term(result, number, factors);
  }
  return result.empty() ? "0" : result;
}

std::string Analysis::quotient(const Polynomial& top, const Polynomial& bottom) const {
  const Polynomial common = Polynomial::gcd(top, bottom);
  Polynomial a = top, b = bottom;
  top.divide(common, &a);
  bottom.divide(common, &b);
  if (b.is_constant()) return text(a.scaled(1 / b.term_list()[0].first));
  const cln::cl_RA content = b.content();
  a = a.scaled(1 / content);
  b = b.scaled(1 / content);
  return quotient_text(text(a), a.terms() > 1, text(b));
}

void Analysis::read_weights(const std::vector<std::pair<Text, Text>>& weights) {
  std::vector<std::string> names;
  for (const GiNaC::symbol& s : model_.variables) names.push_back(s.get_name());
  if (weights.empty()) {
    const std::optional<Weights> found = find_weights(field_, names);
    if (!found) {
      throw ModelError(
          "no weights with small numbers make the equations of motion quasi-homogeneous: give "
          "some");
    }
    weights_ = *found;
  } else {
    weights_.numerators.assign(dimension_, 1);
    for (const auto& [name, weight] : weights) {
      const std::size_t i =
          symbol_position(name, name.value, 0, model_.variables, "a variable of this case");
      int value = 0;
      const char* end = weight.value.data() + weight.value.size();
      const auto [stop, problem] = std::from_chars(weight.value.data(), end, value);
      if (problem != std::errc() || stop != end || value < 1 || value > 100)
        throw weight.error("a weight is a whole number from 1 to 100");
      weights_.numerators[i] = value;
    }
  }
  for (std::size_t i = 0; i < dimension_; ++i)
    report_.weights.emplace_back(names[i], rational_text(weight(i)));
}

void Analysis::keep_leading_terms() {
  for (std::size_t i = 0; i < dimension_; ++i) {
    TermCollector kept(ring_), dropped(ring_);
    for (const auto& [number, exponents] : field_[i].term_list()) {
      const int more = excess(weights_, i, exponents);
      if (more > 0) {
        throw ModelError(
            fmt::format("with these weights the rate of {} has a term of too high a weight, so "
                        "that no solution "
                        "grows like a power",
                        model_.variables[i].get_name()));
      }
      (more == 0 ? kept : dropped).add(number, exponents);
    }
    field_[i] = kept.finish();
    const Polynomial rest = dropped.finish();
    if (!rest.is_zero())
      report_.left_out.push_back(
          fmt::format("{} in the rate of {}", text(rest), model_.variables[i].get_name()));
  }
}

Exponent Analysis::exponent_of(const Polynomial& factor) const {
  Exponent result;
  const std::vector<Polynomial> parts = factor.coefficients(rho_);
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
      result.text = quotient(-parts[0], parts[1]);
    }
    return result;
  }
  result.kind = constant ? Exponent::Kind::algebraic : Exponent::Kind::parametric;
  result.is_root = true;
  result.is_irrational = !constant && is_irrational(factor);
  const cln::cl_RA content = factor.content();
  result.text = text(factor.scaled(1 / content));
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
    Polynomial combination = ring_.variable(rho_);
    long factor = 1, expected = 1;
    for (const SolvedRelation& r : relations) {
      combination = combination - ring_.variable(r.variable).scaled(cln::cl_RA(factor));
      factor = factor * 3 + trial;
    }
    for (const SolvedRelation& r : relations) {
      Polynomial relation = r.relation;
      for (std::size_t v = 0; v < rho_; ++v) {
        const bool solved = std::ranges::any_of(
            relations, [&](const SolvedRelation& other) { return other.variable == v; });
        if (solved || !relation.uses(v)) continue;
        const long number = trial * 7 + static_cast<long>(v * v) * 3 + 2;
        relation = substituted(relation, v, ring_.constant(number), ring_.constant(1));
      }
      expected *= static_cast<long>(relation.degree(r.variable));
      combination = resultant(combination, relation, r.variable);
    }
    const auto factors = combination.factors();
    const bool single = std::ranges::count_if(factors, [&](const auto& f) {
                          return f.first.uses(rho_) && f.second == 1 &&
                                 static_cast<long>(f.first.degree(rho_)) == expected;
                        }) == 1;
    if (single) return true;
  }
  return false;
}

/// The roots of det(dF/dx(c) + diag(g) - rho), by factors over the rationals; where a coefficient
/// is an algebraic number, of the norm.
std::vector<Exponent> Analysis::exponents_of(const Branch& branch, bool& decided) {
  const bool simple =
      std::all_of(branch.solved.begin(), branch.solved.end(),
                  [](const SolvedUnknown& s) { return s.denominator.is_constant(); });
  std::vector<std::vector<Polynomial>> matrix;
  for (std::size_t i = 0; i < dimension_; ++i) {
    auto& row = matrix.emplace_back();
    for (std::size_t j = 0; j < dimension_; ++j) {
      Polynomial entry = field_[i].derivative(j);
      if (i == j) entry += factor_.scaled(weight(i)) - factor_ * ring_.variable(rho_);
      row.push_back(simple ? branch.reduced(entry) : entry);
    }
  }
  Polynomial characteristic = determinant_without_sign(matrix, ring_);
  if (!simple) characteristic = branch.reduced(characteristic);
  characteristic = normal_form(characteristic);
  const std::optional<std::vector<SolvedRelation>> relations = triangular(branch.rest, unknowns_);
  if (!relations) {
    decided = false;
    return {};
  }
  unsigned long norm = 1;
  for (const SolvedRelation& r : *relations) {
    if (!characteristic.uses(r.variable)) continue;
    characteristic = normal_form(resultant(characteristic, r.relation, r.variable));
    norm *= static_cast<unsigned long>(r.relation.degree(r.variable));
  }
  if (characteristic.is_zero()) {
    decided = false;
    return {};
  }
  // Over the field of sqrt(2) the solutions of x^2 = 2 are not conjugate.
  const bool conjugate = norm == 1 || (!has_functions_ && are_conjugate(*relations));
  std::vector<Exponent> result;
  unsigned long degree = 0;
  for (const auto& [factor, power] : characteristic.factors()) {
    if (!factor.uses(rho_)) continue;
    Exponent exponent = exponent_of(factor);
    const bool alike = conjugate && power % norm == 0;
    exponent.multiplicity = alike ? power / norm : power;
    exponent.solutions = alike ? 1 : norm;
    degree += power * static_cast<unsigned long>(factor.degree(rho_));
    result.push_back(std::move(exponent));
  }
  if (degree != norm * dimension_) decided = false;
  std::sort(result.begin(), result.end(), [](const Exponent& a, const Exponent& b) {
    return std::pair(a.kind, std::pair(a.text.size(), a.text)) <
           std::pair(b.kind, std::pair(b.text.size(), b.text));
  });
  return result;
}

std::optional<Balance> Analysis::balance_of(const Branch& branch) {
  Balance balance;
  balance.decided = branch.decided && !(has_functions_ && divides_by_zero(branch));
  bool zero = true;
  std::set<std::size_t> free;
  for (std::size_t i = 0; i < dimension_; ++i) {
    Polynomial top = ring_.variable(i), bottom = ring_.constant(1);
    for (const SolvedUnknown& s : branch.solved) put(s, top, bottom);
    const std::vector<Polynomial> parts = normal_forms({top, bottom});
    top = parts[0];
    if (!parts[1].is_zero()) bottom = parts[1];  // else the branch is not decided
    if (!top.is_zero()) zero = false;
    balance.is_nonzero.push_back(!top.is_zero());
    for (std::size_t v = 0; v < dimension_; ++v)
      if (top.uses(v)) free.insert(v);
    balance.coefficients.emplace_back(model_.variables[i].get_name(), quotient(top, bottom));
  }
  if (zero) return std::nullopt;
  if (const auto relations = triangular(branch.rest, unknowns_); relations && balance.decided) {
    for (const SolvedRelation& r : *relations) {
      balance.relations.push_back(text(r.relation) + " = 0");
      free.erase(r.variable);
    }
  } else {
    balance.decided = false;
  }
  for (const std::size_t v : free) balance.free.push_back(model_.variables[v].get_name());
  if (balance.decided) balance.exponents = exponents_of(branch, balance.decided);
  return balance;
}

/// The least power N of t - t0 for which x_i = c_i (t - t0)^(-g_i) has whole powers of its root.
long Analysis::root_of_time() const {
  long result = 1;
  for (std::size_t i = 0; i < dimension_; ++i)
    result = std::lcm(result, cln::cl_I_to_long(cln::denominator(weight(i))));
  return result;
}

/// Whether a coordinate of a balance that is not zero has a broken power of t - t0.
bool Analysis::branches_itself(const Balance& balance) const {
  for (std::size_t i = 0; i < dimension_; ++i)
    if (cln::denominator(weight(i)) != 1 && balance.is_nonzero[i]) return true;
  return false;
}

void Analysis::conclude() {
  // Variations of a balance are (t - t0)^(rho - g_i) times constants, in Jordan blocks times
  // logarithms. Solutions without branches have variations without (Lyapunov); where weights are
  // broken, the balance itself may branch, and rho - g_i is whole where rho is not.
  const long root = root_of_time();
  std::vector<std::string> rational, irrational, parametric;
  bool all_integer = report_.complete, branches = false;
  for (const Balance& balance : report_.balances) {
    branches = branches || branches_itself(balance);
    for (const Exponent& e : balance.exponents) {
      if (e.kind == Exponent::Kind::integer) continue;
      all_integer = false;
      const bool of_root =
          e.kind == Exponent::Kind::rational && cln::denominator(e.value * cln::cl_RA(root)) == 1;
      if (of_root && root > 1) continue;
      const bool open = e.kind == Exponent::Kind::parametric && !e.is_irrational;
      auto& list = e.kind == Exponent::Kind::rational ? rational : open ? parametric : irrational;
      const bool is_root = e.kind == Exponent::Kind::algebraic || e.is_root;
      const std::string entry = is_root ? e.text + " = 0" : e.text;
      if (std::find(list.begin(), list.end(), entry) == list.end()) list.push_back(entry);
    }
  }
  auto& out = report_.conclusions;
  if (report_.balances.empty() && report_.complete)
    out.push_back("there is no balance with these weights: the test says nothing");
  if (!irrational.empty()) {
    out.push_back(fmt::format(
        "exponents that are not rational ({}): the leading system is not algebraically integrable, "
        "that is, has no {} independent algebraic integrals (Yoshida 1983, Goriely 1996: all "
        "Kovalevskaya exponents of a quasi-homogeneous system that has are rational), and its "
        "general solution branches infinitely often",
        fmt::join(irrational, "; "), dimension_ - 1));
  }
  if (!rational.empty()) {
    out.push_back(fmt::format(
        "rational exponents that are not {} ({}): the general solution is not single-valued in "
        "complex time (Kovalevskaya 1889, Lyapunov 1894); an algebraic integral is not excluded",
        root == 1 ? "integers" : fmt::format("multiples of 1/{}, as the weights are", root),
        fmt::join(rational, "; ")));
  }
  if (!parametric.empty()) {
    out.push_back(fmt::format(
        "exponents that depend on parameters ({}): where one is not rational, the leading system "
        "is not algebraically integrable, that is, has no {} independent algebraic integrals "
        "(Yoshida 1983, Goriely 1996); where one is not {}, the general solution is not "
        "single-valued (Kovalevskaya 1889, Lyapunov 1894)",
        fmt::join(parametric, "; "), dimension_ - 1,
        root == 1 ? "an integer" : fmt::format("a multiple of 1/{}, as the weights are", root)));
  }
  if (branches)
    out.push_back(
        "a balance has broken powers of t - t0: it is not single-valued in complex time, whatever "
        "the exponents");
  if (all_integer && !report_.balances.empty() && root == 1)
    out.push_back(
        "all exponents are integers: Kovalevskaya's necessary condition for single-valued general "
        "solutions holds for these balances; that excludes no logarithms and alone proves no "
        "integrability");
}

/// Of two branches that are one, the first remains.
bool Analysis::belongs_to_another(const std::vector<Branch>& branches, std::size_t b) const {
  const auto decides = [](const Branch& branch) { return branch.decided; };
  if (!decides(branches[b])) return false;
  for (std::size_t other = 0; other < branches.size(); ++other) {
    if (other == b || !decides(branches[other])) continue;
    if (!contains(branches[other], branches[b], unknowns_)) continue;
    if (other < b || !contains(branches[b], branches[other], unknowns_)) return true;
  }
  return false;
}

/// The parameters of the leading terms; these terms themselves, where there are none.
void Analysis::describe_leading() {
  bool is_numeric = true;
  std::vector<double> values(ring_.size(), 1);
  for (std::size_t k = dimension_; k < rho_; ++k) {
    if (!leading_terms_use(k)) continue;
    if (!system_.is_number(k)) report_.generic.push_back(system_.name(k));
    const std::optional<double> value = value_of(k);
    is_numeric = is_numeric && value;
    values[k] = value.value_or(1);
  }
  if (!is_numeric) return;
  const auto number_of = [&](const cln::cl_RA& number, const std::vector<unsigned long>& powers) {
    double result = cln::double_approx(number);
    for (std::size_t k = dimension_; k < powers.size(); ++k)
      result *= std::pow(values[k], static_cast<double>(powers[k]));
    return result;
  };
  double factor = 0;
  for (const auto& [number, powers] : factor_.term_list()) factor += number_of(number, powers);
  LeadingSystem leading;
  for (std::size_t i = 0; i < dimension_; ++i) {
    leading.names.push_back(model_.variables[i].get_name());
    leading.weights.push_back(cln::double_approx(weight(i)));
    auto& rate = leading.rates.emplace_back();
    for (auto [number, exponents] : field_[i].term_list()) {
      const double coefficient = number_of(number, exponents) / factor;
      exponents.resize(dimension_);
      rate.push_back({coefficient, exponents});
    }
  }
  report_.leading = std::move(leading);
}

/// No balance is known where the equations are too large.
ExponentReport Analysis::run() {
  try {
    const WorkMeter meter(system_.model().limits);
    find_balances();
  } catch (const TooLarge& limit) {
    report_.complete = false;
    report_.reason = limit.what();
  }
  conclude();
  return report_;
}

void Analysis::find_balances() {
  if (doubt_) {
    report_.reason = *doubt_ + ", and what is divided by might be zero";
    return;
  }
  if (!report_.generic.empty()) {
    if (const auto thin = thin_assumptions(system_)) {
      report_.reason = *thin;
      return;
    }
  }
  std::vector<Polynomial> equations;
  for (std::size_t i = 0; i < dimension_; ++i)
    equations.push_back(field_[i] + factor_.scaled(weight(i)) * ring_.variable(i));
  watch_.begin("balances");
  report_.complete = true;
  NormalForm normal;
  if (has_functions_) normal = [this](const Polynomial& p) { return normal_form(p); };
  const std::vector<Branch> branches = solve_system(equations, unknowns_, watch_, {}, normal);
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
