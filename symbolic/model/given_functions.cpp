#include "symbolic/model/given_functions.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "symbolic/algebra/number_text.hpp"
#include "symbolic/expression/arbitrary.hpp"
#include "symbolic/expression/expression.hpp"
#include "symbolic/expression/expression_size.hpp"
#include "symbolic/expression/principal_values.hpp"

namespace casimir {
namespace {

using GiNaC::ex;

/// A polynomial of so high a degree, or a small number for 0: there is a domain that asks a
/// function to be small. `which` makes those of several functions different.
ex choice_of(const std::vector<GiNaC::symbol>& arguments, int degree, int which,
             std::string& text) {
  if (degree == 0) {
    const cln::cl_RA small = cln::cl_RA(1 + which) / 10;
    text = rational_text(small);
    return GiNaC::numeric(small);
  }
  const int sign = degree < 0 ? -1 : 1;
  const int power = sign * degree;
  ex sum = 0;
  text.clear();
  const auto add = [&](int factor, const ex& monomial, const std::string& written) {
    sum += sign * factor * monomial;
    append_term(text, cln::cl_RA(sign * factor), written);
  };
  add(1 + which, 1, "");
  for (std::size_t i = 0; i < arguments.size(); ++i)
    add(static_cast<int>(i) + 1 + which, GiNaC::pow(arguments[i], power),
        arguments[i].get_name() + (power > 1 ? fmt::format("^{}", power) : ""));
  if (arguments.size() > 1 && power > 1)
    add(1, arguments[0] * arguments[1], arguments[0].get_name() + "*" + arguments[1].get_name());
  return sum;
}

void put_all(std::vector<ex>& list, const GivenFunctions& given) {
  for (ex& e : list) e = given.put(e);
}

/// The domain has been put in before.
void put_all(std::vector<ex>& list, std::vector<ex>& domain, const GivenFunctions& given) {
  for (ex& e : list) given.put_into(e, domain);
}

void put_all(std::vector<NamedExpression>& list, const GivenFunctions& given) {
  for (NamedExpression& f : list) f = given.put(f);
}

void put_all(std::vector<LevelClaim>& list, const GivenFunctions& given) {
  for (LevelClaim& claim : list) {
    claim.expression = given.put(claim.expression);
    put_all(claim.on, given);
  }
}

void put_all(GiNaC::matrix& m, std::vector<ex>& domain, const GivenFunctions& given) {
  for (unsigned i = 0; i < m.rows(); ++i)
    for (unsigned j = 0; j < m.cols(); ++j) given.put_into(m(i, j), domain);
}

void put_all(std::vector<Assumption>& list, std::vector<ex>& domain, const GivenFunctions& given) {
  for (Assumption& a : list) given.put_into(a.difference, domain);
}

PoissonStructure put_bracket(const PoissonStructure& bracket, std::vector<ex>& domain,
                             const GivenFunctions& given) {
  std::vector<ex> upper;
  for (std::size_t i = 0; i < bracket.dimension(); ++i)
    for (std::size_t j = i + 1; j < bracket.dimension(); ++j) {
      upper.push_back(bracket(i, j));
      given.put_into(upper.back(), domain);
    }
  return {bracket.coordinates(), upper};
}

void put_map(PoissonMap& map, const GivenFunctions& given) {
  put_all(map.domain, given);
  map.target = put_bracket(map.target, map.domain, given);
  put_all(map.expressions, map.domain, given);
  put_all(map.on, given);
  put_all(map.image, given);
  put_all(map.leads_to, map.domain, given);
  for (MapInverse& inverse : map.inverses) {
    put_all(inverse.defined_by, given);
    put_all(inverse.expressions, inverse.defined_by, given);
    put_all(inverse.domain, inverse.defined_by, given);
  }
}

void put_claims(Model& model, const GivenFunctions& given) {
  for (auto* list : {&model.definitions, &model.casimirs, &model.integrals, &model.constraints})
    put_all(*list, given);
  put_all(model.conditionals, given);
  put_all(model.invariant_relations, given);
  for (LaxPair& pair : model.lax_pairs) {
    put_all(pair.domain, given);
    put_all(pair.l, pair.domain, given);
    put_all(pair.a, pair.domain, given);
    put_all(pair.on, given);
  }
  for (PoissonMap& map : model.maps) put_map(map, given);
  for (Measure& measure : model.measures) measure.density = given.put(measure.density);
  for (Identity& identity : model.identities) {
    put_all(identity.domain, given);
    given.put_into(identity.left, identity.domain);
    given.put_into(identity.right, identity.domain);
    put_all(identity.on, given);
  }
}

/// The domains have been put in before.
void put_motion(Model& model, const GivenFunctions& given) {
  if (model.hamiltonian) {
    given.put_into(*model.hamiltonian, model.domain);
    put_all(model.field, given);  // derived from it
  } else {
    put_all(model.field, model.domain, given);
  }
  if (model.poisson) model.poisson = put_bracket(*model.poisson, model.bracket_domain, given);
  // All points are where the assumptions have values.
  std::vector<ex> of_assumptions;
  put_all(model.assumptions, of_assumptions, given);
  for (std::vector<ex>* domain : {&model.domain, &model.bracket_domain})
    domain->insert(domain->end(), of_assumptions.begin(), of_assumptions.end());
}

}  // namespace

bool has_arbitrary_functions(const Model& model) {
  return std::any_of(model.parameters.begin(), model.parameters.end(), [](const GiNaC::symbol& p) {
    return function_name(p.get_name()).has_value();
  });
}

ex GivenFunctions::put(const ex& expression) const {
  return substituted(expression, values, limits);
}

std::vector<ex> lost_of_functions_in(const ex& expression, const GiNaC::exmap& values,
                                     const std::map<std::string, std::vector<ex>>& lost,
                                     const Limits& limits) {
  std::vector<ex> result;
  if (lost.empty()) return result;
  for (auto part = expression.preorder_begin(); part != expression.preorder_end(); ++part) {
    if (!GiNaC::is_exactly_a<GiNaC::function>(*part)) continue;
    const auto call = as_arbitrary(GiNaC::ex_to<GiNaC::function>(*part));
    if (!call) continue;
    const auto own = lost.find(call->function.get_name());
    const auto given = values.find(call->function);
    if (own == lost.end() || given == values.end()) continue;
    GiNaC::exmap arguments;
    for (std::size_t k = 0; k < call->arguments.size(); ++k)
      arguments[given->second.op(k)] = call->arguments[k];
    for (const ex& one : own->second) result.push_back(substituted(one, arguments, limits));
  }
  return result;
}

void GivenFunctions::put_into(ex& expression, std::vector<ex>& domain) const {
  std::vector<ex> parts = lost_in_substitution(expression, values, limits, VanishingTerms::counted);
  for (const ex& part : lost_of_functions_in(expression, values, lost, limits))
    parts.push_back(put(part));
  for (const ex& part : parts) {
    if (!complex_numbers && is_no_real_constant(part, limits.bits))
      throw ModelError(fmt::format("with the functions that are given, {} has no real value",
                                   printable(expression_text(expression), 80)));
    domain.push_back(part);
  }
  expression = put(expression);
}

NamedExpression GivenFunctions::put(NamedExpression f) const {
  put_all(f.domain, *this);
  put_into(f.value, f.domain);
  return f;
}

std::vector<GivenFunctions> function_choices(const Model& model) {
  std::vector<GivenFunctions> result;
  for (const int degree : {1, 2, 3, -2, 0}) {
    result.push_back({model.limits, {}, {}, model.complex_numbers});
    int which = 0;
    for (const GiNaC::symbol& parameter : model.parameters) {
      const auto function = function_name(parameter.get_name());
      if (!function) continue;
      std::vector<GiNaC::symbol> arguments;
      for (const std::string& argument : function->arguments) arguments.emplace_back(argument);
      std::string text;
      const ex body = choice_of(arguments, degree, which++, text);
      result.back().values[parameter] = given_function(arguments, body);
      result.back().texts.emplace_back(parameter.get_name(), text);
    }
  }
  return result;
}

Model with_functions(const Model& model, const GivenFunctions& given) {
  Model result = model;
  put_all(result.domain, given);
  put_all(result.bracket_domain, given);
  put_motion(result, given);
  put_claims(result, given);
  result.section.reset();
  result.scenes.clear();  // they are about functions of their own
  std::erase_if(result.parameters,
                [](const GiNaC::symbol& p) { return function_name(p.get_name()).has_value(); });
  return result;
}

std::pair<Model, Scene> in_scene(const Model& model, const Scene& scene) {
  GivenFunctions given{model.limits, {}, {}, model.complex_numbers};
  Scene own = scene;
  own.parameters.clear();
  own.lost_of_functions.clear();
  for (std::size_t i = 0; i < model.parameters.size(); ++i) {
    const GiNaC::symbol& parameter = model.parameters[i];
    const auto function = function_name(parameter.get_name());
    if (!function) {
      own.parameters.push_back(scene.parameters[i]);
      continue;
    }
    if (!GiNaC::is_a<GiNaC::lst>(scene.parameters[i]))
      throw function_not_given(scene.name, parameter.get_name());
    given.values[parameter] = scene.parameters[i];
    const auto lost = scene.lost_of_functions.find(parameter.get_name());
    if (lost != scene.lost_of_functions.end()) given.lost.insert(*lost);
  }
  return {with_functions(model, given), own};
}

Model model_in_scene(const Model& model, const Scene& scene) {
  return has_arbitrary_functions(model) ? in_scene(model, scene).first : model;
}

ModelError function_not_given(const std::string& scene, const std::string& parameter) {
  const auto function = function_name(parameter);
  return ModelError(fmt::format(
      "the scene '{}' does not say what the function {} is: functions = {{ {} = \"..\" }} in it",
      printable(scene), parameter, function ? function->name : parameter));
}

}  // namespace casimir
