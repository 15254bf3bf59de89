#pragma once

#include <optional>
#include <vector>

#include "runtime/kernels/taylor/program_tables.h"
#include "runtime/program.hpp"

namespace casimir {

/// The Taylor series of a right-hand side by tables: what its program does at one order is sorted
/// into groups of like operations that do not wait for each other, and a precompiled kernel takes
/// them register by register. The time to lay it out and the memory grow like the length of the
/// program; nothing is compiled.
class ProgramLayout {
 public:
  /// \param width  of the registers: 2, 4 or 8 numbers.
  /// \return  nothing where the program has operations that have no group: tan, hyperbolic and
  ///          inverse functions, atan2, |.|, sign.
  static std::optional<ProgramLayout> of(const Program& program, std::size_t parameters, int width);

  /// Before the first expansion, and wherever order or parameters change.
  void start(int order, const double* parameters);

  /// \param rows    coefficients of the states, order + 1 rows; the first holds the state.
  /// \param stride  numbers in a row.
  void expand(double t, double unit, double* rows, int stride);

 private:
  struct Group {
    int kind = 0, level = 0, target = 0, padded = 0;
    std::vector<int> lines;      ///< that it does; the first of a pair of sine and cosine
    std::vector<int> a, b;       ///< places
    std::vector<int> constant;   ///< lines of constants, where there are any
    std::vector<double> values;  ///< of these
    std::size_t history = 0;     ///< where its series begin
  };
  class Sorter;

  Program program_;
  std::size_t parameters_ = 0;
  int width_ = 8, places_ = 0, time_ = 0, first_constant_ = 0;
  std::vector<int> constants_;     ///< lines whose values are places
  std::vector<bool> is_constant_;  ///< lines that depend on parameters only
  std::vector<Group> groups_;
  std::vector<int> outputs_;
  /// Whole lines of the cache: a register that lies across two of them is loaded twice.
  struct alignas(64) Line {
    double numbers[8] = {};
  };
  std::vector<double> constant_values_;
  std::vector<Line> place_, history_;
  std::vector<casimir_group> tables_;
  int order_ = 0;
};

}  // namespace casimir
