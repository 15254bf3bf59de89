#include "symbolic/proof/thin_domain.hpp"

#include <algorithm>

namespace casimir {

std::optional<std::string> thin_domain(Prover& prover) {
  const std::vector<Assumption>& assumptions = prover.model().assumptions;
  // Polynomials and quotients have values at almost all points, whatever has cancelled in them.
  static const std::vector<GiNaC::ex> kNothing;
  const std::vector<GiNaC::ex>& functions =
      prover.ring().is_polynomial() ? kNothing : prover.domain();
  if (assumptions.empty() && functions.empty()) return std::nullopt;
  RealPoints& points = prover.real_points();
  const auto is_inside = [&](std::vector<GiNaC::ex> coordinates) {
    try {
      RealPoint point = points.at(std::move(coordinates));
      BallEvaluator& at = point.evaluator();
      const bool assumed =
          std::all_of(assumptions.begin(), assumptions.end(), [&](const Assumption& a) {
            const auto sign = at.sign(a.difference);
            return sign && *sign != 0 && holds(a.comparison, *sign);
          });
      if (!assumed) return false;
      for (const GiNaC::ex& f : functions) at.require(f);
      return at.smooth();
    } catch (const NotCertified&) {
      return false;
    }
  };
  const auto states = points.scenes();
  if (std::any_of(states.begin(), states.end(), is_inside)) return std::nullopt;
  constexpr int kTries = 400;
  for (int k = 0; k < kTries; ++k)
    if (is_inside(points.draw())) return std::nullopt;
  for (int k = 0; k < kTries; ++k)
    if (is_inside(points.draw_wide())) return std::nullopt;
  return functions.empty()
             ? "no point was found at which all assumptions hold and none of them with equality: "
               "they may leave special values only"
             : "no point was found with real values of all functions around it at which the "
               "assumptions hold, none of them with equality: there may be special values only";
}

}  // namespace casimir
