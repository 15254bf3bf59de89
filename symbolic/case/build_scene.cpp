// Scenes: exact initial data for a case.
#include "symbolic/case/build_scene.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "symbolic/algebra/exact_constant.hpp"
#include "symbolic/expression/arbitrary.hpp"
#include "symbolic/expression/decimal.hpp"
#include "symbolic/expression/expression.hpp"
#include "symbolic/expression/expression_size.hpp"

namespace casimir {
namespace {

using GiNaC::ex;

class SceneReader {
 public:
  SceneReader(const Model& model, const ParameterValues& fixed) : model_(model), fixed_(fixed) {}

  /// The values of a scene's table, one for each symbol.
  std::vector<std::optional<ex>> values(const std::vector<Entry>& entries,
                                        const std::vector<GiNaC::symbol>& symbols,
                                        const std::string& what) const {
    std::vector<std::optional<ex>> result(symbols.size());
    for (const auto& [name, text] : entries) {
      if (what == "parameter" && is_fixed(name.value)) continue;
      if (what == "parameter" && function_name(name.value)) continue;
      result[symbol_position(name, name.value, 0, symbols, "a " + what + " of this case")] =
          parse_real_constant(text, model_.limits);
    }
    return result;
  }

  Scene read(const SceneText& text) const {
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
        if (function_name(symbols[i].get_name())) {
          result.emplace_back(symbols[i]);  // until it is given
          continue;
        }
        if (!given[i])
          throw text.name.error(fmt::format("the scene '{}' has no value for the {} '{}'",
                                            printable(scene.name), what, symbols[i].get_name()));
        result.push_back(*given[i]);
      }
      return result;
    };
    scene.parameters = complete(text.parameters, model_.parameters, "parameter");
    give_functions(text.parameters, scene);
    scene.initial = complete(text.initial, model_.variables, "variable");
    if (text.duration) {
      scene.duration = parse_real_constant(*text.duration, model_.limits);
      if (real_decimal(*scene.duration, model_.limits.bits)->is_negative())
        throw text.duration->error("the duration must not be negative");
    } else if (!text.reference.empty()) {
      throw text.name.error(
          fmt::format("the scene '{}' has a reference state but no duration, at whose end it is",
                      printable(scene.name)));
    }
    for (const Text& name : text.observe) {
      symbol_position(name, name.value, 0, model_.variables, "a variable of this case");
      scene.observe.push_back(name.value);
    }
    if (text.extreme) scene.extreme = kind_of_extreme(*text.extreme);
    if (!text.reference.empty() && keeps_its_parameters(text)) {
      scene.reference = values(text.reference, model_.variables, "variable");
    }
    check_assumptions(text.name, scene);
    check_constraints(text, scene);
    return scene;
  }

  /// What the arbitrary functions are in a scene.
  void give_functions(const std::vector<Entry>& entries, Scene& scene) const {
    std::vector<std::string> known;
    for (const GiNaC::symbol& parameter : model_.parameters)
      if (const auto function = function_name(parameter.get_name()))
        known.push_back(function->name);
    for (const auto& [name, text] : entries) {
      const auto given = function_name(name.value);
      if (!given) continue;
      if (std::ranges::count(known, given->name) == 0)
        throw name.error(fmt::format("'{}' is not an arbitrary function of this case", given->name),
                         0, known.empty() ? "it has none" : suggest_or_list(given->name, known));
      for (std::size_t i = 0; i < model_.parameters.size(); ++i) {
        const auto function = function_name(model_.parameters[i].get_name());
        if (function && function->name == given->name)
          scene.parameters[i] = read_function(
              *function, text, scene.lost_of_functions[model_.parameters[i].get_name()]);
      }
    }
  }

  /// An expression over the parameters, which may change, and the arguments of a function, which
  /// hide parameters of the same name.
  /// \param lost  what of it does not show
  ex read_function(const FunctionName& function, const Text& text, std::vector<ex>& lost) const {
    NameTable names(model_.limits);
    for (const GiNaC::symbol& parameter : model_.parameters)
      if (!function_name(parameter.get_name()))
        names.add(parameter.get_name(), Quantity::symbol(parameter));
    for (const auto& [parameter, value] : model_.fixed) names.add(parameter.value, measured(value));
    std::vector<GiNaC::symbol> arguments;
    for (const std::string& argument : function.arguments) {
      arguments.emplace_back(argument);
      names.add(argument, Quantity::symbol(arguments.back()));
    }
    const Quantity body = parse_expression(text, names);
    lost = lost_parts(body);
    return given_function(arguments, body.value);
  }

