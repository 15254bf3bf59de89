// casimir new: a commented case file to start from.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "symbolic/error.hpp"
#include "tools/cli/cli.hpp"
#include "tools/cli/errors.hpp"
#include "tools/cli/json_output.hpp"
#include "tools/cli/output.hpp"
#include "tools/runs/new_case.hpp"

namespace casimir::tools {
namespace {

struct NewArguments {
  Common common;
  std::string name, output;
  std::string algebra = "so(3)";
  int canonical = 0, equations = 0;
  bool force = false;
};

NewCase system_for(const NewArguments& options) {
  if (options.canonical > 0) return new_canonical(options.canonical);
  if (options.equations > 0) return new_equations(options.equations);
  if (const auto algebra = find_lie_algebra(options.algebra)) return new_on_algebra(*algebra);
  throw CaseError({"--algebra"},
                  fmt::format("unknown Lie algebra '{}'", printable(options.algebra)), {},
                  lie_algebra_hint(options.algebra));
}

int create(const NewArguments& options) {
  std::string stem = options.name;
  if (stem.ends_with(".toml")) stem.resize(stem.size() - 5);
  const bool plain =
      !stem.empty() &&
      stem.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-") ==
          std::string::npos;
  if (!plain)
    throw UsageError(
        fmt::format("'{}' cannot name a case: letters, digits, '_' and '-' only", printable(stem)));
  constexpr std::size_t kLongest = 200;  // letters, of a file's name
  if (stem.size() > kLongest)
    throw UsageError(fmt::format("'{}' is too long a name for a case: {} letters, at most {}",
                                 printable(stem, 40), stem.size(), kLongest));
  const std::filesystem::path path = options.output.empty() ? stem + ".toml" : options.output;
  if (!options.force && std::filesystem::exists(path))
    throw UsageError(
        fmt::format("'{}' exists already; --force writes over it", printable(path.string(), 200)));
  const NewCase system = system_for(options);
  OutputFile file(path);
  file.stream() << to_toml(system, stem, path.filename().string());
  file.commit();
  if (options.common.json) {
    print_json(nlohmann::ordered_json{{"file", path.string()}});
  } else if (!options.common.quiet)
    fmt::print("wrote {0}; next: casimir verify {0}\n", printable(path.string(), 200));
  return kDone;
}

}  // namespace

void register_new(CLI::App& program, Action& action) {
  auto options = std::make_shared<NewArguments>();
  CLI::App* command = program.add_subcommand("new", "Write a commented case file to start from");
  add_common(*command, options->common);
  command->add_option("NAME", options->name, "Name of the new case")->required();
  CLI::Option* algebra =
      command
          ->add_option("--algebra", options->algebra,
                       "A top on this Lie algebra, such as e(3), so(4), so(3)+2*R3 (default so(3))")
          ->type_name("NAME");
  CLI::Option* canonical =
      command
          ->add_option("--canonical", options->canonical, "Oscillators in q1..qN, p1..pN instead")
          ->type_name("N")
          ->check(CLI::Range(1, 100))
          ->excludes(algebra);
  command->add_option("--equations", options->equations, "N equations without a bracket instead")
      ->type_name("N")
      ->check(CLI::Range(2, 200))
      ->excludes(algebra)
      ->excludes(canonical);
  command->add_option("--output", options->output, "Write this file (default: NAME.toml)")
      ->type_name("FILE.toml");
  command->add_flag("--force", options->force, "Write over a file that exists");
  command->callback([options, &action] { action = action_of(options, create); });
}

}  // namespace casimir::tools
