#include "runtime/precise_run.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "runtime/digits/precise_branch.hpp"
#include "runtime/digits/precise_step.hpp"
#include "runtime/digits/root_zeros.hpp"
#include "runtime/evaluate.hpp"
#include "runtime/every_second.hpp"
#include "runtime/program/angle_branches.hpp"
#include "runtime/program/exact_number.hpp"
#include "runtime/program/interpreter.hpp"
#include "runtime/program/program_series.hpp"
#include "runtime/undefined_motion.hpp"

namespace casimir {
namespace {

constexpr double kLog2Of10 = 3.321928094887362;
constexpr int kGuardDigits = 8;
constexpr double kOrderPerDigit = 1.15;  // ln(10) / 2
constexpr double kSlack = 10;
/// Bits that every coefficient has beyond those that the envelope of terms needs.
constexpr slong kSpareBits = 40;
/// What part of the bits of a step the equations have to confirm, and how often it is halved for
/// that: an error of one step has half of the digits to grow.
constexpr double kFollowed = 0.5, kSmallPart = 0.4, kMostHalvings = 200;
/// A singularity is believed when predictions from different steps and orders agree to all but
/// these digits, ..
constexpr int kUncertainDigits = 8;
/// .. and it is so much nearer than the way made.
constexpr double kNearLog10 = -10;

slong bits_for(int digits) {
  return static_cast<slong>((digits + kGuardDigits) * kLog2Of10 + kSlack);
}

BigFloat value_at(const LongSeries& series, const BigFloat& h) {
  BigFloat value = series.back();
  for (std::size_t k = series.size() - 1; k-- > 0;) value = value * h + series[k];
  return value;
}

/// The derivative of the series.
BigFloat slope_at(const LongSeries& series, const BigFloat& h) {
  BigFloat value;
  for (std::size_t k = series.size() - 1; k > 0; --k)
    value = value * h + BigFloat(cln::cl_I(k)) * series[k];
  return value;
}

double double_of(const BigFloat& value) { return arf_get_d(value.mid(), ARF_RND_NEAR); }

std::vector<double> doubles(const std::vector<BigFloat>& values) {
  std::vector<double> result;
  for (const BigFloat& value : values) result.push_back(double_of(value));
  return result;
}

/// One run; see `precise_run`.
class PreciseRunner {
 public:
  PreciseRunner(const PreciseProblem& problem, int digits)
      : problem_(problem),
        digits_(digits),
        bits_(bits_for(digits)),
        precision_(bits_),
        order_(static_cast<int>(kOrderPerDigit * (digits + kGuardDigits)) + 4),
        format_(cln::float_format(static_cast<uintE>(digits) + kGuardDigits)) {
    const std::size_t states = problem.rhs->outputs.size();
    std::vector<BigFloat> start;
    for (const cln::cl_R& value : problem.start(digits + kGuardDigits)) start.emplace_back(value);
    const auto middle = start.begin() + static_cast<std::ptrdiff_t>(states);
    state_.assign(start.begin(), middle);
    if (problem.from_other_side) move_to_other_side();
    parameters_.assign(middle, start.end() - 1);
    look_.emplace(*problem.rhs, state_, parameters_);
    undefined_.emplace(*problem.rhs);
    roots_.emplace(*problem.rhs, doubles(parameters_));
    end_ = problem.end ? BigFloat(*problem.end) : start.back();
    if (problem.mark) mark_ = BigFloat(*problem.mark);
    run_.digits = digits;
    run_.log2_sizes.assign(states, -std::numeric_limits<double>::infinity());
  }

  PreciseRun operator()() {
    const auto begin = std::chrono::steady_clock::now();
    follow_angles({}, time_);
    follow_invariants();
    record_sizes();
    record_samples({}, time_);
    try {
      look_for_undefined();
      integrate();
    } catch (const std::domain_error& problem) {
      stop(Status::singularity, std::string("the equations have no value here: ") + problem.what());
    } catch (const UnknownBranch&) {
      stop(Status::no_convergence,
           "an argument of |.|, a sign or an angle comes to zero, and whether it passes it cannot "
           "be "
           "told: by which formula the equations go on is not known");
    } catch (const GivenUp&) {
      stop(Status::stopped, reason_of(Status::stopped));
    }
    BigFloat::set_precision(bits_);
    finish();
    run_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return std::move(run_);
  }

