#include "runtime/trace_check.hpp"

#include <algorithm>
#include <stdexcept>

#include "runtime/certificate/hex_float.hpp"
#include "runtime/certificate/step_check.hpp"
#include "runtime/validated/rational_ends.hpp"

namespace casimir {
namespace {

using certificate::ArbBall;
using certificate::BallMatrix;
using certificate::BallSet;
using certificate::LevelBound;
using certificate::StepCheck;
using certificate::Vector;
using validated::BallPrecision;

/// Beyond the bits of the run: of the sets, and of exact data and levels.
constexpr slong kMoreBits = 11, kExactBits = 128;

bool is_wide(const ValidatedProblem& problem) {
  return std::ranges::any_of(problem.radii, [](const cln::cl_RA& r) { return !cln::zerop(r); });
}

bool set_fits(const TracedSet& set, std::size_t n, bool wide) {
  return set.middle.size() == n && set.frame.size() == n * n && set.rest.size() == n &&
         set.carried.size() == (wide ? n * n : 0);
}

/// Whether all lists have the lengths that they need.
bool has_shape(const ValidatedProblem& problem, const RunTrace& trace) {
  constexpr int kMostOrder = 2000, kMostRoom = 100000;
  constexpr long kMostBits = 20000;
  const std::size_t n = problem.rates.outputs.size();
  const auto whole = static_cast<int>(n);
  if (trace.order < 1 || trace.order > kMostOrder || trace.bits < 1 || trace.bits > kMostBits ||
      trace.middle.size() != n || trace.off.size() != n || trace.end.size() != n ||
      trace.steps.empty())
    return false;
  return std::ranges::all_of(trace.steps, [&](const TracedStep& step) {
    return set_fits(step.after, n, is_wide(problem)) && std::abs(step.room) <= kMostRoom &&
           step.columns.size() == problem.integrals.size() &&
           std::ranges::all_of(step.columns, [&](int c) { return c >= -1 && c < whole; });
  });
}

class Checker {
 public:
  Checker(const ValidatedProblem& problem, const RunTrace& trace)
      : problem_(problem),
        trace_(trace),
        wide_(is_wide(problem)),
        precision_(trace.bits + kMoreBits),
        flow_(validated::joined(problem.rates, problem.jacobian, problem.entries)) {
    {
      const BallPrecision exact(trace.bits + kExactBits);
      start_ = evaluate(problem.start, std::vector<ArbBall>{});
    }
    duration_ = start_.back();
    start_.pop_back();
    forwards_ = arb_is_negative(duration_.raw()) == 0;
    if (!forwards_) duration_ = -duration_;
    bounds_.reserve(problem.integrals.size());
    for (const KnownIntegral& integral : problem.integrals)
      bounds_.emplace_back(integral, trace.bits + kExactBits);
  }

  TraceCheck operator()(const TraceCheckSettings& settings) {
    TraceCheck result;
    BallSet set = certificate::first_set(trace_, wide_);
    if (!starts_in()) result.fault = TraceFault::start;
    for (LevelBound& bound : bounds_) bound.begin(start_, set, wide_);
    StepCheck check(flow_, bounds_, trace_.order, trace_.bits + kMoreBits, forwards_,
                    settings.derivatives);
    std::vector<validated::BallFunction<ArbBall>> smooth;
    for (const Program& function : settings.smooth) smooth.emplace_back(function);
    ArbBall elapsed;
    BallMatrix total;
    for (std::size_t k = 0; k < trace_.steps.size() && result.fault == TraceFault::none; ++k) {
      result.step = k + 1;
      if (settings.give_up && settings.give_up()) {
        result.fault = TraceFault::stopped;
        break;
      }
      const TracedStep& step = trace_.steps[k];
      const bool last = k + 1 == trace_.steps.size();
      ArbBall length;
      if (!length_of(step, last, elapsed, length)) {
        result.fault = TraceFault::time;
        break;
      }
      BallSet after = certificate::set_of(step.after, set.start);
      const certificate::StepClaim claim{set, after, elapsed, length, step.room, step.columns};
      result.fault = check(claim);
      for (auto& function : smooth)
        if (result.fault == TraceFault::none && !check.is_analytic(function, claim))
          result.fault = TraceFault::not_smooth;
      if (result.fault == TraceFault::none && settings.derivatives)
        total = k == 0 ? check.derivatives() : validated::product(check.derivatives(), total);
      set = std::move(after);
      arb_add(elapsed.raw(), elapsed.raw(), length.raw(), ARF_PREC_EXACT);
    }
    if (result.fault == TraceFault::none) finish(result, set, total);
    return result;
  }

