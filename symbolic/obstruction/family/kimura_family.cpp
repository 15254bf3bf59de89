#include "symbolic/obstruction/family/kimura_family.hpp"

#include <cln/integer.h>
#include <cln/rational.h>
#include <fmt/format.h>

#include <set>

#include "symbolic/algebra/number_text.hpp"
#include "symbolic/obstruction/equation/kimura.hpp"
#include "symbolic/obstruction/equation/kovacic.hpp"
#include "symbolic/obstruction/equation/lame.hpp"

namespace casimir::obstruction {
namespace {

using cln::cl_RA;

/// More integers than this in one condition are not tried.
constexpr long kLargestInteger = 2000;

/// An integer that is at least the root of a number that is not negative.
long root_bound(const cl_RA& square) {
  cln::cl_I root;
  cln::isqrt(cln::ceiling1(square), &root);
  if (root > kLargestInteger) throw NotDecided("differences of exponents above 2000");
  return cln::cl_I_to_long(root) + 1;
}

bool vanishes(const RationalFunction& f, const RealRoot& c) { return c.is_root_of(f.numerator()); }

/// The square at c, if its root is a rational number with a denominator up to 5, else empty. Such a
/// root is j/60 for an integer j, and an interval shorter than the distance of their squares has at
/// most one of them.
std::optional<cl_RA> simple_square(const RationalFunction& square, const RealRoot& c) {
  const RationalInterval value = c.value(square, cl_RA(1) / 20000);
  if (cln::minusp(value.high)) return std::nullopt;
  cln::cl_I j;
  cln::isqrt(cln::ceiling1(value.high * 3600), &j);
  for (const int step : {-1, 0, 1}) {
    const cl_RA root = cl_RA(j + step) / 60;
    if (vanishes(square - RationalFunction(root * root), c)) return root * root;
  }
  return std::nullopt;
}

/// Of an irrational c.
std::optional<std::string> kimura_condition(const RiemannFamily& family, const RealRoot& c) {
  if (family.lame) {
    const auto square = simple_square(family.squares[2], c);
    return square ? lame_class(*square) : std::nullopt;
  }
  long bound = 0;
  std::array<std::optional<cl_RA>, 3> simple;
  for (std::size_t i = 0; i < 3; ++i) {
    const RationalInterval value = c.value(family.squares[i], 1);
    if (!cln::minusp(value.high)) bound += root_bound(value.high);
    simple[i] = simple_square(family.squares[i], c);
  }
  for (long m = 1; m <= bound; m += 2)
    if (vanishes(product_of_sums(m, family.squares), c))
      return fmt::format("a sum of the differences is the odd integer {}", m);
  const auto is_half = [](const std::optional<cl_RA>& square) {
    return square && cln::denominator(*square_root(*square)) == 2;
  };
  if (is_half(simple[0]) + is_half(simple[1]) + is_half(simple[2]) >= 2)
    return "Schwarz's list, row 1";
  if (simple[0] && simple[1] && simple[2]) return kimura({*simple[0], *simple[1], *simple[2]});
  return std::nullopt;
}

}  // namespace

RationalFunction product_of_sums(long m, const std::array<RationalFunction, 3>& squares) {
  const RationalFunction n(cl_RA(m * m)), &d = squares[0];
  const RationalFunction sum = squares[1] + squares[2], difference = squares[1] - squares[2];
  // X^2 - 2 X sum + difference^2 with X = (m + s1)^2, as even + odd*s1.
  const RationalFunction own = n + d, two(2), four(4);
  const RationalFunction even =
      own * own + four * n * d - two * own * sum + difference * difference;
  const RationalFunction odd = RationalFunction(cl_RA(4 * m)) * (own - sum);
  return even * even - odd * odd * d;
}

KimuraAt kimura_at(const RiemannFamily& family, const RealRoot& c) {
  for (const Univariate& condition : family.conditions.polynomials())
    if (c.is_root_of(condition)) return {};
  KimuraAt result;
  result.known = true;
  std::optional<std::string> condition;
  if (const auto number = c.rational()) {
    SquaredDifferences squares;
    for (std::size_t i = 0; i < 3; ++i)
      squares[i] =
          family.squares[i].numerator().at(*number) / family.squares[i].denominator().at(*number);
    condition = family.lame ? lame_class(squares[2]) : kimura(squares);
  } else {
    condition = kimura_condition(family, c);
  }
  result.solvable = condition.has_value();
  result.condition = condition.value_or("none of the conditions holds");
  return result;
}

std::string Cell::text(const std::string& name) const {
  if (!low && !high) return "every real " + name;
  if (!low) return fmt::format("{} < {}", name, high->text(name));
  if (!high) return fmt::format("{} > {}", name, low->text(name));
  return fmt::format("{} < {} < {}", low->text(name), name, high->text(name));
}

namespace {

/// The limit of the size of a function at an end of a cell, from above; empty: infinite.
std::optional<cl_RA> bound_at(const RationalFunction& f, const std::optional<RealRoot>& end) {
  if (end) {
    if (end->is_root_of(f.denominator())) return std::nullopt;
    const RationalInterval value = end->value(f, 1);
    const cl_RA low = cln::abs(value.low), high = cln::abs(value.high);
    return low > high ? low : high;
  }
  const long order = f.numerator().degree() - f.denominator().degree();
  if (order > 0) return std::nullopt;
  return order < 0 ? cl_RA(0) : cl_RA(cln::abs(f.numerator().leading()));
}

/// One difference of exponents on a cell.
struct Difference {
  RationalFunction square;
  bool constant = false, real = true;
  std::optional<long> bound;  ///< of a real one
};

std::array<Difference, 3> differences_on(const RiemannFamily& family, const Cell& cell) {
  std::array<Difference, 3> result;
  for (std::size_t i = 0; i < 3; ++i) {
    const RationalFunction& square = family.squares[i];
    Difference& own = result[i];
    own.square = square;
    own.constant = square.is_constant();
    own.real =
        !cln::minusp(square.numerator().at(cell.inside) / square.denominator().at(cell.inside));
    const auto low = bound_at(square, cell.low), high = bound_at(square, cell.high);
    if (low && high) own.bound = root_bound(*low > *high ? *low : *high);
  }
  return result;
}

/// Adds the numerator of a function that has to vanish.
void add(const RationalFunction& f, std::vector<Univariate>& result) {
  if (f.is_zero()) throw NotDecided("all members of the family are solvable");
  if (!f.numerator().is_constant()) result.push_back(f.numerator());
}

/// square = root^2 for each root = (start + step*p)/denominator up to a bound.
void add_squares(const Difference& own, int start, int step, int denominator,
                 std::vector<Univariate>& result) {
  for (long j = start; j <= *own.bound * denominator; j += step) {
    const cl_RA root = cl_RA(j) / denominator;
    add(own.square - RationalFunction(root * root), result);
  }
}

/// c at which a sum with signs is an odd integer. \return  false: may be infinitely many
bool add_odd_sums(const std::array<Difference, 3>& all, const RiemannFamily& family,
                  std::vector<Univariate>& result) {
  std::vector<const Difference*> real, imaginary;
  for (const Difference& own : all) (own.real ? real : imaginary).push_back(&own);
  if (imaginary.size() == 1 || imaginary.size() == 3) return true;
  if (imaginary.size() == 2 && !(imaginary[0]->square == imaginary[1]->square)) {
    add(imaginary[0]->square - imaginary[1]->square, result);
    return true;
  }
  long bound = 0;
  for (const Difference* own : real) {
    if (!own->bound) return false;
    bound += *own->bound;
  }
  for (long m = 1; m <= bound; m += 2) add(product_of_sums(m, family.squares), result);
  return true;
}

bool is_half(const RationalFunction& constant) {
  const auto root = square_root(constant.numerator().coefficient(0));
  return root && cln::denominator(*root) == 2;
}

/// c at which two differences are halves of odd integers.
bool add_two_halves(const std::array<Difference, 3>& all, std::vector<Univariate>& result) {
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = i + 1; j < 3; ++j) {
      bool possible = true;
      const Difference* finite = nullptr;
      for (const Difference* own : {&all[i], &all[j]}) {
        possible = possible && own->real && (!own->constant || is_half(own->square));
        if (!own->constant && own->bound) finite = own;
      }
      if (!possible) continue;
      if (all[i].constant && all[j].constant)
        throw NotDecided("all members of the family are solvable");
      if (finite == nullptr) return false;
      add_squares(*finite, 1, 2, 2, result);
    }
  return true;
}

/// c at which all differences are rational numbers as in the other rows of Schwarz's list.
bool add_rows(const std::array<Difference, 3>& all, std::vector<Univariate>& result) {
  const Difference* finite = nullptr;
  bool constant = true;
  for (const Difference& own : all) {
    if (!own.real) return true;
    if (own.constant) {
      const auto root = square_root(own.square.numerator().coefficient(0));
      if (!root || cln::denominator(*root) > 5 || cln::denominator(*root) == 1) return true;
      continue;
    }
    constant = false;
    if (own.bound) finite = &own;
  }
  if (constant) return true;  // `says_nothing` knows them
  if (finite == nullptr) return false;
  for (const int denominator : {2, 3, 4, 5}) add_squares(*finite, 1, 1, denominator, result);
  return true;
}

}  // namespace

