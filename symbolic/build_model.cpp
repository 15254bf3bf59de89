// Case files to models: every expression is read, every name declared once.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>

#include "symbolic/expression.hpp"
#include "symbolic/model.hpp"
#include "symbolic/phase_space.hpp"

namespace casimir {
namespace {

using GiNaC::ex;

/// The names of a case file. A definition is read when it is first used, so that their order does
/// not matter; one that uses itself is an error.
class CaseNames : public Names {
 public:
  void declare(const Text& name, const std::string& what, Quantity quantity) {
    check_name(name, what);
    if (table_.contains(name.value) || pending_.contains(name.value)) {
      throw name.error(fmt::format("'{}' is declared twice", name.value));
    }
    table_[name.value] = std::move(quantity);
  }

  void define(const Entry& entry) {
    check_name(entry.first, "a definition");
    if (table_.contains(entry.first.value)) {
      throw entry.first.error(fmt::format("'{}' is declared twice", entry.first.value));
    }
    pending_[entry.first.value] = &entry;
  }

  /// Names an expression already read, unless the name is taken: for use in further expressions.
  void alias(const std::string& name, Quantity quantity) {
    table_.try_emplace(name, std::move(quantity));
  }

  const Quantity* find(const std::string& name) override {
    const auto known = table_.find(name);
    if (known != table_.end()) return &known->second;
    const auto waiting = pending_.find(name);
    if (waiting == pending_.end()) return nullptr;
    const Entry& entry = *waiting->second;
    constexpr std::size_t kMaxChain = 100;
    if (open_.contains(name) || open_.size() > kMaxChain) {
      throw entry.second.error(
          fmt::format("the definition of '{}' {}", name,
                      open_.contains(name) ? "uses itself" : "is nested too deep"));
    }
    open_.insert(name);
    Quantity value = parse_expression(entry.second, *this);
    open_.erase(name);
    return &(table_[name] = std::move(value));
  }

  std::vector<std::string> known() const override {
    std::vector<std::string> names;
    for (const auto& [name, quantity] : table_) names.push_back(name);
    for (const auto& [name, entry] : pending_) names.push_back(name);
    return names;
  }

 private:
  std::map<std::string, Quantity> table_;
  std::map<std::string, const Entry*> pending_;
  std::set<std::string> open_;
};

/// An exact real constant.
ex real_constant(const Text& text) {
  const ex value = parse_constant(text);
  const ex number = value.evalf();
  if (!GiNaC::is_a<GiNaC::numeric>(number) || !GiNaC::ex_to<GiNaC::numeric>(number).is_real()) {
    throw text.error("expected a real constant, such as 3/5 or sqrt(2)/2");
  }
  return value;
}

class Builder {
 public:
  Builder(const CaseFile& file, const ParameterValues& fixed) : file_(file), fixed_(fixed) {}

  Model build() {
    copy_texts();
    declare_names();
    read_equations();
    read_claims();
    for (const SceneText& scene : file_.scenes) read_scene(scene);
    return std::move(model_);
  }

 private:
  void copy_texts() {
    model_.name = file_.name;
    model_.file = file_.file;
    model_.title = file_.title;
    model_.source = file_.source;
    model_.tags = file_.tags;
    model_.integrable = file_.integrable;
    model_.phase_space = describe(file_.phase_space);
  }

  const Text* fixed_value(const std::string& parameter) const {
    const auto it = std::find_if(fixed_.begin(), fixed_.end(),
                                 [&](const auto& pair) { return pair.first.value == parameter; });
    return it == fixed_.end() ? nullptr : &it->second;
  }

