#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "tools/cli/cli.hpp"
#include "tools/cli/options/picture_options.hpp"
#include "tools/runs/scene_values.hpp"
#include "tools/section/request.hpp"

namespace casimir::tools {

/// What `casimir section` was asked for.
struct SectionArguments {
  Common common;
  OtherStart start;
  std::string case_name, seeds, certificate;
  SectionOptions request;
  std::vector<std::string> outputs;
  PictureOptions print;
  std::size_t orbits = 40, points = 500, cycles = 0;
  std::string colour, period;
  std::vector<std::string> symmetry;
  bool keep_period = false, rotation = false;
  bool fixed_points = false, validated = false, horseshoe = false, tolerance_given = false;
  std::optional<std::string> duration;
  bool orbits_given = false, level_given = false;
  bool of_many_orbits = false;  ///< an option was given that is about the orbits of a picture
  bool about_points = false;    ///< the same, but for those about the level
  double tolerance = 1e-14;
  int jobs = 0;

  std::size_t longest_cycle() const {
    return fixed_points ? std::max<std::size_t>(cycles, 1) : cycles;
  }
};

/// Declares the options, which write into `arguments`; these must outlive the command.
/// \return  the one of the tolerance, which somebody may have given
CLI::Option* add_section_options(CLI::App& command, SectionArguments& arguments);

/// \throws UsageError  for options that have no meaning together
void check_usage(const SectionArguments& options);

}  // namespace casimir::tools
