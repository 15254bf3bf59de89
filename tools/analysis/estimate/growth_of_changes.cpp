#include "tools/analysis/estimate/growth_of_changes.hpp"

#include <algorithm>
#include <cmath>

#include "codegen/optimise/differentiate.hpp"
#include "runtime/uncompiled.hpp"
#include "tools/analysis/estimate/saltation.hpp"
#include "tools/analysis/run/taylor_path.hpp"

namespace casimir {
namespace {

/// Of the largest state, the least that others are taken for.
constexpr double kLeastSize = 1e-9;

/// Steps in all columns together: a tenth of a second where the equations are quadratic, and half a
/// second where they are interpreted.
constexpr unsigned long long kSteps = 60000, kInterpretedSteps = 6000;
constexpr std::size_t kStartsOfGrowth = 16;
constexpr double kTightest = 1e-15;
/// Of base orbits: near separatrices their own errors would pass for the distance from them.
constexpr double kLoosest = 1e-10;
constexpr double kMostGrowth = 1e250;
/// Of deviations, which enter linearly: far below the states, whose errors rule the steps. Where
/// the states rest they rule nothing, and deviations are as large as states.
constexpr double kUnit = 0x1p-130, kUnitAtRest = 1;
/// In so few the states say nothing of how long the steps of deviations may be: x = t takes one.
constexpr std::size_t kFewSteps = 40;
/// A state that moves by less, relative to its size, rests.
constexpr double kRest = 1e-6;

using Growth = Conditioning::Growth;

/// One deviation, followed step by step.
class Deviation {
 public:
  Deviation(const std::vector<double>& sizes, double unit) : sizes_(sizes), unit_(unit) {}

  void see(double t, const double* state) {
    const std::size_t n = sizes_.size();
    double size = 0;
    for (std::size_t i = 0; i < n; ++i)
      size = std::max(size, std::abs(state[n + i]) / (unit_ * sizes_[i]));
    reached_ = std::abs(t);
    now_ = std::min(size, kMostGrowth);
    if (now_ >= 2 * growth_.back().factor) growth_.push_back({reached_, now_});
  }

  /// Continues the growth to `end`, in steps of doubled growth.
  void extrapolate(double end) {
    if (!(reached_ > 0) || reached_ >= end) return;
    const double largest = growth_.back().factor, half = at(reached_ / 2);
    const double power = std::max(std::log2(largest / half), 1.);
    const double rate = 2 * std::log(largest / half) / reached_;
    const bool exponential = power > 3;
    for (double factor = 2 * largest; factor < kMostGrowth; factor *= 2) {
      const double t = exponential ? reached_ + std::log(factor / largest) / rate
                                   : reached_ * std::pow(factor / largest, 1 / power);
      if (!(t < end)) break;
      growth_.push_back({t, factor});
    }
    now_ = std::min(kMostGrowth, exponential ? largest * std::exp(rate * (end - reached_))
                                             : largest * std::pow(end / reached_, power));
  }

  const std::vector<Growth>& growth() const { return growth_; }
  double now() const { return now_; }
  double reached() const { return reached_; }

 private:
  /// The largest growth up to a time.
  double at(double t) const {
    const auto next = std::ranges::find_if(growth_, [&](const Growth& g) { return g.time > t; });
    return (next - 1)->factor;
  }

  const std::vector<double>& sizes_;
  const double unit_;
  std::vector<Growth> growth_{{0, 1}};
  double now_ = 1, reached_ = 0;
};

struct Point {
  double time;
  std::vector<double> state;
};

class Follower {
 public:
  Follower(const PreparedScene& run, const Settings& settings, double duration,
           const std::vector<double>& sizes, bool stiff)
      : run_(run),
        sizes_(sizes),
        stiff_(stiff),
        rhs_(codegen::variational(run.specialisation.rhs, sizes.size())),
        saltation_(run.specialisation.rhs) {
    const TaylorChoice choice =
        choose_taylor_path(rhs_, run.specialisation.limits, run.parameters, false);
    module_.emplace(uncompiled_module(rhs_, {}, choice.form, run.parameters));
    settings_.duration = duration;
    settings_.rtol = choice.form ? std::clamp(settings.rtol, kTightest, kLoosest) : kLoosest;
    const double tighter = settings.rtol > 0 ? settings_.rtol / settings.rtol : 1;
    // Growth is relative to the size of each state, which what is allowed has to be small beside.
    settings_.atol = std::min(settings.atol * tighter, settings_.rtol * std::ranges::min(sizes));
    settings_.give_up = settings.give_up;
    steps_ = choice.form ? kSteps : kInterpretedSteps;
    begin_again();
  }

  std::optional<Conditioning> conditioning() {
    const std::size_t n = sizes_.size();
    settings_.max_steps = steps_ / n;
    if (stiff_ || rests()) unit_ = kUnitAtRest;
    if (!follow_columns()) return std::nullopt;
    if (path_.size() < kFewSteps && unit_ != kUnitAtRest) {
      unit_ = kUnitAtRest;
      begin_again();
      if (!follow_columns()) return std::nullopt;
    }
    if (result_.followed >= 0.99 * std::abs(settings_.duration)) follow_from_later();
    return std::move(result_);
  }

 private:
  void begin_again() {
    path_.clear();
    grown_.clear();
    result_ = {};
    result_.followed = std::abs(settings_.duration);
    result_.growth = {{0, 1}};
  }

  /// \return  whether each of them gets somewhere
  bool follow_columns() {
    for (std::size_t j = 0; j < sizes_.size(); ++j) {
      std::vector<double> direction(sizes_.size(), 0.);
      direction[j] = 1;
      const auto deviation = follow({0, run_.initial}, direction, j == 0);
      if (!deviation) return false;
      result_.columns.push_back(deviation->now() / part_of_sizes(run_.initial));
    }
    return true;
  }