  void declare_names() {
    model_.variables = make_variables(file_.phase_space);
    for (std::size_t i = 0; i < model_.variables.size(); ++i) {
      names_.declare(file_.phase_space.variables[i], "a variable",
                     Quantity::symbol(model_.variables[i]));
    }
    if (const auto& time = file_.phase_space.time) {
      model_.time = GiNaC::symbol(time->value);
      names_.declare(*time, "the time", Quantity::symbol(*model_.time));
    }
    std::vector<std::string> known;
    for (const ParameterText& parameter : file_.parameters) {
      known.push_back(parameter.name.value);
      if (const Text* text = fixed_value(parameter.name.value)) {
        const ex value = real_constant(*text);
        names_.declare(parameter.name, "a parameter", {value, 64, 0, 1});
        model_.fixed.emplace_back(parameter.name, value);
        continue;
      }
      model_.parameters.push_back(GiNaC::symbol(parameter.name.value));
      names_.declare(parameter.name, "a parameter", Quantity::symbol(model_.parameters.back()));
    }
    for (const auto& [name, value] : fixed_) {
      if (std::find(known.begin(), known.end(), name.value) == known.end()) {
        throw name.error(fmt::format("'{}' is not a parameter of this case", printable(name.value)),
                         0, suggest(name.value, known));
      }
    }
    for (const Entry& definition : file_.definitions) names_.define(definition);
    for (const Entry& definition : file_.definitions) {
      model_.definitions.push_back(
          named(definition.first, names_.find(definition.first.value)->value));
    }
    for (const ParameterText& parameter : file_.parameters) {
      for (const Text& text : parameter.assume) read_assumption(text);
    }
    for (const Text& text : file_.phase_space.domain) read_assumption(text);
  }

  void read_assumption(const Text& text) {
    const Relation relation = parse_relation(text, names_);
    const Assumption assumption{relation.lhs - relation.rhs, relation.relation, text.value};
    if (GiNaC::is_a<GiNaC::numeric>(assumption.difference) && !assumption.holds_at({})) {
      throw text.error(fmt::format("the assumption '{}' does not hold", printable(text.value)));
    }
    model_.assumptions.push_back(assumption);
  }

  void read_equations() {
    model_.poisson = make_bracket(file_.phase_space, model_.variables, names_);
    const Location where = file_.phase_space.where;
    if (file_.equations) {
      if (model_.poisson || file_.hamiltonian) {
        throw CaseError(where,
                        "a system is given either by [equations] or by a bracket and a "
                        "hamiltonian, not by both");
      }
      read_explicit_field();
      return;
    }
    if (!model_.poisson) {
      throw CaseError(where,
                      "the phase space needs a bracket: one of 'algebra', 'canonical', 'brackets' "
                      "and 'structure_constants'; or the file a table [equations]");
    }
    if (!file_.hamiltonian)
      throw CaseError({file_.file, 1, 1}, "the case file needs a key 'hamiltonian'");
    model_.hamiltonian = parse_expression(*file_.hamiltonian, names_).value;
    model_.field = model_.poisson->flow(*model_.hamiltonian);
  }

  void read_explicit_field() {
    std::map<std::string, const Text*> given;
    for (const auto& [key, text] : *file_.equations) {
      variable_position(key);
      given[key.value] = &text;
    }
    for (const GiNaC::symbol& x : model_.variables) {
      const auto it = given.find(x.get_name());
      if (it == given.end()) {
        throw CaseError(file_.phase_space.where,
                        fmt::format("[equations] has no equation for '{}'", x.get_name()));
      }
      model_.field.push_back(parse_expression(*it->second, names_).value);
    }
  }

  std::size_t variable_position(const Text& name) const {
    return position(name, model_.variables, "variable");
  }

  static std::size_t position(const Text& name, const std::vector<GiNaC::symbol>& symbols,
                              const std::string& what) {
    std::vector<std::string> known;
    for (std::size_t i = 0; i < symbols.size(); ++i) {
      if (symbols[i].get_name() == name.value) return i;
      known.push_back(symbols[i].get_name());
    }
    throw name.error(fmt::format("'{}' is not a {} of this case", printable(name.value), what), 0,
                     suggest(name.value, known));
  }

  static NamedExpression named(const Text& name, const ex& value) {
    return {name.value, value, name.where};
  }

  NamedExpression anonymous(const Text& text) {
    return {text.value, parse_expression(text, names_).value, text.where};
  }

  std::vector<NamedExpression> read_named(const std::vector<Entry>& entries) {
    std::vector<NamedExpression> result;
    for (const auto& [name, text] : entries) {
      check_name(name, "a function");
      const Quantity quantity = parse_expression(text, names_);
      result.push_back(named(name, quantity.value));
      names_.alias(name.value, quantity);
    }
    return result;
  }

  LevelClaim read_level(const LevelText& text) {
    LevelClaim claim{named(text.name, parse_expression(text.expression, names_).value), {}};
    for (const Text& relation : text.on) claim.on.push_back(anonymous(relation));
    return claim;
  }