std::optional<std::vector<Univariate>> candidates(const RiemannFamily& family, const Cell& cell) {
  std::vector<Univariate> result;
  const auto all = differences_on(family, cell);
  if (family.lame) {
    const Difference& n = all[2];
    if (!n.real || n.constant) return result;  // `says_nothing` knows the constant ones
    if (!n.bound) return std::nullopt;
    for (const int denominator : {1, 2, 3, 4, 5}) add_squares(n, 0, 1, denominator, result);
    return result;
  }
  const bool sums = add_odd_sums(all, family, result);
  const bool halves = add_two_halves(all, result);
  const bool rows = add_rows(all, result);
  if (!sums || !halves || !rows) return std::nullopt;
  return result;
}

bool says_nothing(const RiemannFamily& family) {
  // Numbers that no condition has in mind.
  for (const long above : {104729, -104729, 1299709, -17, 15485863}) {
    const KimuraAt at = kimura_at(family, RealRoot(cl_RA(above) / 10007));
    if (at.known && !at.solvable) return false;
  }
  return true;
}

namespace {

/// The residues modulo 2, up to signs, that the third difference may have.
std::set<cl_RA> residues(const cl_RA& first, const cl_RA& second) {
  const auto folded = [](cl_RA value) {
    value = value - 2 * cln::floor1(value / 2);
    return value > 1 ? cl_RA(2 - value) : value;
  };
  std::set<cl_RA> tried;
  for (long j = 0; j <= 60; ++j) tried.insert(cl_RA(j) / 60);
  for (const int sign : {1, -1}) tried.insert(folded(1 + first + sign * second));
  std::set<cl_RA> result;
  for (const cl_RA& r : tried)
    if (kimura({first * first, second * second, r * r})) result.insert(r);
  return result;
}

/// The c with (a c + b)/(e c + f) = s^2, as "c = 12/(s^2 - 1/4)".
std::optional<std::string> solved_for_parameter(const RationalFunction& square,
                                                const std::string& name) {
  const Univariate &above = square.numerator(), &below = square.denominator();
  if (above.degree() > 1 || below.degree() > 1) return std::nullopt;
  const auto combination = [](const cl_RA& of_square, const cl_RA& number) {
    return Univariate(std::vector<cl_RA>{number, 0, of_square});
  };
  const RationalFunction result(combination(below.coefficient(0), -above.coefficient(0)),
                                combination(-below.coefficient(1), above.coefficient(1)));
  const auto enclosed = [](const Univariate& p) {
    const std::string text = p.text("s");
    return text.find_first_of(" /") == std::string::npos ? text : "(" + text + ")";
  };
  if (result.denominator().is_constant())
    return fmt::format("{} = {}", name, result.numerator().text("s"));
  return fmt::format("{} = {}/{}", name, enclosed(result.numerator()),
                     enclosed(result.denominator()));
}

}  // namespace

