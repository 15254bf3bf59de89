#include "symbolic/structure/bracket_search.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "symbolic/functions/short_text.hpp"
#include "symbolic/model/bare_motion.hpp"
#include "symbolic/search/modular/span.hpp"
#include "symbolic/search/search.hpp"

namespace casimir::structure {
namespace {

/// The equations of motion alone, with the points that scenes give.
Model bare(const Model& model) {
  Model result = bare_motion(model);
  result.scenes = model.scenes;
  return result;
}

/// Of polynomials, those that are linearly independent of the ones before them and of 1, at random
/// points modulo a prime.
std::vector<Polynomial> independent(const search::System& system,
                                    const std::vector<Polynomial>& list) {
  const search::Modulus modulus = search::usable_modulus(system);
  std::mt19937_64 random(29);
  const std::optional<search::Point> constants = system.random_point(modulus, random);
  std::vector<search::Point> points;
  while (constants && points.size() < list.size() + 5) {
    std::optional<search::Point> point = system.random_point(modulus, random, &*constants);
    if (!point) break;
    points.push_back(std::move(*point));
  }
  search::Span span(modulus);
  span.insert(std::vector<search::Residue>(points.size(), 1));
  std::vector<Polynomial> result;
  for (const Polynomial& p : list) {
    std::vector<search::Residue> values;
    for (const search::Point& point : points)
      values.push_back(search::value_at(p, point, modulus).value_or(0));
    if (span.insert(std::move(values))) result.push_back(p);
  }
  return result;
}

}  // namespace

int degree_of_motion(const Model& model) {
  GiNaC::lst variables;
  for (const GiNaC::symbol& x : model.variables) variables.append(x);
  int highest = 0;
  for (const GiNaC::ex& rate : model.field) {
    const GiNaC::ex expanded = rate.expand();
    if (!expanded.is_polynomial(variables))
      throw ModelError("brackets are searched for equations of motion that are polynomials");
    const auto size_of = [&](const GiNaC::ex& term) {
      int degree = 0;
      for (const GiNaC::symbol& x : model.variables) degree += term.degree(x);
      return degree;
    };
    if (!GiNaC::is_a<GiNaC::add>(expanded)) highest = std::max(highest, size_of(expanded));
    for (std::size_t k = 0; GiNaC::is_a<GiNaC::add>(expanded) && k < expanded.nops(); ++k)
      highest = std::max(highest, size_of(expanded.op(k)));
  }
  return highest;
}

std::vector<std::vector<GiNaC::ex>> simple_constants(std::size_t count) {
  std::vector<std::vector<GiNaC::ex>> result;
  const std::vector<GiNaC::ex> zero(count, 0);
  result.push_back(zero);
  for (std::size_t i = 0; i < count; ++i) {
    result.push_back(zero);
    result.back()[i] = 1;
  }
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      for (const int second : {1, -1, 2}) {
        result.push_back(zero);
        result.back()[j] = 1;
        result.back()[i] = second;
      }
    }
  }
  for (int k = 1; k <= 3; ++k) {
    result.emplace_back();
    for (std::size_t i = 0; i < count; ++i)
      result.back().emplace_back(static_cast<int>((i * i + 3 * i) % 7) + k);
  }
  return result;
}

bool are_proportional(const Bivector& p, const Bivector& q) {
  std::size_t pivot = 0;
  while (pivot < p.size() && p[pivot].is_zero()) ++pivot;
  if (pivot == p.size()) return true;
  for (std::size_t c = 0; c < p.size(); ++c)
    if (!(p[c] * q[pivot] == q[c] * p[pivot])) return false;
  // The ratio is q[pivot]/p[pivot]: of a function of the motion it would be another bracket.
  return p[pivot].total_degree() == q[pivot].total_degree() &&
         p[pivot].scaled(1 / p[pivot].content()) == q[pivot].scaled(1 / q[pivot].content());
}

