#include "tests/adversary/systems.hpp"
#include "tests/adversary/templates.hpp"

namespace casimir::adversary {
namespace {

const Expr x{"x"}, y{"y"}, z{"z"};

Case on_level(Kind kind, const std::string& family, const Expr& f, const std::vector<Expr>& on) {
  Case claim;
  claim.kind = kind;
  claim.family = family;
  claim.system.variables = {"x", "y", "z"};
  if (kind == Kind::conditional) claim.conditionals = {{"C", f, on}};
  if (kind == Kind::invariant_relation) claim.invariant_relations = {{"R", f, on}};
  return claim;
}

/// A function of x and a real place where it vanishes, if it does.
struct Lead {
  Expr function;
  std::vector<Expr> zeros;
};

Lead lead(Random& random) {
  const std::vector<Lead> vanish{{x, {0}},
                                 {sin(x), {0, Expr::pi()}},
                                 {sqrt(x), {0}},
                                 {log(x), {1}},
                                 {cos(x) - 1, {0, 2 * Expr::pi()}},
                                 {absolute(x), {0}},
                                 {exp(x) - 1, {0}},
                                 {atan(x), {0}},
                                 {atan2(x, 1), {0}},
                                 {pow(x, 2), {0}},
                                 {x - 1, {1}},
                                 {pow(x, 2) - 2, {sqrt(Expr(2)), -sqrt(Expr(2))}},
                                 {sqrt(1 + x) - 1, {0}},
                                 {asin(x / 4), {0}},
                                 {tan(x), {0, Expr::pi()}},
                                 {pow(x, Expr(1, 3)), {0}},
                                 {cos(x), {Expr::pi() / 2}},
                                 {x * sin(x), {0, Expr::pi()}},
                                 {sin(x) - x, {0}}};
  const std::vector<Lead> never{{pow(x, 2) + 1, {}},     {exp(x), {}},
                                {2 + sin(x), {}},        {cos(x) - 2, {}},
                                {pow(x, 2) + x + 1, {}}, {sqrt(1 + pow(x, 2)), {}},
                                {1 + acos(x / 4), {}},   {1 + absolute(x), {}},
                                {sqrt(x) + 1, {}}};
  return random.one_in(3) ? random.of(never) : random.of(vanish);
}

/// x and y rest, z moves with y: z is an integral on y = 0, and not where the lead A(x) of the
/// level A(x)*y vanishes. In other coordinates Y = y - f(x), Z = z - g(x, y).
Case leading_function(Random& random) {
  const Lead a = lead(random);
  const bool bent = random.one_in(2);
  const Expr shift = bent ? small_number(random) * pow(x, 2) : Expr(0);
  const Expr lift = bent ? small_number(random) * x * y : Expr(0);
  const Expr old_y = y + shift;
  Case claim = on_level(Kind::conditional, "level-lead", z + lift,
                        {random.one_in(2) ? a.function * old_y : old_y * a.function});
  claim.system.equations = {0, 0, old_y * random.of(std::vector<Expr>{1, exp(x), 1 + pow(y, 2)})};
  claim.pieces = {{{"y", -shift}}};
  for (const Expr& zero : a.zeros) claim.pieces.push_back({{"x", zero}});
  claim.truth = a.zeros.empty() ? Truth::yes : Truth::no;
  if (random.one_in(4)) {
    claim.system.domain = {{x, ">"}};
    const bool still = a.zeros.size() > 1 || (!a.zeros.empty() && !a.zeros.front().is(0));
    claim.truth = still ? Truth::no : Truth::yes;
    std::vector<Substitution> kept;
    for (const Substitution& piece : claim.pieces) {
      const auto it = piece.find("x");
      if (it == piece.end() || !it->second.is(0)) kept.push_back(piece);
    }
    claim.pieces = kept;
  }
  return claim;
}

/// The level a*x, which is everything where a = 0.
Case leading_parameter(Random& random) {
  const Expr a{"a"}, b{"b"};
  struct Choice {
    Expr lead;
    std::vector<Assumption> assume;
    bool vanishes;
    Substitution where;
  };
  const std::vector<Choice> choices{{a, {}, true, {{"a", 0}}},
                                    {a, {{a, ">="}}, true, {{"a", 0}}},
                                    {a, {{a, "!="}}, false, {}},
                                    {a, {{a, ">"}}, false, {}},
                                    {a - b, {}, true, {{"a", b}}},
                                    {a * b, {{a, "!="}}, true, {{"b", 0}}},
                                    {a * b, {{a, ">"}, {b, "!="}}, false, {}},
                                    {pow(a, 2) - 1, {}, true, {{"a", 1}}},
                                    {pow(a, 2) + 1, {}, false, {}},
                                    {pow(a, 2) + pow(b, 2), {}, true, {{"a", 0}, {"b", 0}}},
                                    {pow(a, 2) + pow(b, 2), {{b, "!="}}, false, {}},
                                    {sin(a), {{a, ">"}}, true, {{"a", Expr::pi()}}},
                                    {a + absolute(a), {{a, ">"}}, false, {}},
                                    {a + absolute(a), {{a, "!="}}, true, {{"a", -1}}},
                                    {exp(a) - exp(b), {}, true, {{"a", b}}},
                                    {sqrt(a), {}, true, {{"a", 0}}},
                                    {log(a), {{a, ">"}}, true, {{"a", 1}}}};
  const Choice& c = random.of(choices);
  const Kind kind = random.one_in(3) ? Kind::invariant_relation : Kind::conditional;
  Case claim = on_level(kind, "level-parameter", y, {c.lead * x});
  claim.system.parameters = {{"a", {}}, {"b", {}}};
  for (const Assumption& assumption : c.assume)
    claim.system.parameters[contains(assumption.left, "a") ? 0 : 1].assume.push_back(assumption);
  claim.system.equations = {0, x * random.of(std::vector<Expr>{1, 1 + pow(z, 2), exp(x)}), 1};
  claim.truth = c.vanishes ? Truth::no : Truth::yes;
  claim.pieces = {{{"x", 0}}};
  if (kind == Kind::invariant_relation) claim.pieces = {{{"x", 0}, {"y", 0}}};
  if (c.vanishes) {
    claim.pieces.push_back(c.where);
    if (kind == Kind::invariant_relation) claim.pieces.back().emplace("y", 0);
  }
  return claim;
}

/// dx/dt = x and y' = R(x) on x = 0: whether R(0) is 0, with roots and quotients in R and in what
/// is added to y, of which the rate vanishes on the level although it has a denominator.
Case root_on_level(Random& random) {
  struct Choice {
    Expr rate, more;
    bool vanishes;
  };
  const std::vector<Choice> choices{{1, pow(x, Expr(3, 2)), false},
                                    {1, pow(x, 2), false},
                                    {1, sqrt(x), false},
                                    {1 + sqrt(x), x * sqrt(x), false},
                                    {sqrt(x), pow(x, Expr(3, 2)), true},
                                    {x, pow(x, Expr(5, 2)), true},
                                    {cos(x), pow(x, Expr(5, 2)), false},
                                    {pow(x, Expr(1, 3)), pow(x, Expr(4, 3)), true},
                                    {sin(x), x * absolute(x), true},
                                    {1 + absolute(x), x * absolute(x), false},
                                    {absolute(x), 0, true},
                                    {exp(x), pow(x, Expr(7, 3)), false},
                                    {exp(sqrt(x)) - 1, x, true}};
  const Choice& c = random.of(choices);
  Case claim = on_level(Kind::conditional, "level-root", y + small_number(random) * c.more, {x});
  claim.system.equations = {x * random.of(std::vector<Expr>{1, 1 + pow(z, 2)}),
                            small_number(random) * c.rate, 0};
  claim.truth = c.vanishes ? Truth::yes : Truth::no;
  claim.pieces = {{{"x", 0}}};
  return claim;
}

/// dy/dt = y^r starts on y = 0 and leaves it if r < 1.
Case not_lipschitz(Random& random) {
  const std::vector<std::pair<Expr, bool>> powers{{Expr(1, 2), false}, {Expr(2, 3), false},
                                                  {Expr(1, 3), false}, {Expr(3, 2), true},
                                                  {Expr(5, 3), true},  {Expr(2), true}};
  const auto& [r, unique] = random.of(powers);
  const Kind kind = random.one_in(2) ? Kind::invariant_relation : Kind::conditional;
  Case claim = on_level(kind, "level-unique", kind == Kind::conditional ? z : y,
                        kind == Kind::conditional ? std::vector<Expr>{y} : std::vector<Expr>{});
  claim.system.equations = {
      1,
      r.is(2)                                                                    ? pow(y, 2)
      : r.node().numerator == 1 && random.one_in(2) && r.node().denominator == 2 ? sqrt(y)
                                                                                 : pow(y, r),
      0};
  claim.truth = unique ? Truth::yes : Truth::no;
  claim.pieces = {{{"y", 0}}};
  if (!unique) {
    // y = ((1 - r) s)^(1/(1 - r))
    const Node& n = r.node();
    const long numerator = n.denominator - n.numerator;
    const Expr s{"s"};
    claim.orbit =
        Substitution{{"x", s},
                     {"y", pow(Expr(numerator, n.denominator) * s, Expr(n.denominator, numerator))},
                     {"z", 0}};
  }
  return claim;
}

/// A domain that says nothing on the level, since its inequality holds there trivially.
Case trivial_domain(Random& random) {
  struct Choice {
    Expr left;
    std::string relation;
    Truth truth;
  };
  const std::vector<Choice> choices{{pow(x, 2) * y, ">=", Truth::no},
                                    {x * y, ">=", Truth::no},
                                    {x * y * (1 + pow(z, 2)), ">=", Truth::no},
                                    {absolute(x) * y, ">=", Truth::no},
                                    {sin(x) * y, ">=", Truth::no},
                                    {y, ">=", Truth::yes},
                                    {y, ">", Truth::yes},
                                    {y + pow(x, 2), ">=", Truth::yes},
                                    {(1 + pow(x, 2)) * y, ">=", Truth::yes},
                                    {exp(x) * y, ">", Truth::yes},
                                    {y + 1, ">=", Truth::no},
                                    {pow(x, 2) * y, ">", Truth::nothing},
                                    {x, ">", Truth::nothing}};
  const Choice& c = random.of(choices);
  Case claim = on_level(Kind::conditional, "level-sign", z, {x});
  claim.system.domain = {{c.left, c.relation}};
  claim.system.equations = {0, 0,
                            (absolute(y) - y) * random.of(std::vector<Expr>{1, 1 + pow(x, 2)})};
  claim.truth = c.truth;
  claim.pieces = {{{"x", 0}}};
  return claim;
}

/// Levels whose real points are few: q^2 + p^2 = 0 is one point, and there the claim holds or not.
Case real_level(Random& random) {
  const std::vector<Expr> sums{pow(x, 2) + pow(y, 2),     pow(x, 2) + 2 * pow(y, 2),
                               pow(x, 4) + pow(y, 2),     pow(x, 2) + x * y + pow(y, 2),
                               absolute(x) + absolute(y), pow(x, 2) + 1 - cos(y) + pow(y, 2)};
  const bool vanishes = random.one_in(2);
  const Expr rate = vanishes ? random.of(std::vector<Expr>{x, x * y, sin(y), pow(x, 2)})
                             : random.of(std::vector<Expr>{1 + x, cos(y), z});
  Case claim = on_level(Kind::conditional, "level-real", z, {random.of(sums)});
  claim.system.equations = {0, 0, rate};
  claim.truth = vanishes ? Truth::yes : Truth::no;
  claim.pieces = {{{"x", 0}, {"y", 0}}};
  return claim;
}

/// Half a turn between two angles is lost or won where x passes the pole of an argument.
Case half_turn(Random& random) {
  const Expr quarter = Expr::pi() / 2;
  const std::vector<Expr> angles{atan(x) + atan(1 / x) - quarter,
                                 atan2(1 / x, 1) + atan(x) - quarter, atan2(1, 1 / x) - atan(x),
                                 x / absolute(x) - 1,
                                 atan(2 * x) + asin(1 / sqrt(1 + 4 * pow(x, 2))) - quarter};
  const bool stays = random.one_in(2);
  const std::size_t which = static_cast<std::size_t>(random.between(0, 4));
  Case claim = on_level(Kind::invariant_relation, "level-half-turn", angles[which], {});
  const Expr rate = stays ? x * random.of(std::vector<Expr>{1, 1 + pow(y, 2)}) : Expr(-1);
  const bool moves = random.one_in(2);
  claim.system.equations = {rate, 0, moves ? y : Expr(0)};
  claim.truth = stays ? Truth::yes : Truth::no;
  claim.pieces = {{{"x", absolute(x)}}};
  const Expr s{"s"};
  if (!stays)
    claim.orbit = Substitution{{"x", Expr(1, 3) - s}, {"y", 1}, {"z", moves ? s : Expr(0)}};
  return claim;
}

/// The level |x| = x is a half line, which a rotation leaves and a growth does not.
Case half_space(Random& random) {
  const bool stays = random.one_in(2);
  const Expr excess = absolute(x) - x;
  Case claim = on_level(Kind::conditional, "level-half-space", z, {excess * random.between(1, 2)});
  if (stays) {
    claim.system.equations = {x * random.of(std::vector<Expr>{1, 1 + pow(y, 2)}), 1, excess};
    claim.duration = 0.5;
  } else {
    const Expr k = random.between(1, 2);
    claim.system.equations = {k * y, -k * x, excess};
    claim.duration = 5;
  }
  claim.truth = stays ? Truth::yes : Truth::no;
  claim.pieces = {{{"x", absolute(x)}}};
  return claim;
}

/// The square of what defines a level: x^2 = 0 is left where x is, though its rate vanishes there.
Case squared_level(Random& random) {
  const bool stays = random.one_in(2);
  const Expr power = pow(x, random.between(2, 3));
  const Expr f = random.of(std::vector<Expr>{power, power * (1 + pow(y, 2)), 1 - cos(x) + pow(x, 2),
                                             power * y});  // 1 - cos(x) alone is zero at 2*Pi, too
  const bool whole = contains(f, "y") && f.node().arguments.back().node().op == Op::symbol;
  Case claim = on_level(Kind::invariant_relation, "level-squared", f, {});
  claim.system.equations = {(stays ? x : Expr(1)) * random.of(std::vector<Expr>{1, exp(z)}), y * z,
                            0};
  claim.truth = stays ? Truth::yes : Truth::no;
  claim.pieces = {{{"x", 0}}};
  if (whole) claim.pieces.push_back({{"y", 0}});
  return claim;
}

/// Two levels at once, of which a product hides a part.
Case two_levels(Random& random) {
  // x*y = 0 and x*z = 0: x = 0, or y = z = 0.
  Case claim = on_level(Kind::conditional, "level-parts", Expr("w"), {x * y, x * z});
  claim.system.variables.emplace_back("w");
  const int choice = random(3);
  const Expr rate = choice == 0 ? x * y + z * x : choice == 1 ? y + z : x;
  claim.system.equations = {0, 0, 0, rate};
  claim.truth = choice == 0 ? Truth::yes : Truth::no;
  claim.pieces = {{{"x", 0}}, {{"y", 0}, {"z", 0}}};
  return claim;
}

/// The identity of two functions on a level that has several parts.
Case identity_on_level(Random& random) {
  const Lead a = lead(random);
  Case claim;
  claim.kind = Kind::identity;
  claim.family = "level-lead";
  claim.system.variables = {"x", "y", "z"};
  claim.system.equations = {1, 0, y};
  claim.identities = {{y * monomial(random, {z, 1 + x}) + z, z, {a.function * y}}};
  claim.pieces = {{{"y", 0}}};
  for (const Expr& zero : a.zeros) claim.pieces.push_back({{"x", zero}});
  claim.truth = a.zeros.empty() ? Truth::yes : Truth::no;
  return claim;
}

}  // namespace

const std::vector<Template>& level_templates() {
  static const std::vector<Template> all{leading_function, leading_function, leading_parameter,
                                         root_on_level,    not_lipschitz,    trivial_domain,
                                         real_level,       half_turn,        half_space,
                                         squared_level,    two_levels,       identity_on_level};
  return all;
}

}  // namespace casimir::adversary
