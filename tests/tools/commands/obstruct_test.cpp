// obstruct from the command line.
#include <gtest/gtest.h>

#include "tests/tools/program.hpp"

namespace casimir::test {
namespace {

constexpr const char* kFamily =
    "title = \"Henon and Heiles\"\nsource = \"a test\"\n"
    "hamiltonian = \"(px^2 + py^2 + x^2 + y^2)/2 + x^2*y + c*y^3/3\"\n"
    "[phase_space]\nvariables = [\"x\", \"y\", \"px\", \"py\"]\ncanonical = true\n"
    "[parameters]\nc = {}\n[[scene]]\nname = \"default\"\nparameters = { c = \"-1\" }\n"
    "initial = { x = \"0\", y = \"0\", px = \"1\", py = \"0\" }\n";

TEST(Obstruct, ProvesWithTheEvidence) {
  const Folder folder;
  const std::string file = folder.write("family.toml", kFamily);
  const Outcome outcome = run_in(folder, {"obstruct", file, "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.out << outcome.err;
  const auto json = outcome.json();
  EXPECT_EQ(json.at("verdict"), "proved");
  EXPECT_EQ(json.at("along"), "x = 0, px = 0");
  EXPECT_EQ(json.at("parameters").at("c"), "-1");
  for (const char* key : {"case", "level", "nve", "theorem", "excluded", "seconds"})
    EXPECT_TRUE(json.contains(key)) << key;
  // Cases 1 to 3 with their reasons, and Kimura's theorem.
  EXPECT_EQ(json.at("examined").back().at("cases").size(), 7u);
}

TEST(Obstruct, IsUndecidedForAnIntegrableSystem) {
  const Folder folder;
  const std::string file = folder.write("family.toml", kFamily);
  for (const char* c : {"c=1", "c=6"}) {
    const Outcome outcome = run_in(folder, {"obstruct", file, "--param", c, "--json"});
    EXPECT_EQ(outcome.status, 3) << outcome.out << outcome.err;
    EXPECT_EQ(outcome.json().at("verdict"), "undecided");
    EXPECT_FALSE(outcome.json().at("reason").get<std::string>().empty());
  }
  EXPECT_EQ(run({"obstruct", "kovalevskaya"}).status, 3);
}

TEST(Obstruct, TellsWhatSurvivesOfAFreeParameter) {
  const Folder folder;
  const std::string file = folder.write("family.toml", kFamily);
  const Outcome outcome = run_in(folder, {"obstruct", file, "--free", "c", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.out << outcome.err;
  const auto free = outcome.json().at("free");
  EXPECT_EQ(free.at("parameter"), "c");
  ASSERT_EQ(free.at("survivors").size(), 4u);
  EXPECT_EQ(free.at("survivors").at(3).at("value"), "6");
  EXPECT_EQ(free.at("excluded_alone").at(0).at("value"), "0");
  EXPECT_EQ(free.at("sequences").size(), 1u);
  const Outcome text = run_in(folder, {"obstruct", file, "--free", "c"});
  EXPECT_NE(text.out.find("survives    c = 6"), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("for every other real c"), std::string::npos);
  // What has a value is not free, nor is what is no parameter.
  EXPECT_EQ(run_in(folder, {"obstruct", file, "--free", "d"}).status, 2);
  EXPECT_EQ(run_in(folder, {"obstruct", file, "--free", "c", "--param", "c=1"}).status, 2);
}

TEST(Obstruct, RefusesWhatIsNoSurface) {
  const Folder folder;
  const std::string file = folder.write("family.toml", kFamily);
  EXPECT_EQ(run_in(folder, {"obstruct", file, "--along", "x = 0"}).status, 0);
  EXPECT_EQ(run_in(folder, {"obstruct", file, "--along", "w = 0"}).status, 2);
  EXPECT_EQ(run_in(folder, {"obstruct", file, "--along", "x +"}).status, 2);
  EXPECT_EQ(run_in(folder, {"obstruct", file, "--param", "d=1"}).status, 2);
}

}  // namespace
}  // namespace casimir::test
