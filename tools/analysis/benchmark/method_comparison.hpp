#pragma once

#include <functional>
#include <string>
#include <vector>

#include "codegen/specialise.hpp"
#include "runtime/equal_error.hpp"
#include "runtime/work_precision.hpp"
#include "symbolic/model.hpp"
#include "tools/analysis/estimate/reference_state.hpp"
#include "tools/analysis/row.hpp"
#include "tools/analysis/run_request.hpp"

namespace casimir {

/// What is to be measured, and for how long.
struct ComparisonOptions {
  std::vector<std::string> methods = {};  ///< empty: all that suit the case
  std::vector<double> tolerances = {};
  RunRequest run = {};
  SceneOptions code = {};  ///< of the specialised code: parameters that are kept, for one
  int digits = 30;
  double budget = 8;
  int repeat = 0;  ///< > 0: rounds for everybody, instead of a budget
  /// Without `methods`: leaves out what takes longer to compile than to measure.
  bool quick = false;
  double reference_limit = 60;  ///< seconds
  std::function<bool()> give_up = {};
  /// Told what is being done and which share of it is done.
  std::function<void(const std::string& what, double share)> progress = {};
};

/// One method on one kind of code: a curve of the plot, a line of the tables.
struct ComparedMethod {
  std::string method;
  std::string code;     ///< "specialised" or "general"
  std::string outside;  ///< the library that does it, or empty
  /// How tables and pictures name it.
  std::string label() const { return code == "general" ? method + " general" : method; }
  /// Whether it is a method of our own.
  bool own() const { return outside.empty(); }
};

/// The outcome of one scene.
struct MethodComparison {
  std::string case_name, title, scene;
  std::string no_reference;  ///< why nothing could be measured, or empty
  NoReference failure = NoReference::none;
  std::string reference;    ///< where the reference state is from
  double error_bound = 0;   ///< of it, relative to the size of each state
  int digits = 0;           ///< of it
  double conditioning = 0;  ///< growth of small changes; see runtime/work_precision.hpp
  std::vector<std::string> all_states, states;  ///< of the case, and those that are integrated
  OperationCount general, specialised;          ///< of one right-hand side
  std::vector<ComparedMethod> contenders;       ///< ours first
  std::vector<Row> rows;                        ///< by contender, from coarse to fine
  std::vector<std::string> notes;               ///< what was left out, and why

  /// What the good rows of a contender say: rows that are wrong or did not arrive are not in it.
  WorkPrecision curve(const ComparedMethod& contender) const;
};

/// Methods that a bench runs where none are named.
const std::vector<std::string>& usual_methods();

/// Writes into a row how its run ended and, for one that says ok, what its error is worth: it is
/// `wrong` beyond what is explained, or at a tenth of a state's size, where nothing is left of the
/// motion.
/// \param explained  see `explained_error`
/// \param own        a method of ours: then an error that nothing explains is a failure, and makes
///                   the exit status of `bench` 1
void judge_row(Row& row, const Sample& sample, double explained, bool own);

/// Measures one scene: every method at every tolerance, our own on general code too, all in one
/// interleaved run (see `measure`).
///
/// Each row is judged by `judge_row`.
/// \throws EnvironmentError  if nothing is left to be measured, with the reason of the first.
MethodComparison compare_methods(const Model& model, const Scene& scene,
                                 const ComparisonOptions& options);

}  // namespace casimir
