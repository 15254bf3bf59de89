#include "tools/kept_parameters.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <sstream>

#include "symbolic/expression.hpp"

namespace casimir::tools {
namespace {

bool differ(const Text& a, const Text& b) {
  return !(parse_real_constant(a) - parse_real_constant(b)).expand().is_zero();
}

/// Gives a parameter this value in every scene. The reference state of a scene that had another one
/// belongs to another motion.
void choose(CaseFile& file, const Text& name, const Text& value) {
  for (SceneText& scene : file.scenes) {
    const auto own = std::find_if(scene.parameters.begin(), scene.parameters.end(),
                                  [&](const Entry& e) { return e.first.value == name.value; });
    if (own == scene.parameters.end() || differ(own->second, value)) {
      scene.reference.clear();
      scene.altered = true;
    }
    if (own != scene.parameters.end()) scene.parameters.erase(own);
    scene.parameters.emplace_back(name, value);
  }
}

}  // namespace

void KeptParameters::add_to(CLI::App& command) {
  command.add_flag("--keep-params", text_,
                   "Keep the parameters (with =A,B: these) as arguments at run time; --param then "
                   "sets their values");
}

bool KeptParameters::all() const { return text_ == "true"; }

std::vector<std::string> KeptParameters::names() const {
  std::vector<std::string> result;
  std::istringstream stream(all() ? "" : text_);
  for (std::string name; std::getline(stream, name, ',');) result.push_back(name);
  return result;
}

Model KeptParameters::model_of(const CaseFile& file, const ParameterValues& given) const {
  CaseFile chosen = file;
  ParameterValues fixed;
  const std::vector<std::string> kept = names();
  for (const auto& [name, value] : given) {
    const bool declared = std::any_of(
        file.parameters.begin(), file.parameters.end(),
        [&, &wanted = name](const ParameterText& p) { return p.name.value == wanted.value; });
    if (declared && (all() || std::find(kept.begin(), kept.end(), name.value) != kept.end()))
      choose(chosen, name, value);
    else
      fixed.emplace_back(name, value);
  }
  return tools::model_of(chosen, fixed);
}

}  // namespace casimir::tools