  void read_claims() {
    if (!model_.poisson && !file_.casimirs.empty()) {
      throw file_.casimirs[0].first.error(
          "a Casimir function needs a bracket, which this phase space does not have");
    }
    if (!model_.poisson && !file_.maps.empty()) {
      throw file_.maps[0].name.error(
          "a Poisson map needs a bracket, which this phase space does not have");
    }
    model_.casimirs = read_named(file_.casimirs);
    model_.integrals = read_named(file_.integrals);
    for (const LevelText& text : file_.conditionals)
      model_.conditionals.push_back(read_level(text));
    for (const LevelText& text : file_.invariant_relations)
      model_.invariant_relations.push_back(read_level(text));
    for (const LaxText& text : file_.lax) read_lax(text);
    for (const MapText& text : file_.maps) read_map(text);
    for (const Text& text : file_.measures) model_.measures.push_back(anonymous(text));
    if (!file_.section) return;
    Section section{parse_expression(file_.section->function, names_).value, true, {}};
    if (const auto& direction = file_.section->direction) {
      if (direction->value != "up" && direction->value != "down")
        throw direction->error("'direction' must be \"up\" or \"down\"");
      section.upwards = direction->value == "up";
    }
    for (const Text& text : file_.section->plot)
      section.plot.push_back(parse_expression(text, names_).value);
    model_.section = section;
  }

  /// Names of the case and one more symbol.
  class Extended : public Names {
   public:
    Extended(Names& base, const GiNaC::symbol& extra)
        : base_(base), name_(extra.get_name()), extra_(Quantity::symbol(extra)) {}
    const Quantity* find(const std::string& name) override {
      return name == name_ ? &extra_ : base_.find(name);
    }
    std::vector<std::string> known() const override {
      std::vector<std::string> names = base_.known();
      names.push_back(name_);
      return names;
    }

   private:
    Names& base_;
    std::string name_;
    Quantity extra_;
  };

  void read_lax(const LaxText& text) {
    const std::size_t n = text.l.size();
    if (n == 0 || text.a.size() != n) {
      throw CaseError(
          {file_.file, text.l.empty() || text.l[0].empty() ? 1 : text.l[0][0].where.line, 1},
          "the matrices L and A of a Lax pair must have the same size");
    }
    LaxPair pair{std::nullopt, GiNaC::matrix(unsigned(n), unsigned(n)),
                 GiNaC::matrix(unsigned(n), unsigned(n))};
    pair.spectral = GiNaC::symbol(text.spectral ? text.spectral->value : "(none)");
    if (text.spectral) {
      check_name(*text.spectral, "the spectral parameter");
      if (names_.find(text.spectral->value) != nullptr)
        throw text.spectral->error(fmt::format("'{}' is declared twice", text.spectral->value));
    }
    Extended names(names_, *pair.spectral);
    for (unsigned i = 0; i < n; ++i) {
      for (unsigned j = 0; j < n; ++j) {
        pair.l(i, j) = parse_expression(text.l[i][j], names).value;
        pair.a(i, j) = parse_expression(text.a[i][j], names).value;
      }
    }
    if (!text.spectral) pair.spectral.reset();
    model_.lax_pairs.push_back(std::move(pair));
  }

  void read_map(const MapText& text) {
    PhaseSpaceText target;
    if (text.to_table) {
      target = *text.to_table;
    } else {
      target.where = text.to->where;
      target.algebra = text.to;
      for (const Entry& entry : text.expressions) target.variables.push_back(entry.first);
    }
    const std::vector<GiNaC::symbol> coordinates = make_variables(target);
    NameTable names;
    for (const GiNaC::symbol& s : coordinates) names.add(s.get_name(), Quantity::symbol(s));
    const std::optional<PoissonStructure> bracket = make_bracket(target, coordinates, names);
    if (!bracket) throw CaseError(target.where, "the phase space of 'to' needs a bracket");
    PoissonMap map{
        text.name.value, text.name.where, *bracket, std::vector<ex>(coordinates.size()), {}, 1};
    std::vector<bool> seen(coordinates.size());
    for (const auto& [name, value] : text.expressions) {
      const std::size_t i = position(name, coordinates, "variable");
      map.expressions[i] = parse_expression(value, names_).value;
      seen[i] = true;
    }
    for (std::size_t i = 0; i < seen.size(); ++i) {
      if (!seen[i])
        throw text.name.error(
            fmt::format("the map gives no expression for '{}'", coordinates[i].get_name()));
    }
    for (const Text& relation : text.on) map.on.push_back(anonymous(relation));
    if (text.sign && text.sign->value == "-")
      map.sign = -1;
    else if (text.sign && text.sign->value != "+")
      throw text.sign->error("'sign' must be \"+\" or \"-\"");
    model_.maps.push_back(std::move(map));
  }

