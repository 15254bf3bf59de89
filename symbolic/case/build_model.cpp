// Case files to models: every expression is read, every name declared once.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "symbolic/algebra/number_text.hpp"
#include "symbolic/case/build_scene.hpp"
#include "symbolic/case/case_names.hpp"
#include "symbolic/case/case_parts.hpp"
#include "symbolic/case/limits.hpp"
#include "symbolic/case/read_claims.hpp"
#include "symbolic/case/real_values.hpp"
#include "symbolic/case/toml_keys.hpp"
#include "symbolic/discrete/map_model.hpp"
#include "symbolic/expression/arbitrary.hpp"
#include "symbolic/expression/expression.hpp"
#include "symbolic/expression/expression_size.hpp"
#include "symbolic/lie_algebra.hpp"
#include "symbolic/model.hpp"
#include "symbolic/model/model_dynamics.hpp"
#include "symbolic/model/phase_space.hpp"

namespace casimir {
namespace {

using GiNaC::ex;

class Builder {
 public:
  Builder(const CaseFile& file, const ParameterValues& fixed, const FindCase& find_case)
      : file_(file), fixed_(fixed), find_case_(find_case), names_(file.limits), dynamics_(model_) {}

  Model build() {
    read_names();
    read_equations();
    read_rest();
    return std::move(model_);
  }

  /// The same with next values in place of equations of motion.
  MapModel build(const MapCaseFile& map) {
    MapModel result;
    read_names();
    read_bracket();
    if (!model_.poisson) model_.phase_space = "map";
    if (model_.time)
      throw file_.phase_space.time->error("a map has no time: a parameter may stand for a step");
    result.sign = sign_of(map.sign);
    if (map.sign && !model_.poisson)
      throw map.sign->error("'map_sign' needs a bracket, which this phase space does not have");
    read_next(map, result);
    read_definitions();
    for (const SymmetryText& text : map.symmetries) {
      if (!changes_fixed(text)) result.symmetries.push_back(read_symmetry(text));
    }
    for (const ConjugacyText& text : map.conjugacies)
      result.conjugacies.push_back(read_conjugacy(text));
    for (const MeasureText& text : file_.measures) {
      if (text.every_hamiltonian)
        throw text.density.error("'every_hamiltonian' is about flows, and this is a map");
    }
    read_rest();
    result.base = std::move(model_);
    for (MapModel& step : result.steps)
      step.base = &step == &result.steps.front() ? result.base : anywhere(result.base);
    return result;
  }

 private:
  void read_names() {
    check_counts();
    copy_texts();
    declare_names();
  }

  void read_rest() {
    read_claims(file_, find_case_, names_, model_);
    for (const SceneText& scene : file_.scenes)
      model_.scenes.push_back(read_scene(scene, model_, fixed_));
  }

  void read_next(const MapCaseFile& map, MapModel& result) {
    const std::string what = "a variable of this case";
    if (map.steps.empty()) {
      result.next =
          all_components(map.map, map.next, model_.variables, names_, what, result.next_domain);
      return;
    }
    result.next.assign(model_.variables.begin(), model_.variables.end());
    for (const std::vector<Entry>& entries : map.steps) {
      MapModel step;
      step.next.assign(model_.variables.begin(), model_.variables.end());
      GiNaC::exmap before;
      for (std::size_t i = 0; i < result.next.size(); ++i)
        before[model_.variables[i]] = result.next[i];
      for (const auto& [name, value] : entries) {
        const Quantity quantity = parse_expression(value, names_);
        for (const ex& part : lost_parts(quantity)) step.next_domain.push_back(part);
        step.next[variable_position(name)] = quantity.value;
      }
      try {
        compose(step, before, result);
      } catch (const GiNaC::pole_error&) {
        throw entries.front().second.error(
            "behind the steps before it, this step has a value nowhere: it divides by zero");
      }
      result.steps.push_back(std::move(step));
    }
    if (result.steps.size() == 1) result.steps.clear();
  }

  /// One more step of a map. \param before  the variables as the steps before it leave them
  void compose(const MapModel& step, const GiNaC::exmap& before, MapModel& result) const {
    for (std::size_t i = 0; i < result.next.size(); ++i)
      result.next[i] = substituted(step.next[i], before, file_.limits);
    // What cancels in the composition was needed all the same.
    for (const auto* list : {&step.next, &step.next_domain})
      for (const ex& f : *list)
        for (const ex& part : substituted_with_parts(f, before, file_.limits))
          result.next_domain.push_back(part);
  }

  /// A symmetry that changes a parameter leads to another map where that has a value from outside.
  bool changes_fixed(const SymmetryText& text) const {
    return std::ranges::any_of(text.expressions, [&](const Entry& entry) {
      return std::ranges::any_of(model_.fixed, [&](const auto& parameter) {
        return parameter.first.value == entry.first.value;
      });
    });
  }

