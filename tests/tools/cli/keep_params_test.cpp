// --keep-params: one module for all values, and the results of the folded ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/tools/program.hpp"

namespace casimir::test {
namespace {

/// A cache of its own, so that what one run compiles the next one finds.
struct KeepParams : ::testing::Test {
  nlohmann::ordered_json integrate(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "integrate");
    if (std::count(arguments.begin(), arguments.end(), "--method") == 0)
      arguments.insert(arguments.end(), {"--method", "dop853"});  // one that is compiled
    arguments.insert(arguments.end(), {"--tolerance", "1e-11", "--json"});
    const Outcome outcome =
        run_in(folder, arguments, {}, {{"CASIMIR_CACHE", (cache.path() / "cache").string()}});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return outcome.status == 0 ? outcome.json() : nlohmann::ordered_json{};
  }
  Folder folder, cache;
};

TEST_F(KeepParams, AnotherValueComesFromTheCache) {
  bool cached = false;
  for (const char* value : {"r=1", "r=2", "r=1/3", "r=-7.5"}) {
    const auto kept = integrate({"kovalevskaya", "--keep-params", "--param", value});
    const auto folded = integrate({"kovalevskaya", "--param", value});
    EXPECT_EQ(kept.at("from_cache"), cached) << value;
    EXPECT_EQ(folded.at("from_cache"), false) << value;
    cached = true;
    for (const auto& [name, x] : folded.at("state").items())
      EXPECT_NEAR(number(kept.at("state").at(name)), number(x), 1e-7) << value << ' ' << name;
    EXPECT_LT(number(kept.at("invariants").at("K").at("drift")), 1e-9) << value;
    EXPECT_TRUE(kept.at("left_out").empty());
  }
}

TEST_F(KeepParams, ScenesShareTheModule) {
  EXPECT_EQ(integrate({"kovalevskaya", "--keep-params"}).at("from_cache"), false);
  const auto generic = integrate({"kovalevskaya", "--keep-params", "--scene", "generic"});
  EXPECT_EQ(generic.at("from_cache"), true);
  // Reference: two Taylor series in 45 and 90 digits.
  EXPECT_NEAR(number(generic.at("state").at("M1")), 0.9314032994660502, 1e-8);
}

TEST_F(KeepParams, OnlySomeOfThem) {
  const auto first = integrate({"clebsch", "--keep-params=a1,a2", "--param", "a2=1/3", "--param",
                                "a3=1/5", "--duration", "5"});
  const auto folded =
      integrate({"clebsch", "--param", "a2=1/3", "--param", "a3=1/5", "--duration", "5"});
  for (const auto& [name, x] : folded.at("state").items())
    EXPECT_NEAR(number(first.at("state").at(name)), number(x), 1e-9) << name;
  for (const auto& item : first.at("left_out")) EXPECT_NE(item.at("name"), "a2");
  EXPECT_EQ(integrate({"clebsch", "--keep-params=a1,a2", "--param", "a1=2", "--param", "a3=1/5",
                       "--duration", "5"})
                .at("from_cache"),
            true);
  EXPECT_EQ(integrate({"clebsch", "--keep-params=a1,a2", "--param", "a3=1/7", "--duration", "5"})
                .at("from_cache"),
            false);
}

TEST_F(KeepParams, StatesThatNobodyObservesAreLeftOut) {
  const auto json = integrate({"euler-e3", "--keep-params", "--observe", "M1", "--duration", "5"});
  EXPECT_EQ(json.at("state").size(), 3U);
}

TEST_F(KeepParams, TablesAndTheInterpreterTakeThemToo) {
  const std::vector<std::string> kept{"kovalevskaya", "--keep-params", "--param",
                                      "r=2",          "--duration",    "5"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), kept.begin(), kept.end());
    return number(integrate(more).at("state").at("M1"));
  };
  const double expected = with({});
  EXPECT_NEAR(with({"--method", "taylor"}), expected, 1e-9);
  EXPECT_NEAR(with({"--method", "taylor-compiled"}), expected, 1e-9);
  EXPECT_NEAR(with({"--method", "gauss8"}), expected, 1e-8);
}

