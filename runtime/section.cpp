// Poincare sections: orbits in the lanes of registers, and their crossings of a surface.
#include "runtime/section.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <bitset>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <mutex>
#include <new>
#include <optional>
#include <stdexcept>
#include <thread>

#include "runtime/ensemble/ensemble_work.hpp"
#include "runtime/ensemble/lane_look.hpp"
#include "runtime/ensemble/part_of_step.hpp"
#include "runtime/section/plane_watch.hpp"
#include "runtime/section/section_orbit.hpp"
#include "runtime/taylor/jet_layout.hpp"

namespace casimir {
namespace {

using Clock = std::chrono::steady_clock;

/// For ever; orbits end when they have crossed often enough.
constexpr double kEndOfTime = 1e15;

/// The series of the function has converged where its last two terms are not larger. The zeros of
/// it are then made exact; see RunningOrbit.
constexpr double kTail = 1e-10;
/// How short a part of a step may become, and how many there may be of one step.
constexpr std::int64_t kMostParts = std::int64_t{1} << 40;
constexpr int kMostPartsOfStep = 4096;

constexpr std::size_t kMostLanes = 8;
using Lanes = std::bitset<kMostLanes>;

/// What the threads share.
struct Cutting {
  EnsembleWork& work;
  const LaneKernel& kernel;
  const SectionSettings& settings;
  const PlaneOfOrbit& plane;
  const JetLayout& layout;
  std::optional<StepWatch> plane_watch;
  std::vector<double> numbers;  ///< what the kernel wants of every orbit
  std::vector<RunningOrbit> orbits;
  std::atomic<std::size_t> found = 0;
  std::thread::id caller = std::this_thread::get_id();
};

/// Worked out here and not by the threads: exact numbers count their references without locks.
std::vector<double> numbers_of(const LaneKernel& kernel) {
  std::vector<double> numbers(kernel.numbers.outputs.size());
  const double none = 0;
  if (!numbers.empty()) Interpreter(kernel.numbers)(&none, numbers.data());
  return numbers;
}

struct AlignedDelete {
  void operator()(double* memory) const { ::operator delete[](memory, std::align_val_t(64)); }
};

/// What one thread gives to a kernel and takes from it, behind the plain C interface.
class Cutter {
 public:
  explicit Cutter(Cutting& shared)
      : shared_(shared),
        tables_(shared.layout.tables()),
        kernel_(jet_kernel(shared.kernel.lanes)),
        memory_(new (std::align_val_t(64)) double[static_cast<std::size_t>(
            tables_.rows * (CASIMIR_MOST_JET_ORDER + 1) * shared.kernel.lanes)]) {
    const std::lock_guard lock(exact_constants_guard());
    const auto looks = [&](const StepWatch& watch) {
      return LaneLook(watch, shared.work.ensemble().states, shared.kernel.lanes,
                      [](long long) { return nullptr; });
    };
    if (shared.kernel.watch) look_.emplace(looks(*shared.kernel.watch)).end_before_poles();
    if (shared.plane_watch) plane_look_.emplace(looks(*shared.plane_watch));
  }

  void run() {
    casimir_ensemble request = {};
    request.t_end = kEndOfTime;
    request.rtol = shared_.settings.rtol;
    request.atol = shared_.settings.atol;
    request.next = [](void* self, double* x, const double** numbers) {
      return static_cast<Cutter*>(self)->next(x, numbers);
    };
    request.done = [](void* self, long long member, const double* x,
                      const casimir_outcome* outcome) {
      static_cast<Cutter*>(self)->done(static_cast<std::size_t>(member), x, *outcome);
    };
    request.give_up = [](void* self) { return static_cast<Cutter*>(self)->give_up() ? 1 : 0; };
    request.observe = [](void* self, const casimir_lane_step* step) {
      static_cast<Cutter*>(self)->observe(*step);
    };
    if (look_)
      request.look = [](void* self, const casimir_lane_step* trial, double* parts) {
        (*static_cast<Cutter*>(self)->look_)(*trial, parts);
      };
    request.source = this;
    // Once there is no new orbit a kernel asks for none: those that are to go on then wait.
    do shared_.kernel.run(&request);
    while (!again_.empty() && !shared_.work.give_up(calls_));
  }

 private:
  long long next(double* x, const double** numbers) {
    long long member = -1;
    if (!again_.empty()) {
      member = again_.back();
      again_.pop_back();
    } else {
      member = shared_.work.next(0);
    }
    if (member < 0) return member;
    const RunningOrbit& orbit = shared_.orbits[static_cast<std::size_t>(member)];
    std::copy(orbit.start().begin(), orbit.start().end(), x);
    *numbers = shared_.numbers.data();
    return member;
  }

  void observe(const casimir_lane_step& step) {
    kernel_(&tables_, &step, memory_.get(), &range_);
    Lanes in_parts{};
    for (int lane = 0; lane < step.lanes; ++lane) {
      if (!step.held[lane] || step.member[lane] < 0) continue;
      if (is_fine(step, lane))
        step.finished[lane] = see(step, lane) ? -1 : 0;
      else
        in_parts.set(static_cast<std::size_t>(lane));
    }
    if (in_parts.none()) return;
    parts_left_.fill(kMostPartsOfStep);
    const Lanes enough = see_in_parts(step, in_parts, 0, 1);
    for (std::size_t lane = 0; lane < in_parts.size(); ++lane)
      if (in_parts[lane]) step.finished[lane] = enough[lane] ? -1 : 0;
  }

