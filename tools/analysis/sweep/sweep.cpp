// The points are done in rounds: each rank takes every size-th of the next ones, rank 0 collects
// and keeps what came of them. Which rank does a point, and in which round, changes nothing in it.
#include "tools/analysis/sweep/sweep.hpp"

#include <algorithm>
#include <chrono>
#include <exception>
#include <map>
#include <optional>

#include "tools/analysis/proof/exact_text.hpp"
#include "tools/analysis/sweep/journal.hpp"

namespace casimir {
namespace {

using Clock = std::chrono::steady_clock;

/// A round shall take about this long: a kill loses no more.
constexpr double kRoundSeconds = 0.5;
constexpr std::size_t kFirstRound = 64, kLongestRound = 1 << 16;

class Sweep {
 public:
  Sweep(const SweepTask& task, const Ranks& ranks, const SweepOptions& options)
      : task_(task),
        ranks_(ranks),
        options_(options),
        columns_(task.columns().size()),
        points_(task.places().count()) {}

  /// In the rank that speaks. \throws RequestError, EnvironmentError
  void open_journal() {
    journal_.emplace(options_.output, digest(task_.fingerprint() + task_.places().fingerprint()),
                     columns_, options_.restart);
  }

  SweepOutcome run(const std::function<void(const std::vector<PointResult>&)>& finish) {
    find_open_points();
    std::size_t next = 0, round = kFirstRound;
    while (agree_on_round(next, round)) {
      const auto start = Clock::now();
      const std::size_t end = std::min(open_.size(), next + round);
      together([&] { keep(ranks_.gather(own_share(next, end))); });
      next = end;
      adapt(round, std::chrono::duration<double>(Clock::now() - start).count());
    }
    SweepOutcome outcome;
    outcome.complete = all_done_;
    if (!ranks_.speaks()) return outcome;
    outcome.points = points_;
    outcome.resumed = points_ - open_.size();
    outcome.computed = journal_->done().size() - outcome.resumed;
    if (!all_done_) {
      outcome.journal = journal_->path();
      return outcome;
    }
    for (const auto& [point, result] : journal_->done()) outcome.rows.push_back(result);
    finish(outcome.rows);
    journal_->remove();
    return outcome;
  }

 private:
  /// What fails in one of several ranks ends them all: the others would wait for it for ever.
  void together(const std::function<void()>& work) const {
    try {
      work();
    } catch (const std::exception& problem) {
      if (ranks_.size() > 1) ranks_.end_all(problem);
      throw;
    }
  }

  void find_open_points() {
    if (ranks_.speaks()) {
      const auto& done = journal_->done();
      for (unsigned long long point = 0; point < points_; ++point)
        if (!done.contains(point)) open_.push_back(point);
    }
    ranks_.broadcast(open_);
  }

  /// Whether there is another round, and how many points it has: what rank 0 says.
  bool agree_on_round(std::size_t next, std::size_t& round) {
    const bool done = next >= open_.size();
    const bool ended = stopped_ || (options_.give_up && options_.give_up());
    std::vector<unsigned long long> said{done || ended ? 0ULL : round,
                                         done && !stopped_ ? 1ULL : 0};
    ranks_.broadcast(said);
    round = said[0];
    all_done_ = said[1] == 1;
    return round > 0;
  }

  void adapt(std::size_t& round, double seconds) const {
    if (seconds < kRoundSeconds / 2 && round < kLongestRound) round *= 2;
    if (seconds > kRoundSeconds * 2 && round > kFirstRound) round /= 2;
  }

  /// Point, status and values of each point of this rank, one after the other.
  std::vector<double> own_share(std::size_t begin, std::size_t end) const {
    std::vector<std::size_t> points;
    for (std::size_t i = begin + static_cast<std::size_t>(ranks_.rank()); i < end;
         i += static_cast<std::size_t>(ranks_.size()))
      points.push_back(open_[i]);
    if (points.empty()) return {};
    const int threads = options_.threads > 0 ? options_.threads : ranks_.processors();
    const std::vector<PointResult> results = task_.run(points, threads, options_.give_up);
    std::vector<double> numbers;
    for (std::size_t i = 0; i < points.size(); ++i) {
      numbers.push_back(static_cast<double>(points[i]));
      numbers.push_back(static_cast<double>(results[i].status));
      numbers.insert(numbers.end(), results[i].values.begin(), results[i].values.end());
    }
    return numbers;
  }

  void keep(const std::vector<double>& numbers) {
    if (!ranks_.speaks()) return;
    std::map<std::size_t, PointResult> results;
    const std::size_t width = columns_ + 2;
    for (std::size_t at = 0; at + width <= numbers.size(); at += width) {
      PointResult result{static_cast<Status>(numbers[at + 1]), {}};
      result.values.assign(numbers.begin() + static_cast<std::ptrdiff_t>(at + 2),
                           numbers.begin() + static_cast<std::ptrdiff_t>(at + width));
      if (result.status == Status::stopped)
        stopped_ = true;  // by the time limit or the user: not done
      else
        results.emplace(static_cast<std::size_t>(numbers[at]), std::move(result));
    }
    journal_->append(results);
    if (options_.progress)
      options_.progress(static_cast<double>(journal_->done().size()) /
                        static_cast<double>(points_));
  }

  const SweepTask& task_;
  const Ranks& ranks_;
  const SweepOptions& options_;
  std::size_t columns_, points_;
  std::optional<Journal> journal_;        ///< of rank 0
  std::vector<unsigned long long> open_;  ///< points that are to be done
  bool stopped_ = false, all_done_ = false;
};

}  // namespace

SweepOutcome sweep_over(const SweepTask& task, const Ranks& ranks, const SweepOptions& options,
                        const std::function<void(const std::vector<PointResult>&)>& finish) {
  Sweep sweep(task, ranks, options);
  std::exception_ptr problem;
  if (ranks.speaks()) {
    try {
      sweep.open_journal();
    } catch (...) {
      problem = std::current_exception();
    }
  }
  if (ranks.largest(problem ? 1 : 0) > 0) {
    if (problem) std::rethrow_exception(problem);
    return {};
  }
  return sweep.run(finish);
}

}  // namespace casimir
