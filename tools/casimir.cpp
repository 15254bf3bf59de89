// The command line: reads it, runs one command, and maps every kind of failure to its exit status.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <new>
#include <stdexcept>
#include <system_error>

#include "codegen/compile.hpp"
#include "symbolic/error.hpp"
#include "tools/cli/cli.hpp"
#include "tools/cli/command_line.hpp"
#include "tools/cli/errors.hpp"
#include "tools/cli/output.hpp"
#include "tools/cli/standard_streams.hpp"
#include "tools/usage/helpers.hpp"

namespace {

using namespace casimir;
using namespace casimir::tools;

int fail(Exit status, const std::string& message) {
  std::cout.flush();
  std::cerr << message << '\n';
  return status;
}

int run(int argc, char** argv) {
  Program program;
  Action action;
  if (const std::optional<int> status =
          run_helper(program.app(), {argv + 1, argv + argc}, CASIMIR_VERSION))
    return *status;
  try {
    action = program.read(argc, argv);
  } catch (const CLI::Success& help) {
    return program.app().exit(help);
  } catch (const CLI::ParseError& problem) {
    return fail(kBadInput, program.usage_message(problem, argc, argv));
  }
  return action();
}

/// Runs the command; every kind of failure has its exit status.
int run_guarded(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const CaseError& problem) {
    return fail(kBadInput, problem.what());
  } catch (const RequestError& problem) {
    return fail(kBadInput, fmt::format("casimir: error: {}", problem.what()));
  } catch (const SingularPoint& problem) {
    return fail(kNotContinued, fmt::format("casimir: error: {}", problem.what()));
  } catch (const ModelError& problem) {
    return fail(kBadInput, fmt::format("casimir: error: {}", problem.what()));
  } catch (const EnvironmentError& problem) {
    return fail(kEnvironment, fmt::format("casimir: error: {}", problem.what()));
  } catch (const SystemError& problem) {
    return fail(kEnvironment, fmt::format("casimir: error: {}", problem.what()));
  } catch (const std::bad_alloc&) {
    return fail(kEnvironment, "casimir: error: " + out_of_memory_text());
  } catch (const std::domain_error& problem) {
    // Exact arithmetic at a point where an expression has no value.
    return fail(kBadInput, fmt::format("casimir: error: an expression of the case has no value "
                                       "where it is needed: {}",
                                       problem.what()));
  } catch (const std::system_error& problem) {
    // Standard output that takes no more is reported once, at the end.
    if (standard_output_problem()) return kEnvironment;
    return fail(kEnvironment, fmt::format("casimir: error: {}", problem.what()));
  } catch (const std::exception& problem) {
    // An error of a library that nobody thought of: still a message, and not a crash.
    return fail(kEnvironment, fmt::format("casimir: error: {}", printable(problem.what(), 500)));
  }
}

}  // namespace

int main(int argc, char** argv) {
  open_standard_streams();
  install_interrupt_handler();
  const int status = run_guarded(argc, argv);
  if (const char* const problem = standard_output_problem())
    return fail(kEnvironment,
                fmt::format("casimir: error: cannot write to standard output: {}", problem));
  return status;
}
