#pragma once

#include <atomic>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <utility>
#include <vector>

#include "runtime/ensemble.hpp"
#include "runtime/program/angle_branches.hpp"
#include "runtime/program/interpreter.hpp"

namespace casimir {

/// Hands out the members of an ensemble to threads, and takes what came of them.
class EnsembleWork {
 public:
  EnsembleWork(const Ensemble& ensemble, const Settings& settings);

  /// How many absolute tolerances the members have.
  std::size_t shares() const { return shares_.size(); }

  /// The absolute tolerance of a share.
  double atol(std::size_t share) const { return shares_[share].atol; }

  /// The next member of a share that nobody has, or -1.
  long long next(std::size_t share);

  /// Whether all shall end: asks the settings now and then.
  bool give_up(unsigned& calls);

  /// Runs `worker` on `jobs` threads (0: one for each processor, never more than members / `lanes`
  /// rounded up) and rethrows the first exception of any.
  void on_threads(int jobs, int lanes, const std::function<void()>& worker);

  const Ensemble& ensemble() const { return ensemble_; }
  EnsembleResult result;

 private:
  /// The members of one absolute tolerance, in their order.
  struct Share {
    Share(double tolerance, std::vector<std::size_t> who)
        : atol(tolerance), members(std::move(who)) {}
    double atol;
    std::vector<std::size_t> members;
    std::atomic<std::size_t> next = 0;
  };

  void fail(std::exception_ptr problem);

  const Ensemble& ensemble_;
  const Settings& settings_;
  std::deque<Share> shares_;
  std::atomic<bool> stop_ = false;
  std::mutex guard_;
  std::exception_ptr problem_;
};

/// Exact constants of programs count their references without locks: who makes, copies, destroys or
/// evaluates one in a thread holds this.
std::mutex& exact_constants_guard();

/// Compares the invariants of a member at its start and its end. One for each thread, made and
/// destroyed under `exact_constants_guard`, which it takes itself when it compares.
class EndCheck {
 public:
  EndCheck(const Ensemble& ensemble, const Program& invariants);
  void operator()(std::size_t member, MemberResult& result);

 private:
  void evaluate_at(std::size_t member, const double* state, double time,
                   std::vector<double>& values);
  void put_on_one_branch(const std::vector<long double>& start);

  const Ensemble& ensemble_;
  const Program& program_;
  Interpreter invariants_;
  std::vector<Angle> angles_;
  std::vector<double> inputs_, first_, last_, sizes_;
};

}  // namespace casimir
