#include "tools/report/findings.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "codegen/compile.hpp"
#include "symbolic/error.hpp"
#include "tools/analysis/proof/prove_in_process.hpp"
#include "tools/analysis/proof/proved_facts.hpp"
#include "tools/analysis/section/orbits.hpp"
#include "tools/cli/errors.hpp"
#include "tools/cli/stopwatch.hpp"
#include "tools/runs/conserve_run.hpp"
#include "tools/runs/further_integral.hpp"
#include "tools/text/runs/trust_report.hpp"

namespace casimir::tools {
namespace {

/// Between two looks at the clock a proof about more would take too long for a page.
constexpr std::size_t kMostVariablesOfObstruction = 8;

/// Does one part after the other; what fails is noted and the next part is done.
class Investigation {
 public:
  Investigation(const Model& model, const ReportOptions& options)
      : model_(model), options_(options) {}

  Findings all() {
    if (!model_.scenes.empty()) result_.scene = &model_.scene(options_.scene);
    part("proofs", 0, [&] { prove_claims(); });
    if (options_.obstruction > 0 && model_.variables.size() <= kMostVariablesOfObstruction)
      part("further integrals", 0.05, [&] { exclude_integrals(); });
    if (result_.scene) {
      part("generated code", 0.1, [&] { generate(); });
      part("motion", 0.2, [&] { move(); });
      part("enclosure", 0.25, [&] { enclose_end(); });
      if (model_.section) part("cycles", 0.28, [&] { prove_cycles(); });
      part("drift", 0.3, [&] { conserve(); });
      if (options_.budget > 0) part("error against run time", 0.5, [&] { measure(); });
    } else {
      result_.notes.emplace_back("The case has no scene: nothing is generated or integrated.");
    }
    result_.machine = this_machine();
    return std::move(result_);
  }

 private:
  double left() const {
    return options_.time_limit > 0 ? options_.time_limit - watch_.seconds() : 1;
  }

  void part(const std::string& name, double share, const std::function<void()>& work) {
    if (options_.progress) options_.progress(name, share);
    if (left() <= 0) {
      result_.stopped = true;
      result_.notes.push_back(fmt::format("Not done within the time limit: {}.", name));
      return;
    }
    const auto note = [&](const std::exception& problem) {
      result_.notes.push_back(fmt::format("{}: {}", name, problem.what()));
    };
    try {
      work();
    } catch (const EnvironmentError& problem) {
      result_.problems.push_back(fmt::format("{}: {}", name, problem.what()));
    } catch (const SystemError& problem) {
      result_.problems.push_back(fmt::format("{}: {}", name, problem.what()));
    } catch (const CaseError& problem) {
      note(problem);
    } catch (const ModelError& problem) {
      note(problem);
    } catch (const RequestError& problem) {
      note(problem);
    } catch (const SingularPoint& problem) {
      note(problem);
    }
  }

  std::function<bool()> give_up() const {
    return options_.time_limit > 0 ? time_limit(std::max(left(), 1e-3)) : std::function<bool()>{};
  }

  void prove_claims() {
    const Stopwatch watch;
    result_.proofs =
        prove_within(options_.time_limit > 0 ? left() : 0, model_, {}, [](const Proof&) {});
    result_.verdict = overall(model_, result_.proofs);
    result_.proof_seconds = watch.seconds();
  }

  void exclude_integrals() {
    const double seconds =
        options_.time_limit > 0 ? std::min(left(), options_.obstruction) : options_.obstruction;
    result_.obstruction = further_integral(model_, options_.scene, result_.proofs, seconds);
  }

  void generate() {
    SpecialiseOptions what;
    what.fold_parameters = options_.code.fold_parameters;
    what.keep_parameters = options_.code.keep_parameters;
    what.gradients = true;
    result_.code = specialise(model_, *result_.scene, what);
  }

  void move() {
    SceneOptions code = options_.code;
    code.observe = std::vector<std::string>{};
    const PreparedScene run = prepare(model_, *result_.scene, code);
    AssessmentOptions how;
    how.time_limit = options_.time_limit > 0 ? left() : 0;
    const AssessedRun judged = integrate_assessed(model_, *result_.scene, run, how);
    result_.motion_method = judged.method->name;
    result_.motion = motion_of(run, judged);
    if (judged.trajectory.status != Status::ok)
      result_.notes.push_back(fmt::format("motion: the run stopped at t = {:.6g}: {}",
                                          judged.trajectory.time, judged.trajectory.reason));
    for (const std::string& warning : words_of(judged).warnings)
      result_.notes.push_back("motion: " + warning);
  }

