// Certificates of runs: what is true is checked, what was tampered with is not.
#include "tools/analysis/certificate/certificate_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <random>

namespace casimir {
namespace {

/// The heavy top with K = (M1^2 - M2^2 + 2 g1)^2 + (2 M1 M2 + 2 g2)^2.
constexpr const char* kTop = R"toml(title = "Top"
[phase_space]
variables = ["M1", "M2", "M3", "g1", "g2", "g3"]
[equations]
M1 = "M2*M3"
M2 = "-M1*M3 - g3"
M3 = "g2"
g1 = "2*g2*M3 - g3*M2"
g2 = "g3*M1 - 2*g1*M3"
g3 = "g1*M2 - g2*M1"
[integrals]
H = "(M1^2 + M2^2 + 2*M3^2)/2 - g1"
F1 = "g1^2 + g2^2 + g3^2"
F2 = "M1*g1 + M2*g2 + M3*g3"
[[scene]]
name = "default"
initial = { M1 = "1", M2 = "1/2", M3 = "1/3", g1 = "3/5", g2 = "0", g3 = "4/5" }
duration = "2"
)toml";

/// dx/dt = sin(t) / (1 + x^2) + exp(-sqrt(1 + y^2)), dy/dt = atan2(x, 2) - cos(y) + tanh(x)
constexpr const char* kFunctions = R"toml(title = "Functions"
[phase_space]
variables = ["x", "y"]
time = "t"
[equations]
x = "sin(t)/(1 + x^2) + exp(-sqrt(1 + y^2)) + log(3 + cosh(y))/4"
y = "atan2(x, 2 + y^2) - cos(y) + tanh(x) + asin(y/(9 + y^2)) + (4 + x^2)^(1/3) - tan(x/(5 + x^2))"
[[scene]]
name = "default"
initial = { x = "sqrt(2)", y = "-1/7" }
duration = "Pi/8"
)toml";

RunCertificate certified(const std::string& equations, std::vector<cln::cl_RA> radii = {},
                         int digits = 0) {
  RunCertificate certificate;
  certificate.of_case = "top";
  certificate.scene = "default";
  certificate.equations = equations;
  certificate.radii = std::move(radii);
  const Model model = model_of_certificate(certificate);
  ValidatedOptions options;
  options.radii = certificate.radii;
  options.run.trace = &certificate.trace;
  options.run.digits = digits;
  EXPECT_EQ(enclose(model, model.scenes.front(), options).run.status, ValidatedStatus::ok);
  return certificate;
}

const RunCertificate& of_a_point() {
  static const RunCertificate certificate = certified(kTop);
  return certificate;
}
const RunCertificate& of_a_box() {
  static const RunCertificate certificate =
      certified(kTop, std::vector<cln::cl_RA>(6, cln::cl_RA(1) / 1000000));
  return certificate;
}

TraceFault fault_of(const RunCertificate& certificate) {
  return check_certificate(certificate).check.fault;
}

/// The certificate with one thing changed.
RunCertificate changed(RunCertificate certificate, const std::function<void(RunTrace&)>& change) {
  change(certificate.trace);
  return certificate;
}

RunCertificate with_text(RunCertificate certificate, const std::string& from,
                         const std::string& to) {
  const std::size_t place = certificate.equations.find(from);
  EXPECT_NE(place, std::string::npos) << from;
  certificate.equations.replace(place, from.size(), to);
  return certificate;
}

double value_of(const std::string& text) { return std::strtod(text.c_str(), nullptr); }

std::string text_of(double value) {
  if (value == 0) return "0";
  int exponent = 0;
  const double share = std::frexp(std::abs(value), &exponent);
  char text[64];
  std::snprintf(text, sizeof text, "%s0x%llxp%d", value < 0 ? "-" : "",
                static_cast<unsigned long long>(std::ldexp(share, 53)), exponent - 53);
  return text;
}

TEST(RunCertificate, OfARunIsChecked) {
  for (const RunCertificate* certificate : {&of_a_point(), &of_a_box()}) {
    const CheckedCertificate checked = check_certificate(*certificate);
    ASSERT_TRUE(checked.holds()) << static_cast<int>(checked.check.fault) << " in step "
                                 << checked.check.step;
    EXPECT_EQ(checked.integrals, (std::vector<std::string>{"H", "F1", "F2"}));
    EXPECT_EQ(checked.check.used, checked.integrals);
  }
  EXPECT_LT(check_certificate(of_a_point()).radius, cln::cl_RA(1) / 100000000000000);
}

TEST(RunCertificate, OfAllFunctionsAndOfManyDigitsIsChecked) {
  EXPECT_EQ(fault_of(certified(kFunctions)), TraceFault::none);
  EXPECT_EQ(fault_of(certified(kFunctions, {cln::cl_RA(1) / 10000, 0})), TraceFault::none);
  EXPECT_EQ(fault_of(certified(kFunctions, {}, 30)), TraceFault::none);
}

