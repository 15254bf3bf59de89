// Every claim of every bundled case is proved, and every claim with one sign flipped is not.
#include "tests/symbolic/cases.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "symbolic/expression/expression.hpp"
#include "symbolic/prove.hpp"
#include "tests/bundled_cases.hpp"

namespace casimir::test {

namespace {

class EveryCase : public testing::TestWithParam<std::filesystem::path> {};

TEST_P(EveryCase, IsProved) {
  const Model model = build_model(read_case(GetParam()));
  const std::vector<Proof> proofs = prove(model);
  EXPECT_EQ(overall(model, proofs), Verdict::proved);
  for (const Proof& proof : proofs) {
    if (!counts(model, proof)) continue;
    EXPECT_EQ(proof.verdict, Verdict::proved) << to_string(proof.kind) << ' ' << proof.name << ": "
                                              << proof.reason << ' ' << proof.residual;
  }
}

// The twin: adding a coordinate to an integral spoils it, unless that coordinate is conserved.
TEST_P(EveryCase, BentIntegralIsRefutedByAWitness) {
  Model model = build_model(read_case(GetParam()));
  int bent = 0;
  for (std::size_t i = 0; i < model.variables.size(); ++i) {
    const GiNaC::ex x = model.variables[i];
    Model copy = model;
    for (NamedExpression& f : copy.integrals) f.value += x * x;
    if (model.field[i].expand().is_zero()) continue;
    for (const Proof& proof : prove(copy, {.only = ClaimKind::integral})) {
      if (proof.kind != ClaimKind::integral) continue;
      EXPECT_NE(proof.verdict, Verdict::proved) << proof.name << " + " << x << "^2";
      if (proof.verdict != Verdict::refuted) continue;
      ++bent;
      ASSERT_TRUE(proof.witness.has_value());
      EXPECT_NE(proof.witness->value, "0");
    }
  }
  if (!model.integrals.empty()) {
    EXPECT_GT(bent, 0);
  }
}

// A witness is worth something only if it is a point where GiNaC itself finds the residual.
TEST_P(EveryCase, WitnessOfAFalseCasimirReEvaluatesToItsValue) {
  const Model model = build_model(read_case(GetParam()));
  if (!model.poisson) return;  // nothing is a Casimir function there
  Candidates candidates;
  const std::string name = model.variables[0].get_name();
  candidates.casimirs = {{name, {"test", 1, 1}, name}};
  const std::vector<Proof> proofs = prove(model, candidates);
  ASSERT_EQ(proofs.size(), 2U);  // the claim and the judgement
  EXPECT_TRUE(proofs[1].note);
  ASSERT_EQ(proofs[0].verdict, Verdict::refuted) << proofs[0].reason;
  GiNaC::exmap point;
  for (const auto& [symbol, value] : proofs[0].witness->point) {
    for (const auto* list : {&model.variables, &model.parameters}) {
      for (const GiNaC::symbol& s : *list) {
        if (s.get_name() == symbol)
          point[s] = parse_constant({value, {"witness", 1, 1}, value}, {});
      }
    }
  }
  bool found = false;
  for (const GiNaC::symbol& x : model.variables) {
    const GiNaC::ex residual = model.poisson->bracket(x, model.variables[0]).subs(point);
    found = found || (residual - GiNaC::numeric(proofs[0].witness->value.c_str())).is_zero();
  }
  EXPECT_TRUE(found);
}

INSTANTIATE_TEST_SUITE_P(Cases, EveryCase, testing::ValuesIn(bundled_cases()),
                         [](const auto& file) { return test_name_of(file.param); });

}  // namespace
}  // namespace casimir::test