  MapSymmetry read_symmetry(const SymmetryText& text) {
    MapSymmetry result;
    result.name = text.name.value;
    result.reverses = text.reverses;
    result.variables.assign(model_.variables.begin(), model_.variables.end());
    result.parameters.assign(model_.parameters.begin(), model_.parameters.end());
    std::vector<GiNaC::symbol> symbols = model_.symbols();
    for (const auto& [name, value] : text.expressions) {
      const std::size_t i =
          symbol_position(name, name.value, 0, symbols, "a variable or parameter of this case");
      const Quantity quantity = parse_expression(value, names_);
      for (const ex& part : lost_parts(quantity)) result.domain.push_back(part);
      const std::size_t n = model_.variables.size();
      for (const GiNaC::symbol& x : model_.variables) {
        if (i >= n && quantity.value.has(x))
          throw value.error(fmt::format(
              "the image of the parameter '{}' uses the variable '{}': only parameters may stand "
              "there",
              name.value, x.get_name()));
      }
      (i < n ? result.variables[i] : result.parameters[i - n]) = quantity.value;
    }
    return result;
  }

  /// The names of the other map's variables, which mean nothing else in this case.
  std::vector<GiNaC::symbol> other_variables(const ConjugacyText& text) {
    PhaseSpaceText space;
    space.where = text.name.where;
    for (const Entry& entry : text.map) space.variables.push_back(entry.first);
    for (const Text& name : space.variables) {
      if (names_.find(name.value))
        throw name.error(fmt::format(
            "'{}' is a name of this case: the variables of the other map need names of their own",
            name.value));
    }
    std::vector<GiNaC::symbol> result = make_variables(space, file_.limits);
    if (result.size() != model_.variables.size())
      throw text.name.error(
          fmt::format("the other map has {} variables and this one {}: a conjugacy is invertible",
                      result.size(), model_.variables.size()));
    return result;
  }

  MapConjugacy read_conjugacy(const ConjugacyText& text) {
    MapConjugacy result;
    result.name = text.name.value;
    result.reverses = text.reverses;
    result.coordinates = other_variables(text);
    const std::string what = "a variable of the other map";
    result.expressions = all_components(text.name, text.expressions, result.coordinates, names_,
                                        what, result.domain);
    ExtendedNames others(names_, result.coordinates);
    result.map =
        all_components(text.name, text.map, result.coordinates, others, what, result.map_domain);
    std::vector<ex> written = result.map;
    written.insert(written.end(), result.map_domain.begin(), result.map_domain.end());
    for (const GiNaC::symbol& x : model_.variables) {
      if (std::ranges::any_of(written, [&](const ex& part) { return part.has(x); }))
        throw text.name.error(fmt::format(
            "the other map uses '{}', a variable of this case, and not its own variables alone",
            x.get_name()));
    }
    return result;
  }

  void check_counts() const {
    const auto check = [&](std::size_t count, double Limits::*limit, const char* what) {
      const Limits& limits = file_.limits;
      if (static_cast<double>(count) > limits.*limit)
        throw CaseError({file_.file},
                        fmt::format("{} {} given; the limit is {:.0f}", count, what, limits.*limit),
                        {}, limits.hint(limit), limit);
    };
    check(file_.parameters.size(), &Limits::parameters, "parameters");
    check(file_.scenes.size(), &Limits::scenes, "scenes");
    check(file_.casimirs.size() + file_.integrals.size() + file_.conditionals.size() +
              file_.invariant_relations.size() + file_.lax.size() + file_.maps.size() +
              file_.measures.size() + file_.identities.size(),
          &Limits::claims, "claims");
  }

  void copy_texts() {
    model_.limits = file_.limits;
    model_.name = file_.name;
    model_.file = file_.file;
    model_.title = file_.title;
    model_.source = file_.source;
    model_.book = file_.book;
    model_.tags = file_.tags;
    model_.integrable = file_.integrable;
    model_.superintegrable = file_.superintegrable;
    model_.phase_space = describe(file_.phase_space);
  }

  const Text* fixed_value(const std::string& parameter) const {
    const auto it = std::find_if(fixed_.begin(), fixed_.end(),
                                 [&](const auto& pair) { return pair.first.value == parameter; });
    return it == fixed_.end() ? nullptr : &it->second;
  }