  /// Seconds for a part that is not to hold up the page.
  double at_most(double seconds) const {
    return options_.time_limit > 0 ? std::clamp(left(), 1e-3, seconds) : seconds;
  }

  void enclose_end() {
    if (!result_.scene->duration) return;
    constexpr double kLongest = 2;
    ValidatedOptions how;
    how.observe = std::vector<std::string>{};
    how.run.give_up = [late = time_limit(at_most(kLongest))](double) { return late(); };
    result_.enclosure = enclose(model_, *result_.scene, how);
  }

  /// Fixed points of the return map on the level of the scene, as many as some starts lead to.
  void prove_cycles() {
    constexpr std::size_t kStarts = 100, kMost = 8;
    constexpr double kLongest = 4, kLongestOfOne = 2;
    if (!model_.hamiltonian || !model_.poisson || model_.time) return;
    const auto late = time_limit(at_most(kLongest));
    const SectionProblem problem = section_problem(model_, *result_.scene);
    const LevelSet level(problem);
    const OrbitCutter cutter(problem, {1e-14, 1, late}, kStarts);
    const std::vector<PlacedPoint> domain = points_of_domain(level, cutter.returning(), {});
    CycleSearch found =
        find_cycles(level, cutter, spread_out(level, domain, kStarts), 1,
                    verdict_on_jacobi(model_, *result_.scene) == Verdict::proved, [](double) {});
    if (found.cycles.size() > kMost) found.cycles.resize(kMost);
    for (const Cycle& cycle : found.cycles) {
      if (late()) break;
      ProvedCycle proof =
          enclose_cycles(model_, *result_.scene, problem, {cycle}, {}, kLongestOfOne).front();
      if (proof.proved) result_.cycles.push_back(std::move(proof));
    }
    result_.cycle_level = problem.proved_level_text();
  }

  /// Every scene by every method, none for longer than a reader would wait.
  void conserve() {
    result_.drift_bound = ConservationOptions{}.bound;
    for (const Scene& scene : model_.scenes) {
      if (!scene.unusable.empty() || !scene.duration) continue;
      for (const std::string& method : conserving_methods()) {
        if (left() <= 0) {
          result_.stopped = true;
          return;
        }
        conserve_one(scene, method_named(method));
      }
    }
  }

  void conserve_one(const Scene& scene, const Method& method) {
    constexpr double kLongestRun = 5;
    const double seconds =
        options_.time_limit > 0 ? std::clamp(left(), 1e-3, kLongestRun) : kLongestRun;
    const ConservationOptions what{.code = options_.code, .give_up = time_limit(seconds)};
    std::vector<DriftRecord> drifts;
    Row row = conserve_scene(model_, scene, method, what, &drifts);
    if (row.end == RowEnd::ran && row.status == Status::stopped) {
      row.failed = false;
      row.refused = true;
      row.reason = fmt::format("not at its end after {:.2g} s", seconds);
    }
    if (&scene == result_.scene)
      result_.drifts.insert(result_.drifts.end(), drifts.begin(), drifts.end());
    result_.runs.push_back(std::move(row));
  }

  void measure() {
    ComparisonOptions what{.tolerances = {1e-3, 1e-5, 1e-7, 1e-9, 1e-11, 1e-13, 1e-15},
                           .code = options_.code,
                           .budget = options_.budget,
                           .quick = options_.quick,
                           .reference_limit = std::max(2 * options_.budget, 2.0),
                           .give_up = give_up()};
    if (options_.progress)
      what.progress = [&](const std::string& doing, double share) {
        options_.progress(doing, 0.5 + share / 2);
      };
    MethodComparison contest = compare_methods(model_, *result_.scene, what);
    if (options_.quick)
      contest.notes.emplace_back(
          "measured beside the reports on other cases, and without Boost.Odeint, which takes "
          "longer "
          "to compile than all else: a report on this case alone has it");
    if (contest.no_reference.empty())
      result_.contest = std::move(contest);
    else
      result_.notes.push_back("error against run time: " + contest.no_reference);
  }

  const Model& model_;
  const ReportOptions& options_;
  const Stopwatch watch_;
  Findings result_;
};

}  // namespace

int Findings::exit_status() const {
  const auto failed = [](const Row& row) { return row.failed; };
  const bool wrong =
      std::ranges::any_of(runs, failed) || (contest && std::ranges::any_of(contest->rows, failed));
  if (verdict == Verdict::refuted || wrong) return kFailed;
  if (!problems.empty()) return kEnvironment;
  return verdict == Verdict::proved ? kDone : kUndecided;
}

Findings investigate(const Model& model, const ReportOptions& options) {
  return Investigation(model, options).all();
}

}  // namespace casimir::tools
