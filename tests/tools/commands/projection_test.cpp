// Runs that are put back onto the levels of their invariants, and Hamiltonians that split, from the
// command line.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/tools/program.hpp"

namespace casimir::test {
namespace {

double drift(const nlohmann::ordered_json& run, const char* name) {
  return std::stod(run.at("invariants").at(name).at("drift").get<std::string>());
}

nlohmann::ordered_json end_of(std::vector<std::string> more) {
  const Folder folder;
  std::vector<std::string> arguments{"integrate", "kovalevskaya", "--json"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const Outcome outcome = run_in(folder, arguments);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return outcome.json();
}

double error(const nlohmann::ordered_json& run) {
  static const nlohmann::ordered_json exact = end_of({});
  double largest = 0;
  for (const auto& [name, value] : exact.at("state").items())
    largest = std::max(largest, std::abs(std::stod(run.at("state").at(name).get<std::string>()) -
                                         std::stod(value.get<std::string>())));
  return largest;
}

TEST(Projection, KeepsEveryProvedInvariantAtACoarseToleranceByEveryMethod) {
  for (const char* method : {"dop853", "taylor", "taylor-compiled", "gauss8", "radau9"}) {
    const nlohmann::ordered_json plain = end_of({"--method", method, "--tolerance", "1e-6"});
    const nlohmann::ordered_json kept =
        end_of({"--method", method, "--tolerance", "1e-6", "--project"});
    EXPECT_EQ(kept.at("projected"), (nlohmann::ordered_json{"H", "F1", "F2", "K"}));
    EXPECT_GT(drift(plain, "K"), 1e-9) << method;
    for (const char* name : {"H", "F1", "F2", "K"}) EXPECT_LT(drift(kept, name), 2e-15) << method;
    EXPECT_LT(error(kept), 3 * error(plain)) << method;
  }
}

TEST(Projection, OntoSomeLeavesTheOthers) {
  const nlohmann::ordered_json run =
      end_of({"--method", "dop853", "--tolerance", "1e-6", "--project-onto", "F1,F2"});
  EXPECT_EQ(run.at("projected"), (nlohmann::ordered_json{"F1", "F2"}));
  EXPECT_LT(drift(run, "F1"), 2e-15);
  EXPECT_GT(drift(run, "K"), 1e-9);
}

TEST(Projection, ADependentInvariantDoesNoHarm) {
  // At rest on the lower vertical the gradients of H and of the Casimirs depend on each other.
  const Folder folder;
  const std::string file = folder.write("rest.toml", R"toml(title = "top"
hamiltonian = "(M1^2 + M2^2 + 2*M3^2)/2 - g1"
[phase_space]
variables = ["M1", "M2", "M3", "g1", "g2", "g3"]
algebra = "e(3)"
[casimirs]
F1 = "g1^2 + g2^2 + g3^2"
F2 = "M1*g1 + M2*g2 + M3*g3"
[integrals]
twice = "2*(g1^2 + g2^2 + g3^2)"
[[scene]]
name = "default"
initial = { M1 = "1", M2 = "0", M3 = "0", g1 = "1", g2 = "0", g3 = "0" }
duration = "10"
)toml");
  const Outcome outcome =
      run_in(folder, {"integrate", file, "--json", "--project", "--method", "dop853"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.json().at("state").at("M1"), "1");
}

TEST(Projection, IsRefusedOntoWhatIsNoIntegral) {
  const Folder folder;
  const std::string file = folder.write("top.toml", R"toml(title = "top"
hamiltonian = "(M1^2 + 2*M2^2 + 3*M3^2)/2"
[phase_space]
variables = ["M1", "M2", "M3"]
algebra = "so(3)"
[integrals]
wrong = "M1^2 + M2^2"
[[scene]]
name = "default"
initial = { M1 = "1", M2 = "1/2", M3 = "1/3" }
duration = "1"
)toml");
  const auto refused = [&](std::vector<std::string> more, const char* text) {
    std::vector<std::string> arguments{"integrate", file};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = run_in(folder, arguments);
    EXPECT_EQ(outcome.status, 2) << outcome.err;
    EXPECT_NE(outcome.err.find(text), std::string::npos) << outcome.err;
  };
  refused({"--project-onto", "wrong"}, "wrong is refuted to be an integral");
  refused({"--project-onto", "wrongs"}, "did you mean 'wrong'");
  refused({"--project", "--method", "cvode-adams"}, "cannot be projected");
  const Outcome rest = run_in(folder, {"integrate", file, "--project"});
  EXPECT_EQ(rest.status, 0) << rest.err;
  EXPECT_NE(rest.out.find("not projected onto: wrong is refuted"), std::string::npos) << rest.out;
}

TEST(Splitting, IsRefusedWhereTheHamiltonianDoesNotSplit) {
  const Folder folder;
  const Outcome outcome =
      run_in(folder, {"integrate", "linked-bodies-plane", "--method", "splitting"});
  EXPECT_EQ(outcome.status, 2) << outcome.err;
  EXPECT_NE(outcome.err.find("does not split"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace casimir::test
