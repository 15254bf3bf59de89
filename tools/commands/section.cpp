// casimir section: many orbits on one energy and Casimir level, cut with a surface.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>

#include "tools/analysis/certificate/certificate_file.hpp"
#include "tools/analysis/estimate/cancelled_parts.hpp"
#include "tools/analysis/proof/proved_facts.hpp"
#include "tools/analysis/section/orbit_rotation.hpp"
#include "tools/cli/case_library.hpp"
#include "tools/cli/cli.hpp"
#include "tools/cli/errors.hpp"
#include "tools/cli/json_output.hpp"
#include "tools/cli/output.hpp"
#include "tools/cli/progress.hpp"
#include "tools/plot/gnuplot.hpp"
#include "tools/runs/certified_cycles.hpp"
#include "tools/runs/enclosed_run.hpp"
#include "tools/runs/scene_values.hpp"
#include "tools/section/horseshoe_section.hpp"
#include "tools/section/map_section.hpp"
#include "tools/section/picture.hpp"
#include "tools/section/ranged_case.hpp"
#include "tools/section/report.hpp"
#include "tools/section/request.hpp"
#include "tools/section/section_arguments.hpp"
#include "tools/section/seeds.hpp"
#include "tools/section/symmetric_section.hpp"
#include "tools/section/validated_section.hpp"
#include "tools/tables/table.hpp"
#include "tools/text/runs/run_report.hpp"

namespace casimir::tools {
namespace {

/// Orbits are begun in turns, of so many at least: they fill the registers of some cores.
constexpr std::size_t kOrbitsOfTurn = 16, kTurnsOfFigure = 4;

/// What is kept of all crossings: the state, the pair, time and growth.
void check_memory(const SectionArguments& options, std::size_t states) {
  constexpr double kMost = 4e9;
  const double bytes = 8. * static_cast<double>(options.orbits) *
                       static_cast<double>(options.points) * static_cast<double>(states + 4);
  if (bytes > kMost)
    throw UsageError(
        fmt::format("{} orbits of {} points take {:.1f} GB; at most {:.0f} are allowed",
                    options.orbits, options.points, bytes / 1e9, kMost / 1e9));
}

/// One section from the options to the report.
class SectionCommand {
 public:
  SectionCommand(const SectionArguments& options, const CaseFile& file)
      : options_(options),
        case_(options.start.in(file), options.common,
              options.validated && options.longest_cycle() > 0),
        model_(model_of(case_.file, case_.values)),
        problem_(section_problem(model_, model_.scene(options.common.scene),
                                 case_.request(model_, options.request))),
        level_(problem_),
        progress_(!options.common.quiet),
        cutter_(problem_, {options.tolerance, options.jobs, time_limit(options.common.time_limit)},
                options.orbits * options.points) {}

  int run() {
    check_memory(options_, problem_.states());
    if (options_.longest_cycle() > 0) require_derivative_of_return(problem_);
    SectionReport report{.problem = problem_, .orbits = {}, .cycles = {}, .warnings = {}};
    report.tolerance = options_.tolerance;
    report.compile_seconds = cutter_.kernel().seconds;
    report.lanes = cutter_.kernel().lanes->lanes;
    report.instruction_set = cutter_.kernel().lanes->instruction_set;
    report.from_cache = cutter_.kernel().from_cache;
    if (!options_.seeds.empty())
      follow(seeds_of(options_.seeds, level_, [this] { return domain(); }), 1, report);
    else
      follow_spread(report);
    warn_of_orbits(report);
    if (options_.rotation || options_.colour == "rotation")
      for (const OrbitReport& orbit : report.orbits)
        report.rotations.push_back(rotation_of_orbit(problem_, orbit));
    if (options_.longest_cycle() > 0) {
      progress_.begin(model_.name + ": cycles");
      report.cycles = find_cycles(
          level_, cutter_, cycle_starts(level_, domain(), report.orbits, options_.longest_cycle()),
          options_.longest_cycle(),
          verdict_on_jacobi(model_, model_.scene(options_.common.scene)) == Verdict::proved,
          [this](double share) { progress_.show(share); });
      cut_short_ = cut_short_ || cutter_.interrupted();
      if (options_.validated)
        report.proofs = enclose_cycles(model_, model_.scene(options_.common.scene), problem_,
                                       report.cycles.cycles, case_.ranges);
      report.ranges = ranges_text(options_.common.parameter_values());
    }
    deliver(report);
    if (!options_.certificate.empty()) write_certificates(report);
    return verdict(report);
  }

