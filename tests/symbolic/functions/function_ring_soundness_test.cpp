// What a FunctionRing takes for zero is zero at every point at which it is real: random expressions
// less a rewriting of themselves, by rules of which many hold only for some signs or branches,
// against long double.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <optional>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "symbolic/case/limits.hpp"
#include "symbolic/functions/function_ring.hpp"

namespace casimir {
namespace {

using GiNaC::ex;

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  int operator()(int count) { return std::uniform_int_distribution(0, count - 1)(engine_); }
  long double real() { return std::uniform_real_distribution<long double>(-6, 6)(engine_); }
  const ex& of(const std::vector<ex>& list) { return list[(*this)(static_cast<int>(list.size()))]; }

 private:
  std::mt19937 engine_;
};

using Values = GiNaC::exmap;

long double value_of(const ex& e, const Values& point);

long double plain_value(const ex& e, const Values& point) {
  const auto part = [&](std::size_t i) { return value_of(e.op(i), point); };
  if (GiNaC::is_a<GiNaC::numeric>(e)) {
    const GiNaC::numeric& number = GiNaC::ex_to<GiNaC::numeric>(e);
    return static_cast<long double>(number.numer().to_double()) /
           static_cast<long double>(number.denom().to_double());
  }
  if (const auto it = point.find(e); it != point.end())
    return static_cast<long double>(GiNaC::ex_to<GiNaC::numeric>(it->second).to_double());
  if (GiNaC::is_a<GiNaC::add>(e)) {
    long double sum = 0;
    for (std::size_t i = 0; i < e.nops(); ++i) sum += part(i);
    return sum;
  }
  if (GiNaC::is_a<GiNaC::mul>(e)) {
    long double product = 1;
    for (std::size_t i = 0; i < e.nops(); ++i) product *= part(i);
    return product;
  }
  if (GiNaC::is_a<GiNaC::power>(e)) return std::pow(part(0), part(1));
  if (GiNaC::is_a<GiNaC::constant>(e)) return std::acos(-1.0L);
  const std::string name = GiNaC::ex_to<GiNaC::function>(e).get_name();
  if (name == "sin") return std::sin(part(0));
  if (name == "cos") return std::cos(part(0));
  if (name == "tan") return std::tan(part(0));
  if (name == "exp") return std::exp(part(0));
  if (name == "sinh") return std::sinh(part(0));
  if (name == "cosh") return std::cosh(part(0));
  if (name == "tanh") return std::tanh(part(0));
  if (name == "log") return std::log(part(0));
  if (name == "asin") return std::asin(part(0));
  if (name == "acos") return std::acos(part(0));
  if (name == "atan") return std::atan(part(0));
  if (name == "atan2") {  // no angle belongs to the origin
    const long double y = part(0), x = part(1);
    return y == 0 && x == 0 ? std::numeric_limits<long double>::quiet_NaN() : std::atan2(y, x);
  }
  ADD_FAILURE() << "no value of " << name;
  return 0;
}

/// The real value; not a number where a part of the expression is not real, or so large or small
/// that rounding might matter.
long double value_of(const ex& e, const Values& point) {
  const long double value = plain_value(e, point);
  const bool fit = value == 0 || (std::fabs(value) < 1e4L && std::fabs(value) > 1e-4L);
  // No real number is -0, of which atan2 makes another side of its cut.
  return fit ? value + 0.0L : std::numeric_limits<long double>::quiet_NaN();
}

class Identities {
 public:
  explicit Identities(unsigned seed) : random_(seed) {}

  ex expression(int depth) {
    if (depth == 0 || random_(8) == 0) return leaf();
    const ex a = expression(depth - 1);
    switch (random_(21)) {
      case 18:
        return GiNaC::sinh(a);
      case 19:
        return GiNaC::cosh(a);
      case 20:
        return GiNaC::tanh(a);
      case 14:
        return random_(2) == 0 ? GiNaC::asin(a) : GiNaC::acos(a);
      case 15:
        return GiNaC::atan2(a, nonzero(leaf()));
      case 16:
        return GiNaC::sin(inverse(a) / (2 + random_(3)));
      case 17:
        return GiNaC::cos(inverse(a) / (2 + random_(3)));
      case 0:
        return a + leaf();
      case 1:
        return a - expression(depth - 1);
      case 2:
        return a * expression(depth - 1);
      case 3:
        return a / nonzero(leaf());
      case 4:
        return GiNaC::pow(a, 2 + random_(2));
      case 5:
        return root(a);
      case 6:
        return root(GiNaC::pow(a, 2));
      case 7:
        return GiNaC::sin(a);
      case 8:
        return GiNaC::cos(a);
      case 9:
        return GiNaC::log(nonzero(a));
      case 10:
        return GiNaC::exp(a);
      case 11:
        return GiNaC::atan(a);
      case 12:
        return root(a * leaf());
      default:
        return root(expression(depth - 1) / nonzero(leaf()));
    }
  }

