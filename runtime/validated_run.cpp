#include "runtime/validated_run.hpp"

#include <cln/integer_io.h>

#include <chrono>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "runtime/certificate/hex_float.hpp"
#include "runtime/program/exact_number.hpp"
#include "runtime/trace_check.hpp"
#include "runtime/validated/crossings.hpp"
#include "runtime/validated/lohner.hpp"
#include "runtime/validated/rational_ends.hpp"

namespace casimir {
namespace {

using validated::ArbBall;
using validated::BallPrecision;
using validated::Lohner;
using validated::MidRad;
using validated::StepOutcome;
using validated::StepSettings;

constexpr double kBitsPerDigit = 3.321928094887362;
constexpr int kDoubleOrder = 22, kGuardBits = 24;
/// Bits of the exact data beyond those of the balls.
constexpr slong kDataBits = 128;
/// A step has to be so much of the time that it leads to, so that the times are short numbers.
constexpr int kTimeBits = 44;
/// The logarithm of the least positive double: shorter steps are none.
constexpr double kLeastStep = -1074;
/// The time may grow by such a factor in a step: its bits fit a double then.
constexpr double kGrowth = 100;

slong bits_of(const ValidatedSettings& settings) {
  return settings.digits == 0 ? 53
                              : static_cast<slong>(settings.digits * kBitsPerDigit) + kGuardBits;
}

StepSettings step_settings(const ValidatedSettings& settings, bool forwards) {
  StepSettings result;
  const slong bits = bits_of(settings);
  result.order = settings.order > 0     ? settings.order
                 : settings.digits == 0 ? kDoubleOrder
                                        : static_cast<int>(0.35 * static_cast<double>(bits)) + 4;
  result.log2_error = settings.digits == 0 ? -53 : -static_cast<int>(bits) - 4;
  if (settings.log2_error < 0) result.log2_error = settings.log2_error;
  result.integral_bits = bits + 80;
  result.forwards = forwards;
  result.without_remainder = settings.without_remainder;
  result.with_reserve = settings.trace != nullptr;
  result.derivatives = settings.derivatives;
  return result;
}

void check(const ValidatedProblem& problem) {
  const std::size_t n = problem.rates.outputs.size();
  const bool fits = problem.rates.inputs.size() == n + 1 && problem.start.outputs.size() == n + 1 &&
                    problem.jacobian.outputs.size() == problem.entries.size() &&
                    (problem.radii.empty() || problem.radii.size() == n);
  if (!fits) throw std::invalid_argument("the parts of the problem have different states");
}

/// The last output of a program without inputs, where it is rational.
std::optional<cln::cl_RA> rational_end(const Program& program) {
  std::vector<bool> needed(program.code.size());
  needed[static_cast<std::size_t>(program.outputs.back())] = true;
  for (std::size_t i = program.code.size(); i-- > 0;) {
    const Instruction& line = program.code[i];
    if (!needed[i] || is_literal(line)) continue;
    for (const int operand : {line.a, line.b})
      if (operand >= 0) needed[static_cast<std::size_t>(operand)] = true;
  }
  const Arithmetic<cln::cl_RA> exact;
  std::vector<cln::cl_RA> values(program.code.size());
  const auto at = [&](int i) { return values[static_cast<std::size_t>(i)]; };
  try {
    for (std::size_t i = 0; i < program.code.size(); ++i) {
      const Instruction& line = program.code[i];
      if (!needed[i]) continue;
      values[i] = is_literal(line)
                      ? literal_value(program, line, exact)
                      : applied(line.op, at(line.a), at(line.b < 0 ? line.a : line.b), exact);
    }
  } catch (const std::domain_error&) {
    return std::nullopt;
  }
  return at(program.outputs.back());
}

/// One run with balls of one kind.
template <class Ball>
class Runner {
 public:
  /// \param start  the states and the duration, exactly.
  Runner(const ValidatedProblem& problem, const ValidatedSettings& settings,
         std::vector<ArbBall> start)
      : settings_(settings),
        forwards_(arb_is_negative(start.back().raw()) == 0),
        precision_(bits_of(settings)),
        flow_(validated::joined(problem.rates, problem.jacobian, problem.entries)),
        integrals_(integrals_of(problem)),
        order_(step_settings(settings, forwards_).order),
        lohner_(flow_, integrals_, step_settings(settings, forwards_)) {
    end_exact_ = forwards_ ? start.back() : -start.back();
    if (const auto rational = rational_end(problem.start)) {
      end_time_ = forwards_ ? *rational : -*rational;
    } else {
      const RationalInterval ends = validated::ends_of(end_exact_);
      end_time_ = (ends.low + ends.high) / 2;
    }
    start.pop_back();
    std::vector<Ball> wide(start.size());
    for (std::size_t i = 0; i < problem.radii.size(); ++i)
      wide[i] = validated::symmetric(Arithmetic<Ball>::from(problem.radii[i]));
    end_ = validated::ball_from<Ball>(end_exact_);
    lohner_.begin(start, wide);
    if (!problem.plane.outputs.empty()) {
      crossings_.emplace(problem.plane, forwards_, settings.without_monotony);
      crossings_->begin(lohner_.box());
    }
    if (settings.trace) trace_start(*settings.trace, bits_of(settings));
  }

