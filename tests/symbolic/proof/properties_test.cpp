// What must hold for any input: the axioms of a bracket, agreement with GiNaC's own expansion, and
// verdicts that do not depend on names, on order or on the coordinates chosen.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <sstream>

#include "symbolic/poisson.hpp"
#include "symbolic/prove.hpp"
#include "tests/symbolic/cases.hpp"

namespace casimir::test {
namespace {

using GiNaC::ex;
using Symbols = std::vector<GiNaC::symbol>;

std::string text_of(const ex& e) {
  std::ostringstream stream;
  stream << e;
  return stream.str();
}

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}

  int integer(int low, int high) { return std::uniform_int_distribution(low, high)(engine_); }
  GiNaC::numeric rational() { return GiNaC::numeric(integer(-5, 5), integer(1, 3)); }

  /// A few random terms of degree at most `degree`.
  ex polynomial(const Symbols& x, int degree, int terms) {
    ex sum = 0;
    for (int t = 0; t < terms; ++t) {
      ex term = rational();
      for (int d = integer(0, degree); d > 0; --d)
        term *= x[static_cast<std::size_t>(integer(0, static_cast<int>(x.size()) - 1))];
      sum += term;
    }
    return sum;
  }

  template <class T>
  void shuffle(std::vector<T>& list) {
    std::shuffle(list.begin(), list.end(), engine_);
  }

 private:
  std::mt19937 engine_;
};

Symbols symbols(std::size_t n) {
  Symbols x;
  for (std::size_t i = 0; i < n; ++i) x.emplace_back("x" + std::to_string(i + 1));
  return x;
}

/// {x_i, x_j} = f eps_ijk dC/dx_k: a Poisson bracket of three variables whatever f and C are.
PoissonStructure nambu(const Symbols& x, const ex& f, const ex& c) {
  return {x, {f * c.diff(x[2]), -f * c.diff(x[1]), f * c.diff(x[0])}};
}

class Seed : public testing::TestWithParam<unsigned> {};

class BracketAxioms : public Seed {};
INSTANTIATE_TEST_SUITE_P(Each, BracketAxioms, testing::Range(1U, 21U));

TEST_P(BracketAxioms, HoldForRandomPolynomialBracketsAndFunctions) {
  Random random(GetParam());
  const Symbols x = symbols(3);
  const PoissonStructure structure =
      nambu(x, random.polynomial(x, 2, 3), random.polynomial(x, 3, 4));
  const ex f = random.polynomial(x, 3, 4);
  const ex g = random.polynomial(x, 3, 4);
  const ex h = random.polynomial(x, 2, 3);
  const GiNaC::numeric a = random.rational();
  const auto bracket = [&](const ex& u, const ex& v) { return structure.bracket(u, v).expand(); };
  const auto zero = [](const ex& e) { return e.expand().is_zero(); };
  EXPECT_TRUE(zero(bracket(f, g) + bracket(g, f)));
  EXPECT_TRUE(zero(bracket(a * f + g, h) - a * bracket(f, h) - bracket(g, h)));
  EXPECT_TRUE(zero(bracket(f * g, h) - f * bracket(g, h) - g * bracket(f, h)));
  EXPECT_TRUE(
      zero(bracket(f, bracket(g, h)) + bracket(g, bracket(h, f)) + bracket(h, bracket(f, g))));
  EXPECT_TRUE(zero(structure.jacobi_defect(0, 1, 2)));
}

/// A case with these brackets, Hamiltonian and candidate integral.
std::string toml(const Symbols& x, const PoissonStructure& structure, const ex& h, const ex& f) {
  std::ostringstream text;
  text << "hamiltonian = \"" << h << "\"\n[integrals]\nF = \"" << f
       << "\"\n[phase_space]\nvariables = [";
  for (std::size_t i = 0; i < x.size(); ++i) text << (i > 0 ? ", " : "") << '"' << x[i] << '"';
  text << "]\n[phase_space.brackets]\n";
  for (std::size_t i = 0; i < x.size(); ++i) {
    for (std::size_t j = i + 1; j < x.size(); ++j)
      text << '"' << x[i] << ',' << x[j] << "\" = \"" << structure(i, j) << "\"\n";
  }
  return text.str();
}

Verdict verdict_of(const std::string& text, const std::string& kind = "integral") {
  for (const Proof& proof : prove(model_of(text))) {
    if (to_string(proof.kind) == kind) return proof.verdict;
  }
  ADD_FAILURE() << "no claim of the kind " << kind;
  return Verdict::undecided;
}

PoissonStructure e3(const Symbols& x) {
  const auto& [m1, m2, m3, g1, g2, g3] = std::tie(x[0], x[1], x[2], x[3], x[4], x[5]);
  return {x, {-m3, m2, 0, -g3, g2, -m1, g3, 0, -g1, -g2, g1, 0, 0, 0, 0}};
}

ex kovalevskaya_energy(const Symbols& x) {
  return (x[0] * x[0] + x[1] * x[1] + 2 * x[2] * x[2]) / 2 - x[3];
}

ex kovalevskaya_integral(const Symbols& x) {
  return GiNaC::pow(x[0] * x[0] - x[1] * x[1] + 2 * x[3], 2) +
         GiNaC::pow(2 * x[0] * x[1] + 2 * x[4], 2);
}

