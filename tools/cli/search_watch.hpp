#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <string>

#include "symbolic/search/watch.hpp"
#include "tools/cli/cli.hpp"
#include "tools/cli/progress.hpp"

namespace casimir::tools {

/// The time limit of a search, its limit of memory, and the bar that a person sees of it from the
/// second second on.
class SearchWatch {
 public:
  /// \param memory  bytes
  SearchWatch(const Common& common, const std::string& case_name, double memory = 2e9);
  ~SearchWatch();
  SearchWatch(const SearchWatch&) = delete;
  SearchWatch& operator=(const SearchWatch&) = delete;

  const search::Watch& watch() const { return watch_; }
  /// Seconds since the beginning; the bar is gone.
  double end();

 private:
  using Clock = std::chrono::steady_clock;
  double spent() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

  Clock::time_point start_ = Clock::now();
  Progress progress_;
  search::Watch watch_;
  std::string step_;
  bool begun_ = false, ended_ = false;
  std::shared_ptr<std::atomic<bool>> done_;  ///< or the time is up: shared with what waits for that
};

/// Runs a search; where it ends without an answer it says why, also as JSON, and returns
/// kUndecided.
/// \throws SystemError  with advice, where it would take too much memory.
int with_search_errors(const Common& common, const std::string& case_name,
                       const std::function<int()>& work);

}  // namespace casimir::tools