 private:
  /// Moves each state that was rounded by its last bit, to beyond its exact value.
  void move_to_other_side() {
    constexpr int kToCompare = 30;
    const Precision precision(bits_for(digits_ + kToCompare));
    const std::vector<cln::cl_R> exact = problem_.start(digits_ + kGuardDigits + kToCompare);
    for (std::size_t i = 0; i < state_.size(); ++i) {
      const int side = (BigFloat(exact[i]) - state_[i]).sign();
      if (side == 0) continue;
      BigFloat last_bit;
      arf_set_si_2exp_si(last_bit.mid(), side, static_cast<slong>(state_[i].log2()) - bits_);
      state_[i] = state_[i] + last_bit;
    }
  }

  void integrate() {
    const Arithmetic<BigFloat> arithmetic{
        .bits = bits_, .order = order_, .spare = kSpareBits, .give_up = [this] {
          return given_up();
        }};
    TaylorJet<BigFloat> jet(*problem_.rhs, arithmetic, parameters_, order_);
    const Envelope envelope{.bits = static_cast<double>(bits_), .slack = kSlack};
    while (!(time_ == end_) && may_step()) {
      const std::vector<LongSeries>& series = jet.expand(time_, state_);
      BigFloat::set_precision(bits_);
      const double step = log2_step(series, jet.singular_series(), envelope);
      if (std::isnan(step)) return stop(Status::non_finite, reason_of(Status::non_finite));
      if (meets_singularity(series, step)) return;
      advance(series, step);
    }
  }

  bool given_up() const {
    return problem_.give_up && problem_.give_up(std::exp2(time_.log2() - end_.log2()));
  }

  bool may_step() {
    if (problem_.max_steps > 0 && run_.steps == problem_.max_steps) {
      stop(Status::max_steps, reason_of(Status::max_steps));
    } else if (given_up()) {
      stop(Status::stopped, reason_of(Status::stopped));
    }
    return run_.status == Status::ok;
  }

  void stop(Status status, std::string reason) {
    run_.status = status;
    run_.reason = std::move(reason);
  }

  /// Whether the solution ends on this side of the end of the run.
  bool meets_singularity(const std::vector<LongSeries>& series, double step) {
    const double resolution = (digits_ - kUncertainDigits) * kLog2Of10;
    const std::optional<Singularity> singularity = nearest_singularity(series);
    std::optional<BigFloat> predicted;
    if (singularity && singularity->distance.sign() == end_.sign()) {
      const BigFloat place = time_ + singularity->distance;
      const bool before_the_end = singularity->distance.log2() < (end_ - time_).log2();
      if (before_the_end && singularity->log2_spread < place.log2() - resolution) predicted = place;
    }
    // A step that does not move the time: the disk of convergence has closed, whatever the reason.
    const bool closed =
        run_.steps > 0 && step < time_.log2() - resolution - kGuardDigits * kLog2Of10;
    const bool near = predicted && singularity->distance.log2() < predicted->log2() + kNearLog10;
    const bool again = predicted && predicted_ &&
                       (*predicted - *predicted_).log2() < predicted->log2() - resolution;
    predicted_ = predicted;
    if (!closed && !(near && again)) return false;
    run_.singular_time = to_cln(predicted ? *predicted : time_, format_);
    stop(Status::singularity,
         "the solution has a singularity, or one within rounding of real times: it grows without "
         "bound, or comes to a place at which the "
         "equations have a pole or are not smooth");
    return true;
  }

