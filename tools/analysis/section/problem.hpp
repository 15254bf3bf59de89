#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "runtime/section.hpp"
#include "symbolic/model.hpp"
#include "tools/analysis/scene_run.hpp"

namespace casimir::tools {

/// What a user says of a section on the command line; what is left out is as in the case file.
struct SectionRequest {
  std::optional<std::string> energy;      ///< an exact real constant
  std::vector<std::string> casimirs;      ///< NAME=VALUE
  std::optional<std::string> plane;       ///< an expression, or LEFT = RIGHT
  std::optional<std::string> direction;   ///< "up" or "down"
  std::vector<std::string> pair, labels;  ///< none or two
};

/// One of the two functions that are plotted.
struct PlottedFunction {
  std::string text;   ///< as it was written
  std::string label;  ///< of the axis
  double period = 0;  ///< > 0: an angle, known up to multiples of this
};

/// A section made ready to be computed.
struct SectionProblem {
  SceneRun run;        ///< all states; invariants: H, the Casimirs, the plane, the plotted pair
  SceneRun deviating;  ///< the same system with one deviation, by the variational equations
  SectionPlane plane;
  std::string plane_text;
  std::array<PlottedFunction, 2> plotted;
  std::vector<std::string> level_names;  ///< "H" and the Casimirs
  std::vector<double> levels;            ///< the value of each
  bool on_scene = true;                  ///< these are the values of the scene
  std::vector<bool> angles;              ///< states that are known up to multiples of 2 Pi
  std::size_t leaf = 4;                  ///< dimension of the symplectic leaf

  /// "H = 1.5, F1 = 1".
  std::string level_text() const;
  std::size_t states() const { return run.specialisation.states.size(); }
};

/// Reads plane, pair and level, and specialises the system.
/// \throws CaseError, UsageError  for what cannot be read, and for systems that have no such
///                    section: no Hamiltonian, the time in it, one degree of freedom, Casimir
///                    functions that the file does not name.
SectionProblem section_problem(const CaseFile& file, const Model& model, const Scene& scene,
                               const SectionRequest& request);

}  // namespace casimir::tools
