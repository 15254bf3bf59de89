#include "tests/adversary/systems.hpp"

namespace casimir::adversary {
namespace {

Expr symbol(const std::string& name) { return Expr(name); }

std::vector<Expr> symbols(const std::vector<std::string>& names) {
  std::vector<Expr> result;
  for (const std::string& name : names) result.push_back(symbol(name));
  return result;
}

Known canonical(std::size_t pairs) {
  Known known;
  for (const char* letter : {"q", "p"}) {
    for (std::size_t i = 1; i <= pairs; ++i)
      known.system.variables.push_back(letter + (pairs > 1 ? std::to_string(i) : ""));
  }
  known.system.bracket = Bracket::canonical;
  known.atoms.reals = symbols(known.system.variables);
  return known;
}

void add_parameter(Known& known, const std::string& name, const std::string& relation) {
  Parameter p{name};
  if (!relation.empty()) p.assume.push_back({symbol(name), relation});
  known.system.parameters.push_back(p);
  (relation == ">" ? known.atoms.positives : known.atoms.reals).push_back(symbol(name));
}

const Expr q1{"q1"}, q2{"q2"}, p1{"p1"}, p2{"p2"};

Known central(Random& random) {
  Known known = canonical(2);
  const Expr square = pow(q1, 2) + pow(q2, 2);
  const std::vector<Expr> potentials{square,      pow(square, 2), sqrt(square),
                                     log(square), exp(-square),   1 / sqrt(square)};
  known.system.hamiltonian =
      (pow(p1, 2) + pow(p2, 2)) / 2 + small_number(random) * random.of(potentials);
  known.integrals = {q1 * p2 - q2 * p1};
  known.moving = {q1, q2, p1, p2};
  return known;
}

Known oscillators(Random& random) {
  Known known = canonical(2);
  add_parameter(known, "a", random.one_in(2) ? ">" : "");
  const Expr a = symbol("a");
  const Expr first = pow(p1, 2) + a * pow(q1, 2), second = pow(p2, 2) + pow(q2, 4);
  known.system.hamiltonian = first / 2 + small_number(random) * second;
  known.integrals = {first, second};
  known.moving = {q1, q2, p1, p2, a * q1};
  return known;
}

/// One degree of freedom in a potential with a function or a symbolic exponent.
Known one_dimensional(Random& random) {
  Known known = canonical(1);
  const Expr q = symbol("q"), p = symbol("p");
  Expr potential = random.of(std::vector<Expr>{cos(q), exp(q), pow(q, 4), log(1 + pow(q, 2))});
  if (random.one_in(3)) {
    add_parameter(known, "n", "");
    known.system.domain.push_back({q, ">"});
    known.atoms = {{p}, {q}};
    potential = pow(q, symbol("n"));
  }
  known.system.hamiltonian = pow(p, 2) / 2 + potential;
  known.integrals = {known.system.hamiltonian};
  known.moving = {q, p};
  return known;
}

Known body(Random& random) {
  Known known;
  known.system.variables = {"M1", "M2", "M3"};
  known.system.bracket = Bracket::so3;
  known.atoms.reals = symbols(known.system.variables);
  const std::vector<Expr>& m = known.atoms.reals;
  known.system.hamiltonian = (pow(m[0], 2) + 2 * pow(m[1], 2) +
                              small_number(random) * m[2] * random.of(m) + 5 * pow(m[2], 2)) /
                             2;
  known.casimirs = {pow(m[0], 2) + pow(m[1], 2) + pow(m[2], 2)};
  known.integrals = {known.system.hamiltonian, known.casimirs.front()};
  known.moving = m;
  return known;
}

Known lagrange_top(Random& random) {
  Known known;
  known.system.variables = {"M1", "M2", "M3", "g1", "g2", "g3"};
  known.system.bracket = Bracket::e3;
  known.atoms.reals = symbols(known.system.variables);
  add_parameter(known, "c", ">");
  const std::vector<Expr>& x = known.atoms.reals;
  known.system.hamiltonian =
      (pow(x[0], 2) + pow(x[1], 2) + symbol("c") * pow(x[2], 2)) / 2 + small_number(random) * x[5];
  known.casimirs = {x[0] * x[3] + x[1] * x[4] + x[2] * x[5],
                    pow(x[3], 2) + pow(x[4], 2) + pow(x[5], 2)};
  known.integrals = {x[2], known.casimirs[0], known.casimirs[1]};
  known.moving = {x[0], x[1], x[3], x[4]};
  return known;
}

/// The algebra {x, z} = x, {y, z} = a*y with the Casimir function y*x^(-a).
Known solvable(Random& random) {
  Known known;
  System& s = known.system;
  s.variables = {"x", "y", "z"};
  s.bracket = Bracket::structure_constants;
  s.domain = {{symbol("x"), ">"}, {symbol("y"), ">"}};
  const Expr x = symbol("x"), y = symbol("y"), z = symbol("z");
  Expr a = random.between(2, 3);
  known.atoms = {{z}, {x, y}};
  if (random.one_in(2)) {
    add_parameter(known, "a", "");
    a = symbol("a");
  }
  s.entries[{0, 2}] = x;
  s.entries[{1, 2}] = a * y;
  s.hamiltonian = small_number(random) * z + x;
  known.casimirs = {y * pow(x, -a)};
  known.integrals = {s.hamiltonian, known.casimirs.front()};
  known.moving = {x, y, z};
  return known;
}

/// dx/dt = a x, dy/dt = -b y, with integrals that depend on the time.
Known growth(Random& random) {
  Known known;
  System& s = known.system;
  s.variables = {"x", "y"};
  s.time = "t";
  const Expr x = symbol("x"), y = symbol("y"), t = symbol("t");
  add_parameter(known, "a", "");
  const Expr a = symbol("a"), b = small_number(random);
  s.equations = {a * x, -b * y};
  known.integrals = {x * exp(-a * t), y * exp(b * t)};
  known.atoms.reals = {x, y, t, a};
  known.moving = {x, y, t};
  return known;
}

}  // namespace

Known free_particle(Random& random) {
  Known known = canonical(2);
  known.system.hamiltonian = pow(p1, 2) * small_number(random);
  known.integrals = {p1, p2};
  known.atoms.reals = {p1, p2};
  known.moving = {q1};
  return known;
}

Known gradient_bracket(Random& random) {
  Known known;
  System& s = known.system;
  s.variables = {"x", "y", "z"};
  s.bracket = Bracket::brackets;
  const Expr x = symbol("x"), y = symbol("y"), z = symbol("z");
  known.atoms.reals = {x, y, z};
  const Expr mu = random.one_in(2) ? Expr(1) : positive_expression(random, known.atoms);
  // C = c1 x^2 + y^k + f(z), whose gradient is written down.
  const Expr c1 = small_number(random);
  const bool bent = random.one_in(2);
  const Expr f = bent ? sin(z) : pow(z, 2), slope = bent ? cos(z) : 2 * z;
  const long k = random.between(1, 3);
  s.entries[{0, 1}] = mu * slope;
  s.entries[{0, 2}] = -(mu * k * pow(y, k - 1));
  s.entries[{1, 2}] = mu * 2 * c1 * x;
  s.hamiltonian = random.of(known.atoms.reals) * random.of(known.atoms.reals) + y;
  known.casimirs = {c1 * pow(x, 2) + pow(y, k) + f};
  known.integrals = {s.hamiltonian, known.casimirs.front()};
  known.moving = known.atoms.reals;
  return known;
}

Known nambu(Random& random) {
  Known known;
  System& s = known.system;
  s.variables = {"x", "y", "z"};
  const Expr x = symbol("x"), y = symbol("y"), z = symbol("z");
  known.atoms.reals = {x, y, z};
  const Expr mu = random.one_in(2) ? Expr(1) : positive_expression(random, known.atoms);
  const Expr c = small_number(random), d = small_number(random);
  // A = x^2 + c y^2 + z, B = d x y + z^2.
  const std::vector<Expr> a{2 * x, 2 * c * y, 1}, b{d * y, d * x, 2 * z};
  s.equations = {mu * (a[1] * b[2] - a[2] * b[1]), mu * (a[2] * b[0] - a[0] * b[2]),
                 mu * (a[0] * b[1] - a[1] * b[0])};
  known.integrals = {pow(x, 2) + c * pow(y, 2) + z, d * x * y + pow(z, 2)};
  known.moving = {x, y, z};
  known.casimirs = {1 / mu};  // the density
  return known;
}

Known random_poisson_system(Random& random) {
  switch (random(9)) {
    case 0:
      return central(random);
    case 1:
      return oscillators(random);
    case 2:
      return one_dimensional(random);
    case 3:
      return body(random);
    case 4:
      return random.one_in(2) ? lagrange_top(random) : body(random);
    case 5:
      return solvable(random);
    case 6:
      return free_particle(random);
    default:
      return gradient_bracket(random);
  }
}

Known random_system(Random& random) {
  switch (random(5)) {
    case 0: {
      Known known = nambu(random);
      known.casimirs.clear();
      return known;
    }
    case 1:
      return growth(random);
    default:
      return random_poisson_system(random);
  }
}

Expr combination(Random& random, const std::vector<Expr>& integrals) {
  Expr sum = small_number(random) * random.of(integrals);
  for (int count = random(3); count > 0; --count) sum = sum + monomial(random, integrals);
  switch (random(6)) {
    case 0:
      return sin(sum);
    case 1:
      return exp(sum / 8);
    case 2:
      return sqrt(1 + pow(sum, 2));
    default:
      return sum;
  }
}

}  // namespace casimir::adversary
