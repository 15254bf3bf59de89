// When a numerator that reduces to zero shows that a function is zero.
#include <algorithm>

#include "symbolic/proof/prover.hpp"

namespace casimir {

bool Prover::is_zero(const Polynomial& p) {
  if (p.is_zero() || ring_.is_polynomial()) return ring_.reduced(p).is_zero();
  // What the relations reduce to zero has the numerator zero, but not the other way round.
  return ring_.numerator(p).is_zero() &&
         (has_no_zero_divisors({{p}}) || ring_.reduced(p).is_zero());
}

namespace {

/// Nonzero elements of a field of meromorphic functions divide nothing but zero to zero; nor does a
/// root or an absolute value of what does not, since its power would.
bool is_regular(const FunctionRing& ring, const Polynomial& p) {
  const FunctionRing::Pieces pieces = ring.pieces({p});
  if (pieces.rigid && pieces.switches.empty()) return true;
  for (const auto& [f, exponent] : p.factors()) {
    if (f.is_constant()) continue;
    const FunctionRing::Pieces own = ring.pieces({f});
    if (own.rigid && own.switches.empty()) continue;
    std::size_t place = ring.symbols().size();
    while (place < ring.end_of_generators() && !(f == ring.ring().variable(place))) ++place;
    if (place == ring.end_of_generators()) return false;
    const FunctionRing::Origin origin = ring.origin(place);
    const bool power = origin.kind == FunctionRing::Origin::Kind::root ||
                       origin.kind == FunctionRing::Origin::Kind::absolute;
    if (!power || !is_regular(ring, origin.argument)) return false;
  }
  return true;
}

}  // namespace

bool Prover::has_no_zero_divisors(const std::vector<std::vector<Polynomial>>& rows) {
  if (ring_.is_polynomial()) return true;
  const std::vector<Polynomial> bases = ring_.denominators();
  std::vector<bool> used;
  for (const auto& row : rows) {
    for (const Polynomial& p : row) ring_.mark_denominators(p, used);
  }
  for (std::size_t k = 0; k < used.size(); ++k) {
    if (!used[k]) continue;
    if (is_regular(ring_, bases[k])) continue;
    const auto& divisors = explicit_divisors(Divisors::all);
    const bool divided_by = std::any_of(divisors.begin(), divisors.end(), [&](const auto& d) {
      return d == bases[k] || d == -bases[k];
    });
    if (!divided_by && !ring_.is_nowhere_zero(bases[k])) return false;
  }
  return true;
}

}  // namespace casimir
