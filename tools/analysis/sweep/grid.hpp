#pragma once

#include <ginac/ginac.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace casimir {

/// What is varied along one direction of a grid.
struct Axis {
  std::string name;
  /// What it sets.
  enum class Kind { parameter, state, free };  ///< free: only expressions of `Lets` have it
  Kind kind = Kind::parameter;
  std::vector<double> values;  ///< each the nearest to its exact value
};

/// All combinations; the last axis runs fastest.
struct Grid {
  std::vector<Axis> axes;

  /// How many combinations there are.
  std::size_t points() const;
  /// One value for each axis.
  std::vector<double> at(std::size_t point) const;
};

/// Initial values and parameters as functions of what a grid varies.
struct Lets {
  std::vector<GiNaC::symbol> axes;                             ///< one for each axis of the grid
  std::vector<std::pair<std::string, GiNaC::ex>> values = {};  ///< by name, over these symbols
  /// As written: by this a sweep that goes on knows them again, in another process, in which GiNaC
  /// may print the terms of a sum in another order.
  std::string text = {};
};

/// Most points of a sweep.
inline constexpr std::size_t kMostPoints = 20'000'000;

}  // namespace casimir
