#include "runtime/digits/agreed_run.hpp"

#include <cln/exception.h>
#include <cln/integer.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "runtime/digits/cancellation.hpp"
#include "runtime/program/zero_states.hpp"
#include "runtime/undefined_motion.hpp"

namespace casimir {
namespace {

constexpr double kLog10Of2 = 0.30102999566398120;
constexpr double kNoDifference = -1e18;

/// log10 |x|.
double log10_of(const cln::cl_F& x) {
  if (cln::zerop(x)) return kNoDifference;
  const cln::decoded_float parts = cln::decode_float(x);
  return kLog10Of2 * static_cast<double>(cln::cl_I_to_long(parts.exponent)) +
         std::log10(cln::double_approx(parts.mantissa));
}

/// log10 |a - b| / |b|.
double log10_difference(const cln::cl_F& a, const cln::cl_F& b) {
  return a == b ? kNoDifference : log10_of(a - b) - log10_of(b);
}

double largest(const std::vector<double>& values) {
  return *std::max_element(values.begin(), values.end());
}

/// What is so many digits below all other components is zero, or nothing that matters.
int far_below(int digits) { return 2 * digits + 200; }

/// The same for the component of two end states that differs most. One is zero to that many digits,
/// and not compared, if it is below the last digit both of the state and of its own largest value
/// along the run; or below far more digits of whatever there was.
double log10_difference(const PreciseRun& a, const PreciseRun& b, int digits) {
  const int far = far_below(digits);
  std::vector<double> sizes, state;
  for (const double size : b.log2_sizes) sizes.push_back(kLog10Of2 * size);
  for (std::size_t i = 0; i < b.state.size(); ++i)
    state.push_back(std::max(log10_of(a.state[i]), log10_of(b.state[i])));
  double difference = kNoDifference;
  for (std::size_t i = 0; i < state.size(); ++i) {
    const bool zero =
        state[i] < std::min(sizes[i], largest(state)) - digits || state[i] < largest(sizes) - far;
    if (!zero) difference = std::max(difference, log10_difference(a.state[i], b.state[i]));
  }
  return difference;
}

/// log10 of the largest distance of two runs at the places of one of them, each component beside
/// the largest that it comes to. Those that are nothing but rounding of the others are left out,
/// and what grows from that, as where the ends are compared.
double largest_on_the_way(const PreciseRun& a, const PreciseRun& b, int working, int digits) {
  constexpr int kOfRounding = 5;
  const double below = std::min(working - kOfRounding, far_below(digits));
  std::vector<double> sizes;
  for (std::size_t i = 0; i < a.log2_sizes.size(); ++i)
    sizes.push_back(kLog10Of2 * std::max(a.log2_sizes[i], b.log2_sizes[i]));
  double result = kNoDifference;
  for (std::size_t k = 0; k < std::min(a.way.size(), b.way.size()); ++k)
    for (std::size_t i = 0; i < sizes.size(); ++i)
      if (sizes[i] >= largest(sizes) - below && a.way[k][i] != b.way[k][i])
        result = std::max(result, log10_of(a.way[k][i] - b.way[k][i]) - sizes[i]);
  return result;
}

int whole_digits(double log10_error, int most) {
  return static_cast<int>(std::clamp(std::floor(-log10_error), 0., static_cast<double>(most)));
}

constexpr int kMoreDigits = 10;
/// A search does not go on to runs that take more memory.
constexpr double kMostBytes = 1e9;
constexpr int kMostRounds = 8;

/// The search for two runs that agree.
class Search {
 public:
  Search(PreciseProblem problem, int digits, const std::function<void(int)>& begin)
      : problem_(std::move(problem)), wanted_(digits), begin_(begin) {
    // Rounding would take these off 0, and no two runs would ever agree in what it leaves there.
    const std::vector<cln::cl_R> start = problem_.start(digits);
    std::vector<bool> zero;
    for (std::size_t i = 0; i < problem_.rhs->outputs.size(); ++i)
      zero.push_back(cln::zerop(start[i]));
    rhs_ = at_rest(*problem_.rhs, states_that_stay_zero(*problem_.rhs, zero));
    problem_.rhs = &rhs_;
    cancelled_ = cancelled_at(std::vector<cln::cl_R>(start.begin(), start.end() - 1), 0);
  }
  Search(const Search&) = delete;
  Search& operator=(const Search&) = delete;

  AgreedRun operator()() {
    find_loss();
    int working = wanted_ + best_.lost + cancelled_;
    bool cancels = false;
    for (int round = 0; round < kMostRounds && !stopped_; ++round) {
      compare(working, wanted_);
      // Series whose coefficients are rounding do not converge: more digits may.
      const bool converged = best_.run.status != Status::no_convergence;
      cancels = false;
      if (converged && best_.digits >= wanted_ && !(cancels = more_cancels_at_the_end())) break;
      // A state beside a singularity may have no more digits however many are spent.
      if (best_.run.status != Status::ok && round > 1) break;
      // Nothing in common: the loss is not known, only that it is more.
      working = best_.digits == 0
                    ? 2 * working
                    : std::max(working + kMoreDigits, wanted_ + best_.lost + cancelled_);
      if (precise_run_bytes(problem_, working) > kMostBytes) break;
    }
    // No run was made with the digits that these would take: that two agree says nothing.
    if (cancels) best_.digits = 0;
    refuse_at_jump();
    return std::move(best_);
  }

 private:
  int cancelled_at(std::vector<cln::cl_R> state, const cln::cl_R& time) const {
    state.push_back(time);
    return cancelled_digits(rhs_, state, problem_.start(wanted_).back(), wanted_ + kMoreDigits);
  }

