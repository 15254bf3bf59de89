#include "symbolic/search/conditions/darboux_conditions.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "symbolic/algebra/number_text.hpp"
#include "symbolic/error.hpp"
#include "symbolic/search/conditions/projection.hpp"
#include "symbolic/search/conditions/special_model.hpp"
#include "symbolic/search/conditions/special_values.hpp"
#include "symbolic/search/darboux_equations.hpp"
#include "symbolic/search/polynomial_system.hpp"

namespace casimir::search {
namespace {

using GiNaC::ex;

/// A set in the space of the free parameters that cases of the equations lead to.
struct DarbouxPlace {
  std::vector<std::pair<GiNaC::symbol, ex>> values;
  std::vector<std::pair<std::string, std::string>> names;
};

// For which values a of parameters is there an additional Darboux polynomial F, of cofactor K? The
// equations X F = K F, with one coefficient of F equal to 1, are solved for F, K and a together,
// over the complex numbers, by cases. Each case is a set whose components all project onto dense
// subsets of one irreducible set P of parameters, or of several that are conjugate
// (projection.hpp). So every F at every point a is in one of the cases, and there it is a limit of
// solutions at generic points of P, which are products of irreducible ones at these; as their
// leading coefficients are 1, so are the limits, by Gauss's lemma for the valuation of a curve
// through the point.
//
//   - Where P is everything, F is a product of limits of what the search for generic values finds.
//   - Where P has equations, a search at its generic point decides whether there is an additional
//     one: of the cases inside P, and at single points of it, other cases tell.
//   - Such a limit may have rational coefficients where what it is a limit of has algebraic ones,
//     which are not shown: y - 2*x at a = 4 of y - sqrt(a)*x. Then the answer is open
//     (leave_open_if_split).
//   - P is left out only where it has an equation in one parameter without real roots.
//
// What was found at P may be a factor of the value there of what there is in general: at a = 0, x
// is one of x*y - a. But at a = 4, x - 2 is the limit of x - sqrt(a), a factor of x^2 - a over all
// numbers, and nothing new. And where a*x + b*y vanishes, at a = b = 0, it has many limits
// (additional_of).
class DarbouxConditions {
 public:
  DarbouxConditions(const Model& model, int degree, std::vector<std::size_t> free,
                    const Watch& watch)
      : model_(model),
        degree_(degree),
        free_(std::move(free)),
        watch_(watch),
        equations_(model, degree) {}

  DarbouxConditionReport run();

 private:
  void search_from(std::size_t leading);
  void add(const Branch& branch, const DarbouxEquations::Ansatz& ansatz);
  void add_place(const Projection& projection);
  void add_relations(const std::vector<Polynomial>& relations);
  void confirm(const DarbouxPlace& place);
  struct Known {
    ex value;
    bool linear;  ///< in a coordinate, before the values were put in
  };
  std::vector<Known> known_at(const GiNaC::exmap& here) const;
  std::vector<DarbouxPolynomial> additional_of(const Model& special, const DarbouxReport& found,
                                               const GiNaC::exmap& here);
  void leave_open(const std::string& reason);
  void leave_open_if_split(const DarbouxReport& report);
  std::string text(const Polynomial& p) { return equations_.system().prover().ring().text(p); }
  std::string text_of(const Polynomial& top, const Polynomial& bottom);
  const GiNaC::symbol& parameter(std::size_t place) const {
    return model_.parameters[place - model_.variables.size()];
  }