  /// Another form of e, which equals it everywhere, for some signs, or nowhere.
  ex rewritten(const ex& e) {
    if (e.nops() > 0 && random_(3) == 0) {
      std::vector<ex> parts;
      for (std::size_t i = 0; i < e.nops(); ++i) parts.push_back(rewritten(e.op(i)));
      if (GiNaC::is_a<GiNaC::add>(e)) return GiNaC::add(GiNaC::exvector(parts)).eval();
      if (GiNaC::is_a<GiNaC::mul>(e)) return GiNaC::mul(GiNaC::exvector(parts)).eval();
      if (GiNaC::is_a<GiNaC::power>(e)) return rewritten_power(parts[0], parts[1]);
      return rewritten_function(GiNaC::ex_to<GiNaC::function>(e).get_name(), parts[0],
                                parts.back());
    }
    if (GiNaC::is_a<GiNaC::power>(e)) return rewritten_power(e.op(0), e.op(1));
    if (GiNaC::is_a<GiNaC::mul>(e)) return rewritten_product(e);
    if (GiNaC::is_a<GiNaC::function>(e))
      return rewritten_function(GiNaC::ex_to<GiNaC::function>(e).get_name(), e.op(0),
                                e.op(e.nops() - 1));
    if (GiNaC::is_a<GiNaC::add>(e) && random_(3) == 0)
      return GiNaC::sqrt(nonzero(GiNaC::pow(e, 2).expand()));
    return e.expand();
  }

  std::vector<Assumption> assumptions() {
    std::vector<Assumption> result;
    constexpr std::array kComparisons{Comparison::greater, Comparison::at_least, Comparison::less,
                                      Comparison::at_most};
    for (int count = random_(3); count > 0; --count) {
      const ex first = leaf(), second = leaf();
      const ex difference = random_(3) == 0   ? first
                            : random_(3) == 0 ? first * second
                            : random_(2) == 0 ? first / nonzero(second)
                                              : expression(2);
      if (!GiNaC::is_a<GiNaC::numeric>(difference))
        result.push_back({difference, kComparisons[static_cast<std::size_t>(random_(4))], ""});
    }
    return result;
  }

  /// Something that the ring has to know as well, and that is real where the claim is made: often a
  /// root or a logarithm of a simple function.
  ex context() {
    const ex a = random_(2) == 0 ? GiNaC::sin(leaf()) : expression(1);
    return random_(3) == 0 ? GiNaC::log(nonzero(a)) : GiNaC::sqrt(nonzero(a));
  }

  /// Every other one of small numbers, at which cuts are met and the ends of ranges.
  Values point() {
    Values result;
    const bool small = random_(2) == 0;
    for (const ex& x : symbols_) {
      const double value = small ? random_(5) - 2 : static_cast<double>(random_.real());
      result[x] = GiNaC::numeric(value);
    }
    return result;
  }

  std::vector<GiNaC::symbol> symbols() const {
    std::vector<GiNaC::symbol> result;
    for (const ex& x : symbols_) result.push_back(GiNaC::ex_to<GiNaC::symbol>(x));
    return result;
  }

