// Jacobi's functions and Carlson's integrals: values against Boost, proofs of their identities, and
// what is not one.
#include "symbolic/expression/elliptic.hpp"

#include <gtest/gtest.h>

#include <boost/math/special_functions/ellint_rd.hpp>
#include <boost/math/special_functions/ellint_rf.hpp>
#include <boost/math/special_functions/ellint_rj.hpp>
#include <boost/math/special_functions/jacobi_elliptic.hpp>
#include <cmath>

#include "symbolic/case_file.hpp"
#include "symbolic/error.hpp"
#include "symbolic/expression/decimal.hpp"
#include "symbolic/prove.hpp"

namespace casimir::test {
namespace {

Model two_variables(const std::string& more = {}) {
  return build_model(parse_case(R"toml(title = "t"
[phase_space]
variables = ["x", "y", "z", "w"]
[parameters]
k = { assume = ["k > 0", "k < 1"] }
[equations]
x = "1"
y = "1/2"
z = "2"
w = "0"
)toml" + more,
                                "t.toml"));
}

GiNaC::ex read(const Model& model, const std::string& text) {
  return model.parse(Text{text, {"test", 1, 1}, text});
}

Verdict verdict_of(const std::string& left, const std::string& right) {
  const Model model = two_variables();
  Candidates candidates;
  const std::string text = left + " = " + right;
  candidates.identities.push_back(Text{text, {"test", 1, 1}, text});
  return prove(model, candidates).front().verdict;
}

/// By balls.
double value_of(const std::string& text, double x, double y, double z) {
  const Model model = two_variables();
  const GiNaC::exmap point{{model.variables[0], GiNaC::numeric(x)},
                           {model.variables[1], GiNaC::numeric(y)},
                           {model.variables[2], GiNaC::numeric(z)}};
  const auto exact = real_decimal(read(model, text).subs(point), model.limits.bits);
  return exact ? exact->to_double() : NAN;
}

void expect_value(const std::string& text, double x, double y, double z, double expected) {
  EXPECT_NEAR(value_of(text, x, y, z), expected, 4e-14 * (1 + std::abs(expected)))
      << text << " " << x;
}

TEST(EllipticBalls, AreThoseOfBoost) {
  for (const double u : {-3.7, 0.2, 1.1, 2.9, 17.3})
    for (const char* k : {"1/10", "1/2", "9/10", "9999/10000"}) {
      const double modulus =
          GiNaC::ex_to<GiNaC::numeric>(GiNaC::ex(GiNaC::numeric(k)).evalf()).to_double();
      double cn = 0, dn = 0;
      const double sn = boost::math::jacobi_elliptic(modulus, u, &cn, &dn);
      const std::string k_text = std::string(", ") + k + ")";
      expect_value("sn(x" + k_text, u, 1, 1, sn);
      expect_value("cn(x" + k_text, u, 1, 1, cn);
      expect_value("dn(x" + k_text, u, 1, 1, dn);
      expect_value("sin(am(x" + k_text + ")", u, 1, 1, sn);
    }
}

TEST(EllipticBalls, OfCarlsonAreThoseOfBoost) {
  for (const auto& [x, y, z] : {std::array{1., 2., 3.}, std::array{1e-6, 2., 1e5},
                                std::array{0.5, 0.5000001, 0.4999}, std::array{3., 1e-12, 7e3}}) {
    expect_value("R_F(x, y, z)", x, y, z, boost::math::ellint_rf(x, y, z));
    expect_value("R_D(x, y, z)", x, y, z, boost::math::ellint_rd(x, y, z));
    expect_value("R_J(x, y, z, 3/2)", x, y, z, boost::math::ellint_rj(x, y, z, 1.5));
  }
}

TEST(EllipticProofs, IdentitiesAreProved) {
  EXPECT_EQ(verdict_of("sn(x, k)^2 + cn(x, k)^2", "1"), Verdict::proved);
  EXPECT_EQ(verdict_of("k^2*sn(x, k)^2 + dn(x, k)^2", "1"), Verdict::proved);
  EXPECT_EQ(verdict_of("diff(sn(2*x, k), x)", "2*cn(2*x, k)*dn(2*x, k)"), Verdict::proved);
  EXPECT_EQ(verdict_of("rate(dn(x*y, k))", "-k^2*sn(x*y, k)*cn(x*y, k)*(y + x/2)"),
            Verdict::proved);
  EXPECT_EQ(verdict_of("rate(am(x, k))^2", "1 - k^2*sin(am(x, k))^2"), Verdict::proved);
  EXPECT_EQ(verdict_of("R_D(y, z, x) + R_D(z, x, y) + R_D(x, y, z)", "3/sqrt(x*y*z)"),
            Verdict::proved);
  EXPECT_EQ(verdict_of("x*R_D(y, z, x) + y*R_D(x, z, y) + z*R_D(x, y, z)", "3*R_F(z, x, y)"),
            Verdict::proved);
  EXPECT_EQ(verdict_of("rate(R_F(x, y, z))", "-(R_D(y, z, x) + R_D(x, z, y)/2 + 2*R_D(x, y, z))/6"),
            Verdict::proved);
  // Euler and Poisson's equation of the mixed derivatives.
  EXPECT_EQ(verdict_of("2*(x - y)*diff(diff(R_F(x, y, z), x), y)",
                       "diff(R_F(x, y, z), x) - diff(R_F(x, y, z), y)"),
            Verdict::proved);
  EXPECT_EQ(verdict_of("x*diff(R_J(x, y, z, 2), x) + y*diff(R_J(x, y, z, 2), y) + "
                       "z*diff(R_J(x, y, z, 2), z) + 3/2*R_J(x, y, z, 2)",
                       "R_J(x, y, z, 2)"),
            Verdict::refuted);
}

TEST(EllipticProofs, WhatIsNoIdentityIsNeverProved) {
  EXPECT_EQ(verdict_of("sn(x, k)^2 + dn(x, k)^2", "1"), Verdict::refuted);
  EXPECT_EQ(verdict_of("diff(sn(x, k), x)", "cn(x, k)"), Verdict::refuted);
  EXPECT_EQ(verdict_of("dn(x, k)", "-sqrt(1 - k^2*sn(x, k)^2)"), Verdict::refuted);
  EXPECT_EQ(verdict_of("sn(2*x, 1/2)", "2*sn(x, 1/2)"), Verdict::refuted);
  EXPECT_EQ(verdict_of("R_F(x, y, z)", "R_D(x, y, z)"), Verdict::refuted);
  EXPECT_EQ(verdict_of("R_D(x, y, z)", "R_D(y, z, x)"), Verdict::refuted);
  // True, and not known here.
  EXPECT_NE(verdict_of("sn(2*x, 1/2)*(1 - sn(x, 1/2)^4/4)", "2*sn(x, 1/2)*cn(x, 1/2)*dn(x, 1/2)"),
            Verdict::refuted);
  EXPECT_NE(verdict_of("R_F(x, x, x)", "1/sqrt(x)"), Verdict::refuted);
}

TEST(EllipticProofs, OfArgumentsThatAreEqualByARelationAreUndecided) {
  for (const char* f : {"R_F(cos(x)^2, 1 - sin(x)^2, 2)", "R_J(1, y, 2, cos(x)^2 + sin(x)^2)",
                        "R_F(x, y, cos(x)^2 + sin(x)^2 - 1)"})
    EXPECT_EQ(verdict_of(f, std::string(f) + " + x"), Verdict::undecided) << f;
}

/// sn(x, y) and sn(x, -y) are one function; what is not known of derivatives by the modulus is no
/// value that a rank could be taken of.
TEST(EllipticProofs, DerivativesByTheModulusMakeNothingIndependent) {
  const Model model = build_model(parse_case(R"toml(title = "t"
hamiltonian = "a"
[phase_space]
variables = ["x", "y", "a", "b"]
domain = ["y > 0", "y < 1"]
brackets = { "x,y" = "0", "a,b" = "1" }
[casimirs]
F = "sn(x, y)"
G = "sn(x, -y)"
)toml",
                                             "t.toml"));
  Candidates facts;
  facts.only = ClaimKind::independence;
  const std::vector<Proof> proofs = prove(model, facts);
  ASSERT_EQ(proofs.size(), 1U);
  EXPECT_EQ(proofs[0].verdict, Verdict::undecided);
}

TEST(EllipticNames, BelongToTheCaseThatHasThem) {
  const Model model = two_variables();
  EXPECT_THROW(read(model, "sn(x)"), CaseError);
  EXPECT_THROW(read(model, "sn(x, 3/2)"), CaseError);
  EXPECT_THROW(read(model, "diff(sn(x, y), y)"), CaseError);
  EXPECT_TRUE(read(model, "sn(x, 0)").is_equal(GiNaC::sin(model.variables[0])));
  const Model own = build_model(parse_case(
      "title = \"t\"\n[phase_space]\nvariables = [\"am\", \"sn\"]\n[equations]\nam = \"sn\"\n"
      "sn = \"-am\"\n",
      "t.toml"));
  EXPECT_TRUE(read(own, "am*sn").is_equal(own.variables[0] * own.variables[1]));
  EXPECT_THROW(read(own, "sn(am, 1/2)"), CaseError);
}

}  // namespace
}  // namespace casimir::test
