#include <algorithm>

#include "tests/adversary/planted_case.hpp"
#include "tests/adversary/systems.hpp"

namespace casimir::adversary {
namespace {

PlantedCase system_of(Kind kind, const std::string& family, std::size_t dimension) {
  PlantedCase result;
  result.base.kind = kind;
  result.base.family = family;
  for (std::size_t i = 1; i <= dimension; ++i)
    result.base.system.variables.push_back("x" + std::to_string(i));
  return result;
}

Expr variable(std::size_t i) { return Expr("x" + std::to_string(i + 1)); }

/// y_i = x_i + c x_j for some i, j and c, a few times: no exponent changes.
void mix(PlantedCase& c, Random& random) {
  System& s = c.base.system;
  const int n = static_cast<int>(s.variables.size());
  for (int times = random(3); times > 0 && n > 1; --times) {
    const int i = random(n), j = (i + random.between(1, n - 1)) % n;
    const Expr factor = random.between(1, 2) * (random.one_in(2) ? 1 : -1);
    const Substitution old{
        {s.variables[static_cast<std::size_t>(i)],
         variable(static_cast<std::size_t>(i)) - factor * variable(static_cast<std::size_t>(j))}};
    Expr& changed = s.equations[static_cast<std::size_t>(i)];
    changed = changed + factor * s.equations[static_cast<std::size_t>(j)];
    for (Expr& rate : s.equations) rate = substitute(rate, old);
    for (Expr& f : c.darboux) f = substitute(f, old);
  }
}

/// u_i' = a_i u_i^(m + 1), and w' = b u_1 w: balances are those with u_i = 0 for some i, but not
/// all. The exponents are -1 where u_i is not zero, 1/m where it is, and 1 - b/a_1 or 1 for w.
PlantedCase decoupled(Random& random) {
  const std::size_t n = static_cast<std::size_t>(random.between(2, 3));
  const bool follows = random.one_in(2);
  const long m = follows ? 1 : random.between(1, 2);
  PlantedCase c = system_of(Kind::exponents, "decoupled", n + (follows ? 1 : 0));
  System& s = c.base.system;
  std::vector<Expr> a;
  for (std::size_t i = 0; i < n; ++i) {
    a.push_back(small_number(random));
    s.equations.push_back(a.back() * pow(variable(i), m + 1));
  }
  Expr b = small_number(random) / 7;  // never a_1, for which w would be arbitrary
  if (follows && random.one_in(2)) {
    s.parameters = {{"b"}};
    b = Expr("b");
  }
  if (follows) s.equations.push_back(b * variable(0) * variable(n));
  for (unsigned set = 1; set < (1U << n); ++set) {
    std::vector<Expr>& own = c.exponents.emplace_back();
    for (std::size_t i = 0; i < n; ++i) own.push_back((set >> i & 1U) != 0 ? Expr(-1) : Expr(1, m));
    if (follows) own.push_back((set & 1U) != 0 ? 1 - b / a[0] : Expr(1));
  }
  mix(c, random);
  return c;
}

/// u' = a v w, v' = b w u, w' = c u v: four balances, each with the exponents -1, 2, 2.
PlantedCase euler(Random& random) {
  PlantedCase c = system_of(Kind::exponents, "euler", 3);
  System& s = c.base.system;
  std::vector<Expr> factors{small_number(random), small_number(random), small_number(random)};
  if (random.one_in(3)) {
    s.parameters = {{"a"}};
    factors[0] = Expr("a");
  }
  for (std::size_t i = 0; i < 3; ++i)
    s.equations.push_back(factors[i] * variable((i + 1) % 3) * variable((i + 2) % 3));
  c.exponents = {{-1, 2, 2}};
  if (random.one_in(2)) mix(c, random);
  return c;
}

/// Any quadratic system: what is reported is checked, and nothing is known.
PlantedCase quadratic(Random& random) {
  PlantedCase c = system_of(Kind::exponents, "quadratic", 2);
  System& s = c.base.system;
  const Expr x = variable(0), y = variable(1);
  for (int i = 0; i < 2; ++i)
    s.equations.push_back(random.between(-2, 2) * pow(x, 2) + random.between(-2, 2) * x * y +
                          small_number(random) * pow(y, 2));
  return c;
}

/// u' = u (p + ..), v' = v (q + ..) has the Darboux polynomials u and v, and v = y - k x^2 bends
/// one.
PlantedCase predators(Random& random) {
  PlantedCase c = system_of(Kind::darboux, "predators", 2);
  System& s = c.base.system;
  const Expr x = variable(0), y = variable(1);
  const long p = random.between(2, 4), q = random.between(5, 9);
  const Expr first = x * (p + random.between(1, 3) * x + random.between(1, 3) * y),
             second = y * (-q + random.between(1, 3) * x + random.between(4, 6) * y);
  const long k = random.one_in(2) ? 0 : random.between(1, 2);
  const Substitution bent{{"x2", y - k * pow(x, 2)}};
  const Expr rate = substitute(first, bent);
  s.equations = {rate, substitute(second, bent) + 2 * k * x * rate};
  c.darboux = {x, y - k * pow(x, 2)};
  c.degree = k == 0 ? random.between(1, 2) : 2;
  if (k == 0) mix(c, random);
  return c;
}

/// x' = y^2, y' = z^2, z' = x^2 has none (Jouanolou), in any linear coordinates.
PlantedCase jouanolou(Random& random) {
  PlantedCase c = system_of(Kind::darboux, "jouanolou", 3);
  for (std::size_t i = 0; i < 3; ++i)
    c.base.system.equations.push_back(pow(variable((i + 1) % 3), 2));
  c.degree = random.between(1, 2);
  if (c.degree == 1 || random.one_in(2)) mix(c, random);
  return c;
}

/// Claims about polynomials alone, and now and then one that is about another function.
PlantedCase certified(Random& random) {
  Known known = random_poisson_system(random);
  PlantedCase c;
  c.base.kind = Kind::certificate;
  c.base.family = "certificate";
  c.base.system = known.system;
  std::size_t number = 0;
  for (const Expr& f : known.casimirs)
    c.base.casimirs.push_back({"C_" + std::to_string(++number), f * small_number(random)});
  for (const Expr& f : known.integrals) {
    c.base.integrals.push_back({"F" + std::to_string(++number), f});
    if (random.one_in(2))
      c.base.integrals.push_back({"_F__" + std::to_string(++number),
                                  monomial(random, known.integrals) + random.between(0, 2)});
  }
  if (random.one_in(3) && !known.integrals.empty()) {
    const Expr& f = random.of(known.integrals);
    c.base.invariant_relations = {{"forall Q, Admitted.", pow(f, 2) * (f - 1), {}}};
  }
  return c;
}

}  // namespace

std::string PlantedCase::text() const {
  std::string command = base.kind == Kind::exponents ? "# exponents\n" : "";
  if (base.kind == Kind::darboux) {
    command = "# search --darboux --degree " + std::to_string(degree) + "\n# there is";
    for (const Expr& f : darboux) command += " " + f.text() + ";";
    command += darboux.empty() ? " nothing\n" : "\n";
  }
  if (base.kind == Kind::certificate) command = "# verify --certificate FILE\n";
  return command + base.text();
}

const std::vector<PlantedTemplate>& exponent_templates() {
  static const std::vector<PlantedTemplate> all{decoupled, euler, quadratic};
  return all;
}

const std::vector<PlantedTemplate>& darboux_templates() {
  static const std::vector<PlantedTemplate> all{predators, jouanolou};
  return all;
}

const std::vector<PlantedTemplate>& certificate_templates() {
  static const std::vector<PlantedTemplate> all{certified};
  return all;
}

}  // namespace casimir::adversary
