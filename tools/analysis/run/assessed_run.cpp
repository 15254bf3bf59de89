#include "tools/analysis/run/assessed_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <optional>
#include <stdexcept>

#include "codegen/optimise/scale_exponentials.hpp"
#include "runtime/step/stiffness.hpp"
#include "runtime/undefined_motion.hpp"
#include "tools/analysis/error.hpp"
#include "tools/analysis/estimate/cancelled_parts.hpp"
#include "tools/analysis/estimate/growth_of_changes.hpp"
#include "tools/analysis/estimate/near_singular.hpp"
#include "tools/analysis/estimate/parting_solutions.hpp"
#include "tools/analysis/estimate/parting_start.hpp"
#include "tools/analysis/estimate/rounding_of_rates.hpp"
#include "tools/analysis/run/closed_form_error.hpp"
#include "tools/analysis/run/drift_check.hpp"
#include "tools/analysis/run/invariant_projection.hpp"
#include "tools/analysis/run/smooth_method.hpp"

namespace casimir {
namespace {

/// Of `auto`, without a tolerance: where rounding takes over.
constexpr double kSmoothTolerance = 1e-15, kToleranceOfStiffRun = 1e-13;
/// What `auto` takes where coefficients of Taylor series are beyond all doubles.
constexpr const char* kWithoutSeries = "dop853";
constexpr double kToleranceWithoutSeries = 1e-13;
/// After so many steps `auto` asks for the first time whether the equations are stiff; then after
/// twice as many, and so on.
constexpr unsigned long long kFirstLook = 300;

/// A run of so many steps may be one that follows the rounding of the equations, which is as rough
/// as can be, if it is more than this part of the state.
constexpr unsigned long long kManySteps = 9600;
constexpr double kRough = 1e-9;

/// Looks while Taylor series run for what they are not made for: stiff equations, and such as are
/// no smooth functions in double precision.
class SmoothnessWatch {
 public:
  SmoothnessWatch(const CompiledModule& compiled, const PreparedScene& run, double duration)
      : compiled_(compiled), run_(run), duration_(duration) {}

  void see(double t, const double* x) {
    if (++steps_ != next_look_) return;
    next_look_ *= 2;
    look(t, {x, x + run_.initial.size()});
  }
  /// \return  whether nothing was found.
  bool look(double t, const std::vector<double>& state) {
    const double* const p = run_.parameters.empty() ? nullptr : run_.parameters.data();
    const double left = std::abs(duration_ - t);
    if (is_stiff(compiled_.module, t, state, p, left))
      finding_ = fmt::format("the equations are stiff at t = {:.3g}", t);
    else if (steps_ >= kManySteps &&
             rounding_of_rates_at(run_, compiled_.module, t, state, left) > kRough)
      finding_ = fmt::format("the equations lose their digits to rounding at t = {:.3g}", t);
    return finding_.empty();
  }
  const std::string& finding() const { return finding_; }

 private:
  const CompiledModule& compiled_;
  const PreparedScene& run_;
  double duration_;
  unsigned long long steps_ = 0, next_look_ = kFirstLook;
  std::string finding_;
};

class Judge {
 public:
  Judge(const Model& model, const Scene& scene, const PreparedScene& run,
        const AssessmentOptions& options)
      : model_(model), scene_(scene), run_(run), options_(options) {}

  AssessedRun judged() {
    if (options_.method == "auto") {
      run_chosen_method();
    } else {
      prepare(method_named(options_.method), settings_for(options_.run, run_));
      run_it();
    }
    refuse_undefined();
    judge();
    return std::move(result_);
  }

 private:
  void prepare(const Method& method, const Settings& settings) {
    result_.method = &method;
    result_.settings = settings;
    result_.settings.sample_every = options_.sample_every;
    if (options_.run.projects()) {
      result_.doubts.clear();
      result_.projected =
          set_projection(options_.run, model_, scene_, run_, result_.settings, result_.doubts);
    }
    result_.settings.give_up = time_limit(options_.time_limit);
    // Nothing is compiled for a method that is not the one to go on with. The module outlives this.
    BegunModule begun =
        interpreted_first(run_, method, [of = smoothness_](double t, const std::vector<double>& x) {
          return !*of || (*of)->look(t, x);
        });
    result_.compiled.emplace(std::move(begun.code));
    result_.later = std::move(begun.later);
  }

  /// From when on more than one solution may go on.
  std::optional<double> parting_time() const {
    const double begin = result_.settings.begin;
    if (!parting_->time() && may_part_at_start(run_, begin, result_.settings.duration))
      return begin;
    return parting_->time();
  }

  void run_chosen_method() {
    if (run_closed_form()) return;
    prepare_smooth(settings_for(options_.run, run_, kSmoothTolerance));
    SmoothnessWatch smoothness(*result_.compiled, run_, result_.settings.duration);
    *smoothness_ = &smoothness;
    run_it(&smoothness);
    *smoothness_ = nullptr;
    result_.chosen = smoothness.finding();
    if (result_.chosen.empty()) {
      result_.chosen = "the equations are not stiff";
      if (!result_.method->series)
        result_.chosen += ", and few digits are asked for";
      else if (result_.trajectory.status == Status::non_finite)
        try_without_series();
    } else {
      prepare(method_named(kStiffMethod), settings_for(options_.run, run_, kToleranceOfStiffRun));
      run_it();
      if (!options_.run.tolerance && !options_.run.atol) try_small_states();
    }
  }

