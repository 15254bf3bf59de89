// The JSON of casimir show.
#include "symbolic/expression/expression_size.hpp"
#include "tools/show/show.hpp"
#include "tools/show/system_view.hpp"

namespace casimir::tools {
namespace {

using Json = nlohmann::ordered_json;

/// Expressions as case files have them.
class Plain {
 public:
  explicit Plain(const Model& model) : model_(model), notation_(model) {}
  std::string operator()(const GiNaC::ex& e) { return notation_.case_text(e); }

  void add_bracket(Json& json) {
    const auto& x = model_.variables;
    Json brackets = Json::object();
    for (std::size_t i = 0; i < x.size(); ++i) {
      for (std::size_t j = i + 1; j < x.size(); ++j) {
        const GiNaC::ex value = (*model_.poisson)(i, j);
        if (!value.is_zero()) brackets[x[i].get_name() + "," + x[j].get_name()] = (*this)(value);
      }
    }
    json["brackets"] = brackets;
    if (const auto rank = rank_of(model_)) {
      json["rank"] = rank->name;
      json["rank_evidence"] = rank->evidence;
    }
    if (model_.hamiltonian) json["hamiltonian"] = (*this)(*model_.hamiltonian);
  }

  void add_functions(Json& json, const char* key, const std::vector<NamedExpression>& list) {
    for (const NamedExpression& f : list) json[key][f.name] = (*this)(f.value);
  }

  void add_levels(Json& json, const char* key, const std::vector<LevelClaim>& list) {
    for (const LevelClaim& claim : list) {
      Json entry = {{"name", claim.expression.name},
                    {"expression", (*this)(claim.expression.value)}};
      for (const NamedExpression& f : claim.on) entry["on"].push_back((*this)(f.value));
      json[key].push_back(entry);
    }
  }

 private:
  const Model& model_;
  Notation notation_;
};

Json object(const std::vector<Formula>& formulas) {
  Json json = Json::object();
  for (const Formula& f : formulas) json[f.left.text] = f.right.text;
  return json;
}

/// In vectors: keys are the left sides of the formulas, as the text has them.
void add_view(Json& json, const SystemView& view) {
  for (const VectorEntries& vector : view.vectors)
    json["vectors"][vector.name] = texts(vector.entries);
  if (!view.vector_brackets.empty()) json["vector_brackets"] = object(view.vector_brackets);
  if (!view.vector_equations.empty()) {
    json["vector_equations"] = object(view.vector_equations);
    json["gradients"] = object(view.gradients);
    json["scalar_products"] = {{"H", view.hamiltonian->text}};
    for (const FormulaGroup& group : view.claims) {
      for (const Formula& f : group.formulas) json["scalar_products"][f.left.text] = f.right.text;
    }
  }
  if (!view.structure_matrix.empty()) json["structure_matrix"] = texts(view.structure_matrix);
  for (const LaxView& pair : view.lax_pairs) {
    Json entry = {{"L", texts(pair.l)}, {"A", texts(pair.a)}};
    if (pair.spectral) entry["spectral"] = pair.spectral->text;
    if (!pair.on.empty()) entry["on"] = texts(pair.on);
    json["lax"].push_back(entry);
  }
}

/// With the motion that `add_motion` writes, and the view of the whole.
Json document(const Model& model, const std::function<void(Json&, Plain&)>& add_motion,
              const std::function<SystemView(Notation&)>& view) {
  Json json = {{"case", model.name},
               {"title", model.title},
               {"source", model.source},
               {"phase_space", model.phase_space}};
  for (const GiNaC::symbol& x : model.variables) json["variables"].push_back(x.get_name());
  json["parameters"] = Json::array();
  for (const GiNaC::symbol& p : model.parameters) json["parameters"].push_back(p.get_name());
  json["assumptions"] = Json::array();
  for (const Assumption& a : model.assumptions) json["assumptions"].push_back(a.text);
  Plain plain(model);
  if (model.poisson) plain.add_bracket(json);
  add_motion(json, plain);
  if (!model.constraints.empty()) plain.add_functions(json, "constraints", model.constraints);
  plain.add_functions(json, "casimirs", model.casimirs);
  plain.add_functions(json, "integrals", model.integrals);
  plain.add_levels(json, "conditional", model.conditionals);
  plain.add_levels(json, "invariant_relation", model.invariant_relations);
  for (const Scene& scene : model.scenes) json["scenes"].push_back(scene.name);
  Notation notation(model);
  add_view(json, view(notation));
  return json;
}

}  // namespace

Json show_json(const Model& model) {
  return document(
      model,
      [&](Json& json, Plain& plain) {
        for (std::size_t i = 0; i < model.variables.size(); ++i)
          json["equations"][model.variables[i].get_name()] =
              plain(expanded_within(model.field[i], kMostTermsShown));
      },
      [&](Notation& notation) { return view_of(model, notation); });
}

Json show_json(const MapModel& map) {
  return document(
      map.base,
      [&](Json& json, Plain& plain) {
        for (std::size_t i = 0; i < map.next.size(); ++i)
          json["map"][map.base.variables[i].get_name()] = plain(map.next[i]);
      },
      [&](Notation& notation) { return view_of(map, notation); });
}

}  // namespace casimir::tools
