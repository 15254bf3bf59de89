#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tests/traps/formula.hpp"

namespace casimir::traps {

/// A state with what is large in it: errors are relative to `sizes`.
struct Truth {
  std::vector<Real> state;
  std::vector<Real> sizes;  ///< the largest of each along the way; empty: not known
};

/// A scene whose end state is known, or can be had by `reference`.
struct Scene {
  std::string kind;  ///< what makes it a trap, as "pulse"
  /// Names the case file without its numbers: scenes of one shape share a compiled module.
  std::string shape;
  Texts variables;
  std::string time{};
  Named parameters{};   ///< with exact values; kept at run time
  Named definitions{};  ///< each over what stands before it
  Texts equations{};
  std::string
      hamiltonian{};  ///< instead of the equations in the file, where the variables are q, p
  Texts initial{};
  std::string duration{};
  /// The longest step of the reference integrator, over variables, parameters and the time: never
  /// longer than a fraction of the distance to what is narrow, and of its width.
  std::string limit{};
  bool small_matters = false;  ///< what dies out comes back: the reference follows it down
  std::optional<std::vector<Real>> exact{};  ///< by a closed form
  std::optional<Real> singular_at{};         ///< there is no real solution beyond this time

  /// The case file.
  std::string text() const;
};

}  // namespace casimir::traps
