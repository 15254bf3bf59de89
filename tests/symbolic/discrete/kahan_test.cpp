// Kahan's map: what it is made of, what it keeps, and how the degrees of its iterates grow.
#include "symbolic/discrete/kahan.hpp"

#include <gtest/gtest.h>

#include "symbolic/discrete/degrees.hpp"
#include "symbolic/discrete/growth.hpp"
#include "symbolic/discrete/prove_map.hpp"
#include "tests/symbolic/cases.hpp"
#include "tests/symbolic/discrete/maps.hpp"

namespace casimir::test {
namespace {

using discrete::DegreeRequest;
using discrete::degrees_of_iterates;
using discrete::degrees_of_kahan_iterates;
using Degrees = std::vector<int>;

/// Equations with whatever else is a name as a parameter.
Model flow(const std::vector<std::string>& variables, const std::vector<std::string>& rates,
           const std::vector<std::string>& parameters = {}) {
  std::string text = "[phase_space]\nvariables = [";
  for (const std::string& x : variables) text += "\"" + x + "\", ";
  text += "]\n[parameters]\n";
  for (const std::string& p : parameters) text += p + " = {}\n";
  text += "[equations]\n";
  for (std::size_t i = 0; i < rates.size(); ++i) text += variables[i] + " = \"" + rates[i] + "\"\n";
  return model_of(text);
}

Model on_e3(const std::string& hamiltonian, const std::string& algebra,
            const std::vector<std::string>& parameters) {
  std::string text = "hamiltonian = \"" + hamiltonian +
                     "\"\n[phase_space]\nvariables = [\"M1\", \"M2\", \"M3\", \"p1\", \"p2\", "
                     "\"p3\"]\n" +
                     algebra + "\n[parameters]\n";
  for (const std::string& p : parameters) text += p + " = {}\n";
  return model_of(text);
}

const std::string kE3 = "algebra = \"e(3)\"";
const std::string kTwoSpheres =
    "[phase_space.brackets]\n\"M1,M2\" = \"-M3\"\n\"M2,M3\" = \"-M1\"\n\"M1,M3\" = \"M2\"\n"
    "\"p1,p2\" = \"-p3\"\n\"p2,p3\" = \"-p1\"\n\"p1,p3\" = \"p2\"\n";

/// So many degrees, the first ones.
Degrees first(const Model& model, int count) {
  return degrees_of_kahan_iterates(model, {count, true});
}

Degrees first(const std::string& name, int count) { return first(bundled(name), count); }

TEST(Kahan, DegreesInThreeDimensions) {
  const Degrees euler{3, 9, 19, 33, 51, 73, 99};
  EXPECT_EQ(first("euler", 7), euler);
  EXPECT_EQ(first(flow({"x", "y", "z"}, {"a*y*z", "b*z*x", "c*x*y"}, {"a", "b", "c"}), 7), euler);
  const std::vector<std::string> rotors{"(A3 - A2)*y*z + l2*A3*z - l3*A2*y",
                                        "(A1 - A3)*z*x + l3*A1*x - l1*A3*z",
                                        "(A2 - A1)*x*y + l1*A2*y - l2*A1*x"};
  const auto with = [&](const std::vector<std::string>& fixed) {
    std::string text;
    for (const std::string& zero : fixed) text += zero + " = \"0\"\n";
    Model model = model_of(
        "[phase_space]\nvariables = [\"x\", \"y\", \"z\"]\n[parameters]\nA1 = "
        "{}\nA2 = {}\nA3 = {}\n" +
        std::string(fixed.empty() ? "l1 = {}\nl2 = {}\n" : "") + "l3 = {}\n[definitions]\n" + text +
        "[equations]\nx = \"" + rotors[0] + "\"\ny = \"" + rotors[1] + "\"\nz = \"" + rotors[2] +
        "\"\n");
    return first(model, 5);
  };
  EXPECT_EQ(with({"l1", "l2"}), (Degrees{3, 9, 19, 33, 51}));
  EXPECT_EQ(with({}), (Degrees{3, 9, 27, 81, 243}));
  EXPECT_EQ(first(flow({"x", "y", "z"}, {"x*y - x*z", "y*z - y*x", "z*x - z*y"}), 7),
            (Degrees{3, 7, 15, 25, 39, 55, 75}));
  EXPECT_EQ(first(flow({"x", "y", "z"}, {"10*(y - x)", "28*x - y - x*z", "x*y - 8*z/3"}), 5),
            (Degrees{3, 9, 27, 81, 243}));
}

TEST(Kahan, DegreesInTheOtherDimensions) {
  EXPECT_EQ(first(flow({"x", "y"}, {"x - x*y", "x*y - y"}), 5), (Degrees{2, 4, 8, 16, 32}));
  EXPECT_EQ(first(flow({"x", "y"}, {"x^2 - y^2", "-2*x*y"}), 9),
            (Degrees{2, 4, 8, 13, 20, 28, 38, 49, 62}));
  EXPECT_EQ(first(flow({"x", "y"}, {"2*x^2 - 12*y^2", "-6*x*y - 4*y^2"}), 9),
            (Degrees{2, 4, 7, 12, 18, 25, 34, 44, 55}));
  EXPECT_EQ(
      first(flow({"x", "y", "u", "v"}, {"u", "v", "-A*x - 2*x*y", "-A*y - x^2 - y^2"}, {"A"}), 9),
      (Degrees{3, 5, 9, 13, 21, 29, 39, 49, 63}));
}

TEST(Kahan, DegreesOfTopsAndBodiesInFluid) {
  EXPECT_EQ(first("lagrange", 5), (Degrees{6, 18, 38, 66, 102}));
  EXPECT_EQ(
      first(on_e3("a*(M1^2 + M2^2 + M3^2)/2 + r1*p1 + r2*p2 + r3*p3", kE3, {"a", "r1", "r2", "r3"}),
            5),
      (Degrees{4, 13, 28, 49, 76}));
  EXPECT_EQ(first("euler-e3", 6), (Degrees{6, 14, 26, 42, 62, 86}));
  EXPECT_EQ(first("kovalevskaya", 3), (Degrees{6, 33, 180}));
  EXPECT_EQ(first("goryachev-chaplygin", 3), (Degrees{6, 33, 180}));
  EXPECT_EQ(first("clebsch", 5), (Degrees{6, 21, 46, 81, 126}));
  EXPECT_EQ(
      first(on_e3("(M1^2 + M2^2 + M3^2 + c1*p1^2 + c2*p2^2 + c3*p3^2)/2", kE3, {"c1", "c2", "c3"}),
            6),
      (Degrees{6, 19, 42, 73, 114, 163}));
  EXPECT_EQ(first(on_e3("(a*(M1^2 + M2^2) + a3*M3^2 + c*(p1^2 + p2^2) + c3*p3^2)/2", kE3,
                        {"a", "a3", "c", "c3"}),
                  5),
            (Degrees{6, 21, 46, 81, 126}));
  const std::string diagonal =
      "(a1*M1^2 + a2*M2^2 + a3*M3^2 + c1*p1^2 + c2*p2^2 + c3*p3^2)/2 + b1*M1*p1 + b2*M2*p2 + "
      "b3*M3*p3";
  const std::vector<std::string> nine{"a1", "a2", "a3", "b1", "b2", "b3", "c1", "c2", "c3"};
  EXPECT_EQ(first(on_e3(diagonal, kE3, nine), 3), (Degrees{6, 36, 216}));
  EXPECT_EQ(first(on_e3(diagonal, kTwoSpheres, nine), 3), (Degrees{6, 36, 216}));
  EXPECT_EQ(first("manakov-so4", 5), (Degrees{6, 21, 46, 81, 126}));
}

TEST(Degrees, OfOtherMaps) {
  const auto of = [](const std::string& name, int count) {
    return degrees_of_iterates(bundled_map(name), {count, false});
  };
  EXPECT_EQ(of("mcmillan", 5), (Degrees{3, 9, 19, 33, 51}));
  EXPECT_EQ(of("lyness", 11), (Degrees{2, 2, 3, 4, 5, 7, 9, 11, 14, 16, 20}));
  EXPECT_EQ(of("henon-area-preserving", 5), (Degrees{2, 4, 8, 16, 32}));
  EXPECT_EQ(of("qrt", 6), (Degrees{18, 66, 146, 258, 402, 578}));
  const std::string plane = "[phase_space]\nvariables = [\"x\", \"y\"]\n";
  const auto made = [&](const std::string& text, int count) {
    return degrees_of_iterates(
        build_map_model(std::get<MapCaseFile>(parse_any_case(plane + text, "test.toml"))),
        {count, false});
  };
  EXPECT_EQ(made("[parameters]\na = {}\n[map]\nx = \"-y + x + a/x^2\"\ny = \"x\"\n", 6),
            (Degrees{3, 9, 27, 73, 195, 513}));
  EXPECT_EQ(made("[map]\nx = \"2*x\"\ny = \"x + y\"\n", 3), (Degrees{1, 1, 1}));
}

// The first rows of the document: what sort of growth its sequences suggest.
TEST(Degrees, GrowthIsReadOffTheBeginning) {
  const auto euler = discrete::growth_of({3, 9, 19, 33, 51, 73, 99});
  EXPECT_EQ(euler.kind, discrete::Growth::Kind::polynomial);
  EXPECT_EQ(euler.formula, "2*n^2 + 1");
  EXPECT_EQ(discrete::growth_of({6, 14, 26, 42, 62, 86}).formula, "2*n^2 + 2*n + 2");
  const auto lyness = discrete::growth_of({2, 2, 3, 4, 5, 7, 9, 11, 14, 16, 20, 23, 27, 31});
  EXPECT_EQ(lyness.kind, discrete::Growth::Kind::polynomial);
  EXPECT_EQ(lyness.degree, 2);
  const auto viallet = discrete::growth_of({3, 9, 27, 73, 195, 513, 1347, 3529});
  EXPECT_EQ(viallet.kind, discrete::Growth::Kind::exponential);
  EXPECT_NEAR(viallet.ratio.value(), 2.618034, 1e-2);
  EXPECT_EQ(discrete::growth_of({6, 33, 180}).kind, discrete::Growth::Kind::exponential);
  EXPECT_EQ(discrete::growth_of({6, 19, 42, 73, 114, 163}).degree, 2);
  EXPECT_EQ(discrete::growth_of({6}).kind, discrete::Growth::Kind::unclear);
}

/// Monomial maps with complex eigenvalues, and shifts that square or cube after some steps: their
/// degrees grow exponentially and stand still or fall in between.
TEST(Degrees, GrowthThatIsUnsteadyIsNotClear) {
  for (const std::vector<int>& degrees : {std::vector<int>{4, 4, 5, 12, 9, 22, 28, 31, 68, 67},
                                          {4, 4, 5, 12, 9, 22, 28},
                                          {4, 4, 5, 12, 9, 22, 28, 31},
                                          {2, 2, 2, 2, 2, 4, 4, 4, 4, 4},
                                          {3, 3, 3, 3, 3, 4, 4, 9, 9, 9, 9, 16, 16, 27},
                                          {3, 4, 10, 12, 30}}) {
    EXPECT_EQ(discrete::growth_of(degrees).kind, discrete::Growth::Kind::unclear) << degrees.size();
  }
}

/// Of monomial maps with one eigenvalue, 1: like n^5, and like n^4 from the seventh on.
TEST(Degrees, PolynomialGrowthOfAHighDegreeIsNotExponential) {
  const auto fifth = discrete::growth_of({2, 4, 8, 16, 32, 63, 120, 219, 382});
  EXPECT_EQ(fifth.kind, discrete::Growth::Kind::polynomial);
  EXPECT_EQ(fifth.degree, 5);
  EXPECT_NE(discrete::growth_of({5, 9, 13, 19, 36, 62, 99, 163, 256, 386}).kind,
            discrete::Growth::Kind::exponential);
  EXPECT_EQ(discrete::growth_of({6, 33, 180, 981}).kind, discrete::Growth::Kind::exponential);
  EXPECT_EQ(discrete::growth_of({3, 7, 17, 39, 93, 215, 495}).kind,
            discrete::Growth::Kind::exponential);
}

/// max(2^k, 3^l) of a block of three and one of four: 9 is the eighth, and not 3*4.
TEST(Degrees, ARecurrenceSaysFromWhereItHolds) {
  const auto growth =
      discrete::growth_of({3, 3, 3, 4, 9, 9, 9, 9, 27, 27, 27, 27, 81, 81, 81, 81, 243, 243});
  EXPECT_EQ(growth.recurrence, "d(n) = 3*d(n-4) for n > 8");
  EXPECT_EQ(discrete::growth_of({3, 9, 27, 81, 243, 729}).recurrence, "d(n) = 3*d(n-1)");
}

TEST(Kahan, OfACubicHamiltonianKeepsAHamiltonianAndAMeasure) {
  const Model flow = model_of(
      "hamiltonian = \"p^2/2 + a*q^2 + b*q^3 + q*p^2\"\n[phase_space]\nvariables = [\"q\", "
      "\"p\"]\ncanonical = true\n[parameters]\na = {}\nb = {}\n");
  const RationalMapText map = kahan_map(flow, std::nullopt);
  ASSERT_TRUE(map.modified_integral && map.density);
  std::string text = "[phase_space]\nvariables = [\"q\", \"p\"]\n[parameters]\na = {}\nb = {}\n" +
                     map.step + " = {}\n[definitions]\n";
  for (const auto& [name, value] : map.definitions) text += name + " = \"" + value + "\"\n";
  text += "[map]\nq = \"" + map.next[0] + "\"\np = \"" + map.next[1] + "\"\n[integrals]\nF = \"" +
          *map.modified_integral + "\"\n[[measure]]\ndensity = \"" + *map.density + "\"\n";
  const MapModel model = build_map_model(std::get<MapCaseFile>(parse_any_case(text, "test.toml")));
  EXPECT_EQ(overall(model.base, prove_map(model)), Verdict::proved);
}

TEST(Kahan, RefusesWhatIsNotQuadratic) {
  const auto refused = [](const std::string& rate) {
    EXPECT_THROW(kahan_map(flow({"x"}, {rate}), std::nullopt), ModelError) << rate;
    EXPECT_THROW(degrees_of_kahan_iterates(flow({"x"}, {rate})), ModelError) << rate;
  };
  for (const char* rate : {"x^3", "1/x", "sin(x)", "sqrt(x^2)", "sqrt(x)"}) refused(rate);
  EXPECT_THROW(midpoint_map(flow({"x"}, {"x^2"}), std::nullopt), ModelError);
  EXPECT_NO_THROW(midpoint_map(flow({"x"}, {"x + 1"}), std::nullopt));
  EXPECT_NO_THROW(kahan_map(flow({"x"}, {"(x^3 + x)/x"}), std::nullopt));
  EXPECT_NO_THROW(kahan_map(flow({"x"}, {"x^2/a + sqrt(a)*x"}, {"a"}), std::nullopt));
}

}  // namespace
}  // namespace casimir::test
