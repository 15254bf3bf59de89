#include "symbolic/proof/points/witness.hpp"

#include <cln/rational.h>
#include <cln/rational_io.h>

#include <algorithm>
#include <sstream>

#include "symbolic/algebra/exact_constant.hpp"
#include "symbolic/algebra/where_defined.hpp"
#include "symbolic/functions/point_completer.hpp"
#include "symbolic/proof/points/exact_point.hpp"

namespace casimir {
namespace {

using GiNaC::ex;

/// The symbols that must keep rational values, since they occur otherwise than as plain angles.
std::vector<bool> bare_symbols(const Model& model, const FunctionRing& ring,
                               const Polynomial& numerator, const Level& level) {
  std::vector<bool> bare = functions::PointCompleter(ring.table()).bare_symbols(numerator);
  const auto keep = [&](const ex& e) {
    for (std::size_t i = 0; i < bare.size(); ++i) bare[i] = bare[i] || e.has(ring.symbols()[i]);
  };
  for (const Polynomial& f : level.numerators) {
    const std::vector<bool> of_level = functions::PointCompleter(ring.table()).bare_symbols(f);
    for (std::size_t i = 0; i < bare.size(); ++i) bare[i] = bare[i] || of_level[i];
  }
  for (const Assumption& a : model.assumptions) keep(a.difference);
  return bare;
}

/// The value where it is not zero, as text; exact if it has a normal form, else its first digits.
std::optional<std::string> nonzero_value(const ExactPoint& point, const ex& expression,
                                         BallEvaluator& balls) {
  const auto exact = exact_constant(point.evaluate(expression));
  if (exact) return exact->zero ? std::nullopt : std::optional(exact->text);
  const Ball& ball = balls(expression);
  if (ball.is_zero() != false) return std::nullopt;
  return "about " + ball.text();
}

/// The witness if the value at this point is shown not to be zero, and the level's to be zero.
/// \param brief  what balls do not tell from zero is not evaluated exactly
std::optional<Witness> confirmed(const FunctionRing& ring, const RealPoints& real_points,
                                 const ExactPoint& point, const Suspect& suspect,
                                 const Level& level, bool brief) {
  constexpr long kBits = 192;
  const auto examine = [&]() -> std::optional<Witness> {
    BallEvaluator balls(real_points.numbers(), kBits);
    for (const GiNaC::symbol& s : ring.symbols()) balls.set(s, point.value(s));
    if (!ring.is_polynomial() && !real_points.admits(balls, suspect.domain)) return std::nullopt;
    // Where a function of the claim is not differentiable, nothing is said of its rate. Levels may
    // consist of such points.
    if (level.empty() && !balls.smooth()) return std::nullopt;
    if (brief && balls(suspect.expression).is_zero() != false) return std::nullopt;
    auto value = nonzero_value(point, suspect.expression, balls);
    if (!value) return std::nullopt;
    const bool on_level =
        std::all_of(level.functions.begin(), level.functions.end(), [&](const ex& f) {
          const auto zero = exact_constant(point.evaluate(f));
          return zero && zero->zero;
        });
    if (!on_level) return std::nullopt;
    return Witness{point.coordinates(), std::move(*value)};
  };
  try {
    return where_defined(examine).value_or(std::nullopt);
  } catch (const NotCertified&) {
    return std::nullopt;
  } catch (const TooLarge&) {
    return std::nullopt;
  }
}

/// A point with these rational coordinates.
Point point_at(const FunctionRing& ring, const std::vector<ex>& coordinates) {
  Point point(ring.ring().size(), 0);
  for (std::size_t i = 0; i < coordinates.size(); ++i)
    point[i] = cln::the<cln::cl_RA>(GiNaC::ex_to<GiNaC::numeric>(coordinates[i]).to_cl_N());
  return point;
}

}  // namespace

std::optional<Witness> find_witness(const Model& model, const FunctionRing& ring,
                                    PointSearch& points, RealPoints& real_points,
                                    const Suspect& suspect, const Level& level, bool brief) {
  constexpr int kTrials = 60;
  if (!brief &&
      functions::PointCompleter(ring.table())
          .has_value(suspect.numerator)) {  // the nicest points: every function is rational there
    const functions::PointCompleter::Freedom freedom{
        false, bare_symbols(model, ring, suspect.numerator, level)};
    for (int trial = 0; trial < kTrials; ++trial) {
      const auto point = points.completed(level, freedom);
      if (!point) break;
      if (cln::zerop(suspect.numerator.evaluate(*point))) continue;
      if (auto found = confirmed(ring, real_points, ExactPoint(ring, *point, freedom.bare), suspect,
                                 level, brief))
        return found;
    }
  }
  const std::vector<bool> all_bare(ring.symbols().size(), true);
  const auto at = [&](const Point& point) {
    return confirmed(ring, real_points, ExactPoint(ring, point, all_bare), suspect, level, brief);
  };
  constexpr int kFew = 20, kMany = 400, kBriefTrials = 20;
  if (brief || !ring.is_polynomial()) {
    for (int trial = 0; trial < (brief ? kBriefTrials : kTrials); ++trial) {
      const auto point = points.rational(level, brief ? kFew : kMany);
      if (!point) break;
      if (auto found = at(*point)) return found;
    }
  }
  // A level that cannot be solved, and a narrow domain, may have simple points all the same.
  const int simple_trials = brief ? 30 : 300;
  for (int trial = 0; trial < simple_trials && (!level.empty() || !ring.is_polynomial()); ++trial) {
    const std::vector<ex> simple = real_points.draw_simple();
    BallEvaluator balls(real_points.numbers(), 64);
    try {
      for (std::size_t i = 0; i < simple.size(); ++i) balls.set(ring.symbols()[i], simple[i]);
      const bool near_level = std::all_of(level.functions.begin(), level.functions.end(),
                                          [&](const ex& f) { return balls(f).contains_zero(); });
      if (!near_level || !real_points.admits(balls, suspect.domain)) continue;
      if (balls(suspect.expression).is_zero() != false) continue;
    } catch (const NotCertified&) {
      continue;
    }
    if (auto found = at(point_at(ring, simple))) return found;
  }
  return std::nullopt;
}

}  // namespace casimir
