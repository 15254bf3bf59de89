#pragma once

#include <cstdint>
#include <string>

#include "symbolic/case/limits.hpp"
#include "tests/adversary/case.hpp"
#include "tests/adversary/templates.hpp"

namespace casimir::adversary {

/// How a claim came out.
enum class Outcome {
  proved,
  refuted,
  undecided,
  refused,      ///< the library does not read the case, and says so
  unconfirmed,  ///< the oracle could not confirm the truth: nothing was asked
  false_proof,  ///< proved, but false or about nothing
  false_refutation,
  bad_witness,  ///< rightly refuted, by a point that shows nothing
  broken,       ///< an exception that is no refusal, a crash, or no answer in time
  tester,       ///< construction and oracle disagree: the fault is the tester's
};
inline constexpr std::size_t kOutcomes = 10;

std::string to_string(Outcome outcome);
/// Whether it fails the run.
bool is_failure(Outcome outcome);

/// Under which a claim is read and decided: one that takes longer is undecided, which is no
/// failure.
Limits limits_of_a_claim();

/// One claim, judged.
struct Judgement {
  Outcome outcome = Outcome::unconfirmed;
  Kind kind = Kind::integral;
  std::string family;
  Truth truth = Truth::yes;
  std::string what;  ///< for a failure, or why it is undecided
  std::string file;  ///< the case; of what is judged only for a failure, or if it is undecided
};

/// What is known of the claim of that index before anyone is asked, with its file.
Judgement unjudged(std::uint64_t seed, std::uint64_t index);

/// Makes the claim of that index, finds what the prover says of it, and judges that.
Judgement judge(std::uint64_t seed, std::uint64_t index);
/// The same for another claim in its place, with the same random numbers for the oracle.
Judgement judge(AnyClaim claim, std::uint64_t seed, std::uint64_t index);

}  // namespace casimir::adversary