  /// A motion that goes no further since a jump holds it. (That it is undefined for a time each run
  /// finds out to all its digits: differences that doubles do not see are not 0.)
  void refuse_at_jump() {
    if (best_.run.status == Status::ok) return;
    const std::vector<cln::cl_R> start = problem_.start(wanted_);
    const auto approximate = [](const cln::cl_R& x) {
      const double result = cln::double_approx(x);
      if (result != 0 || cln::zerop(x)) return result;
      return std::copysign(std::numeric_limits<double>::min(), cln::minusp(x) ? -1. : 1.);
    };
    const auto inputs = [&](const auto& state, const cln::cl_R& time) {
      std::vector<double> result;
      for (std::size_t i = 0; i + 1 < start.size(); ++i)
        result.push_back(approximate(i < best_.run.state.size() ? cln::cl_R(state[i]) : start[i]));
      result.push_back(cln::double_approx(time));
      return result;
    };
    try {
      const std::string why = UndefinedMotion(rhs_).why(best_.run.status, inputs(start, 0),
                                                        inputs(best_.run.state, best_.run.time));
      if (why.empty()) return;
      best_.run.status = Status::at_jump;
      best_.run.reason = why;
    } catch (const cln::runtime_exception&) {
      // A number beyond all doubles is not 0.
    }
  }

  /// Two runs that lose all their digits in the same difference agree as well.
  bool more_cancels_at_the_end() {
    if (best_.run.status != Status::ok) return false;
    const std::vector<cln::cl_R> start = problem_.start(wanted_);
    std::vector<cln::cl_R> inputs(best_.run.state.begin(), best_.run.state.end());
    inputs.insert(inputs.end(), start.begin() + static_cast<std::ptrdiff_t>(inputs.size()),
                  start.end() - 1);
    const int there = cancelled_at(std::move(inputs), best_.run.time);
    if (there <= cancelled_) return false;
    cancelled_ = there;
    return true;
  }

  /// What the motion costs, by runs with a quarter of the digits: a few hundredths of the work.
  void find_loss() {
    constexpr int kLeast = 12, kWorthwhile = 40;
    if (wanted_ < kWorthwhile) return;
    for (int working = std::max(kLeast, wanted_ / 4); working < wanted_ && !stopped_;
         working *= 2) {
      compare(working, working);
      if (best_.digits > 0 || best_.run.status != Status::ok) break;
    }
  }

  /// Two runs, the second with more digits, and what they agree in.
  void compare(int working, int most) {
    const int more = std::max(kMoreDigits, wanted_ / 16);
    AgreedRun next;
    PreciseProblem checking = problem_;
    checking.from_other_side = checking.keep_way = true;
    next.check = run(checking, working);
    if (stopped_) return keep_stopped(std::move(next.check));
    checking.from_other_side = checking.keep_way = false;
    checking.places = next.check.way_times;
    if (next.check.status == Status::max_steps) {
      checking.max_steps = 0;
      checking.end = next.check.time;
    } else if (next.check.status != Status::ok) {
      checking.mark = next.check.time;
    }
    next.run = run(checking, working + more);
    if (stopped_) return keep_stopped(std::move(next.run));
    if (next.check.status == Status::max_steps && next.run.status == Status::ok) {
      next.run.status = next.check.status;
      next.run.reason = next.check.reason;
    } else if (!next.run.at_mark.empty()) {
      next.run.time = next.check.time;
      next.run.state = std::exchange(next.run.at_mark, {});
    }
    judge(next, working, most);
  }

  void judge(AgreedRun& next, int working, int most) {
    next.checked = next.run.status == next.check.status;
    next.log10_error = 0;
    if (next.checked && next.run.singular_time && next.check.singular_time) {
      next.log10_error = log10_difference(*next.check.singular_time, *next.run.singular_time);
    } else if (next.checked && log10_difference(next.check.time, next.run.time) < -working) {
      next.log10_error = log10_difference(next.check, next.run, most);
    }
    // Half of the digits on the way: what hides behind that much of a large part of a state would
    // have to be seen in the other half at the end.
    const double apart = next.checked ? largest_on_the_way(next.check, next.run, working, most) : 0;
    if (apart > -most / 2.) next.log10_error = std::max(next.log10_error, 0.);
    // Two runs that are equal by chance still have no more digits than they were made with.
    next.log10_error = std::max(next.log10_error, -static_cast<double>(next.run.digits));
    next.digits = whole_digits(next.log10_error, most);
    next.lost = working - whole_digits(next.log10_error, working);
    next.runs = runs_;
    best_ = std::move(next);
  }

  PreciseRun run(const PreciseProblem& problem, int digits) {
    if (begin_) begin_(digits);
    PreciseRun result = precise_run(problem, digits);
    ++runs_;
    stopped_ = result.status == Status::stopped;
    return result;
  }

  /// The time is up: a pair of runs with fewer digits is better than a part of one.
  void keep_stopped(PreciseRun part) {
    if (best_.checked && best_.digits > 0) {
      best_.run.status = part.status;
      best_.run.reason = part.reason;
    } else {
      best_ = AgreedRun{.run = std::move(part), .check = {}};
    }
    best_.runs = runs_;
  }

  PreciseProblem problem_;
  Program rhs_;  ///< of the problem, at rest where the solution is
  int wanted_;
  int cancelled_ = 0;  ///< digits that the rates lose where they were looked at
  const std::function<void(int)>& begin_;
  AgreedRun best_;
  bool stopped_ = false;
  int runs_ = 0;
};

}  // namespace

int agreed_digits(const cln::cl_F& a, const cln::cl_F& b, int most) {
  return whole_digits(log10_difference(a, b), most);
}

AgreedRun agreed_run(PreciseProblem problem, int digits, const std::function<void(int)>& begin) {
  return Search(std::move(problem), digits, begin)();
}

}  // namespace casimir
