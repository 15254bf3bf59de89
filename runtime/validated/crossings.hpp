#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "runtime/validated/lohner.hpp"

namespace casimir::validated {

/// Where solutions of a set pass a zero of a function s of the state and the time, each exactly
/// once.
template <class Ball>
struct Passage {
  Ball time;                 ///< elapsed since the start
  std::vector<Ball> states;  ///< in that time
  bool upwards = true;       ///< s goes from negative to positive while the run goes on
};

/// A stretch of a step, in shares of its length.
struct Share {
  double from, to;
  double middle() const { return 0.5 * (from + to); }
};

/// Contains a share with both ends, also where its middle is rounded.
inline MidRad ball_of(const Share& share) {
  const double middle = share.middle();
  return {middle, upwards(std::max(share.to - middle, middle - share.from))};
}

/// Contains middle - y for each y within `radius` of a number of which `shift` is the double that
/// is nearest, where the middle is a share.
///
/// Five sums and roundings of numbers below 1 + |shift| + radius are off by 2^-53 of that each; the
/// margin has 2^-49 of it.
inline Share shifted_share(double middle, double shift, double radius) {
  constexpr double kMargin = 0x1p-49;
  const double centre = middle - shift,
               reach = upwards(radius + kMargin * std::max(1., std::abs(shift) + radius));
  return {centre - reach, centre + reach};
}

/// Finds all zeros of s along all solutions of a set.
///
/// The time is divided until on each part either s is certain not to vanish, or the derivative of s
/// is certain to have one sign: then s is monotone along every solution there, and so it is on
/// parts of the second kind that touch (at the time that they share both signs hold, so they are
/// equal). Between two parts without zeros such a stretch has exactly one zero where s has
/// different signs there, and none where they are equal. Where neither is certain, however short
/// the part, nothing is said: solutions may touch the zero level there.
template <class Ball>
class Crossings {
 public:
  using Vector = std::vector<Ball>;

  /// \param plane  s and its derivative by the time along solutions, of the states and the time;
  ///               must outlive this.
  /// \param monotone_is_enough  for tests: takes every part with a possible zero for monotone, which
  ///               makes the answers false.
  explicit Crossings(const Program& plane, bool forwards, bool monotone_is_enough = false)
      : plane_(plane), forwards_(forwards), careless_(monotone_is_enough) {}

  /// The set at the start of the run.
  void begin(const Vector& box) {
    const auto [value, rate] = values(box, Ball());
    last_sign_ = sign_of(value);
    starts_on_ = last_sign_ == 0;
  }

  /// A step from `elapsed` on that the set is certain to make, before it does.
  /// \return  false where some solution may touch.
  bool step(Lohner<Ball>& lohner, const Ball& elapsed, const Ball& h) {
    const auto [value, rate] = values(lohner.piece().tube(), elapsed + from_zero_to(h));
    if (const int sign = sign_of(value)) return no_zero(sign);
    return part({lohner, elapsed, h}, {0, 1});
  }

  /// After the last step. \return  as `step`.
  bool finish(const Vector& box, const Ball& elapsed) {
    if (!open_) return true;
    const auto [value, rate] = values(box, elapsed);
    const int sign = sign_of(value);
    if (sign == 0) return refuse(elapsed);
    return no_zero(sign);
  }

  /// After a step, with the set at its end: ends a stretch where s has a sign there, so that the
  /// zero in it is among those that are found. \return  as `step`.
  bool settle(const Vector& box, const Ball& elapsed) {
    if (!open_) return true;
    const int sign = sign_of(values(box, elapsed).first);
    return sign == 0 || no_zero(sign);
  }

  /// All of them, in their order.
  const std::vector<Passage<Ball>>& found() const { return found_; }
  /// Whether s may be zero at the start: a zero there, or so near that the start cannot be told
  /// from it, is not among them.
  bool starts_on_plane() const { return starts_on_; }
  /// Up to when all zeros are found, of a run that has come to `elapsed`; after a refusal that is
  /// where solutions may touch.
  Ball settled_until(const Ball& elapsed) const {
    return open_ ? open_->from : refused_ ? undecided_ : elapsed;
  }

 private:
  /// A step, and a part of it in shares of its length: dyadic numbers, so that parts meet.
  struct Step {
    Lohner<Ball>& lohner;
    const Ball &elapsed, &h;
  };
  struct Stretch {
    int sign;  ///< of the derivative of s by the elapsed time
    Ball from;
    std::optional<Passage<Ball>> passage;
  };
  static constexpr double kShortest = 0x1p-24;

  static Ball ball_of(const Share& share) { return Ball(validated::ball_of(share)); }

  int sign_of(const Ball& value) const {
    if (!is_usable(value) || contains_zero(value)) return 0;
    return approximate(value) < 0 ? -1 : 1;
  }

