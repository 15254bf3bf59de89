#include "runtime/reference.hpp"

#include <cln/float_io.h>
#include <cln/input.h>
#include <cln/real_io.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <functional>

#include "tests/runtime/programs.hpp"
#include "tests/runtime/systems.hpp"

namespace casimir::test {
namespace {

cln::cl_F decimal_number(const std::string& text) {
  const cln::float_format_t format = cln::float_format(60);
  const cln::cl_read_flags flags = {
      cln::syntax_float, cln::lsyntax_standard, 10, {format, format, false}};
  return cln::cl_float(cln::read_float(flags, text.c_str(), nullptr, nullptr), format);
}

double difference(const cln::cl_F& a, const cln::cl_F& b) {
  return std::abs(cln::double_approx(cln::cl_F(a - b)));
}

const std::vector<cln::cl_R> kStart = {1, cln::cl_RA("1/2"), cln::cl_RA("1/4"), cln::cl_RA("3/5"),
                                       0, cln::cl_RA("4/5")};

TEST(Reference, KovalevskayaTopToThirtyDigits) {
  const auto begin = std::chrono::steady_clock::now();
  const Reference reference = reference_solution(kovalevskaya_program(), kStart, 100, 30);
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  RecordProperty("seconds", std::to_string(seconds));
  ASSERT_TRUE(reference.reached) << reference.reason;
  EXPECT_LT(reference.error_bound, 1e-28);
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_LT(difference(reference.state[i], decimal_number(Kovalevskaya::kReference[i])), 1e-30)
        << i;
  // The twin: a start that differs in the 29th digit is seen.
  std::vector<cln::cl_R> bent = kStart;
  bent[0] = 1 + cln::cl_RA("1/10000000000000000000000000000");
  const Reference other = reference_solution(kovalevskaya_program(), bent, 100, 30);
  EXPECT_GT(difference(other.state[0], decimal_number(Kovalevskaya::kReference[0])), 1e-29);
}

TEST(Reference, GoesBackwardInTime) {
  const Reference there = reference_solution(kovalevskaya_program(), kStart, 20, 30);
  const Reference back =
      reference_solution(kovalevskaya_program(), {there.state.begin(), there.state.end()}, -20, 30);
  ASSERT_TRUE(back.reached);
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_LT(std::abs(cln::double_approx(cln::cl_R(back.state[i] - kStart[i]))), 1e-28);
  const Reference nowhere = reference_solution(kovalevskaya_program(), kStart, 0, 30);
  ASSERT_TRUE(nowhere.reached);
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_LT(std::abs(cln::double_approx(cln::cl_R(nowhere.state[i] - kStart[i]))), 1e-30);
}

TEST(Reference, PoleIsRefused) {
  Builder b({"x"});
  b.output(b.op(Op::mul, 0, 0));
  const Reference beyond = reference_solution(b.program(), {1}, 2, 25);
  EXPECT_FALSE(beyond.reached);
  EXPECT_FALSE(beyond.reason.empty());
  EXPECT_NEAR(cln::double_approx(beyond.time), 1, 1e-9);
  const Reference before = reference_solution(b.program(), {1}, cln::cl_RA("1/2"), 25);
  ASSERT_TRUE(before.reached);
  EXPECT_LT(difference(before.state[0], decimal_number("2.0")), 1e-24);
}

// Every unit of time along x' = 5x - z, z' = -z costs 2.6 digits of x: they are asked for again.
TEST(Reference, LostDigitsAreMadeUpFor) {
  Builder b({"x", "y", "z"});
  const int five = b.number(5);
  b.output(b.op(Op::sub, b.op(Op::mul, five, 0), 2));
  b.output(b.op(Op::neg, 1));
  b.output(b.op(Op::neg, 2));
  // x = z0 e^-t / 6 for x0 = z0 / 6: an unstable balance, lost to any error.
  const Reference reference =
      reference_solution(b.program(), {cln::cl_RA("1/18"), 1, cln::cl_RA("1/3")}, 30, 25);
  ASSERT_TRUE(reference.reached);
  EXPECT_LT(reference.error_bound, 1e-25);
  EXPECT_GT(reference.digits, 60);
  const cln::cl_F truth = cln::exp(cln::cl_float(-30, cln::float_format(60))) / 18;
  EXPECT_LT(difference(reference.state[0] / truth, decimal_number("1.0")), 1e-20);
}

TEST(Reference, StopsWhenAsked) {
  int asked = 0;
  const Reference stopped = reference_solution(kovalevskaya_program(), kStart, 1000000, 30, {},
                                               [&] { return ++asked > 3; });
  EXPECT_FALSE(stopped.reached);
  EXPECT_EQ(stopped.reason, reason_of(Status::stopped));
}

// Scales far from one cost nothing but a shift of exponents.
TEST(Reference, ScaleOfTheStateDoesNotMatter) {
  Builder b({"x"});
  b.output(b.op(Op::mul, 0, 0));
  const cln::cl_RA huge = cln::expt(cln::cl_I(10), 150);
  const Reference reference = reference_solution(b.program(), {huge}, 1 / (2 * huge), 25);
  ASSERT_TRUE(reference.reached);
  EXPECT_LT(std::abs(cln::double_approx(cln::cl_R(reference.state[0] / huge - 2))), 1e-24);
}

/// A system x' = f(x, t) whose solution is known, one for each operation.
struct Rule {
  const char* name;
  std::function<int(Builder&)> slope;                   ///< the line of x'
  cln::cl_RA start;                                     ///< x(0)
  std::function<cln::cl_F(const cln::cl_F&)> solution;  ///< of t
};

cln::cl_F real(const cln::cl_RA& a, const cln::cl_F& like) { return cln::cl_float(a, like); }

const Rule kRules[] = {
    // x' = 1/x, x = sqrt(1 + 2t)
    {"div", [](Builder& b) { return b.op(Op::div, b.number(1), 0); }, 1,
     [](const cln::cl_F& t) { return cln::sqrt(real(1, t) + 2 * t); }},
    // x' = sqrt(x), x = (1 + t/2)^2
    {"sqrt", [](Builder& b) { return b.op(Op::sqrt, 0); }, 1,
     [](const cln::cl_F& t) { return cln::square(real(1, t) + t / 2); }},
    // x' = x^(1/3), x = (1 + 2t/3)^(3/2)
    {"pow", [](Builder& b) { return b.op(Op::pow, 0, b.number(cln::cl_RA("1/3"))); }, 1,
     [](const cln::cl_F& t) {
       const cln::cl_F y = real(1, t) + t * 2 / 3;
       return y * cln::sqrt(y);
     }},
    // x' = exp(-x), x = log(1 + t)
    {"exp", [](Builder& b) { return b.op(Op::exp, b.op(Op::neg, 0)); }, 0,
     [](const cln::cl_F& t) { return cln::ln(real(1, t) + t); }},
    // x' = x log x, from 2: x = 2^(e^t)
    {"log", [](Builder& b) { return b.op(Op::mul, 0, b.op(Op::log, 0)); }, 2,
     [](const cln::cl_F& t) { return cln::exp(cln::ln(real(2, t)) * cln::exp(t)); }},
    // x' = cos(t^2) * 2t, x = sin(t^2)
    {"cos",
     [](Builder& b) {
       const int t = b.time();
       return b.op(Op::mul, b.op(Op::add, t, t), b.op(Op::cos, b.op(Op::mul, t, t)));
     },
     0, [](const cln::cl_F& t) { return cln::cl_float(cln::sin(t * t), t); }},
    // x' = -sin(t^2) * 2t, x = cos(t^2)
    {"sin",
     [](Builder& b) {
       const int t = b.time();
       return b.op(Op::neg, b.op(Op::mul, b.op(Op::add, t, t), b.op(Op::sin, b.op(Op::mul, t, t))));
     },
     1, [](const cln::cl_F& t) { return cln::cl_float(cln::cos(t * t), t); }},
    // x' = tan t * x, x = 1/cos t
    {"tan", [](Builder& b) { return b.op(Op::mul, 0, b.op(Op::tan, b.time())); }, 1,
     [](const cln::cl_F& t) { return real(1, t) / cln::cl_float(cln::cos(t), t); }},
    // x' = x tanh t, x = cosh t
    {"tanh", [](Builder& b) { return b.op(Op::mul, 0, b.op(Op::tanh, b.time())); }, 1,
     [](const cln::cl_F& t) { return cln::cl_float(cln::cosh(t), t); }},
    // x' = sinh t, x = cosh t from 1
    {"sinh", [](Builder& b) { return b.op(Op::sinh, b.time()); }, 1,
     [](const cln::cl_F& t) { return cln::cl_float(cln::cosh(t), t); }},
    // x' = 1/cosh x, x = log(t + sqrt(1 + t^2))
    {"cosh", [](Builder& b) { return b.op(Op::div, b.number(1), b.op(Op::cosh, 0)); }, 0,
     [](const cln::cl_F& t) { return cln::ln(t + cln::sqrt(real(1, t) + t * t)); }},
    // x' = asin(t/2): x = t asin(t/2) + sqrt(4 - t^2) - 2
    {"asin", [](Builder& b) { return b.op(Op::asin, b.op(Op::div, b.time(), b.number(2))); }, 0,
     [](const cln::cl_F& t) {
       const cln::cl_F root = cln::sqrt(real(4, t) - t * t);
       return t * cln::cl_float(cln::atan(root, t), t) + root - real(2, t);
     }},
    // x' = acos(t/2): x = t acos(t/2) - sqrt(4 - t^2) + 2
    {"acos", [](Builder& b) { return b.op(Op::acos, b.op(Op::div, b.time(), b.number(2))); }, 0,
     [](const cln::cl_F& t) {
       const cln::cl_F root = cln::sqrt(real(4, t) - t * t);
       return t * cln::cl_float(cln::atan(t, root), t) - root + real(2, t);
     }},
    // x' = atan2(t, 1 + t): checked through x' at the end, see below; x = integral of atan(t/(1+t))
    // with atan(t/(1+t)) = atan(1 + 2t) - pi/4, whose integral is
    // ((1+2t) atan(1+2t) - log(1 + (1+2t)^2)/2)/2 - pi t/4 + const
    {"atan2",
     [](Builder& b) { return b.op(Op::atan2, b.time(), b.op(Op::add, b.number(1), b.time())); }, 0,
     [](const cln::cl_F& t) {
       const auto part = [&](const cln::cl_F& u) -> cln::cl_F {
         const cln::cl_F angle = cln::cl_float(cln::atan(u), t);
         return (u * angle - cln::ln(real(1, t) + u * u) / 2) / 2;
       };
       return part(real(1, t) + 2 * t) - part(real(1, t)) - cln::pi(cln::float_format(t)) * t / 4;
     }},
    // x' = Pi x
    {"pi", [](Builder& b) { return b.op(Op::mul, b.op(Op::pi), 0); }, 1,
     [](const cln::cl_F& t) { return cln::exp(cln::pi(cln::float_format(t)) * t); }},
};

class Jet : public testing::TestWithParam<Rule> {};

TEST_P(Jet, RuleAgreesWithTheClosedFormToFiftyDigits) {
  Builder b({"x"});
  b.output(GetParam().slope(b));
  const cln::cl_RA end("9/10");
  const Reference reference = reference_solution(b.program(), {GetParam().start}, end, 50);
  ASSERT_TRUE(reference.reached) << reference.reason;
  const cln::float_format_t format = cln::float_format(70);
  const cln::cl_F truth = GetParam().solution(cln::cl_float(end, format));
  EXPECT_LT(difference(reference.state[0], truth), 1e-49);
  // The twin: another time is another value.
  const cln::cl_F later = GetParam().solution(cln::cl_float(end + cln::cl_RA("1/1000000"), format));
  EXPECT_GT(difference(reference.state[0], later), 1e-8);
}
INSTANTIATE_TEST_SUITE_P(Runtime, Jet, testing::ValuesIn(kRules),
                         [](const auto& one) { return std::string(one.param.name); });

}  // namespace
}  // namespace casimir::test