BracketSearch::BracketSearch(const Model& model, int hamiltonian_degree, const search::Watch& watch)
    : model_(model),
      watch_(watch),
      space_(model, {2, false}),
      hamiltonian_degree_(hamiltonian_degree) {
  const search::System& system = space_.system();
  if (system.atoms().size() > space_.lift().model().variables.size())
    throw ModelError("brackets are searched for equations of motion that are polynomials");
  motion_.assign(system.flow().begin(),
                 system.flow().begin() + static_cast<std::ptrdiff_t>(dimension()));
  take_integrals(hamiltonian_degree);
}

void BracketSearch::take_integrals(int degree) {
  const Model own = bare(model_);
  search::Request request;
  request.degree = degree;
  request.casimirs_are_integrals = true;
  const search::Report report = search::find_integrals(own, request, watch_);
  integrals_are_all_ = report.complete;
  integrals_reason_ = report.reason;
  search::System& system = space_.system();
  std::vector<Polynomial> generators;
  std::vector<int> degrees;
  for (const search::Found& found : report.found) {
    if (!space_.add_integral(found.value)) {
      integrals_are_all_ = false;
      continue;
    }
    generators.push_back(system.functions().reduced(system.prover().convert(found.value)));
    degrees.push_back(found.degree);
  }
  std::vector<Polynomial> products;
  std::vector<std::vector<int>> exponents = search::products_up_to(degrees, degree, 0);
  const auto weight = [&](const std::vector<int>& e) {
    int sum = 0;
    for (std::size_t g = 0; g < e.size(); ++g) sum += e[g] * degrees[g];
    return sum;
  };
  std::stable_sort(exponents.begin(), exponents.end(),
                   [&](const auto& a, const auto& b) { return weight(a) < weight(b); });
  for (const std::vector<int>& e : exponents) {
    Polynomial product = system.ring().constant(1);
    for (std::size_t g = 0; g < e.size(); ++g)
      product = product * generators[g].pow(static_cast<unsigned long>(e[g]));
    products.push_back(std::move(product));
  }
  integrals_ = independent(system, products);
  std::erase_if(products, [](const Polynomial& p) { return p.is_constant(); });
  all_integrals_ = std::move(products);
}

GiNaC::ex BracketSearch::factor_of_motion() const {
  for (std::size_t i = 0; i < dimension(); ++i) {
    const GiNaC::ex rate = model_.field[i].normal();
    if (!rate.is_zero()) {
      const search::System& system = space_.system();
      return (system.expression(motion_[i]) / rate).normal();
    }
  }
  return 1;
}

std::pair<Bivector, GiNaC::ex> BracketSearch::combination(const std::vector<Bivector>& basis,
                                                          const std::vector<GiNaC::ex>& constants) {
  search::System& system = space_.system();
  // Multiplied by the common denominator, and divided by the content.
  GiNaC::ex bottom = 1;
  for (const GiNaC::ex& constant : constants) {
    const GiNaC::ex own = constant.denom();
    bottom = (bottom * own / GiNaC::gcd(bottom, own)).normal();
  }
  std::vector<Polynomial> factors;
  for (const GiNaC::ex& constant : constants)
    factors.push_back(system.prover().convert((constant * bottom).normal().expand()));
  Bivector sum(basis.front().size(), Polynomial(system.ring()));
  for (std::size_t k = 0; k < basis.size(); ++k) {
    if (factors[k].is_zero()) continue;
    for (std::size_t c = 0; c < sum.size(); ++c) sum[c] += factors[k] * basis[k][c];
  }
  Polynomial common(system.ring());
  for (const Polynomial& component : sum) {
    if (!component.is_zero())
      common = common.is_zero() ? component : Polynomial::gcd(common, component);
  }
  // Only what is made of parameters: the rest of a common factor belongs to the bracket.
  Polynomial divisor = system.ring().constant(1);
  if (!common.is_zero()) {
    for (const auto& [factor, exponent] : common.factors()) {
      bool moves = false;
      for (std::size_t i = 0; i < system.ring().size(); ++i)
        moves = moves || (!system.is_constant()[i] && factor.uses(i));
      if (!moves && !factor.is_constant()) divisor = divisor * factor.pow(exponent);
    }
  }
  cln::cl_RA content = 0;
  for (Polynomial& component : sum) {
    Polynomial quotient(system.ring());
    if (component.divide(divisor, &quotient)) component = std::move(quotient);
    const cln::cl_RA own = component.content();
    if (cln::zerop(own)) continue;
    const cln::cl_RA numerators = cln::gcd(cln::numerator(content), cln::numerator(own));
    const cln::cl_RA denominators = cln::lcm(cln::denominator(content), cln::denominator(own));
    content = numerators / denominators;
  }
  if (cln::zerop(content)) return {std::move(sum), 0};
  for (Polynomial& component : sum) component = component.scaled(1 / content);
  const GiNaC::ex factor =
      (bottom / (system.expression(divisor) * GiNaC::numeric(content))).normal();
  return {std::move(sum), factor};
}