  const Model& model_;
  int degree_;
  std::vector<std::size_t> free_;
  const Watch& watch_;
  DarbouxEquations equations_;
  std::vector<DarbouxPlace> places_;
  std::vector<std::string> relations_;
  DarbouxConditionReport report_;
  std::vector<DarbouxPlace> confirmed_;  ///< of the first conditions, in their order
};

void DarbouxConditions::leave_open(const std::string& reason) {
  report_.complete = false;
  constexpr std::size_t kLongest = 400;
  if (report_.reason.find(reason) != std::string::npos || report_.reason.size() > kLongest) return;
  report_.reason += (report_.reason.empty() ? "" : "; ") + reason;
}

std::string DarbouxConditions::text_of(const Polynomial& top, const Polynomial& bottom) {
  if (bottom.is_constant()) return text(top.scaled(1 / bottom.term_list()[0].first));
  return quotient_text(text(top), top.terms() > 1, text(bottom));
}

void DarbouxConditions::search_from(std::size_t leading) {
  // Parts of one weight would not do: at special values sums of them may have one cofactor.
  const DarbouxEquations::Ansatz ansatz = equations_.of(leading, false);
  std::vector<std::size_t> unknowns = ansatz.unknowns;
  unknowns.insert(unknowns.end(), free_.begin(), free_.end());
  for (const Branch& branch : solve_system(ansatz.equations, unknowns, watch_, free_))
    add(branch, ansatz);
}

void DarbouxConditions::add(const Branch& branch, const DarbouxEquations::Ansatz& ansatz) {
  if (branch.reduced(ansatz.cofactor).is_zero()) return;  // integrals
  const Projection projection = projected(branch, ansatz.unknowns, free_);
  switch (projection.kind) {
    case Projection::Kind::dense:
      return;
    case Projection::Kind::open:
      return leave_open("some equations for coefficients and parameters were not solved exactly");
    case Projection::Kind::relations:
      return add_relations(projection.relations);
    case Projection::Kind::values:
      return add_place(projection);
  }
}

void DarbouxConditions::add_place(const Projection& projection) {
  DarbouxPlace place;
  const FunctionRing& ring = equations_.system().functions();
  for (const auto& [own, top, bottom] : projection.values) {
    const auto above = equations_.in_system_ring(top), below = equations_.in_system_ring(bottom);
    if (!above || !below) return leave_open("a value of a parameter has unknowns");
    place.values.emplace_back(parameter(own), ring.quotient(*above, *below));
    place.names.emplace_back(parameter(own).get_name(), text_of(*above, *below));
  }
  if (std::ranges::none_of(places_, [&](const auto& p) { return p.names == place.names; }))
    places_.push_back(std::move(place));
}

/// Equations between parameters that give no values: only one whose roots are all complex is left
/// out.
void DarbouxConditions::add_relations(const std::vector<Polynomial>& relations) {
  DarbouxCondition condition;
  for (const Polynomial& relation : relations) {
    const std::optional<Polynomial> own = equations_.in_system_ring(relation);
    if (!own) return leave_open("a relation between parameters has unknowns");
    std::vector<std::size_t> used;
    for (std::size_t i = 0; i < own->ring().size(); ++i)
      if (own->uses(i)) used.push_back(i);
    if (used.size() == 1 && real_roots(*own, used[0]) == 0) return;
    condition.relations.push_back(text(*own));
  }
  const std::string key = fmt::format("{}", fmt::join(condition.relations, " = "));
  leave_open(fmt::format("'{} = 0' has no rational solution to confirm", key));
  if (std::find(relations_.begin(), relations_.end(), key) != relations_.end()) return;
  relations_.push_back(key);
  report_.conditions.push_back(std::move(condition));
}

/// What there is in general, and on sets around it, with the values put in.
std::vector<DarbouxConditions::Known> DarbouxConditions::known_at(const GiNaC::exmap& here) const {
  std::vector<Known> result;
  const auto take = [&](const std::vector<DarbouxPolynomial>& list) {
    for (const DarbouxPolynomial& f : list) {
      const ex value = f.value.expand();
      const bool linear = std::ranges::any_of(
          model_.variables, [&](const GiNaC::symbol& x) { return value.degree(x) == 1; });
      result.push_back({value.subs(here, GiNaC::subs_options::no_pattern), linear});
    }
  };
  take(report_.generic.found);
  for (std::size_t i = 0; i < confirmed_.size(); ++i) {
    const bool around = std::ranges::all_of(confirmed_[i].values, [&](const auto& entry) {
      try {
        return (ex(entry.first) - entry.second).subs(here).normal().is_zero();
      } catch (const GiNaC::pole_error&) {
        return false;
      }
    });
    if (around) take(report_.conditions[i].found);
  }
  return result;
}

/// Without the values of known ones. A factor of such a value is additional where the known one is
/// irreducible over all numbers: as an irreducible one is that is linear in a coordinate.
std::vector<DarbouxPolynomial> DarbouxConditions::additional_of(const Model& special,
                                                                const DarbouxReport& found,
                                                                const GiNaC::exmap& here) {
  System system(special, {}, {});
  const auto numerator = [&](const ex& e) {
    return system.functions().numerator(system.prover().convert(e));
  };
  const auto has_coordinates = [&](const Polynomial& p) {
    for (std::size_t i = 0; i < special.variables.size(); ++i)
      if (p.uses(i)) return true;
    return false;
  };
  std::vector<DarbouxPolynomial> result;
  const std::vector<Known> known = known_at(here);
  for (const DarbouxPolynomial& own : found.found) {
    const Polynomial p = numerator(own.value);
    bool is_new = true;
    for (const auto& [known_value, linear] : known) {
      const Polynomial value = numerator(known_value);
      Polynomial quotient(value.ring());
      if (!value.is_zero() && !value.divide(p, &quotient)) continue;
      const bool same = !value.is_zero() && !has_coordinates(quotient);
      const bool may_be_limit = value.is_zero() || !linear;
      if (same || may_be_limit) is_new = false;
      if (!same && may_be_limit)
        leave_open(
            fmt::format("whether '{}' is a limit of what there is in general is open", own.text));
    }
    if (is_new) result.push_back(own);
  }
  return result;
}

void DarbouxConditions::leave_open_if_split(const DarbouxReport& report) {
  report_.has_conjugates |= report.has_conjugates;
  if (!report.has_moving_conjugates) return;
  leave_open(
      "there are factors with coefficients that are roots of functions of parameters, and rational "
      "at some values");
}

void DarbouxConditions::confirm(const DarbouxPlace& place) {
  DarbouxCondition condition;
  condition.parameters = place.names;
  GiNaC::exmap here;
  std::string where;
  for (const auto& [name, value] : place.names)
    where += fmt::format("{}{} = {}", where.empty() ? "" : ", ", name, value);
  Model special = model_;
  try {
    for (const auto& [symbol, value] : place.values) {
      condition.values.push_back(value);
      here.emplace(symbol, value);
      std::optional<Model> next = with_value(special, symbol, value);
      if (!next) return;
      special = std::move(*next);
    }
    if (contradict(special) || is_meaningless(special)) return;
    const DarbouxReport found = find_darboux_polynomials(special, degree_, watch_);
    if (!found.complete) {
      leave_open(fmt::format("whether there is an additional one at {} is undecided: {}", where,
                             found.reason));
    }
    leave_open_if_split(found);
    condition.found = additional_of(special, found, here);
  } catch (const GiNaC::pole_error&) {
    // Of the equations, or of what is compared with it: only the former would be no case.
    return leave_open("at some values there is a division by zero");
  } catch (const ModelError& problem) {
    return leave_open(fmt::format("the search at {} has no answer: {}", where, problem.what()));
  }
  if (condition.found.empty()) return;
  const bool proved = std::ranges::all_of(
      condition.found, [](const auto& own) { return own.verdict == Verdict::proved; });
  // Where some for generic values are not known, these may be limits of those.
  if (proved && report_.generic.complete) condition.verdict = Verdict::proved;
  const auto after_the_confirmed = static_cast<std::ptrdiff_t>(confirmed_.size());
  confirmed_.push_back(place);
  report_.conditions.insert(report_.conditions.begin() + after_the_confirmed, std::move(condition));
}

DarbouxConditionReport DarbouxConditions::run() {
  report_.generic = find_darboux_polynomials(model_, degree_, watch_);
  report_.complete = report_.generic.complete;
  report_.reason = report_.generic.reason;
  leave_open_if_split(report_.generic);
  for (const std::size_t place : inside_functions(equations_.system(), free_)) {
    leave_open(fmt::format("'{}' is inside a function, whose special values were not sought",
                           parameter(place).get_name()));
  }
  watch_.begin("conditions");
  const std::size_t count = equations_.monomials().size();
  {
    const WorkMeter meter(model_.limits);  // of all systems of equations together
    for (std::size_t leading = 1; leading < count; ++leading) {
      watch_.tick(static_cast<double>(leading) / static_cast<double>(count));
      try {
        search_from(leading);
      } catch (const TooLarge& limit) {
        leave_open(limit.what());
      }
    }
  }
  std::ranges::stable_sort(
      places_, [](const auto& a, const auto& b) { return a.values.size() < b.values.size(); });
  for (const DarbouxPlace& place : places_) confirm(place);
  return report_;
}

}  // namespace

DarbouxConditionReport find_darboux_conditions(const Model& model, int degree,
                                               const std::vector<Text>& free, const Watch& watch) {
  return DarbouxConditions(model, degree, free_places(model, free), watch).run();
}

}  // namespace casimir::search
