// What roots and logarithms need, against their values at points: where everything that is said
// holds, each of them has one.
#include <gtest/gtest.h>

#include <random>

#include "symbolic/algebra/ball_evaluator.hpp"
#include "symbolic/functions/function_ring.hpp"

namespace casimir {
namespace {

using GiNaC::ex;

/// Products of roots and logarithms of small polynomials.
class RandomFunctions {
 public:
  RandomFunctions(const std::vector<GiNaC::symbol>& variables, unsigned seed)
      : variables_(variables), random_(seed) {}

  ex product() {
    ex result = 1;
    for (int k = up_to(3); k >= 0; --k) result *= function(2);
    return result;
  }
  int up_to(int end) { return std::uniform_int_distribution<int>(0, end - 1)(random_); }

 private:
  ex variable() { return variables_[static_cast<std::size_t>(up_to(3))]; }
  ex argument() {
    const ex x = variable();
    switch (up_to(6)) {
      case 0:
        return x;
      case 1:
        return x * variable() * GiNaC::pow(variable(), 2);
      case 2:
        return x + 1 - 2 * up_to(2);
      case 3:
        return GiNaC::pow(x, 2) + variable() / 2;
      case 4:
        return x / (variable() - 3);
      default:
        return -GiNaC::pow(x, 1 + up_to(2));
    }
  }
  ex function(int depth) {
    const ex a = depth > 0 && up_to(3) == 0 ? function(depth - 1) : argument();
    switch (up_to(4)) {
      case 0:
        return GiNaC::log(a);
      case 1:
        return GiNaC::sqrt(a);
      case 2:
        return GiNaC::pow(a, GiNaC::numeric(1, 4));
      default:
        return GiNaC::pow(a, GiNaC::numeric(-1, 2));
    }
  }

  const std::vector<GiNaC::symbol>& variables_;
  std::mt19937 random_;
};

/// Whether all that the ring says of where its functions have values holds at a point.
bool holds_at(const FunctionRing& ring, BallEvaluator& evaluator) {
  const auto sign = [&](const Polynomial& p) { return evaluator.sign(ring.expression(p)); };
  try {
    for (const auto& [p, strict] : ring.implied_by_values().positive) {
      const auto found = sign(p);
      if (!found || *found < (strict ? 1 : 0)) return false;
    }
    for (const auto& list : {ring.implied_by_values().nonzero, ring.denominators()})
      for (const Polynomial& p : list)
        if (sign(p).value_or(0) == 0) return false;
    return true;
  } catch (const NotCertified&) {
    return false;
  }
}

TEST(SignConditions, AreEnoughForEveryRootAndLogarithm) {
  const GiNaC::symbol x("x"), y("y"), z("z");
  const std::vector<GiNaC::symbol> variables{x, y, z};
  RandomFunctions functions(variables, 1);
  int held = 0, rings = 0;
  for (int k = 0; k < 300; ++k) {
    try {
      const ex f = functions.product();
      const FunctionRing ring(variables, {}, {f}, {});
      ++rings;
      for (int point = 0; point < 40; ++point) {
        BallEvaluator evaluator(BallEvaluator::Numbers::real, 128);
        std::string at;
        for (const GiNaC::symbol& v : variables) {
          const GiNaC::numeric value(functions.up_to(13) - 6, 2);
          evaluator.set(v, value);
          at += v.get_name() + " = " + std::to_string(value.to_double()) + " ";
        }
        if (!holds_at(ring, evaluator)) continue;
        ++held;
        EXPECT_NO_THROW(evaluator.require(f)) << f << " at " << at;
      }
    } catch (const ModelError&) {  // a logarithm of what is nowhere positive
    } catch (const GiNaC::pole_error&) {
    }
  }
  EXPECT_GT(rings, 200);
  EXPECT_GT(held, 500);
}

}  // namespace
}  // namespace casimir
