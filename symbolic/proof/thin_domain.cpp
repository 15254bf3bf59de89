#include "symbolic/proof/thin_domain.hpp"

#include <algorithm>

namespace casimir {

std::optional<std::string> thin_assumptions(Prover& prover) {
  const std::vector<Assumption>& assumptions = prover.model().assumptions;
  if (assumptions.empty()) return std::nullopt;
  RealPoints& points = prover.real_points();
  const auto is_inside = [&](std::vector<GiNaC::ex> coordinates) {
    try {
      RealPoint point = points.at(std::move(coordinates));
      return std::all_of(assumptions.begin(), assumptions.end(), [&](const Assumption& a) {
        const auto sign = point.evaluator().sign(a.difference);
        return sign && *sign != 0 && holds(a.comparison, *sign);
      });
    } catch (const NotCertified&) {
      return false;
    }
  };
  const auto states = points.scenes();
  if (std::any_of(states.begin(), states.end(), is_inside)) return std::nullopt;
  constexpr int kTries = 400;
  for (int k = 0; k < kTries; ++k)
    if (is_inside(points.draw())) return std::nullopt;
  return "no point was found at which all assumptions hold and none of them with equality: they "
         "may "
         "leave special values only";
}

}  // namespace casimir
