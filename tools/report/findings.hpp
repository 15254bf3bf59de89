#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "codegen/specialise.hpp"
#include "symbolic/obstruction/obstruct.hpp"
#include "symbolic/prove.hpp"
#include "tools/analysis/benchmark/method_comparison.hpp"
#include "tools/analysis/run/validated.hpp"
#include "tools/analysis/section/validated_cycles.hpp"
#include "tools/cli/machine.hpp"
#include "tools/plot/drift_plot.hpp"
#include "tools/plot/motion_plot.hpp"
#include "tools/text/runs/run_report.hpp"

namespace casimir::tools {

/// How a report is made.
struct ReportOptions {
  std::string scene = "default";
  double budget = 4;       ///< seconds of measuring error against run time; 0: not at all
  bool quick = false;      ///< as of ComparisonOptions
  double time_limit = 0;   ///< seconds for the whole; 0: none
  double obstruction = 0;  ///< seconds for a proof that there is no further integral; 0: not at all
  SceneOptions code = {};
  /// Told what is being done and which share of it is done.
  std::function<void(const std::string& what, double share)> progress = {};
};

/// Everything that a report tells of a case. Parts that could not be had are empty, and `problems`
/// or `notes` says why.
struct Findings {
  std::vector<Proof> proofs;
  Verdict verdict = Verdict::undecided;
  double proof_seconds = 0;
  /// Where Liouville's count lacks an integral, whether one is excluded.
  std::optional<obstruction::Obstruction> obstruction;

  const Scene* scene = nullptr;  ///< of the model; null for a case without one
  std::optional<Specialisation> code;
  std::vector<DriftRecord> drifts;  ///< of the scene, one for each method
  std::vector<Row> runs;            ///< of every scene, by the methods of `conserve`
  double drift_bound = 0;
  std::string motion_method;
  std::optional<Motion> motion;
  std::optional<MethodComparison> contest;
  std::optional<ValidatedMotion> enclosure;  ///< of the state at the end, as far as it got
  std::string cycle_level;                   ///< of the cycles, "H = 1.5, F1 = 1"
  std::vector<ProvedCycle> cycles;           ///< fixed points of the return map that are proved
  Machine machine;

  std::vector<std::string> notes;     ///< what was left out for a reason of the case
  std::vector<std::string> problems;  ///< what the environment did not allow
  bool stopped = false;               ///< the time limit left something out

  /// Whether everything that was checked holds: the exit status of `report`.
  int exit_status() const;
};

/// Proves, generates, integrates and measures.
/// \throws CaseError  for an unknown scene
Findings investigate(const Model& model, const ReportOptions& options);

}  // namespace casimir::tools
