#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "symbolic/expression.hpp"
#include "symbolic/search/finder.hpp"
#include "symbolic/search/rank_conditions.hpp"
#include "symbolic/search/short_text.hpp"

namespace casimir::search {
namespace {

using GiNaC::ex;

/// The model where a parameter has a value, which may contain the others. Only what a search needs.
Model with_value(const Model& model, const GiNaC::symbol& parameter, const ex& value) {
  const GiNaC::exmap map{{parameter, value}};
  const auto put = [&](const ex& e) { return e.subs(map, GiNaC::subs_options::no_pattern); };
  Model result = model;
  std::erase_if(result.parameters, [&](const GiNaC::symbol& s) { return s.is_equal(parameter); });
  std::erase_if(result.assumptions,
                [&](const Assumption& a) { return GiNaC::has(a.difference, parameter); });
  if (result.hamiltonian) result.hamiltonian = put(*result.hamiltonian);
  for (ex& rate : result.field) rate = put(rate);
  for (auto* list : {&result.definitions, &result.casimirs, &result.integrals})
    for (NamedExpression& f : *list) f.value = put(f.value);
  if (result.poisson) {
    std::vector<ex> upper;
    for (std::size_t i = 0; i < result.poisson->dimension(); ++i)
      for (std::size_t j = i + 1; j < result.poisson->dimension(); ++j)
        upper.push_back(put((*result.poisson)(i, j)));
    result.poisson = PoissonStructure(result.poisson->coordinates(), upper);
  }
  result.lax_pairs.clear();
  result.maps.clear();
  result.scenes.clear();
  result.conditionals.clear();
  result.invariant_relations.clear();
  result.measures.clear();
  result.identities.clear();
  result.section.reset();
  result.fixed.emplace_back(Text{parameter.get_name(), {}, {}}, value);
  return result;
}

class ConditionFinder {
 public:
  ConditionFinder(const Model& model, const Request& request, const Watch& watch)
      : model_(model), request_(request), watch_(watch), finder_(model, request, watch) {}

  ConditionReport run(const std::vector<std::size_t>& free);

 private:
  void add_factor(const Polynomial& factor, const std::vector<std::size_t>& free);
  void add_points(const std::vector<ParametricBlock>& blocks, const std::vector<std::size_t>& free);
  bool on_a_found_surface(const GiNaC::exmap& point) const;
  Report confirmed(const Model& special) const;
  std::string quotient_text(const Polynomial& top, const Polynomial& bottom);
  std::string text(const Polynomial& p) { return finder_.system().prover().ring().text(p); }
  const GiNaC::symbol& parameter(std::size_t place) const {
    return model_.parameters[place - model_.variables.size()];
  }

