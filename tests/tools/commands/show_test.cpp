// `casimir show`: vectors where a bracket has them and nowhere else, scalar products, the matrix.
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>

#include "tests/bundled_cases.hpp"
#include "tests/tools/program.hpp"

namespace casimir::test {
namespace {

/// {M_i, M_j} and {M_i, g_j} of e(3) as a table, {M1,g2} as given.
std::string e3_case(const std::string& m1_g2, const std::string& hamiltonian) {
  return "hamiltonian = \"" + hamiltonian +
         "\"\n[phase_space]\nvariables = [\"M1\", \"M2\", \"M3\", \"g1\", \"g2\", \"g3\"]\n"
         "[phase_space.brackets]\n\"M1,M2\" = \"-M3\"\n\"M1,M3\" = \"M2\"\n\"M2,M3\" = \"-M1\"\n"
         "\"M1,g2\" = \"" +
         m1_g2 +
         "\"\n\"M1,g3\" = \"g2\"\n\"M2,g1\" = \"g3\"\n\"M2,g3\" = \"-g1\"\n\"M3,g1\" = \"-g2\"\n"
         "\"M3,g2\" = \"g1\"\n[parameters]\na = {}\nr1 = {}\nr2 = {}\nr3 = {}\n";
}

std::string shown(const std::string& text, const std::string& format = "text") {
  const Outcome outcome = run({"show", "-", "--format", format}, text);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return outcome.out;
}

TEST(Show, PrintsBracketHamiltonianAndEquations) {
  const Outcome text = run({"show", "kovalevskaya"});
  EXPECT_EQ(text.status, 0);
  EXPECT_TRUE(has(text.out, "  M1    0  -M3   M2    0  -g3   g2\n")) << text.out;
  EXPECT_TRUE(has(text.out, "dM1/dt = M2*M3")) << text.out;
  EXPECT_TRUE(has(text.out, "rank 4"));
  const Outcome latex = run({"show", "kovalevskaya", "--format", "latex"});
  EXPECT_EQ(latex.status, 0);
  EXPECT_TRUE(has(latex.out, "\\dot{M}_{1} &= M_{2} M_{3}")) << latex.out;
  EXPECT_TRUE(has(latex.out, "\\dot{M}_{2} &= -M_{1} M_{3} - r \\gamma_{3}")) << latex.out;
  EXPECT_EQ(run({"show", "kovalevskaya", "--format", "json"}).json(),
            run({"show", "kovalevskaya", "--json"}).json());
}

/// Products of conjugates are real; what is not has a letter for I.
TEST(Show, WritesAComplexLaxPair) {
  const Outcome text = run({"show", "goryachev-chaplygin-lax"});
  EXPECT_EQ(text.status, 0) << text.err;
  EXPECT_TRUE(has(text.out, "A =  [[M3*I - u*I/2, -I],")) << text.out;
  const Outcome latex = run({"show", "goryachev-chaplygin-lax", "--format", "latex"});
  EXPECT_TRUE(has(latex.out, "-i")) << latex.out;
}

TEST(Show, IsTheSameInEveryRun) {
  for (const char* format : {"text", "latex", "json"}) {
    const std::string first = run({"show", "steklov", "--format", format}).out;
    for (int k = 0; k < 5; ++k) EXPECT_EQ(run({"show", "steklov", "--format", format}).out, first);
  }
}

TEST(Show, WritesE3InVectors) {
  const std::string out = shown(e3_case("-g3", "M1^2 + r1*g1"));
  for (const char* line :
       {"  M = (M1, M2, M3)\n", "  {M_i, M_j} = -eps_ijk M_k\n", "  {M_i, g_j} = -eps_ijk g_k\n",
        "  {g_i, g_j} = 0\n", "  dM/dt = M x dH/dM + g x dH/dg\n", "  dg/dt = g x dH/dM\n",
        "  dH/dM = (2*M1, 0, 0)\n", "  dH/dg = (r1, 0, 0)\n"})
    EXPECT_TRUE(has(out, line)) << line << out;
}

TEST(Show, BentBracketIsWrittenInComponentsOnly) {
  const std::string out = shown(e3_case("g3", "M1^2 + M2*g2"));
  for (const char* part : {"vectors", "eps_ijk", "dM/dt", "dH/dM"})
    EXPECT_FALSE(has(out, part)) << part << out;
  EXPECT_TRUE(has(out, "dM1/dt = "));
  const auto json = nlohmann::ordered_json::parse(shown(e3_case("g3", "M1^2"), "json"));
  EXPECT_FALSE(json.contains("vector_equations"));
  EXPECT_FALSE(json.contains("vectors"));
  EXPECT_EQ(json.at("brackets").at("M1,g2"), "g3");
}

TEST(Show, ScalarProductsNeedThreeTermsWithOneFactor) {
  const std::string product = "M1*g1 + M2*g2 + M3*g3";
  EXPECT_TRUE(has(shown(e3_case("-g3", product)), "H = (M, g)\n"));
  EXPECT_TRUE(has(shown(e3_case("-g3", "(" + product + ")^2 - M1")), "H = (M, g)^2 - M1\n"));
  EXPECT_TRUE(has(shown(e3_case("-g3", "a*(M1^2 + M2^2 + M3^2)/2 + g1")), "H = (M, M)*a/2 + g1\n"));
  const std::string constants = shown(e3_case("-g3", "M1^2 - r1*g1 - r2*g2 - r3*g3"));
  EXPECT_TRUE(has(constants, "H = M1^2 - (r, g)\n")) << constants;
  EXPECT_TRUE(has(constants, "  r = (r1, r2, r3)\n")) << constants;
  for (const char* none : {"M1*g1 + M2*g2 - M3*g3", "M1*g1 + M2*g2", "M1*g1 + M2*g2 + 2*M3*g3",
                           "M1*g1 + M2*g2 + a*M3*g3", "M1*g2 + M2*g3 + M3*g1"})
    EXPECT_FALSE(has(shown(e3_case("-g3", none)), "H = (M, g)")) << none;
}

TEST(Show, GreekLettersInLatexUnlessTheCaseHasThem) {
  const std::string text = e3_case("-g3", "M1^2 + g1");
  EXPECT_TRUE(has(shown(text, "latex"), "\\boldsymbol\\gamma &= (\\gamma_{1}, "));
  const std::string taken = std::regex_replace(text, std::regex("\nr1 ="), "\ngamma =");
  const std::string out = shown(taken, "latex");
  EXPECT_TRUE(has(out, "\\boldsymbol g &= (g_{1}, ")) << out;
  EXPECT_FALSE(has(out, "\\boldsymbol\\gamma")) << out;
}

TEST(Show, LatexCanBeADocument) {
  const std::string document = run({"show", "clebsch", "--format", "latex", "--standalone"}).out;
  EXPECT_TRUE(document.starts_with("\\documentclass")) << document.substr(0, 80);
  EXPECT_TRUE(document.ends_with("\\end{document}\n"));
  const std::string displays = run({"show", "clebsch", "--format", "latex"}).out;
  EXPECT_NE(document.find(displays), std::string::npos);
  EXPECT_EQ(run({"show", "clebsch", "--standalone"}).status, 2);
}

TEST(Show, JsonHasTheBracketInBothForms) {
  const auto json = run({"show", "kovalevskaya", "--json"}).json();
  EXPECT_EQ(json.at("vectors").at("M"), (std::vector<std::string>{"M1", "M2", "M3"}));
  EXPECT_EQ(json.at("vector_equations").at("dg/dt"), "g x dH/dM");
  EXPECT_EQ(json.at("casimirs").at("F1"), "g1^2 + g2^2 + g3^2");  // as case files have it
  EXPECT_EQ(json.at("scalar_products").at("F1"), "(g, g)");
  const auto& matrix = json.at("structure_matrix");
  ASSERT_EQ(matrix.size(), 6U);
  EXPECT_EQ(matrix[0][1], "-M3");
  EXPECT_EQ(matrix[1][0], "M3");
  for (const auto& row : matrix) EXPECT_EQ(row.size(), 6U);
  for (const char* key : {"case", "title", "source", "phase_space", "variables", "parameters",
                          "assumptions", "brackets", "rank", "rank_evidence", "hamiltonian",
                          "equations", "casimirs", "integrals", "invariant_relation", "scenes"})
    EXPECT_TRUE(json.contains(key)) << key;
}

/// Whether braces, \left and \right, and environments are balanced.
bool balanced(const std::string& latex) {
  int braces = 0;
  int delimiters = 0;
  std::vector<std::string> environments;
  static const std::regex kToken(R"(\\(begin|end)\{([a-z*]+)\}|\\left\b|\\right\b|\\.|[{}])");
  for (std::sregex_iterator it(latex.begin(), latex.end(), kToken), end; it != end; ++it) {
    const std::string token = it->str();
    if ((*it)[1] == "begin") {
      environments.push_back((*it)[2]);
    } else if ((*it)[1] == "end") {
      if (environments.empty() || environments.back() != (*it)[2]) return false;
      environments.pop_back();
      if (braces != 0 || delimiters != 0) return false;
    }
    braces += token == "{" ? 1 : token == "}" ? -1 : 0;
    delimiters += token == "\\left" ? 1 : token == "\\right" ? -1 : 0;
    if (braces < 0 || delimiters < 0) return false;
  }
  return environments.empty() && braces == 0 && delimiters == 0;
}

TEST(EveryCase, HasBalancedLatex) {
  for (const auto& path : cases_to_go_through()) {
    const std::string name = path.stem().string();
    const std::string latex = run({"show", name, "--format", "latex"}).out;
    EXPECT_TRUE(balanced(latex)) << name << latex;
    EXPECT_FALSE(has(latex, "\\\\\n\\end")) << name << ": an empty last line";
  }
  const std::string latex = run({"show", "kovalevskaya", "--format", "latex"}).out;
  EXPECT_TRUE(has(latex, "\\begin{pmatrix}"));
  EXPECT_FALSE(balanced(latex + "}"));
  EXPECT_FALSE(balanced(std::regex_replace(latex, std::regex("end\\{pmatrix\\}"), "x")));
}

TEST(Show, LaxPairsAreClaimsToo) {
  const std::string lax =
      "\n[[lax]]\nL = [[\"0\", \"M1\"], [\"M1\", \"0\"]]\nA = [[\"0\", \"0\"], [\"0\", \"0\"]]\n";
  const std::string text = e3_case("-g3", "M1^2");
  EXPECT_TRUE(has(shown(text + lax), "  L =  [[0, M1],\n        [M1, 0]]\n")) << shown(text + lax);
  EXPECT_FALSE(has(shown(text), "Lax"));
}

/// a1 and a_1 may stand side by side in a case.
TEST(Show, NamesThatWouldBeOneOnPaperAreToldApart) {
  const Folder folder;
  folder.write("alike.toml",
               "title = \"t\"\n[phase_space]\nvariables = [\"a1\", \"a_1\"]\n[equations]\n"
               "a1 = \"2*a_1\"\na_1 = \"-a1\"\n");
  const Outcome outcome = run_in(folder, {"show", "./alike.toml", "--format", "latex"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("\\mathrm{a\\_1}"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("2 \\mathrm{a\\_1}"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("-a_{1}"), std::string::npos) << outcome.out;
}

}  // namespace
}  // namespace casimir::test
