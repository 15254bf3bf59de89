#include "tests/adversary/systems.hpp"
#include "tests/adversary/templates.hpp"

namespace casimir::adversary {
namespace {

const Expr x{"x"}, y{"y"}, z{"z"}, w{"w"};

/// Whether what is assumed makes b >= 0: |b| - b is then zero.
Case sign_of_parameter(Random& random) {
  const Expr a{"a"}, b{"b"}, c{"c"};
  struct Choice {
    std::vector<Assumption> assume;
    bool implied;
  };
  const std::vector<Choice> choices{{{{a, ">="}, {a * b, ">="}}, false},
                                    {{{a, ">"}, {a * b, ">="}}, true},
                                    {{{a, ">="}, {a * b, ">"}}, true},
                                    {{{pow(a, 2) * b, ">="}}, false},
                                    {{{pow(a, 2) * b, ">"}}, true},
                                    {{{a * b, ">="}, {a + b, ">"}}, true},
                                    {{{a * b, ">="}, {a + b, ">="}}, true},
                                    {{{a * b, ">="}, {b * c, ">="}, {c, ">="}}, false},
                                    {{{a * b, ">"}, {a * c, ">"}, {c, ">"}}, true},
                                    {{{a * b, ">="}, {a * c, ">="}, {c, ">"}}, false},
                                    {{{b, ">="}}, true},
                                    {{{a - b, ">="}, {a, ">="}}, false},
                                    {{{b - a, ">="}, {a, ">="}}, true},
                                    {{{b - pow(a, 2), ">="}}, true},
                                    {{{b - a, ">="}, {a + 1, ">="}}, false},
                                    {{{a * b * c, ">="}, {a, ">"}, {c, ">="}}, false},
                                    {{{a * b * c, ">="}, {a, ">"}, {c, ">"}}, true},
                                    {{{pow(a, 3) * b, ">="}, {a, ">="}}, false},
                                    {{{b / a, ">="}, {a, ">="}}, true},
                                    {{{a, "!="}, {pow(a, 2) * b, ">="}}, true}};
  const Choice& choice = random.of(choices);
  Case claim;
  claim.family = "parameter-sign";
  claim.system.parameters = {{"a"}, {"b"}, {"c"}};
  for (const Assumption& assumption : choice.assume) {
    const std::size_t owner = contains(assumption.left, "c")   ? 2
                              : contains(assumption.left, "b") ? 1
                                                               : 0;
    claim.system.parameters[owner].assume.push_back(assumption);
  }
  const Expr excess = random.of(std::vector<Expr>{absolute(b) - b, absolute(b) * b - pow(b, 2),
                                                  pow(pow(b, 2), Expr(3, 2)) - pow(b, 3)});
  Known known = free_particle(random);
  claim.system.variables = known.system.variables;
  claim.system.bracket = known.system.bracket;
  claim.system.hamiltonian = known.system.hamiltonian;
  claim.truth = choice.implied ? Truth::yes : Truth::no;
  if (random.one_in(2)) {
    claim.kind = Kind::integral;
    claim.name = "F";
    claim.integrals = {{"F", Expr("p1") + excess * Expr("q1")}};
  } else {
    claim.kind = Kind::identity;
    claim.identities = {{excess * Expr("q1"), 0}};
  }
  return claim;
}

/// A function that is real only where y > 0, or y >= 0, and conserved where y and w are.
Expr only_positive(Random& random) {
  return random.of(std::vector<Expr>{log(y * w) - log(w), sqrt(y * w) / sqrt(w), sqrt(y), log(y),
                                     pow(y, Expr(1, 3)), sqrt(pow(y, 3)), sqrt(w) * sqrt(y / w),
                                     sqrt(w * y) * sqrt(1 / w), log(y / w) + log(w),
                                     sqrt(y * exp(w)) + w, log(pow(y, 3)), pow(y, Expr(3, 2)),
                                     asin(sqrt(y) / 10), log(y * w) * sqrt(w - 5) * 0 + log(y)});
}

/// What is true where all functions are real, since a root or a logarithm in it says y > 0.
Case implied_domain(Random& random) {
  Case claim;
  claim.family = "implied-domain";
  System& s = claim.system;
  s.variables = {"y", "w", "z"};
  const Expr implied = only_positive(random), excess = absolute(y) - y;
  const bool right = random.one_in(3) ? random.one_in(2) : true;
  const Expr defect = right ? excess : absolute(y) - small_number(random) - y;
  claim.truth = right ? Truth::yes : Truth::no;
  claim.by_oracle = !right;
  s.equations = {0, 0, 1};
  const int choice = random(3);
  if (choice == 0) {
    claim.kind = Kind::integral;
    claim.name = "F";
    claim.integrals = {{"F", implied + defect * z}};
  } else if (choice == 1) {
    claim.kind = Kind::integral;
    claim.name = "F";
    claim.integrals = {{"F", implied * (1 + defect * z)}};
  } else {
    claim.kind = Kind::identity;
    claim.identities = {{implied * absolute(y) + (right ? Expr(0) : Expr(1)), implied * y}};
  }
  return claim;
}

/// Any claim with a term in it that is real nowhere, or with assumptions that exclude each other.
Case empty_domain(Random& random) {
  const Template inner = random.of(identity_templates());
  Case claim = inner(random);
  while (claim.kind != Kind::integral && claim.kind != Kind::identity &&
         claim.kind != Kind::casimir)
    claim = random.of(identity_templates())(random);
  claim.family = "empty-domain";
  claim.truth = Truth::nothing;
  claim.by_oracle = false;
  const Expr v{claim.system.variables.front()};
  const Expr u{claim.system.variables.back()};
  const std::vector<Expr> unreal{sqrt(-1 - pow(v, 2)),
                                 log(-exp(v)),
                                 asin(2 + pow(v, 2)),
                                 sqrt(-exp(u)),
                                 log(-pow(v, 2) - pow(u, 2)),
                                 sqrt(sin(v) - 2),
                                 acos(-3 + cos(u)),
                                 sqrt(-2 - pow(v, 4)),
                                 log(-1 - absolute(u)),
                                 sqrt(v) * sqrt(-1 - v),
                                 log(u) * log(-u),
                                 sqrt(-pow(v, 2) - 1 + v)};
  Expr& f = claim.kind == Kind::integral  ? claim.integrals.front().value
            : claim.kind == Kind::casimir ? claim.casimirs.front().value
                                          : claim.identities.front().left;
  const Expr s = random.of(unreal);
  switch (random(5)) {
    case 0:
      f = f + s * (absolute(v) - v);
      break;
    case 1:
      f = random.one_in(2) || f.is_number() ? s : f * s;  // 0*s is 0, which has a domain
      break;
    case 2:
      f = f + s;
      break;
    case 3:
      claim.system.domain.push_back({v, ">"});
      claim.system.domain.push_back({v, "<"});
      break;
    default:
      claim.system.domain.push_back(
          {random.of(std::vector<Expr>{-1 - pow(v, 2), -exp(u), cos(v) - 2}),
           random.one_in(2) ? ">" : ">="});
  }
  return claim;
}

/// Rules for roots and logarithms where no point makes them real.
Case both_signs(Random& random) {
  Case claim;
  claim.kind = Kind::identity;
  claim.family = "empty-domain";
  claim.truth = Truth::nothing;
  claim.system.variables = {"x", "y", "z"};
  claim.system.equations = {1, 0, y};
  const Atoms atoms{{x, y, z}};
  const Expr v = random.of(atoms.reals);
  const Expr p = positive_expression(random, atoms) + pow(v, 2);
  const Expr r = positive_expression(random, atoms) + exp(v);
  const std::vector<IdentityClaim> choices{
      {log(-x), log(x)},
      {log(-p), log(p)},
      {(absolute(p) + p) * sqrt(-p), 0},
      {sqrt(-v) * sqrt(v - 1), sqrt(v - pow(v, 2))},
      {log(v - 2) + log(1 - v), log((v - 2) * (1 - v))},
      {sqrt(-p) * sqrt(-r), sqrt(p * r)},
      {pow(sqrt(-p), 2), -p},
      {log(-p) + log(-r), log(p * r)},
      {asin(1 + p) + acos(1 + p), Expr::pi() / 2},
      {exp(log(-p)), -p},
      {sqrt(v) * sqrt(-p - v), sqrt(-v * (p + v))},
      {sqrt(-pow(v, 2) - p), sqrt(-p - pow(v, 2)) * 1},
      {log(v) * absolute(v) * log(-v - p), v * log(v) * log(-v - p)},
      {cos(acos(2 + pow(v, 2))), 2 + pow(v, 2)}};
  claim.identities = {random.of(choices)};
  return claim;
}

/// With I in a claim roots and logarithms have complex values, and rules for real ones fail.
Case complex_claim(Random& random) {
  const Expr i = Expr::imaginary();
  struct Choice {
    Expr left, right;
    bool equal;
  };
  const std::vector<Choice> choices{
      {sqrt(1 / x), 1 / sqrt(x), false},
      {sqrt(pow(log(x), 2) * y), sqrt(pow(log(x), 2)) * sqrt(y), false},
      {sqrt(x) * sqrt(y), sqrt(x * y), false},
      {log(x * y), log(x) + log(y), false},
      {log(1 / x), -log(x), false},
      {sqrt(pow(sqrt(x), 2)), sqrt(x), true},
      {pow(sqrt(x), 2), x, true},
      {exp(log(x)), x, true},
      {sqrt(pow(x, 2)) * sqrt(pow(x, 2)), pow(x, 2), true},
      {exp(i * x), cos(x) + i * sin(x), true},
      {(x + i * y) * (x - i * y), pow(x, 2) + pow(y, 2), true},
      {sqrt(-1 - pow(x, 2)), i * sqrt(1 + pow(x, 2)), true},
      {sqrt(-x), i * sqrt(x), false},
      {pow(pow(x, 3), Expr(1, 3)), x, false},
      {log(pow(x, 2)), 2 * log(x), false},
      {sqrt(pow(x, 2) * y), sqrt(pow(x, 2)) * sqrt(y), true},
      {pow(x, Expr(1, 2)) * pow(x, Expr(1, 3)), pow(x, Expr(5, 6)), true},
      {log(exp(2 * i * x)), 2 * i * x, false},
      {sqrt(exp(2 * i * x)), exp(i * x), false},
      {sqrt(x / y), sqrt(x) / sqrt(y), false},
      {sqrt(1 / exp(x)), exp(-x / 2), true},
      {sqrt(sqrt(x)), pow(x, Expr(1, 4)), true}};
  const Choice& c = random.of(choices);
  Case claim;
  claim.family = "complex";
  claim.truth = c.equal ? Truth::yes : Truth::no;
  claim.system.variables = {"x", "y", "z"};
  claim.system.equations = {0, 0, 1};
  const Expr factor = random.one_in(2) ? i : i * small_number(random) + 1;
  if (random.one_in(2)) {
    claim.kind = Kind::identity;
    claim.identities = {{factor * c.left, factor * c.right}};
  } else {
    claim.kind = Kind::integral;
    claim.name = "F";
    claim.integrals = {{"F", x + z * factor * (c.left - c.right)}};
  }
  return claim;
}

/// A domain that is met on a set without inner points only: x^2*y >= 0 at x = 0, y < 0.
Case thin_domain(Random& random) {
  Case claim;
  claim.kind = Kind::identity;
  claim.family = "thin-domain";
  claim.system.variables = {"x", "y", "z"};
  claim.system.equations = {0, 0, 1};
  struct Choice {
    Expr left;
    std::string relation;
    bool implied;
  };
  const std::vector<Choice> choices{
      {pow(x, 2) * y, ">=", false},      {pow(x, 2) * y, ">", true},
      {pow(x, 4) * y, ">=", false},      {(1 + pow(x, 2)) * y, ">=", true},
      {exp(x) * y, ">=", true},          {pow(x, 3) * y, ">=", false},
      {absolute(x) * y, ">=", false},    {(1 - cos(x)) * y, ">=", false},
      {pow(sin(x), 2) * y, ">=", false}, {y / pow(x, 2), ">=", true}};
  const Choice& c = random.of(choices);
  claim.system.domain = {{c.left, c.relation}};
  claim.truth = c.implied ? Truth::yes : Truth::no;
  claim.pieces = {{}, {{"x", 0}}};
  const Expr excess = (absolute(y) - y) * z;
  if (random.one_in(2)) {
    claim.identities = {{excess + z, z}};
  } else {
    claim.kind = Kind::integral;
    claim.name = "F";
    claim.integrals = {{"F", x + excess}};
  }
  return claim;
}

/// dy/dt = R(y) with a root in R, and F(y) with dF/dt = 1: along F - t a solution that rests where
/// R vanishes is no constant. So the claim is false, but true where y is elsewhere.
Case rest_point(Random& random) {
  struct Choice {
    Expr rate;
    std::vector<Expr> clocks;
    std::vector<long> rests;
  };
  const Expr y1 = 1 + y;
  const std::vector<Choice> choices{
      {2 * sqrt(y), {sqrt(y)}, {0}},
      {3 * pow(y, Expr(2, 3)), {pow(y, Expr(1, 3))}, {0}},
      {4 * pow(y, Expr(3, 4)), {pow(y, Expr(1, 4)), sqrt(sqrt(y))}, {0}},
      {-2 * sqrt(y * (1 - y)),
       {asin(sqrt(1 - y)), acos(sqrt(y)), atan2(sqrt(1 - y), sqrt(y)), acos(2 * y - 1) / 2},
       {0, 1}},
      {sqrt(1 - pow(y, 2)),
       {asin(y), -acos(y), atan2(y, sqrt(1 - pow(y, 2))), 2 * asin(sqrt((1 + y) / 2))},
       {1, -1}},
      {y * sqrt(log(y)), {2 * sqrt(log(y))}, {1}},
      {sqrt(exp(y) - 1), {2 * atan(sqrt(exp(y) - 1))}, {0}},
      {2 * y * sqrt(y - 1), {acos(1 / sqrt(y)), atan(sqrt(y - 1))}, {1}},
      {2 * sqrt(y) * y1,
       {atan(sqrt(y)), atan2(sqrt(y), 1), asin(sqrt(y / y1)), acos(1 / sqrt(y1))},
       {0}},
      {2 * sqrt(y) * (1 + sqrt(y)), {2 * log(1 + sqrt(y))}, {0}}};
  const Choice& c = random.of(choices);
  const Expr change = random.of(c.clocks) - x;
  Case claim;
  claim.family = "rest-point";
  claim.kind = Kind::integral;
  claim.name = "F";
  claim.system.variables = {"x", "y"};
  claim.system.equations = {1, c.rate};
  claim.integrals = {
      {"F", random.of(std::vector<Expr>{change, pow(change, 2), exp(change), sin(change)})}};
  claim.truth = Truth::no;
  claim.orbit = Substitution{{"x", Expr("s")}, {"y", random.of(c.rests)}};
  return claim;
}

}  // namespace

const std::vector<Template>& domain_templates() {
  static const std::vector<Template> all{sign_of_parameter, sign_of_parameter, implied_domain,
                                         empty_domain,      both_signs,        complex_claim,
                                         complex_claim,     thin_domain,       rest_point};
  return all;
}

}  // namespace casimir::adversary