GiNaC::ex BracketSearch::combination(const std::vector<Polynomial>& functions,
                                     const std::vector<GiNaC::ex>& constants) const {
  const search::System& system = space_.system();
  GiNaC::ex sum = 0;
  for (std::size_t k = 0; k < functions.size(); ++k) {
    if (!constants[k].is_zero()) sum += constants[k] * system.expression(functions[k]);
  }
  return sum;
}

std::vector<Bivector> BracketSearch::shortest_independent(std::vector<Bivector> list,
                                                          const std::vector<Bivector>& base) const {
  const search::System& system = space_.system();
  const auto length = [](const Bivector& p) {
    std::size_t sum = 0;
    for (const Polynomial& component : p) {
      for (const auto& [number, exponents] : component.term_list()) {
        sum += 1;
        for (const unsigned long e : exponents) sum += e;
        if (number != 1 && number != -1) ++sum;
      }
    }
    return sum;
  };
  std::stable_sort(list.begin(), list.end(),
                   [&](const Bivector& a, const Bivector& b) { return length(a) < length(b); });
  const search::Modulus modulus = search::usable_modulus(system);
  std::mt19937_64 random(37);
  const std::optional<search::Point> constants = system.random_point(modulus, random);
  std::vector<search::Point> points;
  while (constants && points.size() < 24) {
    std::optional<search::Point> point = system.random_point(modulus, random, &*constants);
    if (!point) break;
    points.push_back(std::move(*point));
  }
  search::Span span(modulus);
  const auto is_new = [&](const Bivector& p) {
    std::vector<search::Residue> values;
    for (const search::Point& point : points) {
      for (const Polynomial& component : p)
        values.push_back(search::value_at(component, point, modulus).value_or(0));
    }
    return span.insert(std::move(values));
  };
  for (const Bivector& p : base) is_new(p);
  std::erase_if(list, [&](const Bivector& p) { return !is_new(p); });
  return list;
}

/// `short_text` is that of the polynomial or of its negative.
std::string BracketSearch::signed_text(const GiNaC::ex& polynomial) {
  search::System& system = space_.system();
  const Polynomial p = system.functions().reduced(system.prover().convert(polynomial.expand()));
  const std::string text = search::short_text(system.functions(), p, system.is_constant());
  const auto is = [&](const std::string& own) {
    return (model_.parse({own, {"the text of a function", 1, 1}, own}) - polynomial)
        .expand()
        .is_zero();
  };
  if (is(text)) return text;
  const std::string negative = p.terms() > 1 ? "-(" + text + ")" : "-" + text;
  return is(negative) ? negative : system.functions().text(p);
}