  void advance(const std::vector<LongSeries>& series, double log2_size) {
    const BigFloat left = end_ - time_;
    bool last = log2_size >= left.log2();
    BigFloat h = left;
    if (!last) {
      // A short number: the times of steps stay short as well, and exact.
      const double whole = std::floor(log2_size);
      const double digits = std::floor(std::exp2(log2_size - whole) * 0x1p16) * 0x1p-16;
      arf_set_d(h.mid(), end_.sign() < 0 ? -digits : digits);
      arf_mul_2exp_si(h.mid(), h.mid(), static_cast<slong>(whole));
    }
    const double least = h.log2() - kMostHalvings;
    largest_tried_ = -std::numeric_limits<double>::infinity();
    for (bool taken = false; !taken;) {
      const BigFloat tried = h;
      h = look_->size({time_, tried, [&](const BigFloat& after) {
                         std::vector<BigFloat> state;
                         for (const LongSeries& s : series) state.push_back(value_at(s, after));
                         return state;
                       }});
      if (h.sign() == 0)  // the run chatters about a jump
        return stop(Status::step_underflow, reason_of(Status::step_underflow));
      taken = h == tried;
      if (taken && !follows(series, h)) {
        h = tried * half_;
        taken = false;
        if (h.log2() < least)
          return stop(Status::no_convergence, reason_of(Status::no_convergence));
      }
      last = last && h == tried;
    }
    if (const auto shorter = up_to_zero_of_root(series, h)) {
      h = *shorter;
      last = false;
      if (h.is_zero()) return;
    }
    const BigFloat next = last ? end_ : time_ + h;
    record_samples(series, next);
    if (mark_ && !passed(time_, *mark_) && !passed(*mark_, next))
      run_.at_mark = rounded(at(series, *mark_));
    record_places(series, next);
    for (std::size_t i = 0; i < state_.size(); ++i) state_[i] = value_at(series[i], h);
    follow_angles(series, next);
    time_ = next;
    ++run_.steps;
    record_way();
    look_for_undefined();
    record_sizes();
    follow_invariants();
  }

  /// Ends the run where it stays at a jump.
  void look_for_undefined() {
    if (!undefined_->looks()) return;
    std::vector<BigFloat> inputs = state_;
    inputs.insert(inputs.end(), parameters_.begin(), parameters_.end());
    inputs.push_back(time_);
    std::vector<bool> zero;
    for (const BigFloat& value : evaluate(undefined_->arguments(), inputs))
      zero.push_back(value.is_zero());
    std::vector<double> now = doubles(inputs);
    bool stays = false;
    for (std::size_t k = 0; k < zero_.size(); ++k) stays = stays || (zero[k] && zero_[k]);
    const std::string why = stays ? undefined_->why(Status::ok, before_, now) : "";
    if (!why.empty()) stop(Status::at_jump, why);
    before_ = std::move(now);
    zero_ = std::move(zero);
  }

  /// Ends the run before a place in this step behind which the motion need not be the only one.
  /// \return  the step up to there; nothing where there is no such place
  std::optional<BigFloat> up_to_zero_of_root(const std::vector<LongSeries>& series,
                                             const BigFloat& h) {
    if (!roots_->any()) return std::nullopt;
    const auto scaled = [](const BigFloat& size, double part) {
      BigFloat factor;
      arf_set_d(factor.mid(), part);
      return size * factor;
    };
    const auto zero = roots_->zero_in([&](double part, double* x) {
      const BigFloat after = scaled(h, part);
      for (const LongSeries& s : series) *x++ = double_of(value_at(s, after));
      return double_of(time_ + after);
    });
    if (!zero) return std::nullopt;
    const BigFloat place = scaled(h, *zero);
    stop(Status::singularity,
         "what a root is taken of comes to zero next, where the equations are not Lipschitz "
         "continuous: more than one solution may go on from there");
    // A run that is compared with one from the other side goes a little farther than that.
    constexpr double kBefore = 0x1p-20;
    const BigFloat shorter = place - scaled(end_, problem_.from_other_side ? 2 * kBefore : kBefore);
    return shorter.sign() * h.sign() > 0 ? shorter : BigFloat();
  }

  /// Whether the series has the derivative that the equations ask for: at the end of the step, and
  /// at a place within it that is another one each time. Coefficients that are zero up to the last
  /// do not say what follows them.
  bool follows(const std::vector<LongSeries>& series, const BigFloat& h) {
    constexpr double kGoldenSection = 0.6180339887498949;
    place_ += kGoldenSection;
    if (place_ >= 1) place_ -= 1;
    BigFloat within;
    arf_set_d(within.mid(), place_);
    return follows_at(series, h * within) && (look_->ends_behind_jump() || follows_at(series, h));
  }

