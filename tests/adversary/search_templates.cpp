#include "tests/adversary/search_case.hpp"
#include "tests/adversary/systems.hpp"

namespace casimir::adversary {
namespace {

const Expr x{"x"}, y{"y"}, z{"z"}, t{"t"}, n{"n"};
const Expr q1{"q1"}, q2{"q2"}, p1{"p1"}, p2{"p2"};

SearchCase canonical(const std::string& family, const Expr& hamiltonian) {
  SearchCase s;
  s.base.family = family;
  s.base.system.variables = {"q1", "q2", "p1", "p2"};
  s.base.system.bracket = Bracket::canonical;
  s.base.system.hamiltonian = hamiltonian;
  return s;
}

SearchCase equations(const std::string& family, const std::vector<Expr>& rates) {
  SearchCase s;
  s.base.family = family;
  const std::vector<std::string> names{"x", "y", "z"};
  s.base.system.variables.assign(names.begin(), names.begin() + static_cast<long>(rates.size()));
  s.base.system.equations = rates;
  return s;
}

/// A potential that depends on q1 alone, though nobody sees it.
SearchCase disguised_potential(Random& random) {
  const Disguise d = true_identity(random, {{q1, q2}});
  Expr potential = q1 * small_number(random) + monomial(random, {q1, q2}) * d.difference();
  if (random.one_in(3))
    potential = sqrt(pow(q1, 2) + pow(q2, 2)) * (2 * pow(cos(atan2(q2, q1) / 2), 2) - 1);
  SearchCase s = canonical("search-identity", (pow(p1, 2) + pow(p2, 2)) / 2 + potential);
  s.degree = random.between(1, 2);
  s.specials = {{{}, p2}};
  return s;
}

/// A rate that is zero in disguise.
SearchCase disguised_rate(Random& random) {
  const Disguise d = true_identity(random, {{x, z}});
  SearchCase s =
      equations("search-identity", {1, monomial(random, {x, y}) * d.difference(), y * x});
  s.degree = 1;
  s.specials = {{{}, y}};
  return s;
}

/// On x^2 + y^2 = 0 the function z is an integral, for real points; on x*y = 0 on both parts.
SearchCase on_level(Random& random) {
  struct Choice {
    Expr level, rate;
    std::vector<Substitution> pieces;
  };
  const std::vector<Choice> choices{
      {pow(x, 2) + pow(y, 2), x, {{{"x", 0}, {"y", 0}}}},
      {pow(x, 2) + 3 * pow(y, 2), y - x, {{{"x", 0}, {"y", 0}}}},
      {x * y, x * y, {{{"x", 0}}, {{"y", 0}}}},
      {pow(x, 2), x, {{{"x", 0}}}},
      {pow(x, 2) - pow(y, 2), pow(x, 2) - pow(y, 2), {{{"x", y}}, {{"x", -y}}}},
      {x, x, {{{"x", 0}}}},
      {pow(x, 2) + x * y + pow(y, 2), x + 2 * y, {{{"x", 0}, {"y", 0}}}}};
  const Choice& c = random.of(choices);
  const Expr k = random.between(1, 3);
  SearchCase s = equations("search-level", {k * x, k * y, c.rate * z});
  s.base.kind = Kind::conditional;
  s.base.conditionals = {{"G", z, {c.level}}};
  s.base.pieces = c.pieces;
  s.specials = {{{}, z}};
  return s;
}

/// An integral that is a product of a variable with a function that the user names.
SearchCase named_function(Random& random) {
  const long k = random.between(1, 5);
  if (random.one_in(2)) {
    SearchCase s = equations("search-function", {Expr(-k) * x, x});
    s.base.system.time = "t";
    s.functions = {exp(k * t)};
    s.degree = 2;
    s.specials = {{{}, x * s.functions.front()}};
    return s;
  }
  const Expr power(random.between(1, 3), random.between(2, 5));
  SearchCase s = equations("search-function", {1, -power / x * y});
  s.functions = {pow(x, power)};
  s.degree = random.between(2, 3);
  s.specials = {{{}, y * s.functions.front()}};
  return s;
}

/// y' = f(n*x) - f(k*x), which is zero at n = k.
SearchCase parameter_in_function(Random& random) {
  const long k = random.between(1, 3);
  const std::vector<std::pair<Expr, Expr>> sides{{exp(n * x), exp(k * x)},
                                                 {cos(n * x), cos(k * x)},
                                                 {sin(n * x), sin(k * x)},
                                                 {atan(n * x), atan(k * x)},
                                                 {n * x, k * x},
                                                 {pow(x, n), pow(x, k)},
                                                 {sqrt(n + pow(x, 2)), sqrt(k + pow(x, 2))},
                                                 {log(n + pow(x, 2)), log(k + pow(x, 2))},
                                                 {1 / (n + pow(x, 2)), 1 / (k + pow(x, 2))},
                                                 {exp(x + n) * exp(-x), exp(Expr(k))}};
  const auto& [left, right] = random.of(sides);
  const Expr factor = random.one_in(2) ? Expr(1) : small_number(random) + x;
  SearchCase s = equations("free-function", {1, factor * (left - right)});
  s.base.system.parameters = {{"n"}};
  s.free = {"n"};
  s.specials = {{{{"n", Expr(k)}}, y}};
  return s;
}

/// A central potential r^(2 m), which is the oscillator's for m = 1.
SearchCase parameter_in_exponent(Random& random) {
  const Expr square = pow(q1, 2) + pow(q2, 2);
  const long shift = random.between(-1, 1);
  const bool twice = random.one_in(2);
  const Expr exponent = twice ? 2 * n + shift : n + shift;
  SearchCase s = canonical("free-exponent", (pow(p1, 2) + pow(p2, 2)) / 2 + pow(square, exponent));
  s.base.system.parameters = {{"n"}};
  s.free = {"n"};
  s.degree = 2;
  s.specials = {{{{"n", Expr(1 - shift, twice ? 2 : 1)}}, pow(p1, 2) / 2 + pow(q1, 2)}};
  return s;
}

/// {a, e} = a, {b, e} = d*b: at d = -k the function a^k*b is a new Casimir function.
SearchCase new_casimir(Random& random) {
  SearchCase s;
  s.base.family = "free-casimir";
  System& system = s.base.system;
  system.variables = {"a", "b", "c", "e"};
  system.bracket = random.one_in(2) ? Bracket::brackets : Bracket::structure_constants;
  const Expr a{"a"}, b{"b"}, c{"c"}, d{"d"}, e{"e"};
  const long k = random.between(1, 2);
  system.entries[{0, 3}] = a;
  system.entries[{1, 3}] = d * b;
  system.entries[{2, 3}] = c;
  system.hamiltonian = a + e;
  system.parameters = {{"d"}};
  s.free = {"d"};
  s.degree = static_cast<int>(k) + 1;
  s.specials = {{{{"d", Expr(-k)}}, pow(a, k) * b}};
  return s;
}

/// Two conditions at once: oscillators that are isotropic, and the integrable Henon-Heiles system.
SearchCase two_conditions(Random& random) {
  const Expr a{"A"}, b{"B"}, d{"d"};
  const Expr kinetic = (pow(p1, 2) + pow(p2, 2)) / 2,
             quadratic = (a * pow(q1, 2) + b * pow(q2, 2)) / 2;
  const bool cubic = random.one_in(2);
  SearchCase s =
      cubic ? canonical("free-set", kinetic + quadratic + pow(q1, 2) * q2 + d * pow(q2, 3) / 3)
            : canonical("free-set", kinetic + quadratic + d * q1 * q2);
  s.base.system.parameters = {{"A"}, {"B"}, {"d"}};
  s.free = {"A", "B", "d"};
  s.degree = cubic ? 3 : 2;
  s.specials = cubic ? std::vector<Special>{{{{"A", b}, {"d", 1}},
                                             pow(q1, 3) + 3 * q1 * q2 * (q2 + b) + 3 * p1 * p2}}
                     : std::vector<Special>{{{{"A", b}, {"d", 0}}, q1 * p2 - q2 * p1}};
  return s;
}

/// Lagrange's top among those with a body-fixed axis in a plane.
SearchCase lagrange(Random& random) {
  SearchCase s;
  s.base.family = "free-set";
  System& system = s.base.system;
  system.variables = {"M1", "M2", "M3", "g1", "g2", "g3"};
  system.bracket = Bracket::e3;
  const Expr m1{"M1"}, m2{"M2"}, m3{"M3"}, a{"a"}, r{"r"}, c{"c"};
  system.hamiltonian =
      (pow(m1, 2) + a * pow(m2, 2) + c * pow(m3, 2)) / 2 + r * Expr("g1") + Expr("g3");
  system.parameters = {{"a"}, {"r"}, {"c"}};
  s.free = random.one_in(2) ? std::vector<std::string>{"a", "r"}
                            : std::vector<std::string>{"a", "r", "c"};
  s.specials = {{{{"a", 1}, {"r", 0}}, m3}};
  return s;
}

}  // namespace

std::string SearchCase::text() const {
  std::string command = "# search --degree " + std::to_string(degree);
  for (const Expr& f : functions) command += " --functions \"" + f.text() + "\"";
  for (const OnLevel& level : base.conditionals) {
    for (const Expr& f : level.on) command += " --on \"" + f.text() + "\"";
  }
  for (std::size_t i = 0; i < free.size(); ++i) command += (i == 0 ? " --free " : ",") + free[i];
  command += "\n# there is";
  for (const Special& s : specials) {
    command += " " + s.function.text();
    for (const auto& [name, value] : s.values) command += " at " + name + " = " + value.text();
  }
  Case plain = base;
  plain.conditionals.clear();
  return command + "\n" + plain.text();
}

const std::vector<SearchTemplate>& search_templates() {
  static const std::vector<SearchTemplate> all{disguised_potential, disguised_rate, on_level,
                                               named_function};
  return all;
}

const std::vector<SearchTemplate>& free_templates() {
  static const std::vector<SearchTemplate> all{parameter_in_function, parameter_in_exponent,
                                               new_casimir, two_conditions, lagrange};
  return all;
}

}  // namespace casimir::adversary