 private:
  const std::vector<PlacedPoint>& domain() {
    if (!domain_.empty()) return domain_;
    progress_.begin(model_.name + ": domain of possible motion");
    const Returning returning = cutter_.returning();
    std::size_t tried = 0;
    domain_ = points_of_domain(
        level_,
        [&](const std::vector<PlacedPoint>& points) {
          tried += points.size();
          return returning(points);
        },
        known_points());
    if (cutter_.interrupted())
      throw SystemError(
          "the time limit was reached before the domain of possible motion was known");
    if (!domain_.empty()) return domain_;
    if (tried == 0) throw UsageError(why_no_points(level_));
    throw UsageError(
        fmt::format("of {} orbits with {} that begin on the plane none comes back to it", tried,
                    problem_.level_text()));
  }

  /// Points of the level that need not be found: the scene's and where its orbit crosses.
  std::vector<LevelSet::Vector> known_points() const {
    if (!problem_.on_scene) return {};
    const LevelSet::Vector start = Eigen::Map<const LevelSet::Vector>(
        problem_.run.initial.data(), static_cast<Eigen::Index>(problem_.states()));
    std::vector<LevelSet::Vector> points{start};
    const SectionOrbit orbit = cutter_.orbits({start}, 1).orbits.front();
    if (orbit.size() == 1)
      points.push_back(Eigen::Map<const LevelSet::Vector>(orbit.states.data(), start.size()));
    return points;
  }

  /// Cuts the orbits of these seeds, which are the last ones up to `share` of the work.
  void follow(const std::vector<LevelSet::Vector>& seeds, double share, SectionReport& report) {
    const double before = done_;
    progress_.begin(model_.name + ": orbits");
    SectionResult result = cutter_.orbits(seeds, options_.points, [&](double part) {
      progress_.show(before + (share - before) * part);
    });
    done_ = share;
    report.seconds += result.seconds;
    report.jobs = std::max(report.jobs, result.jobs);
    for (OrbitReport& orbit : judged_orbits(level_, std::move(result), seeds))
      report.orbits.push_back(std::move(orbit));
  }

  /// In a few turns: after the first, orbits begin where none has been.
  void follow_spread(SectionReport& report) {
    PicturePlaces taken;
    const std::size_t turns =
        std::clamp<std::size_t>(options_.orbits / kOrbitsOfTurn, 1, kTurnsOfFigure);
    for (std::size_t turn = 0; turn < turns && !cutter_.interrupted(); ++turn) {
      // Half of them at first: the sea of chaos is large.
      const std::size_t first_half = turns == 1 ? options_.orbits : options_.orbits / 2;
      const std::size_t until =
          first_half + (turn == 0 ? 0 : (options_.orbits - first_half) * turn / (turns - 1));
      std::vector<PlacedPoint> chosen =
          spread_out(level_, domain(), until - report.orbits.size(), taken);
      if (turn == 0) chosen = centred(level_, domain(), std::move(chosen));
      std::vector<LevelSet::Vector> seeds;
      seeds.reserve(chosen.size());
      for (const PlacedPoint& point : chosen) seeds.push_back(point.x);
      const std::size_t before = report.orbits.size();
      follow(seeds, static_cast<double>(turn + 1) / static_cast<double>(turns), report);
      for (std::size_t i = before; i < report.orbits.size(); ++i)
        taken.insert(taken.end(), report.orbits[i].places.begin(), report.orbits[i].places.end());
    }
    cut_short_ = report.orbits.size() < options_.orbits && cutter_.interrupted();
    if (report.orbits.size() < options_.orbits && !cut_short_)
      report.warnings.push_back(
          fmt::format("only {} different points of the section were found for {} orbits",
                      report.orbits.size(), options_.orbits));
  }

  void warn_of_orbits(SectionReport& report) const {
    if (std::string parts = unwatched_parts(model_, model_.scene(options_.common.scene));
        !parts.empty())
      report.warnings.push_back(std::move(parts));
    if (problem_.leaf > 4)
      report.warnings.push_back(fmt::format(
          "the level has {} degrees of freedom: the picture is a projection of a section of {} "
          "dimensions",
          problem_.leaf / 2, problem_.leaf - 2));
    const auto uncertain = std::ranges::count_if(
        report.orbits, [](const OrbitReport& orbit) { return orbit.orbit.uncertain; });
    if (uncertain > 0)
      report.warnings.push_back(fmt::format(
          "{} of {} orbits pass where the function of the plane is singular: a crossing "
          "may be missing there",
          uncertain, report.orbits.size()));
    const auto lost = std::ranges::count_if(
        report.orbits, [](const OrbitReport& orbit) { return !orbit.orbit.returns; });
    if (lost > 0)
      report.warnings.push_back(
          fmt::format("{} of {} orbits do not come back to the plane often enough", lost,
                      report.orbits.size()));
    if (std::string places = lost_places(report.orbits, "crossings"); !places.empty())
      report.warnings.push_back(std::move(places));
  }

