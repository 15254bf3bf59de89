#include "tools/cli/search_watch.hpp"

#include <fmt/format.h>

#include <unistd.h>

#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>
#include <thread>

#include "tools/cli/errors.hpp"
#include "tools/cli/json_output.hpp"

namespace casimir::tools {
namespace {

/// What is said where there is no result.
std::string undecided_text(const Common& common, const std::string& case_name,
                           const std::string& reason, double seconds) {
  if (common.quiet && !common.json) return {};
  if (!common.json) return fmt::format("undecided: {}\n", reason);
  return json_text({{"case", case_name},
                    {"verdict", "undecided"},
                    {"integrals", nlohmann::ordered_json::array()},
                    {"reason", reason},
                    {"seconds", seconds}});
}

}  // namespace

SearchWatch::SearchWatch(const Common& common, const std::string& case_name, double memory)
    : progress_(!common.json && !common.quiet), done_(std::make_shared<std::atomic<bool>>(false)) {
  if (common.time_limit > 0) {
    // Exact algebra cannot be asked to stop in the middle of a product: where no tick comes for so
    // long after the limit, the program ends. Nothing was printed or written before.
    constexpr double kGrace = 0.5;
    const auto limit = std::chrono::duration<double>(common.time_limit + kGrace);
    std::thread([done = done_, limit,
                 text = undecided_text(common, case_name, search::TimeUp().what(),
                                       common.time_limit)] {
      std::this_thread::sleep_for(limit);
      if (done->exchange(true)) return;
      std::fputs(text.c_str(), stdout);
      std::fflush(stdout);
      _exit(kUndecided);
    }).detach();
  }
  watch_.memory_limit = memory;
  watch_.begin = [this, case_name](const std::string& what) {
    step_ = fmt::format("{}: {}", case_name, what);
    begun_ = false;
  };
  watch_.tick = [this, limit = common.time_limit](double share) {
    const double seconds = spent();
    if (limit > 0 && seconds > limit) throw search::TimeUp();
    if (seconds < 1) return;
    if (!begun_) progress_.begin(step_);
    begun_ = true;
    progress_.show(share);
  };
}

SearchWatch::~SearchWatch() { end(); }

double SearchWatch::end() {
  // Where the thread was faster, it ends the program.
  if (!ended_ && done_->exchange(true)) std::this_thread::sleep_for(std::chrono::seconds(60));
  ended_ = true;
  return spent();
}

int with_search_errors(const Common& common, const std::string& case_name,
                       const std::function<int()>& work) {
  const auto start = std::chrono::steady_clock::now();
  try {
    return work();
  } catch (const search::TooMuchMemory& problem) {
    throw SystemError(
        fmt::format("{}\n  hint: a lower --degree, numbers for parameters (--param), or a higher "
                    "--memory-limit",
                    problem.what()));
  } catch (const search::NoAnswer& problem) {
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
    std::cout << undecided_text(common, case_name, problem.what(), spent.count());
    return kUndecided;
  }
}

}  // namespace casimir::tools
