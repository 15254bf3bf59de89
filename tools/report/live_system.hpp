#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "codegen/emit_wasm.hpp"
#include "codegen/specialise.hpp"
#include "symbolic/model.hpp"
#include "tools/analysis/section/problem.hpp"

namespace casimir::tools {

/// A section that was drawn: what a page needs to cut orbits by itself.
struct DrawnSection {
  std::array<PlottedFunction, 2> plotted;
  bool upwards = true;
  bool of_angle = false;  ///< the plane is an angle, and there at every multiple of its period
  std::vector<std::string> level_names;
  std::optional<std::vector<double>> levels;  ///< where they are not those of the scene
  std::vector<std::vector<double>> seeds;     ///< a state of each orbit, on the plane
};

/// A scene that a page can integrate: its equations as WebAssembly, with open parameters, and the
/// functions of the state that it evaluates.
struct LiveSystem {
  WasmSeries series;
  std::vector<std::string> states, parameters;
  std::vector<double> initial, values;  ///< of the states and of the parameters
  double duration = 0;
  std::vector<std::string> functions;  ///< invariants first, what is below after them
  std::size_t levels = 0;  ///< how many of them are the Hamiltonian or Casimir functions
  std::size_t invariants = 0;

  /// A function that is compared with 0 at the start.
  struct Watched {
    std::string text;
    std::size_t at = 0;  ///< among the functions
    Comparison comparison = Comparison::unequal;
  };
  std::vector<Watched> conditions, constraints;

  struct Cut {
    std::size_t plane = 0;  ///< among the functions
    std::array<std::size_t, 2> pair = {};
    DrawnSection drawn;
  };
  std::optional<Cut> section;
};

/// The system of a scene, for a page.
/// \param drawn  its section, if it has one that can be cut there
/// \throws ModelError, RequestError  for what a page cannot integrate, with the reason
LiveSystem live_system(const Model& model, const Scene& scene,
                       const std::optional<DrawnSection>& drawn);

}  // namespace casimir::tools