  static Extreme kind_of_extreme(const Text& text) {
    std::vector<std::string> kinds;
    for (const Extreme kind : extremes()) {
      kinds.push_back(to_string(kind));
      if (kinds.back() == text.value) return kind;
    }
    throw text.error(fmt::format("unknown kind of extreme scene '{}'", printable(text.value)), 0,
                     suggest_or_list(text.value, kinds));
  }

  /// Whether the parameters fixed from outside have the values that the scene gives them: only then
  /// is its reference state that of the motion.
  bool keeps_its_parameters(const SceneText& text) const {
    return std::all_of(fixed_.begin(), fixed_.end(), [&](const auto& pair) {
      const auto own =
          std::find_if(text.parameters.begin(), text.parameters.end(),
                       [&](const Entry& entry) { return entry.first.value == pair.first.value; });
      return own != text.parameters.end() && (parse_real_constant(own->second, model_.limits) -
                                              parse_real_constant(pair.second, model_.limits))
                                                 .expand()
                                                 .is_zero();
    });
  }

  /// The scene has to lie on the constraints of its case and on the levels that it names itself,
  /// exactly. Under other parameters than its own it may leave them; then it cannot be run.
  void check_constraints(const SceneText& text, Scene& scene) const {
    std::vector<std::pair<const Text*, NamedExpression>> relations;
    for (const NamedExpression& constraint : model_.constraints)
      relations.emplace_back(&text.name, constraint);
    for (const Text& relation : text.on)
      relations.emplace_back(&relation,
                             NamedExpression{relation.value, model_.parse(relation), {}});
    const GiNaC::exmap point = point_of(scene);
    for (const auto& [where, relation] : relations) {
      const ex value = normal_form(substituted(relation.value, point, model_.limits));
      const auto constant = exact_constant(value);
      if (constant && constant->zero) continue;
      if (text.rounded && zero_but_for_rounding(relation.value, point)) continue;
      std::string what = fmt::format("the scene '{}' is not on the level {} = 0",
                                     printable(scene.name), printable(relation.name));
      what += constant ? fmt::format(": the value there is {}", printable(constant->text))
                       : ": whether the value there is zero is not decided";
      if (!text.altered && keeps_its_parameters(text)) throw where->error(what);
      scene.unusable = what + ", with the values given";
      return;
    }
  }

  /// Whether a sum is as small beside its terms as rounding the point to doubles can leave a zero.
  bool zero_but_for_rounding(const ex& sum, const GiNaC::exmap& point) const {
    const auto size = [&](const ex& e) {
      const ex value = substituted(e, point, model_.limits).evalf();
      return GiNaC::is_a<GiNaC::numeric>(value)
                 ? GiNaC::abs(GiNaC::ex_to<GiNaC::numeric>(value)).to_double()
                 : std::numeric_limits<double>::infinity();
    };
    double terms = size(sum);
    if (GiNaC::is_a<GiNaC::add>(sum))
      for (const ex& term : sum) terms = std::max(terms, size(term));
    constexpr double kRounding = 1e-12;
    return size(sum) <= kRounding * terms;
  }

  GiNaC::exmap point_of(const Scene& scene) const {
    GiNaC::exmap point = model_.parameter_values(scene);
    for (std::size_t i = 0; i < model_.variables.size(); ++i)
      point[model_.variables[i]] = scene.initial[i];
    return point;
  }

  void check_assumptions(const Text& name, const Scene& scene) const {
    const GiNaC::exmap point = point_of(scene);
    for (const Assumption& assumption : model_.assumptions) {
      const ex value = substituted(assumption.difference, point, model_.limits);
      if (!decimal(value, model_.limits.bits) || assumption.holds_at(point, model_.limits))
        continue;
      throw name.error(fmt::format("the scene '{}' is outside the assumption '{}'",
                                   printable(scene.name), printable(assumption.text)));
    }
  }

 private:
  bool is_fixed(const std::string& parameter) const {
    return std::any_of(fixed_.begin(), fixed_.end(),
                       [&](const auto& pair) { return pair.first.value == parameter; });
  }

  const Model& model_;
  const ParameterValues& fixed_;
};

}  // namespace

Scene read_scene(const SceneText& text, const Model& model, const ParameterValues& fixed) {
  return SceneReader(model, fixed).read(text);
}

}  // namespace casimir
