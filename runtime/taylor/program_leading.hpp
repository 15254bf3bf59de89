#pragma once

#include "runtime/module_abi.h"
#include "runtime/program.hpp"
#include "runtime/program/number.hpp"
#include "runtime/program/program_series.hpp"

namespace casimir {

/// At such tolerances it is rounding that limits a run, and leading terms are worth their time.
constexpr double kRoundingShows = 3e-15;

/// The leading terms of Taylor steps in the digits of a long double, from the program of the
/// right-hand side: what quadratic systems have from tables (LeadingTables). In a run of a million
/// steps the rounding of single steps adds up; of a step along a series of order 24 it is that of
/// the first terms, since the later ones are small.
///
/// Where long double has no more digits than double, nothing is gained.
class ProgramLeading {
 public:
  /// Whether the terms may be formed for this program. Not where it branches: with a few digits
  /// more, an argument of |.| next to zero may be on its other side, and the terms would be those
  /// of another function than the rest of the series.
  static bool serves(const Program& rhs);

  /// \param rhs  has to outlive this object.
  /// \param parameters  null if there are none
  ProgramLeading(const Program& rhs, const double* parameters);

  ProgramLeading(const ProgramLeading&) = delete;
  ProgramLeading& operator=(const ProgramLeading&) = delete;

  /// For a run; points to this object.
  casimir_leading view() const;

 private:
  static void add(const void* self, double t, double unit, double s, double* x, double* carry,
                  const double* tail);

  mutable TaylorJet<long double> jet_;
  mutable std::vector<long double> state_;
};

}  // namespace casimir
