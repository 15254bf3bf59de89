// Systems from expressions, and their claims.
#include "tools/analysis/system.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "symbolic/case/limits.hpp"
#include "tests/tools/analysis/systems.hpp"
#include "tools/analysis/verify.hpp"

namespace casimir::test {
namespace {

TEST(System, TheEquationsAreThoseOfHamilton) {
  const Oscillator oscillator;
  ASSERT_EQ(oscillator.model.field.size(), 2U);
  EXPECT_TRUE((oscillator.model.field[0] - oscillator.p).expand().is_zero());
  EXPECT_TRUE((oscillator.model.field[1] + oscillator.q).expand().is_zero());
}

TEST(System, AnIntegralIsProvedAndItsBentTwinRefutedWithAWitness) {
  const GiNaC::symbol x("x"), y("y"), u("u"), v("v"), k("k");
  Model model =
      hamiltonian_system("central", {x, y}, {u, v}, (u * u + v * v) / 2 + k * (x * x + y * y), {k});
  model.integrals = {{"L", x * v - y * u, {}}};
  EXPECT_EQ(verify(model).verdict, Verdict::proved);
  model.integrals = {{"L", x * v + y * u, {}}};
  for (const double seconds : {0., 60.}) {
    const Verification refuted = verify(model, seconds);
    EXPECT_EQ(refuted.verdict, Verdict::refuted);
    const auto proof = std::ranges::find(refuted.proofs, "L", &Proof::name);
    ASSERT_NE(proof, refuted.proofs.end());
    ASSERT_TRUE(proof->witness);
    EXPECT_EQ(proof->witness->point.size(), 5U);
  }
}

// With a time limit the proofs run in another process.
TEST(System, ProofsAreHeldToTheLimitsOfTheirModel) {
  const GiNaC::symbol x("x"), y("y"), u("u"), v("v");
  Model wide = hamiltonian_system("plane", {x, y}, {u, v}, u * u + v * v + x * x + y * y);
  wide.integrals = {{"F", GiNaC::pow(*wide.hamiltonian, 6), {}}};
  Model narrow = wide;
  narrow.limits.terms = 20;
  for (const double seconds : {0., 60.}) {
    for (const Model* model : {&narrow, &wide}) {
      const Verification result = verify(*model, seconds);
      const auto proof = std::ranges::find(result.proofs, "F", &Proof::name);
      ASSERT_NE(proof, result.proofs.end());
      EXPECT_EQ(proof->verdict, model == &wide ? Verdict::proved : Verdict::undecided);
      EXPECT_EQ(proof->limit, model == &wide ? nullptr : &Limits::terms) << proof->reason;
    }
  }
}

TEST(System, WhatExactAlgebraHasNoMeaningForIsRefused) {
  const GiNaC::symbol q("q"), p("p"), other("a"), twin("q"), keyword("double");
  const auto refused = [&](const GiNaC::ex& h) {
    EXPECT_THROW(hamiltonian_system("x", {q}, {p}, h), ModelError) << h;
  };
  refused(GiNaC::ex(0.5) * p * p);
  refused(GiNaC::I * p * p);
  refused(p * p + other);
  refused(p * p + twin);
  refused(GiNaC::tgamma(q));
  refused(GiNaC::Catalan * q);
  refused(GiNaC::ex(q == p));
  EXPECT_THROW(hamiltonian_system("x", {q}, {}, q), ModelError);
  EXPECT_THROW(hamiltonian_system("x", {q}, {twin}, q), ModelError);
  EXPECT_THROW(hamiltonian_system("x", {q}, {keyword}, q), CaseError);
  EXPECT_NO_THROW(hamiltonian_system("x", {q}, {p}, p * p / 2 - GiNaC::cos(q) + GiNaC::Pi));
  EXPECT_NO_THROW(hamiltonian_system("x", {q}, {p}, p * p * other, {other}));
}

TEST(System, InitialValuesAreExactRealConstantsAsManyAsThereAreVariables) {
  const Oscillator oscillator;
  EXPECT_NO_THROW(scene_from(oscillator.model, {GiNaC::sqrt(GiNaC::ex(2)), GiNaC::Pi}, 1));
  EXPECT_THROW(scene_from(oscillator.model, {1}, 1), ModelError);
  EXPECT_THROW(scene_from(oscillator.model, {1, 0.5}, 1), ModelError);
  EXPECT_THROW(scene_from(oscillator.model, {1, oscillator.q}, 1), ModelError);
  EXPECT_THROW(scene_from(oscillator.model, {1, GiNaC::sqrt(GiNaC::ex(-2))}, 1), ModelError);
  EXPECT_THROW(scene_from(oscillator.model, {1, 0}, 1, {2}), ModelError);
}

}  // namespace
}  // namespace casimir::test
