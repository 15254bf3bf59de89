// Variables that separate: what is found is checked in numbers, what may not count does not.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <regex>

#include "symbolic/error.hpp"
#include "symbolic/structure/separate/leaves.hpp"
#include "symbolic/structure/separate/levi_civita.hpp"
#include "symbolic/structure/separate/multipliers.hpp"
#include "symbolic/structure/separate/roots.hpp"
#include "symbolic/structure/separate/separated_case.hpp"
#include "symbolic/structure/separation.hpp"
#include "tests/symbolic/cases.hpp"

namespace casimir::test {
namespace {

using structure::Separation;
using structure::SeparationReport;
using Complex = std::complex<double>;

Text text_of(const std::string& value) { return {value, {"a test", 1, 1}, {}}; }

Model canonical(const std::string& variables, const std::string& hamiltonian,
                const std::string& more = {}) {
  return model_of("hamiltonian = \"" + hamiltonian + "\"\n[phase_space]\nvariables = [" +
                  variables + "]\ncanonical = true\n" + more);
}

const std::string kPlane = R"("x", "y", "px", "py")";

SeparationReport searched(const Model& model, int degree, const std::vector<std::string>& on = {}) {
  structure::SeparationRequest request{degree, {}, {}};
  for (const std::string& own : on) request.on.push_back(text_of(own));
  return structure::find_separation(model, request);
}

/// Brackets of the roots with each other and with the integrals, at a point in doubles: by the
/// bracket of the model alone.
class AtPoint {
 public:
  AtPoint(const Model& model, const Separation& own, GiNaC::exmap values)
      : model_(model), own_(own), values_(std::move(values)) {
    for (const std::string& one : own.coefficients) a_.push_back(model.parse(text_of(one)));
    for (const std::string& one : own.integrals) f_.push_back(model.parse(text_of(one)));
    find_roots();
  }

  std::size_t size() const { return a_.size(); }
  Complex root(std::size_t i) const { return roots_[i]; }
  Complex slope(std::size_t i) const {
    Complex result = 1;
    for (std::size_t k = 0; k < size(); ++k)
      if (k != i) result *= roots_[i] - roots_[k];
    return result;
  }
  Complex with_integral(std::size_t i, std::size_t j) const {
    Complex sum = 0;
    for (std::size_t k = 0; k < size(); ++k)
      sum -= number(model_.poisson->bracket(a_[k], f_[j])) * power(i, size() - 1 - k);
    return sum / slope(i);
  }
  Complex with_root(std::size_t i, std::size_t j) const {
    Complex sum = 0;
    for (std::size_t k = 0; k < size(); ++k) {
      for (std::size_t l = 0; l < size(); ++l)
        sum += number(model_.poisson->bracket(a_[k], a_[l])) * power(i, size() - 1 - k) *
               power(j, size() - 1 - l);
    }
    return sum / slope(i) / slope(j);
  }
  /// s_j at a root, which is real in the tests.
  double multiplier(const Separation::Relation& relation, std::size_t j, std::size_t i) const {
    return number(model_.parse(text_of(with_number(relation.multipliers[j], own_.names.root, i))));
  }
  /// The difference of the two sides of the equation for {u, G}^2.
  double equation_defect(const Separation::Relation& relation, std::size_t i) const {
    double g = 0, w = 0;
    for (std::size_t j = 0; j < f_.size(); ++j) {
      g += multiplier(relation, j, i) * number(f_[j]);
      w += multiplier(relation, j, i) * with_integral(i, j).real();
    }
    const std::string sides = std::regex_replace(with_number(relation.equation, own_.names.root, i),
                                                 std::regex("\\bG\\b"), "(" + fraction_of(g) + ")");
    return number(model_.parse(text_of(sides))) - w * w;
  }
  double number(const GiNaC::ex& e) const {
    return GiNaC::ex_to<GiNaC::numeric>(e.subs(values_).evalf()).to_double();
  }

