// Bad input: exit status 2, the place, the text, a hint; nothing crashes and nothing is written.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/tools/program.hpp"

namespace casimir::test {
namespace {

struct Bad {
  const char* name;
  std::vector<std::string> arguments;
  const char* expected;
};

void PrintTo(const Bad& bad, std::ostream* stream) { *stream << bad.name; }

class BadCommandLine : public testing::TestWithParam<Bad> {};

TEST_P(BadCommandLine, IsRefused) {
  const Folder folder;
  const Outcome outcome = run_in(folder, GetParam().arguments);
  EXPECT_EQ(outcome.status, 2) << outcome.err;
  EXPECT_NE(outcome.err.find(GetParam().expected), std::string::npos) << outcome.err;
  if (std::ranges::count(GetParam().arguments, "--json") == 0)
    EXPECT_TRUE(outcome.out.empty()) << outcome.out;
  else
    EXPECT_TRUE(nlohmann::ordered_json::parse(outcome.out).contains("error")) << outcome.out;
  EXPECT_EQ(folder.files(), 0U);
}

INSTANTIATE_TEST_SUITE_P(
    All, BadCommandLine,
    testing::Values(
        Bad{"UnknownCommand", {"verfy", "euler"}, "did you mean 'verify'?"},
        Bad{"UnknownCase", {"verify", "kovalevskaja"}, "did you mean 'kovalevskaya'?"},
        Bad{"MissingFile",
            {"verify", "./none.toml"},
            "./none.toml: error: the case file does not exist"},
        Bad{"UnknownOption",
            {"verify", "euler", "--integrall", "M1"},
            "'verify' has no option '--integrall'\n  hint: did you mean '--integral'?"},
        Bad{"UnexpectedArgument", {"show", "euler", "extra"}, "unexpected argument 'extra'"},
        Bad{"EmptyArgumentBeforeTheCommand", {"", "survey"}, "unexpected argument ''"},
        Bad{"TooLongANumber",
            {"integrate", "euler", "--digits", "99999999999999999999"},
            "--digits = 99999999999999999999: a number was expected"},
        Bad{"Undeclared",
            {"verify", "euler", "--integral", "M1 + M5"},
            "--integral:1:6: error: 'M5' is not declared"},
        Bad{"DivisionByZero",
            {"verify", "euler", "--integral", "1/0"},
            "--integral:1:2: error: division by zero"},
        Bad{"HiddenDivisionByZero",
            {"verify", "euler", "--integral", "1/((M1+M2)^2-M1^2-M2^2-2*M1*M2)"},
            "identically zero"},
        Bad{"NegativeTolerance", {"integrate", "euler", "--tolerance", "-1"}, "--tolerance"},
        Bad{"ZeroTolerance", {"integrate", "euler", "--tolerance", "0"}, "--tolerance"},
        Bad{"NanTolerance",
            {"integrate", "euler", "--tolerance", "nan"},
            "expected a number above 0 such as 0.01 or 1e-9, not 'nan'"},
        Bad{"TooSmallTolerance",
            {"integrate", "euler", "--tolerance", "1e-20"},
            "double precision"},
        Bad{"WordAsTolerance", {"integrate", "euler", "--tolerance", "small"}, "--tolerance"},
        Bad{"UnknownMethod",
            {"integrate", "euler", "--method", "dop583"},
            "did you mean 'dop853'?"},
        Bad{"MethodInCapitals",
            {"integrate", "euler", "--method", "DOPRI5"},
            "did you mean 'dopri5'?"},
        Bad{"MethodLikeNoOther",
            {"integrate", "euler", "--method", "euler1768"},
            "known: dop853, "},
        Bad{"UnknownMethodOfConserve",
            {"conserve", "euler", "--method", "taylor,gaus8"},
            "did you mean 'gauss8'?"},
        Bad{"CommandInCapitals", {"VERIFY", "euler"}, "did you mean 'verify'?"},
        Bad{"CaseWithItsEnding",
            {"verify", "euler.toml"},
            "euler.toml: error: the case file does not exist or cannot be read\n  hint: the "
            "bundled "
            "case is called 'euler'"},
        Bad{"UnknownParameter",
            {"verify", "kovalevskaya", "--param", "R=1"},
            "--param:1:1: error: 'R' is not a parameter of this case\n  R=1\n  ^\n  hint: did you "
            "mean 'r'?"},
        Bad{"UnknownParameterFarOff",
            {"verify", "kovalevskaya", "--param", "mass=1"},
            "hint: parameters: r"},
        Bad{"UnknownVariable",
            {"integrate", "kovalevskaya", "--observe", "M4"},
            "did you mean 'M1'?"},
        Bad{"UnknownStart",
            {"integrate", "kovalevskaya", "--initial", "m1=2"},
            "--initial:1:1: error: 'm1' is not a variable of this case\n  m1=2\n  ^\n  hint: did "
            "you mean 'M1'?"},
        Bad{"StartWithoutValue",
            {"conserve", "kovalevskaya", "--initial", "M1"},
            "--initial 'M1': expected NAME=VALUE"},
        Bad{"StartTwice",
            {"section", "kovalevskaya", "--initial", "M1=1", "--initial", "M1=2"},
            "--initial M1 is given twice"},
        Bad{"StartThatIsNoNumber",
            {"generate", "kovalevskaya", "--initial", "M1=2*r"},
            "--initial:1:6: error: 'r' is not declared"},
        Bad{"UnknownFormat", {"show", "euler", "--format", "jsn"}, "did you mean 'json'?"},
        Bad{"UnknownPart",
            {"generate", "euler", "--with", "rhs,jacobi"},
            "did you mean 'jacobian'?"},
        Bad{"UnknownScalar", {"generate", "euler", "--scalar", "doubel"}, "did you mean 'double'?"},
        Bad{"UnknownTask",
            {"sweep", "euler", "--over", "M1=1:2:3", "--do", "sections"},
            "did you mean 'section'?"},
        Bad{"HeaderNameIsAKeyword",
            {"generate", "euler", "--name", "class"},
            "'class' cannot name generated code: it is a keyword"},
        Bad{"HeaderNameIsReserved", {"generate", "euler", "--name", "a__b"}, "are reserved in C++"},
        Bad{"HeaderNameBeginsWithUnderscore",
            {"generate", "euler", "--name", "_top"},
            "are reserved in C++"},
        Bad{"HeaderNameIsNoIdentifier",
            {"generate", "euler", "--name", "my-top"},
            "'my-top' cannot name generated code: an ASCII letter"},
        Bad{"HeaderNameIsEmpty", {"generate", "euler", "--name", ""}, "'' cannot name"},
        Bad{"HeaderNameIsThatOfTheStandard",
            {"generate", "euler", "--name", "std"},
            "'std' cannot name generated code"},
        Bad{"UnknownScene", {"integrate", "euler", "--scene", "genric"}, "did you mean 'generic'?"},
        Bad{"BadDuration", {"integrate", "euler", "--duration", "1/0"}, "division by zero"},
        Bad{"BadParameter",
            {"verify", "euler", "--param", "a1=x"},
            "--param:1:4: error: 'x' is not declared"},
        Bad{"FractionForANumber",
            {"integrate", "euler", "--step", "1/100"},
            "--step: expected a number above 0 such as 0.01 or 1e-9, not '1/100'"},
        Bad{"NegativeNumber", {"integrate", "euler", "--tolerance", "-1"}, "not '-1'"},
        Bad{"HalfAJob",
            {"stress", "euler", "--jobs", "1.5"},
            "expected a whole number from 1 on, not '1.5'"},
        Bad{"BadPlotName", {"bench", "euler", "--plot", "b.gif"}, ".svg, .png, .pdf or .tex"},
        Bad{"JsonWithoutFile", {"generate", "euler", "--json"}, "--output"},
        Bad{"AllAndCase", {"verify", "euler", "--all"}, "--all takes no CASE"},
        Bad{"OnWithoutCandidate", {"verify", "euler", "--on", "M1"}, "--on needs a candidate"},
        Bad{"Folder", {"verify", "./"}, "this is a folder"}),
    [](const auto& bad) { return bad.param.name; });

std::string case_with(const std::string& hamiltonian) {
  return "hamiltonian = \"" + hamiltonian +
         "\"\n[phase_space]\nvariables = [\"q\", \"p\"]\ncanonical = true\n";
}

TEST(BadFile, ErrorsAreJsonToo) {
  const Outcome outcome = run({"verify", "-", "--json"}, case_with("p^2/2 + qq"));
  EXPECT_EQ(outcome.status, 2);
  const auto json = nlohmann::ordered_json::parse(outcome.out);
  EXPECT_EQ(json.at("schema"), 1);
  const auto& error = json.at("error");
  EXPECT_EQ(error.at("file"), "<standard input>");
  EXPECT_EQ(error.at("line"), 1);
  EXPECT_EQ(error.at("column"), 24);
  EXPECT_EQ(error.at("text"), "'qq' is not declared");
  EXPECT_EQ(error.at("hint"), "did you mean 'q*q'?");
  EXPECT_NE(outcome.err.find("<standard input>:1:24: error: 'qq'"), std::string::npos);
  // Before a command line is understood as well, and where there is no place.
  const Outcome option = run({"verify", "euler", "--json", "--nosuch"});
  EXPECT_NE(nlohmann::ordered_json::parse(option.out)
                .at("error")
                .at("text")
                .get<std::string>()
                .find("--nosuch"),
            std::string::npos);
  EXPECT_EQ(nlohmann::ordered_json::parse(run({"verify", "euler", "--json"}).out).at("schema"), 1);
}

TEST(BadFile, LargerThanTheStatedLimitIsRefused) {
  std::string sum = "q";
  while (sum.size() <= (16U << 20)) sum += " + q*p";
  const Outcome outcome = run({"verify", "-"}, case_with(sum));
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("<standard input>: error: the file is larger than 16 MiB"),
            std::string::npos)
      << outcome.err;
  EXPECT_LT(outcome.err.size(), 1000U);
}

TEST(BadFile, DeepNestingIsRefusedByAStatedLimit) {
  const std::string deep = std::string(100000, '(') + "q" + std::string(100000, ')');
  const Outcome outcome = run({"verify", "-"}, case_with(deep));
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("nested more than 200 deep"), std::string::npos) << outcome.err;
  EXPECT_EQ(run({"verify", "-"}, "x = " + std::string(100000, '[')).status, 2);
}

TEST(BadFile, TerminalEscapesAreNotPassedOn) {
  const Outcome outcome = run({"verify", "euler", "--integral", "M1 + \x1b[31mM2"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.err.find('\x1b'), std::string::npos) << outcome.err;
  const Outcome title = run({"verify", "-"}, "title = \"a\\u001b[31mb\"\n" + case_with("q^2"));
  EXPECT_EQ(title.out.find('\x1b'), std::string::npos) << title.out;
}

}  // namespace
}  // namespace casimir::test
