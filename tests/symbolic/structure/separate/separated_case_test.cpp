// The case with the map to separated variables.
#include <gtest/gtest.h>

#include <algorithm>

#include "symbolic/structure/separate/separated_case.hpp"
#include "tests/symbolic/structure/separations.hpp"

namespace casimir::test {
namespace {

/// With all Casimir functions fixed the roots, G and {u, G} are a Poisson map, which is proved as
/// the maps of case files are. The same with another sign in the curve is refuted.
TEST(SeparatedCase, OfGoryachevAndChaplyginIsAPoissonMap) {
  const SeparationReport report = searched(bundled("goryachev-chaplygin"), 2,
                                           {"M1*g1 + M2*g2 + M3*g3", "g1^2 + g2^2 + g3^2 - 1"});
  ASSERT_EQ(report.found.size(), 1U) << report.reason;
  const Separation& own = report.found[0];
  EXPECT_EQ(own.map, Verdict::proved);
  std::string wrong = own.map_case;
  const std::size_t place = wrong.find("\"u1,w1\" = \"");
  ASSERT_NE(place, std::string::npos);
  wrong.insert(place + 11, "-1*");
  EXPECT_EQ(structure::verdict_of_map(wrong, {}), Verdict::refuted) << wrong;
}

/// Definitions and Casimir functions are not written, so nothing may go by their names.
TEST(SeparatedCase, WritesItsLevelAndDomainInTheVariablesAlone) {
  const Model top = model_of(R"toml(
hamiltonian = "(M1^2 + M2^2 + 4*M3^2)/2 - g1"
[phase_space]
variables = ["M1", "M2", "M3", "g1", "g2", "g3"]
algebra = "e(3)"
domain = ["twice != 0"]
[definitions]
area = "M1*g1 + M2*g2 + M3*g3"
twice = "2*M3"
[casimirs]
B = "g1^2 + g2^2 + g3^2"
[[conditional]]
name = "G"
expression = "M3*(M1^2 + M2^2) + M1*g3"
on = ["area"]
)toml");
  const SeparationReport report = searched(top, 2, {"area", "B - 1"});
  ASSERT_EQ(report.found.size(), 1U) << report.reason;
  EXPECT_EQ(report.found[0].map, Verdict::proved) << report.found[0].no_map;
  EXPECT_NE(report.found[0].map_case.find("domain = [\"2*M3 != 0\"]"), std::string::npos)
      << report.found[0].map_case;
}

/// Assumptions on parameters that have got values, and functions that are not used.
TEST(SeparatedCase, WritesNoParameterThatIsNotThere) {
  const std::string text = R"(
hamiltonian = "px^2 + py^2 + b*x^4 + a*y^4"
[phase_space]
variables = ["x", "y", "px", "py"]
canonical = true
[functions]
U = ["r"]
[parameters]
a = { assume = "a > b" }
b = { assume = "b != 0" }
[integrals]
E = "px^2 + b*x^4"
)";
  for (const char* b : {"", "-1/2"}) {
    ParameterValues values;
    if (*b != 0) values.emplace_back(text_of("b"), text_of(b));
    const SeparationReport report =
        examined(build_model(parse_case(text, "a test"), values), "(u - x)*(u - y)");
    ASSERT_EQ(report.found.size(), 1U) << report.reason;
    const Separation& own = report.found[0];
    EXPECT_EQ(own.map, Verdict::proved) << own.no_map << own.map_case;
    EXPECT_EQ(own.map_case.find("U"), std::string::npos) << own.map_case;
    EXPECT_NE(own.map_case.find(*b == 0 ? "\"a - b > 0\"" : "\"a + 1/2 > 0\""), std::string::npos)
        << own.map_case;
  }
}

TEST(SeparatedCase, SaysWhyThereIsNoMap) {
  const Model model = canonical(R"("x", "u1", "px", "py")", "px^2 + py^2 + x^4 + u1^4",
                                "[integrals]\nE = \"px^2 + x^4\"\n");
  const SeparationReport report = examined(model, "(u - x)*(u - u1)");
  ASSERT_EQ(report.found.size(), 1U) << report.reason;
  EXPECT_EQ(report.found[0].separated, Verdict::proved);
  EXPECT_TRUE(report.found[0].map_case.empty());
  EXPECT_EQ(report.found[0].no_map, "the case has the name 'u1', which the map needs");
}

}  // namespace
}  // namespace casimir::test