  /// From `from` to the end; the states on the way become starting points if `keep`.
  std::optional<Deviation> follow(const Point& from, const std::vector<double>& direction,
                                  bool keep) {
    const std::size_t n = sizes_.size();
    Deviation deviation(sizes_, unit_);
    const double part = part_of_sizes(from.state);
    Settings settings = settings_;
    settings.begin = from.time;
    settings.duration -= from.time;
    settings.watch = [&](double t, const double* x) {
      deviation.see(t - from.time, x);
      if (keep) path_.push_back({t, {x, x + n}});
    };
    saltation_.begin();
    settings.after_step = saltation_.hook(run_.parameters, 2 * n);
    // More is not told apart, and deviations that begin as large as states would overflow.
    settings.give_up = [&] {
      return deviation.now() >= kMostGrowth || (settings_.give_up && settings_.give_up());
    };
    std::vector<double> start = from.state;
    for (std::size_t i = 0; i < n; ++i) start.push_back(unit_ * sizes_[i] * part * direction[i]);
    const Trajectory run =
        integrate(*module_, *find_method("taylor"), settings, start, run_.parameters);
    const bool grown = run.status == Status::stopped && deviation.now() >= kMostGrowth;
    if (run.status != Status::ok && run.status != Status::max_steps && !grown) return std::nullopt;
    result_.followed = std::min(result_.followed, std::abs(from.time) + deviation.reached());
    deviation.extrapolate(std::abs(settings.duration));
    include(deviation, std::abs(from.time));
    return deviation;
  }

  /// What part of its sizes a state has grown to: errors that are made there are relative to it,
  /// but for the absolute tolerance. Where it is not small it is 1.
  double part_of_sizes(const std::vector<double>& state) const {
    constexpr double kSmallPart = 0.1, kUnitRoundoff = 0x1p-53;
    double part = 0;
    for (std::size_t i = 0; i < sizes_.size(); ++i)
      part = std::max(part, (std::abs(state[i]) + settings_.atol / kUnitRoundoff) / sizes_[i]);
    return part < kSmallPart ? part : 1;
  }

  /// Whether the motion is none, or next to none.
  bool rests() const {
    std::vector<double> start = run_.initial;
    start.resize(2 * start.size());
    bool result = true;
    Settings settings = settings_;
    settings.watch = [&](double, const double* x) {
      for (std::size_t i = 0; i < sizes_.size(); ++i)
        result = result && std::abs(x[i] - run_.initial[i]) <= kRest * sizes_[i];
    };
    settings.give_up = [&, asked = settings_.give_up] { return !result || (asked && asked()); };
    integrate(*module_, *find_method("taylor"), settings, start, run_.parameters);
    return result;
  }

  /// Changes made on the way may grow more than those at the start, as at the passage of a saddle.
  /// The points are evenly spread over the steps, which are shortest where much happens.
  void follow_from_later() {
    const std::vector<Point> path = path_;
    for (std::size_t k = 1; k <= kStartsOfGrowth; ++k) {
      const std::size_t at = k * path.size() / (kStartsOfGrowth + 1);
      if (at == 0 || at + 1 >= path.size()) continue;
      std::vector<double> direction;  // of both signs, and the same in every run
      for (std::size_t i = 0; i < sizes_.size(); ++i)
        direction.push_back((k * (2 * i + 1) / 2) % 2 == 0 ? 1 : -1);
      follow(path[at], direction, false);
    }
  }

  void include(const Deviation& deviation, double from) {
    result_.at_end = std::max(result_.at_end, deviation.now());
    for (const Growth& g : deviation.growth()) grown_.push_back({from + g.time, g.factor});
    std::ranges::sort(grown_, {}, &Growth::time);
    std::vector<Growth> rising{{0, 1}};
    for (const Growth& g : grown_)
      if (g.factor >= 2 * rising.back().factor) rising.push_back(g);
    grown_ = result_.growth = std::move(rising);
  }

  const PreparedScene& run_;
  const std::vector<double>& sizes_;
  const bool stiff_;
  Program rhs_;
  Saltation saltation_;
  std::optional<Module> module_;
  Settings settings_;
  unsigned long long steps_ = 0;
  double unit_ = kUnit;
  std::vector<Point> path_;
  std::vector<Growth> grown_;
  Conditioning result_;
};

}  // namespace

std::optional<double> Conditioning::time_of(double factor) const {
  for (std::size_t i = 0; i < growth.size(); ++i) {
    if (growth[i].factor >= factor) return growth[i == 0 ? 0 : i - 1].time;
  }
  return std::nullopt;
}

std::vector<double> sizes_of(const Trajectory& trajectory) {
  std::vector<double> sizes = trajectory.sizes;
  const double largest = std::ranges::max(sizes);
  for (double& size : sizes) size = largest == 0 ? 1 : std::max(size, kLeastSize * largest);
  return sizes;
}

std::vector<std::size_t> smaller_states(const Trajectory& trajectory,
                                        const std::vector<double>& initial) {
  constexpr double kRounding = 1e-14;  // what is zero all along may become so large
  const double largest = std::ranges::max(trajectory.sizes), least = kLeastSize * largest;
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < initial.size(); ++i)
    if (trajectory.sizes[i] < least &&
        (initial[i] != 0 || trajectory.sizes[i] > kRounding * largest))
      result.push_back(i);
  return result;
}

std::optional<Conditioning> conditioning(const PreparedScene& run, const Settings& settings,
                                         double duration, const std::vector<double>& sizes,
                                         bool stiff) {
  return Follower(run, settings, duration, sizes, stiff).conditioning();
}

}  // namespace casimir