TEST(RunCertificate, ReadsBackAsItWasWritten) {
  for (const RunCertificate* certificate : {&of_a_point(), &of_a_box()}) {
    const std::string text = certificate_text(*certificate);
    const CertificateFile read = read_certificate(text, "c.json");
    ASSERT_TRUE(read.run);
    EXPECT_EQ(certificate_text(*read.run), text);
    EXPECT_EQ(fault_of(*read.run), TraceFault::none);
  }
}

TEST(RunCertificate, OneUlpLessThanTheBoxAtTheEndIsRefuted) {
  for (const RunCertificate* certificate : {&of_a_point(), &of_a_box()}) {
    for (std::size_t i = 0; i < 6; ++i) {
      for (const std::size_t side : {0U, 1U}) {
        const auto narrower = [&](RunTrace& trace) {
          std::string& end = trace.end[i][side];
          end = text_of(std::nextafter(value_of(end), side == 0 ? INFINITY : -INFINITY));
        };
        EXPECT_EQ(fault_of(changed(*certificate, narrower)), TraceFault::end);
      }
    }
  }
}

TEST(RunCertificate, ASmallerRadiusIsRefutedInItsStep) {
  const std::size_t steps = of_a_box().trace.steps.size();
  ASSERT_GT(steps, 4U);
  for (const std::size_t step : {std::size_t{0}, steps / 2, steps - 1}) {
    for (std::size_t i = 0; i < 6; ++i) {
      const CheckedCertificate zero = check_certificate(
          changed(of_a_point(), [&](RunTrace& trace) { trace.steps[step].after.rest[i] = "0"; }));
      EXPECT_EQ(zero.check.fault, TraceFault::outside);
      EXPECT_EQ(zero.check.step, step + 1);
    }
  }
  // Of a box there is no more room than rounding.
  const CheckedCertificate start = check_certificate(changed(of_a_box(), [](RunTrace& trace) {
    trace.off[2] = text_of(value_of(trace.off[2]) * (1 - 1e-7));
  }));
  EXPECT_EQ(start.check.fault, TraceFault::start);
}

TEST(RunCertificate, AMovedSetIsRefutedInItsStep) {
  for (const double by : {1e-12, -1e-12}) {
    const CheckedCertificate moved = check_certificate(changed(of_a_point(), [&](RunTrace& trace) {
      std::string& x = trace.steps[3].after.middle[1];
      x = text_of(value_of(x) + by);
    }));
    EXPECT_EQ(moved.check.fault, TraceFault::outside);
    EXPECT_EQ(moved.check.step, 4U);
  }
  EXPECT_EQ(fault_of(changed(of_a_box(),
                             [](RunTrace& trace) {
                               std::string& c = trace.steps[2].after.carried[7];
                               c = text_of(value_of(c) + 1e-3);
                             })),
            TraceFault::outside);
}

TEST(RunCertificate, ADroppedStepIsRefuted) {
  const std::size_t steps = of_a_point().trace.steps.size();
  for (std::size_t k = 0; k + 1 < steps; ++k) {
    const TraceFault fault = fault_of(changed(of_a_point(), [&](RunTrace& trace) {
      trace.steps.erase(trace.steps.begin() + static_cast<std::ptrdiff_t>(k));
    }));
    EXPECT_NE(fault, TraceFault::none) << k;
  }
  const TraceFault last =
      fault_of(changed(of_a_point(), [](RunTrace& trace) { trace.steps.pop_back(); }));
  EXPECT_NE(last, TraceFault::none);
}

TEST(RunCertificate, OtherEquationsDataOrDurationAreRefuted) {
  EXPECT_EQ(check_certificate(with_text(of_a_point(), "M2*M3", "2*M2*M3")).unproved, "H");
  RunCertificate bare = of_a_point();
  bare.equations.erase(bare.equations.find("[integrals]"),
                       bare.equations.find("[[scene]]") - bare.equations.find("[integrals]"));
  for (TracedStep& step : bare.trace.steps) step.columns.clear();
  EXPECT_EQ(fault_of(with_text(bare, "M2*M3", "2*M2*M3")), TraceFault::outside);
  EXPECT_EQ(fault_of(with_text(of_a_point(), "M2 = \"1/2\"", "M2 = \"1/2 + 10^(-15)\"")),
            TraceFault::start);
  EXPECT_NE(fault_of(with_text(of_a_point(), "duration = \"2\"", "duration = \"2 + 10^(-9)\"")),
            TraceFault::none);
  EXPECT_EQ(fault_of(with_text(of_a_point(), "duration = \"2\"", "duration = \"1\"")),
            TraceFault::time);
  // A false integral would make every set thin.
  EXPECT_EQ(check_certificate(with_text(of_a_point(), "F1 = \"g1^2", "F1 = \"2*g1^2")).unproved,
            "F1");
}

