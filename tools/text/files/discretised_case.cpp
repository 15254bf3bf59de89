#include "tools/text/files/discretised_case.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "tools/show/notation.hpp"
#include "tools/text/runs/sure_decimals.hpp"

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
    const std::vector<std::string> all = variables();
    for (std::size_t i = 0; i < all.size(); ++i) text += (i > 0 ? ", " : "") + quoted(all[i]);
    text += "]\n" + parameters() + definitions() + map_text(all);
    text += claims();
    for (const Scene& scene : flow_.scenes) text += scene_text(scene);
    return text;
  }

 private:
  std::string text_of(const GiNaC::ex& e) { return notation_.case_text(e); }

  std::vector<std::string> variables() const {
    std::vector<std::string> all = names(flow_.variables);
    all.insert(all.end(), map_.added.begin(), map_.added.end());
    return all;
  }

  /// The next values, at once or in steps.
  std::string map_text(const std::vector<std::string>& all) const {
    std::string text;
    if (map_.steps.empty()) text += "\n[map]\n";
    for (std::size_t i = 0; map_.steps.empty() && i < map_.next.size(); ++i)
      text += all[i] + " = " + quoted(map_.next[i]) + "\n";
    for (const std::vector<std::size_t>& step : map_.steps) {
      std::vector<std::string> keys, values;
      for (const std::size_t i : step) {
        keys.push_back(all[i]);
        values.push_back(map_.next[i]);
      }
      text += "\n[[map_step]]\nexpressions = " + entries(keys, values) + "\n";
    }
    return text;
  }

  std::string claims() const {
    std::string text;
    if (map_.modified_integral)
      text +=
          "\n[integrals]  # H + dH.(x' - x)/3\nH_modified = " + quoted(*map_.modified_integral) +
          "\n";
    text += claims_on_the_level();
    if (map_.density) text += "\n[[measure]]\ndensity = " + quoted(*map_.density) + "\n";
    return text;
  }

  /// That the map keeps to it, and what is constant on it.
  std::string claims_on_the_level() const {
    if (map_.relations.empty()) return "";
    std::vector<std::string> level;
    for (const std::string& f : map_.relations) level.push_back(quoted(f));
    std::string text =
        fmt::format("\n[[invariant_relation]]\nname = \"level\"\nexpression = {}\n", level.front());
    const std::vector<std::string> others(level.begin() + 1, level.end());
    if (!others.empty()) text += fmt::format("on = [{}]\n", fmt::join(others, ", "));
    for (const auto& [name, value] : map_.conditionals)
      text += fmt::format("\n[[conditional]]\nname = {}\nexpression = {}\non = [{}]\n",
                          quoted(name), quoted(value), fmt::join(level, ", "));
    return text;
  }

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
    for (const std::string& condition : map_.conditions) conditions.push_back(quoted(condition));
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

  /// Where the map starts in a scene; null where it does not.
  const MapStart* start_of(const Scene& scene) const {
    const auto found = std::ranges::find(map_.starts, scene.name, &MapStart::scene);
    return found == map_.starts.end() ? nullptr : &*found;
  }

  std::string scene_text(const Scene& scene) {
    if (!scene.unusable.empty()) return "";
    const MapStart* start = start_of(scene);
    if (!map_.added.empty() && !start)
      return "\n# The scene " + quoted(scene.name) + " is left out: its steps are too long.\n";
    std::vector<std::string> keys = names(flow_.parameters), values, initial;
    for (const GiNaC::ex& value : scene.parameters) values.push_back(text_of(value));
    for (const GiNaC::ex& value : scene.initial) initial.push_back(text_of(value));
    if (start) {
      for (const cln::cl_F& value : start->added) initial.push_back(decimal_text(value, kDigits));
    }
    if (!map_.step.empty()) {
      keys.push_back(map_.step);
      values.push_back(start ? start->step : "1/10");
    }
    std::string text = "\n[[scene]]\nname = " + quoted(scene.name) + "\n";
    if (!keys.empty()) text += "parameters = " + entries(keys, values) + "\n";
    return text + "initial = " + entries(variables(), initial) + "\nduration = \"1000\"  # steps\n";
  }

  static constexpr int kDigits = 40;  ///< of what solves equations

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
