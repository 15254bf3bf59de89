#include "tools/text/files/discretised_case.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "tools/show/notation.hpp"

namespace casimir::tools {
namespace {

/// A TOML string on one line.
std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + "\"";
}

std::vector<std::string> names(const std::vector<GiNaC::symbol>& symbols) {
  std::vector<std::string> result;
  for (const GiNaC::symbol& s : symbols) result.push_back(s.get_name());
  return result;
}

/// A key of an inline table: a name, which needs no quotes.
std::string entries(const std::vector<std::string>& keys, const std::vector<std::string>& values) {
  std::string text;
  for (std::size_t i = 0; i < keys.size(); ++i)
    text += fmt::format("{}{} = {}", i > 0 ? ", " : "", keys[i], quoted(values[i]));
  return "{ " + text + " }";
}

class DiscretisedWriter {
 public:
  DiscretisedWriter(const Model& flow, const RationalMapText& map)
      : flow_(flow), map_(map), notation_(flow) {}

  std::string write(const std::string& method, const std::optional<std::string>& value) {
    std::string text = fmt::format("# {} of the case {}{}.\n", method, flow_.name,
                                   value ? ", with the step " + *value : "");
    if (!flow_.constraints.empty())
      text += "# A map need not keep the constraints of the flow, which are left out.\n";
    text +=
        "title = " +
        quoted(fmt::format("{} of {}", method, flow_.title.empty() ? flow_.name : flow_.title)) +
        "\n";
    if (!flow_.source.empty()) text += "source = " + quoted(flow_.source) + "\n";
    text += "tags = [\"map\"]\n\n[phase_space]\nvariables = [";
    for (std::size_t i = 0; i < flow_.variables.size(); ++i)
      text += (i > 0 ? ", " : "") + quoted(flow_.variables[i].get_name());
    text += "]\n" + parameters() + definitions() + "\n[map]\n";
    for (std::size_t i = 0; i < map_.next.size(); ++i)
      text += flow_.variables[i].get_name() + " = " + quoted(map_.next[i]) + "\n";
    if (map_.modified_integral)
      text +=
          "\n[integrals]  # H + dH.(x' - x)/3\nH_modified = " + quoted(*map_.modified_integral) +
          "\n";
    if (map_.density) text += "\n[[measure]]\ndensity = " + quoted(*map_.density) + "\n";
    for (const Scene& scene : flow_.scenes) text += scene_text(scene);
    return text;
  }

 private:
  std::string text_of(const GiNaC::ex& e) { return notation_.case_text(e); }

  /// Those about the variables are left out: the map need not keep to the domain.
  std::vector<std::string> assumptions() {
    std::vector<std::string> result;
    for (const Assumption& a : flow_.assumptions) {
      const bool moves = std::ranges::any_of(
          flow_.variables, [&](const GiNaC::symbol& x) { return a.difference.has(x); });
      if (moves || GiNaC::is_a<GiNaC::numeric>(a.difference)) continue;
      result.push_back(fmt::format("{} {} 0", text_of(a.difference), to_string(a.comparison)));
    }
    return result;
  }

  std::string parameters() {
    std::vector<std::string> all = names(flow_.parameters);
    if (!map_.step.empty()) all.push_back(map_.step);
    if (all.empty()) return "";
    std::string text = "\n[parameters]\n";
    std::vector<std::string> conditions;
    for (const std::string& condition : assumptions()) conditions.push_back(quoted(condition));
    for (std::size_t i = 0; i < all.size(); ++i) {
      text += all[i] + (i > 0 || conditions.empty()
                            ? " = {}\n"
                            : fmt::format(" = {{ assume = [{}] }}\n", fmt::join(conditions, ", ")));
    }
    return text;
  }

  std::string definitions() const {
    if (map_.definitions.empty()) return "";
    std::string text = "\n[definitions]\n";
    for (const auto& [name, value] : map_.definitions) text += name + " = " + quoted(value) + "\n";
    return text;
  }

  std::string scene_text(const Scene& scene) {
    if (!scene.unusable.empty()) return "";
    std::vector<std::string> keys = names(flow_.parameters), values, initial;
    for (const GiNaC::ex& value : scene.parameters) values.push_back(text_of(value));
    for (const GiNaC::ex& value : scene.initial) initial.push_back(text_of(value));
    if (!map_.step.empty()) {
      keys.push_back(map_.step);
      values.emplace_back("1/10");
    }
    std::string text = "\n[[scene]]\nname = " + quoted(scene.name) + "\n";
    if (!keys.empty()) text += "parameters = " + entries(keys, values) + "\n";
    return text + "initial = " + entries(names(flow_.variables), initial) +
           "\nduration = \"1000\"  # steps\n";
  }

  const Model& flow_;
  const RationalMapText& map_;
  Notation notation_;
};

}  // namespace

std::string discretised_case(const Model& flow, const RationalMapText& map,
                             const std::string& method, const std::optional<std::string>& value) {
  return DiscretisedWriter(flow, map).write(method, value);
}

}  // namespace casimir::tools
