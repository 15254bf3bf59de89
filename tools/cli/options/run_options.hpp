#pragma once

#include <optional>
#include <string>

#include "symbolic/case/limits.hpp"
#include "tools/analysis/run_request.hpp"
#include "tools/cli/cli_names.hpp"

namespace casimir::tools {

/// The options of a run that `integrate`, `conserve` and `bench` share.
struct RunOptions {
  RunRequest asked = {};  ///< all but the duration
  std::optional<std::string> duration;

  /// What is asked of a run. \param limits  of the duration that was typed
  /// \throws UsageError  for a duration that is no number.
  RunRequest request(const Limits& limits) const;
};

void add_run_options(CLI::App& command, RunOptions& options);

/// `--project` and `--project-onto`.
void add_projection(CLI::App& command, RunOptions& options);

/// All names, for help texts.
std::string method_list();

}  // namespace casimir::tools
