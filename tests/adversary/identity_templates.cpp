#include "tests/adversary/systems.hpp"
#include "tests/adversary/templates.hpp"

namespace casimir::adversary {
namespace {

Equal random_equality(Random& random) {
  const int choice = random(20);
  return choice < 11 ? Equal::everywhere : choice < 15 ? Equal::partly : Equal::nowhere;
}

/// A disguise and what a claim becomes by it. That a random change breaks a claim is left to the
/// oracle: it might touch a coefficient of what is zero anyhow.
Disguise put_on(Case& claim, Random& random, const Atoms& atoms) {
  const Disguise d = disguise(random, atoms, random_equality(random));
  claim.family = d.family;
  claim.truth = d.equal == Equal::everywhere ? Truth::yes : Truth::no;
  claim.by_oracle = d.equal != Equal::everywhere;
  return d;
}

Case integral(Random& random) {
  Known known = random_system(random);
  Case claim;
  claim.kind = Kind::integral;
  const Disguise d = put_on(claim, random, known.atoms);
  const Expr base = combination(random, known.integrals);
  Expr f = base + monomial(random, known.moving) * d.difference();
  if (random.one_in(4))
    f = base + random.of(known.moving) * d.left - random.of(known.moving) * d.right;
  if (!f.is_number() && random.one_in(5) && known.system.bracket != Bracket::none) {
    // In the Hamiltonian instead.
    known.system.hamiltonian =
        known.system.hamiltonian + monomial(random, known.moving) * d.difference();
    f = base;
  } else if (claim.truth == Truth::yes) {
    claim.by_oracle = true;
  }
  claim.system = known.system;
  claim.name = "F";
  claim.integrals = {{"F", f}};
  return claim;
}

Case casimir_function(Random& random) {
  Known known = random_poisson_system(random);
  Case claim;
  claim.kind = Kind::casimir;
  const Disguise d = put_on(claim, random, known.atoms);
  const Expr base =
      known.casimirs.empty() ? small_number(random) : combination(random, known.casimirs);
  claim.casimirs = {{"C", base + monomial(random, known.atoms.reals) * d.difference()}};
  claim.system = known.system;
  claim.name = "C";
  return claim;
}

Case jacobi(Random& random) {
  Known known = gradient_bracket(random);
  Case claim;
  claim.kind = Kind::jacobi;
  const Disguise d = put_on(claim, random, known.atoms);
  const std::vector<std::pair<std::size_t, std::size_t>> places{{0, 1}, {0, 2}, {1, 2}};
  Expr& entry = known.system.entries[random.of(places)];
  entry = entry + monomial(random, known.atoms.reals) * d.difference();
  claim.system = known.system;
  return claim;
}

Case identity(Random& random) {
  Known known = random_system(random);
  Case claim;
  claim.kind = Kind::identity;
  const Disguise d = put_on(claim, random, known.atoms);
  const Expr factor = random.one_in(2) ? Expr(1) : monomial(random, known.moving);
  const Expr more = random.one_in(2) ? Expr(0) : combination(random, known.integrals);
  claim.identities = {{more + factor * d.left, factor * d.right + more}};
  claim.system = known.system;
  return claim;
}

/// A disguise inside of the arguments of another: v and what equals v in a function.
Case nested_identity(Random& random) {
  Known known = random_system(random);
  Case claim;
  claim.kind = Kind::identity;
  const Disguise inner = put_on(claim, random, known.atoms);
  const Expr w = monomial(random, known.atoms.reals);
  const Expr a = inner.left + w, b = inner.right + w;
  switch (random(6)) {
    case 0:
      claim.identities = {{sin(a), 2 * sin(b / 2) * cos(b / 2)}};
      break;
    case 1:
      claim.identities = {{cos(a), 2 * pow(cos(b / 2), 2) - 1}};
      break;
    case 2:
      claim.identities = {{exp(a), pow(exp(b / 2), 2)}};
      break;
    case 3:
      claim.identities = {{sqrt(1 + pow(a, 2)), sqrt(1 + pow(b, 2))}};
      break;
    case 4:
      claim.identities = {{atan(a), 2 * atan(b / (1 + sqrt(1 + pow(b, 2))))}};
      break;
    default:
      claim.identities = {{pow(a, 2) - pow(b, 2), 0}};
  }
  claim.system = known.system;
  return claim;
}

Case measure(Random& random) {
  Case claim;
  claim.kind = Kind::measure;
  Known known = random.one_in(2) ? nambu(random) : gradient_bracket(random);
  const Disguise d = put_on(claim, random, known.atoms);
  const Expr change = monomial(random, known.moving) * d.difference();
  if (random.one_in(5)) {
    // A density that is zero is no measure.
    claim.measures = {{change, false}};
    if (d.equal == Equal::everywhere) claim.truth = Truth::nothing;
    claim.by_oracle = claim.truth != Truth::nothing;
  } else if (known.system.bracket == Bracket::none) {
    claim.measures = {{known.casimirs.front() + change, false}};
  } else {
    // mu * grad C has the density 1/mu for every H, by which the entries are multiplied here.
    claim.measures = {{1 + change, random.one_in(2)}};
    claim.by_oracle = true;
  }
  claim.system = known.system;
  return claim;
}

Case lax(Random& random) {
  Case claim;
  claim.kind = Kind::lax;
  System& s = claim.system;
  s.variables = {"q", "p"};
  s.bracket = Bracket::canonical;
  const Expr q{"q"}, p{"p"};
  s.hamiltonian = (pow(p, 2) + pow(q, 2)) / 2;
  Atoms atoms{{q, p}};
  Expr factor = 1;
  Lax pair;
  if (random.one_in(2)) {
    pair.spectral = "lambda";
    factor = Expr(std::string("lambda"));
    if (random.one_in(3)) factor = pow(factor, 2);
  }
  const Disguise d = put_on(claim, random, atoms);
  const Expr change = monomial(random, {q, p}) * d.difference();
  pair.l = {{p, q * factor}, {q / factor, -p}};
  pair.a = {{0, factor / 2}, {-1 / (2 * factor), 0}};
  Expr& entry =
      (random.one_in(2)
           ? pair.l
           : pair.a)[static_cast<std::size_t>(random(2))][static_cast<std::size_t>(random(2))];
  entry = entry + change;
  claim.lax = {pair};
  return claim;
}

/// Two pairs with spectral parameters of one name, of which the second is false.
Case two_lax_pairs(Random& random) {
  Case claim = lax(random);
  const Expr lambda{"lambda"}, q{"q"}, p{"p"};
  claim.lax.front().spectral = "lambda";
  Lax constant;
  constant.l = {{1, 0}, {0, 1}};
  constant.a = {{q, p}, {p, pow(q, 3)}};
  claim.lax.insert(claim.lax.begin(), constant);
  return claim;
}

Case map(Random& random) {
  Case claim;
  claim.kind = Kind::map;
  Known known = free_particle(random);
  System& s = known.system;
  const Expr x1{"q1"}, x2{"q2"}, y1{"p1"}, y2{"p2"};
  known.atoms.reals = {x1, x2, y1, y2};
  const Disguise d = put_on(claim, random, known.atoms);
  const Expr change = monomial(random, known.atoms.reals) * d.difference();
  Map m;
  if (random.one_in(2)) {
    // A shear by a gradient is canonical.
    m.target.variables = {"u1", "u2", "v1", "v2"};
    m.target.bracket = Bracket::canonical;
    const Expr c = small_number(random);
    m.expressions = {x1, x2, y1 + c * x2 + cos(x1), y2 + c * x1};
    if (random.one_in(2)) {
      m.sign = -1;
      m.expressions = {m.expressions[2], m.expressions[3], x1, x2};
    }
  } else {
    // Quadratic functions of one pair are so(2,1) in the numbers of this bracket.
    m.target.variables = {"u", "v", "w"};
    m.target.bracket = Bracket::brackets;
    const Expr u{"u"}, v{"v"}, w{"w"};
    m.target.entries[{0, 1}] = 4 * w;
    m.target.entries[{0, 2}] = 2 * u;
    m.target.entries[{1, 2}] = -(2 * v);
    m.expressions = {pow(x1, 2), pow(y1, 2), x1 * y1};
  }
  Expr& changed =
      m.expressions[static_cast<std::size_t>(random(static_cast<int>(m.expressions.size())))];
  changed = changed + change;
  claim.maps = {m};
  claim.system = s;
  return claim;
}

Case involution(Random& random) {
  Known known = free_particle(random);
  Case claim;
  claim.kind = Kind::involution;
  known.atoms.reals = {Expr("q1"), Expr("p1"), Expr("p2")};
  const Disguise d = put_on(claim, random, known.atoms);
  const Expr change = monomial(random, known.atoms.reals) * d.difference();
  claim.integrals = {{"F", combination(random, known.integrals)},
                     {"G", combination(random, known.integrals) + change}};
  claim.system = known.system;
  return claim;
}

/// x = 0 where dx/dt is a multiple of x, but for a disguise.
Case invariant_relation(Random& random) {
  Case claim;
  claim.kind = Kind::invariant_relation;
  System& s = claim.system;
  s.variables = {"x", "y", "z"};
  const Expr x{"x"}, y{"y"}, z{"z"};
  const Disguise d = put_on(claim, random, {{y, z}});
  s.equations = {pow(x, random.between(1, 2)) * monomial(random, {y, z}) +
                     monomial(random, {y, z}) * d.difference(),
                 small_number(random) + x, y};
  claim.invariant_relations = {{"R", x * (1 + pow(y, 2)), {}}};
  claim.pieces = {{{"x", Expr(0)}}};
  return claim;
}

}  // namespace

const std::vector<Template>& identity_templates() {
  static const std::vector<Template> all{
      integral, integral,      integral,        casimir_function,  jacobi,
      identity, identity,      nested_identity, measure,           lax,
      map,      two_lax_pairs, involution,      invariant_relation};
  return all;
}

}  // namespace casimir::adversary