std::string condition_text(const RiemannFamily& family, const std::string& name) {
  const RationalFunction* changing = nullptr;
  std::vector<cl_RA> roots;
  for (const RationalFunction& square : family.squares) {
    if (!square.is_constant()) {
      changing = &square;
      continue;
    }
    const auto root = square_root(square.numerator().coefficient(0));
    if (root) roots.push_back(*root);
  }
  if (roots.size() != 2 || changing == nullptr)
    return fmt::format(
        "a sum of sqrt({}), sqrt({}), sqrt({}) with signs is an odd integer, or they stand in "
        "Schwarz's list",
        family.squares[0].text(name), family.squares[1].text(name), family.squares[2].text(name));
  std::string list;
  if (family.lame) {
    const auto solved = solved_for_parameter(family.squares[2], name);
    return fmt::format("{} with s in Z/2, Z/3, Z/4 or Z/5 (Lame's equation, n = s - 1/2)",
                       solved.value_or(family.squares[2].text(name) + " = s^2"));
  }
  for (const cl_RA& r : residues(roots[0], roots[1]))
    list += (list.empty() ? "" : ", ") + rational_text(r);
  if (list.empty()) return "never";
  if (const auto solved = solved_for_parameter(*changing, name))
    return fmt::format("{} with s = 2*p + r for an integer p and r in {{{}}}", *solved, list);
  return fmt::format("{} = s^2 with s = 2*p + r for an integer p and r in {{{}}}",
                     changing->text(name), list);
}

}  // namespace casimir::obstruction
