// Changes of variables: Borisov & Mamaev, Sec. 1.3.
#include "symbolic/coordinates.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <deque>
#include <new>
#include <optional>
#include <set>

#include "symbolic/algebra/exact_constant.hpp"
#include "symbolic/algebra/where_defined.hpp"
#include "symbolic/expression/decimal.hpp"
#include "symbolic/expression/expression.hpp"
#include "symbolic/expression/expression_size.hpp"

namespace casimir {
namespace {

using GiNaC::ex;

constexpr auto kPlain = GiNaC::subs_options::no_pattern;

GiNaC::exmap substitution(const std::vector<GiNaC::symbol>& symbols,
                          const std::vector<ex>& values) {
  GiNaC::exmap map;
  for (std::size_t i = 0; i < symbols.size(); ++i) map[symbols[i]] = values[i];
  return map;
}

bool only_about(const ex& expression, const std::vector<GiNaC::symbol>& variables) {
  for (auto it = expression.preorder_begin(); it != expression.preorder_end(); ++it) {
    if (GiNaC::is_a<GiNaC::symbol>(*it) &&
        std::none_of(variables.begin(), variables.end(), [&](const GiNaC::symbol& s) {
          return s.is_equal(GiNaC::ex_to<GiNaC::symbol>(*it));
        }))
      return false;
  }
  return true;
}

bool same_bracket(const PoissonStructure& a, const PoissonStructure& b) {
  if (a.dimension() != b.dimension()) return false;
  const std::vector<ex> names(a.coordinates().begin(), a.coordinates().end());
  const GiNaC::exmap renamed = substitution(b.coordinates(), names);
  for (std::size_t i = 0; i < a.dimension(); ++i) {
    for (std::size_t j = i + 1; j < a.dimension(); ++j) {
      if (!(a(i, j) - b(i, j).subs(renamed, kPlain)).expand().is_zero()) return false;
    }
  }
  return true;
}

bool same_names(const std::vector<GiNaC::symbol>& a, const std::vector<GiNaC::symbol>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const auto& x, const auto& y) { return x.get_name() == y.get_name(); });
}

enum class Truth { no, yes, unknown };

/// Whether a condition holds at an exact point: exactly where that is decided, else by 60 digits.
Truth holds(const Assumption& condition, const GiNaC::exmap& point, const Limits& limits) {
  if (condition.holds_at(point, limits)) return Truth::yes;
  const auto decide = [&] {
    const ex value = substituted(condition.difference, point, limits);
    if (const auto constant = exact_constant(value); constant && constant->zero)
      return casimir::holds(condition.comparison, 0) ? Truth::yes : Truth::no;
    const std::optional<GiNaC::numeric> number = decimal(value, limits.bits);
    if (!number) return Truth::unknown;
    const GiNaC::numeric& x = *number;
    if (!x.is_real()) return Truth::no;
    if (GiNaC::abs(x) < GiNaC::pow(GiNaC::numeric(10), GiNaC::numeric(-12))) return Truth::no;
    return casimir::holds(condition.comparison, x.is_positive() ? 1 : -1) ? Truth::yes : Truth::no;
  };
  return where_defined(decide).value_or(Truth::no);
}

/// Whether a function that has to vanish does not, as far as can be told.
bool surely_nonzero(const ex& value, const Limits& limits) {
  if (const auto constant = exact_constant(value)) return !constant->zero;
  const std::optional<GiNaC::numeric> number = decimal(value, limits.bits);
  return !number || GiNaC::abs(*number) > GiNaC::pow(GiNaC::numeric(10), GiNaC::numeric(-12));
}

std::string decimal_text(const ex& value, const Limits& limits) {
  const std::optional<GiNaC::numeric> number = real_decimal(value, limits.bits);
  return number ? fmt::format("{:.6g}", number->to_double()) : "?";
}