  /// Whether the series that the kernel has worked on is the function of the plane all along the
  /// step.
  bool is_fine(const casimir_lane_step& step, int lane) {
    return range_.tail[lane] <= kTail && (!plane_look_ || plane_look_->of_lane(step, lane) >= 1);
  }

  /// Both halves of a part of a step, in halves themselves as often as the series of the function
  /// needs it in one of these lanes. What is done to a lane does not depend on the others. Those
  /// whose orbits have seen enough.
  Lanes see_in_parts(const casimir_lane_step& whole, Lanes lanes, std::int64_t which,
                     std::int64_t parts) {
    Lanes enough{};
    for (std::int64_t half = 2 * which; half < 2 * which + 2; ++half) {
      // One at a time: its step is that of the next as well.
      const casimir_lane_step& step = part_.take(whole, half, 2 * parts);
      kernel_(&tables_, &step, memory_.get(), &range_);
      Lanes halved{};
      for (std::size_t k = 0; k < lanes.size(); ++k) {
        if (!lanes[k]) continue;
        const int lane = static_cast<int>(k);
        const bool given_up = --parts_left_[k] < 0 || !std::isfinite(range_.tail[lane]);
        if (given_up) shared_.orbits[static_cast<std::size_t>(whole.member[lane])].doubt();
        if (given_up || is_fine(step, lane))
          enough[k] = see(step, lane);
        else
          halved.set(k);
      }
      // Where they are as short as they may be it is about a corner: the next part begins behind
      // it.
      if (halved.any() && 2 * parts < kMostParts)
        enough |= see_in_parts(whole, halved, half, 2 * parts);
      lanes &= ~enough;
      if (lanes.none()) break;
    }
    return enough;
  }

  /// Shows the step that the kernel has worked on to the orbit in a lane. Whether it has seen
  /// enough.
  bool see(const casimir_lane_step& step, int lane) {
    const double* const series =
        memory_.get() + static_cast<std::ptrdiff_t>(tables_.line[tables_.lines - 1].row) *
                            (CASIMIR_MOST_JET_ORDER + 1) * step.lanes;
    RunningOrbit& orbit = shared_.orbits[static_cast<std::size_t>(step.member[lane])];
    const std::size_t before = orbit.found();
    const bool enough =
        orbit.see(LaneOfStep{step, lane, series, range_}, shared_.plane, shared_.settings);
    if (orbit.found() > before) shared_.found += orbit.found() - before;
    return enough;
  }

  void done(std::size_t member, const double* x, const casimir_outcome& outcome) {
    if (shared_.orbits[member].leave(x, outcome, shared_.settings))
      again_.push_back(static_cast<long long>(member));
  }

  bool give_up() {
    const SectionSettings& settings = shared_.settings;
    if (settings.progress && std::this_thread::get_id() == shared_.caller && calls_ % 256 == 0) {
      const auto all = static_cast<double>(shared_.orbits.size() * settings.points);
      settings.progress(static_cast<double>(shared_.found) / std::max(all, 1.));
    }
    return shared_.work.give_up(calls_);
  }

  Cutting& shared_;
  const casimir_jet_tables tables_;
  casimir_jet_kernel* const kernel_;
  const std::unique_ptr<double[], AlignedDelete> memory_;
  casimir_jet_range range_ = {};
  PartOfStep part_;
  std::array<int, kMostLanes> parts_left_{};  ///< of the step, in each lane
  std::optional<LaneLook> look_, plane_look_;
  std::vector<long long> again_;
  unsigned calls_ = 0;
};

}  // namespace

SectionResult cut(const LaneKernel& kernel, const SectionPlane& plane,
                  const std::vector<double>& seeds, std::size_t seed_size,
                  const SectionSettings& settings) {
  Settings run;
  run.duration = kEndOfTime;
  run.rtol = settings.rtol;
  run.atol = settings.atol;
  run.give_up = settings.give_up;
  check_settings(run, *find_method("taylor"));
  Ensemble ensemble;
  ensemble.states = seed_size;
  ensemble.initial = seeds;
  EnsembleWork work(ensemble, run);
  const JetLayout layout = jet_layout(plane.function, settings.states);
  const PlaneOfOrbit place{plane.upwards, plane.period, layout, settings.states};
  Cutting shared{.work = work,
                 .kernel = kernel,
                 .settings = settings,
                 .plane = place,
                 .layout = layout,
                 .plane_watch = watch_of_plane(plane.function, settings.states, seed_size),
                 .numbers = numbers_of(kernel),
                 .orbits = {}};
  for (std::size_t i = 0; i < ensemble.size(); ++i)
    shared.orbits.emplace_back(
        std::vector<double>(ensemble.state(i), ensemble.state(i) + seed_size));
  const auto start = Clock::now();
  work.on_threads(settings.jobs, kernel.lanes, [&] { Cutter(shared).run(); });
  SectionResult result;
  result.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  result.jobs = work.result.jobs;
  for (RunningOrbit& orbit : shared.orbits) result.orbits.push_back(std::move(orbit).result());
  return result;
}

}  // namespace casimir