  ValidatedRun operator()() {
    const auto begin = std::chrono::steady_clock::now();
    try {
      record_start();
      if (arb_is_zero(end_exact_.raw()) != 0) rest();
      while (run_.status == ValidatedStatus::ok && !done_) step();
    } catch (const std::domain_error& problem) {
      stop(ValidatedStatus::no_enclosure,
           std::string("the equations are not certain to have a value: ") + problem.what());
    }
    finish();
    run_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return std::move(run_);
  }

 private:
  static std::vector<validated::Integral> integrals_of(const ValidatedProblem& problem) {
    std::vector<validated::Integral> result;
    for (const KnownIntegral& known : problem.integrals)
      result.push_back({known.name, known.value, known.gradient, known.states});
    return result;
  }

  void stop(ValidatedStatus status, std::string reason) {
    run_.status = status;
    run_.reason = std::move(reason);
  }

  /// The end of a run of no duration: it is the start.
  void rest() {
    done_ = true;
    if (crossings_ && !crossings_->finish(lohner_.box(), end_)) touches();
  }

  bool may_step() {
    const double share = elapsed_ / std::abs(approximate(end_));
    if (settings_.max_steps > 0 && run_.steps == settings_.max_steps)
      stop(ValidatedStatus::max_steps, "the number of steps has reached its limit");
    else if (settings_.give_up && settings_.give_up(share))
      stop(ValidatedStatus::stopped, "the run was stopped");
    return run_.status == ValidatedStatus::ok;
  }

  /// A time after t of few bits, as near to t + 2^log2_h as these allow; the step to it is a
  /// double.
  double next_time(double log2_h) const {
    double h = std::exp2(log2_h);
    if (elapsed_ > 0) h = std::min(h, kGrowth * elapsed_);
    int exponent = 0;
    std::frexp(elapsed_ + h, &exponent);
    return std::ldexp(std::floor(std::ldexp(elapsed_ + h, kTimeBits - exponent)),
                      exponent - kTimeBits);
  }

  void step() {
    if (!may_step()) return;
    const Ball elapsed(elapsed_);
    const Ball left = end_ - elapsed;
    double log2_h = lohner_.prepare(elapsed);
    const double log2_left = validated::log2_magnitude(left);
    bool full = true;
    for (;;) {
      if (std::isnan(log2_h))
        return stop(ValidatedStatus::no_enclosure, "the numbers have become too large");
      const bool last = log2_h >= log2_left || next_time(log2_h) >= approximate(end_);
      const double next = last ? 0 : next_time(log2_h);
      if (last ? log2_h < kLeastStep : !(next > elapsed_))
        return stop(ValidatedStatus::no_enclosure, "no step of any length can be enclosed");
      const Ball h = last ? left : Ball(next - elapsed_);
      const double by = lohner_.shortened_by(h, full && !last);
      if (by == 0) return advance(h, last, next);
      ++run_.rejected;
      full = false;
      log2_h = std::min(log2_h, log2_left) - by;
      if (!may_step()) return;
    }
  }

  void advance(const Ball& h, bool last, double next) {
    record_samples(last, next);
    if (crossings_ && !crossings_->step(lohner_, Ball(elapsed_), h)) return touches();
    const StepOutcome outcome = lohner_.advance(h);
    if (outcome == StepOutcome::contradiction)
      return stop(ValidatedStatus::contradiction,
                  "an integral has another value in all of the box: it is not constant");
    if (outcome != StepOutcome::taken)
      return stop(ValidatedStatus::no_enclosure, "the box has become too wide");
    ++run_.steps;
    if (settings_.trace) trace_step(*settings_.trace, h);
    elapsed_ = last ? elapsed_ : next;
    done_ = last;
    if (done_ && crossings_ && !crossings_->finish(lohner_.box(), end_)) return touches();
    if (!done_ && too_wide())
      stop(ValidatedStatus::no_enclosure, "the box has become as wide as the state is large");
  }

  void touches() {
    done_ = false;
    stop(ValidatedStatus::touching, "the solution may touch the surface without crossing it");
  }

  void record_crossings() {
    run_.starts_on_plane = crossings_->starts_on_plane();
    run_.crossings_until = run_.end.time;
    if (run_.status != ValidatedStatus::ok) {
      const auto until = validated::ends_of(ArbBall(crossings_->settled_until(Ball(elapsed_))));
      const cln::cl_RA first = cln::plusp(until.low) ? until.low : cln::cl_RA(0);
      run_.crossings_until = forwards_ ? first : -first;
    }
    for (const validated::Passage<Ball>& passage : crossings_->found()) {
      ValidatedCrossing crossing;
      crossing.time = validated::ends_of(ArbBall(forwards_ ? passage.time : -passage.time));
      for (const Ball& x : passage.states)
        crossing.states.push_back(validated::ends_of(ArbBall(x)));
      crossing.upwards = passage.upwards == forwards_;
      run_.crossings.push_back(std::move(crossing));
    }
  }

