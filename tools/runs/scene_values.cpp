#include "tools/runs/scene_values.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "symbolic/error.hpp"
#include "tools/cli/errors.hpp"

namespace casimir::tools {
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

void OtherStart::add_to(CLI::App& command) {
  command
      .add_option("--initial", words_,
                  "NAME=VALUE: start a variable from this exact number instead (repeatable)")
      ->allow_extra_args(false)
      ->type_name("NAME=VALUE");
}

CaseFile OtherStart::in(CaseFile file) const {
  return with_initial_values(std::move(file), named_values("--initial", words_));
}

}  // namespace casimir::tools