class AgreesWithGinac : public Seed {};
INSTANTIATE_TEST_SUITE_P(Each, AgreesWithGinac, testing::Range(1U, 21U));

TEST_P(AgreesWithGinac, OnRandomFunctionsOfIntegrals) {
  Random random(GetParam());
  const Symbols x = symbols(6);
  const PoissonStructure structure = e3(x);
  const ex h = kovalevskaya_energy(x);
  ex f = random.rational() * kovalevskaya_integral(x) * h +
         random.rational() * GiNaC::pow(x[3] * x[3] + x[4] * x[4] + x[5] * x[5], 2);
  // Every second candidate is spoiled by random terms, which may or may not spoil it.
  if (GetParam() % 2 == 0) f += random.polynomial(x, 2, 2);
  const bool zero = structure.bracket(f, h).expand().is_zero();
  EXPECT_EQ(verdict_of(toml(x, structure, h, f)), zero ? Verdict::proved : Verdict::refuted)
      << text_of(f);
}

TEST_P(AgreesWithGinac, OnJacobiOfRandomBrackets) {
  Random random(GetParam());
  const Symbols x = symbols(3);
  const PoissonStructure any(
      x, {random.polynomial(x, 2, 2), random.polynomial(x, 2, 2), random.polynomial(x, 2, 2)});
  const bool zero = any.jacobi_defect(0, 1, 2).expand().is_zero();
  EXPECT_EQ(verdict_of(toml(x, any, x[0], x[0]), "jacobi"),
            zero ? Verdict::proved : Verdict::refuted);
  const PoissonStructure poisson = nambu(x, random.polynomial(x, 2, 2), random.polynomial(x, 3, 3));
  EXPECT_EQ(verdict_of(toml(x, poisson, x[0], x[0]), "jacobi"), Verdict::proved);
}

class Invariance : public Seed {};
INSTANTIATE_TEST_SUITE_P(Each, Invariance, testing::Range(1U, 11U));

TEST_P(Invariance, OfTheVerdictUnderRenamingAndReordering) {
  Random random(GetParam());
  const Symbols x = symbols(6);
  std::vector<std::size_t> order(6);
  std::iota(order.begin(), order.end(), std::size_t{0});
  random.shuffle(order);
  GiNaC::exmap renamed;
  Symbols y(6);
  for (std::size_t i = 0; i < 6; ++i) {
    y[i] = GiNaC::symbol("v" + std::to_string(random.integer(0, 9)) + std::string(i + 1, 'q'));
    renamed[x[order[i]]] = y[i];
  }
  const PoissonStructure structure = e3(x);
  std::vector<ex> upper;
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = i + 1; j < 6; ++j)
      upper.push_back(structure(order[i], order[j]).subs(renamed));
  }
  const ex h = kovalevskaya_energy(x).subs(renamed);
  const ex f = kovalevskaya_integral(x).subs(renamed);
  const PoissonStructure shuffled(y, upper);
  EXPECT_EQ(verdict_of(toml(y, shuffled, h, f)), Verdict::proved);
  EXPECT_EQ(verdict_of(toml(y, shuffled, h, f + y[0])), Verdict::refuted);
}

TEST_P(Invariance, OfTheVerdictUnderALinearChangeOfCoordinates) {
  Random random(GetParam());
  const Symbols x = symbols(6);
  const Symbols y = [] {
    Symbols s;
    for (int i = 1; i <= 6; ++i) s.emplace_back("y" + std::to_string(i));
    return s;
  }();
  // y = T x with a T of determinant 1: lower triangular times upper triangular.
  GiNaC::matrix lower(6, 6);
  GiNaC::matrix upper_part(6, 6);
  for (unsigned i = 0; i < 6; ++i) {
    for (unsigned j = 0; j < 6; ++j) {
      lower(i, j) = i == j ? 1 : i > j ? random.integer(-1, 1) : 0;
      upper_part(i, j) = i == j ? 1 : i < j ? random.integer(-1, 1) : 0;
    }
  }
  const GiNaC::matrix t = lower.mul(upper_part);
  const GiNaC::matrix back = t.inverse();
  GiNaC::exmap to_y;
  std::vector<ex> forward(6);
  for (unsigned i = 0; i < 6; ++i) {
    ex sum = 0;
    for (unsigned j = 0; j < 6; ++j) {
      sum += back(i, j) * y[j];
      forward[i] += t(i, j) * x[j];
    }
    to_y[x[i]] = sum;
  }
  const PoissonStructure structure = e3(x);
  std::vector<ex> upper;
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = i + 1; j < 6; ++j)
      upper.push_back(structure.bracket(forward[i], forward[j]).subs(to_y).expand());
  }
  const PoissonStructure moved(y, upper);
  const ex h = kovalevskaya_energy(x).subs(to_y);
  const ex f = kovalevskaya_integral(x).subs(to_y);
  EXPECT_EQ(verdict_of(toml(y, moved, h, f)), Verdict::proved);
  EXPECT_EQ(verdict_of(toml(y, moved, h, f), "jacobi"), Verdict::proved);
  EXPECT_EQ(verdict_of(toml(y, moved, h, f + y[0])), Verdict::refuted);
}

}  // namespace
}  // namespace casimir::test
