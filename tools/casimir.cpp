// The command line: reads it, runs one command, and maps every kind of failure to its exit status.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <functional>
#include <iostream>
#include <new>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include "codegen/compile.hpp"
#include "runtime/instruction_set.hpp"
#include "symbolic/error.hpp"
#include "tools/cli/cli.hpp"
#include "tools/cli/command_line.hpp"
#include "tools/cli/errors.hpp"
#include "tools/cli/json_output.hpp"
#include "tools/cli/output.hpp"
#include "tools/cli/standard_streams.hpp"
#include "tools/usage/helpers.hpp"

namespace {

using namespace casimir;
using namespace casimir::tools;

/// Whether errors are wanted as JSON too; to be known before the command line is read.
bool g_json = false;

/// Says on standard error why the command ends, and with `--json` on standard output as well.
int fail(Exit status, const std::string& message, const nlohmann::ordered_json& json) {
  if (g_json) print_json(json);
  std::cout.flush();
  std::cerr << message << '\n';
  return status;
}

int fail(Exit status, const std::string& text) {
  return fail(status, "casimir: error: " + text, error_json(text));
}

int run(int argc, char** argv) {
  CommandLine line;
  std::function<int()> action;
  if (const std::optional<int> status =
          run_helper(line.app(), {argv + 1, argv + argc}, CASIMIR_VERSION))
    return *status;
  try {
    action = line.read(argc, argv);
  } catch (const CLI::Success& help) {
    return line.app().exit(help);
  } catch (const CLI::ParseError& problem) {
    const std::string message = line.usage_message(problem, argc, argv);
    return fail(kBadInput, message, error_json(message));
  }
  chosen_instruction_set();  // what is wrong with it is said before any work
  return action();
}

/// Runs the command; every kind of failure has its exit status.
int run_guarded(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const CaseError& problem) {
    return fail(kBadInput, problem.what(), error_json(problem));
  } catch (const RequestError& problem) {
    return fail(kBadInput, problem.what());
  } catch (const SingularPoint& problem) {
    return fail(kNotContinued, problem.what());
  } catch (const ModelError& problem) {
    return fail(kBadInput, problem.what());
  } catch (const EnvironmentError& problem) {
    return fail(kEnvironment, problem.what());
  } catch (const SystemError& problem) {
    return fail(kEnvironment, problem.what());
  } catch (const InstructionsUnavailable& problem) {
    return fail(kEnvironment, problem.what());
  } catch (const std::bad_alloc&) {
    return fail(kEnvironment, out_of_memory_text());
  } catch (const std::domain_error& problem) {
    // Exact arithmetic at a point where an expression has no value.
    return fail(kBadInput, fmt::format("an expression of the case has no value "
                                       "where it is needed: {}",
                                       problem.what()));
  } catch (const std::system_error& problem) {
    // Standard output that takes no more is reported once, at the end.
    if (standard_output_problem()) return kEnvironment;
    return fail(kEnvironment, problem.what());
  } catch (const std::exception& problem) {
    // An error of a library that nobody thought of: still a message, and not a crash.
    return fail(kEnvironment, printable(problem.what(), 500));
  }
}

}  // namespace

int main(int argc, char** argv) {
  open_standard_streams();
  g_json = std::any_of(argv, argv + argc,
                       [](const char* word) { return std::string_view(word) == "--json"; });
  install_interrupt_handler();
  const int status = run_guarded(argc, argv);
  if (const char* const problem = standard_output_problem()) {
    std::cerr << "casimir: error: cannot write to standard output: " << problem << '\n';
    return kEnvironment;
  }
  return status;
}
