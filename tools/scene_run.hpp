#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "codegen/specialise.hpp"
#include "runtime/integrate.hpp"
#include "runtime/reference.hpp"
#include "runtime/work_precision.hpp"
#include "symbolic/model.hpp"

namespace casimir::tools {

/// A scene made ready to run: generated code, and its numbers in double.
struct SceneRun {
  Specialisation specialisation;
  std::vector<double> initial;     ///< of the kept states
  std::vector<double> rounding;    ///< what rounding them to double left out
  std::vector<double> parameters;  ///< at run time; empty when folded
  std::vector<double> parameter_rounding;
  double duration = 0;

  /// Writes the size of the largest term of each invariant at a state: see Settings.
  std::function<void(double t, const double* x, double* sizes)> invariant_sizes() const;
  double generate_seconds = 0;
};

struct SceneOptions {
  bool fold_parameters = true;
  std::vector<std::string> keep_parameters = {};  ///< although the others are folded
  std::optional<std::vector<std::string>> observe;
};

/// Specialises a scene and rounds its data. \throws ModelError  for data outside double's range.
SceneRun prepare(const Model& model, const Scene& scene, const SceneOptions& options = {});

/// The module of a scene for one method: from the cache, or compiled. Modules of methods that need
/// no kernel of ours are one and the same.
struct CompiledModule {
  Module module;
  double seconds = 0;  ///< to compile or fetch it
  bool from_cache = false;
  bool compiled = true;      ///< false: table-driven or interpreted
  std::string warning = {};  ///< what the user should know about how it was made, or empty
};
CompiledModule compile_for(const SceneRun& run, const Method& method);

/// The state that errors are measured against: the one of the case file where it has 25 digits and
/// more, otherwise a multiprecision run of our own. Empty with a reason if there is none.
struct TruthOrReason {
  std::optional<Truth> truth;
  std::string source;  ///< "the case file", or "our own, 40 digits, error below 1e-30"
  std::string reason;
};
TruthOrReason truth_of(const Scene& scene, const SceneRun& run, int digits,
                       const std::function<bool()>& give_up);

/// The largest value that each state takes along a run in double precision, at 200 times; at least
/// a millionth of the largest of all. What errors are measured against.
std::vector<double> state_sizes(const SceneRun& run);

/// A watch for `--time-limit`: answers true once that many seconds have passed; never for 0.
std::function<bool()> time_limit(double seconds);

}  // namespace casimir::tools
