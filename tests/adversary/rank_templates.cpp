#include "tests/adversary/systems.hpp"
#include "tests/adversary/templates.hpp"

namespace casimir::adversary {
namespace {

/// What makes functions independent, or only seem to: zero everywhere, on a part, or nowhere.
Disguise difference_of(Case& claim, Random& random, const Atoms& atoms) {
  const std::vector<Equal> kinds{Equal::everywhere, Equal::everywhere, Equal::partly,
                                 Equal::nowhere};
  const Disguise d = disguise(random, atoms, random.of(kinds));
  claim.family = d.family;
  claim.truth = d.equal == Equal::nowhere ? Truth::yes : Truth::no;
  claim.by_oracle = d.equal != Equal::everywhere;
  claim.integrable = true;
  return d;
}

/// A function of H, and the same with something more that may be zero.
Case independence(Random& random) {
  Case claim;
  claim.kind = Kind::independence;
  const Known known = free_particle(random);
  const Disguise d = difference_of(claim, random, known.atoms);
  const Expr h = pow(Expr("p1"), 2);
  const std::vector<Expr> functions{h, pow(h, 2) + h, cos(h), exp(h / 4), sqrt(1 + h)};
  claim.integrals = {
      {"F", random.of(functions) + monomial(random, known.integrals) * d.difference()}};
  claim.system = known.system;
  return claim;
}

/// The same where Casimir functions and the bracket are less simple.
Case independence_of_casimirs(Random& random) {
  Case claim;
  claim.kind = Kind::independence;
  Known known = gradient_bracket(random);
  const Disguise d = difference_of(claim, random, known.atoms);
  const Expr c = known.casimirs.front();
  claim.casimirs = {{"C", c}};
  claim.integrals = {{"F", random.of(std::vector<Expr>{c * known.system.hamiltonian, pow(c, 2),
                                                       sin(known.system.hamiltonian)}) +
                               monomial(random, known.moving) * d.difference()}};
  claim.system = known.system;
  return claim;
}

/// Liouville's count on two or three pairs: the second integral is the first, or none.
Case liouville(Random& random) {
  Case claim;
  claim.kind = Kind::liouville;
  const Known known = free_particle(random);
  const Disguise d = difference_of(claim, random, known.atoms);
  const Expr p1{"p1"}, p2{"p2"};
  const Expr base = random.one_in(2) ? Expr(0) : p1 * small_number(random);
  claim.integrals = {{"F", base + monomial(random, {p1, p2}) * d.difference()}};
  claim.system = known.system;
  return claim;
}

/// Both sides of an identity as two integrals, so that nothing is added to nothing.
Case liouville_by_sides(Random& random) {
  Case claim;
  claim.kind = Kind::liouville;
  System& s = claim.system;
  s.variables = {"q1", "q2", "q3", "p1", "p2", "p3"};
  s.bracket = Bracket::canonical;
  const Expr p1{"p1"}, p2{"p2"}, p3{"p3"};
  s.hamiltonian = pow(p1, 2) + pow(p2, 2) + small_number(random) * pow(p3, 2);
  const Disguise d = difference_of(claim, random, {{p1, p2}});
  const Expr w = random.of(std::vector<Expr>{p3, p1 * p3, p3 + 1});
  claim.integrals = {{"F1", w * d.left}, {"F2", w * d.right}};
  claim.by_oracle = true;
  return claim;
}

/// A bracket that is zero, somewhere, or not.
Case rank(Random& random) {
  Case claim;
  claim.kind = Kind::rank;
  Known known = gradient_bracket(random);
  System& s = known.system;
  if (random.one_in(2)) {
    s.variables = {"x", "y"};
    s.entries.clear();
    s.entries[{0, 1}] = 1;
    s.hamiltonian = Expr("x");
    known.casimirs.clear();
    known.atoms.reals = {Expr("x"), Expr("y")};
  }
  const Disguise d = difference_of(claim, random, known.atoms);
  const Expr factor = monomial(random, known.atoms.reals) * d.difference();
  for (auto& [place, entry] : s.entries) entry = factor * entry;
  // Of a bracket that is zero everywhere, rank 0 is true; the number is what counts.
  claim.truth = d.equal == Equal::partly ? Truth::no : Truth::yes;
  for (const Expr& c : known.casimirs) claim.casimirs.push_back({"C", c});
  claim.system = s;
  return claim;
}

/// sqrt(p^2) + p and the like: zero for one sign.
Case one_sign(Random& random) {
  Case claim;
  claim.kind = random.one_in(2) ? Kind::liouville : Kind::independence;
  claim.family = "absolute-value";
  claim.integrable = true;
  const Known known = free_particle(random);
  claim.system = known.system;
  const Expr p1{"p1"}, p2{"p2"};
  const Expr v = small_number(random) * p2 + (random.one_in(2) ? Expr(0) : p1);
  const bool restricted = random.one_in(2);
  if (restricted) claim.system.domain = {{v, ">"}};
  claim.truth = restricted ? Truth::yes : Truth::no;
  claim.integrals = {{"F", (absolute(v) + v) * random.of(std::vector<Expr>{1, p1, exp(p1)})}};
  return claim;
}

}  // namespace

const std::vector<Template>& rank_templates() {
  static const std::vector<Template> all{
      independence, independence_of_casimirs, liouville, liouville_by_sides, rank, one_sign};
  return all;
}

}  // namespace casimir::adversary
