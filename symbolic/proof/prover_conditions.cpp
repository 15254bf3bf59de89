// What stands beside a verdict: where something was divided by, that there are points at all, and
// cofactors.
#include <cln/float.h>
#include <cln/rational.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "symbolic/proof/prover.hpp"

namespace casimir {

using GiNaC::ex;

/// A claim about nothing says so: for all points of the empty set everything is true. So does one
/// that differentiates functions which have real values on the edge of their domain alone, as
/// sqrt(-x^2) has.
void Prover::check_inhabited(Proof& proof, const Level& own) {
  if (proof.verdict != Verdict::proved || taken_as_inhabited_) return;
  const bool whole = own.empty();
  const bool constrained = constraints_count_ && !model_.constraints.empty();
  if ((!whole || has_inner_points()) && (!constrained || has_points_on_constraints(own)) &&
      (whole || constrained || has_points_on(own, claim_expressions())))
    return;
  proof.verdict = Verdict::undecided;
  proof.evidence.clear();
  proof.reason = fmt::format(
      "no real point{} was found inside the assumptions at which all functions of the claim have "
      "real values: it may be about nothing",
      constrained ? (whole ? " of the constraints" : " of the level and the constraints")
                  : (whole ? "" : " of the level"));
}

/// What a point of the claim needs values of; a polynomial has one everywhere.
const std::vector<ex>& Prover::claim_expressions() const {
  static const std::vector<ex> kNothing;
  return ring_.is_polynomial() ? kNothing : domain_;
}

/// The same of all claims of the case at once.
const std::vector<ex>& Prover::all_expressions() const {
  static const std::vector<ex> kNothing;
  return ring_.is_polynomial() ? kNothing : all_;
}

bool Prover::has_points_on(const Level& level, const std::vector<ex>& expressions) {
  return RealLevelPoints(ring_, real_points_, points_).find(level, expressions).has_value();
}

bool Prover::has_inner_points() {
  if (ring_.is_polynomial() && model_.assumptions.empty()) return true;
  if (!all_inhabited_) all_inhabited_ = real_points_.any(all_expressions(), true).has_value();
  if (*all_inhabited_) return true;
  if (!claim_inhabited_)
    claim_inhabited_ =
        real_points_.any(claim_expressions(), subject_ != Subject::functions).has_value();
  return *claim_inhabited_;
}

/// Of what the constraints leave of a level: sqrt(|x|^2 - 2) is a Casimir function of so(3), and
/// has no value on the unit sphere.
bool Prover::has_points_on_constraints(const Level& own) {
  const std::vector<ex>& known = level(model_.constraints).functions;
  const bool whole = std::ranges::all_of(own.functions, [&](const ex& f) {
    return std::ranges::any_of(known, [&](const ex& g) { return f.is_equal(g); });
  });
  if (!whole) {
    if (on_constraints_->vain_searches >= PointsOfConstraints::kMostSearches) return false;
    const bool found =
        has_points_on(level(within_constraints(functions_of(own))), claim_expressions());
    if (!found) ++on_constraints_->vain_searches;
    return found;
  }
  if (!all_on_constraints_) all_on_constraints_ = has_point_of_constraints(all_expressions(), true);
  if (*all_on_constraints_) return true;
  if (ring_.is_polynomial()) return false;
  if (!claim_on_constraints_)
    claim_on_constraints_ =
        has_point_of_constraints(claim_expressions(), subject_ != Subject::functions);
  return *claim_on_constraints_;
}

/// Points that were found once are looked at first.
bool Prover::has_point_of_constraints(const std::vector<ex>& expressions, bool differentiable) {
  PointsOfConstraints& so_far = *on_constraints_;
  const bool known = std::ranges::any_of(so_far.points, [&](BallEvaluator point) {
    return real_points_.admits(point, expressions) && (!differentiable || point.smooth());
  });
  if (known) return true;
  if (so_far.empty || so_far.vain_searches >= PointsOfConstraints::kMostSearches) return false;
  const Level& set = level(model_.constraints);
  RealLevelPoints points(ring_, real_points_, points_);
  if (auto point = points.find(set, expressions, differentiable)) {
    so_far.points.push_back(std::move(*point));
    return true;
  }
  ++so_far.vain_searches;
  if (so_far.points.empty()) {
    auto any = points.find(set, {});
    so_far.empty = !any;
    if (any) so_far.points.push_back(std::move(*any));
  }
  return false;
}

bool Prover::is_nonzero_somewhere_on_constraints(const ex& f) {
  std::vector<ex> expressions = claim_expressions();
  expressions.push_back(GiNaC::pow(f, -1));
  return has_point_of_constraints(expressions, false);
}

bool Prover::is_positive_somewhere_on_constraints(const ex& f) {
  std::vector<ex> expressions = claim_expressions();
  expressions.push_back(GiNaC::pow(f, GiNaC::numeric(-1, 2)));
  return has_point_of_constraints(expressions, false);
}

bool Prover::is_nowhere_zero_on_constraints(const Polynomial& p) {
  return vanishes_nowhere_on(p, level(model_.constraints));
}

/// Whether the domain seems to have a zero of `f`, which has to be solved for a variable to be
/// found: then all that is divided by has another value there, and no algebra can show that `f`
/// vanishes nowhere. Doubles suffice, since nothing is claimed where the answer is true.
bool Prover::seems_to_vanish(const Polynomial& f, Divisors which) {
  constexpr double kRounding = 1e-6;
  const std::size_t symbols = ring_.symbols().size();
  if (ring_.is_complex()) return false;
  std::size_t x = symbols;
  for (std::size_t i = 0; i < ring_.end_of_generators(); ++i) {
    if (i >= symbols && f.uses(i)) return false;
    if (i < symbols && x == symbols && f.degree(i) == 1) x = i;
  }
  if (x == symbols) return false;
  const std::vector<Polynomial> parts = f.coefficients(x);
  if (!parts[1].is_constant()) return false;
  const double slope = cln::double_approx(parts[1].term_list()[0].first);
  const functions::FunctionProbe probes(ring_.table());
  const auto admitted = [&](functions::Probe& at) {
    const auto differs = [&](const Polynomial& d) {
      return std::abs(probes.value_at(at, d)) > kRounding;  // not so where it has no value
    };
    return probes.has_values_at(at) &&
           std::all_of(model_.assumptions.begin(), model_.assumptions.end(),
                       [&](const Assumption& a) {
                         const double d = probes.value_at(at, ring_.convert(a.difference));
                         const int sign = std::abs(d) <= kRounding ? 0 : d > 0 ? 1 : -1;
                         return std::isfinite(d) && holds(a.comparison, sign);
                       }) &&
           std::all_of(explicit_divisors(which).begin(), explicit_divisors(which).end(), differs);
  };
  for (std::size_t k = 0; k < functions::kProbes; ++k) {
    functions::Probe at = probes.probe(k);
    at.coordinates[x] = -probes.value_at(at, parts[0]) / slope;
    at.generators.clear();
    if (admitted(at)) return true;
  }
  return false;
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
  // What has cancelled was divided by, too: by the claim, and by what defines the system.
  for (const ex& expression : claim_) convert(expression);
  for (const ex& expression : lost_of_dynamics(model_, subject_)) convert(expression);
  const std::vector<Polynomial> denominators = ring_.denominators();
  for (std::size_t k = 0; k < divided_by_.size(); ++k) {
    if (divided_by_[k] && !ring_.is_nowhere_zero(denominators[k]))
      proof.nonzero.push_back(ring_.text(denominators[k]));
  }
  say_where_values_are(proof);
}

void Prover::say_where_values_are(Proof& proof) const {
  proof.positive.clear();
  proof.not_zero.clear();
  const functions::Implied implied = ring_.implied_by_values();
  for (const auto& [p, strict] : implied.positive) {
    proof.positive.push_back(ring_.text(p));
    if (strict) proof.not_zero.push_back(proof.positive.back());
  }
  for (const Polynomial& p : implied.nonzero) proof.nonzero.push_back(ring_.text(p));
  // The ring meets them in an order that differs from one process to the next.
  std::sort(proof.nonzero.begin(), proof.nonzero.end());
  proof.nonzero.erase(std::unique(proof.nonzero.begin(), proof.nonzero.end()), proof.nonzero.end());
}

std::string Prover::cofactor_text(const Polynomial& of_numerator, const Polynomial& divisor,
                                  const Level& level, std::size_t i) {
  const auto [top, bottom] = ring_.lowest_terms(convert(level.functions[i]));
  const auto text = [&](const Polynomial& p) { return shortened(ring_.text(p), p.terms()); };
  Polynomial rest(ring_.ring()), above(ring_.ring()), below(ring_.ring());
  std::string name = level.texts[i];
  if (!top.divide(level.numerators[i], &rest)) {
    name = text(level.numerators[i]);
    rest = bottom;
  }
  const Polynomial common = Polynomial::gcd(of_numerator * bottom, rest * divisor);
  (of_numerator * bottom).divide(common, &above);
  (rest * divisor).divide(common, &below);
  const auto grouped = [](const std::string& part, const char* marks) {
    return part.find_first_of(marks) == std::string::npos ? part : "(" + part + ")";
  };
  if (!below.is_constant())
    return fmt::format("{}/{} of {}", grouped(text(above), " "), grouped(text(below), " */-"),
                       name);
  return fmt::format("{} of {}", text(above.scaled(1 / below.term_list()[0].first)), name);
}

}  // namespace casimir
