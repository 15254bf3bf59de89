#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/analysis/run/validated.hpp"
#include "tools/cli/cli.hpp"
#include "tools/cli/options/kept_parameters.hpp"
#include "tools/cli/options/run_options.hpp"
#include "tools/runs/scene_values.hpp"

namespace casimir::tools {

/// What `integrate --validated` was asked.
struct EnclosedRequest {
  const Common& common;
  const RunOptions& run;
  const KeptParameters& kept;
  const OtherStart& start;
  std::string case_name, in, as, method, output;
  double every = 0;
  std::optional<int> digits;
  std::optional<std::string> initial_radius;
  std::vector<std::string> observe;
  std::string certificate;  ///< a file, or empty
};

/// Whether a value of `--param` is a range, as in r=1..1.001.
bool is_range(const std::string& word);

/// Takes the ranges out of the values of parameters: scenes get their middles.
/// \throws CaseError  for what is no range of rational numbers.
ParameterValues without_ranges(const ParameterValues& given, CaseFile& file,
                               ParameterRanges& ranges);

/// "r in [1, 1.001]" for each range, with commas between them.
std::string ranges_text(const ParameterValues& given);

/// Encloses the solutions of a scene and reports what was proved. \return exit status.
int integrate_validated(const EnclosedRequest& request);

}  // namespace casimir::tools
