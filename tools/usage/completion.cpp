#include "tools/usage/completion.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <set>

#include "runtime/methods.hpp"
#include "tools/cli/case_library.hpp"
#include "tools/runs/atlas.hpp"
#include "tools/usage/option.hpp"

namespace casimir::tools {
namespace {

using Lines = std::vector<std::string>;
constexpr const char* kFiles = ":files";

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

/// The command line up to the word being typed.
struct Typed {
  const CLI::App* command = nullptr;
  std::vector<DeclaredOption> options;
  std::string case_argument;         ///< the first positional word, or empty
  std::set<std::string> given;       ///< options that are there already
  std::optional<DeclaredOption> of;  ///< the option whose value is being typed
};

const DeclaredOption* named(const std::vector<DeclaredOption>& options, const std::string& name) {
  const auto found = std::ranges::find_if(options, [&](const DeclaredOption& option) {
    return std::ranges::find(option.names, name) != option.names.end();
  });
  return found == options.end() ? nullptr : &*found;
}

/// \param words  behind the command and before the word being typed
Typed read_words(const CLI::App& command, const std::vector<std::string>& words) {
  Typed typed{&command, declared_options(command), {}, {}, {}};
  for (const std::string& word : words) {
    if (typed.of) {
      typed.of.reset();
    } else if (word.size() > 1 && word.front() == '-') {
      const std::size_t equals = word.find('=');
      const DeclaredOption* option = named(typed.options, word.substr(0, equals));
      if (!option) continue;
      typed.given.insert(option->names.begin(), option->names.end());
      if (option->takes_value() && equals == std::string::npos) typed.of = *option;
    } else if (typed.case_argument.empty()) {
      typed.case_argument = word;
    }
  }
  return typed;
}

/// The case that the command line is about; standard input is not touched.
std::optional<CaseFile> case_of(const Typed& typed) {
  if (typed.case_argument.empty() || typed.case_argument == "-") return std::nullopt;
  return common_part(load_any_case(typed.case_argument, {}));
}

Lines names_of(const std::vector<Entry>& entries) {
  Lines names;
  for (const auto& [name, value] : entries) names.push_back(name.value);
  return names;
}

Lines state_names(const CaseFile& file) {
  Lines names;
  for (const Text& name : file.phase_space.variables) names.push_back(name.value);
  return names;
}

Lines invariant_names(const CaseFile& file) {
  Lines names{"H"};
  for (const auto* list : {&file.casimirs, &file.integrals}) {
    for (const std::string& name : names_of(*list)) names.push_back(name);
  }
  return names;
}

Lines parameter_names(const CaseFile& file) {
  Lines names;
  for (const ParameterText& parameter : file.parameters) names.push_back(parameter.name.value);
  return names;
}

Lines with_equals(Lines names) {
  for (std::string& name : names) name += '=';
  return names;
}

Lines joined(Lines a, const Lines& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

Lines tags() {
  std::set<std::string> result;
  for (const CaseFile& file : tagged_cases("", {}))
    result.insert(file.tags.begin(), file.tags.end());
  return {result.begin(), result.end()};
}

Lines variable_sets() {
  Lines names;
  for (const Coordinates& set : bundled_atlas({}).sets) names.push_back(set.name);
  return names;
}

Lines scene_names(const CaseFile& file) {
  Lines names;
  for (const SceneText& scene : file.scenes) names.push_back(scene.name.value);
  return names;
}

/// The values of options that follow from the case of the command line.
Lines values_in_case(const std::string& option, const CaseFile& file) {
  if (option == "--scene") return scene_names(file);
  if (option == "--param") return with_equals(parameter_names(file));
  if (option == "--free") return parameter_names(file);
  if (option == "--casimir") return with_equals(names_of(file.casimirs));
  if (option == "--over" || option == "--let")
    return with_equals(joined(parameter_names(file), state_names(file)));
  if (option == "--project-onto") return invariant_names(file);
  if (option == "--observe") return joined(state_names(file), invariant_names(file));
  if (option.starts_with("--plot-")) return state_names(file);
  return {};
}

Lines values_of(const DeclaredOption& option, const Typed& typed) {
  if (!option.choices.empty()) return option.choices;
  const std::string& name = option.names.back();
  if (option.value.starts_with("FILE")) return {kFiles};
  if (name == "--method") return joined(method_names(), {"auto"});
  if (option.value == "TAG") return tags();
  if (option.value == "SET") return variable_sets();
  const std::optional<CaseFile> file = case_of(typed);
  return file ? values_in_case(name, *file) : Lines{};
}

/// The values that begin as the typed text does; of lists behind the last comma, without those
/// that are in it.
Lines matching(const Lines& values, const std::string& text, bool is_list,
               const std::string& before) {
  const std::size_t comma = is_list ? text.rfind(',') : std::string::npos;
  const std::string kept = comma == std::string::npos ? "" : text.substr(0, comma + 1);
  const std::string start = text.substr(kept.size());
  Lines result;
  for (const std::string& value : values) {
    if (value == kFiles)
      result.push_back(value);
    else if (value.starts_with(start) && ("," + kept).find("," + value + ",") == std::string::npos)
      result.push_back(before + kept + value);
  }
  return result;
}

Lines option_values(const DeclaredOption& option, const Typed& typed, const std::string& text,
                    const std::string& before) {
  const bool is_list = option.value == "A,B" || option.value.ends_with(",..");
  return matching(values_of(option, typed), text, is_list, before);
}

Lines option_names(const Typed& typed, const std::string& text) {
  Lines result;
  for (const DeclaredOption& option : typed.options) {
    if (option.names.empty()) continue;
    if (!option.repeatable && typed.given.contains(option.names.back())) continue;
    for (const std::string& name : option.names) {
      if (name.size() > 2 && name.starts_with(text))
        result.push_back(name + "\t" + first_line(option.description));
    }
  }
  return result;
}

Lines positional_words(const Typed& typed, const std::string& text) {
  const bool of_a_file = std::ranges::any_of(
      typed.options, [](const DeclaredOption& option) { return option.positional == "FILE"; });
  if (of_a_file && typed.case_argument.empty()) return {kFiles};
  const auto found = std::ranges::find_if(
      typed.options, [](const DeclaredOption& option) { return option.positional == "CASE"; });
  if (found == typed.options.end() || (!found->repeatable && !typed.case_argument.empty()))
    return {};
  Lines result{kFiles};
  for (const std::filesystem::path& path : bundled_cases()) {
    if (path.stem().string().starts_with(text)) result.push_back(path.stem().string());
  }
  return result;
}

Lines command_names(const CLI::App& program, const std::string& text) {
  Lines result;
  for (const CLI::App* command : declared_commands(program)) {
    if (command->get_name().starts_with(text))
      result.push_back(command->get_name() + "\t" + first_line(command->get_description()));
  }
  if (text.starts_with('-'))
    return option_names({&program, declared_options(program), {}, {}, {}}, text);
  return result;
}

}  // namespace

std::vector<std::string> completions(const CLI::App& program, std::vector<std::string> words) {
  if (words.empty()) words.emplace_back();
  const std::string text = words.back();
  words.pop_back();
  if (words.empty()) return command_names(program, text);
  const std::vector<const CLI::App*> commands = declared_commands(program);
  const auto command = std::ranges::find(commands, words.front(), &CLI::App::get_name);
  if (command == commands.end()) return {};
  words.erase(words.begin());
  try {
    const Typed typed = read_words(**command, words);
    if (typed.of) return option_values(*typed.of, typed, text, "");
    const std::size_t equals = text.find('=');
    if (text.starts_with("--") && equals != std::string::npos) {
      const DeclaredOption* option = named(typed.options, text.substr(0, equals));
      if (!option) return {};
      return option_values(*option, typed, text.substr(equals + 1), text.substr(0, equals + 1));
    }
    return text.starts_with('-') ? option_names(typed, text) : positional_words(typed, text);
  } catch (const std::exception&) {
    return {};  // a case that cannot be read: there is nothing to offer, and nobody to tell
  }
}

}  // namespace casimir::tools