  /// \return  whether the run was long, and there is a closed form that reaches its end.
  bool run_closed_form() {
    Settings settings = settings_for(options_.run, run_, kSmoothTolerance);
    settings.sample_every = options_.sample_every;
    if (options_.run.projects() || !closed_form_pays(run_, settings)) return false;
    const Method& method = *find_method("exact");
    // In less than a few periods its values may be small beside those of which it is off by a part.
    constexpr double kPeriods = 10;
    const std::optional<double> period = closed_form_period(run_);
    if (!period || !(std::abs(settings.duration) > kPeriods * *period)) return false;
    try {
      prepare(method, settings);
      run_it();
    } catch (const RequestError&) {  // so close to a separatrix that its numbers do not suffice
      result_ = {};
      return false;
    }
    result_.chosen = "the run is long, and its solution is known in closed form";
    return true;
  }

  /// 1/(1 + exp(10^5 x)) is as good as 0 where the exponential is beyond all doubles; the
  /// coefficients of its series are infinity by infinity.
  void try_without_series() {
    const double time = result_.trajectory.time;
    if (!has_rates(result_.compiled->module, time, result_.trajectory.state, run_.parameters))
      return;
    AssessedRun first = std::move(result_);
    result_ = {};
    prepare(method_named(kWithoutSeries),
            settings_for(options_.run, run_, kToleranceWithoutSeries));
    run_it();
    if (result_.trajectory.status == Status::ok) {
      result_.chosen =
          fmt::format("coefficients of Taylor series are beyond all doubles at t = {:.3g}", time);
      return;
    }
    result_ = std::move(first);
  }

  void prepare_smooth(const Settings& settings) {
    const Method& method = smooth_method(run_, settings.fixed_step > 0 ? 0 : settings.rtol);
    try {
      return prepare(method, settings);
    } catch (const CompilerMissing&) {
      if (method.series) throw;
    }
    prepare(method_named("auto"), settings);  // which needs no compiler
  }

  /// A state of reacting matter may dwindle below the absolute tolerance and, once it is lost to
  /// rounding and negative, explode.
  void try_small_states() {
    const Status status = result_.trajectory.status;
    if (status == Status::ok || status == Status::stopped || status == Status::max_steps) return;
    constexpr double kMuchLess = 1e-15;
    const Trajectory first = result_.trajectory;
    const double asked = result_.settings.atol;
    result_.settings.atol *= kMuchLess;
    run_it();
    if (result_.trajectory.status == Status::ok) return;
    result_.trajectory = first;
    result_.settings.atol = asked;
  }

  /// One run; what `smoothness` finds ends it.
  void run_it(SmoothnessWatch* smoothness = nullptr) {
    singular_.emplace(run_);
    parts_.emplace(model_, run_);
    undefined_.emplace(run_.specialisation.rhs, run_.parameters, result_.settings.duration);
    Settings settings = result_.settings;
    undefined_->see(settings.begin, run_.initial.data(), run_.initial.size());
    if (singular_->divides() || smoothness || undefined_->looks())
      settings.watch = [&, smoothness](double t, const double* x) {
        singular_->see(t, x);
        undefined_->see(t, x, run_.initial.size());
        if (smoothness) smoothness->see(t, x);
      };
    parts_->watch(settings);
    parting_.emplace(run_).watch(settings);
    if (smoothness || singular_->divides() || undefined_->looks())
      settings.give_up = [this, smoothness, limit = settings.give_up] {
        return singular_->goes_to_and_fro() || !undefined_->why().empty() ||
               (smoothness && !smoothness->finding().empty()) || (limit && limit());
      };
    const auto run = [&] {
      try {
        const double before = seconds_to_compile();
        result_.trajectory = integrate(result_.compiled->module, *result_.method, settings,
                                       run_.initial, run_.parameters);
        result_.trajectory.seconds -= seconds_to_compile() - before;
      } catch (const std::invalid_argument& problem) {
        throw RequestError(problem.what());
      }
    };
    if (options_.around)
      options_.around(settings, run);
    else
      run();
    if (parts_->lost()) parts_->end(result_.trajectory);
    if (singular_->goes_to_and_fro() && result_.trajectory.status == Status::stopped) {
      result_.trajectory.status = Status::singularity;
      result_.trajectory.reason = reason_of(Status::singularity);
    }
  }

  /// Of code that is compiled in the middle of a run.
  double seconds_to_compile() const { return result_.later ? result_.later->seconds : 0; }