  /// The values of a scene's table, one for each symbol.
  std::vector<std::optional<ex>> values(const std::vector<Entry>& entries,
                                        const std::vector<GiNaC::symbol>& symbols,
                                        const std::string& what) const {
    std::vector<std::optional<ex>> result(symbols.size());
    for (const auto& [name, text] : entries) {
      if (what == "parameter" && fixed_value(name.value) != nullptr) continue;
      result[position(name, symbols, what)] = real_constant(text);
    }
    return result;
  }

  void read_scene(const SceneText& text) {
    Scene scene;
    scene.name = text.name.value;
    scene.where = text.name.where;
    for (const Scene& other : model_.scenes) {
      if (other.name == scene.name)
        throw text.name.error(fmt::format("the scene '{}' is given twice", printable(scene.name)));
    }
    const auto complete = [&](const std::vector<Entry>& entries,
                              const std::vector<GiNaC::symbol>& symbols, const std::string& what) {
      std::vector<ex> result;
      const auto given = values(entries, symbols, what);
      for (std::size_t i = 0; i < given.size(); ++i) {
        if (!given[i])
          throw text.name.error(fmt::format("the scene '{}' has no value for the {} '{}'",
                                            printable(scene.name), what, symbols[i].get_name()));
        result.push_back(*given[i]);
      }
      return result;
    };
    scene.parameters = complete(text.parameters, model_.parameters, "parameter");
    scene.initial = complete(text.initial, model_.variables, "variable");
    scene.duration = real_constant(*text.duration);
    if (GiNaC::ex_to<GiNaC::numeric>(scene.duration.evalf()).is_negative())
      throw text.duration->error("the duration must not be negative");
    for (const Text& name : text.observe) {
      variable_position(name);
      scene.observe.push_back(name.value);
    }
    if (text.extreme) scene.extreme = kind_of_extreme(*text.extreme);
    if (!text.reference.empty() && keeps_its_parameters(text)) {
      scene.reference = values(text.reference, model_.variables, "variable");
    }
    check_assumptions(text.name, scene);
    model_.scenes.push_back(std::move(scene));
  }

  static std::string kind_of_extreme(const Text& text) {
    const std::vector<std::string> kinds = {"separatrix", "stiff", "scale",
                                            "gimbal",     "long",  "blowup"};
    if (std::find(kinds.begin(), kinds.end(), text.value) != kinds.end()) return text.value;
    std::string hint = suggest(text.value, kinds);
    if (hint.empty()) hint = fmt::format("known: {}", fmt::join(kinds, ", "));
    throw text.error(fmt::format("unknown kind of extreme scene '{}'", printable(text.value)), 0,
                     hint);
  }

  /// Whether the parameters fixed from outside have the values that the scene gives them: only then
  /// is its reference state that of the motion.
  bool keeps_its_parameters(const SceneText& text) const {
    return std::all_of(fixed_.begin(), fixed_.end(), [&](const auto& pair) {
      const auto own =
          std::find_if(text.parameters.begin(), text.parameters.end(),
                       [&](const Entry& entry) { return entry.first.value == pair.first.value; });
      return own != text.parameters.end() &&
             (real_constant(own->second) - real_constant(pair.second)).expand().is_zero();
    });
  }

  void check_assumptions(const Text& name, const Scene& scene) const {
    GiNaC::exmap point;
    for (std::size_t i = 0; i < model_.parameters.size(); ++i)
      point[model_.parameters[i]] = scene.parameters[i];
    for (std::size_t i = 0; i < model_.variables.size(); ++i)
      point[model_.variables[i]] = scene.initial[i];
    for (const Assumption& assumption : model_.assumptions) {
      const ex value = assumption.difference.subs(point, GiNaC::subs_options::no_pattern).evalf();
      if (!GiNaC::is_a<GiNaC::numeric>(value) || assumption.holds_at(point)) continue;
      throw name.error(fmt::format("the scene '{}' is outside the assumption '{}'",
                                   printable(scene.name), printable(assumption.text)));
    }
  }

  const CaseFile& file_;
  const ParameterValues& fixed_;
  CaseNames names_;
  Model model_;
};

}  // namespace

Model build_model(const CaseFile& file, const ParameterValues& fixed) {
  return Builder(file, fixed).build();
}

}  // namespace casimir
