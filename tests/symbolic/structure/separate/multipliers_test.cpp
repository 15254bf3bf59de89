// The conditions of the theorems on separation, one by one.
#include <gtest/gtest.h>

#include <algorithm>

#include "symbolic/structure/separate/leaves.hpp"
#include "symbolic/structure/separate/levi_civita.hpp"
#include "symbolic/structure/separate/multipliers.hpp"
#include "tests/symbolic/structure/separations.hpp"

namespace casimir::test {
namespace {

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
  void expect_commuting_coordinates(const structure::RootCoefficients& a) {
    EXPECT_TRUE(is_regular(a));
    EXPECT_TRUE(structure::roots_commute(leaves_, a));
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
  expect_commuting_coordinates(a);
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
  expect_commuting_coordinates(a);
  EXPECT_FALSE(is_staeckel(a));
  EXPECT_FALSE(obeys_levi_civita(a));
}

/// Staeckel's form and Levi-Civita's condition are two roads to the same: where the first is proved
/// the second holds, with roots that are no polynomials and on a level too.
TEST(LeviCivita, HoldsWhereverStaeckelsFormIsThere) {
  const auto expect_both = [](const Model& model, const SeparationReport& report) {
    ASSERT_EQ(report.found.size(), 1U);
    EXPECT_EQ(report.found[0].staeckel, Verdict::proved);
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
  expect_both(top, examined(top, "u^2 - 2*M3*u - (M1^2 + M2^2)"));
  expect_both(plane, searched(plane, 1));
}

}  // namespace
}  // namespace casimir::test
