#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "runtime/section.hpp"
#include "symbolic/model.hpp"
#include "tools/analysis/run/prepared_scene.hpp"

namespace casimir {

/// A function of the state, and how it was written.
struct FunctionText {
  GiNaC::ex function;
  std::string text;
};

/// What is asked of a section; what is left out is that of the case and of the scene.
struct SectionRequest {
  std::optional<FunctionText> plane = {};  ///< it is zero there
  std::optional<bool> upwards = {};        ///< in which direction the plane is crossed
  std::vector<FunctionText> pair = {};     ///< what is plotted: none or two
  std::vector<std::string> labels = {};    ///< of the axes: none or two
  std::optional<double> energy = {};
  std::vector<std::pair<std::string, double>> casimirs = {};  ///< values by name
};

/// One of the two functions that are plotted.
struct PlottedFunction {
  std::string text;   ///< as it was written
  std::string label;  ///< of the axis
  double period = 0;  ///< > 0: an angle, known up to multiples of this
};

/// A section made ready to be computed.
struct SectionProblem {
  PreparedScene run;  ///< all states; invariants: H, the Casimirs, the plane, the plotted pair
  PreparedScene deviating;  ///< the same system with one deviation, by the variational equations
  SectionPlane plane;
  std::string plane_text;
  GiNaC::ex plane_function;  ///< for the values of the parameters
  std::array<PlottedFunction, 2> plotted;
  std::vector<std::string> level_names;  ///< "H" and the Casimirs
  std::vector<double> levels;            ///< the value of each
  bool on_scene = true;                  ///< these are the values of the scene
  std::vector<bool> angles;              ///< states that are known up to multiples of 2 Pi
  std::size_t leaf = 4;                  ///< dimension of the symplectic leaf
  /// The rates may jump. The deviations of orbits in lanes are not carried over that (see
  /// Saltation): nothing is said of their growth, and the return has no derivative.
  bool jumps = false;

  /// "H = 1.5, F1 = 1".
  std::string level_text() const;
  /// The same with all digits, for what `enclose_cycles` proves: the shortest decimal that is read
  /// as the double is one of the values for which that holds.
  std::string proved_level_text() const;
  /// The number of states.
  std::size_t states() const { return run.specialisation.states.size(); }
};

/// \throws RequestError  for a system whose orbits lie on no level of an energy: one without a
///                       Hamiltonian, or with the time in it.
void require_energy_level(const Model& model);

/// \throws RequestError  where the return has no derivative that is known
void require_derivative_of_return(const SectionProblem& problem);

/// Specialises the system with plane, pair and level.
/// \throws RequestError  for systems that have no such section: no Hamiltonian, the time in it, one
///                       degree of freedom, Casimir functions that the case does not name.
SectionProblem section_problem(const Model& model, const Scene& scene,
                               const SectionRequest& request = {});

}  // namespace casimir
