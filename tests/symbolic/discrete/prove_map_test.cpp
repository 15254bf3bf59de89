// Claims about maps, proved and refuted, and what a rule would get wrong without its hypothesis.
#include <gtest/gtest.h>

#include "symbolic/discrete/map_inverse.hpp"
#include "symbolic/discrete/prove_map.hpp"
#include "symbolic/discrete/search_map.hpp"
#include "tests/symbolic/discrete/maps.hpp"

namespace casimir::test {
namespace {

TEST(ProveMap, EveryBundledMapIsProved) {
  for (const char* name :
       {"bobenko-lorbeer-suris", "discrete-lagrange", "discrete-neumann", "henon-area-preserving",
        "kahan-clebsch", "kahan-euler", "lyness", "mcmillan", "moser-veselov", "qrt"}) {
    const MapModel map = bundled_map(name);
    EXPECT_EQ(overall(map.base, prove_map(map)), Verdict::proved) << name;
  }
}

TEST(ProveMap, InversesOfTheBundledMapsAreFoundAndProved) {
  for (const char* name : {"discrete-lagrange", "discrete-neumann", "henon-area-preserving",
                           "kahan-euler", "lyness", "mcmillan", "qrt"}) {
    const MapModel map = bundled_map(name);
    const auto inverse = discrete::proved_inverse(map);
    ASSERT_TRUE(inverse) << name;
    ASSERT_EQ(inverse->size(), map.base.variables.size());
    // By arithmetic that is none of the prover's: numbers put into both.
    GiNaC::exmap point, image;
    int k = 3;
    for (const auto* list : {&map.base.variables, &map.base.parameters})
      for (const GiNaC::symbol& s : *list) {
        ++k;
        point[s] = GiNaC::numeric(k, 7 + k % 3);
      }
    for (const GiNaC::symbol& s : map.base.parameters) image[s] = point[s];
    const auto apply = [](const std::vector<GiNaC::ex>& functions, const GiNaC::exmap& at) {
      std::vector<GiNaC::ex> values;
      for (const GiNaC::ex& f : functions)
        values.push_back(f.subs(at, GiNaC::subs_options::no_pattern));
      return values;
    };
    std::vector<GiNaC::ex> state;
    for (const GiNaC::symbol& x : map.base.variables) state.push_back(point[x]);
    const std::vector<MapModel> whole{map};
    for (const MapModel& step : map.steps.empty() ? whole : map.steps) {
      GiNaC::exmap at = image;
      for (std::size_t i = 0; i < state.size(); ++i) at[map.base.variables[i]] = state[i];
      state = apply(step.next, at);
    }
    for (std::size_t i = 0; i < state.size(); ++i) image[map.base.variables[i]] = state[i];
    const std::vector<GiNaC::ex> back = apply(*inverse, image);
    for (std::size_t i = 0; i < back.size(); ++i)
      EXPECT_TRUE((back[i] - point[map.base.variables[i]]).is_zero()) << name;
  }
}

TEST(ProveMap, NoInverseIsSaidWhereThereIsNone) {
  EXPECT_FALSE(
      discrete::proved_inverse(map_of(kPhaseSpaceOfPlane + "[map]\nx = \"x^2\"\ny = \"y\"\n")));
  EXPECT_FALSE(discrete::proved_inverse(
      map_of(kPhaseSpaceOfPlane + "[map]\nx = \"x + y\"\ny = \"x + y\"\n")));
  // A claimed reversal that is none gives none.
  EXPECT_FALSE(discrete::proved_inverse(
      map_of(kPhaseSpaceOfPlane + "[map]\nx = \"y^2\"\ny = \"x^2\"\n[[symmetry]]\nname = \"s\"\n"
                                  "expressions = { x = \"y\", y = \"x\" }\nreverses = true\n")));
}

TEST(ProveMap, WitnessesAreOnBothSidesOfAStep) {
  const MapModel map = map_of(kPhaseSpaceOfPlane +
                              "[map]\nx = \"y\"\ny = \"(2 + y)/x\"\n[integrals]\nF = \"x + y\"\n");
  const Proof proof = proof_of(map, ClaimKind::integral);
  EXPECT_EQ(proof.verdict, Verdict::refuted);
  ASSERT_TRUE(proof.witness);
  EXPECT_EQ(proof.witness->point.size(), 2U);
}

TEST(ProveMap, FunctionsOfTheLanguageAreTakenAlong) {
  const std::string standard =
      "[parameters]\nk = {}\n[map]\nx = \"x + y + k*sin(x)\"\ny = \"y + k*sin(x)\"\n";
  EXPECT_EQ(
      verdict_of(map_of(kPhaseSpaceOfPlane + "canonical = true\n" + standard), ClaimKind::map),
      Verdict::proved);
  const std::string rotation =
      "[map]\nx = \"x + 1/y\"\ny = \"y\"\n[integrals]\nF = \"sqrt(y^2)\"\n";
  EXPECT_EQ(verdict_of(map_of(kPhaseSpaceOfPlane + rotation), ClaimKind::integral),
            Verdict::proved);
  const std::string root =
      "[map]\nx = \"sqrt(x)*y\"\ny = \"x*y\"\n[integrals]\nF = \"log(x) - log(y)\"\n";
  EXPECT_EQ(verdict_of(map_of(kPhaseSpaceOfPlane + root), ClaimKind::integral), Verdict::refuted);
}

// sqrt(y^2) is |y|, and -y is not y.
TEST(ProveMap, ARootIsNotItsRadicand) {
  const MapModel map =
      map_of(kPhaseSpaceOfPlane +
             "[map]\nx = \"x\"\ny = \"-y\"\n[integrals]\nF = \"sqrt(y^2)\"\nG = \"y\"\n");
  EXPECT_EQ(verdict_of(map, ClaimKind::integral, "F"), Verdict::proved);
  EXPECT_EQ(verdict_of(map, ClaimKind::integral, "G"), Verdict::refuted);
}

TEST(ProveMap, APoissonMapAndItsSign) {
  const std::string exchange =
      kPhaseSpaceOfPlane + "canonical = true\n[map]\nx = \"y\"\ny = \"x\"\n";
  EXPECT_EQ(verdict_of(map_of(exchange), ClaimKind::map), Verdict::refuted);
  EXPECT_EQ(verdict_of(map_of("map_sign = \"-\"\n" + exchange), ClaimKind::map), Verdict::proved);
}

// A Poisson map that exchanges the leaves z = c and z = -c: z is a Casimir function all the same.
TEST(ProveMap, ACasimirFunctionNeedNotBeKept) {
  const MapModel map = map_of(
      "[phase_space]\nvariables = [\"x\", \"y\", \"z\"]\n[phase_space.brackets]\n\"x,y\" = \"1\"\n"
      "[map]\nx = \"x\"\ny = \"y\"\nz = \"-z\"\n[casimirs]\nC = \"z\"\n");
  EXPECT_EQ(verdict_of(map, ClaimKind::map), Verdict::proved);
  EXPECT_EQ(verdict_of(map, ClaimKind::casimir), Verdict::proved);
  EXPECT_EQ(verdict_of(map, ClaimKind::integral, "C"), Verdict::refuted);
  EXPECT_EQ(overall(map.base, prove_map(map)), Verdict::refuted);
}

// The bracket's image has to be taken at the next point: x -> 2x keeps {x, y} = x with y alone.
TEST(ProveMap, TheBracketIsTakenAtTheNextPoint) {
  const std::string linear = kPhaseSpaceOfPlane + "[phase_space.brackets]\n\"x,y\" = \"x\"\n";
  EXPECT_EQ(verdict_of(map_of(linear + "[map]\nx = \"2*x\"\ny = \"y\"\n"), ClaimKind::map),
            Verdict::proved);
  EXPECT_EQ(verdict_of(map_of(linear + "[map]\nx = \"x\"\ny = \"2*y\"\n"), ClaimKind::map),
            Verdict::refuted);
}

TEST(ProveMap, MeasuresMayBeReversed) {
  const MapModel map =
      map_of(kPhaseSpaceOfPlane + "[map]\nx = \"y\"\ny = \"x\"\n[[measure]]\ndensity = \"1\"\n");
  const Proof proof = proof_of(map, ClaimKind::measure);
  EXPECT_EQ(proof.verdict, Verdict::proved);
  EXPECT_NE(proof.evidence.find("reverses"), std::string::npos);
  const std::string twice =
      kPhaseSpaceOfPlane + "[map]\nx = \"2*x\"\ny = \"y\"\n[[measure]]\ndensity = ";
  EXPECT_EQ(verdict_of(map_of(twice + "\"1\"\n"), ClaimKind::measure), Verdict::refuted);
  EXPECT_EQ(verdict_of(map_of(twice + "\"1/x\"\n"), ClaimKind::measure), Verdict::proved);
  EXPECT_EQ(verdict_of(map_of(twice + "\"0\"\n"), ClaimKind::measure), Verdict::undecided);
}

TEST(ProveMap, RelationsAreInvariantOnTheirLevel) {
  const std::string map = kPhaseSpaceOfPlane + "[map]\nx = \"x*y\"\ny = \"y + x\"\n";
  const std::string relation = "[[invariant_relation]]\nname = \"r\"\nexpression = ";
  EXPECT_EQ(verdict_of(map_of(map + relation + "\"x\"\n"), ClaimKind::invariant_relation),
            Verdict::proved);
  EXPECT_EQ(verdict_of(map_of(map + relation + "\"y\"\n"), ClaimKind::invariant_relation),
            Verdict::refuted);
  // On x = 0 nothing moves.
  EXPECT_EQ(verdict_of(map_of(map + "[[conditional]]\nname = \"c\"\nexpression = \"y\"\non = "
                                    "[\"x\"]\n"),
                       ClaimKind::conditional),
            Verdict::proved);
  // y is constant for one step from the level x = 0, but this level is left.
  const std::string leaves = kPhaseSpaceOfPlane + "[map]\nx = \"1 + x\"\ny = \"y*(1 + x)\"\n";
  EXPECT_EQ(verdict_of(map_of(leaves + "[[conditional]]\nname = \"c\"\nexpression = \"y\"\non = "
                                       "[\"x\"]\n"),
                       ClaimKind::conditional),
            Verdict::refuted);
}

// Where the next value has a pole on the level, nothing is shown by numerators.
TEST(ProveMap, APoleOnTheLevelIsNoZero) {
  const MapModel map = map_of(kPhaseSpaceOfPlane +
                              "[map]\nx = \"x/(x^2 + x*y)\"\ny = \"y\"\n"
                              "[[invariant_relation]]\nname = \"r\"\nexpression = \"x\"\n");
  EXPECT_NE(verdict_of(map, ClaimKind::invariant_relation), Verdict::proved);
}

// x' = x^2 doubles what it maps: the density is kept near every point, and no measure of sets.
TEST(ProveMap, AMeasureIsLocalWhereTheMapIsNotOneToOne) {
  const auto where = [](const std::string& next) {
    return proof_of(
               map_of(kPhaseSpaceOfPlane + "[map]\n" + next + "[[measure]]\ndensity = \"1\"\n"),
               ClaimKind::measure)
        .where;
  };
  EXPECT_EQ(where("x = \"x^2\"\ny = \"y/(2*x)\"\n").size(), 1U);
  EXPECT_TRUE(where("x = \"x + y^2\"\ny = \"y\"\n").empty());
}

// Boole: the two preimages of an interval by x - 1/x have together its length. The logistic map has
// an invariant density, too. Of a map that is one to one the same refutes.
TEST(ProveMap, AMeasureIsNotRefutedNearAPointWhereTheMapIsNotOneToOne) {
  const auto verdict = [](const std::string& next, const std::string& density) {
    return verdict_of(map_of("[phase_space]\nvariables = [\"x\"]\n[map]\nx = \"" + next +
                             "\"\n[[measure]]\ndensity = \"" + density + "\"\n"),
                      ClaimKind::measure);
  };
  EXPECT_EQ(verdict("x - 1/x", "1"), Verdict::undecided);
  EXPECT_EQ(verdict("4*x*(1 - x)", "1/sqrt(x*(1 - x))"), Verdict::undecided);
  EXPECT_EQ(verdict("2*x", "1"), Verdict::refuted);
}

// All points go to x = y, where 1/(x - y) has a pole.
TEST(ProveMap, AFunctionWithAPoleWhereverTheMapLeadsIsUndecided) {
  const std::string folded = kPhaseSpaceOfPlane + "[map]\nx = \"y\"\ny = \"y\"\n";
  EXPECT_EQ(verdict_of(map_of(folded + "[integrals]\nF = \"1/(x - y)\"\n"), ClaimKind::integral),
            Verdict::undecided);
  EXPECT_EQ(
      verdict_of(map_of(folded + "[[measure]]\ndensity = \"1/(x - y)\"\n"), ClaimKind::measure),
      Verdict::undecided);
  EXPECT_NO_THROW(discrete::search_map(map_of(folded), 2));
}

/// c -> -c keeps c^2, c -> c + 2 Pi keeps sin(c): no orbit stays on its leaf.
TEST(ProveMap, LiouvilleDependsOnLeavesThatTheCasimirFunctionsDoNotTellApart) {
  const auto liouville = [](const std::string& c, const std::string& casimir) {
    const MapModel map = map_of(
        "[phase_space]\nvariables = [\"q\", \"p\", \"c\"]\n[phase_space.brackets]\n\"q,p\" = "
        "\"1\"\n[map]\nq = \"q + p\"\np = \"p\"\nc = \"" +
        c + "\"\n[casimirs]\nC = \"" + casimir + "\"\n[integrals]\nJ = \"p\"\n");
    return proof_of(map, ClaimKind::liouville);
  };
  for (const auto& [c, casimir] : {std::pair{"-c", "c^2"}, {"c + 2*Pi", "sin(c)"}}) {
    const Proof proof = liouville(c, casimir);
    EXPECT_TRUE(proof.verdict != Verdict::proved || !proof.where.empty()) << casimir;
  }
  const Proof plain = liouville("c", "2*c + 1");
  EXPECT_EQ(plain.verdict, Verdict::proved) << plain.reason;
  EXPECT_TRUE(plain.where.empty());
}

TEST(ProveMap, LiouvilleNeedsAPoissonMapAndItsIntegrals) {
  const std::string file =
      kPhaseSpaceOfPlane +
      "canonical = true\n[map]\nx = \"2*x\"\ny = \"y\"\n[integrals]\nF = \"y\"\n";
  EXPECT_EQ(verdict_of(map_of(file), ClaimKind::liouville), Verdict::undecided);
  const std::string shear =
      kPhaseSpaceOfPlane + "canonical = true\n[map]\nx = \"x + y\"\ny = \"y\"\n[integrals]\nF = ";
  EXPECT_EQ(verdict_of(map_of(shear + "\"y\"\n"), ClaimKind::liouville), Verdict::proved);
  EXPECT_EQ(verdict_of(map_of(shear + "\"x\"\n"), ClaimKind::liouville), Verdict::undecided);
}

// Each step keeps y, but from x = 0 on the second one has no value: the map is defined nowhere.
TEST(ProveMap, StepsThatNeverMeetShowNothing) {
  const MapModel map =
      map_of(kPhaseSpaceOfPlane +
             "[[map_step]]\nexpressions = { x = \"(y + 1)^2 - y^2 - 2*y - 1\" }\n"
             "[[map_step]]\nexpressions = { x = \"1/x\" }\n[integrals]\nF = \"y\"\n");
  EXPECT_NE(verdict_of(map, ClaimKind::integral), Verdict::proved);
}

// From x > 0 the first step leads to x < 0, where the second one changes y.
TEST(ProveMap, AStepMayLeadOutOfWhatIsAssumed) {
  const auto steps = [](const std::string& first, const std::string& second) {
    return "[[map_step]]\nexpressions = { " + first + " }\n[[map_step]]\nexpressions = { " +
           second + " }\n";
  };
  const std::string turned = steps("x = \"-x\"", "y = \"y + abs(x) - x\"");
  const std::string shrunk = steps("x = \"-x\"", "y = \"y*(1 + abs(x) - x)\"");
  const std::string domain = "domain = [\"x > 0\"]\n";
  EXPECT_EQ(verdict_of(map_of(kPhaseSpaceOfPlane + domain + turned + "[integrals]\nF = \"y\"\n"),
                       ClaimKind::integral),
            Verdict::refuted);
  EXPECT_EQ(verdict_of(map_of(kPhaseSpaceOfPlane + domain + turned +
                              "[[invariant_relation]]\nname = \"R\"\nexpression = \"y\"\n"),
                       ClaimKind::invariant_relation),
            Verdict::refuted);
  EXPECT_EQ(
      verdict_of(map_of(kPhaseSpaceOfPlane + domain + shrunk + "[[measure]]\ndensity = \"1\"\n"),
                 ClaimKind::measure),
      Verdict::refuted);
  // What stays inside is kept.
  EXPECT_EQ(verdict_of(
                map_of(kPhaseSpaceOfPlane + domain +
                       steps("x = \"2*x\"", "y = \"y + abs(x) - x\"") + "[integrals]\nF = \"y\"\n"),
                ClaimKind::integral),
            Verdict::proved);
}

// The root of the second step is real where the first one has led to x >= 0: from x <= 0.
TEST(ProveMap, RootsOfAStepGiveNoSignsToAnother) {
  const MapModel map =
      map_of(kPhaseSpaceOfPlane +
             "[[map_step]]\nexpressions = { x = \"-x\", y = \"y + abs(x) - x\" }\n"
             "[[map_step]]\nexpressions = { x = \"sqrt(x)\" }\n[integrals]\nF = \"y\"\n");
  EXPECT_EQ(verdict_of(map, ClaimKind::integral), Verdict::refuted);
}

// |x - 1| folds x > 0, though |x| does not, and so does the tent map, which keeps lengths as a
// whole.
TEST(ProveMap, WhatIsAssumedOfTheStartInvertsTheFirstStepAlone) {
  const auto map = [](const std::string& domain, const std::vector<std::string>& steps) {
    std::string text = "[phase_space]\nvariables = [\"x\"]\ndomain = [" + domain + "]\n";
    for (const std::string& step : steps)
      text += "[[map_step]]\nexpressions = { x = \"" + step + "\" }\n";
    return map_of(text + "[[measure]]\ndensity = \"1\"\n");
  };
  const MapModel folds = map("\"x > 0\"", {"x - 1", "abs(x)"});
  const Proof measure = proof_of(folds, ClaimKind::measure);
  EXPECT_EQ(measure.verdict, Verdict::proved);
  EXPECT_EQ(measure.where, std::vector<std::string>{"on sets on which the map is one to one"});
  EXPECT_FALSE(discrete::proved_inverse(folds));
  EXPECT_FALSE(discrete::is_one_to_one(folds, 1e6));

  const MapModel tent = map("\"x > 0\", \"x < 1\"", {"1 - 2*x", "abs(x)", "1 - x"});
  EXPECT_EQ(verdict_of(tent, ClaimKind::measure), Verdict::undecided);
  EXPECT_FALSE(discrete::proved_inverse(tent));

  // The first step begins where it is assumed.
  const MapModel moved = map("\"x > 0\"", {"abs(x)", "x - 1"});
  EXPECT_TRUE(proof_of(moved, ClaimKind::measure).where.empty());
  EXPECT_TRUE(discrete::proved_inverse(moved));
  EXPECT_TRUE(discrete::is_one_to_one(moved, 1e6));
}

TEST(ProveMap, WhereACompositionHasValuesIsSaidInTheVariablesOfItsStart) {
  const auto proof = [](const std::string& second) {
    return proof_of(map_of(kPhaseSpaceOfPlane +
                           "[[map_step]]\nexpressions = { x = \"x - 1\" }\n"
                           "[[map_step]]\nexpressions = { x = \"" +
                           second + "\" }\n[integrals]\nY = \"y\"\n"),
                    ClaimKind::integral);
  };
  EXPECT_EQ(proof("sqrt(x)").positive, std::vector<std::string>{"x - 1"});
  EXPECT_EQ(proof("1/x").nonzero, std::vector<std::string>{"x - 1"});
  EXPECT_NE(proof("1/x").evidence.find("each of the 2 steps"), std::string::npos);
}

// Neither step keeps x + y, their composition does.
TEST(ProveMap, ACompositionMayKeepWhatItsStepsDoNot) {
  const MapModel map = map_of(
      kPhaseSpaceOfPlane +
      "[[map_step]]\nexpressions = { x = \"x + 1\" }\n"
      "[[map_step]]\nexpressions = { y = \"y - 1\" }\n[integrals]\nF = \"x + y\"\nG = \"x\"\n");
  EXPECT_EQ(verdict_of(map, ClaimKind::integral, "F"), Verdict::proved);
  EXPECT_EQ(verdict_of(map, ClaimKind::integral, "G"), Verdict::refuted);
}

TEST(ProveMap, AMapThatIsDefinedNowhereProvesNothing) {
  const MapModel map = map_of(kPhaseSpaceOfPlane +
                              "[map]\nx = \"sqrt(-1 - x^2)\"\ny = \"y\"\n[integrals]\nF = \"y\"\n");
  EXPECT_EQ(verdict_of(map, ClaimKind::integral), Verdict::undecided);
}

// (1, 0) goes to (-2, 4), where log(x) has no value, and on to (1, 8).
TEST(ProveMap, AFunctionWithoutAValueBetweenTheStepsIsNotKeptByThem) {
  const std::string shears = R"toml(
[[map_step]]
expressions = { x = "x - 3", y = "y + abs(x - 3) - (x - 3)" }
[[map_step]]
expressions = { x = "x + 3", y = "y + abs(x) - x" }
)toml";
  const std::string f = "\"y + exp(log(x)) - x\"\n";
  EXPECT_EQ(verdict_of(map_of(kPhaseSpaceOfPlane + shears + "[integrals]\nF = " + f),
                       ClaimKind::integral),
            Verdict::refuted);
  EXPECT_EQ(verdict_of(map_of(kPhaseSpaceOfPlane + shears +
                              "[[invariant_relation]]\nname = \"r\"\nexpression = " + f),
                       ClaimKind::invariant_relation),
            Verdict::refuted);
}

// Around (1, 1) areas become 25 times as large.
TEST(ProveMap, ADensityWithoutAValueBetweenTheStepsIsNotKeptByThem) {
  const std::string one = "\"1 + exp(log(x)) - x\"\n";
  const MapModel map = map_of(kPhaseSpaceOfPlane + "[phase_space.brackets]\n\"x,y\" = " + one +
                              R"toml(
[[map_step]]
expressions = { x = "x - 3", y = "y*(1 + abs(x - 3) - (x - 3))" }
[[map_step]]
expressions = { x = "x + 3", y = "y*(1 + abs(x) - x)" }
[[measure]]
density = )toml" + one);
  EXPECT_EQ(verdict_of(map, ClaimKind::measure), Verdict::refuted);
  EXPECT_EQ(verdict_of(map, ClaimKind::map), Verdict::refuted);
}

TEST(ProveMap, AQuotientIsKeptByStepsThatAreQuotients) {
  const MapModel map = map_of(kPhaseSpaceOfPlane +
                              "[[map_step]]\nexpressions = { x = \"x*y/(x + y)\", y = \"x^2/(x + "
                              "y)\" }\n[[map_step]]\nexpressions = { x = \"y\", y = \"x\" }\n"
                              "[integrals]\nF = \"x/y + y/x\"\n");
  const Proof proof = proof_of(map, ClaimKind::integral);
  EXPECT_EQ(proof.verdict, Verdict::proved);
  EXPECT_NE(proof.evidence.find("each of the 2 steps"), std::string::npos) << proof.evidence;
}

// The logistic map moves the leaves c = const about.
TEST(ProveMap, IntegrabilityNeedsLeavesThatAreKept) {
  const auto map = [](const std::string& next, const std::string& more) {
    return map_of(
        "integrable = true\n[phase_space]\nvariables = [\"q\", \"p\", \"c\"]\n"
        "brackets = { \"q,p\" = \"1\" }\n" +
        more + "[map]\nq = \"q + c^2\"\np = \"p\"\nc = \"" + next + "\"\n[integrals]\nP = \"p\"\n");
  };
  const std::string casimirs = "[casimirs]\nC = \"c\"\n";
  EXPECT_EQ(verdict_of(map("4*c*(1 - c)", ""), ClaimKind::liouville), Verdict::undecided);
  EXPECT_EQ(verdict_of(map("4*c*(1 - c)", casimirs), ClaimKind::liouville), Verdict::undecided);
  EXPECT_EQ(verdict_of(map("c", ""), ClaimKind::liouville), Verdict::undecided);
  EXPECT_EQ(verdict_of(map("c", casimirs), ClaimKind::liouville), Verdict::proved);
}

// It is its own inverse, and keeps the areas of both halves.
TEST(ProveMap, AReflectionOfOneHalfOfThePlaneKeepsAreas) {
  const auto map = [](const std::string& density) {
    return map_of(kPhaseSpaceOfPlane +
                  "[map]\nx = \"x\"\ny = \"y*sign(x)\"\n[[measure]]\ndensity = \"" + density +
                  "\"\n");
  };
  EXPECT_EQ(verdict_of(map("1"), ClaimKind::measure), Verdict::proved);
  EXPECT_EQ(verdict_of(map("1 + y^2*x^2"), ClaimKind::measure), Verdict::proved);
  EXPECT_EQ(verdict_of(map("2 + y"), ClaimKind::measure), Verdict::refuted);
}

// (x^2, y/(2 x)) doubles areas: two points lead to each.
TEST(ProveMap, ASearchSaysThatADensityIsALocalOne) {
  const auto found =
      discrete::search_map(map_of(kPhaseSpaceOfPlane + "[map]\nx = \"x^2\"\ny = \"y/(2*x)\"\n"), 2);
  ASSERT_EQ(found.densities.size(), 1u);
  EXPECT_NE(found.densities[0].evidence.find("one to one"), std::string::npos);
}

/// A density is said to have both signs wherever these are, and not where the constraints leave
/// one.
TEST(ProveMap, TheSignsOfADensityAreThoseOnThePhaseSpace) {
  const auto has_both_signs = [](const std::string& space, const std::string& density) {
    const Proof proof = proof_of(map_of(space + "[[measure]]\ndensity = \"" + density + "\"\n"),
                                 ClaimKind::measure);
    EXPECT_EQ(proof.verdict, Verdict::proved) << density << ": " << proof.reason;
    return proof.evidence.find("both signs") != std::string::npos;
  };
  const std::string turn = kPhaseSpaceOfPlane + "[map]\nx = \"y\"\ny = \"-x\"\n";
  for (const char* density : {"100-x^2-y^2", "1/(16-(x^2+y^2)/25)", "x^2+y^2-1/1000"})
    EXPECT_TRUE(has_both_signs(turn, density)) << density;
  EXPECT_FALSE(has_both_signs(turn, "x^2+y^2"));
  // That of a parameter is the same at all points.
  const std::string with_parameter = turn + "[parameters]\na = {}\n";
  EXPECT_FALSE(has_both_signs(with_parameter, "a*(1 + x^2 + y^2)"));
  EXPECT_TRUE(has_both_signs(with_parameter, "a*(x^2 + y^2 - 1)"));
  const std::string steps = kPhaseSpaceOfPlane +
                            "[[map_step]]\nexpressions = { x = \"x + 1\" }\n"
                            "[[map_step]]\nexpressions = { x = \"x - 3\" }\n";
  EXPECT_TRUE(has_both_signs(steps, "1/y"));
  EXPECT_FALSE(has_both_signs(steps, "1/(1+y^2)"));
  const std::string circles =
      "[phase_space]\nvariables = [\"x\", \"y\", \"z\"]\nconstraints = [\"x^2+y^2-1\", "
      "\"z*(z-1)\"]\n[map]\nx = \"(3*x - 4*y)/5\"\ny = \"(4*x + 3*y)/5\"\nz = \"z\"\n";
  EXPECT_FALSE(has_both_signs(circles, "1+z"));
  EXPECT_FALSE(has_both_signs(circles, "2-z"));
  EXPECT_TRUE(has_both_signs(circles, "2*z-1"));
}

}  // namespace
}  // namespace casimir::test
