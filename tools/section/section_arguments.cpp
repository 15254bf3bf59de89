#include "tools/section/section_arguments.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tools/cli/errors.hpp"
#include "tools/cli/options/choices.hpp"
#include "tools/cli/options/number_checks.hpp"
#include "tools/plot/sheet.hpp"
#include "tools/runs/enclosed_run.hpp"
#include "tools/section/plane_options.hpp"
#include "tools/tables/table.hpp"

namespace casimir::tools {
namespace {

void add_orbit_options(CLI::App& command, SectionArguments& arguments) {
  command
      .add_option("--orbits", arguments.orbits,
                  "Orbits, spread over the domain of possible motion (default 40)")
      ->type_name("N")
      ->check(CLI::Range(1, 100000));
  command.add_option("--points", arguments.points, "Crossings of each orbit (default 500)")
      ->type_name("N")
      ->check(CLI::Range(1, 10000000));
  command
      .add_option("--seeds", arguments.seeds,
                  "Where orbits begin instead: a CSV file with a column for each variable, or with "
                  "the columns u and v")
      ->type_name("FILE.csv");
  command.add_flag("--rotation", arguments.rotation,
                   "Rotation numbers of the orbits, with their errors, and whether they lie on "
                   "curves or islands");
  command
      .add_option("--colour", arguments.colour,
                  "Colours of the orbits in a picture: megno, exponent or rotation; 2 is the "
                  "MEGNO of regular motion (default: one of a few for each regular orbit)")
      ->check(one_of({"megno", "exponent", "rotation"}))
      ->type_name("WHAT");
}

void add_cycle_options(CLI::App& command, SectionArguments& arguments) {
  command
      .add_option("--cycles", arguments.cycles,
                  "Find cycles of the return map up to this length, with their stability")
      ->type_name("N")
      ->check(CLI::Range(1, 64));
  command.add_flag("--fixed-points", arguments.fixed_points, "The same as --cycles 1");
  command
      .add_option(
          "--symmetry", arguments.symmetry,
          "NAME=EXPR: find one cycle with x(t + T/n) = S x(t) near the scene's start, where "
          "S moves these variables and is the identity after n times (repeatable)")
      ->allow_extra_args(false)
      ->type_name("NAME=EXPR");
  command
      .add_option("--period", arguments.period,
                  "With --symmetry: about the period T of the cycle (default: the duration of the "
                  "scene)")
      ->type_name("T");
  command.add_flag("--keep-period", arguments.keep_period,
                   "With --symmetry: the cycle of this very period, of a family of them");
}

void add_proof_options(CLI::App& command, SectionArguments& arguments) {
  command.add_flag("--validated", arguments.validated,
                   "Prove each cycle: it exists, is alone nearby, and how it is stable; without "
                   "cycles enclose every crossing of the scene's orbit, or of --orbits N, none "
                   "missed");
  command.add_flag("--horseshoe", arguments.horseshoe,
                   "Look for chaos and prove it: covering relations of sets around hyperbolic "
                   "cycles (up to the length of --cycles) and orbits between them; exit status 3 "
                   "where none is found");
  command
      .add_option("--duration", arguments.duration,
                  "With --validated: up to this time (default: that of the scene)")
      ->type_name("T");
  command
      .add_option(
          "--certificate", arguments.certificate,
          "With --validated and cycles, or with --horseshoe: write what proves them to this "
          "file, for casimir check")
      ->type_name("FILE");
}

void check_symmetry(const SectionArguments& options) {
  const SectionOptions& asked = options.request;
  if (options.symmetry.empty()) {
    if (!options.period.empty() || options.keep_period)
      throw UsageError("--period and --keep-period are about the cycle of --symmetry");
    return;
  }
  if (options.longest_cycle() > 0 || options.of_many_orbits || options.orbits_given ||
      options.level_given || options.rotation || options.horseshoe || options.validated ||
      asked.plane || asked.direction || !asked.pair.empty() || !options.outputs.empty() ||
      options.duration)
    throw UsageError(
        "--symmetry finds one cycle, from the start of the scene: it goes with --scene, --param, "
        "--initial, --period, --keep-period and --tolerance");
}

void check_outputs(const SectionArguments& options) {
  for (const std::string& path : options.outputs)
    if (is_table_name(path))
      check_table_name(path);
    else if (!is_picture_name(path))
      throw UsageError(fmt::format("'{}': an output's name must end in .csv, .npz, .h5, {}",
                                   printable(path, 200), kPictureNames));
  if (!options.colour.empty() && std::ranges::none_of(options.outputs, is_picture_name))
    throw UsageError("--colour is about a picture: it needs --output FILE.png, .svg or .pdf");
  options.print.check(std::ranges::any_of(options.outputs, is_picture_name));
}

}  // namespace

CLI::Option* add_section_options(CLI::App& command, SectionArguments& arguments) {
  add_common(command, arguments.common);
  arguments.start.add_to(command);
  add_case(command, arguments.case_name);
  add_plane_options(command, arguments.request);
  add_orbit_options(command, arguments);
  add_cycle_options(command, arguments);
  add_proof_options(command, arguments);
  CLI::Option* tolerance =
      command.add_option("--tolerance", arguments.tolerance, "Tolerance of a step (default 1e-14)")
          ->type_name("X")
          ->check(CLI::Range(1e-15, 1e-3));
  command.add_option("--jobs", arguments.jobs, "Threads (default: all processors)")
      ->type_name("N")
      ->check(count_from_one());
  command
      .add_option("--output,--plot", arguments.outputs,
                  "Write the crossings to a .csv, .npz or .h5 file, or draw them to an .svg, .png "
                  "or .pdf file (repeatable)")
      ->allow_extra_args(false)
      ->type_name("FILE");
  arguments.print.add_to(command);
  return tolerance;
}

void check_usage(const SectionArguments& options) {
  check_symmetry(options);
  if (options.horseshoe && (options.validated || options.duration || !options.outputs.empty() ||
                            options.about_points || !options.request.pair.empty()))
    throw UsageError(
        "--horseshoe looks for orbits itself: it goes with --plane, --direction, --energy, "
        "--casimir, --cycles, --certificate and --time-limit");
  if (options.horseshoe && std::ranges::any_of(options.common.params, is_range))
    throw UsageError(
        "a horseshoe is proved for one value of each parameter, not for a range: give NAME=VALUE");
  check_outputs(options);
  if (!options.certificate.empty() && std::ranges::any_of(options.common.params, is_range))
    throw UsageError("--certificate is of cycles for one value of each parameter, not for a range");
  const bool one_orbit = options.validated && options.longest_cycle() == 0;
  if (options.duration && !one_orbit)
    throw UsageError("--duration is that of the one orbit of --validated without cycles");
  if (!options.certificate.empty() && !options.horseshoe && (!options.validated || one_orbit))
    throw UsageError(
        "--certificate is of cycles that are proved, --validated --cycles N, or of --horseshoe");
  if (one_orbit && (options.rotation || options.of_many_orbits || !options.outputs.empty()))
    throw UsageError(
        "--validated encloses the crossings of the scene's orbit or of --orbits N, or proves "
        "--cycles N: without cycles it goes with --plane, --direction, --duration and --orbits");
  if (one_orbit && options.level_given && !options.orbits_given)
    throw UsageError(
        "the orbit of the scene is on its own level: --energy and --casimir go with --orbits N");
}

}  // namespace casimir::tools