  /// Tables first: pictures need a program that may be missing.
  void deliver(const SectionReport& report) const {
    bool table = false;
    for (const std::string& path : options_.outputs) {
      if (is_picture_name(path)) continue;
      write_crossings(report, path);
      table = true;
    }
    if (options_.common.json)
      print_json(to_json(report, !table));
    else if (!options_.common.quiet)
      print_text(report);
    std::cout.flush();
    for (const std::string& path : options_.outputs) {
      if (is_picture_name(path))
        draw_section(problem_.plotted, model_.title + ", " + problem_.level_text(), report.orbits,
                     report.cycles.cycles, options_.print.sheet(path),
                     colours_by(options_.colour, report.orbits, report.rotations));
      if (!options_.common.quiet && !options_.common.json)
        fmt::print("  wrote {}\n", printable(path, 200));
    }
  }

  void write_certificates(const SectionReport& report) const {
    const std::vector<CycleCertificate> certificates =
        certified_cycles(model_, model_.scene(options_.common.scene), problem_, report.proofs);
    const std::size_t count = certificates.size();
    if (count > 0) {
      OutputFile file(options_.certificate);
      file.stream() << certificate_text(certificates);
      file.commit();
    }
    if (count < report.proved())
      std::cerr << fmt::format("casimir: {} of {} proved cycles have no certificate\n",
                               report.proved() - count, report.proved());
    if (count > 0 && !options_.common.quiet && !options_.common.json)
      fmt::print("  wrote {} certificates to {}\n", count, printable(options_.certificate, 200));
  }

  /// What went wrong, on stderr.
  int verdict(const SectionReport& report) const {
    const auto& orbits = report.orbits;
    const auto off = std::ranges::find(orbits, true, &OrbitReport::leaves_level);
    if (off != orbits.end()) {
      std::cerr << fmt::format(
          "casimir: error: orbit {} left its level by more than {:g} at crossing {}\n  hint: a "
          "smaller --tolerance, or fewer --points\n",
          off - orbits.begin() + 1, kOnLevel, off->places.size() + 1);
      return kFailed;
    }
    const auto stopped = [](const OrbitReport& orbit) {
      return orbit.orbit.status == Status::stopped && orbit.orbit.returns;
    };
    const auto lost = [&](const OrbitReport& orbit) {
      return orbit.orbit.status != Status::ok && orbit.orbit.returns && !stopped(orbit);
    };
    if (std::ranges::any_of(orbits, lost)) {
      tell(report, lost, "could not be continued");
      return kNotContinued;
    }
    if (std::ranges::any_of(orbits, stopped)) {
      tell(report, stopped, "were stopped at the time limit");
      return kEnvironment;
    }
    if (cut_short_) {
      std::cerr << "casimir: error: the time limit was reached before all was done\n";
      return kEnvironment;
    }
    if (!report.proofs.empty() && report.proved() == 0) {
      std::cerr << "casimir: error: no cycle could be proved\n";
      return kNotContinued;
    }
    if (report.crossings() > 0) return kDone;
    std::cerr << "casimir: error: no orbit crosses the plane\n";
    return kNotContinued;
  }

  template <class Which>
  void tell(const SectionReport& report, const Which& which, const char* what) const {
    const auto& orbits = report.orbits;
    std::string text = fmt::format("casimir: error: {} of {} orbits {}",
                                   std::ranges::count_if(orbits, which), orbits.size(), what);
    const auto first = std::ranges::find_if(orbits, which);
    if (first != orbits.end()) {
      const SectionOrbit& orbit = first->orbit;
      text += fmt::format(
          "; the first is orbit {}, at t = {} after {} of {} crossings: {}\n  last good state: ",
          first - orbits.begin() + 1, exact_text(orbit.time), orbit.size(), options_.points,
          reason_of(orbit.status));
      for (std::size_t k = 0; k < orbit.state.size(); ++k)
        text += fmt::format("{}{} = {:.6g}", k == 0 ? "" : ", ",
                            problem_.run.specialisation.states[k], orbit.state[k]);
    }
    std::cerr << text << '\n';
  }

