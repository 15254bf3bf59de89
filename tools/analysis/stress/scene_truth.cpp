#include "tools/analysis/stress/scene_truth.hpp"

#include <cmath>
#include <limits>

#include "tools/analysis/scene_run.hpp"
#include "tools/analysis/truth.hpp"
#include "tools/run_report.hpp"

namespace casimir::tools {
namespace {

using Json = nlohmann::json;

Json exact(const std::vector<double>& values) {
  Json list = Json::array();
  for (const double value : values) list.push_back(exact_text(value));
  return list;
}

std::vector<double> numbers(const Json& list) {
  std::vector<double> values;
  for (const Json& text : list)
    values.push_back(std::strtod(text.get<std::string>().c_str(), nullptr));
  return values;
}

}  // namespace

SceneTruth truth_of_scene(const Model& model, const Scene& scene, double longest) {
  const SceneRun run = prepare(model, scene);
  const TruthOrReason known = truth_of(scene, run, {.longest = longest});
  SceneTruth result{.states = run.specialisation.states};
  result.source = known.truth ? known.source : known.reason;
  result.singular_time = known.singular_time;
  const bool called_so = scene.extreme == "blowup" && scene.reference.empty();
  result.has_end = !called_so;
  if (known.singular_time || !result.has_end || !known.truth) return result;
  result.truth = known.truth;
  result.growth = growth_of(run, *known.truth);
  return result;
}

Json packed(const SceneTruth& truth) {
  Json json = {{"states", truth.states},
               {"source", truth.source},
               {"has_end", truth.has_end},
               {"growth", exact_text(truth.growth)}};
  if (truth.singular_time) json["singular_time"] = exact_text(*truth.singular_time);
  if (truth.truth) {
    json["state"] = exact(truth.truth->state);
    json["rest"] = exact(truth.truth->rest);
    json["scale"] = exact(truth.truth->scale);
  }
  return json;
}

SceneTruth unpacked(const Json& json) {
  const auto number = [&](const char* key) {
    return std::strtod(json.at(key).get<std::string>().c_str(), nullptr);
  };
  SceneTruth truth{.states = json.at("states").get<std::vector<std::string>>(),
                   .source = json.at("source").get<std::string>(),
                   .has_end = json.at("has_end").get<bool>(),
                   .growth = number("growth")};
  if (json.contains("singular_time")) truth.singular_time = number("singular_time");
  if (json.contains("state"))
    truth.truth =
        Truth{numbers(json.at("state")), numbers(json.at("rest")), numbers(json.at("scale"))};
  return truth;
}

}  // namespace casimir::tools
