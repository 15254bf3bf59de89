#pragma once

#include <optional>
#include <vector>

#include "tests/adversary/case.hpp"
#include "tests/adversary/evaluate.hpp"
#include "tests/adversary/random.hpp"
#include "tests/adversary/residuals.hpp"

namespace casimir::adversary {

/// Draws real points for a claim: inside of every assumption, and on the level where the claim is
/// about one.
class Sampler {
 public:
  /// \param generic  only points with no special values, for what is said of almost all points
  Sampler(const Case& claim, const std::vector<Assumption>& more, bool generic, Random& random);

  /// A point, or none where this try met none.
  std::optional<Point> draw();
  /// What came of the last point, or of the last try: whether the claim holds there, or nobody
  /// knows.
  void note(bool holds) { (holds ? agreed_ : doubtful_)[piece_] = true; }
  /// Whether no part of the level has only points of which nobody knows: what holds on the others
  /// need not hold there.
  bool is_settled() const;

  /// Whether there are assumptions, which may admit special points that are seldom met, or complex
  /// values, which differ by branches.
  bool is_intricate() const { return !assumptions_.empty() || is_complex(case_); }

 private:
  Point free_values();
  bool admits(const Point& point) const;

  const Case& case_;
  std::vector<Assumption> assumptions_;
  Substitution names_;
  bool generic_;
  Random& random_;
  std::size_t piece_ = 0;                ///< of the last point; all are visited in turn
  std::vector<bool> agreed_, doubtful_;  ///< by piece
};

/// Whether `left RELATION 0` holds there, where what is zero to 40 digits is zero.
bool holds(const Assumption& assumption, const Point& point);
/// The functions whose common zero level a claim is about; for an invariant relation it is among
/// them.
std::vector<Expr> level_of(const Case& claim);

}  // namespace casimir::adversary