TEST_F(KeepParams, WhatIsUndefinedIsRefused) {
  const std::string file = folder.write(
      "c.toml",
      "[phase_space]\nvariables = [\"u\", \"v\"]\n[equations]\nu = \"v/c\"\nv = \"sqrt(c + 1)*u\"\n"
      "[parameters]\nc = {}\n[[scene]]\nname = \"default\"\nparameters = { c = \"1\" }\ninitial = "
      "{ "
      "u = \"1\", v = \"0\" }\nduration = \"1\"\n");
  EXPECT_EQ(integrate({file, "--keep-params"}).at("status"), "ok");
  for (const char* method : {"dop853", "taylor"}) {
    for (const char* value : {"c=0", "c=-2"}) {
      const Outcome outcome = run_in(
          folder, {"integrate", file, "--keep-params", "--param", value, "--method", method});
      EXPECT_EQ(outcome.status, 2) << outcome.out;
      EXPECT_NE(outcome.err.find("cannot be computed"), std::string::npos) << outcome.err;
    }
  }
  const Outcome outside =
      run_in(folder, {"integrate", "kovalevskaya", "--keep-params", "--param", "r=0"});
  EXPECT_EQ(outside.status, 2);
  EXPECT_NE(outside.err.find("r != 0"), std::string::npos) << outside.err;
  EXPECT_EQ(run({"integrate", "kovalevskaya", "--keep-params", "--param", "q=1"}).status, 2);
  EXPECT_EQ(run({"integrate", "kovalevskaya", "--keep-params=q"}).status, 2);
}

TEST_F(KeepParams, RoundingAParameterCountsAsRoundingAnInput) {
  const auto rounded = [&](const char* value) {
    return number(integrate({"euler", "--keep-params=a1", "--param", value, "--duration", "20"})
                      .at("trust")
                      .at("input_rounding"));
  };
  const double exact = rounded("a1=0.5");
  EXPECT_GT(rounded("a1=0.3"), 1.5 * exact);
}

TEST_F(KeepParams, ReferencesBelongToTheirParameters) {
  const auto error = [&](const char* value) {
    return run_in(folder, {"conserve", "kovalevskaya", "--scene", "default", "--keep-params",
                           "--param", value, "--method", "dop853", "--json"})
        .json()
        .at("rows")
        .at(0)
        .at("error");
  };
  EXPECT_LT(number(error("r=1")), 1e-8);
  EXPECT_TRUE(error("r=2").is_null());
}

TEST_F(KeepParams, BenchMeasuresThem) {
  const auto json =
      run_in(folder, {"bench", "kovalevskaya", "--keep-params", "--param", "r=2", "--duration", "3",
                      "--method", "dop853", "--tolerances", "1e-10", "--json"})
          .json();
  for (const auto& row : json.at("rows")) EXPECT_LT(number(row.at("error")), 1e-7);
}

TEST(Generate, CountsTheOperationsOfEachFunction) {
  const Folder folder;
  const auto json = run_in(folder, {"generate", "clebsch", "--with",
                                    "gradients,jacobian,variational", "-o", "c.hpp", "--json"})
                        .json();
  const auto& functions = json.at("functions");
  EXPECT_EQ(functions.at("rhs"), json.at("operations").at("specialised"));
  EXPECT_EQ(functions.at("gradients").at("entries"), 21);
  EXPECT_EQ(functions.at("jacobian").at("entries"), 24);
  for (const char* name : {"rhs", "invariants", "gradients", "jacobian", "variational"})
    EXPECT_GT(functions.at(name).at("mul"), 0) << name;
  const auto few =
      run_in(folder, {"generate", "clebsch", "--with", "rhs", "-o", "d.hpp", "--json"}).json();
  EXPECT_EQ(few.at("functions").size(), 1U);
  EXPECT_NE(file_text(folder.path() / "c.hpp").find("void gradients("), std::string::npos);
  EXPECT_EQ(file_text(folder.path() / "d.hpp").find("void gradients("), std::string::npos);
  EXPECT_EQ(run({"generate", "clebsch", "--with", "gradient"}).status, 2);
}

}  // namespace
}  // namespace casimir::test
