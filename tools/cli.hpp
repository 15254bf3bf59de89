#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "symbolic/model.hpp"

namespace casimir::tools {

/// Exit statuses, as the interface documents them.
enum Exit : int {
  kDone = 0,
  kFailed = 1,
  kBadInput = 2,
  kUndecided = 3,
  kEnvironment = 4,
  kNotContinued = 5,
  kInterrupted = 130,
};

/// A command line that cannot be carried out.
class UsageError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Something outside this program that does not work: a file that cannot be written, a missing
/// tool.
class SystemError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The options that every command has.
struct Common {
  bool json = false;
  bool quiet = false;
  std::vector<std::string> params;
  std::string scene = "default";
  bool scene_given = false;
  double time_limit = 0;  ///< seconds; 0: none

  /// `--param NAME=VALUE`, split. \throws UsageError
  ParameterValues parameter_values() const;
};

/// Adds the common options to a command.
void add_common(CLI::App& command, Common& common);

/// Runs after the command line has been read; its result is the exit status.
using Action = std::function<int()>;

/// A command adds itself to the program and, if it was chosen, sets `action`.
using Register = void (*)(CLI::App& program, Action& action);

void register_list(CLI::App& program, Action& action);
void register_show(CLI::App& program, Action& action);
void register_verify(CLI::App& program, Action& action);
void register_search(CLI::App& program, Action& action);
void register_exponents(CLI::App& program, Action& action);
void register_equilibria(CLI::App& program, Action& action);
void register_generate(CLI::App& program, Action& action);
void register_integrate(CLI::App& program, Action& action);
void register_conserve(CLI::App& program, Action& action);
void register_section(CLI::App& program, Action& action);
void register_bench(CLI::App& program, Action& action);
void register_stress(CLI::App& program, Action& action);
void register_report(CLI::App& program, Action& action);
void register_sweep(CLI::App& program, Action& action);
void register_new(CLI::App& program, Action& action);
void register_survey(CLI::App& program, Action& action);

/// In the order in which the help shows them: a new command is one file and one line here.
inline constexpr Register kCommands[] = {
    register_list,      register_show,       register_verify,   register_search,
    register_exponents, register_equilibria, register_generate, register_integrate,
    register_section,   register_conserve,   register_bench,    register_stress,
    register_report,    register_sweep,      register_survey,   register_new,
};

}  // namespace casimir::tools