std::string BracketSearch::text_of(const GiNaC::ex& function) {
  const GiNaC::ex parts = function.numer_denom();
  std::string top = signed_text(parts.op(0)), bottom = signed_text(parts.op(1));
  if (bottom.starts_with('-')) {
    top = signed_text(-parts.op(0));
    bottom = signed_text(-parts.op(1));
  }
  if (bottom == "1") return top;
  const auto bracketed = [](const std::string& text) {
    const bool plain = text.find_first_of("+-*/ ") == std::string::npos;
    return plain ? text : "(" + text + ")";
  };
  // "-(..)" is how `signed_text` writes a negative sum.
  return (top.starts_with("-(") ? top : bracketed(top)) + "/" + bracketed(bottom);
}

Bracket BracketSearch::described(const Bivector& p, const std::optional<GiNaC::ex>& hamiltonian) {
  search::System& system = space_.system();
  Bracket result;
  for (std::size_t c = 0; c < p.size(); ++c) {
    result.upper.push_back(system.expression(p[c]));
    if (p[c].is_zero()) continue;
    result.texts.emplace_back(space_.lift().label(c), system.functions().text(p[c]));
    result.degree = std::max(
        result.degree,
        search::weighted_degree(p[c], system.atoms(), std::vector<int>(system.atoms().size(), 1)));
  }
  Model model = bare(model_);
  model.phase_space = "explicit brackets";
  model.poisson.emplace(model.variables, result.upper);
  model.hamiltonian = hamiltonian;
  Candidates only;
  only.only = ClaimKind::jacobi;
  if (!hamiltonian) model.hamiltonian = 0;
  const std::vector<Proof> proofs = prove(model, only);
  if (!proofs.empty() && std::ranges::all_of(proofs, [](const Proof& proof) {
        return proof.verdict == Verdict::proved;
      }))
    result.jacobi = Verdict::proved;
  if (hamiltonian) {
    result.hamiltonian = hamiltonian;
    result.hamiltonian_text = text_of(*hamiltonian);
    const std::vector<GiNaC::ex> flow = model.poisson->flow(*hamiltonian);
    result.motion = Verdict::proved;
    for (std::size_t i = 0; i < flow.size(); ++i)
      if (!(flow[i] - model.field[i]).normal().is_zero()) result.motion = Verdict::undecided;
  }
  search::Request request;
  request.degree = hamiltonian_degree_;
  request.casimirs = true;
  for (const search::Found& found : search::find_integrals(model, request, watch_).found)
    if (found.verdict == Verdict::proved) result.casimirs.push_back(found.text);
  return result;
}

std::optional<GiNaC::ex> BracketSearch::hamiltonian_of(const Bivector& p) {
  const std::size_t n = dimension();
  ConstantEquations own(space_.system(), integrals_.size());
  std::vector<std::vector<ConstantEquations::Summand>> motion(n);
  for (std::size_t i = 0; i < n; ++i) motion[i].push_back({-motion_[i], {}});
  for (std::size_t f = 0; f < integrals_.size(); ++f) {
    const std::vector<Polynomial> field = hamiltonian_field(p, n, integrals_[f]);
    for (std::size_t i = 0; i < n; ++i)
      if (!field[i].is_zero()) motion[i].push_back({field[i], {f}});
  }
  for (const auto& sum : motion) own.add(sum);
  for (const search::Branch& family : own.solve(watch_)) {
    const auto constants =
        own.values(family, std::vector<GiNaC::ex>(own.free_in(family).size(), 0));
    if (constants) return (combination(integrals_, *constants) / factor_of_motion()).normal();
  }
  return std::nullopt;
}

std::optional<std::string> BracketSearch::doubt(const std::vector<search::Branch>& families) const {
  const search::System& system = space_.system();
  if (!space_.complete()) return space_.reason();
  for (const search::Branch& family : families) {
    if (!family.decided)
      return "some equations for the constants of a bracket could not be solved exactly";
    if (!family.rest.empty())
      return "there may be brackets whose constants are algebraic numbers; these are not shown";
  }
  for (const std::size_t place : system.parameters()) {
    if (place >= system.functions().symbols().size())
      return fmt::format("'{}' is taken as a parameter of its own", system.name(place));
  }
  return std::nullopt;
}

}  // namespace casimir::structure