  /// s, and its derivative by the elapsed time; not usable where they are not certain to exist.
  std::pair<Ball, Ball> values(const Vector& box, const Ball& elapsed) {
    try {
      const Vector& both = plane_(box, forwards_ ? elapsed : -elapsed);
      return {both[0], forwards_ ? both[1] : -both[1]};
    } catch (const std::domain_error&) {
      const Ball nothing(MidRad(0, INFINITY));
      return {nothing, nothing};
    }
  }

  bool refuse(const Ball& time) {
    undecided_ = time;
    refused_ = true;
    return false;
  }

  /// s has this sign on a part. \return  false where that contradicts what is known: it cannot be.
  bool no_zero(int sign) {
    const bool changes = last_sign_ != 0 && sign != last_sign_;
    if (changes && (!open_ || !open_->passage)) return careless_ || refuse(Ball());
    if (changes) {
      open_->passage->upwards = sign > 0;
      found_.push_back(std::move(*open_->passage));
    }
    open_.reset();
    last_sign_ = sign;
    return true;
  }

  bool part(const Step& step, const Share& share) {
    const Ball after = step.h * ball_of(share);
    const Vector box = step.lohner.box_at(after);
    const auto [value, rate] = values(box, step.elapsed + after);
    int sign = sign_of(value);
    if (sign == 0) sign = sign_of(by_middle(step, share, rate));
    if (sign != 0) return no_zero(sign);
    int rising = sign_of(rate);
    if (rising == 0 && careless_) rising = 1;
    if (rising != 0) return monotone(step, share, rising);
    if (share.to - share.from < kShortest) {
      return refuse(step.elapsed + after);
    }
    return part(step, {share.from, share.middle()}) && part(step, {share.middle(), share.to});
  }

  /// s over a part by its value in the middle and its derivative: where that is small it is
  /// narrower.
  Ball by_middle(const Step& step, const Share& share, const Ball& rate) {
    const Ball at = step.h * Ball(share.middle());
    const Ball value = values(step.lohner.box_at(at), step.elapsed + at).first;
    return value + rate * (step.h * Ball(MidRad(0, 0.5 * (share.to - share.from))));
  }

  bool monotone(const Step& step, const Share& share, int sign) {
    const Ball over = step.elapsed + step.h * ball_of(share);
    if (!open_) open_ = Stretch{sign, over, {}};
    if (open_->sign != sign && !careless_) {  // cannot be: see above
      return refuse(over);
    }
    const std::optional<Share> zero = narrowed(step, share, sign);
    if (!zero) return true;
    const Ball after = step.h * ball_of(*zero);
    Passage<Ball> here{step.elapsed + after, step.lohner.box_at(after), sign > 0};
    if (open_->passage) here = joined(*open_->passage, here);
    open_->passage = std::move(here);
    return true;
  }

  /// Narrows the times of the zeros of all solutions in a part where s is monotone: by the sign in
  /// the middle, and by Newton's method with the mean value theorem; nothing where there is none.
  std::optional<Share> narrowed(const Step& step, Share share, int rising) {
    constexpr int kRounds = 60;
    for (int round = 0; round < kRounds; ++round) {
      const double middle = share.middle();
      const Ball at = step.h * Ball(middle), over = step.h * ball_of(share);
      const Ball value = values(step.lohner.box_at(at), step.elapsed + at).first;
      if (!is_usable(value)) return share;
      Share next = share;
      const int sign = sign_of(value);
      if (sign != 0) (sign == rising ? next.to : next.from) = middle;
      const Ball rate = values(step.lohner.box_at(over), step.elapsed + over).second * step.h;
      if (sign_of(rate) != 0) {
        const Ball by = value / rate;
        if (!is_usable(by)) return next;
        const Share zero = shifted_share(middle, approximate(by), radius_of(by));
        next = {std::max(next.from, zero.from), std::min(next.to, zero.to)};
        if (!(next.from <= next.to)) return std::nullopt;
      }
      const bool done = next.to - next.from > 0.9 * (share.to - share.from);
      share = next;
      if (done) break;
    }
    return share;
  }

  static Ball hull(const Ball& a, const Ball& b) { return widened(a, (b - a) + deviation_of(b)); }
  static Passage<Ball> joined(const Passage<Ball>& a, const Passage<Ball>& b) {
    Passage<Ball> both{hull(a.time, b.time), {}, b.upwards};
    for (std::size_t i = 0; i < a.states.size(); ++i)
      both.states.push_back(hull(a.states[i], b.states[i]));
    return both;
  }

  BallFunction<Ball> plane_;
  bool forwards_, careless_, starts_on_ = false, refused_ = false;
  int last_sign_ = 0;  ///< of s on the last part without a zero; 0: there was none
  std::optional<Stretch> open_;
  std::vector<Passage<Ball>> found_;
  Ball undecided_;
};

}  // namespace casimir::validated
