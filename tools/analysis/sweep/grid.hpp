#pragma once

#include <cln/float.h>

#include <cstddef>
#include <string>
#include <vector>

#include "symbolic/model.hpp"

namespace casimir::tools {

/// One `--over NAME=FROM:TO:N` or `--over NAME=A,B,C`.
struct Axis {
  std::string name;
  enum class Kind { parameter, state, free };  ///< free: only expressions of `--let` have it
  Kind kind = Kind::parameter;
  std::vector<double> values;  ///< each the nearest to its exact value
};

/// All combinations; the last axis runs fastest.
struct Grid {
  std::vector<Axis> axes;

  std::size_t points() const;
  /// One value for each axis.
  std::vector<double> at(std::size_t point) const;
};

/// \param lets  the texts of `--let`: names in an axis that the model does not have are free only
/// if
///              these use them.
/// \throws CaseError   with the place in the option: an unknown or repeated name, a bad number, N
/// \throws UsageError  for more points than a sweep can hold
Grid read_grid(const std::vector<std::string>& over, const std::vector<std::string>& lets,
               const Model& model);

/// Most points of a sweep.
inline constexpr std::size_t kMostPoints = 20'000'000;

}  // namespace casimir::tools
