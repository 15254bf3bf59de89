#include "tests/adversary/oracle.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "tests/adversary/orbit.hpp"
#include "tests/adversary/ranks.hpp"
#include "tests/adversary/residuals.hpp"
#include "tests/adversary/sampler.hpp"

namespace casimir::adversary {
namespace {

constexpr int kPoints = 12, kPointsOfRank = 40, kSpecialPoints = 150, kTriesForPoint = 12;

/// What one point says.
enum class Sign { zero, nonzero, none };

/// Asks points until one refutes or enough agree.
Finding over_points(Sampler& sampler, const std::function<Sign(const Point&)>& ask,
                    int points = kPoints) {
  int real = 0, agreed = 0;
  bool doubtful = false;
  const int enough = sampler.is_intricate() ? kSpecialPoints : points;
  for (int k = 0; k < kTriesForPoint * enough && agreed < enough; ++k) {
    const auto point = sampler.draw();
    if (!point) continue;
    try {
      const Sign sign = ask(*point);
      ++real;
      if (sign == Sign::nonzero) return Finding::fails;
      if (sign == Sign::zero) ++agreed;
      sampler.note(sign == Sign::zero);
    } catch (const NotReal&) {
    } catch (const Unknown&) {
      doubtful = true;
      sampler.note(false);
    }
  }
  constexpr int kEnough = 4;
  if (agreed >= kEnough) return sampler.is_settled() ? Finding::holds : Finding::unclear;
  return real == 0 && !doubtful ? Finding::nowhere : Finding::unclear;
}

Sign sign_of(const std::vector<Ball>& residuals) {
  bool tiny = true;
  for (const Ball& r : residuals) {
    if (r.is_nonzero()) return Sign::nonzero;
    tiny = tiny && r.is_tiny();
  }
  if (!tiny) throw Unknown();
  return Sign::zero;
}

/// What the orbit through a point of the level says of what should stay.
Sign along_orbit(const Case& claim, const Point& start) {
  std::vector<Expr> kept = level_of(claim);
  if (claim.kind == Kind::conditional) kept.push_back(claim.conditionals.front().expression);
  const At first(claim, start);
  std::vector<Ball> values;
  for (const Expr& f : kept) values.push_back(first.value(f));
  double largest = 0;
  follow(claim, start, claim.duration, [&](const Point& point) {
    const At now(claim, point);
    for (std::size_t i = 0; i < kept.size(); ++i)
      largest = std::max(largest, std::fabs((now.value(kept[i]) - values[i]).as_double()));
    return largest < 1;
  });
  constexpr double kMoved = 1e-6, kStayed = 1e-12;
  if (largest > kMoved) return Sign::nonzero;
  if (largest > kStayed) throw Unknown();
  return Sign::zero;
}

bool fails_along_orbit(const Case& claim, Sampler& sampler, const std::vector<Assumption>& more) {
  if (!claim.orbit) return false;
  const auto point = sampler.draw();
  return point && explicit_orbit_leaves(claim, *point, more);
}

Finding finding_on_level(const Case& claim, Sampler& sampler) {
  int orbits = 0;
  return over_points(sampler, [&](const Point& point) {
    Sign sign = Sign::zero;
    try {
      sign = sign_of(At(claim, point).residuals());
    } catch (const Unknown&) {
      // No derivative there, as of a root: the orbit decides.
      return along_orbit(claim, point);
    }
    constexpr int kOrbitsOfPiece = 6;
    const int enough = kOrbitsOfPiece * static_cast<int>(claim.pieces.size());
    return sign == Sign::zero && orbits++ < enough ? along_orbit(claim, point) : sign;
  });
}

Finding of_ranks(const Case& claim, Sampler& sampler) {
  std::size_t leaf = 0;
  if (claim.kind == Kind::liouville) {
    over_points(sampler, [&](const Point& point) {
      leaf = std::max(leaf, rank(At(claim, point).structure()));
      return Sign::zero;
    });
  }
  // A smaller rank is seen by what is zero to 40 digits, as exp(x^3) may be by accident: but hardly
  // twice, while on a piece of the domain it is met again.
  std::map<std::size_t, int> ranks;
  const auto is_certain = [&](std::size_t rank) { return ++ranks[rank] > 1; };
  return over_points(
      sampler,
      [&](const Point& point) {
        const At at(claim, point);
        if (claim.kind == Kind::rank) {
          is_certain(rank(at.structure()));
          const auto often = [](const auto& entry) { return entry.second > 1; };
          return std::count_if(ranks.begin(), ranks.end(), often) > 1 ? Sign::nonzero : Sign::zero;
        }
        std::size_t found = 0, needed = leaf / 2;
        if (claim.kind == Kind::liouville) {
          found = largest_involutive(claim, at);
        } else {
          std::vector<std::vector<Ball>> slopes;
          for (const Expr& f : functions_of(claim, true)) slopes.push_back(at.gradient(f));
          found = rank(slopes);
          needed = slopes.size();
        }
        return found < needed && is_certain(found) ? Sign::nonzero : Sign::zero;
      },
      kPointsOfRank);
}

bool is_about_ranks(Kind kind) {
  return kind == Kind::independence || kind == Kind::rank || kind == Kind::liouville;
}

/// A density that vanishes is no measure.
Finding of_measure(const Case& claim, Sampler& sampler) {
  bool vanishes = true;
  const Finding finding = over_points(sampler, [&](const Point& point) {
    const At at(claim, point);
    // Between cosines of large numbers zero is a wide ball.
    for (const Measure& m : claim.measures)
      vanishes = vanishes && !at.value(m.density).is_nonzero();
    return sign_of(at.residuals());
  });
  return finding == Finding::holds && vanishes ? Finding::nowhere : finding;
}

}  // namespace

std::string to_string(Finding finding) {
  switch (finding) {
    case Finding::holds:
      return "holds";
    case Finding::fails:
      return "fails";
    case Finding::nowhere:
      return "about nothing";
    case Finding::unclear:
      break;
  }
  return "unclear";
}

Finding examine(const Case& claim, Random& random, const std::vector<Assumption>& more) {
  Sampler sampler(claim, more, is_about_ranks(claim.kind), random);
  if (is_about_ranks(claim.kind)) return of_ranks(claim, sampler);
  if (fails_along_orbit(claim, sampler, more)) return Finding::fails;
  if (claim.kind == Kind::measure) return of_measure(claim, sampler);
  if (claim.kind == Kind::conditional || claim.kind == Kind::invariant_relation)
    return finding_on_level(claim, sampler);
  return over_points(sampler,
                     [&](const Point& point) { return sign_of(At(claim, point).residuals()); });
}

std::string examine_witness(const Case& claim, const Point& point) {
  try {
    const Substitution names = names_of(claim);
    for (const Assumption& a : claim.system.assumptions()) {
      if (!holds({substitute(a.left, names), a.relation}, point))
        return "it is outside of " + a.text();
    }
    const At at(claim, point);
    for (const Expr& f : level_of(claim)) {
      if (at.value(f).is_nonzero()) return "it is not on the level " + f.text();
    }
    if (sign_of(at.residuals()) == Sign::nonzero) return {};
    // A level may also be left where all rates vanish on it, as q^2 = 0 with dq/dt = 1.
    if (!level_of(claim).empty()) return {};
    return "the residual is zero there";
  } catch (const NotReal&) {
    return "it is outside of the real domain";
  } catch (const Unknown&) {
    return {};
  }
}

Finding examine_rank(const Case& claim, std::size_t expected, Random& random,
                     const std::vector<Alternatives>& where) {
  Sampler sampler(claim, {}, true, random);
  const auto is_claimed = [&](const Point& point) {
    return std::all_of(where.begin(), where.end(), [&](const Alternatives& alternatives) {
      return std::any_of(alternatives.begin(), alternatives.end(), [&](const auto& part) {
        return std::all_of(part.begin(), part.end(),
                           [&](const Assumption& a) { return holds(a, point); });
      });
    });
  };
  return over_points(sampler, [&](const Point& point) {
    if (!is_claimed(point)) return Sign::zero;
    return rank(At(claim, point).structure()) == expected ? Sign::zero : Sign::nonzero;
  });
}

}  // namespace casimir::adversary
