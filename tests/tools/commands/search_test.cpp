// search, exponents and equilibria from the command line.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/tools/program.hpp"

namespace casimir::test {
namespace {

using Json = nlohmann::ordered_json;

Json answered(const Folder& folder, std::vector<std::string> arguments, int status = 0) {
  arguments.emplace_back("--json");
  const Outcome outcome = run_in(folder, arguments);
  EXPECT_EQ(outcome.status, status) << outcome.out << outcome.err;
  return outcome.json();
}

std::string heavy_top(const std::string& hamiltonian, const std::string& parameters) {
  return "title = \"top\"\nhamiltonian = \"" + hamiltonian +
         "\"\n[phase_space]\nvariables = [\"M1\", \"M2\", \"M3\", \"g1\", \"g2\", \"g3\"]\n"
         "algebra = \"e(3)\"\n[parameters]\n" +
         parameters;
}

TEST(Search, WhatItPrintsIsProvedByVerify) {
  const Folder folder;
  for (const char* name : {"kovalevskaya", "clebsch", "steklov", "henon-heiles"}) {
    const Json found = answered(folder, {"search", name, "--degree", "4"});
    EXPECT_EQ(found.at("verdict"), "proved") << name;
    ASSERT_GE(found.at("integrals").size(), 1u) << name;
    for (const Json& integral : found.at("integrals")) {
      const Json checked =
          answered(folder, {"verify", name, "--integral", integral.get<std::string>()});
      EXPECT_EQ(checked.at("verdict"), "proved") << name << ' ' << integral;
    }
  }
}

// The twin: the general top has no integral but those known, and the sentence says so.
TEST(Search, NoneIsSaidOnlyWhereItIsProved) {
  const Folder folder;
  const std::string file =
      folder.write("top.toml", heavy_top("(M1^2 + 2*M2^2 + 3*M3^2)/2 - g1 - g2/2", ""));
  const Json found = answered(folder, {"search", file, "--degree", "4"});
  EXPECT_EQ(found.at("integrals"), Json::array());
  EXPECT_EQ(found.at("verdict"), "proved");
  EXPECT_EQ(found.at("casimirs").size(), 2u);
  const Json limited =
      answered(folder, {"search", file, "--degree", "12", "--time-limit", "0.01"}, 3);
  EXPECT_EQ(limited.at("verdict"), "undecided");
}

TEST(Search, KovalevskayasConditionIsFound) {
  const Folder folder;
  const std::string file = folder.write(
      "top.toml",
      heavy_top("(M1^2 + M2^2 + a3*M3^2)/2 - r*g1", "r = { assume = \"r != 0\" }\na3 = {}\n"));
  const Json found = answered(folder, {"search", file, "--degree", "4", "--free", "a3"});
  std::set<std::string> values;
  for (const Json& condition : found.at("conditions")) {
    values.insert(condition.at("parameters").at("a3").get<std::string>());
    EXPECT_EQ(condition.at("verdict"), "proved");
    EXPECT_GE(condition.at("integrals").size(), 1u);
  }
  EXPECT_EQ(values, (std::set<std::string>{"1", "2"}));
}

// The text and the JSON document say the same, and undecided is an exit status of its own.
TEST(Search, WhatIsLeftOpenIsSaidInTextAndInJson) {
  const Folder folder;
  const std::string system =
      "title = \"t\"\n[phase_space]\nvariables = [\"x\", \"y\"]\n[parameters]\nn = {}\nk = {}\n"
      "[equations]\nx = \"1\"\ny = ";
  const auto expect_open = [&](const std::string& rate, const std::string& free, const char* place,
                               const char* value) {
    const std::string file = folder.write("open.toml", system + '"' + rate + "\"\n");
    const std::vector<std::string> command{"search", file, "--degree", "2", "--free", free};
    const Json found = answered(folder, command, 3);
    EXPECT_EQ(found.at("verdict"), "undecided");
    const auto reason = found.at("reason").get<std::string>();
    EXPECT_FALSE(reason.empty());
    EXPECT_TRUE(std::ranges::any_of(found.at("conditions"), [&](const Json& condition) {
      return condition.at("parameters").value(place, "") == value &&
             condition.at("verdict") == "proved";
    })) << found;
    const Outcome text = run_in(folder, command);
    EXPECT_EQ(text.status, 3);
    EXPECT_NE(text.out.find("undecided"), std::string::npos);
    EXPECT_NE(text.out.find(reason), std::string::npos);
    EXPECT_EQ(text.out.find("No other value"), std::string::npos);
  };
  expect_open("exp(n*x) - exp(2*x) + k*y^2*(n - 2)", "n", "n", "2");
  expect_open("(n - 1)*y^2 + (k - 2)*y^3", "n,k", "k", "2");
  // The twin: polynomial in the parameter.
  const std::string file = folder.write("closed.toml", system + "\"(n - 1)*y^2\"\n");
  const std::vector<std::string> command{"search", file, "--degree", "2", "--free", "n"};
  EXPECT_EQ(answered(folder, command).at("verdict"), "proved");
  EXPECT_NE(run_in(folder, command).out.find("No other value, curve or set: proved"),
            std::string::npos);
}

TEST(Search, HesssRelationIsADarbouxPolynomial) {
  const Folder folder;
  const Json found =
      answered(folder, {"search", "hess-special-axes", "--degree", "1", "--darboux"});
  ASSERT_EQ(found.at("invariant_relations").size(), 1u);
  EXPECT_EQ(found.at("invariant_relations")[0].at("expression"), "M3");
}

/// As the literature states results: by degrees in the momenta and in the rest, or by the weights
/// of the equations, with the functions of the equations, which are named.
TEST(Search, GoesByDegreesInPartsAndByTheWeightsOfTheEquations) {
  const Folder folder;
  const std::string cubic = folder.write(
      "cubic.toml",
      "hamiltonian = \"(p1^2 + p2^2)/2 + q1^2*q2 + 16/3*q2^3\"\n[phase_space]\nvariables = "
      "[\"q1\", \"q2\", \"p1\", \"p2\"]\ncanonical = true\n");
  const std::vector<std::string> command{"search",    cubic,         "--degree-in",
                                         "momenta=4", "--degree-in", "rest=6"};
  const Json found = answered(folder, command);
  EXPECT_EQ(found.at("integrals").size(), 1u);
  EXPECT_TRUE(found.at("degree").is_null());
  EXPECT_EQ(found.at("degree_in")[1].at("variables"), Json::parse(R"(["q1", "q2"])"));
  EXPECT_EQ(found.at("degree_in")[1].at("degree"), 6);
  EXPECT_NE(run_in(folder, command).out.find("up to degree 4 in p1, p2 and 6 in q1, q2"),
            std::string::npos);
  const Json weighted = answered(folder, {"search", cubic, "--degree", "12", "--weights", "auto"});
  EXPECT_EQ(weighted.at("weights"), Json::parse(R"({"q1": 2, "q2": 2, "p1": 3, "p2": 3})"));
  EXPECT_EQ(weighted.at("details")[0].at("degree"), 12);

  const std::string walls = folder.write(
      "walls.toml",
      "hamiltonian = \"(p1^2 + p2^2)/2 + 1/(q1 - q2)^2\"\n[phase_space]\nvariables = [\"q1\", "
      "\"q2\", \"p1\", \"p2\"]\ncanonical = true\n");
  const Json own = answered(folder, {"search", walls, "--degree", "1"});
  EXPECT_EQ(own.at("functions"), Json{"(1/(q1 - q2))"});
  EXPECT_EQ(own.at("integrals").size(), 1u);
  EXPECT_TRUE(own.at("hamiltonian").get<bool>());
}

TEST(Search, BadInputIsNamedAndMemoryIsRefusedBeforeItIsTaken) {
  const Folder folder;
  const auto refused = [&](std::vector<std::string> arguments, int status, const char* text) {
    const Outcome outcome = run_in(folder, arguments);
    EXPECT_EQ(outcome.status, status) << outcome.err;
    EXPECT_NE(outcome.err.find(text), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.out, "");
  };
  refused({"search", "kovalevskaya"}, 2, "--degree");
  refused({"search", "kovalevskaya", "--degree", "0"}, 2, "--degree");
  refused({"search", "kovalevskaya", "--degree", "2", "--free", "s"}, 2, "'s'");
  refused({"search", "kovalevskaya", "--degree", "2", "--on", "M1*g9"}, 2, "--on:1:4");
  refused({"search", "kovalevskaya", "--degree", "2", "--weights", "M9=1"}, 2, "M9");
  refused({"search", "kovalevskaya", "--degree-in", "M1"}, 2, "--degree-in momenta=4");
  refused({"search", "kovalevskaya", "--degree-in", "M1=x", "--degree", "2"}, 2, "--degree-in:1:4");
  refused({"search", "kovalevskaya", "--degree-in", "M1,g9=2"}, 2, "--degree-in:1:4");
  refused({"search", "kovalevskaya", "--degree-in", "momenta=2"}, 2, "--degree-in:1:1");
  refused({"search", "kovalevskaya", "--degree-in", "M1,M2=2"}, 2, "'M3'");
  refused({"search", "kovalevskaya", "--degree", "2", "--weights", "auto", "--free", "r"}, 2,
          "--free");
  refused({"search", "kovalevskaya", "--degree", "2", "--darboux", "--degree-in", "M1=1"}, 2,
          "--darboux");
  refused({"search", "kovalevskaya", "--degree", "70"}, 4, "GB");
}

TEST(Exponents, OfTheIntegrableTopsAreIntegers) {
  const Folder folder;
  const Json found = answered(folder, {"exponents", "kovalevskaya"});
  EXPECT_EQ(found.at("verdict"), "proved");
  ASSERT_GE(found.at("balances").size(), 2u);
  EXPECT_EQ(found.at("weights").at("M1"), "1");
  EXPECT_EQ(found.at("weights").at("g1"), "2");
  // The twin: a general top has exponents that are no rational numbers, and is excluded.
  const std::string file =
      folder.write("top.toml", heavy_top("(M1^2 + 2*M2^2 + 5*M3^2)/2 - g1", ""));
  const Outcome text = run_in(folder, {"exponents", file});
  EXPECT_TRUE(text.status == 0 || text.status == 3) << text.err;
  EXPECT_NE(text.out, run_in(folder, {"exponents", "kovalevskaya"}).out);
}

/// The exponents of each balance, in order; all conjugates of an algebraic one.
std::vector<std::vector<double>> exponents_in(const Json& found) {
  std::vector<std::vector<double>> result;
  for (const Json& balance : found.at("balances")) {
    auto& own = result.emplace_back();
    for (const Json& e : balance.at("exponents")) {
      for (int k = 0; k < e.at("multiplicity").get<int>(); ++k) {
        if (!e.contains("numeric")) {
          const auto text = e.at("value").get<std::string>();
          const std::size_t slash = text.find('/');
          own.push_back(std::stod(text) /
                        (slash == std::string::npos ? 1 : std::stod(text.substr(slash + 1))));
          continue;
        }
        for (const Json& root : e.at("numeric"))
          own.push_back(std::stod(root[0].get<std::string>()));
      }
    }
    std::ranges::sort(own);
  }
  return result;
}

bool has_near(const std::vector<std::vector<double>>& list, const std::vector<double>& wanted) {
  return std::ranges::any_of(list, [&](const std::vector<double>& own) {
    return std::ranges::equal(own, wanted,
                              [](double x, double y) { return std::abs(x - y) < 1e-3; });
  });
}

TEST(Exponents, NumericOnesAreTheExactOnes) {
  const Folder folder;
  for (std::vector<std::string> command :
       {std::vector<std::string>{"exponents", "kovalevskaya", "--param", "r=1"},
        {"exponents", "goryachev-chaplygin", "--param", "r=2"},
        {"exponents", "henon-heiles", "--param", "A=1", "--param", "B=1"},
        {"exponents", "chaplygin", "--param", "c=3"}}) {
    const auto exact = exponents_in(answered(folder, command));
    command.emplace_back("--numeric");
    const auto numeric = exponents_in(answered(folder, command));
    ASSERT_FALSE(exact.empty()) << command[1];
    for (const auto& balance : exact) EXPECT_TRUE(has_near(numeric, balance)) << command[1];
    for (const auto& balance : numeric) EXPECT_TRUE(has_near(exact, balance)) << command[1];
  }
}

// Clebsch's body has a balance of six equations that the exact analysis does not solve.
TEST(Exponents, ThatCannotBeExactAreNumericAndMarked) {
  const Folder folder;
  std::vector<std::string> command{"exponents", "clebsch"};
  const Json symbolic = answered(folder, command, 3);
  EXPECT_EQ(symbolic.at("verdict"), "undecided");
  for (const char* value : {"a1=1", "a2=2", "a3=4", "s=1"})
    command.insert(command.end(), {"--param", value});
  const Json found = answered(folder, command);
  EXPECT_EQ(found.at("verdict"), "undecided");
  EXPECT_GT(found.at("starts"), 0);
  EXPECT_TRUE(has_near(exponents_in(found), {-1, 0, 1, 2, 2, 2}));
  EXPECT_EQ(found.at("balances")[0].at("exponents")[0].at("kind"), "numeric");
}

TEST(Equilibria, OfAHeavyTopHangAndStand) {
  const Folder folder;
  const Json found = answered(folder, {"equilibria", "kovalevskaya"});
  EXPECT_GE(found.at("equilibria").size(), 2u);
}

TEST(SearchStructure, TensorsHaveTheirDimensionsAndComponents) {
  const Folder folder;
  const Json found = answered(folder, {"search", "clebsch", "--bivectors", "--degree", "1"});
  EXPECT_EQ(found.at("kind"), "bivectors");
  EXPECT_EQ(found.at("dimensions"), Json({0, 2}));
  EXPECT_EQ(found.at("verdict"), "proved");
  ASSERT_EQ(found.at("tensors").size(), 1u);
  EXPECT_EQ(found.at("tensors")[0].at("components").at("p1,p2"), "-M3");
  EXPECT_EQ(
      answered(folder, {"search", "clebsch", "--tensors", "2", "--degree", "1"}).at("tensors"),
      found.at("tensors"));
  EXPECT_EQ(answered(folder, {"search", "euler", "--forms", "--tensors", "2", "--degree", "2"})
                .at("dimensions"),
            Json({0, 0, 1}));
}

// What is found is put into a case file, which is verified.
TEST(SearchStructure, ABracketThatIsFoundIsABracketOfACaseFile) {
  const Folder folder;
  const std::string equations =
      "[phase_space]\nvariables = [\"x\", \"y\", \"z\"]\n[equations]\nx = \"2*y*z\"\ny = "
      "\"-3*x*z\"\nz = \"x*y\"\n";
  const std::string bare = folder.write("bare.toml", "title = \"bare\"\n" + equations);
  const Json found = answered(folder, {"search", bare, "--hamiltonian", "--degree", "1"});
  ASSERT_GE(found.at("brackets").size(), 1u);
  const Json& bracket = found.at("brackets")[0];
  std::string text = "title = \"found\"\nhamiltonian = \"" +
                     bracket.at("hamiltonian").get<std::string>() +
                     "\"\n[phase_space]\nvariables = [\"x\", \"y\", "
                     "\"z\"]\n[phase_space.brackets]\n";
  for (const auto& [pair, value] : bracket.at("brackets").items())
    text += "\"" + pair + "\" = \"" + value.get<std::string>() + "\"\n";
  text += "[casimirs]\nC = \"" + bracket.at("casimirs")[0].get<std::string>() + "\"\n";
  const std::string file = folder.write("found.toml", text);
  EXPECT_EQ(answered(folder, {"verify", file}).at("verdict"), "proved");
  const Json shown = run_in(folder, {"show", file, "--format", "json"}).json();
  EXPECT_EQ(shown.dump().find("error"), std::string::npos);
}

TEST(SearchStructure, NoBracketOfADampedBodyIsSaidForAllHamiltonians) {
  const Folder folder;
  const Json found = answered(folder, {"search", "damped-body", "--hamiltonian", "--degree", "2"});
  EXPECT_EQ(found.at("brackets"), Json::array());
  EXPECT_EQ(found.at("excluded"), "any_hamiltonian");
  EXPECT_EQ(found.at("verdict"), "proved");
}

TEST(SearchStructure, SecondBracketsHaveChains) {
  const Folder folder;
  const Json found = answered(folder, {"search", "clebsch", "--bihamiltonian", "--degree", "1"});
  ASSERT_EQ(found.at("brackets").size(), 1u);
  EXPECT_EQ(found.at("brackets")[0].at("chains").size(), 2u);
  EXPECT_EQ(found.at("first").at("jacobi"), "proved");
}

TEST(SearchStructure, VariablesThatSeparateAreTheRootsOfAPolynomial) {
  const Folder folder;
  const Json found =
      answered(folder, {"search", "goryachev-chaplygin", "--separation", "--degree", "2"});
  ASSERT_EQ(found.at("separations").size(), 1u);
  const Json& own = found.at("separations")[0];
  EXPECT_EQ(own.at("separated"), "proved");
  EXPECT_EQ(own.at("staeckel"), "proved");
  EXPECT_EQ(own.at("polynomial"), "u^2 + (2*M3)*u + (-M1^2 - M2^2)");
  EXPECT_EQ(own.at("relations")[0].at("sum"), "u*K1 - K2");
}

TEST(SearchStructure, TheMapToSeparatedVariablesIsWrittenAndProved) {
  const Folder folder;
  const Json found = answered(
      folder, {"search", "henon-heiles", "--separation", "--degree", "1", "-o", "separated.toml"});
  EXPECT_EQ(found.at("separations")[0].at("map"), "proved");
  EXPECT_EQ(found.at("file"), "separated.toml");
  answered(folder, {"verify", "./separated.toml"});
}

/// Of what was asked for, the file is missing.
TEST(SearchStructure, WhereNoMapIsMadeAFileIsNotWrittenAndTheReasonIsSaid) {
  const Folder folder;
  const std::vector<std::string> command = {
      "search", "goryachev-chaplygin", "--separation", "--degree", "2", "-o", "separated.toml"};
  const Json found = answered(folder, command, 3);
  EXPECT_EQ(found.at("separations")[0].at("separated"), "proved");
  EXPECT_EQ(
      found.at("separations")[0].at("no_map"),
      "an equation of {u, G} has Casimir functions in it, whose values the level does not fix");
  EXPECT_FALSE(found.contains("file"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "separated.toml"));
}

TEST(SearchStructure, TheFileOfAMapNeedsAName) {
  const Folder folder;
  const Outcome outcome =
      run_in(folder, {"search", "henon-heiles", "--separation", "--degree", "1", "-o", ""});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_TRUE(has(outcome.err, "--output: a name of a file is needed")) << outcome.err;
}

TEST(SearchStructure, RootsThatAreGivenAreRefuted) {
  const Folder folder;
  const Json found =
      answered(folder, {"search", "henon-heiles", "--separation", "--roots", "(u - x)*(u - y)"}, 1);
  EXPECT_EQ(found.at("verdict"), "refuted");
  answered(folder, {"search", "henon-heiles", "--separation", "--roots", "u^2 + 1"}, 3);
}

TEST(SearchStructure, DarbouxPolynomialsAreCombined) {
  const Folder folder;
  const std::string file =
      folder.write("node.toml",
                   "title = \"node\"\n[phase_space]\nvariables = [\"x\", \"y\"]\n[equations]\nx = "
                   "\"2*x\"\ny = \"3*y\"\n");
  const Json found = answered(folder, {"search", file, "--darboux", "--degree", "1"});
  EXPECT_EQ(found.at("integrals"), Json({"x^3/y^2"}));
  EXPECT_EQ(answered(folder, {"verify", file, "--integral", "x^3/y^2"}).at("verdict"), "proved");
}

TEST(SearchStructure, DarbouxPolynomialsOfFreeParameters) {
  const Folder folder;
  const std::string file =
      folder.write("lorenz.toml",
                   "[phase_space]\nvariables = [\"x\", \"y\", \"z\"]\n[parameters]\ns = {}\nr = "
                   "{}\nb = {}\n[equations]\nx = \"s*(y - x)\"\ny = \"r*x - y - x*z\"\nz = "
                   "\"x*y - b*z\"\n");
  const std::vector<std::string> search{"search", file,     "--darboux", "--degree",
                                        "2",      "--free", "b"};
  const Json found = answered(folder, search);
  ASSERT_EQ(found.at("conditions").size(), 1U);
  const Json& condition = found.at("conditions")[0];
  EXPECT_EQ(condition.at("parameters"), Json({{"b", "2*s"}}));
  EXPECT_EQ(condition.at("invariant_relations")[0].at("cofactor"), "-2*s");
  EXPECT_EQ(condition.at("verdict"), "proved");
  EXPECT_EQ(found.at("verdict"), "proved");
  const Outcome outcome = run_in(folder, search);
  EXPECT_NE(outcome.out.find("b = 2*s   proved\n  F = x^2 - 2*z*s   K = -2*s"), std::string::npos)
      << outcome.out;
  EXPECT_EQ(run_in(folder, {"search", file, "--darboux", "--degree", "1", "--free", "q"}).status,
            2);
}

TEST(SearchStructure, FieldsThatTakeOrbitsToOrbits) {
  const Folder folder;
  const std::vector<std::string> search{"search",   "kovalevskaya", "--fields",
                                        "--orbits", "--degree",     "2"};
  const Json found = answered(folder, search);
  ASSERT_EQ(found.at("fields").size(), 1U);
  EXPECT_EQ(found.at("fields")[0].at("factor"), "-1");
  EXPECT_EQ(found.at("fields")[0].at("components").at("g1"), "2*g1");
  EXPECT_EQ(found.at("verdict"), "proved");
  EXPECT_NE(run_in(folder, search).out.find("(2*g1) d/dg1"), std::string::npos);
}

TEST(SearchStructure, TensorsThatTheMotionMultiplies) {
  const Folder folder;
  const std::string file = folder.write(
      "damped.toml",
      "title = \"x\"\n[phase_space]\nvariables = [\"q\", \"p\"]\n[parameters]\nc = {}\n"
      "[equations]\nq = \"p\"\np = \"-q - q^3 - c*p\"\n");
  const std::vector<std::string> search{"search",  file,          "--tensors", "2",
                                        "--forms", "--conformal", "--degree",  "2"};
  const Json found = answered(folder, search);
  EXPECT_EQ(found.at("kind"), "conformal 2-forms");
  ASSERT_EQ(found.at("tensors").size(), 1U);
  EXPECT_EQ(found.at("tensors")[0].at("factor"), "-c");
  EXPECT_EQ(found.at("tensors")[0].at("components").at("q,p"), "1");
  EXPECT_EQ(found.at("verdict"), "proved");
  EXPECT_NE(run_in(folder, search).out.find("(1) dq^dp   f = -c   proved"), std::string::npos);
}

TEST(SearchStructure, LaxPairsAreCounted) {
  const Folder folder;
  const Json proved = answered(folder, {"verify", "lagrange-lax"});
  for (const Json& claim : proved.at("claims")) {
    if (claim.at("kind") != "lax") continue;
    EXPECT_EQ(claim.at("spectrum").at("verdict"), "proved");
    EXPECT_EQ(claim.at("spectrum").at("involution"), "proved");
    EXPECT_EQ(claim.at("spectrum").at("leaf"), 4);
    EXPECT_EQ(claim.at("spectrum").at("independent_on_leaves"), 2);
  }
  EXPECT_NE(run_in(folder, {"verify", "lagrange-lax"}).out.find("all in involution; 2 "),
            std::string::npos);
}

TEST(SearchStructure, OptionsThatDoNotGoTogetherAreNamed) {
  const Folder folder;
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{"--fields", "--hamiltonian"},
        {"--bivectors", "--on", "M1"},
        {"--bivectors", "--tensors", "3"},
        {"--orbits"},
        {"--orbits", "--forms"},
        {"--conformal"},
        {"--conformal", "--hamiltonian"},
        {"--conformal", "--fields", "--orbits"},
        {"--darboux", "--fields"}}) {
    std::vector<std::string> arguments{"search", "euler", "--degree", "1"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    EXPECT_EQ(run_in(folder, arguments).status, 2) << more.front();
  }
  EXPECT_EQ(run_in(folder, {"search", "euler", "--degree", "0"}).status, 2);
}

}  // namespace
}  // namespace casimir::test
