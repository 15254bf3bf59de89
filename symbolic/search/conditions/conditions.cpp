#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "symbolic/algebra/number_text.hpp"
#include "symbolic/error.hpp"
#include "symbolic/search/conditions/parametric_block.hpp"
#include "symbolic/search/conditions/rank_conditions.hpp"
#include "symbolic/search/conditions/special_model.hpp"
#include "symbolic/search/conditions/special_sets.hpp"
#include "symbolic/search/conditions/special_values.hpp"
#include "symbolic/search/finder.hpp"
#include "symbolic/search/polynomial_system.hpp"

namespace casimir::search {
namespace {

using GiNaC::ex;

/// Whether the difference is zero where the symbols have these values; it need have no value there.
bool vanishes_at(const ex& difference, const GiNaC::exmap& values) {
  try {
    return difference.subs(values).normal().is_zero();
  } catch (const GiNaC::pole_error&) {
    return false;
  }
}

/// Values of some parameters, as a model is put to them.
struct Place {
  std::vector<std::pair<GiNaC::symbol, ex>> values;
  std::vector<std::pair<std::string, std::string>> names;
};

// For which values a of a parameter is there an additional integral of the degree? The equations
// for the coefficients of an integral are A(a) c = 0, where A is a matrix of polynomials in a, and
// in the other parameters, which have generic values. There are more solutions at a value than in
// general exactly where A loses rank; there all minors of full rank vanish, and so do the common
// factors of any combinations of them. So the roots of these are all candidates, and
//
//   - each is decided by an exact search at the value, a factor without real roots has none; a
//     factor with real roots that are not rational leaves the answer open (add_factor);
//   - A has to be polynomial in a: if a is inside a function, then at special values this may be
//     another function, of which no minor knows (inside_functions);
//   - the level has to be the same for all a, or its leading monomials might change (run);
//   - parameters obey no equations: with I for a number without one, the minors I^2 + a and
//     a*I^2 + 1 have no common factor, while both vanish at a = 1 (run);
//   - the generic search has to be complete, with functions that are independent (Finder::doubt);
//   - denominators that are multiplied out change nothing where they do not vanish identically;
//     where they do, the equations have no meaning (meaningless);
//   - new Casimir functions are integrals, which the generic ones do not generate.
//
// For several parameters common factors of minors are hypersurfaces. All minors may vanish on
// smaller sets as well: none are left where one combination of minors has no other factors
// (RankConditions::covered), and where on the hypersurfaces themselves the rank is the same
// everywhere but on parts that are known (look_inside); else they are sought among simple ones and
// the answer is open.
class ConditionFinder {
 public:
  ConditionFinder(const Model& model, const Request& request, const Watch& watch)
      : model_(model), request_(request), watch_(watch), finder_(model, request, watch) {}

  ConditionReport run(const std::vector<std::size_t>& free);

