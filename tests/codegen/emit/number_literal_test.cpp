#include "codegen/emit/number_literal.hpp"

#include <cln/dfloat.h>
#include <cln/float.h>
#include <cln/integer.h>
#include <cln/real.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>

#include "codegen/emit/identifiers.hpp"
#include "symbolic/case/limits.hpp"
#include "symbolic/error.hpp"
#include "tests/codegen/support.hpp"

namespace casimir::codegen {
namespace {

cln::cl_RA ten_to(int exponent) { return cln::expt(cln::cl_RA(10), exponent); }
cln::cl_RA two_to(int exponent) { return cln::expt(cln::cl_RA(2), exponent); }

TEST(Literal, RoundsToNearestAndTiesToEven) {
  EXPECT_EQ(nearest<double>(cln::cl_RA(1) / 3), 1.0 / 3);
  EXPECT_EQ(nearest<double>(cln::cl_RA(-1) / 10), -0.1);
  EXPECT_EQ(nearest<double>(two_to(53) + 1), 0x1p53);      // tie, down to even
  EXPECT_EQ(nearest<double>(two_to(53) + 3), 0x1p53 + 4);  // tie, up to even
  EXPECT_EQ(nearest<double>(two_to(53) + 1 + two_to(-60)), 0x1p53 + 2);
  EXPECT_EQ(nearest<double>(two_to(54) - 1), 0x1p54);  // the mantissa carries
  EXPECT_EQ(nearest<float>(cln::cl_RA(1) / 10), 0.1f);
  EXPECT_EQ(nearest<long double>(cln::cl_RA(1) / 10), 0.1L);
  EXPECT_EQ(nearest<long double>(two_to(64) - cln::cl_RA(1) / 4), 0x1p64L);
}

TEST(Literal, DenormalNumbersAreRoundedOnce) {
  const double least = std::numeric_limits<double>::denorm_min();
  EXPECT_EQ(nearest<double>(two_to(-1074)), least);
  EXPECT_EQ(nearest<double>(two_to(-1075) * 3), 2 * least);  // tie between 1 and 2, to even
  EXPECT_EQ(nearest<double>(two_to(-1075) + two_to(-1200)), least);
  EXPECT_THROW(nearest<double>(two_to(-1075)), ModelError);  // tie, to zero
  EXPECT_EQ(nearest<double>(3 * ten_to(-310)), 3e-310);
  EXPECT_EQ(nearest<double>(two_to(-1022) - two_to(-1076)), 0x1p-1022);
}

TEST(Literal, NumbersOutsideTheRangeAreErrors) {
  EXPECT_EQ(nearest<double>(ten_to(308)), 1e308);
  EXPECT_THROW(nearest<double>(ten_to(309)), ModelError);
  EXPECT_THROW(nearest<double>(ten_to(400)), ModelError);
  EXPECT_THROW(nearest<double>(ten_to(-400)), ModelError);
  EXPECT_THROW(nearest<float>(ten_to(39)), ModelError);
  EXPECT_EQ(nearest<double>(two_to(1024) - two_to(971)), std::numeric_limits<double>::max());
  EXPECT_THROW(nearest<double>(two_to(1024) - two_to(970)), ModelError);  // rounds to infinity
}

TEST(Literal, TextReadsBackAsTheNearestDouble) {
  casimir::testing::Points points;
  for (int i = 0; i < 2000; ++i) {
    const cln::cl_RA value = points.next() / (points.next() * 3) * two_to(i % 400 - 200);
    const std::string text = number_text(value, Scalar::real64).text;
    EXPECT_EQ(std::strtod(text.c_str(), nullptr), nearest<double>(value)) << text;
    // One unit further is another number.
    EXPECT_NE(std::strtod(text.c_str(), nullptr), std::nextafter(nearest<double>(value), 1e300));
  }
}

TEST(Literal, TextIsAFloatingLiteralUnlessItIsASmallInteger) {
  EXPECT_EQ(number_text(2, Scalar::real64).text, "2");
  EXPECT_EQ(number_text(-7, Scalar::real64).text, "-7");
  EXPECT_EQ(number_text(two_to(40), Scalar::real64).text, "1099511627776.0");
  EXPECT_EQ(number_text(ten_to(300), Scalar::real64).text, "1e+300");
  EXPECT_EQ(number_text(cln::cl_RA(1) / 2, Scalar::real64).text, "0.5");
  EXPECT_TRUE(number_text(cln::cl_RA(1) / 2, Scalar::real64).is_plain);
  const NumberText third = number_text(cln::cl_RA(1) / 3, Scalar::real64);
  EXPECT_EQ(third.text, "0.3333333333333333");
  EXPECT_EQ(third.comment, "1/3");
  EXPECT_EQ(number_text(cln::cl_RA(1) / 10, Scalar::real64).is_plain, true);
  EXPECT_EQ(number_text(cln::cl_RA(1) / 4, Scalar::real32).text, "0.25f");
  EXPECT_EQ(number_text(cln::cl_RA(1) / 4, Scalar::long_double).text, "0.25L");
  EXPECT_EQ(number_text(cln::cl_RA(1) / 3, Scalar::templated).text, "Real(1) / 3");
}

TEST(Literal, WideNumbersAreSumsOfWhatDoublesAreAndNotOfTheirDecimals) {
  Program p;
  p.code = {{Op::pi}};
  for (const cln::cl_RA& value :
       {constant_value(p, 0, {}), 3 * two_to(100) + 1, ten_to(40) + 12345,
        cln::cl_RA(1) / ten_to(40), (ten_to(45) + 1) / (3 * ten_to(14) + 7),
        (ten_to(20) + 1) / ten_to(320)}) {
    for (const Scalar scalar : {Scalar::float128, Scalar::templated}) {
      const std::string text = number_text(value, scalar, "wide").text;
      cln::cl_RA sum = 0;
      for (std::size_t at = text.find('('); at != std::string::npos; at = text.find('(', at + 1))
        sum = sum + cln::rational(cln::cl_DF(std::strtod(text.c_str() + at + 1, nullptr)));
      const cln::cl_RA error = cln::abs(sum - value);
      EXPECT_LT(error, cln::abs(value) / two_to(115) + 1 / two_to(1022)) << text;
    }
  }
}

TEST(Literal, IrrationalConstantsAreRoundedFromManyDigits) {
  Program p;
  p.constants = {2, 10, ten_to(60) + 1, ten_to(30)};
  p.code = {{Op::constant, 0}, {Op::sqrt, 0}, {Op::pi},          {Op::mul, 1, 2},
            {Op::constant, 2}, {Op::sqrt, 4}, {Op::constant, 3}, {Op::sub, 5, 6}};
  EXPECT_EQ(nearest<double>(constant_value(p, 1, {})), std::sqrt(2.0));
  EXPECT_EQ(nearest<double>(constant_value(p, 2, {})), std::acos(-1.0));
  EXPECT_EQ(nearest<double>(constant_value(p, 3, {})), 4.442882938158366);
  // sqrt(10^60 + 1) - 10^30 = 5e-31 - ..: sixty digits are not enough for it.
  EXPECT_EQ(nearest<double>(constant_value(p, 7, {})), 5e-31);
  EXPECT_EQ(constant_text(p, 3), "sqrt(2)*Pi");
  p.code = {{Op::constant, 0}, {Op::neg, 0}, {Op::log, 1}};
  EXPECT_THROW(constant_value(p, 2, {}), ModelError);
}

TEST(Literal, ConstantsAreHeldToTheLimitsOfTheirCase) {
  Program p;
  p.constants = {50};
  p.code = {{Op::constant, 0}, {Op::exp, 0}};  // of 73 bits
  Limits limits;
  limits.bits = 72;
  limits.how_to_raise = "see '{}'";
  for (int turn = 0; turn < 2; ++turn) {
    EXPECT_DOUBLE_EQ(nearest<double>(constant_value(p, 1, {})), std::exp(50.));
    try {
      constant_value(p, 1, limits);
      FAIL();
    } catch (const TooLarge& error) {
      EXPECT_EQ(error.limit(), &Limits::bits);
      EXPECT_STREQ(error.what(), "the constant exp(50) has more than 72 bits; see 'bits'");
    }
  }
}

TEST(Names, AreNoMacrosOfCommonHeaders) {
  Names names;
  for (const char* macro :
       {"DBL_MAX", "FLT_EPSILON", "INT32_MAX", "RAND_MAX", "FP_ILOGB0", "EDOM", "M_PIl", "M_LN2f64",
        "MATH_ERRNO", "MAXFLOAT", "math_errhandling", "CLOCKS_PER_SEC"})
    EXPECT_EQ(names.unique(macro), std::string(macro) + "_");
  for (const char* own : {"SIGMA", "EPS", "OMEGA_1", "KEPLER_2D", "INERTIA", "E1", "INTEGRAL_A",
                          "TIME_0", "LONG_1", "M_1", "M_total"})
    EXPECT_EQ(names.unique(own), own);
}

TEST(Names, OfHeadersAreNoFunctionsOfOthers) {
  for (const char* name : {"random", "time", "select", "round", "sin"})
    EXPECT_THROW(check_header_name(name), ModelError) << name;
  check_header_name("random_top");
  check_header_name("random", false);  // of C, where it is random_rhs
  for (const std::string& name : global_functions())
    EXPECT_EQ(Names(global_functions()).unique(name), name + "_");
}

TEST(Names, ClashesAreResolvedInOrder) {
  Names names;
  EXPECT_EQ(names.unique("M1"), "M1");
  EXPECT_EQ(names.unique("int"), "int_");
  EXPECT_EQ(names.unique("x"), "x_");
  EXPECT_EQ(names.unique("x_"), "x_2");
  EXPECT_EQ(names.unique("t1"), "t1_");
  EXPECT_EQ(names.unique("c17"), "c17_");
  EXPECT_EQ(names.unique("I"), "I_");
  EXPECT_EQ(names.unique("_Reserved"), "Reserved");
  EXPECT_EQ(names.unique("a__b"), "a_b");
  EXPECT_EQ(names.unique("a_b"), "a_b_");
  EXPECT_EQ(names.unique("2body"), "v2body");
  EXPECT_EQ(names.unique("e(3)"), "e_3_");
  EXPECT_EQ(names.unique(""), "v");
}

TEST(Names, CommentsCannotBeLeft) {
  EXPECT_EQ(comment_text("a */ b /* c // d"), "a * / b / * c / / d");
  EXPECT_EQ(comment_text("a\n#include <x>"), "a #include <x>");
  EXPECT_EQ(comment_text("end \\"), "end |");
  EXPECT_EQ(comment_text("what?"
                         "?/"),
            "what? ?/");
  EXPECT_EQ(comment_text("Poincar\xc3\xa9"), "Poincar..");
  EXPECT_EQ(string_literal("a\"b\\\n"), "\"a\\042b\\134\\012\"");
}

}  // namespace
}  // namespace casimir::codegen
