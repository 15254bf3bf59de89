// Families with a free parameter, of which the literature knows the integrable members.
#include <cln/integer_io.h>
#include <cln/rational_io.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "symbolic/case_file.hpp"
#include "symbolic/obstruction/curve_field.hpp"
#include "symbolic/obstruction/equation/kimura.hpp"
#include "symbolic/obstruction/family/kimura_family.hpp"
#include "symbolic/obstruction/family/survivors.hpp"
#include "symbolic/obstruction/obstruct.hpp"

namespace casimir::obstruction::free_parameter_test {
namespace {

using cln::cl_RA;
using Texts = std::vector<std::string>;

const Univariate c = Univariate::variable();

cl_RA quotient(long a, long b) { return cl_RA(a) / b; }

/// A case with one parameter that has no number.
Model family(const std::string& hamiltonian, const std::string& parameter,
             const std::string& variables = "\"x\", \"y\", \"px\", \"py\"") {
  return build_model(parse_case(
      fmt::format("title = \"A test\"\nsource = \"a test\"\nhamiltonian = \"{}\"\n[phase_space]\n"
                  "variables = [{}]\ncanonical = true\n[parameters]\n{} = {{}}\n",
                  hamiltonian, variables, parameter),
      "test.toml"));
}

Model one_axis_top() {
  return build_model(parse_case(
      "title = \"A test\"\nsource = \"a test\"\n"
      "hamiltonian = \"(M1^2 + M2^2 + a3*M3^2)/2 + g1\"\n[phase_space]\n"
      "variables = [\"M1\", \"M2\", \"M3\", \"g1\", \"g2\", \"g3\"]\nalgebra = \"e(3)\"\n"
      "[casimirs]\nF1 = \"g1^2 + g2^2 + g3^2\"\nF2 = \"M1*g1 + M2*g2 + M3*g3\"\n"
      "[parameters]\na3 = {}\n",
      "test.toml"));
}

Obstruction freely(const Model& model) {
  ObstructionRequest request;
  request.free = model.parameters.front().get_name();
  return find_obstruction(model, request);
}

Texts values(const Obstruction& answer, bool excluded) {
  Texts result;
  for (const FreeValue& value : answer.values)
    if (value.excluded == excluded) result.push_back(value.value);
  return result;
}

/// A family of Riemann equations of which nothing but its squares is known.
RiemannFamily riemann(const RationalFunction& a, const RationalFunction& b,
                      const RationalFunction& d) {
  RiemannFamily result;
  result.squares = {a, b, d};
  for (const RationalFunction& square : result.squares)
    result.conditions.nonzero(square.denominator());
  return result;
}

Texts surviving(const std::vector<RiemannFamily>& families) {
  Texts result;
  for (const SurvivingValue& value : survivors(families, "c").values)
    result.push_back(value.value.text("c"));
  return result;
}

TEST(FreeParameter, ZiglinsTheoremOfTheHeavyTop) {
  const Obstruction answer = freely(one_axis_top());
  ASSERT_TRUE(answer.proved);
  EXPECT_TRUE(answer.sequences.empty());
  // Euler and Lagrange, Kovalevskaya, Goryachev and Chaplygin; 1/4 fails on another level.
  EXPECT_EQ(values(answer, false), (Texts{"1", "2", "4"}));
  EXPECT_EQ(values(answer, true), (Texts{"1/4"}));
}

// Suslov's body, omega_3 = 0, in the field of gravity along the third axis (Kozlov 1988;
// Maciejewski and Przybylska 2002), its time divided by g3. Near I1 = 0 one plane has finitely many
// candidates, near infinity the other one. Of the sums of the first, 1/2 + sqrt(I1) + sqrt(2*I1 +
// 1/4) = 3 has the root 1, -1 the root of s^2 + 3*s - 2 with s = sqrt(I1), and of Schwarz's list
// there is I1 = 1/4; the second has only the first one among its own.
TEST(FreeParameter, SuslovsProblemHasOneIntegrableRatio) {
  const Obstruction answer = freely(build_model(parse_case(
      "title = \"Suslov\"\nsource = \"a test\"\n"
      "hamiltonian = \"p1^2/2 + p2^2/(2*I1) - g3\"\n[phase_space]\n"
      "variables = [\"g1\", \"g2\", \"g3\", \"p1\", \"p2\"]\n[phase_space.brackets]\n"
      "\"g1,p1\" = \"1\"\n\"g2,p2\" = \"1\"\n\"g3,p1\" = \"-g1/g3\"\n\"g3,p2\" = \"-g2/g3\"\n"
      "[parameters]\nI1 = { assume = \"I1 > 0\" }\n[casimirs]\nF1 = \"g1^2 + g2^2 + g3^2\"\n",
      "test.toml")));
  ASSERT_TRUE(answer.proved) << answer.reason;
  EXPECT_TRUE(answer.sequences.empty());
  EXPECT_EQ(values(answer, false), Texts{"1"});
  EXPECT_TRUE(values(answer, true).empty());
  EXPECT_EQ(answer.assumed, Texts{"I1 > 0"});
}

TEST(FreeParameter, SeveralAtOnce) {
  const auto of = [](const std::string& hamiltonian) {
    ObstructionRequest request;
    request.free = "a,c";
    return find_obstruction(
        build_model(parse_case(fmt::format("title = \"A test\"\nsource = \"a test\"\n"
                                           "hamiltonian = \"{}\"\n[phase_space]\nvariables = "
                                           "[\"x\", \"y\", \"px\", \"py\"]\ncanonical = true\n"
                                           "[parameters]\na = {{}}\nc = {{}}\n",
                                           hamiltonian),
                               "test.toml")),
        request);
  };
  const Obstruction answer = of("(px^2 + py^2 + a*x^2 + y^2)/2 + x^2*y + c*y^3/3");
  ASSERT_TRUE(answer.proved) << answer.reason;
  EXPECT_EQ(answer.free, "a,c");
  EXPECT_TRUE(answer.values.empty());
  ASSERT_EQ(answer.sequences.size(), 1u);
  // n(n + 1) = 12/c at each energy without a double root.
  const Texts& conditions = answer.sequences.front().conditions;
  EXPECT_TRUE(std::any_of(conditions.begin(), conditions.end(), [](const std::string& text) {
    return text.find("(1/4*c + 12)/c = s^2") != std::string::npos;
  })) << fmt::format("{}", fmt::join(conditions, "\n"));
  // Integrable for all values: nothing is excluded.
  for (const char* h : {"(px^2 + py^2)/2 + a*x^3 + c*y^3", "(px^2 + py^2 + a*x^2 + c*y^2)/2",
                        "(px^2 + py^2 + a*x^2 + c*y^2)/2 + x^2*y + 2*y^3"})
    EXPECT_FALSE(of(h).proved) << h;
}

TEST(FreeParameter, HomogeneousPotentialsOfDegreeThreeAndFour) {
  // x^2 y/2 + c y^3/3: 1/2, 3 and 8 are integrable, 1 passes at first order and fails at the third.
  const Obstruction cubic = freely(family("(px^2 + py^2)/2 + x^2*y/2 + c*y^3/3", "c"));
  EXPECT_EQ(values(cubic, false), (Texts{"1/2", "3", "8"}));
  EXPECT_TRUE(cubic.sequences.empty());
  const Obstruction quartic = freely(family("(px^2 + py^2)/2 + x^4 + c*x^2*y^2 + y^4", "c"));
  EXPECT_EQ(values(quartic, false), (Texts{"0", "2", "6"}));
  EXPECT_TRUE(quartic.sequences.empty());
  const Obstruction other = freely(family("(px^2 + py^2)/2 + x^4 + 6*x^2*y^2 + c*y^4", "c"));
  EXPECT_EQ(values(other, false), (Texts{"1", "3", "8"}));
}

// In three dimensions, x^4 + y^4 + z^4 + c*(x^2*y^2 + y^2*z^2 + z^2*x^2): separable for c = 0,
// radial for c = 2. For c = 6 it is separable in each coordinate plane, and not in space.
TEST(FreeParameter, LinesInSpace) {
  const Obstruction answer = freely(build_model(parse_case(
      "title = \"A test\"\nsource = \"a test\"\nhamiltonian = \"(px^2 + py^2 + pz^2)/2 + x^4 + y^4 "
      "+ "
      "z^4 + c*(x^2*y^2 + y^2*z^2 + z^2*x^2)\"\n[phase_space]\nvariables = [\"x\", \"y\", \"z\", "
      "\"px\", \"py\", \"pz\"]\ncanonical = true\n[parameters]\nc = {}\n",
      "test.toml")));
  ASSERT_TRUE(answer.proved) << answer.reason;
  EXPECT_TRUE(answer.sequences.empty());
  EXPECT_EQ(values(answer, false), (Texts{"0", "2"}));
  EXPECT_TRUE(values(answer, true).empty());
}

TEST(FreeParameter, HenonAndHeilesFamily) {
  const Obstruction answer = freely(family("(px^2 + py^2 + x^2 + y^2)/2 + x^2*y + c*y^3/3", "c"));
  ASSERT_TRUE(answer.proved);
  // n(n + 1) = 12/c of Lame's equation; where n is 4 or 2 the third order excludes.
  // At c = 0 the equation is Mathieu's, which has an irregular point.
  EXPECT_EQ(values(answer, false), (Texts{"0", "1", "6"}));
  EXPECT_TRUE(answer.values.front().only_rational);
  ASSERT_EQ(answer.sequences.size(), 1u);
  // At that cut H = 1 is not Lame's equation.
  EXPECT_EQ(answer.sequences.front().range, "0 < c < the root of c^2 - 1/6 near 0.408248");
  const Texts& conditions = answer.sequences.front().conditions;
  EXPECT_EQ(std::count(conditions.begin(), conditions.end(),
                       "c = 12/(s^2 - 1/4) with s = 2*p + r for an integer p and r in {1/2}"),
            1);
}

TEST(FreeParameter, LamesClassesOfHenonAndHeilesWithAnotherFrequency) {
  // B = 16 A at H = 1: Lame's equation with n(n + 1) = 12/c; c = 16 is integrable, with n = 1/2.
  const Obstruction answer =
      freely(family("(px^2 + py^2 + x^2 + 16*y^2)/2 + x^2*y + c*y^3/3", "c"));
  ASSERT_EQ(answer.sequences.size(), 1u);
  const Texts& conditions = answer.sequences.front().conditions;
  EXPECT_NE(std::find(conditions.begin(), conditions.end(),
                      "c = 12/(s^2 - 1/4) with s in Z/2, Z/3, Z/4 or Z/5 (Lame's equation, n = s - "
                      "1/2)"),
            conditions.end());
  RiemannFamily lame =
      riemann(RationalFunction(quotient(1, 4)), RationalFunction(quotient(1, 4)),
              (RationalFunction(c) + RationalFunction(48)) / RationalFunction(4 * c));
  lame.lame = true;
  for (const cl_RA& value : {cl_RA(1), cl_RA(2), cl_RA(6), cl_RA(16)})
    EXPECT_TRUE(kimura_at(lame, RealRoot(value)).solvable) << value;
  for (const cl_RA& value : {cl_RA(-1), cl_RA(3), cl_RA(7), quotient(1, 2)})
    EXPECT_FALSE(kimura_at(lame, RealRoot(value)).solvable) << value;
  EXPECT_TRUE(kimura_at(lame, RealRoot(quotient(432, 7))).solvable);  // s = 2/3
}

TEST(FreeParameter, SwingingAtwoodsMachine) {
  const Obstruction answer = freely(family("pr^2/(2*(mu + 1)) + pt^2/(2*r^2) + r*(mu - cos(t))",
                                           "mu", "\"r\", \"t\", \"pr\", \"pt\""));
  ASSERT_EQ(answer.sequences.size(), 1u);
  // mu = p(p + 1)/(p(p + 1) - 4) with s = 2p + 1.
  EXPECT_EQ(answer.sequences.front().range, "mu > 1");
  EXPECT_EQ(answer.sequences.front().conditions.front(),
            "mu = (s^2 - 1)/(s^2 - 17) with s = 2*p + r for an integer p and r in {1}");
  for (const obstruction::FreeValue& own : answer.values)
    EXPECT_TRUE(own.excluded || own.value == "0" || own.value == "-1" ||
                (own.value == "1" && own.only_rational))
        << own.value;
}

TEST(FreeParameter, KeplerAndSpringAndThreeBodies) {
  const Obstruction kepler = freely(family("(px^2 + a*py^2)/2 - 1/sqrt(x^2 + y^2)", "a"));
  EXPECT_EQ(values(kepler, false), (Texts{"0", "1"}));
  // Of degree -1 the table has 1, 0, -2, -5, ..: a and 1/a are both in it for a = 1 alone. Each of
  // them is bounded on one half of a < 0 only.
  EXPECT_TRUE(kepler.sequences.empty());
  // A spring of any stiffness k > 0, in two kinds of variables.
  for (const Model& model : {family("(px^2 + py^2)/2 - y + k*(sqrt(x^2 + y^2) - 1)^2/2", "k"),
                             family("(pr^2 + pt^2/r^2)/2 - r*cos(t) + k*(r - 1)^2/2", "k",
                                    "\"r\", \"t\", \"pr\", \"pt\"")}) {
    const Obstruction spring = freely(model);
    EXPECT_EQ(values(spring, false), (Texts{"0"}));
    ASSERT_EQ(spring.sequences.size(), 1u);
    EXPECT_EQ(spring.sequences.front().range, "-1 < k < 0");
  }
  // Three bodies on a line, the middle one of mass m: all m > 0.
  const Obstruction three =
      freely(family("(px^2*(1 + 1/m) + py^2*(1 + 1/m))/2 - px*py/m - m/x - m/y - 1/(x + y)", "m"));
  ASSERT_TRUE(three.proved);
  EXPECT_EQ(values(three, false), (Texts{"-2", "0"}));
  ASSERT_EQ(three.sequences.size(), 1u);
  EXPECT_EQ(three.sequences.front().range, "-1/4 < m < 0");
}

TEST(FreeParameter, AFamilyThatIsIntegrableIsLeftAlone) {
  for (const char* h :
       {"(px^2 + py^2)/2 + c*x^4 + y^4", "(px^2 + py^2)/2 + (x^2 + y^2)^2 + c*x^2",
        "(px^2 + py^2 + x^2 + 3*y^2)/2 + c*(x^2*y + 2*y^3)", "(px^2 + py^2)/2 + c*x^3 + x^2 + y^5"})
    EXPECT_FALSE(freely(family(h, "c")).proved) << h;
}

TEST(FreeParameter, EveryNumberAgreesWithTheFamily) {
  // What the family excludes is excluded when it is given as a number, by Kovacic's algorithm.
  const Model model = one_axis_top();
  for (const char* a3 : {"3", "1/2", "-1", "7/8", "11", "22", "9/4"}) {
    const Model numbered = build_model(
        parse_case(fmt::format("title = \"A test\"\nsource = \"a test\"\n"
                               "hamiltonian = \"(M1^2 + M2^2 + ({})*M3^2)/2 + g1\"\n[phase_space]\n"
                               "variables = [\"M1\", \"M2\", \"M3\", \"g1\", \"g2\", \"g3\"]\n"
                               "algebra = \"e(3)\"\n[casimirs]\nF1 = \"g1^2 + g2^2 + g3^2\"\n"
                               "F2 = \"M1*g1 + M2*g2 + M3*g3\"\n",
                               a3),
                   "test.toml"));
    EXPECT_TRUE(find_obstruction(numbered, {}).proved) << a3;
  }
}

TEST(FreeParameter, AWrongNameIsNoParameter) {
  ObstructionRequest request;
  request.free = "b";
  EXPECT_FALSE(find_obstruction(one_axis_top(), request).proved);
}

TEST(Survivors, IrrationalNumbersAreDecidedExactly) {
  const RationalFunction half(quotient(1, 4)), quarter(quotient(1, 16));
  // sqrt(c^2 - 2) with 1/2 and 1/4: on a bounded cell c^2 - 2 = (j/4)^2, j odd, survive.
  const RiemannFamily family = riemann(half, quarter, RationalFunction(c * c - 2));
  const auto at = [&](const Univariate& polynomial) {
    const auto roots = real_roots(polynomial);
    return kimura_at(family, roots.back()).solvable;
  };
  EXPECT_TRUE(at(c * c - Univariate(2 + quotient(1, 16))));   // 1/4
  EXPECT_TRUE(at(c * c - Univariate(2 + quotient(1, 4))));    // 1/2
  EXPECT_TRUE(at(c * c - Univariate(2 + quotient(1, 9))));    // 1/3
  EXPECT_FALSE(at(c * c - Univariate(2 + quotient(1, 25))));  // 1/5
  EXPECT_FALSE(at(c * c - 3));                                // 1
  EXPECT_FALSE(at(c * c - 5));                                // sqrt(3)
  // A sum of two irrational differences: sqrt(c) + sqrt(c - 1) = 1 + 2 n.
  const RiemannFamily sums = riemann(RationalFunction(c), RationalFunction(c - 1),
                                     RationalFunction(quotient(1, 3)) * RationalFunction(c));
  for (const RealRoot& root : real_roots(product_of_sums(3, sums.squares).numerator()))
    EXPECT_TRUE(kimura_at(sums, root).solvable) << root.text("c");
  EXPECT_FALSE(kimura_at(sums, real_roots(c * c - 5).back()).solvable);
}

TEST(Survivors, TheProductOfSumsVanishesWhereASumIsThatInteger) {
  // 5 = sqrt(2) + 5 - sqrt(2); 1 + 2 - 6 = -3.
  const auto product = [](long m, const cl_RA& a, const cl_RA& b, const cl_RA& d) {
    return product_of_sums(m, {RationalFunction(a), RationalFunction(b), RationalFunction(d)})
        .is_zero();
  };
  EXPECT_TRUE(product(5, 2, 25, 2));
  EXPECT_FALSE(product(3, 2, 25, 2));
  EXPECT_TRUE(product(3, 1, 4, 36));
  EXPECT_FALSE(product(1, 1, 4, 36));
  EXPECT_TRUE(product(1, -3, 1, -3));
}

TEST(Survivors, BoundsNeedTheTurningPoints) {
  // c(2 - c)*9 is 0 at both ends of (0, 2), and 9 between: sqrt = 5/2 is taken twice.
  const RiemannFamily family =
      riemann(RationalFunction(quotient(1, 4)), RationalFunction(quotient(1, 9)),
              RationalFunction(9 * c * (2 - c)));
  const Texts found = surviving({family});
  EXPECT_GT(
      std::count_if(found.begin(), found.end(),
                    [](const auto& text) { return text.find("near 1.5") != std::string::npos; }),
      0);
  // Every one is where Kimura's theorem has it, on a fine grid of rational numbers.
  for (long n = 1; n < 200; ++n) {
    const cl_RA square = 9 * quotient(n, 100) * (2 - quotient(n, 100));
    const bool solvable = kimura({quotient(1, 4), quotient(1, 9), square}).has_value();
    const bool listed = std::find(found.begin(), found.end(),
                                  Univariate(quotient(n, 100)).text("c")) != found.end();
    EXPECT_EQ(solvable, listed) << n;
  }
}

TEST(Survivors, ImaginaryDifferencesThatCancelAreFound) {
  // sqrt(-1 - c^2) and sqrt(-c - 7) with 1: equal, c^2 - c - 6 = 0, at 3 and -2.
  const RiemannFamily family =
      riemann(RationalFunction(-1 - c * c), RationalFunction(-c - 7), RationalFunction(1));
  const Texts found = surviving({family});
  for (const char* value : {"-2", "3"})
    EXPECT_NE(std::find(found.begin(), found.end(), value), found.end()) << value;
}

TEST(Survivors, NothingIsSaidWhereAConditionVanishes) {
  RiemannFamily family = riemann(RationalFunction(quotient(1, 4)), RationalFunction(quotient(1, 9)),
                                 RationalFunction(quotient(2, 1)));
  EXPECT_TRUE(surviving({family}).empty());
  family.conditions.nonzero(c * c - 2);
  EXPECT_EQ(surviving({family}).size(), 2u);
  // Another family may decide there.
  EXPECT_TRUE(
      surviving({family, riemann(RationalFunction(quotient(1, 4)), RationalFunction(quotient(1, 9)),
                                 RationalFunction(quotient(3, 1)))})
          .empty());
}

/// r of Riemann's P equation with the points 0, 1 - c and infinity.
ParametricFunction moving(int at_zero, int at_other, int mixed) {
  using F = ParametricFunction;
  const F z = F::variable(), other = z - F(1) + F::parameter();
  return F(at_zero) / (z * z) + F(at_other) / (other * other) + F(mixed) / (z * other);
}

TEST(RiemannFamily, NothingIsSaidWherePointsMeet) {
  // At c = 1 it is y'' = 7/z^2 y, which is solvable; at every other c it is not.
  const auto family = riemann_family(moving(3, 5, -1), {"z", "c"});
  ASSERT_TRUE(family);
  EXPECT_EQ(surviving({of_one_parameter(*family)}), (Texts{"1"}));
  EXPECT_FALSE(kimura_at(of_one_parameter(*family), RealRoot(2)).solvable);
  EXPECT_FALSE(kimura_at(of_one_parameter(*family), RealRoot(1)).known);
}

TEST(RiemannFamily, NothingIsSaidWhereAPointGoesToInfinity) {
  // Poles at 0 and 1/c: at c = 0 it is y'' = 3/z^2 y.
  using F = ParametricFunction;
  const F z = F::variable(), c_z = F::parameter() * z - F(1);
  const auto family = riemann_family(
      F(3) / (z * z) + F(5) * F::parameter() * F::parameter() / (c_z * c_z), {"z", "c"});
  ASSERT_TRUE(family);
  EXPECT_EQ(surviving({of_one_parameter(*family)}), (Texts{"0"}));
}

TEST(RiemannFamily, ConjugatePointsNeedOneDifference) {
  using F = ParametricFunction;
  const F z = F::variable(), both = z * z - F::parameter();
  EXPECT_TRUE(riemann_family(F(3) / (both * both) * F::parameter(), {"z", "c"}));
  EXPECT_FALSE(riemann_family((F(3) + z) / (both * both), {"z", "c"}));
}

TEST(CurveField, NotesWhatItDividesBy) {
  using F = ParametricFunction;
  CurveField<F> field;
  const F z = F::variable(), parameter = F::parameter();
  (void)field.inverse(CurveField<F>::constant(parameter * z));
  EXPECT_EQ(field.conditions().polynomials(), std::vector<Univariate>{c});
  // (c - 2) z + c^2 - 4 vanishes for all z at c = 2 only.
  (void)field.inverse(
      CurveField<F>::constant((parameter - F(2)) * z + parameter * parameter - F(4)));
  EXPECT_EQ(field.conditions().polynomials(), (std::vector<Univariate>{c, c - 2}));
  (void)field.root_of((parameter + F(3)) * z);
  EXPECT_EQ(field.conditions().polynomials(), (std::vector<Univariate>{c, c - 2, c + 3}));
}

TEST(RealRoots, AreInOrderAndEachOnce) {
  const auto roots = real_roots((c * c - 2).pow(3) * (c - 1) * (c.pow(4) - 2) * (c * c + 1));
  ASSERT_EQ(roots.size(), 5u);
  EXPECT_TRUE(std::is_sorted(roots.begin(), roots.end()));
  EXPECT_EQ(roots[2].rational(), cl_RA(1));
  EXPECT_TRUE(roots[4].is_root_of(c * c - 2));
  const RationalInterval value = roots[4].value(RationalFunction(c * c), quotient(1, 1000000));
  EXPECT_LE(value.low, 2);
  EXPECT_GE(value.high, 2);
}

}  // namespace
}  // namespace casimir::obstruction::free_parameter_test