  const SectionArguments& options_;
  const RangedCase case_;
  const Model model_;
  const SectionProblem problem_;
  const LevelSet level_;
  Progress progress_;
  const OrbitCutter cutter_;
  std::vector<PlacedPoint> domain_;
  double done_ = 0;
  bool cut_short_ = false;  ///< by the time limit
};

/// Of a map the points of its orbits: there is no plane to cut them with.
int section_of(MapCaseFile file, const SectionArguments& options) {
  const SectionOptions& asked = options.request;
  if (!options.symmetry.empty() || asked.energy || !asked.casimirs.empty() || asked.plane ||
      asked.direction || options.longest_cycle() > 0 || options.validated || options.horseshoe ||
      options.duration || options.tolerance_given || options.jobs > 0)
    throw UsageError(
        "a map needs no plane: its orbits are points already; of the options --scene, --param, "
        "--initial, --orbits, --points, --seeds, --pair, --labels, --rotation, --colour and "
        "--output "
        "have a meaning");
  file.file = options.start.in(file.file);
  return section_of_map({options.common, file, asked.pair, asked.labels, options.seeds,
                         options.outputs, options.print, options.orbits, options.points,
                         options.rotation, options.colour});
}

int crossings_of_scene(const SectionArguments& options, const CaseFile& given) {
  const CaseFile file = options.start.in(given);
  const Model model = model_of(file, options.common.parameter_values());
  const SectionProblem problem = section_problem(model, model.scene(options.common.scene),
                                                 section_request(file, model, options.request));
  if (!options.orbits_given)
    return enclose_section(options.common, model, problem, options.duration);
  return enclose_orbits(options.common, model, problem,
                        {options.orbits, options.tolerance, options.jobs}, options.duration);
}

int horseshoe_of(const SectionArguments& options, const CaseFile& given) {
  const CaseFile file = options.start.in(given);
  const Model model = model_of(file, options.common.parameter_values());
  return prove_horseshoe(options.common, model, plane_request(file, model, options.request),
                         options.longest_cycle(), options.certificate);
}

/// Of the cycles of the flow that are their own images some time later.
int cycle_with_symmetry(const SectionArguments& options, const CaseFile& given) {
  const CaseFile file = options.start.in(given);
  const Model model = model_of(file, options.common.parameter_values());
  return section_with_symmetry({options.common, model, model.scene(options.common.scene),
                                options.symmetry, options.period, options.keep_period,
                                options.tolerance});
}

int section(const SectionArguments& options) {
  check_usage(options);
  const AnyCaseFile any = load_any_case(options.case_name, options.common.limits);
  if (const auto* map = std::get_if<MapCaseFile>(&any)) return section_of(*map, options);
  const CaseFile& file = std::get<CaseFile>(any);
  if (!options.symmetry.empty()) return cycle_with_symmetry(options, file);
  if (options.horseshoe) return horseshoe_of(options, file);
  if (options.validated && options.longest_cycle() == 0) return crossings_of_scene(options, file);
  return SectionCommand(options, file).run();
}

}  // namespace

void register_section(CLI::App& program, Action& action) {
  auto options = std::make_shared<SectionArguments>();
  CLI::App* command = program.add_subcommand(
      "section", "Poincare section: many orbits on one energy and Casimir level");
  command->footer(
      "Every crossing of the surface in that direction is a point; each keeps energy and Casimir\n"
      "functions to 1e-10, or the exit status is 1. Angles are drawn over one period. A plane "
      "that\n"
      "is an angle counts at every multiple of its period. Of a map the orbits themselves are\n"
      "drawn, from the start of the scene and from others in a box about its orbit.");
  CLI::Option* tolerance = add_section_options(*command, *options);
  command->callback([options, tolerance, &action, command] {
    options->tolerance_given = tolerance->count() > 0;
    options->orbits_given = command->count("--orbits") > 0;
    options->level_given = command->count("--energy") > 0 || command->count("--casimir") > 0;
    for (const char* name : {"--points", "--seeds"})
      options->of_many_orbits = options->of_many_orbits || command->count(name) > 0;
    for (const char* name : {"--orbits", "--points", "--seeds", "--tolerance", "--jobs"})
      options->about_points = options->about_points || command->count(name) > 0;
    action = action_of(options, section);
  });
}

}  // namespace casimir::tools