  bool follows_at(const std::vector<LongSeries>& series, const BigFloat& h) {
    std::vector<BigFloat> inputs;
    for (const LongSeries& s : series) inputs.push_back(value_at(s, h));
    inputs.insert(inputs.end(), parameters_.begin(), parameters_.end());
    inputs.push_back(time_ + h);
    std::vector<BigFloat> rates;
    try {
      rates = evaluate(*problem_.rhs, inputs);
    } catch (const std::domain_error&) {
      return true;  // the next step has something to say of that
    }
    const auto bits = static_cast<double>(bits_);
    std::vector<double> sizes;
    for (std::size_t i = 0; i < rates.size(); ++i)
      sizes.push_back(std::max({state_[i].log2(), inputs[i].log2(), (rates[i] * h).log2()}));
    // What is that far below the others may be their rounding; and where a state rests at zero, it
    // is nothing beside what it comes to in the steps that were too long.
    largest_tried_ = std::max(largest_tried_, *std::ranges::max_element(sizes));
    const double least = largest_tried_ - kSmallPart * bits;
    for (std::size_t i = 0; i < rates.size(); ++i) {
      const double off = ((rates[i] - slope_at(series[i], h)) * h).log2();
      if (off > std::max(sizes[i], least) - kFollowed * bits) return false;
    }
    return true;
  }

  /// Whether a is beyond b in the direction of the run.
  bool passed(const BigFloat& a, const BigFloat& b) const {
    return end_.sign() < 0 ? a < b : b < a;
  }

  std::vector<BigFloat> at(const std::vector<LongSeries>& series, const BigFloat& time) const {
    std::vector<BigFloat> state;
    for (const LongSeries& s : series) state.push_back(value_at(s, time - time_));
    return state;
  }

  std::vector<cln::cl_F> rounded(const std::vector<BigFloat>& values) const {
    std::vector<cln::cl_F> result;
    for (const BigFloat& value : values) result.push_back(to_cln(value, format_));
    return result;
  }

  void record_sizes() {
    for (std::size_t i = 0; i < state_.size(); ++i)
      run_.log2_sizes[i] = std::max(run_.log2_sizes[i], state_[i].log2());
  }

  /// The state at the end of every step, or of every second, fourth, .. in longer runs.
  void record_way() {
    if (!problem_.keep_way || run_.steps % way_stride_ != 0) return;
    constexpr std::size_t kMost = 4096, kLeast = 128, kBytes = std::size_t{1} << 25, kOfNumber = 32;
    const std::size_t bytes = state_.size() * (static_cast<std::size_t>(bits_) / 8 + kOfNumber);
    if (run_.way.size() >= std::clamp(kBytes / bytes, kLeast, kMost)) {
      keep_every_second(run_.way_times);
      keep_every_second(run_.way);
      way_stride_ *= 2;
      if (run_.steps % way_stride_ != 0) return;
    }
    run_.way_times.push_back(to_cln(time_, format_));
    run_.way.push_back(rounded(state_));
  }

  /// The states at the places in a step that ends at the time `next`.
  void record_places(const std::vector<LongSeries>& series, const BigFloat& next) {
    while (run_.way.size() < problem_.places.size()) {
      const cln::cl_F& place = problem_.places[run_.way.size()];
      const BigFloat time(place);
      if (passed(time, next)) return;
      run_.way_times.push_back(place);
      run_.way.push_back(rounded(at(series, time)));
    }
  }

  /// The samples up to the next time; at the start the state itself.
  void record_samples(const std::vector<LongSeries>& series, const BigFloat& next) {
    if (!cln::plusp(problem_.sample_every)) return;
    for (;; ++sample_) {
      const BigFloat time(end_.sign() < 0 ? -problem_.sample_every * sample_
                                          : problem_.sample_every * sample_);
      if (passed(time, next) || (sample_ > 0 && !passed(end_, time))) return;
      run_.sample_times.push_back(to_cln(time, format_));
      run_.samples.push_back(rounded(series.empty() ? state_ : at(series, time)));
      if (series.empty() && next.is_zero()) {
        ++sample_;
        return;
      }
    }
  }

