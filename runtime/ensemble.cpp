// Ensembles: trajectories in the lanes of registers, on several threads.
#include "runtime/ensemble.hpp"

#include <algorithm>
#include <chrono>
#include <optional>
#include <stdexcept>

#include "runtime/ensemble/ensemble_work.hpp"
#include "runtime/ensemble/lane_look.hpp"

namespace casimir {
namespace {

using Clock = std::chrono::steady_clock;

/// What one thread gives to a kernel and takes from it, behind the plain C interface.
class Feed {
 public:
  Feed(EnsembleWork& work, const LaneKernel& kernel, const Program& invariants)
      : work_(work),
        numbers_of_(kernel.numbers),
        count_(kernel.numbers.outputs.size()),
        numbers_(count_),
        check_(work.ensemble(), invariants) {
    const Ensemble& ensemble = work.ensemble();
    if (kernel.watch && looks_at_any(*kernel.watch)) {
      look_.emplace(*kernel.watch, ensemble.states, kernel.lanes, [&ensemble](long long member) {
        return ensemble.values_of(static_cast<std::size_t>(member));
      });
      look_->end_before_poles();
    }
  }

  static long long next(void* self, double* x, const double** numbers) {
    return static_cast<Feed*>(self)->next_member(x, numbers);
  }
  static void done(void* self, long long member, const double* x, const casimir_outcome* outcome) {
    static_cast<Feed*>(self)->take(static_cast<std::size_t>(member), x, *outcome);
  }
  static int give_up(void* self) {
    Feed& feed = *static_cast<Feed*>(self);
    return feed.work_.give_up(feed.calls_) ? 1 : 0;
  }
  static void look(void* self, const casimir_lane_step* trial, double* parts) {
    (*static_cast<Feed*>(self)->look_)(*trial, parts);
  }
  bool looks() const { return look_.has_value(); }
  /// Goes on with the members of another absolute tolerance.
  void take_from(std::size_t share) { share_ = share; }

 private:
  bool looks_at_any(const StepWatch& watch) const {
    const Ensemble& ensemble = work_.ensemble();
    if (!watch.signed_divisors().empty()) return true;
    for (std::size_t i = 0; i < ensemble.size(); ++i)
      if (watch.looks(ensemble.values_of(i), ensemble.state(i))) return true;
    return false;
  }

  long long next_member(double* x, const double** numbers) {
    const long long member = work_.next(share_);
    if (member < 0) return member;
    const Ensemble& ensemble = work_.ensemble();
    const auto index = static_cast<std::size_t>(member);
    std::copy_n(ensemble.state(index), ensemble.states, x);
    *numbers = ensemble.values_of(index);
    if (count_ > 0) {
      numbers_of_(*numbers, numbers_.data());
      *numbers = numbers_.data();
    }
    return member;
  }

  void take(std::size_t member, const double* x, const casimir_outcome& outcome) {
    MemberResult& result = work_.result.members[member];
    result.status = status_of(outcome.status);
    if (result.status == Status::step_underflow && look_ &&
        look_->at_pole(static_cast<long long>(member)))
      result.status = Status::singularity;
    result.time = outcome.t;
    result.state.assign(x, x + work_.ensemble().states);
    result.steps = outcome.steps;
    result.rejected = outcome.rejected;
    check_(member, result);
  }

  EnsembleWork& work_;
  Interpreter numbers_of_;
  std::size_t count_;
  std::vector<double> numbers_;
  EndCheck check_;
  std::optional<LaneLook> look_;
  unsigned calls_ = 0;
  std::size_t share_ = 0;
};

}  // namespace

EnsembleResult integrate_in_lanes(const Ensemble& ensemble, const LaneKernel& kernel,
                                  const Program& invariants, const Settings& settings, int jobs) {
  check_settings(settings, *find_method("taylor"));
  if (settings.fixed_step > 0 || settings.sample_every > 0)
    throw std::invalid_argument("trajectories in lanes have no constant step and no samples");
  EnsembleWork work(ensemble, settings);
  const auto start = Clock::now();
  work.on_threads(jobs, kernel.lanes, [&] {
    std::unique_lock lock(exact_constants_guard());
    Feed feed(work, kernel, invariants);
    lock.unlock();
    casimir_ensemble run = {};
    run.t_end = settings.duration;
    run.rtol = settings.rtol;
    run.max_steps = settings.max_steps;
    run.next = Feed::next;
    run.done = Feed::done;
    run.give_up = Feed::give_up;
    run.look = feed.looks() ? Feed::look : nullptr;
    run.source = &feed;
    for (std::size_t share = 0; share < work.shares(); ++share) {
      feed.take_from(share);
      run.atol = work.atol(share);
      kernel.run(&run);
    }
    lock.lock();  // until the feed is gone
  });
  work.result.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return std::move(work.result);
}

EnsembleResult integrate_members(const Ensemble& ensemble,
                                 const std::function<Module()>& module_for_thread,
                                 const Method& method, const Program& invariants,
                                 const Settings& settings, int jobs) {
  EnsembleWork work(ensemble, settings);
  const auto start = Clock::now();
  work.on_threads(jobs, 1, [&] {
    const Module module = module_for_thread();
    std::unique_lock lock(exact_constants_guard());
    EndCheck check(ensemble, invariants);
    lock.unlock();
    unsigned calls = 0;
    Settings own = settings;
    own.monitor = false;
    own.invariant_terms = nullptr;
    own.invariants = nullptr;
    own.give_up = [&] { return work.give_up(calls); };
    for (std::size_t share = 0; share < work.shares(); ++share) {
      own.atol = work.atol(share);
      for (long long next; (next = work.next(share)) >= 0;) {
        const auto member = static_cast<std::size_t>(next);
        const double *const x = ensemble.state(member), *const p = ensemble.values_of(member);
        const Trajectory trajectory =
            integrate(module, method, own, {x, x + ensemble.states}, {p, p + ensemble.parameters});
        MemberResult& result = work.result.members[member];
        result = {trajectory.status, trajectory.time,    trajectory.state, {},
                  trajectory.steps,  trajectory.rejected};
        check(member, result);
      }
    }
    lock.lock();  // until the check is gone
  });
  work.result.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return std::move(work.result);
}

}  // namespace casimir