std::string point_text(const std::vector<GiNaC::symbol>& variables, const std::vector<ex>& point,
                       const Limits& limits) {
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < variables.size(); ++i) {
    parts.push_back(
        fmt::format("{} = {}", variables[i].get_name(), decimal_text(point[i], limits)));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

/// Carries one case along one map.
class Carrier {
 public:
  Carrier(const Model& model, const Atlas& atlas, const CoordinateChange& map,
          const CoordinateChange& inverse, bool last)
      : model_(model),
        last_(last),
        atlas_(atlas),
        map_(map),
        inverse_(inverse),
        set_(atlas.sets[map.from]),
        to_new_(substitution(model.variables, map.branches[0].expressions)) {
    for (const GiNaC::symbol& s : set_.variables) taken_.insert(s.get_name());
    rename_parameters();
  }

  Model carry() {
    Model result;
    result.limits = model_.limits;
    result.name = model_.name;
    result.file = model_.file;
    result.title = fmt::format("{}, in the variables of '{}'", model_.title, set_.name);
    result.source = model_.source;
    result.book = model_.book;
    result.tags = model_.tags;
    result.phase_space = set_.canonical ? "canonical" : set_.name;
    result.variables = set_.variables;
    result.parameters = parameters_;
    result.time = model_.time;
    result.fixed = model_.fixed;
    for (const Assumption& assumption : model_.assumptions) {
      result.assumptions.push_back(
          {carried(assumption.difference), assumption.comparison, assumption.text});
      need(assumption.difference, result.domain);
    }
    for (const Assumption& assumption : set_.domain) result.assumptions.push_back(assumption);
    result.constraints = set_.constraints;
    result.linear_bracket = set_.linear_bracket;
    result.poisson = set_.bracket;
    result.bracket_domain = set_.bracket_domain;
    result.hamiltonian = carried(*model_.hamiltonian);
    // Nothing is said of points at which the case, as it is written, has no values there.
    result.domain.insert(result.domain.end(), map_.domain.begin(), map_.domain.end());
    need(*model_.hamiltonian, result.domain);
    for (const ex& part : model_.domain) need(part, result.domain);
    result.field = set_.bracket.flow(*result.hamiltonian);
    result.conditionals = carried(model_.conditionals);
    // A Casimir function need not be one on a larger space, but it is an integral there; where the
    // map is Poisson on the constraints alone, only on these.
    for (const auto* list : {&model_.casimirs, &model_.integrals}) {
      for (const NamedExpression& f : *list) {
        const NamedExpression next = carried(f, free_name(f.name));
        if (map_.on.empty())
          result.integrals.push_back(next);
        else
          result.conditionals.push_back({next, map_.on});
      }
    }
    if (last_) {
      for (const NamedExpression& f : set_.casimirs)
        result.casimirs.push_back({free_name(f.name), f.value, {}, f.domain});
    }
    result.invariant_relations = carried(model_.invariant_relations);
    for (LaxPair pair : model_.lax_pairs) {
      std::vector<ex> domain;
      for (const ex& part : pair.domain) need(part, domain);
      for (const auto* matrix : {&pair.l, &pair.a})
        for (std::size_t i = 0; i < matrix->nops(); ++i) need(matrix->op(i), domain);
      pair.domain = std::move(domain);
      for (NamedExpression& f : pair.on) f = carried(f, f.name);
      for (unsigned i = 0; i < pair.l.rows(); ++i) {
        for (unsigned j = 0; j < pair.l.cols(); ++j) {
          pair.l(i, j) = carried(pair.l(i, j));
          pair.a(i, j) = carried(pair.a(i, j));
        }
      }
      result.lax_pairs.push_back(std::move(pair));
    }
    if (model_.section) {
      Section section = *model_.section;
      section.function = carried(section.function);
      for (ex& e : section.plot) e = carried(e);
      result.section = std::move(section);
    }
    for (const Scene& scene : model_.scenes) result.scenes.push_back(carried(scene));
    return result;
  }

 private:
  void rename_parameters() {
    for (const GiNaC::symbol& parameter : model_.parameters) {
      if (taken_.contains(parameter.get_name())) {
        parameters_.push_back(GiNaC::symbol(free_name(parameter.get_name())));
        to_new_[parameter] = parameters_.back();
      } else {
        parameters_.push_back(parameter);
        taken_.insert(parameter.get_name());
      }
    }
  }

  std::string free_name(std::string name) {
    while (taken_.contains(name)) name += '_';
    taken_.insert(name);
    return name;
  }

  ex carried(const ex& expression) const { return expression.subs(to_new_, kPlain); }

  /// What has to have values where a function of the case is taken at the image of a point.
  void need(const ex& expression, std::vector<ex>& domain) const {
    for (const ex& part : substituted_with_parts(expression, to_new_, model_.limits))
      domain.push_back(part);
  }

  NamedExpression carried(const NamedExpression& f, std::string name) const {
    NamedExpression result{std::move(name), carried(f.value), {}, {}};
    for (const ex& part : f.domain) need(part, result.domain);
    need(f.value, result.domain);
    return result;
  }

  std::vector<LevelClaim> carried(const std::vector<LevelClaim>& claims) {
    std::vector<LevelClaim> result;
    for (const LevelClaim& claim : claims) {
      LevelClaim next{carried(claim.expression, free_name(claim.expression.name)), {}};
      for (const NamedExpression& f : claim.on) next.on.push_back(carried(f, f.name));
      // What is true on the image of the constraints is true on them.
      if (last_) next.on.insert(next.on.end(), set_.constraints.begin(), set_.constraints.end());
      result.push_back(std::move(next));
    }
    return result;
  }

  Scene carried(const Scene& scene) const {
    Scene result = scene;
    result.observe.clear();
    result.reference.clear();
    result.initial.assign(set_.variables.size(), ex(0));
    if (!scene.unusable.empty()) return result;
    try {
      const Limits& limits = model_.limits;
      result.initial = image_of(atlas_, inverse_, scene.initial, limits);
      for (const NamedExpression& f : map_.on) {
        if (surely_nonzero(
                substituted(f.value, substitution(set_.variables, result.initial), limits), limits))
          throw SingularPoint(fmt::format("{} is not zero there", printable(f.name)));
      }
    } catch (const SingularPoint& problem) {
      result.unusable = fmt::format("the scene '{}' cannot be given in the variables of '{}': {}",
                                    printable(scene.name), set_.name, problem.what());
      result.singular = true;
    }
    return result;
  }

  const Model& model_;
  const bool last_;  ///< no further map follows
  const Atlas& atlas_;
  const CoordinateChange& map_;
  const CoordinateChange& inverse_;
  const Coordinates& set_;
  GiNaC::exmap to_new_;
  std::set<std::string> taken_{"H"};
  std::vector<GiNaC::symbol> parameters_;
};

}  // namespace