  void declare_names() {
    names_.allow_complex_numbers(file_.complex_numbers);
    model_.complex_numbers = file_.complex_numbers;
    model_.variables = make_variables(file_.phase_space, file_.limits);
    for (std::size_t i = 0; i < model_.variables.size(); ++i) {
      check_symbol_name(file_.phase_space.variables[i]);
      names_.declare(file_.phase_space.variables[i], "a variable",
                     Quantity::symbol(model_.variables[i]));
    }
    if (const auto& time = file_.phase_space.time) {
      check_symbol_name(*time);
      model_.time = GiNaC::symbol(time->value);
      names_.declare(*time, "the time", Quantity::symbol(*model_.time));
    }
    std::vector<std::string> known;
    for (const ParameterText& parameter : file_.parameters) {
      if (const auto function = function_name(parameter.name.value)) {
        declare_function(parameter.name, *function);
        continue;
      }
      known.push_back(parameter.name.value);
      check_symbol_name(parameter.name);
      if (const Text* text = fixed_value(parameter.name.value)) {
        const ex value = parse_real_constant(*text, file_.limits);
        names_.declare(parameter.name, "a parameter", measured(value));
        model_.fixed.emplace_back(parameter.name, value);
        continue;
      }
      model_.parameters.push_back(GiNaC::symbol(parameter.name.value));
      names_.declare(parameter.name, "a parameter", Quantity::symbol(model_.parameters.back()));
    }
    for (const auto& [name, value] : fixed_) {
      if (std::find(known.begin(), known.end(), name.value) == known.end()) {
        throw name.error(
            fmt::format("'{}' is not a parameter of this case", printable(name.value)), 0,
            known.empty() ? "it has none" : suggest_or_list(name.value, known, "parameters"));
      }
    }
    for (const Entry& definition : file_.definitions) names_.define(definition);
    for (const ParameterText& parameter : file_.parameters) {
      for (const Text& text : parameter.assume) read_assumption(text);
    }
    for (const Text& text : file_.phase_space.domain) read_assumption(text);
  }

  /// Its symbol is a parameter; the name alone stands for nothing (see the parser).
  void declare_function(const Text& parameter, const FunctionName& function) {
    Text name = parameter;
    name.value = function.name;
    check_symbol_name(name);
    if (fixed_value(function.name) != nullptr)
      throw fixed_value(function.name)
          ->error(fmt::format("'{}' is an arbitrary function, and no parameter", function.name), 0,
                  fmt::format("a scene gives it: functions = {{ {} = \"..\" }}", function.name));
    model_.parameters.push_back(GiNaC::symbol(parameter.value));
    names_.declare(name, "a function", Quantity::symbol(model_.parameters.back()));
  }

  void read_assumption(const Text& text) {
    std::vector<ex> lost;
    const Assumption assumption = assumption_of(text, names_, lost);
    // That has to have values all the same: x/x is 1 where x is not 0.
    for (const ex& part : lost) {
      for (const Assumption& own : conditions_for_values(part, file_.complex_numbers))
        add_assumption(own, text);
    }
    add_assumption(assumption, text);
  }

  void add_assumption(const Assumption& assumption, const Text& text) {
    if (GiNaC::is_a<GiNaC::numeric>(assumption.difference) &&
        !assumption.holds_at({}, file_.limits)) {
      throw text.error(fmt::format("the assumption '{}' does not hold", printable(text.value)));
    }
    model_.assumptions.push_back(assumption);
  }

  void read_bracket() {
    model_.frame = make_frame(file_.phase_space, model_.variables, model_.parameters, names_);
    model_.linear_bracket = !file_.phase_space.dirac &&
                            (file_.phase_space.algebra || file_.phase_space.structure_constants);
    model_.poisson = make_bracket(file_.phase_space, model_.variables, names_, model_.frame,
                                  &model_.bracket_domain);
  }

  void read_equations() {
    read_bracket();
    if (file_.equations) {
      if (model_.poisson || file_.hamiltonian) {
        throw CaseError(file_.phase_space.where,
                        "a system is given either by [equations] or by a bracket and a "
                        "hamiltonian, not by both");
      }
      read_explicit_field();
    } else {
      if (!model_.poisson) {
        throw CaseError(
            file_.phase_space.where,
            "the phase space needs a bracket: one of 'algebra', 'canonical', 'brackets', "
            "'structure_constants' and 'vector_fields'; or the file a table [equations]");
      }
      read_hamiltonian();
      // In a function of that name, and before it, H is not known.
      if (!function_named_H())
        names_.offer("H", with_parts(measured(*model_.hamiltonian), model_.domain));
      model_.field = model_.poisson->flow(*model_.hamiltonian);
    }
    read_definitions();
  }

  void read_definitions() {
    names_.allow(&dynamics_);
    for (const Entry& definition : file_.definitions) {
      model_.definitions.push_back(named(definition.first, *names_.find(definition.first.value)));
    }
  }

  /// The Casimir function or integral that the file calls H, or null.
  const Text* function_named_H() const {
    for (const auto* entries : {&file_.casimirs, &file_.integrals}) {
      const auto found =
          std::ranges::find(*entries, "H", [](const Entry& e) { return e.first.value; });
      if (found != entries->end()) return &found->first;
    }
    return nullptr;
  }

