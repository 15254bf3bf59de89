// Resource bombs: what a case asks for beyond a stated limit is refused by every command, at once
// and in little memory, and the limit is an option.
#include <gtest/gtest.h>

#include <functional>

#include "tests/tools/program.hpp"

namespace casimir::test {
namespace {

/// A system in x, y, z, t with this Hamiltonian, and more in the file.
std::string system_with(const std::string& hamiltonian, const std::string& more = {}) {
  return "hamiltonian = \"" + hamiltonian +
         "\"\n[phase_space]\nvariables = [\"x\", \"y\", \"z\", \"t\"]\ncanonical = true\n" + more +
         "\n[[scene]]\nname = \"default\"\n"
         "initial = { x = \"1/2\", y = \"1/3\", z = \"1/4\", t = \"1/5\" }\nduration = \"1\"\n";
}

std::string repeated(std::size_t count, const std::function<std::string(std::size_t)>& part) {
  std::string result;
  for (std::size_t i = 0; i < count; ++i) result += part(i);
  return result;
}

/// d0, d1, ..: each made of the one before, which stands for '@'.
std::string chain(std::size_t length, const std::string& step) {
  return "[definitions]\nd0 = \"x + y\"\n" + repeated(length, [&](std::size_t i) {
           std::string value = step;
           for (std::size_t at = 0; (at = value.find('@')) != std::string::npos;)
             value.replace(at, 1, "d" + std::to_string(i));
           return "d" + std::to_string(i + 1) + " = \"" + value + "\"\n";
         });
}

struct Bomb {
  const char* name;
  std::function<std::string()> text;  ///< some are long, and every test begins with this list
  const char* limit;                  ///< what the message says
};

void PrintTo(const Bomb& bomb, std::ostream* stream) { *stream << bomb.name; }

std::string count(std::size_t n) { return std::to_string(n); }

std::vector<Bomb> bombs() {
  return {
      {"Power", [] { return system_with("(x+y+z+t)^(10^9)"); }, "--limit degree=N"},
      {"NegativePower", [] { return system_with("(x+y+z+t)^(-10^9)"); }, "--limit degree=N"},
      {"TowerOfNumbers", [] { return system_with("2^(2^(2^(2^(2^(2^2)))))*x"); }, "--limit bits=N"},
      {"TowerOfPowers", [] { return system_with("((x^(10^5))^(10^5))^(10^5)"); },
       "--limit degree=N"},
      {"TowerInTheExponent", [] { return system_with("x^(2^(2^(2^(2^2))))"); }, "--limit bits=N"},
      {"Decimal", [] { return system_with("1e999999999*x"); }, "--limit bits=N"},
      {"SmallDecimal", [] { return system_with("1e-999999999*x"); }, "--limit bits=N"},
      {"DoublingProducts", [] { return system_with("d60", chain(60, "@*@ + z")); },
       "--limit degree=N"},
      {"DoublingSums", [] { return system_with("d60", chain(60, "@*x + @*y")); }, "--limit size=N"},
      {"DoublingFunctions", [] { return system_with("d60", chain(60, "sin(@) + cos(@)*z")); },
       "--limit size=N"},
      {"LongChain", [] { return system_with("d5000", chain(5000, "sin(@)")); },
       "--limit nesting=N"},
      {"DeepTree",
       [] {
         return system_with("d99", chain(99,
                                         "sin(sin(sin(sin(sin(sin(sin(sin(sin(sin(sin(sin("
                                         "sin(sin(sin(@)))))))))))))))"));
       },
       "--limit depth=N"},
      {"Itself", [] { return system_with("a", "[definitions]\na = \"a + 1\""); },
       "'a' uses itself"},
      {"EachOther", [] { return system_with("a", "[definitions]\na = \"b + 1\"\nb = \"a + x\""); },
       "uses itself"},
      {"Brackets",
       [] { return system_with(std::string(100000, '(') + "x" + std::string(100000, ')')); },
       "--limit nesting=N"},
      {"Signs", [] { return system_with(std::string(100000, '-') + "x"); }, "--limit nesting=N"},
      {"Variables",
       [] {
         return "hamiltonian = \"x0\"\n[phase_space]\ncanonical = true\nvariables = [" +
                repeated(10000,
                         [](std::size_t i) { return (i ? ",\"x" : "\"x") + count(i) + "\""; }) +
                "]\n";
       },
       "--limit variables=N"},
      {"Parameters",
       [] {
         return system_with("x", "[parameters]\n" + repeated(10000, [](std::size_t i) {
                                   return "p" + count(i) + "={}\n";
                                 }));
       },
       "--limit parameters=N"},
      {"Integrals",
       [] {
         return system_with("x", "[integrals]\n" + repeated(5000, [](std::size_t i) {
                                   return "p" + count(i) + "=\"x+" + count(i) + "\"\n";
                                 }));
       },
       "--limit claims=N"},
      {"TenMillionTerms",
       [] {
         return system_with("x", "[integrals]\nK = \"0" +
                                     repeated(10'000'000, [](std::size_t) { return "+x"; }) + "\"");
       },
       "--limit file-bytes=N"},
      {"Terms",
       [] {
         return system_with("x", "[integrals]\nK = \"0" +
                                     repeated(4'100'000, [](std::size_t) { return "+x"; }) + "\"");
       },
       "--limit size=N"},
      {"Algebra",
       [] {
         return "hamiltonian = \"x\"\n[phase_space]\nvariables = [\"x\"]\nalgebra = "
                "\"so(999999999)\"\n";
       },
       "unknown Lie algebra"},
      {"NestedArrays", [] { return "a = " + std::string(100000, '['); }, "not TOML"},
      {"DottedKey", [] { return repeated(1000000, [](std::size_t) { return "a."; }) + "a = 1\n"; },
       "too many parts"},
      {"DottedTable",
       [] { return "[" + repeated(1000000, [](std::size_t) { return "a."; }) + "a]\n"; },
       "too many parts"},
      {"SineOfAGiant",
       [] {
         return system_with("x",
                            "[parameters]\nr = {}\n[[scene]]\nname = \"s\"\n"
                            "parameters = { r = \"sin(exp(exp(23)))\" }\nduration = \"1\"\n"
                            "initial = { x = \"1\", y = \"1\", z = \"1\", t = \"1\" }\n");
       },
       "real constant"},
      {"ExponentialOfAGiant",
       [] {
         return system_with("x",
                            "[definitions]\nd = \"exp(exp(exp(40)))\"\n"
                            "[[scene]]\nname = \"s\"\nduration = \"exp(exp(exp(40)))\"\n"
                            "initial = { x = \"1\", y = \"1\", z = \"1\", t = \"1\" }\n");
       },
       "real constant"}};
}

class ResourceBomb : public testing::TestWithParam<Bomb> {};

TEST_P(ResourceBomb, IsRefusedByAStatedLimit) {
  const Folder folder;
  folder.write("bomb.toml", GetParam().text());
  const Outcome outcome = run_in(folder, {"verify", "./bomb.toml"});
  EXPECT_EQ(outcome.status, 2) << outcome.out;
  EXPECT_NE(outcome.err.find(GetParam().limit), std::string::npos) << outcome.err;
  EXPECT_LT(outcome.err.size(), 2000U);
}

INSTANTIATE_TEST_SUITE_P(All, ResourceBomb, testing::ValuesIn(bombs()),
                         [](const auto& bomb) { return bomb.param.name; });

/// All commands that take a case.
std::vector<std::vector<std::string>> commands() {
  return {{"show"},
          {"verify"},
          {"search", "--degree", "2"},
          {"exponents"},
          {"equilibria"},
          {"generate", "--output", "out.hpp"},
          {"integrate"},
          {"section", "--output", "out.csv"},
          {"conserve"},
          {"bench"},
          {"stress"},
          {"report", "--output", "out.html"},
          {"sweep", "--over", "x=0:1:3", "--output", "out.csv"}};
}

TEST(ResourceBombs, AreRefusedByEveryCommand) {
  const Folder folder;
  folder.write("bomb.toml", system_with("d60", chain(60, "@*x + @*y")));
  for (std::vector<std::string> arguments : commands()) {
    arguments.insert(arguments.begin() + 1, "./bomb.toml");
    const Outcome outcome = run_in(folder, arguments);
    EXPECT_EQ(outcome.status, 2) << arguments[0] << ": " << outcome.err;
    EXPECT_NE(outcome.err.find("--limit size=N"), std::string::npos) << arguments[0] << outcome.err;
    EXPECT_EQ(folder.files(), 1U) << arguments[0];
  }
}

// What is small as it is written and grows when it is expanded.
TEST(ResourceBombs, ThatGrowInAProofAreUndecided) {
  const Folder folder;
  const std::vector<std::pair<const char*, std::string>> cases = {
      {"--limit terms=N", system_with("(x+y+z+t)^10000")},
      {"--limit terms=N", system_with("d12", chain(12, "@*@ + z"))},
      {"--limit", system_with("d8", chain(8, "sqrt(@ + z) + 1/(@ + t)"))}};
  for (const auto& [limit, text] : cases) {
    folder.write("bomb.toml", text);
    const Outcome outcome =
        run_in(folder, {"verify", "./bomb.toml", "--integral", "x", "--limit", "work=1e7"});
    EXPECT_EQ(outcome.status, 3) << limit << outcome.out << outcome.err;
    EXPECT_NE(outcome.out.find(limit), std::string::npos) << outcome.out;
  }
}

TEST(ResourceBombs, ThatGrowInASearchAreUndecided) {
  const Folder folder;
  folder.write("bomb.toml", system_with("d8", chain(8, "sqrt(@ + z) + 1/(@ + t)")));
  for (const char* more : {"--quiet", "--darboux", "--casimirs", "--json"}) {
    const Outcome outcome =
        run_in(folder, {"search", "./bomb.toml", "--degree", "2", more, "--limit", "work=1e7"});
    EXPECT_EQ(outcome.status, 3) << more << outcome.out << outcome.err;
    if (more == std::string("--quiet"))
      EXPECT_EQ(outcome.out, "");
    else
      EXPECT_NE(outcome.out.find("--limit work=N"), std::string::npos) << more << outcome.out;
  }
}

TEST(ResourceBombs, ThatGrowWhenTheyAreMultipliedOutAreTakenAsTheyAreWritten) {
  const Folder folder;
  for (const char* hamiltonian : {"d12", "x + 1/d12"}) {
    folder.write("bomb.toml", system_with(hamiltonian, chain(12, "@*@ + z")));
    for (const std::vector<std::string>& more : {std::vector<std::string>{"show"},
                                                 {"show", "--format", "latex"},
                                                 {"show", "--json"},
                                                 {"generate", "--observe", "x"}}) {
      std::vector<std::string> arguments = more;
      arguments.insert(arguments.begin() + 1, "./bomb.toml");
      const Outcome outcome = run_in(folder, arguments);
      EXPECT_EQ(outcome.status, 0) << more[0] << outcome.err;
      EXPECT_LT(outcome.out.size(), 100'000U) << more[0];
    }
  }
}

TEST(Limits, AreOptions) {
  const Folder folder;
  folder.write("case.toml", system_with("x^20 + y"));
  EXPECT_EQ(run_in(folder, {"verify", "./case.toml"}).status, 0);
  const Outcome low = run_in(folder, {"verify", "./case.toml", "--limit", "degree=10"});
  EXPECT_EQ(low.status, 2);
  EXPECT_NE(low.err.find("the degree here exceeds 10"), std::string::npos) << low.err;
  const Outcome two =
      run_in(folder, {"show", "./case.toml", "--limit", "variables=3", "--limit", "degree=30"});
  EXPECT_NE(two.err.find("4 variables given; the limit is 3"), std::string::npos) << two.err;
  folder.write("high.toml", system_with("x^20000"));
  EXPECT_EQ(run_in(folder, {"show", "./high.toml"}).status, 2);
  EXPECT_EQ(run_in(folder, {"show", "./high.toml", "--limit", "degree=1e5"}).status, 0);
}

TEST(Limits, OfAnUnknownNameOrValueAreRefused) {
  const Outcome name = run({"verify", "euler", "--limit", "degre=3"});
  EXPECT_EQ(name.status, 2);
  EXPECT_NE(name.err.find("did you mean 'degree'?"), std::string::npos) << name.err;
  for (const char* text :
       {"degree", "degree=", "degree=x", "degree=0", "degree=nan", "nesting=1e9", "=", ""})
    EXPECT_EQ(run({"verify", "euler", "--limit", text}).status, 2) << text;
}

#ifndef __SANITIZE_ADDRESS__
TEST(Limits, OfMemoryEndTheProgramWithAMessage) {
  const Outcome outcome =
      run({"verify", "-", "--memory-limit", "0.05"},
          system_with("x", "[integrals]\nK = \"0" + repeated(1'000'000, [](std::size_t i) {
                             return "+x^" + std::to_string(i % 90) + "*y^" +
                                    std::to_string(i / 90 % 90) + "*z^" + std::to_string(i / 8100);
                           }) + "\""));
  EXPECT_EQ(outcome.status, 4) << outcome.out << outcome.err;
  EXPECT_NE(outcome.err.find("out of memory: the limit is 0.05 GB"), std::string::npos)
      << outcome.err;
}
#endif

}  // namespace
}  // namespace casimir::test