std::size_t Atlas::set_of(const Model& model, bool canonical) {
  Coordinates own{model.name, model.variables,      *model.poisson,      canonical, {}, {},
                  {},         model.linear_bracket, model.bracket_domain};
  for (const Assumption& a : model.assumptions) {
    if (only_about(a.difference, model.variables)) own.domain.push_back(a);
  }
  for (const NamedExpression& c : model.constraints) {
    if (only_about(c.value, model.variables)) own.constraints.push_back(c);
  }
  for (const NamedExpression& c : model.casimirs) {
    if (only_about(c.value, model.variables)) own.casimirs.push_back(c);
  }
  const auto same = [&](const Coordinates& set) { return set.name == own.name; };
  const auto known = std::find_if(sets.begin(), sets.end(), same);
  std::size_t from = sets.size();
  if (known == sets.end()) {
    sets.push_back(own);
  } else {
    // It was met before as the target of a map, over other symbols and without its domain.
    from = static_cast<std::size_t>(known - sets.begin());
    const std::vector<ex> names(known->variables.begin(), known->variables.end());
    const GiNaC::exmap renamed = substitution(own.variables, names);
    for (Assumption& a : own.domain) a.difference = a.difference.subs(renamed, kPlain);
    const auto rename = [&](std::vector<ex>& parts) {
      for (ex& part : parts) part = part.subs(renamed, kPlain);
    };
    for (auto* list : {&own.constraints, &own.casimirs}) {
      for (NamedExpression& f : *list) {
        f.value = f.value.subs(renamed, kPlain);
        rename(f.domain);
      }
    }
    rename(own.bracket_domain);
    known->domain = own.domain;
    known->constraints = own.constraints;
    known->casimirs = own.casimirs;
    known->canonical = canonical;
    known->linear_bracket = own.linear_bracket;
    known->bracket_domain = own.bracket_domain;
  }
  return from;
}

