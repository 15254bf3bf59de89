#include "tests/adversary/identities.hpp"

#include "tests/adversary/identity_tables.hpp"

namespace casimir::adversary {
namespace {

/// Changes one of the numbers in a tree, chosen by counting down.
Expr with_number_changed(const Expr& e, int& index, Random& random) {
  const Node& n = e.node();
  if (n.op == Op::number) {
    if (index-- != 0) return e;
    const long change = random.one_in(2) ? 1 : -1;
    const bool vanishes = n.numerator + change * n.denominator == 0;
    return Expr(n.numerator + (vanishes ? 2 : 1) * change * n.denominator, n.denominator);
  }
  std::vector<Expr> arguments;
  for (const Expr& argument : n.arguments)
    arguments.push_back(with_number_changed(argument, index, random));
  return n.arguments.empty() ? e : Expr::make(n.op, std::move(arguments), n.name);
}

int numbers_in(const Expr& e) {
  int count = e.is_number() ? 1 : 0;
  for (const Expr& argument : e.node().arguments) count += numbers_in(argument);
  return count;
}

Operands operands(Random& random, const Atoms& atoms) {
  Operands o;
  o.v = real_expression(random, atoms);
  o.w = real_expression(random, atoms);
  o.p = positive_expression(random, atoms);
  o.r = positive_expression(random, atoms);
  const Expr base = random.of(atoms.reals);
  switch (random(4)) {
    case 0:
      o.u = base / sqrt(1 + pow(base, 2));
      break;
    case 1:
      o.u = sin(base) / 2;
      break;
    case 2:
      o.u = base / (1 + pow(base, 2));
      break;
    default:
      o.u = base / 10;
  }
  o.k = random.between(2, 4);
  return o;
}

/// Such as take both signs, and positive ones on both sides of every number, so that a wrong branch
/// is met.
Operands signed_operands(Random& random, const Atoms& atoms) {
  Operands o;
  o.v = random.of(atoms.reals) * small_number(random);
  o.w = random.of(atoms.reals) * small_number(random) + random(2);
  if (random.one_in(3)) o.v = o.v + 1;
  o.p = !atoms.positives.empty() && random.one_in(2) ? random.of(atoms.positives)
                                                     : exp(random.of(atoms.reals));
  return o;
}

Disguise from_rule(const Rule& rule, const Operands& operands, Random& random, Equal equal) {
  auto [left, right] = rule.make(operands);
  if (random.one_in(2)) std::swap(left, right);
  return {rule.family, left, right, equal};
}

/// Another way to write v.
Expr alias(Random& random, const Expr& v) {
  switch (random(5)) {
    case 0:
      return log(exp(v));
    case 1:
      return tan(atan(v));
    case 2:
      return 2 * (v / 2);
    case 3:
      return 3 * v - 2 * v;
    default:
      return pow(pow(v, 3) + 1, Expr(1)) - pow(v, 3) + v - 1;
  }
}

}  // namespace

Expr small_number(Random& random) {
  const int n = random.between(1, 3);
  return random.one_in(4) ? Expr(n, random.between(2, 3)) : Expr(random.one_in(3) ? -n : n);
}

Expr monomial(Random& random, const std::vector<Expr>& factors) {
  Expr result = small_number(random);
  for (int count = random.between(1, 2); count > 0; --count)
    result = result * pow(random.of(factors), random.between(1, 2));
  return result;
}

Expr real_expression(Random& random, const Atoms& atoms) {
  const Expr& x = random.of(atoms.reals);
  const Expr& y = random.of(atoms.reals);
  switch (random(14)) {
    case 0:
      return x + y * small_number(random);
    case 1:
      return x * y;
    case 2:
      return small_number(random) * x + 1;
    case 3:
      return pow(x, 2) - y;
    case 4:
      return atan2(x, y + 1);
    case 5:
      return acos(x / sqrt(pow(x, 2) + pow(y, 2) + 1));
    case 6:
      return x / sqrt(1 + pow(y, 2));
    case 7:
      return alias(random, x);
    case 8:
      return small_number(random) * x;
    case 9:
      return atan2(y, x);
    default:
      return x;
  }
}

Expr positive_expression(Random& random, const Atoms& atoms) {
  if (!atoms.positives.empty() && random.one_in(2)) {
    const Expr& p = random.of(atoms.positives);
    return random.one_in(3) ? p * random.of(atoms.positives) + random(2) : p;
  }
  const Expr& x = random.of(atoms.reals);
  const Expr& y = random.of(atoms.reals);
  switch (random(5)) {
    case 0:
      return exp(x);
    case 1:
      return pow(x, 2) + pow(y, 2) + 1;
    case 2:
      return random.between(2, 5);
    case 3:
      return 2 + sin(x);
    default:
      return 1 + pow(x, 2);
  }
}

Disguise true_identity(Random& random, const Atoms& atoms) {
  return from_rule(random.of(true_rules()), operands(random, atoms), random, Equal::everywhere);
}

Disguise wrong_branch(Random& random, const Atoms& atoms) {
  return from_rule(random.of(branch_rules()), signed_operands(random, atoms), random,
                   Equal::partly);
}

Disguise broken_identity(Random& random, const Atoms& atoms) {
  Disguise result = true_identity(random, atoms);
  result.equal = Equal::nowhere;
  const int count = numbers_in(result.right);
  if (count == 0) {
    result.right = 2 * result.right;
    return result;
  }
  int index = random(count);
  result.right = with_number_changed(result.right, index, random);
  return result;
}

Disguise disguise(Random& random, const Atoms& atoms, Equal equal) {
  switch (equal) {
    case Equal::everywhere:
      return true_identity(random, atoms);
    case Equal::partly:
      return wrong_branch(random, atoms);
    case Equal::nowhere:
      break;
  }
  return broken_identity(random, atoms);
}

}  // namespace casimir::adversary