TEST(RunCertificate, ARoughEnclosureThatIsNoneIsRefuted) {
  EXPECT_EQ(fault_of(changed(of_a_point(), [](RunTrace& trace) { trace.steps[1].room = -300; })),
            TraceFault::not_enclosed);
  EXPECT_EQ(fault_of(changed(of_a_point(), [](RunTrace& trace) { trace.order = 6; })),
            TraceFault::not_enclosed);
  EXPECT_EQ(fault_of(changed(of_a_point(),
                             [](RunTrace& trace) {
                               for (std::string& b : trace.steps[1].after.frame) b = "0";
                             })),
            TraceFault::frame);
}

/// Whatever is changed: what is accepted is true. x = 1/(1 - t) is 5 at t = 4/5.
TEST(RunCertificate, NothingFalseIsAccepted) {
  const RunCertificate grown = certified(R"toml(title = "Riccati"
[phase_space]
variables = ["x", "y"]
[equations]
x = "x^2"
y = "x*y"
[[scene]]
name = "default"
initial = { x = "1", y = "1" }
duration = "4/5"
)toml");
  ASSERT_EQ(fault_of(grown), TraceFault::none);
  std::mt19937 random(11);
  const auto below = [&](std::size_t n) {
    return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
  };
  int refuted = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const CheckedCertificate checked = check_certificate(changed(grown, [&](RunTrace& trace) {
      TracedStep& step = trace.steps[below(trace.steps.size())];
      std::vector<std::string>* lists[] = {&step.after.middle, &step.after.rest, &step.after.frame,
                                           &trace.middle, &trace.off};
      std::vector<std::string>& list = *lists[below(5)];
      std::string& number = list[below(list.size())];
      const double value = value_of(number), size = std::ldexp(1., -static_cast<int>(below(60)));
      number = text_of(below(2) == 0 ? value * (1 + size) : value * (1 - size));
      for (std::array<std::string, 2>& end : trace.end)  // as narrow as the last set allows
        end = {text_of(value_of(end[0]) - 1e-9), text_of(value_of(end[1]) + 1e-9)};
    }));
    if (!checked.holds()) {
      ++refuted;
      continue;
    }
    for (const RationalInterval& x : checked.check.end) {
      EXPECT_LE(x.low, 5);
      EXPECT_GE(x.high, 5);
    }
  }
  EXPECT_GT(refuted, 50);
}

// --- files of strangers

std::string error_of(const std::string& text) {
  try {
    read_certificate(text, "c.json");
  } catch (const CaseError& problem) {
    return problem.what();
  }
  return "nothing";
}

/// Without its digest, so that it can be given another one.
std::string body() {
  const std::string text = certificate_text(of_a_point());
  return text.substr(0, text.rfind(",\n\"digest\""));
}

TEST(RunCertificate, AFileThatWasChangedOrCutIsMalformed) {
  const std::string text = certificate_text(of_a_point());
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, text.size() / 2, text.size() - 1})
    EXPECT_NE(error_of(text.substr(0, size)).find("the file is not complete"), std::string::npos);
  std::string other = text;
  const std::size_t place = other.find("\"rest\": [\"0x") + 12;
  other[place] = other[place] == '1' ? '2' : '1';
  EXPECT_NE(error_of(other).find("the file has been changed"), std::string::npos);
}

TEST(RunCertificate, MalformedEntriesAreToldByTheirPlace) {
  const auto changed_text = [](const std::string& from, const std::string& to) {
    std::string text = body();
    const std::size_t place = text.find(from);
    EXPECT_NE(place, std::string::npos) << from;
    return with_digest(text.replace(place, from.size(), to));
  };
  EXPECT_NE(error_of(with_digest("{ 5")).find("c.json:1:3: error: expected JSON"),
            std::string::npos)
      << error_of(with_digest("{ 5"));
  EXPECT_NE(error_of(with_digest(std::string(100000, '['))).find("eight lists"), std::string::npos);
  EXPECT_NE(error_of(changed_text("\"order\": 22", "\"order\": 1e99")).find("/order"),
            std::string::npos);
  EXPECT_NE(error_of(changed_text("\"order\": 22", "\"order\": 99999")).find("1 to 2000"),
            std::string::npos);
  EXPECT_NE(error_of(changed_text("\"room\"", "\"rooms\"")).find("/steps/0/rooms"),
            std::string::npos);
  EXPECT_NE(error_of(changed_text("\"rest\": [\"0x", "\"rest\": [\"nan")).find("/steps/0/rest/0"),
            std::string::npos);
  EXPECT_NE(error_of(changed_text("\"rest\": [", "\"rest\": [\"0\", ")).find("a list of 6 numbers"),
            std::string::npos);
  EXPECT_NE(error_of(changed_text("\"0x1p0\"", "\"0x1p999999999\"")).find("a number such as"),
            std::string::npos);
}

TEST(RunCertificate, EquationsWithAnythingElseInThemAreRefused) {
  RunCertificate other = of_a_point();
  other.equations += "\n[[map]]\nname = \"m\"\nto = \"../secret\"\nM1 = \"1\"\n";
  EXPECT_THROW(check_certificate(other), CaseError);
  EXPECT_THROW(check_certificate(with_text(of_a_point(), "duration = \"2\"", "nonsense = \"2\"")),
               CaseError);
}

}  // namespace
}  // namespace casimir