  const Model& model_;
  const Request& request_;
  const Watch& watch_;
  Finder finder_;
  ConditionReport report_;
  std::vector<Polynomial> surfaces_;
};

/// In lowest terms already, since the two make an irreducible polynomial.
std::string ConditionFinder::quotient_text(const Polynomial& top, const Polynomial& bottom) {
  if (bottom.is_constant()) return text(top.scaled(1 / bottom.term_list()[0].first));
  const auto bracketed = [&](const Polynomial& p) {
    return p.terms() > 1 ? "(" + text(p) + ")" : text(p);
  };
  return bracketed(top) + "/(" + text(bottom) + ")";
}

/// What is found at special values beside what is found for generic ones.
Report ConditionFinder::confirmed(const Model& special) const {
  Request request = request_;
  for (const Found& found : report_.generic.found)
    request.known.push_back({found.text, {"found", 1, 1}, {}});
  return find_integrals(special, request, watch_);
}

void ConditionFinder::add_factor(const Polynomial& factor, const std::vector<std::size_t>& free) {
  if (std::any_of(surfaces_.begin(), surfaces_.end(),
                  [&](const Polynomial& known) { return known == factor; }))
    return;
  surfaces_.push_back(factor);
  const FunctionRing& ring = finder_.system().prover().ring();
  Condition condition;
  condition.relation = text(factor);
  // Solved for a parameter in which it is linear, if there is one.
  std::optional<std::size_t> main;
  for (const std::size_t place : free) {
    if (factor.degree(place) != 1) continue;
    if (!main || factor.coefficients(place)[1].is_constant()) main = place;
  }
  if (!main) {
    report_.conditions.push_back(condition);
    report_.complete = false;
    report_.reason =
        fmt::format("'{} = 0' has no rational solution to confirm", condition.relation);
    return;
  }
  const std::vector<Polynomial> parts = factor.coefficients(*main);
  const ex value = ring.quotient(-parts[0], parts[1]);
  condition.parameters.emplace_back(parameter(*main).get_name(),
                                    quotient_text(-parts[0], parts[1]));
  try {
    const Report special = confirmed(with_value(model_, parameter(*main), value));
    condition.found = special.found;
    if (special.found.empty()) {
      if (special.complete) return;  // the rank is lower there for another reason
      report_.complete = false;
      report_.reason = fmt::format("whether there is an additional one at {} = {} is undecided: {}",
                                   condition.parameters[0].first, condition.parameters[0].second,
                                   special.reason);
    }
    condition.verdict = special.complete ? Verdict::proved : Verdict::undecided;
  } catch (const ModelError&) {
    return;  // the equations have no meaning there: a denominator vanishes
  }
  if (free.size() == 1 && parts[1].is_constant() && parts[0].is_constant())
    condition.relation.clear();
  report_.conditions.push_back(std::move(condition));
}

bool ConditionFinder::on_a_found_surface(const GiNaC::exmap& point) const {
  auto& ring = const_cast<Finder&>(finder_).system().prover().ring();
  return std::any_of(surfaces_.begin(), surfaces_.end(), [&](const Polynomial& surface) {
    return ring.expression(surface).subs(point).expand().is_zero();
  });
}

/// Isolated points of two parameters: candidates for the first, and the search for the second with
/// the first fixed.
void ConditionFinder::add_points(const std::vector<ParametricBlock>& blocks,
                                 const std::vector<std::size_t>& free) {
  std::vector<cln::cl_RA> candidates;
  for (const ParametricBlock& block : blocks) {
    for (const cln::cl_RA& value :
         isolated_values(finder_.system(), block, free[0], free[1], watch_)) {
      if (std::find(candidates.begin(), candidates.end(), value) == candidates.end())
        candidates.push_back(value);
    }
  }
  std::sort(candidates.begin(), candidates.end());
  for (const cln::cl_RA& value : candidates) {
    const GiNaC::symbol& first = parameter(free[0]);
    const GiNaC::symbol& second = parameter(free[1]);
    const ex number{GiNaC::numeric(value)};
    if (on_a_found_surface({{first, number}})) continue;
    std::ostringstream number_text;
    number_text << number;
    const Model special = with_value(model_, first, number);
    const ConditionReport inner =
        find_conditions(special, request_, {{second.get_name(), {}, {}}}, watch_);
    for (const Condition& point : inner.conditions) {
      if (point.parameters.empty() || point.found.empty()) continue;
      const ex other = special.parse({point.parameters[0].second, {"found", 1, 1}, {}});
      if (on_a_found_surface({{first, number}, {second, other}})) continue;
      Condition condition = point;
      condition.parameters.insert(condition.parameters.begin(),
                                  {first.get_name(), number_text.str()});
      condition.relation.clear();
      report_.conditions.push_back(std::move(condition));
    }
  }
}

ConditionReport ConditionFinder::run(const std::vector<std::size_t>& free) {
  report_.generic = find_integrals(model_, request_, watch_);
  report_.complete = report_.generic.complete;
  report_.reason = report_.generic.reason;
  watch_.begin("conditions");
  const Problem problem = finder_.integral_problem({});
  const Ansatz ansatz = make_ansatz(finder_.system(), problem, watch_);
  const std::vector<ParametricBlock> blocks =
      parametric_blocks(finder_.system(), problem.fields, ansatz.monomials, ansatz.relations);
  std::vector<Polynomial> factors;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    watch_.tick(static_cast<double>(b) / static_cast<double>(blocks.size()));
    const RankConditions own = rank_conditions(finder_.system(), blocks[b], free, watch_);
    if (!own.decided) {
      report_.complete = false;
      report_.reason =
          "some block of equations is too large, or its conditions involve further parameters: "
          "give numbers to other parameters (--param) or free them too";
    }
    for (const Polynomial& factor : own.factors) factors.push_back(factor);
  }
  for (const Polynomial& factor : factors) add_factor(factor, free);
  report_.points_open = free.size() > 1;
  if (free.size() == 2) add_points(blocks, free);
  return report_;
}

}  // namespace

ConditionReport find_conditions(const Model& model, const Request& request,
                                const std::vector<Text>& free, const Watch& watch) {
  std::vector<std::size_t> places;
  for (const Text& name : free) {
    const std::size_t position =
        symbol_position(name, name.value, 0, model.parameters, "a parameter of this case");
    places.push_back(model.variables.size() + position);
  }
  if (std::set<std::size_t>(places.begin(), places.end()).size() < places.size())
    throw free.back().error("a parameter is named twice");
  return ConditionFinder(model, request, watch).run(places);
}

}  // namespace casimir::search