 private:
  std::string with_number(const std::string& text, const std::string& name, std::size_t i) const {
    return std::regex_replace(text, std::regex("\\b" + name + "\\b"),
                              "(" + fraction_of(roots_[i].real()) + ")");
  }
  static std::string fraction_of(double value) {
    const auto scaled = static_cast<long long>(std::llround(value * 1e12));
    return std::to_string(scaled) + "/1000000000000";
  }
  Complex power(std::size_t i, std::size_t exponent) const {
    Complex result = 1;
    for (std::size_t k = 0; k < exponent; ++k) result *= roots_[i];
    return result;
  }
  /// By Durand and Kerner.
  void find_roots() {
    for (std::size_t i = 0; i < size(); ++i)
      roots_.push_back(std::pow(Complex(0.4, 0.9), static_cast<double>(i)));
    for (int step = 0; step < 300; ++step) {
      for (std::size_t i = 0; i < size(); ++i) {
        Complex value = 1;
        for (const GiNaC::ex& one : a_) value = value * roots_[i] + number(one);
        roots_[i] -= value / slope(i);
      }
    }
  }

  const Model& model_;
  const Separation& own_;
  GiNaC::exmap values_;
  std::vector<GiNaC::ex> a_, f_;
  std::vector<Complex> roots_;
};

/// Variables and parameters in order.
GiNaC::exmap point_of(const Model& model, const std::vector<GiNaC::ex>& numbers) {
  GiNaC::exmap result;
  std::size_t next = 0;
  for (const auto* list : {&model.variables, &model.parameters})
    for (const GiNaC::symbol& one : *list) result[one] = numbers.at(next++);
  return result;
}

/// What the theorem assumes, in numbers.
void expect_separated(const Model& model, const SeparationReport& report,
                      const std::vector<GiNaC::ex>& numbers) {
  ASSERT_EQ(report.found.size(), 1U) << report.reason;
  const Separation& own = report.found[0];
  EXPECT_EQ(own.separated, Verdict::proved);
  EXPECT_EQ(own.staeckel, Verdict::proved);
  const AtPoint at(model, own, point_of(model, numbers));
  for (std::size_t i = 0; i < at.size(); ++i) {
    for (std::size_t k = 0; k < at.size(); ++k) {
      if (i == k) continue;
      EXPECT_GT(std::abs(at.root(i) - at.root(k)), 1e-3);
      EXPECT_LT(std::abs(at.with_root(i, k)), 1e-7);
    }
    const auto is_own = [&](const Separation::Relation& one) {
      return one.root.empty() ||
             std::abs(at.number(model.parse(text_of(one.root))) - at.root(i)) < 1e-6;
    };
    const auto relation = std::ranges::find_if(own.relations, is_own);
    ASSERT_NE(relation, own.relations.end());
    if (!relation->equation.empty()) EXPECT_LT(std::abs(at.equation_defect(*relation, i)), 1e-5);
    for (std::size_t k = 0; k < at.size(); ++k) {
      Complex sum = 0;
      for (std::size_t j = 0; j < at.size(); ++j)
        sum += at.multiplier(*relation, j, i) * at.with_integral(k, j);
      if (k == i)
        EXPECT_GT(std::abs(sum), 1e-4);
      else
        EXPECT_LT(std::abs(sum), 1e-6);
    }
  }
}

using GiNaC::numeric;

/// A point with (M, g) = 0.
const std::vector<GiNaC::ex> kOnLevel{
    1, numeric(1, 2), numeric(-3, 4), numeric(3, 5), 0, numeric(4, 5), 1};

TEST(Separation, OfGoryachevAndChaplyginIsFoundAgain) {
  const Model model = bundled("goryachev-chaplygin");
  const SeparationReport report = searched(model, 2);
  expect_separated(model, report, kOnLevel);
  const Separation& own = report.found[0];
  EXPECT_EQ(report.on, (std::vector<std::string>{"M1*g1 + M2*g2 + M3*g3"}));
  EXPECT_EQ(own.coefficients, (std::vector<std::string>{"2*M3", "-M1^2 - M2^2"}));
  EXPECT_EQ(own.relations[0].multipliers, (std::vector<std::string>{"u", "-1"}));
  EXPECT_EQ(own.relations[0].equation,
            "-4*G^2 + 4*u^3*G - u^6 + (4*g1^2*r^2 + 4*g2^2*r^2 + 4*g3^2*r^2)*u^2");
  for (const Verdict verdict : {own.tangent, own.compatible, own.jacobi, own.involution})
    EXPECT_EQ(verdict, Verdict::proved);
  EXPECT_TRUE(own.real);
}

/// With all Casimir functions fixed the roots, G and {u, G} are a Poisson map, which is proved as
/// the maps of case files are. The same with another sign in the curve is refuted.
TEST(Separation, OfGoryachevAndChaplyginIsAPoissonMap) {
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
TEST(Separation, WritesItsLevelAndDomainInTheVariablesAlone) {
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

/// Neither bracket nor Hamiltonian nor integral is given, only the level.
TEST(Separation, OfGoryachevAndChaplyginIsFoundFromBareEquations) {
  const Model bare = model_of(R"(
[phase_space]
variables = ["M1", "M2", "M3", "g1", "g2", "g3"]
[parameters]
r = {}
[equations]
M1 = "3*M2*M3"
M2 = "-3*M1*M3 - r*g3"
M3 = "r*g2"
g1 = "4*M3*g2 - M2*g3"
g2 = "M1*g3 - 4*M3*g1"
g3 = "M2*g1 - M1*g2"
)");
  const SeparationReport report = searched(bare, 2, {"M1*g1 + M2*g2 + M3*g3"});
  EXPECT_TRUE(report.bracket_of_motion);
  expect_separated(bundled("goryachev-chaplygin"), report, kOnLevel);
}

/// Elliptic coordinates on the sphere.
TEST(Separation, OfNeumannsProblemIsElliptic) {
  const Model model = bundled("neumann-sphere");
  const SeparationReport report =
      searched(model, 3, {"M1*g1 + M2*g2 + M3*g3", "g1^2 + g2^2 + g3^2 - 1"});
  expect_separated(model, report, {3, 0, -1, numeric(2, 7), numeric(3, 7), numeric(6, 7), 1, 3, 7});
}

TEST(Separation, OfHenonAndHeilesIsParabolic) {
  const Model model = bundled("henon-heiles");
  expect_separated(model, searched(model, 1), {1, 2, 3, numeric(1, 2), 2, numeric(1, 3)});
}

/// Three degrees of freedom: elliptic coordinates in space.
TEST(Separation, OfGarniersSystemIsElliptic) {
  const Model model =
      canonical(R"("x", "y", "z", "px", "py", "pz")",
                "(px^2 + py^2 + pz^2)/2 + (x^2 + y^2 + z^2)^2 + a*x^2 + b*y^2 + c*z^2",
                "[parameters]\na = {}\nb = {}\nc = {}\n");
  expect_separated(model, searched(model, 2), {1, 2, numeric(1, 2), 3, 1, numeric(2, 3), 1, 3, 7});
}

/// With roots in the Hamiltonian: parabolic coordinates of a charge in a field.
TEST(Separation, OfTheStarkEffectIsParabolic) {
  const Model model = canonical(kPlane, "(px^2 + py^2)/2 - k/sqrt(x^2 + y^2) - f*x",
                                "[parameters]\nk = {}\nf = {}\n[integrals]\nR = \"py*(x*py - y*px) "
                                "- k*x/sqrt(x^2 + y^2) + f*y^2/2\"\n");
  expect_separated(model, searched(model, 1), {3, 4, 1, 2, 2, numeric(1, 3)});
}

/// The roots are polynomials, and each has multipliers of its own.
TEST(Separation, MayHaveAnotherSumForEachRoot) {
  const Model model = canonical(kPlane, "(px^2 + py^2)/2 + x^2*y + y^3/3");
  const SeparationReport report = searched(model, 1);
  expect_separated(model, report, {1, 3, 2, numeric(1, 2)});
  EXPECT_EQ(report.found[0].relations.size(), 2U);
  EXPECT_FALSE(report.found[0].relations[0].root.empty());
}

/// In Flaschka's variables the whole momentum is a Casimir function, and stands in the sum.
TEST(Separation, TakesCasimirFunctionsForConstants) {
  const Model model = model_of(R"(
hamiltonian = "(b1^2 + b2^2 + b3^2)/2 + a1 + a2"
[phase_space]
variables = ["a1", "a2", "b1", "b2", "b3"]
[phase_space.brackets]
"a1,b1" = "-a1"
"a1,b2" = "a1"
"a2,b2" = "-a2"
"a2,b3" = "a2"
)");
  const SeparationReport report = searched(model, 2);
  expect_separated(model, report, {1, 2, 3, numeric(1, 2), -1});
  EXPECT_EQ(report.found[0].relations[0].multipliers[0], "u + (b1 + b2 + b3)");
  EXPECT_FALSE(report.found[0].relations[0].may_vanish);
}

TEST(Separation, NeedsAsManyIntegralsAsDegreesOfFreedom) {
  const Model model =
      canonical(kPlane, "(px^2 + py^2)/2 + x^2*y + a*y^3", "[parameters]\na = {}\n");
  const SeparationReport report = searched(model, 1);
  EXPECT_TRUE(report.found.empty());
  EXPECT_FALSE(report.none);
  EXPECT_TRUE(report.reason.starts_with("2 integrals in involution")) << report.reason;
}

/// K commutes with H at no point of an open set: what the case claims is not believed.
TEST(Separation, LeavesOutIntegralsThatAreNone) {
  const Model model = canonical(kPlane, "(px^2 + py^2)/2 + x^2*y + a*y^3",
                                "[parameters]\na = {}\n[integrals]\nK = \"px\"\n");
  const SeparationReport report = searched(model, 1);
  EXPECT_TRUE(report.found.empty());
  EXPECT_EQ(report.integrals.size(), 1U);
}

/// Each of the integrals A, B that are claimed has no bivector of degree 1 beside the Hamiltonian,
/// and A - B has one: no word about all of them.
TEST(Separation, OfOtherCombinationsOfIntegralsIsNotExcluded) {
  const std::string p1 = "(px + x^2)", p2 = "(py + y^2)";
  const std::string l = "3*(x*" + p2 + " - y*" + p1 + ")*" + p1 + " + 5*" + p2 + "^2";
  const SeparationReport report =
      searched(canonical(kPlane, p1 + "^2 + " + p2 + "^2",
                         "[integrals]\nA = \"" + l + " - 7*" + p1 + "\"\nB = \"" + l + "\"\n"),
               1);
  EXPECT_TRUE(report.found.empty());
  EXPECT_FALSE(report.none);
}

TEST(Separation, ThatDoesNotExistIsSaidOfTheIntegralsAndOfTheSpaceThatWereLookedAt) {
  const SeparationReport report = searched(bundled("kovalevskaya"), 1);
  EXPECT_TRUE(report.none) << report.reason;
  EXPECT_EQ(report.involved.size(), 2U);
  EXPECT_EQ(report.not_used.size(), 1U);
}

TEST(Separation, UsesNoNameOfTheCase) {
  const SeparationReport report =
      searched(canonical(R"("G", "u", "F1", "w")", "(F1^2 + w^2)/2 + G^4 + u^4 + K*u",
                         "[parameters]\nK = {}\n[integrals]\nI1 = \"F1^2/2 + G^4\"\n"),
               1);
  ASSERT_EQ(report.found.size(), 1U);
  const structure::SeparationNames& names = report.found[0].names;
  for (const std::string& own : {names.root, names.sum, names.rate})
    EXPECT_TRUE(own != "G" && own != "u" && own != "w" && own != "K") << own;
  EXPECT_NE(names.integral, "F");
  EXPECT_EQ(report.found[0].map, Verdict::proved);
}

TEST(Separation, NamesWhereTheGivenPolynomialHasNoRoots) {
  structure::SeparationRequest request;
  request.roots = text_of("(a*u - x)*(u - y)");
  const SeparationReport report = structure::find_separation(
      canonical(kPlane, "(px^2 + py^2)/2 + x^4 + y^4",
                "[parameters]\na = {}\n[integrals]\nK = \"px^2/2 + x^4\"\n"),
      request);
  ASSERT_EQ(report.found.size(), 1U);
  EXPECT_EQ(report.found[0].separated, Verdict::proved);
  const std::vector<std::string>& nonzero = report.found[0].nonzero;
  EXPECT_NE(std::ranges::find(nonzero, "a"), nonzero.end());
}

TEST(Separation, HasNothingToDoInOneDegreeOfFreedom) {
  const SeparationReport report = searched(canonical(R"("q", "p")", "p^2 + q^4"), 2);
  EXPECT_EQ(report.freedom, 1U);
  EXPECT_TRUE(report.found.empty());
}

TEST(Separation, IsSaidNotToExistWhereTheLinearConditionsHaveNoSolution) {
  const SeparationReport report = searched(bundled("clebsch"), 2);
  EXPECT_TRUE(report.found.empty());
  EXPECT_TRUE(report.none) << report.reason;
}

/// All of degree 0 have constant roots: compatible, Poisson, in involution, and no variables.
TEST(Separation, DoesNotCountConstantRoots) {
  const Model model =
      canonical(kPlane, "(px^2 + py^2)/2 + a*x^2 + b*y^2", "[parameters]\na = {}\nb = {}\n");
  const SeparationReport report = searched(model, 0);
  EXPECT_TRUE(report.found.empty());
  EXPECT_FALSE(report.none);
  EXPECT_GT(report.examined, 0U);
}

TEST(Separation, NeedsThePoissonBracketItself) {
  const Model model = model_of(R"(
hamiltonian = "x^2 + y^2"
[phase_space]
variables = ["x", "y", "z", "w"]
[phase_space.brackets]
"x,y" = "z"
"z,w" = "x"
)");
  const SeparationReport report = searched(model, 1);
  EXPECT_TRUE(report.found.empty());
  EXPECT_EQ(report.reason, "the bracket is not shown to obey the Jacobi identity");
}

TEST(Separation, IsAskedForOnLevelsOfCasimirFunctionsOnly) {
  EXPECT_THROW(searched(bundled("goryachev-chaplygin"), 1, {"M1"}), structure::NotLeaves);
}

SeparationReport examined(const Model& model, const std::string& roots) {
  structure::SeparationRequest request;
  request.roots = Text{roots, {"a test", 1, 1}, roots};
  return structure::find_separation(model, request);
}

TEST(RootsThatAreGiven, AreProvedToSeparate) {
  const Model model = bundled("goryachev-chaplygin");
  const SeparationReport report = examined(model, "u^2 - 2*M3*u - (M1^2 + M2^2)");
  expect_separated(model, report, kOnLevel);
  EXPECT_TRUE(report.found[0].bivector.empty());
}

/// 3 in place of 2: the roots commute and are coordinates, but Levi-Civita's condition fails.
TEST(RootsThatAreGiven, AreRefutedWhereNothingSeparates) {
  const SeparationReport report =
      examined(bundled("goryachev-chaplygin"), "u^2 - 3*M3*u - (M1^2 + M2^2)");
  ASSERT_EQ(report.found.size(), 1U);
  EXPECT_EQ(report.found[0].commuting, Verdict::proved);
  EXPECT_EQ(report.found[0].separated, Verdict::refuted);
}

Model central() {
  return canonical(kPlane, "(px^2 + py^2)/2 - k/sqrt(x^2 + y^2)",
                   "[parameters]\nk = {}\n[integrals]\nL = \"x*py - y*px\"\n");
}

/// Polar coordinates: H = pr^2/2 + L^2/(2 r^2) + U(r) is not linear in L, so that Staeckel's form
/// is not there, and Levi-Civita's condition decides.
TEST(RootsThatAreGiven, MaySeparateWithoutStaeckelsForm) {
  const SeparationReport report = examined(central(), "(u - x^2 - y^2)*(u - y/x)");
  ASSERT_EQ(report.found.size(), 1U);
  EXPECT_EQ(report.found[0].separated, Verdict::proved);
  EXPECT_EQ(report.found[0].staeckel, Verdict::undecided);
  const SeparationReport cartesian = examined(central(), "(u - x)*(u - y)");
  EXPECT_EQ(cartesian.found.at(0).separated, Verdict::refuted);
}

TEST(RootsThatAreGiven, AreRefutedWhereTheyDoNotCommute) {
  const SeparationReport report = examined(central(), "(u - x^2 - y^2)*(u - x*px)");
  ASSERT_EQ(report.found.size(), 1U);
  EXPECT_EQ(report.found[0].commuting, Verdict::refuted);
  EXPECT_EQ(report.found[0].separated, Verdict::refuted);
}

/// Assumptions on parameters that have got values, and functions that are not used.
TEST(Separation, WritesNoParameterThatIsNotThere) {
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

TEST(Separation, SaysWhyThereIsNoMap) {
  const Model model = canonical(R"("x", "u1", "px", "py")", "px^2 + py^2 + x^4 + u1^4",
                                "[integrals]\nE = \"px^2 + x^4\"\n");
  const SeparationReport report = examined(model, "(u - x)*(u - u1)");
  ASSERT_EQ(report.found.size(), 1U) << report.reason;
  EXPECT_EQ(report.found[0].separated, Verdict::proved);
  EXPECT_TRUE(report.found[0].map_case.empty());
  EXPECT_EQ(report.found[0].no_map, "the case has the name 'u1', which the map needs");
}

/// The discriminant of six roots has 56183 terms, too many to be factored: their differences are
/// said.
TEST(Separation, OfSixRootsThatArePolynomialsIsSaidByDifferences) {
  std::string variables, momenta, hamiltonian, integrals, roots;
  for (int i = 1; i <= 6; ++i) {
    const std::string n = std::to_string(i), comma = i < 6 ? ", " : "";
    const std::string own = "p" + n + "^2/2 + " + n + "*q" + n + (i % 2 == 0 ? "^4" : "^2");
    variables += "\"q" + n + "\", ";
    momenta += "\"p" + n + "\"" + comma;
    hamiltonian += (i > 1 ? " + " : "") + own;
    if (i < 6) integrals += "E" + n + " = \"" + own + "\"\n";
    roots += (i > 1 ? "*(u - q" : "(u - q") + n + ")";
  }
  const SeparationReport report =
      examined(canonical(variables + momenta, hamiltonian, "[integrals]\n" + integrals), roots);
  ASSERT_EQ(report.found.size(), 1U) << report.reason;
  EXPECT_EQ(report.found[0].separated, Verdict::proved) << report.found[0].reason;
  EXPECT_EQ(report.found[0].nonzero.size(), 21U);  // 15 differences, 6 momenta
}

/// Its degree is not the one that was asked for.
TEST(Separation, SaysWhichSearchWasTooLarge) {
  search::Watch watch;
  watch.memory_limit = 1;
  try {
    structure::find_separation(central(), {1, {}, {}}, watch);
    ADD_FAILURE();
  } catch (const search::TooMuchMemory& problem) {
    EXPECT_EQ(std::string(problem.what())
                  .find("the search for Casimir functions up to degree 2, which this needs, is too "
                        "large: degree 2 has "),
              0U)
        << problem.what();
  }
}

/// Where: the roots are given on a command line.
TEST(Separation, SaysWhatIsWrongWithThePolynomial) {
  const std::vector<std::pair<std::string, std::string>> wrong = {
      {"(sin(x)^2 + cos(x)^2 - 1)*u^3 + u^2 - x*y",
       "1: the leading coefficient of '(sin(x)^2 + cos(x)^2 - 1)*u^3 + u^2 - x*y' is identically "
       "zero"},
      {"u^2 - x/(sin(x)^2 + cos(x)^2 - 1)",
       "1: division by an expression that is identically zero"},
      {"u^2 + x*I", "9: the polynomial has to be real, without I"},
      {"u^2 + sqrt(-1)", "7: this has no real value"},
      {"u^2 + sqrt(-2)", "7: this has no real value"}};
  for (const auto& [roots, error] : wrong) {
    try {
      examined(central(), roots);
      ADD_FAILURE() << roots;
    } catch (const CaseError& problem) {
      EXPECT_EQ(std::to_string(problem.where().column) + ": " + problem.text(), error);
    }
  }
}

/// Equal roots, roots that depend on each other, a root that is an integral: nothing is said.
TEST(RootsThatAreGiven, AreUndecidedWhereTheyAreNoCoordinates) {
  for (const char* roots :
       {"(u - x)^2", "(u - x)*(u - x^2)", "(u - x^2 - y^2)*(u - x*py + y*px)"}) {
    const SeparationReport report = examined(central(), roots);
    ASSERT_EQ(report.found.size(), 1U);
    EXPECT_EQ(report.found[0].separated, Verdict::undecided) << roots;
    EXPECT_FALSE(report.found[0].reason.empty());
  }
}

TEST(RootsThatAreGiven, AreOfAPolynomialOfTheRightDegree) {
  for (const char* roots : {"u - x", "(u - x)*(u - y)*(u - 1)", "sqrt(u)", "x + y", "u^2 +"})
    EXPECT_THROW(examined(central(), roots), CaseError) << roots;
}

/// The name u is taken: v is the next.
TEST(RootsThatAreGiven, HaveAnotherNameWhereTheCaseHasAnU) {
  const Model model = canonical(R"("u", "y", "pu", "py")", "(pu^2 + py^2)/2 + u^4 + y^4",
                                "[integrals]\nK = \"pu^2/2 + u^4\"\n");
  const SeparationReport report = examined(model, "(v - u)*(v - y)");
  ASSERT_EQ(report.found.size(), 1U);
  EXPECT_EQ(report.found[0].names.root, "v");
  EXPECT_EQ(report.found[0].separated, Verdict::proved);
}

/// The parts, with functions in the plane: H = (px^2 + py^2)/2 + x^4 + 2*y^4 separates in x and y.
class PartsOfSeparation : public testing::Test {
 protected:
  Polynomial function(const std::string& text) {
    return leaves_.convert(model_.parse(text_of(text)));
  }
  structure::RootCoefficients coefficients(const std::string& first, const std::string& second) {
    return {function("-(" + first + ") - (" + second + ")"),
            function("(" + first + ")*(" + second + ")")};
  }
  std::vector<Polynomial> integrals() {
    return {function("(px^2 + py^2)/2 + x^4 + 2*y^4"), function("px^2/2 + x^4")};
  }
  bool is_regular(const structure::RootCoefficients& a) {
    return structure::regular_where(leaves_, a, integrals()).has_value();
  }
  bool is_staeckel(const structure::RootCoefficients& a) {
    return structure::staeckel_form(leaves_, a, integrals(), {}, {}).has_value();
  }

  bool obeys_levi_civita(const structure::RootCoefficients& a) {
    return std::ranges::all_of(structure::levi_civita_defect(leaves_, a, integrals()),
                               [](const Polynomial& p) { return p.is_zero(); });
  }

  Model model_ = canonical(kPlane, "(px^2 + py^2)/2 + x^4 + 2*y^4");
  structure::Leaves leaves_{model_, {}, {}};
};

TEST_F(PartsOfSeparation, AcceptWhatSeparates) {
  const auto a = coefficients("x", "y^2");
  EXPECT_TRUE(is_regular(a));
  EXPECT_TRUE(structure::roots_commute(leaves_, a));
  EXPECT_TRUE(is_staeckel(a));
  EXPECT_TRUE(obeys_levi_civita(a));
}

/// A function of one variable and its momentum alone is as good as the variable.
TEST_F(PartsOfSeparation, AcceptFunctionsOfOneVariableAndItsMomentum) {
  EXPECT_TRUE(obeys_levi_civita(coefficients("x + px", "y^2*py")));
}

TEST_F(PartsOfSeparation, RefuseEqualRoots) { EXPECT_FALSE(is_regular(coefficients("x", "x"))); }

TEST_F(PartsOfSeparation, RefuseConstantRoots) { EXPECT_FALSE(is_regular(coefficients("1", "2"))); }

TEST_F(PartsOfSeparation, RefuseDependentRoots) {
  EXPECT_FALSE(is_regular(coefficients("x", "x + 1")));
  EXPECT_FALSE(is_regular(coefficients("x", "x^2")));
}

/// An integral for a root is no coordinate on its own level.
TEST_F(PartsOfSeparation, RefuseRootsThatAreIntegrals) {
  EXPECT_FALSE(is_regular(coefficients("px^2/2 + x^4", "y")));
}

/// {x, px + y} is not zero, though each of the two would do with another partner.
TEST_F(PartsOfSeparation, RefuseRootsThatDoNotCommute) {
  EXPECT_FALSE(structure::roots_commute(leaves_, coefficients("x", "px + y")));
}

/// Commuting and independent, but H does not separate in them.
TEST_F(PartsOfSeparation, RefuseRootsInWhichNothingSeparates) {
  const auto a = coefficients("x + y", "x - y");
  EXPECT_TRUE(is_regular(a));
  EXPECT_TRUE(structure::roots_commute(leaves_, a));
  EXPECT_FALSE(is_staeckel(a));
  EXPECT_FALSE(obeys_levi_civita(a));
}

/// Staeckel's form and Levi-Civita's condition are two roads to the same: where the first is proved
/// the second holds, with roots that are no polynomials and on a level too.
TEST(LeviCivita, HoldsWhereverStaeckelsFormIsThere) {
  const auto defect_of = [](const Model& model, const SeparationReport& report) {
    std::vector<NamedExpression> on;
    for (const std::string& one : report.on) on.push_back(model.parse_named(text_of(one)));
    std::vector<GiNaC::ex> functions;
    for (const std::string& one : report.found.at(0).integrals)
      functions.push_back(model.parse(text_of(one)));
    structure::Leaves leaves(model, on, functions);
    std::vector<Polynomial> integrals;
    for (const GiNaC::ex& f : functions) integrals.push_back(leaves.convert(f));
    structure::RootCoefficients a;
    for (const std::string& one : report.found[0].coefficients)
      a.push_back(leaves.convert(model.parse(text_of(one))));
    EXPECT_TRUE(std::ranges::all_of(structure::levi_civita_defect(leaves, a, integrals),
                                    [](const Polynomial& p) { return p.is_zero(); }));
    a[0] = a[0] + a[0];
    EXPECT_FALSE(std::ranges::all_of(structure::levi_civita_defect(leaves, a, integrals),
                                     [](const Polynomial& p) { return p.is_zero(); }));
  };
  const Model top = bundled("goryachev-chaplygin"), plane = bundled("henon-heiles");
  defect_of(top, examined(top, "u^2 - 2*M3*u - (M1^2 + M2^2)"));
  defect_of(plane, searched(plane, 1));
}

/// On the leaves of e(3): M1, g1 are not tangent to them, the bracket and its multiples are.
TEST(LeavesOfABracket, KnowWhichBivectorsAreTangent) {
  const Model model = bundled("goryachev-chaplygin");
  structure::Leaves leaves(model, {}, {});
  EXPECT_EQ(leaves.degrees_of_freedom(), 2U);
  structure::Bivector p = leaves.bivector();
  for (const std::vector<std::size_t>& rows : leaves.choices(4)) {
    if (leaves.vanishes(structure::pfaffian(p, 6, rows))) continue;
    EXPECT_TRUE(leaves.is_tangent(p, rows));
    structure::Bivector changed = p;
    changed[2] += leaves.ring().constant(1);
    EXPECT_FALSE(leaves.is_tangent(changed, rows));
  }
}

}  // namespace
}  // namespace casimir::test
