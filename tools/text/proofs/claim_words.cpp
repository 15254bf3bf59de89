#include "tools/text/proofs/claim_words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cstddef>

namespace casimir::tools {
namespace {

std::string by_verdict(const Proof& finding, const char* what) {
  switch (finding.verdict) {
    case Verdict::proved:
      return fmt::format("it is a {}", what);
    case Verdict::refuted:
      return fmt::format("it is no {}: {}", what, finding.reason);
    case Verdict::undecided:
      break;
  }
  return fmt::format("whether it is a {} is undecided", what);
}

std::string evidence(const Proof& finding) {
  return finding.evidence.empty() ? "" : " (" + finding.evidence + ")";
}

std::string casimir_finding(const Proof& finding) {
  return by_verdict(finding, "Casimir function");
}

std::string integral_finding(const Proof& finding) { return by_verdict(finding, "first integral"); }

std::string conditional_finding(const Proof& finding) {
  return fmt::format("it is an integral where {} = 0{}", fmt::join(finding.on, " = "),
                     evidence(finding));
}

std::string relation_finding(const Proof& finding) {
  return "its zero level is invariant" + evidence(finding);
}

/// The evidence or the reason says all of it.
std::string plain_finding(const Proof& finding) {
  return finding.verdict == Verdict::proved ? finding.evidence : finding.reason;
}

constexpr std::array kClaimWords{
    ClaimWords{ClaimKind::skew, "skew bracket", "skew brackets", plain_finding},
    ClaimWords{ClaimKind::jacobi, "Jacobi identity", "Jacobi identities", plain_finding},
    ClaimWords{ClaimKind::casimir, "Casimir function", "Casimir functions", casimir_finding,
               "Casimir functions"},
    ClaimWords{ClaimKind::integral, "integral", "integrals", integral_finding, "integrals"},
    ClaimWords{ClaimKind::conditional, "integral on the level", "integrals on the level",
               conditional_finding, "integrals on a level"},
    ClaimWords{ClaimKind::invariant_relation, "invariant relation", "invariant relations",
               relation_finding, "invariant relations"},
    ClaimWords{ClaimKind::lax, "Lax pair", "Lax pairs", plain_finding},
    ClaimWords{ClaimKind::map, "Poisson map", "Poisson maps", plain_finding},
    ClaimWords{ClaimKind::measure, "invariant measure", "invariant measures", plain_finding,
               "densities of invariant measures"},
    ClaimWords{ClaimKind::identity, "identity", "identities", plain_finding, "identities"},
    ClaimWords{ClaimKind::involution, "involution", "involutions", plain_finding},
    ClaimWords{ClaimKind::independence, "independence", "independences", plain_finding},
    ClaimWords{ClaimKind::rank, "rank", "ranks", plain_finding},
    ClaimWords{ClaimKind::liouville, "count of integrals", "counts of integrals", plain_finding},
    ClaimWords{ClaimKind::conjugacy, "conjugacy", "conjugacies", plain_finding},
    ClaimWords{ClaimKind::judgement, "judgement", "judgements", plain_finding},
};

consteval bool has_place_of_its_kind() {
  for (std::size_t i = 0; i < kClaimWords.size(); ++i) {
    if (kClaimWords[i].kind != static_cast<ClaimKind>(i)) return false;
  }
  return true;
}
static_assert(has_place_of_its_kind());

}  // namespace

const ClaimWords& claim_words(ClaimKind kind) {
  return kClaimWords.at(static_cast<std::size_t>(kind));
}

}  // namespace casimir::tools