void Atlas::add_changes(const Model& model, std::size_t from) {
  const std::vector<ex> names(sets[from].variables.begin(), sets[from].variables.end());
  const GiNaC::exmap own_names = substitution(model.variables, names);
  for (const PoissonMap& map : model.maps) {
    if (map.inverses.empty() || map.to.empty() || map.sign != 1) continue;
    const std::size_t to = set_for(map);
    const std::vector<ex> targets(sets[to].variables.begin(), sets[to].variables.end());
    const GiNaC::exmap target_names = substitution(map.target.coordinates(), targets);
    const auto renamed = [](const ex& e, const GiNaC::exmap& r) { return e.subs(r, kPlain); };
    CoordinateChange forward{map.name, from, to, true, {{{}, sets[from].domain}}, {}, {}};
    for (const ex& e : map.expressions)
      forward.branches[0].expressions.push_back(renamed(e, own_names));
    for (const NamedExpression& f : map.on)
      forward.on.push_back({f.name, renamed(f.value, own_names), {}});
    for (const ex& part : map.domain) forward.domain.push_back(renamed(part, own_names));
    CoordinateChange backward{map.name, to, from, false, {}, {}, {}};
    for (const MapInverse& inverse : map.inverses) {
      CoordinateChange::Branch branch;
      for (const ex& e : inverse.expressions)
        branch.expressions.push_back(renamed(e, target_names));
      for (const Assumption& a : inverse.domain)
        branch.domain.push_back({renamed(a.difference, target_names), a.comparison, a.text});
      backward.branches.push_back(std::move(branch));
    }
    for (const NamedExpression& f : map.image)
      backward.image.push_back({f.name, renamed(f.value, target_names), {}});
    changes.push_back(std::move(forward));
    changes.push_back(std::move(backward));
  }
}

void Atlas::add(const Model& model, bool canonical) {
  const bool changes_variables =
      std::any_of(model.maps.begin(), model.maps.end(),
                  [](const PoissonMap& map) { return !map.inverses.empty() && !map.to.empty(); });
  if (!changes_variables || !model.poisson) return;
  add_changes(model, set_of(model, canonical));
}

std::size_t Atlas::set_for(const PoissonMap& map) {
  for (std::size_t i = 0; i < sets.size(); ++i) {
    if (sets[i].name == map.to) return i;
  }
  sets.push_back({map.to, map.target.coordinates(), map.target, false, {}, {}, {}, true});
  return sets.size() - 1;
}

std::size_t Atlas::named(const std::string& name) const {
  std::vector<std::string> known;
  for (std::size_t i = 0; i < sets.size(); ++i) {
    if (sets[i].name == name) return i;
    known.push_back(sets[i].name);
  }
  throw ModelError(fmt::format("there are no variables '{}'; {}", printable(name),
                               suggest_or_list(name, known)));
}

std::size_t Atlas::of(const Model& model) const {
  for (std::size_t i = 0; i < sets.size(); ++i) {
    if (sets[i].name == model.name && sets[i].variables.size() == model.variables.size() &&
        same_names(sets[i].variables, model.variables))
      return i;
  }
  if (model.poisson) {
    for (std::size_t i = 0; i < sets.size(); ++i) {
      if (same_bracket(sets[i].bracket, *model.poisson) &&
          (!sets[i].canonical || same_names(sets[i].variables, model.variables)))
        return i;
    }
  }
  throw ModelError(fmt::format("no map is known from the variables of '{}' ({})",
                               printable(model.name), model.phase_space));
}