  void refuse_undefined() {
    Trajectory& trajectory = result_.trajectory;
    const auto inputs = [&](double t, std::vector<double> x) {
      x.insert(x.end(), run_.parameters.begin(), run_.parameters.end());
      x.push_back(t);
      return x;
    };
    std::string why = undefined_ ? undefined_->why() : "";
    if (why.empty())
      why = UndefinedMotion(run_.specialisation.rhs)
                .why(trajectory.status, inputs(result_.settings.begin, run_.initial),
                     inputs(trajectory.time, trajectory.state));
    if (why.empty()) return;
    trajectory.status = Status::at_jump;
    trajectory.reason = why;
  }

  void judge() {
    std::vector<std::string>& doubts = result_.doubts;
    Trajectory& trajectory = result_.trajectory;
    if (!result_.compiled->warning.empty()) doubts.push_back(result_.compiled->warning);
    if (result_.later && result_.later->missing) doubts.emplace_back(kInterpretedWarning);
    const RunRequest& asked = options_.run;
    if (asked.step && (asked.rtol || asked.atol || asked.tolerance))
      doubts.emplace_back(
          "a constant step is not controlled by its error: the tolerance bounds nothing");
    DriftDoubts drifts = check_drift(model_, scene_, run_, trajectory);
    std::ranges::move(drifts.sentences, std::back_inserter(doubts));
    if (trajectory.status == Status::ok) doubt_small_states();
    result_.trust = assess(run_, *result_.compiled, *result_.method, result_.settings,
                           drifts.which.empty() ? trajectory : without_drifts(drifts.which));
    if (trajectory.status == Status::ok) result_.trust.one_of_several = parting_time();
    if (result_.trust.one_of_several)
      result_.trust.error_estimate = std::max(result_.trust.error_estimate, 1.);
    constexpr double kWrongByOverflow = 1e-6;
    if (trajectory.status == Status::ok && result_.trust.overflow > kWrongByOverflow) {
      trajectory.status = Status::non_finite;
      trajectory.reason =
          "a number in the equations is beyond all doubles, and rates of the state come out wrong";
    }
    if (trajectory.status != Status::ok || singular_->crossed() || costs_digits())
      result_.near_singular = singular_->finding();
  }

  /// A function that is no integral changes however well the state is known.
  Trajectory without_drifts(const std::vector<std::size_t>& which) const {
    Trajectory trajectory = result_.trajectory;
    for (const std::size_t i : which) trajectory.invariants[i].drift = 0;
    return trajectory;
  }

  void doubt_small_states() {
    std::string names;
    for (const std::size_t i : smaller_states(result_.trajectory, run_.initial))
      names += (names.empty() ? "" : ", ") + run_.specialisation.states[i];
    if (names.empty()) return;
    result_.unestimated = fmt::format(
        "the estimate says nothing of {}: all the time below a billionth of the "
        "largest state; other units would show it",
        names);
  }

  /// Whether the estimate of the error leaves room for digits that a small divisor took.
  bool costs_digits() const {
    constexpr double kOfTolerance = 3, kSeen = 1e-12;
    const ErrorEstimate& trust = result_.trust;
    return !trust.known || trust.unconfirmed || trust.beyond_double ||
           !(trust.error_estimate < std::max(kSeen, kOfTolerance * result_.settings.rtol));
  }

  const Model& model_;
  const Scene& scene_;
  const PreparedScene& run_;
  const AssessmentOptions& options_;
  std::optional<NearSingular> singular_;
  std::optional<CancelledParts> parts_;
  std::optional<UndefinedSteps> undefined_;
  std::optional<PartingSolutions> parting_;
  /// While `auto` looks whether its first choice is right.
  std::shared_ptr<SmoothnessWatch*> smoothness_ = std::make_shared<SmoothnessWatch*>(nullptr);
  AssessedRun result_;
};

/// Whether infinities in the equations may be why a run ended.
bool may_be_beyond_doubles(Status status) {
  return status == Status::non_finite || status == Status::singularity ||
         status == Status::step_underflow || status == Status::no_convergence;
}

}  // namespace

AssessedRun integrate_assessed(const Model& model, const Scene& scene, const PreparedScene& run,
                               const AssessmentOptions& options) {
  AssessedRun first = Judge(model, scene, run, options).judged();
  if (!may_be_beyond_doubles(first.trajectory.status)) return first;
  std::optional<Program> scaled =
      codegen::with_scaled_exponentials(run.specialisation.rhs, run.initial.size());
  if (!scaled) return first;
  struct Rewritten {
    PreparedScene scene;
    std::shared_ptr<const LaterCode> later = nullptr;
  };
  const auto rewritten = std::make_shared<Rewritten>(Rewritten{run});
  rewritten->scene.specialisation.rhs = std::move(*scaled);
  AssessedRun second = Judge(model, scene, rewritten->scene, options).judged();
  if (second.trajectory.status != Status::ok) return first;
  // The scene lives as long as the result.
  rewritten->later = second.later;
  second.later = std::shared_ptr<const LaterCode>(rewritten, rewritten->later.get());
  if (!second.chosen.empty())
    second.chosen += ", with exponentials beyond all doubles taken out of logarithms and divisors";
  return second;
}

}  // namespace casimir
