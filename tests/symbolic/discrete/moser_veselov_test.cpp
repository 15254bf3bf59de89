// The map of Moser and Veselov against its definition, and what it needs.
#include "symbolic/discrete/moser_veselov.hpp"

#include <gtest/gtest.h>

#include <array>

#include "symbolic/discrete/moser_root.hpp"
#include "symbolic/discrete/prove_map.hpp"
#include "tests/symbolic/cases.hpp"
#include "tests/symbolic/discrete/maps.hpp"

namespace casimir::test {
namespace {

using GiNaC::ex;
using GiNaC::matrix;
using GiNaC::numeric;
using Numbers = std::array<numeric, 3>;

/// The rotation by a quaternion.
matrix rotation(int s, int a, int b, int c) {
  const numeric n = s * s + a * a + b * b + c * c;
  return matrix{
      {(s * s + a * a - b * b - c * c) / n, 2 * (a * b - s * c) / n, 2 * (a * c + s * b) / n},
      {2 * (a * b + s * c) / n, (s * s - a * a + b * b - c * c) / n, 2 * (b * c - s * a) / n},
      {2 * (a * c - s * b) / n, 2 * (b * c + s * a) / n, (s * s - a * a - b * b + c * c) / n}};
}

/// w, m with w^T J - J w = m, and the invariants of J w.
struct Step {
  matrix w, m;
  ex e1, e2;
};

Step step_of(const Numbers& j, const matrix& w) {
  const matrix tensor{{j[0], 0, 0}, {0, j[1], 0}, {0, 0, j[2]}};
  const matrix y = tensor.mul(w);
  const matrix skew = y.transpose().sub(y);
  const ex square = y.mul(y).trace();
  return {w, matrix{{skew(2, 1)}, {skew(0, 2)}, {skew(1, 0)}}, y.trace(),
          (y.trace() * y.trace() - square) / 2};
}

TEST(MoserVeselov, TheMapTurnsTheMomentumByTheRotationOfItsEquation) {
  const MapModel map = bundled_map("moser-veselov");
  const std::array<Numbers, 4> tensors{
      {{2, numeric(3, 2), 1}, {1, 1, numeric(1, 3)}, {3, 2, 0}, {5, 1, numeric(-1, 2)}}};
  const std::array<std::array<int, 4>, 4> quaternions{
      {{12, -2, -1, 2}, {5, 1, 2, -3}, {1, 1, 1, 2}, {0, 1, 2, 3}}};
  for (const Numbers& j : tensors) {
    for (const auto& q : quaternions) {
      const Step step = step_of(j, rotation(q[0], q[1], q[2], q[3]));
      GiNaC::exmap at;
      for (std::size_t i = 0; i < 3; ++i) {
        at[map.base.parameters[i]] = j[i];
        at[map.base.variables[i]] = step.m(unsigned(i), 0);
      }
      at[map.base.variables[3]] = step.e1;
      at[map.base.variables[4]] = step.e2;
      const matrix turned = step.w.mul(step.m);
      for (std::size_t i = 0; i < 3; ++i)
        EXPECT_TRUE((map.next[i].subs(at) - turned(unsigned(i), 0)).is_zero());
      EXPECT_TRUE((map.next[3].subs(at) - step.e1).is_zero());
      EXPECT_TRUE((map.next[4].subs(at) - step.e2).is_zero());
    }
  }
}

cln::cl_RA rational(const ex& value) {
  return cln::the<cln::cl_RA>(GiNaC::ex_to<numeric>(value.normal()).to_cl_N());
}

TEST(MoserVeselov, TheStartIsTheRotationNearTheIdentity) {
  for (const Numbers& j :
       {Numbers{2, numeric(3, 2), 1}, Numbers{3, 2, 0}, Numbers{5, 1, numeric(-1, 2)}}) {
    const Step step = step_of(j, rotation(40, -2, -1, 2));
    std::array<cln::cl_RA, 3> tensor, m;
    for (unsigned i = 0; i < 3; ++i) {
      tensor[i] = rational(j[i]);
      m[i] = rational(step.m(i, 0));
    }
    const auto found = discrete::rotation_near_identity(tensor, m);
    ASSERT_TRUE(found);
    EXPECT_LT(cln::abs(cln::rational(found->e1) - rational(step.e1)),
              cln::expt(cln::cl_RA(10), -40));
    EXPECT_LT(cln::abs(cln::rational(found->e2) - rational(step.e2)),
              cln::expt(cln::cl_RA(10), -40));
    for (cln::cl_RA& one : m) one = one * 1000;
    EXPECT_FALSE(discrete::rotation_near_identity(tensor, m));
  }
}

/// Without the level the formulas turn nothing: off it the length is not kept.
TEST(MoserVeselov, ItsIntegralsAreOnesOnTheLevelAlone) {
  const MapModel map = bundled_map("moser-veselov", {});
  EXPECT_EQ(overall(map.base, prove_map(map)), Verdict::proved);
  const MapModel numbers = bundled_map("moser-veselov", {{{"j1", {}, "j1"}, {"2", {}, "2"}},
                                                         {{"j2", {}, "j2"}, {"1", {}, "1"}},
                                                         {{"j3", {}, "j3"}, {"3", {}, "3"}}});
  Candidates off;
  off.integrals = {Text{"e1", {"--integral", 1, 1}, "e1"}};
  EXPECT_EQ(prove_map(numbers, off).front().verdict, Verdict::refuted);
}

std::string body(const std::string& energy, const std::string& bracket) {
  return "hamiltonian = \"" + energy + "\"\n[phase_space]\nvariables = [\"x\", \"y\", \"z\"]\n" +
         bracket + "[parameters]\nb = {}\n";
}

const std::string kBracket = "algebra = \"so(3)\"\n";

TEST(MoserVeselov, RefusesWhatIsNoFreeBody) {
  const auto refused = [](const std::string& energy, const std::string& bracket) {
    EXPECT_THROW(moser_veselov_map(model_of(body(energy, bracket)), std::nullopt), ModelError)
        << energy << bracket;
  };
  for (const char* energy : {"x^2 + y^2", "x^2 + y^2 + z^2 + x", "x^2 + y^2 + z^2 + b*x*y",
                             "x^2 + y^2 + z^4", "x^2 + y^2 + x^2*z^2", "sqrt(x^2 + y^2 + z^2)"})
    refused(energy, kBracket);
  refused("x^2 + y^2 + z^2",
          "[phase_space.brackets]\n\"x,y\" = \"z\"\n\"y,z\" = \"x\"\n\"z,x\" = \"-y\"\n");
  refused("x^2 + y^2 + z^2", "[phase_space.brackets]\n\"x,y\" = \"z^2\"\n");
  EXPECT_THROW(moser_veselov_map(bundled("lagrange"), std::nullopt), ModelError);
  EXPECT_THROW(moser_veselov_map(bundled("van-der-pol"), std::nullopt), ModelError);
}

TEST(MoserVeselov, ReadsTheMomentsOfInertia) {
  const auto made = [](const std::string& energy, const std::string& bracket) {
    return moser_veselov_map(model_of(body(energy, bracket)), std::nullopt);
  };
  const RationalMapText map = made("(x^2/2 + y^2/3 + z^2/4)/2 + b", kBracket);
  EXPECT_EQ(map.definitions[0].second, "5/2");
  EXPECT_EQ(map.definitions[1].second, "3/2");
  EXPECT_EQ(map.definitions[2].second, "1/2");
  EXPECT_EQ(map.definitions[3].second, "eps");
  EXPECT_TRUE(map.conditions.empty());
  const RationalMapText other =
      made("(x^2/2 + y^2/3 + z^2/4)/2",
           "[phase_space.brackets]\n\"x,y\" = \"2*z\"\n\"y,z\" = \"2*x\"\n\"z,x\" = \"2*y\"\n");
  EXPECT_EQ(other.definitions[3].second, "-2*eps");
  const RationalMapText symbolic = made("(b*x^2 + y^2 + z^2)/2", kBracket);
  EXPECT_EQ(symbolic.conditions, std::vector<std::string>{"b != 0"});
}

}  // namespace
}  // namespace casimir::test
