// Certificates of cycles: Newton's method in balls, with the derivatives of the flow enclosed.
#include "tools/analysis/certificate/cycle_certificate.hpp"

#include <cln/float.h>
#include <cln/real.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

#include "tools/analysis/certificate/certificate_file.hpp"

namespace casimir {
namespace {

/// Two oscillators; one of them is at rest, nearly.
std::string oscillators(const std::string& stiffness) {
  std::string text = R"toml(title = "Two"
[phase_space]
variables = ["x", "y", "u", "v"]
[equations]
x = "u"
y = "v"
u = "-x"
v = "-STIFF*y"
[integrals]
H = "(u^2 + v^2 + x^2 + STIFF*y^2)/2"
[[scene]]
name = "cycle"
initial = { x = "0", y = "1/1000000000000", u = "1", v = "0" }
duration = "6283185307179/1000000000000"
)toml";
  const std::string mark = "STIFF";
  for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark))
    text.replace(at, mark.size(), stiffness);
  return text;
}

const CycleCertificate& oscillation() {
  static const CycleCertificate certificate =
      certify_cycle("two", oscillators("2"), "x", {0.5}).value_or(CycleCertificate());
  return certificate;
}

CheckedCycle tampered(const std::function<void(CycleCertificate&)>& change) {
  CycleCertificate certificate = oscillation();
  change(certificate);
  return check_cycle(certificate);
}

TEST(CycleCertificates, OfAnOscillationIsChecked) {
  const CheckedCycle checked = check_cycle(oscillation());
  ASSERT_TRUE(checked.holds()) << checked.reason;
  const double low = cln::double_approx(checked.period.low);
  const double high = cln::double_approx(checked.period.high);
  EXPECT_LE(low - 1e-15, 2 * std::acos(-1.));
  EXPECT_GE(high + 1e-15, 2 * std::acos(-1.));
  EXPECT_LT(high - low, 1e-10);
  EXPECT_LE(checked.state[1].low, 0);
  EXPECT_GE(checked.state[1].high, 0);
  const std::string text =
      certificate_text(std::vector<CycleCertificate>{oscillation(), oscillation()});
  const CertificateFile read = read_certificate(text, "c.json");
  EXPECT_EQ(certificate_text(read.cycles), text);
  EXPECT_TRUE(check_cycle(read.cycles.back()).holds());
}

TEST(CycleCertificates, SayForWhichLevelTheyHold) {
  const CheckedCycle checked = check_cycle(oscillation());
  ASSERT_EQ(checked.level_names, std::vector<std::string>{"H"});
  ASSERT_EQ(checked.levels.size(), 1U);
  EXPECT_LT(checked.levels[0].low, cln::cl_RA(1) / 2);
  EXPECT_GT(checked.levels[0].high, cln::cl_RA(1) / 2);
}

TEST(CycleCertificates, ThatAreNotLookedThroughAreNotRefuted) {
  const CheckedCycle checked = check_cycle(oscillation(), [] { return true; });
  EXPECT_FALSE(checked.holds());
  EXPECT_TRUE(checked.stopped) << checked.reason;
}

TEST(CycleCertificates, NumbersBeyondAllExponentsAreMalformed) {
  for (const char* const number : {"0x1p-9223372036854775808", "0x1p9223372036854775807"})
    EXPECT_FALSE(is_traced_number(number)) << number;
  EXPECT_TRUE(is_traced_number("0x1p-1074"));
}

/// With stiffness 4 every orbit of the level closes after 2 pi: none is alone.
TEST(CycleCertificates, AMemberOfAFamilyHasNone) {
  EXPECT_FALSE(certify_cycle("two", oscillators("4"), "x", {0.5}));
}

/// A circle on which a third state grows, or not.
std::string circle(const std::string& rate, const std::string& constant) {
  return R"toml(title = "Circle"
[phase_space]
variables = ["x", "y", "s"]
[equations]
x = "-y"
y = "x"
s = ")toml" +
         rate + R"toml("
[integrals]
R = "sqrt(x^2 + y^2)"
A = ")toml" +
         constant + R"toml("
[[scene]]
name = "cycle"
initial = { x = "3/5", y = "4/5", s = "0" }
duration = "6283185307179586/1000000000000000"
)toml";
}

/// The angle of the state jumps where the third state has grown by as much as a turn.
TEST(CycleCertificates, AFunctionThatJumpsOnTheWayKeepsNoOrbitClosed) {
  const auto still = certify_cycle("circle", circle("0", "s"), "x - 3/5", {1, 0});
  ASSERT_TRUE(still);
  EXPECT_TRUE(check_cycle(*still).holds());
  // What is found is a certificate only where `check_cycle` accepts it.
  const std::string growing = circle("10^(-13)", "s - 10^(-13)*(atan2(y, x) - atan2(4, 3))");
  EXPECT_FALSE(certify_cycle("circle", growing, "x - 3/5", {1, 0}));
}

TEST(CycleCertificates, WhatIsNotTrueIsRefuted) {
  ASSERT_TRUE(check_cycle(oscillation()).holds());
  EXPECT_FALSE(tampered([](CycleCertificate& c) { c.levels[0] = "0x3p-2"; }).holds());
  EXPECT_FALSE(tampered([](CycleCertificate& c) { c.plane = "x - 1/1000"; }).holds());
  EXPECT_FALSE(tampered([](CycleCertificate& c) { c.inverse.assign(25, "0"); }).holds());
  EXPECT_FALSE(tampered([](CycleCertificate& c) { c.radius = "0x1p-60"; }).holds());
  EXPECT_FALSE(tampered([](CycleCertificate& c) { c.radius = "0"; }).holds());
  EXPECT_FALSE(tampered([](CycleCertificate& c) { c.closing = {0, 0, 1}; }).holds());
  EXPECT_FALSE(tampered([](CycleCertificate& c) { c.closing = {1, 2, 3}; }).holds());
  EXPECT_FALSE(tampered([](CycleCertificate& c) { c.equations = oscillators("4"); }).holds());
  EXPECT_FALSE(tampered([](CycleCertificate& c) { c.equations = oscillators("2.001"); }).holds());
  EXPECT_FALSE(
      tampered([](CycleCertificate& c) { c.point.steps.erase(c.point.steps.begin()); }).holds());
  EXPECT_FALSE(tampered([](CycleCertificate& c) { c.box = c.point; }).holds());
  EXPECT_FALSE(tampered([](CycleCertificate& c) { c.point = c.box; }).holds());
  // The level is kept by no more than what is proved.
  EXPECT_FALSE(tampered([](CycleCertificate& c) {
                 c.equations.replace(c.equations.find("H = \"("), 6, "H = \"(x + ");
               }).holds());
}

}  // namespace
}  // namespace casimir