 private:
  ex leaf() {
    const ex x = random_(2) == 0 ? symbols_[0] : random_.of(symbols_);
    switch (random_(8)) {
      case 0:
        return GiNaC::numeric(1 + random_(4));
      case 1:
        return x / (2 + random_(2));
      case 2:
        return x * (2 + random_(2));
      case 3:
        return x - random_.of(symbols_);
      case 4:
        return x * x + 1;
      default:
        return x;
    }
  }
  static ex nonzero(const ex& e) { return e.is_zero() ? ex(2) : e; }
  ex root(const ex& e) {
    return GiNaC::pow(nonzero(e), GiNaC::numeric(1 + 2 * random_(2), 2 + random_(2)));
  }
  ex rewritten_power(const ex& base, const ex& exponent) {
    if (base.is_zero()) return 0;
    if (GiNaC::is_a<GiNaC::mul>(base)) {
      ex product = 1;
      for (std::size_t i = 0; i < base.nops(); ++i)
        product *= GiNaC::pow(GiNaC::pow(base.op(i), random_(2) == 0 ? 1 : 2),
                              random_(2) == 0 ? exponent : exponent / 2);
      return product;
    }
    if (GiNaC::is_a<GiNaC::power>(base)) return GiNaC::pow(base.op(0), base.op(1) * exponent);
    if (random_(2) == 0) return GiNaC::exp(exponent * GiNaC::log(base));
    return random_(2) == 0 ? GiNaC::pow(base.expand(), exponent)
                           : base * GiNaC::pow(base, exponent - 1);
  }
  ex rewritten_product(const ex& e) {
    ex under_root = 1;
    for (std::size_t i = 0; i < e.nops(); ++i) under_root *= GiNaC::pow(e.op(i), 2);
    return random_(2) == 0 ? GiNaC::sqrt(under_root) : e.expand();
  }
  ex inverse(const ex& a) {
    switch (random_(4)) {
      case 0:
        return GiNaC::asin(a);
      case 1:
        return GiNaC::acos(a);
      case 2:
        return GiNaC::atan(a);
      default:
        return GiNaC::atan2(a, nonzero(leaf()));
    }
  }
  ex rewritten_arc(const std::string& name, const ex& a, const ex& b) {
    const ex l = nonzero(leaf());
    const ex r = GiNaC::sqrt(nonzero(a * a + b * b));
    if (name == "asin")
      return random_(3) == 0   ? GiNaC::Pi / 2 - GiNaC::acos(a)
             : random_(2) == 0 ? -GiNaC::asin(-a)
                               : GiNaC::atan(a / GiNaC::sqrt(nonzero(1 - a * a)));
    if (name == "acos")
      return random_(3) == 0   ? GiNaC::Pi / 2 - GiNaC::asin(a)
             : random_(2) == 0 ? GiNaC::Pi - GiNaC::acos(-a)
                               : GiNaC::atan(GiNaC::sqrt(nonzero(1 - a * a)) / nonzero(a));
    if (name == "atan2") {
      switch (random_(6)) {
        case 0:
          return GiNaC::atan(a / nonzero(b));
        case 1:
          return -GiNaC::atan2(-a, b);
        case 2:
          return GiNaC::atan2(a * l, b * l);
        case 3:
          return GiNaC::Pi / 2 - GiNaC::atan2(b, nonzero(a));
        case 4:
          return GiNaC::acos(b / r);
        default:
          return GiNaC::asin(a / r);
      }
    }
    switch (random_(6)) {
      case 0:
        return 2 * GiNaC::atan(a / (1 + GiNaC::sqrt(1 + a * a)));
      case 1:
        return -GiNaC::atan(-a);
      case 2:
        return GiNaC::Pi / 2 - GiNaC::atan(1 / nonzero(a));
      case 3:
        return GiNaC::asin(a / GiNaC::sqrt(1 + a * a));
      case 4:
        return GiNaC::acos(1 / GiNaC::sqrt(1 + a * a));
      default:
        return GiNaC::atan2(a * l, l);
    }
  }
  ex rewritten_hyperbolic(const std::string& name, const ex& a) {
    const ex s = GiNaC::sinh(a), c = GiNaC::cosh(a);
    if (name == "sinh")
      return random_(3) == 0   ? (GiNaC::exp(a) - GiNaC::exp(-a)) / 2
             : random_(2) == 0 ? 2 * GiNaC::sinh(a / 2) * GiNaC::cosh(a / 2)
                               : GiNaC::sqrt(nonzero(c * c - 1));
    if (name == "cosh")
      return random_(3) == 0   ? GiNaC::exp(a) - s
             : random_(2) == 0 ? 1 + 2 * GiNaC::pow(GiNaC::sinh(a / 2), 2)
                               : GiNaC::sqrt(nonzero(1 + s * s));
    return random_(3) == 0   ? s / nonzero(c)
           : random_(2) == 0 ? 1 - 2 / (GiNaC::exp(2 * a) + 1)
                             : GiNaC::sqrt(nonzero(1 - 1 / (c * c)));
  }
  ex rewritten_function(const std::string& name, const ex& a, const ex& b) {
    if (name == "sinh" || name == "cosh" || name == "tanh") return rewritten_hyperbolic(name, a);
    if (name == "sin" && random_(3) == 0)
      return 3 * GiNaC::sin(a / 3) - 4 * GiNaC::pow(GiNaC::sin(a / 3), 3);
    if (name == "cos" && random_(3) == 0)
      return 4 * GiNaC::pow(GiNaC::cos(a / 3), 3) - 3 * GiNaC::cos(a / 3);
    if (name == "sin")
      return random_(3) == 0   ? 2 * GiNaC::sin(a / 2) * GiNaC::cos(a / 2)
             : random_(2) == 0 ? GiNaC::sqrt((1 - GiNaC::cos(2 * a)) / 2)
                               : GiNaC::sqrt(1 - GiNaC::pow(GiNaC::cos(a), 2));
    if (name == "cos")
      return random_(2) == 0 ? 1 - 2 * GiNaC::pow(GiNaC::sin(a / 2), 2)
                             : GiNaC::sqrt((1 + GiNaC::cos(2 * a)) / 2);
    if (name == "asin" || name == "acos" || name == "atan" || name == "atan2")
      return rewritten_arc(name, a, b);
    if (name == "exp") return GiNaC::pow(GiNaC::exp(a / 2), 2);
    if (name == "log" && GiNaC::is_a<GiNaC::power>(a)) return a.op(1) * GiNaC::log(a.op(0));
    if (name == "log" && GiNaC::is_a<GiNaC::mul>(a)) {
      ex sum = 0;
      for (std::size_t i = 0; i < a.nops(); ++i) sum += GiNaC::log(GiNaC::pow(a.op(i), 2)) / 2;
      return sum;
    }
    if (name == "log") return GiNaC::log(nonzero(a * a)) / 2;
    return 0;
  }

