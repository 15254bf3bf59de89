#include "symbolic/proof/thin_domain.hpp"

namespace casimir {

std::optional<std::string> thin_domain(Prover& prover) {
  // Polynomials and quotients have values at almost all points, whatever has cancelled in them.
  const bool everywhere = prover.ring().is_polynomial();
  if (everywhere && prover.model().assumptions.empty()) return std::nullopt;
  const std::vector<GiNaC::ex> functions = everywhere ? std::vector<GiNaC::ex>{} : prover.domain();
  if (prover.real_points().has_inner_point(functions)) return std::nullopt;
  return everywhere ? "no point was found at which all assumptions hold and none of them with "
                      "equality: they may leave special values only"
                    : "no point was found with real values of all functions around it at which the "
                      "assumptions hold, none of them with equality: there may be special values "
                      "only";
}

}  // namespace casimir
