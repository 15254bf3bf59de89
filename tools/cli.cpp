#include "tools/cli.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "tools/errors.hpp"

namespace casimir::tools {

ParameterValues Common::parameter_values() const {
  ParameterValues result;
  for (const std::string& text : params) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos) {
      throw UsageError(
          fmt::format("--param '{}': expected NAME=VALUE, such as --param r=1/2", printable(text)));
    }
    const Text name{text.substr(0, equals), {"--param", 1, 1}, text};
    const Text value{text.substr(equals + 1), {"--param", 1, static_cast<int>(equals) + 2}, text};
    for (const auto& [other, ignored] : result) {
      if (other.value == name.value)
        throw UsageError(fmt::format("--param {} is given twice", printable(name.value)));
    }
    result.emplace_back(name, value);
  }
  return result;
}

void add_common(CLI::App& command, Common& common) {
  command.add_flag("--json", common.json, "One JSON document on standard output and nothing else");
  command.add_flag("--quiet", common.quiet, "Print nothing; only the exit status tells");
  command
      .add_option("--param", common.params,
                  "NAME=VALUE: replace a parameter by an exact number (repeatable)")
      ->allow_extra_args(false)
      ->type_name("NAME=VALUE");
  command
      .add_option_function<std::string>(
          "--scene",
          [&common](const std::string& name) {
            common.scene = name;
            common.scene_given = true;
          },
          "Which scene of the case (default: 'default', or the first)")
      ->type_name("NAME");
  command.add_option("--time-limit", common.time_limit, "Stop after this many seconds")
      ->type_name("SECONDS")
      ->check(CLI::PositiveNumber);
}

void add_case(CLI::App& command, std::string& name) {
  command.add_option("CASE", name, kCaseText)->required();
}

void add_all(CLI::App& command, bool& all, std::string& tag, const std::string& text) {
  command.add_flag("--all", all, text);
  command.add_option("--tag", tag, "With --all: only cases with this tag")->type_name("TAG");
}

}  // namespace casimir::tools
