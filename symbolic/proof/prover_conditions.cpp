// What stands beside a verdict: where something was divided by, and that there are points at all.
#include <algorithm>

#include "symbolic/proof/prover.hpp"

namespace casimir {

using GiNaC::ex;

/// A claim about nothing says so: for all points of the empty set everything is true. So does one
/// that differentiates functions which have real values on the edge of their domain alone, as
/// sqrt(-x^2) has.
void Prover::check_inhabited(Proof& proof, const Level& own) {
  if (proof.verdict != Verdict::proved) return;
  const bool everywhere = ring_.is_polynomial() && model_.assumptions.empty();
  static const std::vector<ex> kNothing;
  const std::vector<ex>& domain = ring_.is_polynomial() ? kNothing : domain_;
  if (own.empty()) {
    if (everywhere) return;
    if (!all_inhabited_)
      all_inhabited_ = real_points_.any(ring_.is_polynomial() ? kNothing : all_, true).has_value();
    if (*all_inhabited_) return;
    if (!claim_inhabited_)
      claim_inhabited_ = real_points_.any(domain, subject_ != Subject::functions).has_value();
    if (*claim_inhabited_) return;
  } else if (RealLevelPoints(ring_, real_points_, points_).exists(own, domain)) {
    return;
  }
  proof.verdict = Verdict::undecided;
  proof.evidence.clear();
  proof.reason = own.empty()
                     ? "no real point was found inside the assumptions at which all functions of "
                       "the claim have real values: it may be about nothing"
                     : "no real point of the level was found inside the assumptions at which all "
                       "functions of the claim have real values: it may be about nothing";
}

namespace {

/// The bases of the powers whose exponents are no numbers, in the order of the text.
void add_bases(const ex& expression, std::vector<ex>& bases) {
  if (GiNaC::is_a<GiNaC::power>(expression) && !GiNaC::is_a<GiNaC::numeric>(expression.op(1)))
    bases.push_back(expression.op(0));
  for (std::size_t i = 0; i < expression.nops(); ++i) add_bases(expression.op(i), bases);
}

/// False where no expression that was converted has a power whose exponent is no number and whose
/// base is no constant: it is made of a logarithm or, where the base is one, of an exponential.
bool may_have_open_powers(const FunctionRing& ring) {
  using Kind = FunctionRing::Origin::Kind;
  if (ring.is_complex()) return true;
  for (std::size_t g = ring.symbols().size(); g < ring.end_of_generators(); ++g) {
    const Kind kind = ring.origin(g).kind;
    if (kind == Kind::logarithm || kind == Kind::exponential) return true;
  }
  return false;
}

}  // namespace

void Prover::say_conditions(Proof& proof) {
  // x^n is read as exp(n*log(x)), though for whole n it has values for x < 0 too.
  const bool any = proof.verdict == Verdict::proved && may_have_open_powers(ring_);
  for (const ex& expression : any ? domain_ : std::vector<ex>{}) {
    std::vector<ex> bases;
    add_bases(expression, bases);
    for (const ex& part : bases) {
      const Polynomial base = ring_.convert(part);
      const bool assumed = base.is_constant() || ring_.is_assumed_positive(base);
      const std::string condition = ring_.text(base) + " > 0";
      const bool said =
          std::find(proof.where.begin(), proof.where.end(), condition) != proof.where.end();
      if (!assumed && !said) proof.where.push_back(condition);
    }
  }
  proof.nonzero.clear();
  proof.positive.clear();
  const std::vector<Polynomial> denominators = ring_.denominators();
  for (std::size_t k = 0; k < divided_by_.size(); ++k) {
    if (divided_by_[k] && !ring_.is_nowhere_zero(denominators[k]))
      proof.nonzero.push_back(ring_.text(denominators[k]));
  }
  // The ring meets them in an order that differs from one process to the next.
  std::sort(proof.nonzero.begin(), proof.nonzero.end());
  for (const Polynomial& p : ring_.implied_positive()) proof.positive.push_back(ring_.text(p));
}

}  // namespace casimir