  /// The set that the last step ends in.
  BallSet last_set() const {
    return certificate::set_of(trace_.steps.back().after,
                               certificate::first_set(trace_, wide_).start);
  }

 private:
  /// Each start of the problem is in the first set.
  bool starts_in() const {
    const BallPrecision exact(trace_.bits + kExactBits);
    for (std::size_t i = 0; i < start_.size(); ++i) {
      ArbBall by = start_[i] - certificate::number_of(trace_.middle[i]);
      arb_abs(by.raw(), by.raw());
      if (wide_) by = by + Arithmetic<ArbBall>::from(problem_.radii[i]);
      const ArbBall off = certificate::number_of(trace_.off[i]);
      if (arb_le(by.raw(), off.raw()) == 0) return false;
    }
    return true;
  }

  /// The last step takes what is left of the duration, which its length has to be near to.
  bool length_of(const TracedStep& step, bool last, const ArbBall& elapsed, ArbBall& length) const {
    length = certificate::number_of(step.length);
    if (!last) return arb_is_positive(length.raw()) != 0;
    const BallPrecision exact(trace_.bits + kExactBits);
    const ArbBall left = duration_ - elapsed;
    // An interval around zero would make the step one in both directions.
    if (arb_is_nonnegative(left.raw()) == 0) return false;
    constexpr slong kNear = -40;
    ArbBall off = left - length, most = duration_;
    arb_abs(off.raw(), off.raw());
    arb_mul_2exp_si(most.raw(), most.raw(), kNear);
    length = left;
    return arb_le(off.raw(), most.raw()) != 0;
  }

  void finish(TraceCheck& result, const BallSet& set, const BallMatrix& total) const {
    const auto inner = certificate::exact_box(set);
    for (std::size_t i = 0; i < inner.size(); ++i) {
      ArbBall low = certificate::number_of(trace_.end[i][0]);
      ArbBall high = certificate::number_of(trace_.end[i][1]);
      const ArbBall least = certificate::number_of(inner[i][0]);
      const ArbBall most = certificate::number_of(inner[i][1]);
      if (arb_le(low.raw(), least.raw()) == 0 || arb_ge(high.raw(), most.raw()) == 0) {
        result.fault = TraceFault::end;
        return;
      }
      result.end.push_back({validated::ends_of(low).low, validated::ends_of(high).high});
    }
    for (const LevelBound& bound : bounds_)
      if (bound.has_bounded()) result.used.push_back(bound.name());
    for (const ArbBall& entry : total.entries)
      result.derivatives.push_back(validated::ends_of(entry));
  }

  const ValidatedProblem& problem_;
  const RunTrace& trace_;
  bool wide_, forwards_ = true;
  BallPrecision precision_;
  validated::FlowProgram flow_;
  Vector start_;
  ArbBall duration_;
  std::vector<LevelBound> bounds_;
};

TraceCheck faulty(TraceFault fault) {
  TraceCheck result;
  result.fault = fault;
  return result;
}

}  // namespace

TraceCheck check_trace(const ValidatedProblem& problem, const RunTrace& trace,
                       const TraceCheckSettings& settings) {
  if (!has_shape(problem, trace)) return faulty(TraceFault::shape);
  try {
    return Checker(problem, trace)(settings);
  } catch (const std::domain_error&) {
    return faulty(TraceFault::no_value);
  }
}

std::vector<std::array<std::string, 2>> end_of(const ValidatedProblem& problem,
                                               const RunTrace& trace) {
  return certificate::exact_box(Checker(problem, trace).last_set());
}

}  // namespace casimir
