// Short runs compile nothing, long ones go over to compiled code, and the answer depends on neither
// the cache nor the clock. Closed forms are taken where they are asked for and there is one.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/tools/program.hpp"

namespace casimir::test {
namespace {

nlohmann::ordered_json run_cold(const Folder& cache, std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "integrate");
  arguments.emplace_back("--json");
  const Outcome outcome =
      run(arguments, {}, {{"CASIMIR_CACHE", (cache.path() / "modules").string()}});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return outcome.status == 0 ? outcome.json() : nlohmann::ordered_json{};
}

bool has_module(const Folder& cache) {
  const std::filesystem::path folder = cache.path() / "modules";
  if (!std::filesystem::exists(folder)) return false;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".so") return true;
  return false;
}

TEST(InterpretedFirst, ShortRunsCompileNothing) {
  const Folder cache;
  EXPECT_EQ(run_cold(cache, {"lagrange-euler-angles"}).at("code"), "interpreted");
  const auto stiff = run_cold(cache, {"robertson"});
  EXPECT_EQ(stiff.at("code"), "interpreted");
  EXPECT_EQ(stiff.at("method"), "radau9");
  EXPECT_EQ(run_cold(cache, {"kovalevskaya"}).at("code"), "tables");
  EXPECT_FALSE(has_module(cache));
}

TEST(InterpretedFirst, LongRunsGoOverAndTheCacheChangesNoBit) {
  const Folder cache;
  const std::vector<std::string> asked{"lagrange-euler-angles", "--duration", "20000"};
  const auto cold = run_cold(cache, asked), warm = run_cold(cache, asked);
  EXPECT_EQ(cold.at("code"), "interpreted, then compiled");
  EXPECT_EQ(warm.at("code"), "interpreted, then compiled");
  EXPECT_EQ(cold.at("from_cache"), false);
  EXPECT_EQ(warm.at("from_cache"), true);
  EXPECT_EQ(cold.at("state"), warm.at("state"));
  EXPECT_EQ(cold.at("steps"), warm.at("steps"));
  EXPECT_TRUE(has_module(cache));
}

TEST(InterpretedFirst, ConstantStepsAreOneOrTheOther) {
  const Folder cache;
  const std::vector<std::string> asked{
      "lagrange-euler-angles", "--method", "taylor", "--duration", "10", "--step"};
  auto few = asked, many = asked;
  few.emplace_back("0.01");
  many.emplace_back("0.00004");
  EXPECT_EQ(run_cold(cache, few).at("code"), "interpreted");
  EXPECT_EQ(run_cold(cache, few).at("steps"), 1000);
  const auto long_run = run_cold(cache, many);
  EXPECT_EQ(long_run.at("code"), "interpreted, then compiled");
  EXPECT_EQ(long_run.at("steps"), 250000);
}

TEST(Exact, HasTheStateOfTheReference) {
  const Folder cache;
  const auto closed = run_cold(cache, {"euler", "--method", "exact"});
  const auto digits = run_cold(cache, {"euler", "--digits", "20"});
  for (const auto& [name, value] : closed.at("state").items())
    EXPECT_NEAR(std::stod(value.get<std::string>()),
                std::stod(digits.at("state").at(name).get<std::string>()), 2e-15)
        << name;
  EXPECT_LT(std::stod(closed.at("invariants").at("H").at("drift").get<std::string>()), 1e-15);
}

TEST(Exact, IsRefusedWithAReasonWhereNoClosedFormIsKnown) {
  const Outcome outcome = run({"integrate", "kovalevskaya", "--method", "exact"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("no closed form"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("there are not three states"), std::string::npos) << outcome.err;
}

// Euler's top by another name and with other signs is one; with a gyrostat in it, it is none.
TEST(Exact, GoesByTheEquationsAndNotByNames) {
  const Folder folder;
  const std::string head =
      "title = \"t\"\nsource = \"-\"\n[phase_space]\nvariables = [\"u\", \"v\", "
      "\"w\"]\n[equations]\n";
  const std::string scene =
      "[[scene]]\nname = \"default\"\ninitial = { u = \"1\", v = \"1/2\", w = \"1/3\" }\n"
      "duration = \"5\"\n";
  folder.write("a.toml", head + "u = \"v*w\"\nv = \"-2*u*w\"\nw = \"u*v\"\n" + scene);
  folder.write("b.toml", head + "u = \"v*w + u\"\nv = \"-2*u*w - u\"\nw = \"u*v\"\n" + scene);
  EXPECT_EQ(run_in(folder, {"integrate", "./a.toml", "--method", "exact"}).status, 0);
  EXPECT_EQ(run_in(folder, {"integrate", "./b.toml", "--method", "exact"}).status, 2);
}

}  // namespace
}  // namespace casimir::test