std::vector<const CoordinateChange*> Atlas::path(std::size_t from, std::size_t to,
                                                 bool forward) const {
  std::vector<const CoordinateChange*> arrived(sets.size(), nullptr);
  std::deque<std::size_t> open{from};
  std::vector<bool> seen(sets.size());
  seen[from] = true;
  while (!open.empty() && !seen[to]) {
    const std::size_t here = open.front();
    open.pop_front();
    for (const CoordinateChange& change : changes) {
      if (change.from != here || seen[change.to] || (forward && !change.forward)) continue;
      seen[change.to] = true;
      arrived[change.to] = &change;
      open.push_back(change.to);
    }
  }
  std::vector<const CoordinateChange*> result;
  for (std::size_t at = to; arrived[at] != nullptr && at != from; at = arrived[at]->from)
    result.insert(result.begin(), arrived[at]);
  return result;
}

std::vector<ex> image_of(const Atlas& atlas, const CoordinateChange& change,
                         const std::vector<ex>& point, const Limits& limits) {
  const Coordinates& from = atlas.sets[change.from];
  const Coordinates& to = atlas.sets[change.to];
  const GiNaC::exmap at = substitution(from.variables, point);
  for (const NamedExpression& f : change.image) {
    const ex value = substituted(f.value, at, limits);
    if (surely_nonzero(value, limits)) {
      const auto constant = exact_constant(value);
      throw SingularPoint(fmt::format(
          "the point is not in the image of the map '{}': {} = {}, not 0", change.name,
          printable(f.name), constant ? printable(constant->text) : decimal_text(value, limits)));
    }
  }
  std::string failed;
  for (const CoordinateChange::Branch& branch : change.branches) {
    bool inside = true;
    for (const Assumption& condition : branch.domain) {
      if (holds(condition, at, limits) == Truth::yes) continue;
      inside = false;
      failed = condition.text;
    }
    if (!inside) continue;
    try {
      std::vector<ex> result;
      for (const ex& e : branch.expressions) result.push_back(e.subs(at, kPlain));
      const GiNaC::exmap there = substitution(to.variables, result);
      for (const Assumption& condition : to.domain) {
        if (holds(condition, there, limits) != Truth::yes) {
          inside = false;
          failed = condition.text;
        }
      }
      for (const ex& e : result) {
        if (!decimal(e, limits.bits)) inside = false;
      }
      if (inside) return result;
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const TooLarge&) {
      throw;
    } catch (const std::exception&) {  // GiNaC's own errors have no common type
      failed = failed.empty() ? "its expressions have a pole" : failed;
    }
  }
  throw SingularPoint(fmt::format("the variables of '{}' are singular at {}{}", to.name,
                                  point_text(from.variables, point, limits),
                                  failed.empty() ? "" : fmt::format(" ({} fails)", failed)));
}

Model in_coordinates(const Model& model, const Atlas& atlas, const std::string& set) {
  const std::size_t target = atlas.named(set);
  const std::size_t own = atlas.of(model);
  if (!model.hamiltonian) throw ModelError("a system given by [equations] cannot be carried");
  if (target == own) return model;
  std::vector<const CoordinateChange*> maps = atlas.path(target, own, true);
  if (maps.empty()) {
    throw ModelError(fmt::format(
        "no Poisson maps lead from the variables of '{0}' onto those of '{1}', so its equations "
        "cannot be carried there; only the answer can be given in them",
        printable(set), printable(model.name)));
  }
  Model result = model;
  // From the case outwards: the last map of the chain first.
  for (auto map = maps.rbegin(); map != maps.rend(); ++map) {
    const auto inverse = std::find_if(
        atlas.changes.begin(), atlas.changes.end(), [&](const CoordinateChange& change) {
          return !change.forward && change.from == (*map)->to && change.to == (*map)->from;
        });
    const bool last = std::next(map) == maps.rend();
    result = Carrier(result, atlas, **map, *inverse, last).carry();
  }
  result.title = fmt::format("{}, in the variables of '{}'", model.title, atlas.sets[target].name);
  return result;
}

}  // namespace casimir
