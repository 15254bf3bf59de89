#include "tools/analysis/run/drift_check.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/tools/analysis/systems.hpp"
#include "tools/analysis/solve.hpp"

namespace casimir::test {
namespace {

/// A run of the scene whose invariants have done this.
Trajectory ended(const PreparedScene& run, std::vector<InvariantRecord> invariants) {
  Trajectory trajectory;
  trajectory.state = run.initial;
  trajectory.invariants = std::move(invariants);
  return trajectory;
}

TEST(DriftCheck, AnIntegralOnTheDomainAloneSaysNothingOfTheRun) {
  const Model model = model_of(kLeavesItsDomain);
  const Scene& scene = model.scene("default");
  EXPECT_EQ(known_invariant(model, scene, "F").proof.verdict, Verdict::proved);
  const KnownInvariant known = known_invariant(model, scene, "G");
  EXPECT_NE(known.proof.verdict, Verdict::proved);
  EXPECT_TRUE(known.on_domain);
  const PreparedScene run = prepare(model, scene);
  Trajectory end = ended(run, {{.initial = 1, .final = 1, .drift = 0, .allowed = 1e-9},
                               {.initial = -1, .final = 0, .drift = 1, .allowed = 1e-9}});
  const DriftDoubts doubts = check_drift(model, scene, run, end);
  EXPECT_EQ(end.status, Status::ok);
  ASSERT_EQ(doubts.sentences.size(), 1U);
  EXPECT_NE(doubts.sentences[0].find("on the domain of the case alone"), std::string::npos);
}

/// A rotation with an integral, if not said otherwise one that has no value at radius 1.
Model rotation(const std::string& x, const std::string& y,
               const std::string& integral = "(x^2 + y^2)^2/(x^2 + y^2 - 1)") {
  return model_of(R"toml(
title = "rotation"
[phase_space]
variables = ["x", "y"]
[equations]
x = "y"
y = "-x"
[[scene]]
name = "default"
duration = "10"
)toml"
                  "initial = { x = \"" +
                  x + "\", y = \"" + y + "\" }\n[integrals]\nF = \"" + integral + "\"\n");
}

TEST(DriftCheck, AnIntegralWithoutAValueSaysNothingOfTheRun) {
  for (const auto& [x, y] : {std::pair{"1", "0"}, {"3/5", "4/5"}}) {
    const Model model = rotation(x, y);
    const auto motion = solve(model, model.scene("default"));
    EXPECT_TRUE(motion.ok()) << x;
    EXPECT_LT(motion.trust().error_estimate, 1e-13) << x;
    ASSERT_FALSE(motion.run().doubts.empty()) << x;
    EXPECT_NE(motion.run().doubts[0].find("says nothing of"), std::string::npos)
        << motion.run().doubts[0];
  }
}

TEST(DriftCheck, AnIntegralThatIsLostOnTheWayIsLookedAtAtTheEnd) {
  const Model model = rotation("2", "0");
  const Scene& scene = model.scene("default");
  const PreparedScene run = prepare(model, scene);
  constexpr double kNever = std::numeric_limits<double>::infinity();
  Trajectory kept = ended(run, {{.initial = 5, .final = 5, .drift = kNever, .allowed = 1e-9}});
  EXPECT_EQ(check_drift(model, scene, run, kept).which.size(), 1U);
  EXPECT_EQ(kept.status, Status::ok);
  Trajectory lost = ended(run, {{.initial = 5, .final = 6, .drift = kNever, .allowed = 1e-9}});
  EXPECT_TRUE(check_drift(model, scene, run, lost).which.empty());
  EXPECT_EQ(lost.status, Status::drift_exceeded);
  Trajectory drifted = ended(run, {{.initial = 5, .final = 5, .drift = 1e-6, .allowed = 1e-9}});
  check_drift(model, scene, run, drifted);
  EXPECT_EQ(drifted.status, Status::drift_exceeded);
}

/// Beside x^2 + y^2 = 1 the root has no value on one side, which is no change.
TEST(DriftCheck, AnIntegralAtTheEdgeOfItsDomainIsLookedAt) {
  const Model model = rotation("1", "0", "5 + sqrt(x^2 + y^2 - 1)");
  const PreparedScene run = prepare(model, model.scene("default"));
  Trajectory drifted = ended(run, {{.initial = 5, .final = 7, .drift = 0.4, .allowed = 1e-9}});
  EXPECT_TRUE(check_drift(model, model.scene("default"), run, drifted).which.empty());
  EXPECT_EQ(drifted.status, Status::drift_exceeded);
}

}  // namespace
}  // namespace casimir::test
