// Limits belong to a case and to what is made of it: two users of one process do not see each
// other's.
#include "symbolic/case/limits.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <variant>

#include "symbolic/discrete/map_model.hpp"
#include "symbolic/error.hpp"
#include "symbolic/functions/function_ring.hpp"
#include "symbolic/model/bare_motion.hpp"
#include "symbolic/proof/prover.hpp"
#include "symbolic/prove.hpp"
#include "tests/symbolic/cases.hpp"

namespace casimir {
namespace {

using test::euler_with;
using test::model_of;

/// An integral with 28 terms when it is multiplied out, of degree 12.
constexpr const char* kIntegral = "(M1^2 + M2^2 + M3^2)^6";

Limits strict() {
  Limits limits;
  limits.terms = 10;
  limits.how_to_raise = "ask the keeper of '{}'";
  return limits;
}

Text text_of(const std::string& value) { return {value, {"test", 1, 1}, value}; }

Proof proof_of(const Model& model, const std::string& integral = kIntegral) {
  Candidates candidates;
  candidates.integrals.push_back(text_of(integral));
  return prove(model, candidates).at(0);
}

/// The error that reading an expression ends with, by the limit and by its hint.
std::pair<double Limits::*, std::string> error_of(const Model& model, const std::string& text) {
  try {
    model.parse(text_of(text));
  } catch (const CaseError& error) {
    return {error.limit(), error.hint()};
  }
  return {nullptr, "no error"};
}

void expect_strict(const Proof& proof) {
  EXPECT_EQ(proof.verdict, Verdict::undecided);
  EXPECT_EQ(proof.limit, &Limits::terms);
  EXPECT_EQ(proof.reason,
            "an expanded power would have more than 10 terms; ask the keeper of 'terms'");
}

void expect_free(const Proof& proof) {
  EXPECT_EQ(proof.verdict, Verdict::proved) << proof.reason;
  EXPECT_EQ(proof.limit, nullptr);
}

TEST(Limits, OfTwoCasesHoldForEachAlone) {
  const Model narrow = euler_with("", strict()), wide = euler_with("");
  for (int turn = 0; turn < 3; ++turn) {
    expect_strict(proof_of(narrow));
    expect_free(proof_of(wide));
  }
}

TEST(Limits, OfExpressionsAreThoseOfTheCaseThatReadsThem) {
  Limits limits;
  limits.degree = 10;
  const Model narrow = euler_with("", limits), wide = euler_with("");
  for (int turn = 0; turn < 2; ++turn) {
    EXPECT_EQ(error_of(narrow, kIntegral),
              std::pair(&Limits::degree, std::string("a larger limit 'degree' allows more")));
    EXPECT_EQ(error_of(wide, kIntegral).second, "no error");
  }
}

// Exact algebra is for one thread at a time. The threads hand it to each other in the middle of
// their work, so that either comes upon whatever the other left behind.
TEST(Limits, OfTwoThreadsHoldForEachAlone) {
  constexpr int kTurns = 10;
  std::mutex algebra;
  const Model narrow = euler_with("", strict()), wide = euler_with("");
  const auto worker = [&](const Model& model, void (*expect)(const Proof&)) {
    return std::thread([&algebra, &model, expect] {
      for (int turn = 0; turn < kTurns; ++turn) {
        const std::lock_guard<std::mutex> guard(algebra);
        expect(proof_of(model));
      }
    });
  };
  std::thread first = worker(narrow, expect_strict), second = worker(wide, expect_free);
  first.join();
  second.join();
}

TEST(Limits, GoWithWhatIsMadeOfTheCase) {
  const Model model = euler_with("", strict());
  EXPECT_EQ(bare_motion(model).limits.terms, 10);
  EXPECT_EQ(Prover(model, {}).ring().limits().terms, 10);
  const MapModel map = build_map_model(std::get<MapCaseFile>(parse_any_case(
      "[phase_space]\nvariables = [\"x\"]\n[map]\nx = \"x + 1\"\n", "map.toml", strict())));
  EXPECT_EQ(map.base.limits.terms, 10);
  EXPECT_EQ(map.as_field().limits.terms, 10);
}

TEST(Limits, OfTheFileAreSaidByTheError) {
  const std::string toml =
      "hamiltonian = \"x\"\n[phase_space]\nvariables = [\"x[1..40]\"]\ncanonical = true\n";
  const auto limit_of = [&](double Limits::*limit, double value) -> double Limits::* {
    Limits limits;
    limits.*limit = value;
    try {
      model_of(toml, limits);
    } catch (const CaseError& error) {
      EXPECT_EQ(error.hint(), limits.hint(limit)) << error.what();
      return error.limit();
    }
    return nullptr;
  };
  for (const auto& [limit, value] :
       {std::pair(&Limits::file_bytes, 20.), std::pair(&Limits::repetitions, 39.),
        std::pair(&Limits::variables, 39.)})
    EXPECT_EQ(limit_of(limit, value), limit) << name_of(limit);
}

TEST(Limits, OfARingAreSaidByTheError) {
  const GiNaC::symbol x("x"), y("y");
  const GiNaC::ex power = GiNaC::pow(x + y + 1, 20);
  Limits limits;
  limits.terms = 100;
  EXPECT_EQ(FunctionRing({x, y}, {}, {power}, {}).convert(power).terms(), 231U);
  try {
    FunctionRing({x, y}, {}, {power}, limits);
    FAIL();
  } catch (const TooLarge& error) {
    EXPECT_EQ(error.limit(), &Limits::terms);
    EXPECT_STREQ(error.what(),
                 "an expanded power would have more than 100 terms; a larger limit 'terms' allows "
                 "more");
  }
}

TEST(Limits, HaveNames) {
  for (const LimitName& limit : limit_names()) {
    EXPECT_EQ(name_of(limit.value), limit.name);
    EXPECT_NE(Limits{}.hint(limit.value).find(limit.name), std::string::npos);
  }
  EXPECT_EQ(name_of(nullptr), "");
}

Limits of_work(double work) {
  Limits limits;
  limits.work = work;
  return limits;
}

TEST(WorkMeter, CountsWithinTheLimitItWasMadeWith) {
  WorkMeter::spend(1e300);  // nobody counts
  const WorkMeter outer(of_work(10));
  WorkMeter::spend(9);
  {
    const WorkMeter inner(of_work(100));
    WorkMeter::spend(99);
    EXPECT_THROW(WorkMeter::spend(2), TooLarge);
  }
  WorkMeter::spend(1);
  EXPECT_THROW(WorkMeter::spend(1), TooLarge);
}

TEST(WorkMeter, CountsForItsThreadAlone) {
  constexpr int kSteps = 100000;
  const auto spent = [](double work) {
    const WorkMeter meter(of_work(work));
    for (int step = 0; step < kSteps; ++step) {
      try {
        WorkMeter::spend(1);
      } catch (const TooLarge&) {
        return step;
      }
    }
    return kSteps;
  };
  std::atomic<int> small = 0, large = 0;
  std::thread first([&] { small = spent(1000); });
  std::thread second([&] { large = spent(kSteps); });
  first.join();
  second.join();
  EXPECT_EQ(small, 1000);
  EXPECT_EQ(large, kSteps);
}

}  // namespace
}  // namespace casimir
