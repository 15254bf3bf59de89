// CASIMIR_INSTRUCTIONS: the instruction set of kernels and of compiled code.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "runtime/instruction_set.hpp"
#include "tests/tools/program.hpp"

namespace casimir::test {
namespace {

std::size_t objects_in(const Folder& cache) {
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(cache.path()))
    count += entry.path().extension() == ".so" ? 1 : 0;
  return count;
}

TEST(Instructions, WhatIsNoneIsRefusedWithTheNamesOfThoseThatAre) {
  for (const char* wrong : {"avx1024", "AVX2", "avx2 ", "native"}) {
    const Outcome outcome =
        run({"integrate", "euler", "--json"}, {}, {{"CASIMIR_INSTRUCTIONS", wrong}});
    EXPECT_EQ(outcome.status, 4) << wrong;
    for (const std::string& part : {std::string("CASIMIR_INSTRUCTIONS"), std::string(wrong),
                                    name_of(instruction_sets_here().back())})
      EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.json().at("error").at("text").dump().find(wrong), std::string::npos);
  }
  EXPECT_EQ(run({"integrate", "euler"}, {}, {{"CASIMIR_INSTRUCTIONS", ""}}).status, 0);
}

TEST(Instructions, BenchSaysWhichItMeasured) {
  for (const InstructionSet set : instruction_sets_here()) {
    const Environment environment{{"CASIMIR_INSTRUCTIONS", name_of(set)}};
    std::vector<std::string> words{"bench",        "euler", "--method", "taylor",
                                   "--tolerances", "1e-9",  "--repeat", "1"};
    const Outcome text = run(words, {}, environment);
    EXPECT_NE(text.out.find("code for " + name_of(set)), std::string::npos) << text.out;
    words.emplace_back("--json");
    EXPECT_EQ(run(words, {}, environment).json().at("machine").at("instructions"), name_of(set));
  }
  const Outcome without = run(
      {"bench", "euler", "--method", "taylor", "--tolerances", "1e-9", "--repeat", "1", "--json"});
  EXPECT_EQ(without.json().at("machine").at("instructions"),
            name_of(instruction_sets_here().front()));
}

TEST(Instructions, EachHasItsOwnObjectInTheCacheAndComesToTheSameEnd) {
  const Folder cache;
  nlohmann::ordered_json widest;
  std::size_t sets = 0;
  for (const InstructionSet set : instruction_sets_here()) {
    ++sets;
    for (int time = 0; time < 2; ++time) {
      const Outcome outcome =
          run({"integrate", "euler", "--method", "taylor-compiled", "--json"}, {},
              {{"CASIMIR_INSTRUCTIONS", name_of(set)}, {"CASIMIR_CACHE", cache.path().string()}});
      ASSERT_EQ(outcome.status, 0) << outcome.err;
      EXPECT_EQ(objects_in(cache), sets) << name_of(set);
      const auto state = outcome.json().at("state");
      if (widest.is_null()) widest = state;
      for (const auto& [name, value] : state.items())
        EXPECT_NEAR(std::stod(value.get<std::string>()),
                    std::stod(widest.at(name).get<std::string>()), 1e-11)
            << name_of(set) << name;
    }
  }
}

}  // namespace
}  // namespace casimir::test
