#include "tests/adversary/judge.hpp"

#include <array>
#include <charconv>
#include <cmath>

#include "symbolic/error.hpp"
#include "symbolic/prove.hpp"
#include "symbolic/search/watch.hpp"
#include "tests/adversary/judge_planted.hpp"
#include "tests/adversary/judge_search.hpp"
#include "tests/adversary/oracle.hpp"
#include "tests/adversary/parser.hpp"
#include "tests/adversary/templates.hpp"

namespace casimir::adversary {
namespace {

/// The random numbers of the oracle are not those of the generator.
constexpr std::uint64_t kOracleSeed = 0x5EED;

const Proof* proof_of(const Case& claim, const std::vector<Proof>& proofs) {
  const Proof* last = nullptr;
  for (const Proof& p : proofs) {
    if (p.note || to_string(p.kind) != to_string(claim.kind)) continue;
    if (!claim.name.empty() && p.name != claim.name) continue;
    last = &p;
    // Of several Lax pairs or measures the claim is all of them: the worst counts.
    if (p.verdict != Verdict::proved) break;
  }
  return last;
}

std::size_t number_in(const std::string& name) {
  const std::size_t place = name.find_last_of(' ') + 1;
  std::size_t number = 0;
  std::from_chars(name.data() + place, name.data() + name.size(), number);
  return number;
}

Point point_of(const Witness& witness) {
  Point point;
  for (const auto& [name, text] : witness.point) point[name] = value(parse(text), {});
  return point;
}

std::vector<std::string> split(const std::string& text, const std::string& by) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  for (std::size_t end = 0; (end = text.find(by, begin)) != std::string::npos;
       begin = end + by.size())
    parts.push_back(text.substr(begin, end - begin));
  parts.push_back(text.substr(begin));
  return parts;
}

/// Conditions that a proof names, so that it says nothing elsewhere: pieces are alternatives. Empty
/// where one is said in words, as that it holds around a point.
template <typename AnyProof>
std::optional<std::vector<Alternatives>> pieces_of(const AnyProof& proof) {
  std::vector<Alternatives> result;
  if constexpr (!requires { proof.where; }) return result;
  for (const std::string& condition : proof.where) {
    const bool inequalities = condition.find_first_of("<>=") != std::string::npos;
    if (!inequalities || condition.find("around") != std::string::npos) return std::nullopt;
    Alternatives& alternatives = result.emplace_back();
    for (const std::string& part : split(condition, ", or ")) {
      alternatives.emplace_back();
      for (const std::string& inequality : split(part, " and "))
        alternatives.back().push_back(parse_assumption(inequality));
    }
  }
  return result;
}

/// One part of each condition, in every way.
std::vector<std::vector<Assumption>> all_parts(const std::vector<Alternatives>& conditions) {
  std::vector<std::vector<Assumption>> result{{}};
  for (const Alternatives& alternatives : conditions) {
    std::vector<std::vector<Assumption>> longer;
    for (const std::vector<Assumption>& begun : result) {
      for (const std::vector<Assumption>& part : alternatives) {
        longer.push_back(begun);
        longer.back().insert(longer.back().end(), part.begin(), part.end());
      }
    }
    result = std::move(longer);
  }
  return result;
}

/// Whether what is said to be proved fails where it is said to hold.
bool fails(const Case& claim, const Proof& proof, Random& random) {
  if (claim.kind == Kind::rank) {
    const auto where = pieces_of(proof);
    return where && examine_rank(claim, number_in(proof.name), random, *where) == Finding::fails;
  }
  if (claim.truth == Truth::yes) return false;
  const auto where = pieces_of(proof);
  if (!where) return false;
  if (where->empty()) return true;
  const std::vector<std::vector<Assumption>> parts = all_parts(*where);
  return std::any_of(parts.begin(), parts.end(), [&](const std::vector<Assumption>& part) {
    const Finding left = examine(claim, random, part);
    return left == Finding::fails || (claim.truth == Truth::nothing && left == Finding::nowhere);
  });
}

/// Whether what a witness shows is too small for the 40 digits of the oracle, as exp(-9^3) is.
bool is_beyond_digits(const Witness& witness) {
  constexpr double kSmallest = 1e-35;
  try {
    return std::fabs(value(parse(witness.value), {}, false).as_double()) < kSmallest;
  } catch (const Unknown&) {
    return true;
  }
}

Outcome compare(const Case& claim, const Proof& proof, Random& random, std::string& what) {
  switch (proof.verdict) {
    case Verdict::undecided:
      what = proof.reason;
      return Outcome::undecided;
    case Verdict::proved:
      if (!fails(claim, proof, random)) return Outcome::proved;
      what = "proved: " + to_string(proof.kind) + " " + proof.name + " " + proof.evidence;
      return Outcome::false_proof;
    case Verdict::refuted:
      break;
  }
  if (claim.truth == Truth::yes && claim.kind != Kind::rank) {
    what = "refuted: " + to_string(proof.kind) + " " + proof.name + " " + proof.residual;
    return Outcome::false_refutation;
  }
  if (!proof.witness) return Outcome::refuted;
  const std::string wrong = examine_witness(claim, point_of(*proof.witness));
  if (wrong.empty() || is_beyond_digits(*proof.witness)) return Outcome::refuted;
  what = "its witness shows nothing: " + wrong;
  return Outcome::bad_witness;
}

/// Whether construction and oracle agree; sets the truth where the oracle decides.
Outcome confirm(Case& claim, Random& random, std::string& what) {
  constexpr int kLooks = 12;
  Finding finding = examine(claim, random);
  // Where a claim was made to be false the part of space that shows it may be narrow.
  for (int look = 1; look < kLooks && claim.truth == Truth::no && finding == Finding::holds; ++look)
    finding = examine(claim, random);
  if (finding == Finding::unclear) return Outcome::unconfirmed;
  const Truth found = finding == Finding::holds   ? Truth::yes
                      : finding == Finding::fails ? Truth::no
                                                  : Truth::nothing;
  // That a claim fails is certain; that a change left it true is not, for points may have been
  // missed.
  if (claim.by_oracle && found == Truth::no) claim.truth = found;
  if (claim.by_oracle && found == Truth::yes && claim.truth != found) return Outcome::unconfirmed;
  if (claim.truth == found) return Outcome::proved;
  if (found == Truth::nothing) return Outcome::unconfirmed;
  what = "made to be " + to_string(claim.truth) + ", found to be " + to_string(found);
  return Outcome::tester;
}

Outcome ask(Case& claim, Random& random, std::string& what) {
  if (const Outcome truth = confirm(claim, random, what); truth != Outcome::proved) return truth;
  const Model model = build_model(parse_case(claim.text(), "claim.toml", limits_of_a_claim()));
  Candidates candidates;
  candidates.only = claim_kind_of(to_string(claim.kind));
  const std::vector<Proof> proofs = prove(model, candidates);
  if (const Proof* proof = proof_of(claim, proofs)) return compare(claim, *proof, random, what);
  what = "the claim is not in the answer";
  return Outcome::tester;
}

/// What is asked, with the library's errors as outcomes.
Outcome asked(AnyClaim& claim, Random& random, std::string& what) {
  try {
    if (auto* search = std::get_if<SearchCase>(&claim)) return judge_search(*search, random, what);
    if (auto* planted = std::get_if<PlantedCase>(&claim))
      return judge_planted(*planted, random, what);
    return ask(std::get<Case>(claim), random, what);
  } catch (const Unknown&) {
    return Outcome::unconfirmed;
  } catch (const NotReal&) {
    return Outcome::unconfirmed;
  } catch (const CaseError& e) {
    what = e.what();
    return Outcome::refused;
  } catch (const ModelError& e) {
    what = e.what();
    return Outcome::refused;
  } catch (const search::NoAnswer& e) {
    what = e.what();
    return Outcome::undecided;
  } catch (const std::logic_error& e) {
    what = std::string("the oracle: ") + e.what();
    return Outcome::tester;
  } catch (const std::exception& e) {
    what = std::string("exception: ") + e.what();
    return Outcome::broken;
  }
}

Judgement described(const AnyClaim& claim) {
  Judgement result;
  if (const auto* search = std::get_if<SearchCase>(&claim)) {
    result.kind = search->is_free() ? Kind::free_search : Kind::search;
    result.family = search->base.family;
    result.file = search->text();
    return result;
  }
  if (const auto* planted = std::get_if<PlantedCase>(&claim)) {
    result.kind = planted->base.kind;
    result.family = planted->base.family;
    result.file = planted->text();
    return result;
  }
  const Case& c = std::get<Case>(claim);
  result.kind = c.kind;
  result.family = c.family;
  result.truth = c.truth;
  result.file = c.text();
  return result;
}

}  // namespace

std::string to_string(Outcome outcome) {
  static const std::array<const char*, kOutcomes> names{
      "proved",      "refuted",          "undecided",   "refused", "unconfirmed",
      "false proof", "false refutation", "bad witness", "broken",  "tester"};
  return names[static_cast<std::size_t>(outcome)];
}

bool is_failure(Outcome outcome) { return outcome >= Outcome::false_proof; }

Limits limits_of_a_claim() {
  Limits limits;
  limits.work = 1e7;
  return limits;
}

Judgement unjudged(std::uint64_t seed, std::uint64_t index) {
  Random generator(seed, index);
  return described(random_claim(generator));
}

Judgement judge(std::uint64_t seed, std::uint64_t index) {
  Random generator(seed, index);
  return judge(random_claim(generator), seed, index);
}

Judgement judge(AnyClaim claim, std::uint64_t seed, std::uint64_t index) {
  Random oracle(seed ^ kOracleSeed, index);
  std::string what;
  const Outcome outcome = asked(claim, oracle, what);
  Judgement result = described(claim);
  result.outcome = outcome;
  result.what = what;
  if (!is_failure(outcome) && outcome != Outcome::undecided) result.file.clear();
  return result;
}

}  // namespace casimir::adversary
