#pragma once

#include "runtime/certificate/arb_series.hpp"
#include "runtime/run_trace.hpp"
#include "runtime/validated/linear.hpp"

namespace casimir::certificate {

using BallMatrix = validated::Matrix<ArbBall>;

/// The states m + C s + B r of a trace, with s and r around zero.
struct BallSet {
  Vector middle;       ///< m, exact
  BallMatrix carried;  ///< C, exact; no columns where the start is a point
  Vector start;        ///< s
  BallMatrix frame;    ///< B, exact
  Vector rest;         ///< r

  std::size_t dimension() const { return middle.size(); }
};

/// The set at the start of a trace. \param wide  the start is no point.
BallSet first_set(const RunTrace& trace, bool wide);
/// The set of a step, with the s of the run.
BallSet set_of(const TracedSet& traced, const Vector& start);

/// C s + B r
Vector deviations(const BallSet& set);
/// A box around m that contains the set.
Vector hull_of(const BallSet& set);
/// The ends of the smallest box of doubles that contains the set, computed exactly.
std::vector<std::array<std::string, 2>> exact_box(const BallSet& set);

/// A matrix that contains the inverse of every matrix of balls. \return false if there is none.
bool invert(const BallMatrix& matrix, BallMatrix& inverse);

}  // namespace casimir::certificate