  void read_hamiltonian() {
    if (file_.lagrangian) read_lagrangian(*file_.lagrangian);
    if (file_.hamiltonian) {
      model_.hamiltonian = in_domain(parse_expression(*file_.hamiltonian, names_));
    } else if (file_.lagrangian) {
      model_.hamiltonian = legendre_transform(*model_.frame, *file_.lagrangian);
      // What L shows, H may not.
      in_domain(with_parts(measured(*model_.hamiltonian), lagrangian_parts_));
    } else {
      no_hamiltonian();
    }
  }

  /// A key below the head of a table belongs to that table, which TOML does not say.
  [[noreturn]] void no_hamiltonian() const {
    const std::string what = "the case file needs a key 'hamiltonian'";
    for (const auto* table : {&file_.definitions, &file_.casimirs, &file_.integrals}) {
      for (const auto& [name, value] : *table) {
        if (name.value == "hamiltonian") throw name.error(what, 0, root_key_hint(name.value));
      }
    }
    throw CaseError({file_.file, 1, 1}, what);
  }

  bool has_velocity(const ex& part) const {
    return std::ranges::any_of(model_.frame->velocities,
                               [&](const GiNaC::symbol& w) { return part.has(w); });
  }

  /// In the quasi-velocities, by default w1, w2, ..
  void read_lagrangian(const Text& text) {
    if (!model_.frame) {
      throw text.error(
          "a Lagrangian needs [phase_space.vector_fields], the frame whose "
          "quasi-velocities it is written in");
    }
    const std::vector<Text>& given = file_.phase_space.vector_fields->velocities;
    const std::size_t k = model_.frame->momenta.size();
    if (!given.empty() && given.size() != k) {
      throw given[0].error(fmt::format("{} velocities given for {} momenta", given.size(), k));
    }
    for (std::size_t s = 0; s < k; ++s) {
      const Text name = given.empty() ? Text{fmt::format("w{}", s + 1), {}, {}} : given[s];
      check_name(name, "a velocity");
      const bool again = std::ranges::any_of(model_.frame->velocities, [&](const auto& other) {
        return other.get_name() == name.value;
      });
      if (again || names_.find(name.value) != nullptr)
        throw(given.empty() ? text : name)
            .error(fmt::format("'{}' is declared twice", name.value), 0,
                   "'velocities' in [phase_space.vector_fields] names the quasi-velocities");
      if (name.value == "H")
        throw name.error("'H' names the Hamiltonian and cannot name a velocity");
      model_.frame->velocities.push_back(GiNaC::symbol(name.value));
    }
    ExtendedNames names(names_, model_.frame->velocities);
    const Quantity lagrangian = parse_expression(text, names);
    for (const ex& part : lost_parts(lagrangian))
      if (has_velocity(part))
        throw text.error(
            fmt::format("{} cancels in the Lagrangian, which has values elsewhere too: write it "
                        "without",
                        printable(expression_text(part), 80)));
    model_.frame->lagrangian = in_domain(lagrangian);
    if (!lagrangian.parts) return;
    for (const ex& part : *lagrangian.parts)
      if (!has_velocity(part)) lagrangian_parts_.push_back(part);
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
      model_.field.push_back(in_domain(parse_expression(*it->second, names_)));
    }
  }

  std::size_t variable_position(const Text& name) const {
    const auto is_it = [&](const GiNaC::symbol& x) { return x.get_name() == name.value; };
    const std::string misplaced = root_key_hint(name.value);
    if (!misplaced.empty() && std::ranges::none_of(model_.variables, is_it))
      throw name.error(fmt::format("'{}' is not a variable of this case", printable(name.value)), 0,
                       misplaced);
    return symbol_position(name, name.value, 0, model_.variables, "a variable of this case");
  }

  /// The value of what the motion is made of; it has one only where all parts have.
  ex in_domain(const Quantity& quantity) {
    for (const ex& part : lost_parts(quantity)) model_.domain.push_back(part);
    return quantity.value;
  }

  const CaseFile& file_;
  const ParameterValues& fixed_;
  const FindCase& find_case_;
  CaseNames names_;
  std::vector<ex> lagrangian_parts_;  ///< those that have no velocity
  Model model_;
  ModelDynamics dynamics_;
};

}  // namespace

Model build_model(const CaseFile& file, const ParameterValues& fixed, const FindCase& find_case) {
  return Builder(file, fixed, find_case).build();
}

MapModel build_map_model(const MapCaseFile& file, const ParameterValues& fixed,
                         const FindCase& find_case) {
  return Builder(file.file, fixed, find_case).build(file);
}

}  // namespace casimir