  /// The angles of the invariants in double: where they are to a few digits tells their branches.
  /// \param series  empty: at the start; else of a step that ends at the time `next`
  void follow_angles(const std::vector<LongSeries>& series, const BigFloat& next) {
    if (problem_.invariants == nullptr || (!series.empty() && !angles_)) return;
    const std::vector<double> x = doubles(state_);
    if (angles_)
      return angles_->advance(double_of(next), x.data(), [&](double t, double* between) {
        std::ranges::copy(doubles(at(series, BigFloat(exact_number(t)))), between);
      });
    angles_.emplace(
        *problem_.invariants, doubles(parameters_),
        [this, rhs = Interpreter(*problem_.rhs), inputs = std::vector<double>()](
            double t, const double* at, double* rates) mutable {
          inputs.assign(at, at + state_.size());
          for (const BigFloat& p : parameters_) inputs.push_back(double_of(p));
          inputs.push_back(t);
          rhs(inputs.data(), rates);
        },
        0, x);
    if (!angles_->follows()) angles_.reset();
  }

  void follow_invariants() {
    if (problem_.invariants == nullptr) return;
    std::vector<BigFloat> inputs = state_;
    inputs.insert(inputs.end(), parameters_.begin(), parameters_.end());
    inputs.push_back(time_);
    final_ = angles_ ? evaluate_on_branches(*problem_.invariants, inputs, angles_->angles(),
                                            [this](std::size_t k, const BigFloat& principal) {
                                              return angles_->half_turns(k, double_of(principal));
                                            })
                     : evaluate(*problem_.invariants, inputs, Arithmetic<BigFloat>{});
    if (initial_.empty()) {
      initial_ = final_;
      changes_.resize(initial_.size());
    }
    for (std::size_t i = 0; i < final_.size(); ++i) {
      BigFloat change = final_[i] - initial_[i];
      if (change.sign() < 0) change = -change;
      if (changes_[i] < change) changes_[i] = std::move(change);
    }
  }

  void finish() {
    run_.time = to_cln(time_, format_);
    run_.state = rounded(state_);
    if (mark_ && time_ == *mark_) run_.at_mark = run_.state;
    if (cln::plusp(problem_.sample_every) && run_.sample_times.back() != run_.time) {
      run_.sample_times.push_back(run_.time);
      run_.samples.push_back(run_.state);
    }
    for (std::size_t i = 0; i < initial_.size(); ++i)
      run_.invariants.push_back(
          {to_cln(initial_[i], format_), to_cln(final_[i], format_), to_cln(changes_[i], format_)});
  }

  const PreciseProblem& problem_;
  int digits_;
  slong bits_;
  Precision precision_;
  int order_;
  cln::float_format_t format_;
  std::vector<BigFloat> state_, parameters_, initial_, final_, changes_;
  std::optional<PreciseLook> look_;
  std::optional<UndefinedMotion> undefined_;
  std::vector<double> before_;  ///< what it saw last, beside ..
  std::vector<bool> zero_;      ///< .. which arguments were 0 to all digits
  std::optional<RootZeros> roots_;
  std::optional<AngleFollower> angles_;  ///< of the invariants, if they have any
  BigFloat time_, end_;
  std::optional<BigFloat> mark_, predicted_;
  const BigFloat half_{cln::cl_RA(1) / 2};
  double place_ = 0.5;        ///< within a step, where it was looked at last
  double largest_tried_ = 0;  ///< log2 of the largest state within any trial of a step
  cln::cl_I sample_ = 0;
  unsigned long long way_stride_ = 1;
  PreciseRun run_;
};

}  // namespace

PreciseRun precise_run(const PreciseProblem& problem, int digits) {
  return PreciseRunner(problem, digits)();
}

double precise_run_bytes(const PreciseProblem& problem, int digits) {
  // Functions have two more series each; coefficients have half of the bits on the average.
  constexpr double kSeriesOfLine = 1.5, kPart = 0.5, kBitsOfByte = 8;
  const auto lines = static_cast<double>(problem.rhs->code.size());
  const double coefficient =
      sizeof(BigFloat) + kPart * static_cast<double>(bits_for(digits)) / kBitsOfByte;
  return kSeriesOfLine * lines * kOrderPerDigit * digits * coefficient;
}

}  // namespace casimir
