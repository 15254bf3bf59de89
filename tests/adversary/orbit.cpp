#include "tests/adversary/orbit.hpp"

#include <algorithm>
#include <cmath>

#include "tests/adversary/residuals.hpp"
#include "tests/adversary/sampler.hpp"

namespace casimir::adversary {
namespace {

using State = std::vector<Ball>;

class Stepper {
 public:
  explicit Stepper(const Case& claim) : case_(claim) {}

  State rate(const Point& point) const {
    State f = At(case_, point).field();
    for (Ball& ball : f) {
      // On a cut the middle is the mean of two branches, and the orbit that of neither.
      if (!ball.is_sharp()) throw Unknown();
      ball = ball.middle();
    }
    return f;
  }

  Point moved(Point point, const State& velocity, const Ball& h) const {
    const System& system = case_.system;
    for (std::size_t i = 0; i < system.variables.size(); ++i) {
      Ball& x = point[system.variables[i]];
      x = (x + h * velocity[i]).middle();
    }
    if (!system.time.empty()) point[system.time] = (point[system.time] + h).middle();
    return point;
  }

  /// Gragg's midpoint rule with n parts.
  Point midpoint(const Point& start, const Ball& h, long n) const {
    const Ball part = h / Ball(n);
    Point before = start, now = moved(start, rate(start), part);
    for (long k = 1; k < n; ++k) {
      Point next = moved(before, rate(now), Ball(2) * part);
      if (!case_.system.time.empty()) next[case_.system.time] = now[case_.system.time] + part;
      before = std::move(now);
      now = std::move(next);
    }
    return now;
  }

  Point step(const Point& start, const Ball& h) const {
    constexpr long kColumns = 8;
    std::vector<Point> column;
    for (long k = 0; k < kColumns; ++k) {
      column.push_back(midpoint(start, h, 2 * (k + 1)));
      for (long m = k - 1; m >= 0; --m) {
        const Ball ratio = Ball::ratio((k + 1) * (k + 1), (m + 1) * (m + 1)) - Ball(1);
        for (const std::string& name : case_.system.variables) {
          Ball& coarse = column[static_cast<std::size_t>(m)][name];
          const Ball& fine = column[static_cast<std::size_t>(m) + 1][name];
          coarse = (fine + (fine - coarse) / ratio).middle();
        }
      }
    }
    if (!case_.system.time.empty())
      column.front()[case_.system.time] = start.at(case_.system.time) + h;
    return column.front();
  }

 private:
  const Case& case_;
};

/// d/ds of every coordinate of the explicit orbit less the field there, all zero to 40 digits.
bool solves(const Case& claim, const Point& at_s) {
  Point point = at_s;
  State velocity;
  for (const std::string& name : claim.system.variables) {
    const Dual x = evaluate(claim.orbit->at(name), at_s, {"s"}, true);
    point[name] = x.value;
    velocity.push_back(x.slope.front());
  }
  if (!claim.system.time.empty()) point[claim.system.time] = at_s.at("s");
  const State field = At(claim, point).field();
  for (std::size_t i = 0; i < field.size(); ++i) {
    if (!(velocity[i] - field[i]).is_tiny()) return false;
  }
  return true;
}

/// Whether the point of the explicit orbit at that time is inside of all conditions.
bool admits(const Case& claim, const Point& at_s, const std::vector<Assumption>& conditions) {
  Point point = at_s;
  for (const std::string& name : claim.system.variables)
    point[name] = value(claim.orbit->at(name), at_s);
  return std::all_of(conditions.begin(), conditions.end(), [&](const Assumption& a) {
    return holds({substitute(a.left, names_of(claim)), a.relation}, point);
  });
}

/// The values of what should stay, at time s of the explicit orbit.
State kept(const Case& claim, Point point, const Ball& s) {
  point["s"] = s;
  Point there = point;
  for (const std::string& name : claim.system.variables)
    there[name] = value(claim.orbit->at(name), point);
  if (!claim.system.time.empty()) there[claim.system.time] = s;
  State values;
  for (const Expr& f : level_of(claim)) values.push_back(At(claim, there).value(f));
  if (claim.kind == Kind::conditional)
    values.push_back(At(claim, there).value(claim.conditionals.front().expression));
  if (claim.kind == Kind::integral)
    values.push_back(At(claim, there).value(claim.integrals.front().value));
  return values;
}

}  // namespace

void follow(const Case& claim, Point start, double duration,
            const std::function<bool(const Point&)>& visit) {
  constexpr long kStepsInOne = 8;
  const Stepper stepper(claim);
  const long steps = std::lround(duration * kStepsInOne);
  for (long k = 0; k < steps; ++k) {
    try {
      start = stepper.step(start, Ball::ratio(1, kStepsInOne));
    } catch (const NotReal&) {
      if (k == 0) throw;
      return;
    } catch (const Unknown&) {
      if (k == 0) throw;
      return;
    }
    if (!visit(start)) return;
  }
}

bool explicit_orbit_leaves(const Case& claim, const Point& parameters,
                           const std::vector<Assumption>& more) {
  if (!claim.orbit) return false;
  std::vector<Assumption> conditions = claim.system.assumptions();
  conditions.insert(conditions.end(), more.begin(), more.end());
  try {
    for (long k = 1; k < 8; ++k) {
      Point at_s = parameters;
      at_s["s"] = Ball::ratio(k, 8);
      if (!solves(claim, at_s) || !admits(claim, at_s, conditions)) return false;
    }
    const State first = kept(claim, parameters, 0), last = kept(claim, parameters, 1);
    for (std::size_t i = 0; i < first.size(); ++i) {
      if ((last[i] - first[i]).is_nonzero()) return true;
    }
  } catch (const NotReal&) {
  } catch (const Unknown&) {
  }
  return false;
}

}  // namespace casimir::adversary
