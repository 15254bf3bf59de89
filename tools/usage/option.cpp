#include "tools/usage/option.hpp"

#include <CLI/CLI.hpp>
#include <sstream>

namespace casimir::tools {
namespace {

/// All that must hold of a value; CLI11 hands them out one by one until it throws.
std::vector<const CLI::Validator*> validators_of(const CLI::Option& option) {
  // The accessor is not const, and changes nothing.
  auto& writable = const_cast<CLI::Option&>(option);
  std::vector<const CLI::Validator*> result;
  for (int i = 0;; ++i) {
    try {
      result.push_back(writable.get_validator(i));
    } catch (const CLI::OptionNotFound&) {
      return result;
    }
  }
}

/// "{a,b,c}" taken apart; nothing for another text.
std::vector<std::string> listed_choices(const std::string& text) {
  std::vector<std::string> result;
  if (text.size() < 2 || text.front() != '{' || text.back() != '}') return result;
  std::istringstream list(text.substr(1, text.size() - 2));
  for (std::string choice; std::getline(list, choice, ',');) result.push_back(choice);
  return result;
}

/// What the type is called, without what CLI11 adds of the validators.
std::string value_name(const CLI::Option& option) {
  std::string name = option.get_type_name();
  for (const CLI::Validator* validator : validators_of(option)) {
    const std::string added = ":" + validator->get_description();
    const std::size_t place = name.rfind(added);
    if (added.size() > 1 && place != std::string::npos) name.erase(place, added.size());
  }
  return name;
}

DeclaredOption declared(const CLI::Option& option) {
  DeclaredOption result;
  for (const std::string& name : option.get_snames()) result.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) result.names.push_back("--" + name);
  if (option.get_positional()) result.positional = option.get_name(true);
  if (option.get_items_expected_max() > 0) result.value = value_name(option);
  result.description = option.get_description();
  result.repeatable = option.get_items_expected_max() >= CLI::detail::expected_max_vector_size;
  result.required = option.get_required();
  for (const CLI::Validator* validator : validators_of(option)) {
    for (const std::string& text : {validator->get_description(), validator->get_name()}) {
      if (result.choices.empty()) result.choices = listed_choices(text);
    }
  }
  return result;
}

}  // namespace

std::vector<DeclaredOption> declared_options(const CLI::App& command) {
  std::vector<DeclaredOption> result;
  for (const CLI::Option* option : command.get_options()) result.push_back(declared(*option));
  return result;
}

std::vector<const CLI::App*> declared_commands(const CLI::App& program) {
  return program.get_subcommands(nullptr);
}

}  // namespace casimir::tools
