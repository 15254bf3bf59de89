#include "tests/adversary/shear.hpp"

#include "tests/adversary/identities.hpp"

namespace casimir::adversary {
namespace {

struct Shear {
  std::string changed, added;
  Expr factor;

  /// The old coordinates by the new ones.
  Expr operator()(const Expr& e) const {
    return substitute(e, {{changed, Expr(changed) - factor * Expr(added)}});
  }
  void apply(std::vector<Expr>& list) const {
    for (Expr& e : list) e = (*this)(e);
  }
  void apply(std::vector<Named>& list) const {
    for (Named& named : list) named.value = (*this)(named.value);
  }
  void apply(std::vector<OnLevel>& list) const {
    for (OnLevel& claim : list) {
      claim.expression = (*this)(claim.expression);
      apply(claim.on);
    }
  }
  /// Points that are given by their old coordinates.
  void move(Substitution& point) const {
    const auto old = [&](const std::string& name) {
      const auto it = point.find(name);
      return it == point.end() ? Expr(name) : it->second;
    };
    point[changed] = old(changed) + factor * old(added);
  }
};

}  // namespace

Case sheared(const Case& claim, Random& random) {
  const System& old = claim.system;
  if (old.bracket != Bracket::none || !old.time.empty() || old.variables.size() < 2) return claim;
  const std::size_t n = old.variables.size();
  const std::size_t i = static_cast<std::size_t>(random(static_cast<int>(n)));
  const std::size_t j =
      (i + static_cast<std::size_t>(random.between(1, static_cast<int>(n) - 1))) % n;
  const Shear shear{old.variables[i], old.variables[j], small_number(random)};
  Case result = claim;
  System& s = result.system;
  s.equations[i] = s.equations[i] + shear.factor * s.equations[j];
  shear.apply(s.equations);
  for (Assumption& a : s.domain) a.left = shear(a.left);
  shear.apply(s.definitions);
  shear.apply(result.casimirs);
  shear.apply(result.integrals);
  shear.apply(result.conditionals);
  shear.apply(result.invariant_relations);
  for (IdentityClaim& identity : result.identities) {
    identity.left = shear(identity.left);
    identity.right = shear(identity.right);
    shear.apply(identity.on);
  }
  for (Measure& m : result.measures) m.density = shear(m.density);
  for (Substitution& piece : result.pieces) {
    if (!piece.empty()) shear.move(piece);
  }
  if (result.orbit) shear.move(*result.orbit);
  return result;
}

}  // namespace casimir::adversary