 private:
  void add_factor(const Polynomial& factor, const std::vector<std::size_t>& free);
  void add_roots(const Polynomial& factor, std::size_t place);
  bool look_inside(ParametricBlock block, const RankConditions& own, const Polynomial& surface,
                   const std::vector<std::size_t>& free);
  bool add_inside(const SpecialSet& surface, const Polynomial& factor,
                  const std::vector<std::size_t>& rest);
  void add_points(const std::vector<ParametricBlock>& blocks, const std::vector<std::size_t>& free);
  void add_sets(const std::vector<ParametricBlock>& blocks, const std::vector<std::size_t>& free);
  void try_values(std::size_t place);
  bool on_a_found_surface(const GiNaC::exmap& point) const;
  bool is_known(const Place& place) const;
  enum class Confirmed { found, none, open };
  Confirmed confirm(const Place& place, Condition condition);
  void leave_open(const std::string& reason);
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
  std::vector<Place> confirmed_;  ///< of the conditions with values, in their order
};

void ConditionFinder::leave_open(const std::string& reason) {
  report_.complete = false;
  constexpr std::size_t kLongest = 400;
  if (report_.reason.find(reason) != std::string::npos || report_.reason.size() > kLongest) return;
  report_.reason += (report_.reason.empty() ? "" : "; ") + reason;
}

/// In lowest terms already, since the two make an irreducible polynomial.
std::string ConditionFinder::quotient_text(const Polynomial& top, const Polynomial& bottom) {
  if (bottom.is_constant()) return text(top.scaled(1 / bottom.term_list()[0].first));
  return casimir::quotient_text(text(top), top.terms() > 1, text(bottom));
}

/// Whether the values are those of a known place, or lie in it.
bool ConditionFinder::is_known(const Place& place) const {
  GiNaC::exmap map;
  for (const auto& [symbol, value] : place.values) map.emplace(symbol, value);
  return std::any_of(confirmed_.begin(), confirmed_.end(), [&](const Place& known) {
    return std::all_of(known.values.begin(), known.values.end(), [&](const auto& entry) {
      return vanishes_at(ex(entry.first) - entry.second, map);
    });
  });
}

/// What is found at special values beside what is found for generic ones, and on sets around them.
ConditionFinder::Confirmed ConditionFinder::confirm(const Place& place, Condition condition) {
  condition.parameters = place.names;
  for (const auto& [symbol, value] : place.values) condition.values.push_back(value);
  std::string where;
  for (const auto& [name, value] : place.names)
    where += fmt::format("{}{} = {}", where.empty() ? "" : ", ", name, value);
  try {
    Model special = model_;
    for (const auto& [symbol, value] : place.values) {
      std::optional<Model> next = with_value(special, symbol, value);
      if (!next) return Confirmed::none;
      special = std::move(*next);
    }
    if (contradict(special) || is_meaningless(special)) return Confirmed::none;
    Request request = request_;
    request.casimirs_are_integrals = true;
    GiNaC::exmap here;
    for (const auto& [symbol, value] : place.values) here.emplace(symbol, value);
    const auto know = [&](const std::vector<Found>& list) {
      for (const Found& found : list)
        request.known.push_back(
            {found.text, found.value.subs(here, GiNaC::subs_options::no_pattern), {}});
    };
    know(report_.generic.casimirs);
    know(report_.generic.found);
    for (std::size_t i = 0; i < confirmed_.size(); ++i) {
      Place known = confirmed_[i];
      const bool around = std::all_of(known.values.begin(), known.values.end(), [&](const auto& e) {
        return vanishes_at(ex(e.first) - e.second, here);
      });
      if (around) know(report_.conditions[i].found);
    }
    const Report found = find_integrals(special, request, watch_);
    condition.found = additional(special, found.found, request.known);
    condition.verdict = found.complete ? Verdict::proved : Verdict::undecided;
    if (!found.complete) {
      leave_open(fmt::format("whether there is an additional one at {} is undecided: {}", where,
                             found.reason));
    }
    if (condition.found.empty()) return found.complete ? Confirmed::none : Confirmed::open;
  } catch (const GiNaC::pole_error&) {
    // Not of the equations, but of what is compared with what is found.
    leave_open(fmt::format("the search at {} has no answer: a division by zero", where));
    return Confirmed::open;
  } catch (const ModelError& problem) {
    leave_open(fmt::format("the search at {} has no answer: {}", where, problem.what()));
    return Confirmed::open;
  } catch (const CaseError& problem) {
    // The level or a declared function uses a definition that has no value there.
    leave_open(fmt::format("the search at {} has no answer: {}", where, problem.text()));
    return Confirmed::open;
  } catch (const TooMuchWork& problem) {
    leave_open(fmt::format("the search at {} has no answer: {}", where, problem.what()));
    return Confirmed::open;
  }
  const auto after_the_confirmed = static_cast<std::ptrdiff_t>(confirmed_.size());
  confirmed_.push_back(place);
  report_.conditions.insert(report_.conditions.begin() + after_the_confirmed, std::move(condition));
  return Confirmed::found;
}

/// Linear in a parameter that none of its functions depends on, as a - |a| does on a.
bool is_linear_in(const FunctionRing& ring, const Polynomial& factor, std::size_t place) {
  if (factor.degree(place) != 1) return false;
  return std::ranges::none_of(factor.coefficients(place),
                              [&](const Polynomial& c) { return ring.depends_on(c, place); });
}

void ConditionFinder::add_factor(const Polynomial& factor, const std::vector<std::size_t>& free) {
  if (std::any_of(surfaces_.begin(), surfaces_.end(),
                  [&](const Polynomial& known) { return known == factor; }))
    return;
  surfaces_.push_back(factor);
  Condition condition;
  condition.relation = text(factor);
  // Solved for a parameter in which it is linear, if there is one.
  std::optional<std::size_t> main, only;
  std::size_t used = 0;
  for (std::size_t i = 0; i < factor.ring().size(); ++i) {
    if (!factor.uses(i)) continue;
    ++used;
    only = i;
  }
  for (const std::size_t place : free) {
    if (!is_linear_in(finder_.system().functions(), factor, place)) continue;
    if (!main || factor.coefficients(place)[1].is_constant()) main = place;
  }
  if (!main) {
    if (used == 1 && real_roots(factor, *only) == 0) return;
    if (used == 1 && factor.degree(*only) == 2 && std::ranges::find(free, *only) != free.end())
      return add_roots(factor, *only);
    leave_open(fmt::format("'{} = 0' has no rational solution to confirm", condition.relation));
    report_.conditions.push_back(condition);
    return;
  }
  const std::vector<Polynomial> parts = factor.coefficients(*main);
  const ex value = finder_.system().functions().quotient(-parts[0], parts[1]);
  const Place place{{{parameter(*main), value}},
                    {{parameter(*main).get_name(), quotient_text(-parts[0], parts[1])}}};
  // Where the leading coefficient vanishes, the value is none: a set of two conditions.
  if (used == 1) condition.relation.clear();
  confirm(place, condition);
}

/// Both roots of a factor of degree two in one parameter, with numbers for coefficients.
void ConditionFinder::add_roots(const Polynomial& factor, std::size_t place) {
  const FunctionRing& ring = finder_.system().functions();
  const std::vector<Polynomial> c = factor.coefficients(place);
  const ex a = ring.expression(c[2]), b = ring.expression(c[1]),
           discriminant = b * b - 4 * a * ring.expression(c[0]);
  for (const int sign : {1, -1}) {
    const ex value = ((GiNaC::sqrt(discriminant) * sign - b) / (2 * a)).expand();
    Condition condition;
    condition.relation = text(factor);
    const Place own{{{parameter(place), value}},
                    {{parameter(place).get_name(), finder_.system().text_of(value)}}};
    if (confirm(own, condition) == Confirmed::open && sign > 0)
      report_.conditions.push_back(condition);
  }
}

bool ConditionFinder::on_a_found_surface(const GiNaC::exmap& point) const {
  const FunctionRing& ring = finder_.system().functions();
  return std::any_of(surfaces_.begin(), surfaces_.end(), [&](const Polynomial& surface) {
    return ring.expression(surface).subs(point).expand().is_zero();
  });
}

/// A parameter that is a polynomial in the others where the condition vanishes, and its value.
std::optional<std::pair<std::size_t, Polynomial>> solved_for(const FunctionRing& ring,
                                                             const Polynomial& condition,
                                                             const std::vector<std::size_t>& free) {
  for (const std::size_t place : free) {
    if (!is_linear_in(ring, condition, place)) continue;
    const std::vector<Polynomial> parts = condition.coefficients(place);
    if (parts[1].is_constant())
      return std::pair{place, parts[0].scaled(-1 / parts[1].term_list()[0].first)};
  }
  return std::nullopt;
}

/// Whether it has no real zero, as far as that is known: it depends on one symbol alone.
bool has_no_real_zero(const Polynomial& factor) {
  std::vector<std::size_t> used;
  for (std::size_t i = 0; i < factor.ring().size(); ++i)
    if (factor.uses(i)) used.push_back(i);
  return used.size() == 1 && real_roots(factor, used[0]) == 0;
}

/// How many of the parameters the block depends on.
std::size_t used_by(const ParametricBlock& block, const std::vector<std::size_t>& free) {
  const auto is_used = [&](std::size_t place) {
    return std::ranges::any_of(block.rows, [&](const ParametricBlock::Row& row) {
      return std::ranges::any_of(row, [&](const auto& entry) { return entry.second.uses(place); });
    });
  };
  return static_cast<std::size_t>(std::ranges::count_if(free, is_used));
}

/// On a surface where a block loses rank it may lose more on some parts: there are more solutions
/// than those that the surface has everywhere. Confirms the parts that are found.
/// \return  whether that are all of them
bool ConditionFinder::look_inside(ParametricBlock block, const RankConditions& own,
                                  const Polynomial& surface, const std::vector<std::size_t>& free) {
  // Below rank one there is nothing more to lose.
  if (own.rank <= 1 || used_by(block, free) <= 1 || has_no_real_zero(surface)) return true;
  const auto value = solved_for(finder_.system().functions(), surface, free);
  if (!value) return false;
  block.put(value->first, value->second);
  std::vector<std::size_t> rest = free;
  std::erase(rest, value->first);
  const RankConditions inside = rank_conditions(finder_.system(), block, rest, watch_);
  bool all = inside.decided && inside.covered;
  for (const Polynomial& factor : inside.factors) all = add_inside({{*value}}, factor, rest) && all;
  return all;
}

/// One part of a surface.
/// \return  whether it is known what there is on it, and that it has no such parts of its own
bool ConditionFinder::add_inside(const SpecialSet& surface, const Polynomial& factor,
                                 const std::vector<std::size_t>& rest) {
  if (has_no_real_zero(factor)) return true;
  const FunctionRing& ring = finder_.system().functions();
  const auto value = solved_for(ring, factor, rest);
  if (!value) return false;
  SpecialSet set = surface;
  for (auto& [known, old] : set.values)
    old = substituted(old, value->first, value->second, old.ring().constant(1));
  set.values.push_back(*value);
  std::ranges::sort(set.values, {}, [](const auto& entry) { return entry.first; });
  Place place;
  for (const auto& [known, own] : set.values) {
    place.values.emplace_back(parameter(known), ring.expression(own));
    place.names.emplace_back(parameter(known).get_name(), text(own));
  }
  // It lies in a known place; only itself is not to be confirmed twice.
  if (std::ranges::none_of(confirmed_, [&](const Place& p) { return p.names == place.names; }))
    confirm(place, {});
  return rest.size() == 1;
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
    std::vector<Condition> points;
    try {
      const std::optional<Model> special = with_value(model_, first, number);
      if (!special || is_meaningless(*special)) continue;
      points =
          find_conditions(*special, request_, {{second.get_name(), {}, {}}}, watch_).conditions;
    } catch (const ModelError& problem) {
      leave_open(fmt::format("the search at {} = {} has no answer: {}", first.get_name(),
                             rational_text(value), problem.what()));
    }
    for (const Condition& point : points) {
      if (point.parameters.empty() || point.found.empty()) continue;
      const ex& other = point.values[0];
      if (on_a_found_surface({{first, number}, {second, other}})) continue;
      const Place place{{{first, number}, {second, other}},
                        {{first.get_name(), rational_text(value)}, point.parameters[0]}};
      if (!is_known(place)) confirm(place, {});
    }
  }
}

/// Sets of two and more conditions.
void ConditionFinder::add_sets(const std::vector<ParametricBlock>& blocks,
                               const std::vector<std::size_t>& free) {
  const FunctionRing& ring = finder_.system().functions();
  for (SpecialSet& set : special_sets(finder_.system(), blocks, free, surfaces_, watch_)) {
    std::sort(set.values.begin(), set.values.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
    Place place;
    for (const auto& [parameter_place, value] : set.values) {
      place.values.emplace_back(parameter(parameter_place), ring.expression(value));
      place.names.emplace_back(parameter(parameter_place).get_name(), text(value));
    }
    if (!is_known(place)) confirm(place, {});
  }
}

/// A parameter that is inside a function: no algebra leads to its special values.
void ConditionFinder::try_values(std::size_t place) {
  for (const cln::cl_RA& value : simple_values(model_)) {
    watch_.tick(0.5);
    const Place own{{{parameter(place), GiNaC::numeric(value)}},
                    {{parameter(place).get_name(), rational_text(value)}}};
    if (!is_known(own)) confirm(own, {});
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
  if (const std::string bound = finder_.system().bound_parameter(); !bound.empty())
    leave_open(fmt::format("'{}' is taken as a parameter of its own", bound));
  if (!ansatz.coprime || !ansatz.independent)
    leave_open("only cofactors of low degree were tried, and the functions may need others");
  if (!ansatz.closed)
    leave_open("by a relation, a monomial is equal to one that is beyond a limit of the degrees");
  const std::vector<std::size_t> inside = inside_functions(finder_.system(), free);
  for (const std::size_t place : inside) {
    leave_open(fmt::format("'{}' is inside a function, of which only simple values were tried",
                           parameter(place).get_name()));
  }
  for (const Polynomial& level : problem.on) {
    for (const std::size_t place : free) {
      if (level.uses(place))
        leave_open(fmt::format("the level depends on '{}'", parameter(place).get_name()));
    }
  }
  std::vector<RankConditions> losses;
  bool covered = true;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    watch_.tick(static_cast<double>(b) / static_cast<double>(blocks.size()));
    const RankConditions own = rank_conditions(finder_.system(), blocks[b], free, watch_);
    if (!own.decided) {
      leave_open(
          "some block of equations is too large, or its conditions involve further parameters: "
          "give numbers to other parameters, or free them too");
    }
    covered = covered && own.covered;
    losses.push_back(own);
  }
  for (const RankConditions& own : losses)
    for (const Polynomial& factor : own.factors) add_factor(factor, free);
  for (const std::size_t place : inside) try_values(place);
  if (free.size() > 1) {
    for (std::size_t b = 0; b < blocks.size() && covered; ++b)
      for (const Polynomial& factor : losses[b].factors)
        covered = look_inside(blocks[b], losses[b], factor, free) && covered;
    if (free.size() == 2) add_points(blocks, free);
    add_sets(blocks, free);
    report_.sets_open = report_.complete && !covered;
    if (!covered) leave_open("sets of two and more conditions were sought among simple ones only");
  }
  return report_;
}

}  // namespace

ConditionReport find_conditions(const Model& model, const Request& request,
                                const std::vector<Text>& free, const Watch& watch) {
  if (request.degree < 0 && request.degree_in.empty())
    throw ModelError("the degree of a search is not negative");
  return ConditionFinder(model, request, watch).run(free_places(model, free));
}

}  // namespace casimir::search
