#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "symbolic/case/limits.hpp"
#include "symbolic/model.hpp"
#include "tools/cli/cli_names.hpp"

namespace casimir::tools {

/// The options that every command has.
struct Common {
  bool json = false;
  bool quiet = false;
  std::vector<std::string> params;
  std::string scene = "default";
  bool scene_given = false;
  double time_limit = 0;  ///< seconds; 0: none
  Limits limits{};        ///< under which cases are read: from `--limit`, see `Resources`

  /// `--param NAME=VALUE`, split.
  /// \throws UsageError
  ParameterValues parameter_values() const;
};

/// Adds the common options to a command.
void add_common(CLI::App& command, Common& common);

inline constexpr const char* kCaseText = "A bundled case, a case file, or - for standard input";

/// Adds the case that a command needs: see `load_case`.
void add_case(CLI::App& command, std::string& name);

/// Adds `--all` and `--tag`: the bundled cases in place of one that is named.
void add_all(CLI::App& command, bool& all, std::string& tag, const std::string& text);

/// Adds `--output FILE.csv`, or .npz or .h5; other endings are refused: see `write_table`.
void add_csv_output(CLI::App& command, std::string& path, const std::string& text);

/// Runs after the command line has been read, under its limits; its result is the exit status.
using Action = std::function<int(const Limits&)>;

/// Runs a command with its options, which the limits of the command line are added to.
template <class Options>
Action action_of(const std::shared_ptr<Options>& options, int (*command)(const Options&)) {
  return [options, command](const Limits& limits) {
    options->common.limits = limits;
    return command(*options);
  };
}

/// A command adds itself to the program and, if it was chosen, sets `action`.
using Register = void (*)(CLI::App& program, Action& action);

void register_list(CLI::App& program, Action& action);
void register_show(CLI::App& program, Action& action);
void register_verify(CLI::App& program, Action& action);
void register_search(CLI::App& program, Action& action);
void register_exponents(CLI::App& program, Action& action);
void register_degrees(CLI::App& program, Action& action);
void register_discretise(CLI::App& program, Action& action);
void register_obstruct(CLI::App& program, Action& action);
void register_equilibria(CLI::App& program, Action& action);
void register_generate(CLI::App& program, Action& action);
void register_integrate(CLI::App& program, Action& action);
void register_conserve(CLI::App& program, Action& action);
void register_check(CLI::App& program, Action& action);
void register_section(CLI::App& program, Action& action);
void register_bench(CLI::App& program, Action& action);
void register_stress(CLI::App& program, Action& action);
void register_relate(CLI::App& program, Action& action);
void register_report(CLI::App& program, Action& action);
void register_sweep(CLI::App& program, Action& action);
void register_new(CLI::App& program, Action& action);
void register_survey(CLI::App& program, Action& action);

/// In the order in which the help shows them: a new command is one file and one line here.
inline constexpr Register kCommands[] = {
    register_list,      register_show,       register_verify,     register_search,
    register_exponents, register_obstruct,   register_equilibria, register_generate,
    register_integrate, register_check,      register_section,    register_conserve,
    register_bench,     register_stress,     register_report,     register_sweep,
    register_survey,    register_discretise, register_degrees,    register_relate,
    register_new,
};

}  // namespace casimir::tools
