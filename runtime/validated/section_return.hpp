#pragma once

#include <string>
#include <vector>

#include "runtime/validated/crossings.hpp"
#include "runtime/validated/lohner.hpp"

namespace casimir::validated {

/// States m + C s + r, with s and r anywhere in their boxes around zero.
struct AffineSet {
  std::vector<double> middle;  ///< m
  Matrix<double> directions;   ///< C
  std::vector<MidRad> along;   ///< s
  std::vector<MidRad> rest;    ///< r, one for each state
};

/// Where the solutions that begin in a set come to the surface s = 0 for the first time while s
/// increases. Each state there is
///   middle + C s + B r + (t - t0) f(x),
/// componentwise with some x of `states` and t - t0 in `late`.
template <class Ball>
struct FirstReturn {
  Ball time;                 ///< contains the time of each solution
  std::vector<Ball> middle;  ///< of the states at the time t0
  Matrix<Ball> by_along;     ///< C: the derivative by s
  std::vector<Ball> along;   ///< s
  Matrix<Ball> by_rest;      ///< B
  std::vector<Ball> rest;    ///< r
  Ball late;                 ///< t - t0
  std::vector<Ball> rates;   ///< f over the states
  std::vector<Ball> states;  ///< contain those of each solution between t0 and its return

  /// The values of a linear function w (x - origin) at the returns.
  Ball along_row(const std::vector<Ball>& row, const std::vector<double>& origin) const;
};

/// What a return is sought with.
struct ReturnSettings {
  int order = 18;
  int log2_error = -54;  ///< of a step, in units of the state
  int max_steps = 2000;
  /// Only for tests that have to see a proof fail: takes s for monotone wherever it may vanish.
  bool without_monotony = false;
};

/// The first return to a surface, of sets of solutions of an autonomous system, as theorems.
///
/// What is proved where an answer is given, for every x of the set that lies on s = 0 and on the
/// levels: the solution from x exists up to its return, which lies on the levels (each integral is
/// rational or analytic all the way: the angle of a state jumps at its cut); s increases strictly
/// through zero at the start and at the return; between the two it passes every zero once, and only
/// downwards: so the return is the first one, none is missed, and it depends continuously on x
/// (implicit function theorem). Each of this is checked by `Crossings` on every step; that the
/// start is transversal is checked here. In balls of doubles, or of Arb's at the precision of the
/// thread.
template <class Ball>
class SectionReturn {
 public:
  /// The programs must outlive this. The system must not depend on the time.
  /// \param plane      s, and its derivative along solutions.
  /// \param integrals  constant along solutions, each with the interval of its values on the sets.
  SectionReturn(const FlowProgram& flow, const std::vector<Integral>& integrals,
                std::vector<ArbBall> levels, const Program& plane, const ReturnSettings& settings);

  /// \param expected  about when the middle returns: a step is made to begin shortly before.
  /// \return  whether it is proved; else `reason` says why not.
  bool find(const AffineSet& set, double expected);

  const FirstReturn<Ball>& result() const { return result_; }
  const std::string& reason() const { return reason_; }

 private:
  using Vector = std::vector<Ball>;
  bool begin(const AffineSet& set);
  /// Goes on by one step. \return  false where that is not possible.
  bool step(double expected);
  double enclosed_step(double proposed, double expected);
  /// Whether a passage upwards was found, and lies within the step.
  bool passes(double h, std::size_t known);
  bool describe(const Passage<Ball>& passage, double h);
  bool fail(std::string reason);

  const Program& plane_;
  std::vector<ArbBall> levels_;
  ReturnSettings settings_;
  Lohner<Ball> lohner_;
  BallFunction<Ball> rates_, plane_function_;
  std::optional<Crossings<Ball>> crossings_;
  FirstReturn<Ball> result_;
  std::string reason_;
  double elapsed_ = 0;
  bool done_ = false;
};

}  // namespace casimir::validated
