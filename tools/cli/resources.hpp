#pragma once

#include <optional>
#include <string>
#include <vector>

#include "symbolic/case/limits.hpp"
#include "tools/cli/cli_names.hpp"

namespace casimir::tools {

/// What a command line allows the process to take.
struct Resources {
  std::vector<std::string> limits;  ///< NAME=VALUE
  std::optional<double> memory;     ///< gigabytes
};

/// Adds `--limit` and `--memory-limit` to a command.
void add_resources(CLI::App& command, Resources& resources);

/// The limits with those replaced that the command line names.
/// \throws UsageError
Limits limits_of(const Resources& resources);

/// Sets the memory that this process may take, and those that it starts.
void limit_memory(const Resources& resources);

/// The memory in bytes that the command line allows; empty where it says nothing.
std::optional<double> memory_allowed();

/// What to say when memory is out.
std::string out_of_memory_text();

}  // namespace casimir::tools
