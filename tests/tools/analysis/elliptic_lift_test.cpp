// Enclosures of systems with elliptic functions, against Boost's values with fifty digits.
#include "tools/analysis/run/elliptic_lift.hpp"

#include <gtest/gtest.h>

#include <boost/math/quadrature/tanh_sinh.hpp>
#include <boost/math/special_functions/ellint_rd.hpp>
#include <boost/math/special_functions/ellint_rf.hpp>
#include <boost/math/special_functions/ellint_rj.hpp>
#include <boost/math/special_functions/jacobi_elliptic.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>

#include <cln/rational_io.h>

#include <sstream>

#include "symbolic/error.hpp"
#include "tests/tools/analysis/systems.hpp"

namespace casimir::test {
namespace {

using Big = boost::multiprecision::cpp_bin_float_50;

Big big(const cln::cl_RA& value) {
  const auto whole = [](const cln::cl_I& number) {
    std::ostringstream text;
    text << number;
    return Big(text.str());
  };
  return whole(cln::numerator(value)) / whole(cln::denominator(value));
}

void expect_contains(const RationalInterval& interval, const Big& value) {
  EXPECT_LE(big(interval.low), value);
  EXPECT_GE(big(interval.high), value);
}

ValidatedMotion motion_of(const Model& model, int digits = 0) {
  ValidatedOptions options;
  options.run.digits = digits;
  return enclose(model, model.scenes.front(), options);
}

/// In x and the time t, from x = 0 to t = 4.
ValidatedMotion driven(const std::string& rate, int digits = 0) {
  return motion_of(driven_equation(rate), digits);
}

TEST(EllipticLift, IntegralOfTheSineOfTheAmplitude) {
  const Big k = Big(4) / 5;
  Big cn, dn;
  boost::math::jacobi_elliptic(k, Big(4), &cn, &dn);
  const Big truth = log((dn - k * cn) / (1 - k)) / k;  // DLMF 22.14.1
  for (const int digits : {0, 30}) {
    const ValidatedMotion motion = driven("sn(t, 4/5)", digits);
    ASSERT_EQ(motion.run.status, ValidatedStatus::ok);
    ASSERT_EQ(motion.names, std::vector<std::string>{"x"});
    expect_contains(motion.run.end.states.at(0), truth);
    EXPECT_LT(motion.run.radius(), digits == 0 ? 1e-12 : 1e-28);
  }
}

TEST(EllipticLift, AmplitudesGrowOverWholeTurns) {
  const Big k = Big(9) / 10;
  // am' = dn, and the integral of k^2 sn cn is 1 - dn.
  const ValidatedMotion motion =
      driven("81/100*sn(2*t, 9/10)*cn(2*t, 9/10) + cos(am(t, 9/10)) - cn(t, 9/10)");
  ASSERT_EQ(motion.run.status, ValidatedStatus::ok);
  Big cn, dn;
  boost::math::jacobi_elliptic(k, Big(8), &cn, &dn);
  expect_contains(motion.run.end.states.at(0), (1 - dn) / 2);
}

TEST(EllipticLift, CarlsonsIntegrals) {
  using boost::math::ellint_rf;
  const ValidatedMotion second = driven("R_D(1, 2, 3 + t)");
  ASSERT_EQ(second.run.status, ValidatedStatus::ok);
  expect_contains(second.run.end.states.at(0),
                  -6 * (ellint_rf(Big(1), Big(2), Big(7)) - ellint_rf(Big(1), Big(2), Big(3))));
  boost::math::quadrature::tanh_sinh<Big> quadrature;
  const ValidatedMotion first = driven("R_F(1 + t, 9, 10 + t)");
  expect_contains(
      first.run.end.states.at(0),
      quadrature.integrate([](const Big& t) { return ellint_rf(1 + t, Big(9), 10 + t); }, Big(0),
                           Big(4)));
  const ValidatedMotion third = driven("R_J(1, 2 + t, 5 + t^2, 20 + t)");
  ASSERT_EQ(third.run.status, ValidatedStatus::ok);
  expect_contains(
      third.run.end.states.at(0),
      quadrature.integrate(
          [](const Big& t) { return boost::math::ellint_rj(Big(1), 2 + t, 5 + t * t, 20 + t); },
          Big(0), Big(4)));
  EXPECT_LT(third.run.radius(), 1e-11);
}

/// The further variables begin at what Arb says that they are.
TEST(EllipticLift, StartsContainTheValues) {
  const Model model = driven_equation("R_D(1, 2, 3 + t)");
  const EllipticLift lift = elliptic_lift(model, model.scenes.front(), {});
  ASSERT_EQ(lift.own, 1U);
  ASSERT_GT(lift.model.variables.size(), 1U);
  ASSERT_EQ(lift.radii.size(), lift.model.variables.size());
  EXPECT_EQ(lift.radii[0], 0);
  EXPECT_GT(lift.radii[1], 0);
  const cln::cl_RA middle =
      cln::the<cln::cl_RA>(GiNaC::ex_to<GiNaC::numeric>(lift.scene.initial[1]).to_cl_N());
  EXPECT_LT(abs(big(middle) - boost::math::ellint_rd(Big(1), Big(2), Big(3))), Big("1e-45"));
  EXPECT_FALSE(has_elliptic_functions(lift.model));
}

/// Wide starts: the corners of the box stay in the box.
TEST(EllipticLift, OfABoxContainsTheSolutionsFromItsCorners) {
  const Model model = one_equation("sn(x, 3/5)", "1");
  ValidatedOptions wide;
  wide.initial_radius = cln::cl_RA(1) / 1000;
  const ValidatedMotion all = enclose(model, model.scenes.front(), wide);
  ASSERT_EQ(all.run.status, ValidatedStatus::ok);
  EXPECT_LT(all.run.radius(), 0.01);
  for (const int side : {-1, 1}) {
    Scene corner = model.scenes.front();
    corner.initial[0] += GiNaC::numeric(side, 1000);
    const ValidatedMotion one = enclose(model, corner, {});
    EXPECT_LE(all.run.end.states[0].low, one.run.end.states[0].low);
    EXPECT_GE(all.run.end.states[0].high, one.run.end.states[0].high);
  }
}

/// x' = -R_F(x, 1, 2) reaches 0, where R_F has a branch point.
TEST(EllipticLift, EndsBeforeAnArgumentIsZero) {
  const ValidatedMotion motion = motion_of(one_equation("-R_F(x, 1, 2)", "10"));
  EXPECT_NE(motion.run.status, ValidatedStatus::ok);
  EXPECT_GT(motion.run.end.states.at(0).low, 0);
}

/// Where two of Carlson's arguments become equal, the derivative by them is 0/0 as it is written.
TEST(EllipticLift, EndsBeforeTwoArgumentsAreEqual) {
  const ValidatedMotion motion = driven("R_F(1 + t, 2, 30 + t)");
  EXPECT_NE(motion.run.status, ValidatedStatus::ok);
  EXPECT_LT(motion.run.end.time, 1);
  EXPECT_GT(motion.run.end.time, 0);
}

TEST(EllipticLift, RefusesWhatItHasNoDerivativeOf) {
  EXPECT_ANY_THROW(motion_of(one_equation("sn(1, x/2)", "1")));
  EXPECT_THROW(motion_of(one_equation("R_F(-x, 1, 2)", "1")), ModelError);
  EXPECT_THROW(motion_of(one_equation("R_D(x, x, x)", "1")), ModelError);
}

/// A proved integral with an elliptic function makes the box smaller.
TEST(EllipticLift, IsContractedByIntegrals) {
  const Model model = model_of(
      "title = \"t\"\nhamiltonian = \"p^2/2 + sn(q, 1/2)^2\"\n[phase_space]\nvariables = [\"q\", "
      "\"p\"]\ncanonical = true\n[[scene]]\nname = \"default\"\ninitial = { q = \"1\", p = \"1/2\" "
      "}\nduration = \"20\"\n");
  ValidatedOptions options;
  const ValidatedMotion with = enclose(model, model.scenes.front(), options);
  options.contract = false;
  const ValidatedMotion without = enclose(model, model.scenes.front(), options);
  EXPECT_EQ(with.run.contracted_by, std::vector<std::string>{"H"});
  EXPECT_TRUE(with.doubts.empty());
  EXPECT_LT(with.run.radius(), without.run.radius());
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_LE(with.run.end.states[i].low, without.run.end.states[i].high);
    EXPECT_GE(with.run.end.states[i].high, without.run.end.states[i].low);
  }
}

}  // namespace
}  // namespace casimir::test