  void trace_start(RunTrace& trace, long bits) const {
    const validated::Doubleton<Ball>& set = lohner_.set();
    trace = {};
    trace.order = order_;
    trace.bits = bits;
    for (const Ball& m : set.middle) trace.middle.push_back(certificate::middle_text(ArbBall(m)));
    for (const Ball& s : set.start.empty() ? set.rest : set.start)
      trace.off.push_back(certificate::size_text(ArbBall(s)));
  }

  void trace_step(RunTrace& trace, const Ball& length) const {
    const validated::Doubleton<Ball>& set = lohner_.set();
    TracedStep& step = trace.steps.emplace_back();
    step.length = certificate::middle_text(ArbBall(length));
    step.room = lohner_.room();
    step.columns = lohner_.columns();
    const auto exact = [](const auto& number) { return certificate::middle_text(ArbBall(number)); };
    for (const Ball& m : set.middle) step.after.middle.push_back(exact(m));
    for (const Ball& c : set.carried.entries) step.after.carried.push_back(exact(c));
    for (const double b : set.frame.columns.entries) step.after.frame.push_back(exact(b));
    for (const Ball& r : set.rest) step.after.rest.push_back(certificate::size_text(ArbBall(r)));
  }

  /// A box as large as all that the state has been is no statement.
  bool too_wide() {
    double widest = 0;
    for (const Ball& x : lohner_.box()) {
      widest = std::max(widest, validated::radius_of(x));
      largest_ = std::max(largest_, std::abs(approximate(x)));
    }
    return !(widest <= largest_ || widest == 0);
  }

  StateBox box_of(const std::vector<Ball>& box, const cln::cl_RA& time) const {
    StateBox result{forwards_ ? time : -time, {}};
    for (const Ball& x : box) result.states.push_back(validated::ends_of(ArbBall(x)));
    return result;
  }

  void record_start() {
    too_wide();
    if (!cln::plusp(settings_.sample_every)) return;
    run_.samples.push_back(box_of(lohner_.box(), 0));
    sample_ = 1;
  }

  /// Boxes at the samples within the step, and before the end.
  void record_samples(bool last, double next) {
    if (!cln::plusp(settings_.sample_every)) return;
    const cln::cl_RA from = exact_number(elapsed_);
    // An irrational end is only known to be in a ball, but the step was enclosed for all of it.
    const cln::cl_RA to = last ? end_time_ : exact_number(next);
    for (;; ++sample_) {
      const cln::cl_RA time = settings_.sample_every * sample_;
      if (time > to || (last && time == to)) return;
      const Ball after = Arithmetic<Ball>::from(time - from);
      run_.samples.push_back(box_of(lohner_.box_at(after), time));
    }
  }

  void finish() {
    cln::cl_RA time = exact_number(elapsed_);
    if (done_) time = end_time_;
    run_.end = box_of(lohner_.box(), time);
    if (cln::plusp(settings_.sample_every) && !run_.samples.empty() &&
        (run_.samples.back().time != run_.end.time))
      run_.samples.push_back(run_.end);
    run_.contracted_by = lohner_.contracted_by();
    if (settings_.derivatives && run_.status == ValidatedStatus::ok)
      for (const Ball& entry : lohner_.derivatives().entries)
        run_.derivatives.push_back(validated::ends_of(ArbBall(entry)));
    if (crossings_) record_crossings();
  }

  const ValidatedSettings& settings_;
  bool forwards_;
  BallPrecision precision_;
  validated::FlowProgram flow_;
  std::vector<validated::Integral> integrals_;
  int order_;
  Lohner<Ball> lohner_;
  std::optional<validated::Crossings<Ball>> crossings_;
  ArbBall end_exact_;
  cln::cl_RA end_time_;  ///< the same, where it is rational
  Ball end_;
  double elapsed_ = 0;  ///< since the start, exactly
  double largest_ = 0;
  bool done_ = false;
  cln::cl_I sample_ = 0;
  ValidatedRun run_;
};

}  // namespace

double ValidatedRun::radius() const {
  double largest = 0;
  for (const RationalInterval& x : end.states)
    largest = std::max(largest, cln::double_approx((x.high - x.low) / 2));
  return largest;
}

ValidatedRun validated_run(const ValidatedProblem& problem, const ValidatedSettings& settings) {
  check(problem);
  std::vector<ArbBall> start;
  {
    const BallPrecision exact(bits_of(settings) + kDataBits);
    start = evaluate(problem.start, std::vector<ArbBall>{});
  }
  ValidatedRun run = settings.digits == 0 ? Runner<MidRad>(problem, settings, std::move(start))()
                                          : Runner<ArbBall>(problem, settings, std::move(start))();
  if (settings.trace && run.status == ValidatedStatus::ok)
    settings.trace->end = end_of(problem, *settings.trace);
  return run;
}

}  // namespace casimir
