// Arbitrary functions that a scene gives, with parameters in them: they move with these, and what
// is said of a scene is about its own functions.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "tests/tools/program.hpp"

namespace casimir::test {
namespace {

using Json = nlohmann::ordered_json;

/// An oscillator of the frequency sqrt(k).
const char* const kSpring = R"toml(
title = "spring"
hamiltonian = "p^2/2 + U(q)"
[phase_space]
variables = ["q", "p"]
canonical = true
[functions]
U = ["r"]
[parameters]
k = {}
[[scene]]
name = "default"
parameters = { k = "1" }
functions = { U = "k*r^2/2" }
initial = { q = "1", p = "0" }
duration = "1"
)toml";

class GivenFunctions : public testing::Test {
 protected:
  Outcome run_on(const char* text, std::vector<std::string> arguments) {
    folder_.write("case.toml", text);
    arguments.insert(arguments.begin() + 1, "./case.toml");
    return run_in(folder_, arguments);
  }

  const Folder folder_;
};

TEST_F(GivenFunctions, AreOnAPageAsTheSceneGivesThem) {
  const Outcome outcome =
      run_on(kSpring, {"report", "--budget", "0", "--output", "page.html", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const std::string page = file_text(folder_.path() / "page.html");
  EXPECT_NE(page.find("U(r) = r^2*k/2"), std::string::npos);
  EXPECT_EQ(page.find("is arbitrary: a scene gives it"), std::string::npos);
}

// A page of a case that has no name of its own.
TEST_F(GivenFunctions, OfStandardInputHaveAPageCalledReport) {
  const Outcome outcome = run_in(folder_, {"report", "-", "--budget", "0"}, kSpring);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "report.html")) << outcome.out;
}

TEST_F(GivenFunctions, MoveWithAParameterThatHasARange) {
  const Outcome outcome = run_on(kSpring, {"integrate", "--validated", "--param", "k=1..1.001",
                                           "--certificate", "run.json", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const Json box = outcome.json().at("validated").at("enclosure").at("q");
  for (const double k : {1., 1.0005, 1.001}) {
    EXPECT_LE(number(box.at(0)), std::cos(std::sqrt(k))) << outcome.out;
    EXPECT_GE(number(box.at(1)), std::cos(std::sqrt(k))) << outcome.out;
  }
  EXPECT_EQ(run_in(folder_, {"check", "run.json"}).status, 0);
}

TEST_F(GivenFunctions, OfAnUnstableMemberOfARangeAreNotProvedToBeStable) {
  const Outcome outcome = run_on(R"toml(
title = "growth"
[phase_space]
variables = ["x"]
[equations]
x = "U(x)"
[functions]
U = ["r"]
[parameters]
a = {}
[[scene]]
name = "default"
parameters = { a = "-1" }
functions = { U = "a*r" }
initial = { x = "1" }
duration = "1"
)toml",
                                 {"equilibria", "--validated", "--param", "a=-3..1"});
  EXPECT_NE(outcome.status, 0);
  EXPECT_FALSE(has(outcome.out, "proved to be stable")) << outcome.out;
}

TEST_F(GivenFunctions, MoveWithTheParametersOfPointsAndMembers) {
  const Outcome sweep = run_on(kSpring, {"sweep", "--over", "k=1,4,9", "--output", "table.csv"});
  ASSERT_EQ(sweep.status, 0) << sweep.err;
  folder_.write("members.csv", "k\n1\n4\n9\n");
  const Outcome ensemble = run_in(
      folder_, {"integrate", "./case.toml", "--ensemble", "members.csv", "--output", "ends.csv"});
  ASSERT_EQ(ensemble.status, 0) << ensemble.err;
  for (const char* table : {"table.csv", "ends.csv"}) {
    const std::string text = file_text(folder_.path() / table);
    for (const int w : {1, 2, 3})
      EXPECT_TRUE(has(text, std::to_string(std::cos(w)).substr(0, 7))) << table << "\n" << text;
  }
}

/// What a body was written with is needed, also where it cancels: the same as if it stood in the
/// case.
TEST_F(GivenFunctions, HaveNoValuesWhereWhatTheyWereWrittenWithHasNone) {
  for (const auto& [body, value] : {std::pair{"k/k*r^2", "0"},
                                    {"sqrt(k)*sqrt(k)*r^2", "-1"},
                                    {"0*log(k) + r^2", "-1"},
                                    {"r^2*(k - 2)/(k - 2)", "2"}}) {
    std::string text = kSpring;
    text.replace(text.find("k*r^2/2"), 7, body);
    const Outcome sweep = run_on(text.c_str(), {"sweep", "--over", std::string("k=3,") + value});
    EXPECT_EQ(sweep.status, 2) << body << sweep.out;
    EXPECT_TRUE(has(sweep.err, "the case has no values")) << sweep.err;
    const Outcome proof =
        run_in(folder_, {"equilibria", "./case.toml", "--validated", "--param",
                         std::string("k=") + value + ".." + std::to_string(std::stoi(value) + 1)});
    EXPECT_NE(proof.status, 0) << body << proof.out;
  }
}

TEST_F(GivenFunctions, HaveNoEquilibriumWhereTheyHaveNoValue) {
  std::string text = kSpring;
  text.replace(text.find("k*r^2/2"), 7, "k*r^3/r");
  const Outcome proof = run_on(text.c_str(), {"equilibria", "--validated"});
  EXPECT_NE(proof.status, 0) << proof.out;
  EXPECT_FALSE(has(proof.out, "proved to be stable")) << proof.out;
}

TEST_F(GivenFunctions, KeepTheirParametersInGeneratedCode) {
  const Outcome outcome = run_on(kSpring, {"generate", "--keep-params"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(has(outcome.out, "dx[1] = -q * k;")) << outcome.out;
}

TEST_F(GivenFunctions, HideParametersOfTheNamesOfTheirArguments) {
  std::string text = kSpring;
  text.replace(text.find("[\"r\"]"), 5, "[\"k\"]");
  text.replace(text.find("k*r^2/2"), 7, "2*k^2");
  const Outcome outcome = run_on(text.c_str(), {"integrate", "--param", "k=7", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NEAR(number(outcome.json().at("state").at("q")), std::cos(2), 1e-12);
}

TEST_F(GivenFunctions, ThatJumpAreNoReasonToRefuseARun) {
  const Outcome outcome = run_on(R"toml(
title = "step"
hamiltonian = "p^2/2 + U(q)"
[phase_space]
variables = ["q", "p"]
canonical = true
[functions]
U = ["r"]
[[scene]]
name = "default"
functions = { U = "sign(r - 3/10)*(r - 3/10) + sign(r)" }
initial = { q = "-1", p = "1" }
duration = "2"
)toml",
                                 {"integrate"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(has(outcome.out + outcome.err, "between the jumps that it may have where q = 0"))
      << outcome.out << outcome.err;
}

TEST_F(GivenFunctions, HaveEquilibria) {
  const Outcome outcome = run_on(kSpring, {"equilibria"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(has(outcome.out, "eigenvalues 1i, -1i: spectrally stable")) << outcome.out;
}

}  // namespace
}  // namespace casimir::test
