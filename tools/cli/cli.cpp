#include "tools/cli/cli.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "tools/cli/errors.hpp"
#include "tools/cli/options/number_checks.hpp"
#include "tools/runs/scene_values.hpp"
#include "tools/tables/table.hpp"

namespace casimir::tools {

ParameterValues Common::parameter_values() const { return named_values("--param", params); }

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
      ->check(positive_number());
}

void add_case(CLI::App& command, std::string& name) {
  command.add_option("CASE", name, kCaseText)->required();
}

void add_all(CLI::App& command, bool& all, std::string& tag, const std::string& text) {
  command.add_flag("--all", all, text);
  command.add_option("--tag", tag, "With --all: only cases with this tag")->type_name("TAG");
}

void add_csv_output(CLI::App& command, std::string& path, const std::string& text) {
  const auto check = [](const std::string& name) -> std::string {
    try {
      check_table_name(name);
    } catch (const UsageError& problem) {
      return problem.what();
    }
    return {};
  };
  command.add_option("--output", path, text + ": .csv, .npz (NumPy) or .h5 (HDF5)")
      ->type_name("FILE.csv")
      ->check(check);
}

}  // namespace casimir::tools