  Random random_;
  std::vector<ex> symbols_{GiNaC::symbol("x"), GiNaC::symbol("y"), GiNaC::symbol("z")};
};

bool holds(const Assumption& assumption, const Values& point) {
  const long double value = value_of(assumption.difference, point);
  return !std::isnan(value) && casimir::holds(assumption.comparison, (value > 0) - (value < 0));
}

/// An expression, another form of it, and what is known where they are compared.
struct Claim {
  ex left, right;
  ex context;  ///< real where the claim is made
  std::vector<Assumption> assumptions;
};

/// Empty where GiNaC divides by zero or sees by itself that both forms are one.
std::optional<Claim> random_claim(Identities& identities) {
  try {
    const ex left = identities.expression(3);
    const ex right = identities.rewritten(left);
    if ((left - right).is_zero()) return std::nullopt;
    const ex context = identities.context();
    return Claim{left, right, context, identities.assumptions()};
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

/// Most of the random claims that take long are no identities.
Limits few() {
  Limits result;
  result.work = 1e5;
  result.terms = 1000;
  return result;
}

/// What is too large for the ring is not proved.
bool proved(const Claim& claim, const std::vector<GiNaC::symbol>& symbols) {
  const ex difference = claim.left - claim.right;
  try {
    const WorkMeter meter(few());
    FunctionRing ring(symbols, claim.assumptions, {claim.context, difference}, few());
    return ring.numerator(ring.convert(difference)).is_zero();
  } catch (const std::exception&) {
    return false;
  }
}

bool inside(const Claim& claim, const Values& point) {
  return !std::isnan(value_of(claim.context, point)) &&
         std::all_of(claim.assumptions.begin(), claim.assumptions.end(),
                     [&](const Assumption& assumption) { return holds(assumption, point); });
}

std::string text_of(const Claim& claim) {
  std::ostringstream text;
  text << claim.left << "\n  taken for " << claim.right << "\n  where " << claim.context
       << " is real";
  for (const Assumption& assumption : claim.assumptions)
    text << "\n  where " << assumption.difference << ' ' << to_string(assumption.comparison)
         << " 0";
  return text.str();
}

/// At how many random points both sides have a value; they must be equal there.
unsigned compared_points(const Claim& claim, Identities& identities) {
  constexpr int kPoints = 60;
  unsigned compared = 0;
  for (int k = 0; k < kPoints; ++k) {
    const Values point = identities.point();
    const long double left = value_of(claim.left, point), right = value_of(claim.right, point);
    if (!inside(claim, point) || !std::isfinite(left) || !std::isfinite(right)) continue;
    ++compared;
    EXPECT_NEAR(static_cast<double>(left), static_cast<double>(right),
                1e-6 * (1 + std::fabs(static_cast<double>(left))))
        << text_of(claim) << "\n  at " << point;
  }
  return compared;
}

TEST(FunctionRingSoundness, WhatIsZeroInTheRingIsZeroAtRandomPoints) {
  const char* asked = std::getenv("CASIMIR_IDENTITIES");
  const unsigned count = asked != nullptr ? static_cast<unsigned>(std::atoi(asked)) : 2000;
  unsigned zeros = 0, compared = 0;
  for (unsigned seed = 1; seed <= count && !HasFailure(); ++seed) {
    SCOPED_TRACE(seed);
    Identities identities(seed);
    const auto claim = random_claim(identities);
    if (!claim || !proved(*claim, identities.symbols())) continue;
    ++zeros;
    compared += compared_points(*claim, identities);
  }
  std::printf("%u of %u differences are zero, compared at %u points\n", zeros, count, compared);
  EXPECT_GT(zeros, count / 20);
  EXPECT_GT(compared, 5 * zeros);
}

}  // namespace
}  // namespace casimir
