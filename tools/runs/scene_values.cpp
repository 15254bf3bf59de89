#include "tools/runs/scene_values.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "symbolic/case/expression.hpp"
#include "tools/cli/errors.hpp"

namespace casimir::tools {
namespace {

bool differ(const Text& a, const Text& b) {
  return !(parse_real_constant(a) - parse_real_constant(b)).expand().is_zero();
}

}  // namespace

std::vector<Entry> named_values(const std::string& option, const std::vector<std::string>& words) {
  std::vector<Entry> result;
  for (const std::string& word : words) {
    const std::size_t equals = word.find('=');
    if (equals == std::string::npos) {
      throw UsageError(fmt::format("{} '{}': expected NAME=VALUE, such as {} {}=1/2", option,
                                   printable(word), option,
                                   word.empty() ? "NAME" : printable(word)));
    }
    const Text name{word.substr(0, equals), {option, 1, 1}, word};
    const Text value{word.substr(equals + 1), {option, 1, static_cast<int>(equals) + 2}, word};
    for (const auto& [other, ignored] : result) {
      if (other.value == name.value)
        throw UsageError(fmt::format("{} {} is given twice", option, printable(name.value)));
    }
    result.emplace_back(name, value);
  }
  return result;
}

void set_in_scenes(CaseFile& file, std::vector<Entry> SceneText::*table, const Text& name,
                   const Text& value) {
  for (SceneText& scene : file.scenes) {
    std::vector<Entry>& entries = scene.*table;
    const auto own = std::ranges::find_if(
        entries, [&](const Entry& entry) { return entry.first.value == name.value; });
    if (own == entries.end() || differ(own->second, value)) {
      scene.reference.clear();
      scene.altered = true;
    }
    if (own != entries.end()) entries.erase(own);
    entries.emplace_back(name, value);
  }
}

void OtherStart::add_to(CLI::App& command) {
  command
      .add_option("--initial", words_,
                  "NAME=VALUE: start a variable from this exact number instead (repeatable)")
      ->allow_extra_args(false)
      ->type_name("NAME=VALUE");
}

CaseFile OtherStart::in(CaseFile file) const {
  std::vector<std::string> known;
  for (const Text& variable : file.phase_space.variables) known.push_back(variable.value);
  for (const auto& [name, value] : named_values("--initial", words_)) {
    if (std::ranges::count(known, name.value) == 0) {
      throw name.error(fmt::format("'{}' is not a variable of this case", printable(name.value)), 0,
                       suggest_or_list(name.value, known, "variables"));
    }
    set_in_scenes(file, &SceneText::initial, name, value);
  }
  return file;
}

}  // namespace casimir::tools
