#include "tools/cli/watched_run.hpp"

#include <cmath>

#include "tools/cli/output.hpp"

namespace casimir::tools {

WatchedRun::WatchedRun(Settings& settings, bool show, bool keeps) : keeps_(keeps), progress_(show) {
  if (keeps) {
    hold_interrupts(true);
    settings.give_up = [limit = settings.give_up] {
      return interrupt_held() || (limit && limit());
    };
  }
  if (!progress_.visible()) return;
  settings.progress = [this, duration = std::abs(settings.duration)](double t) {
    // Asking for the time takes as long as a step of a small system.
    constexpr unsigned long long kBetween = 256;
    if (++calls_ % kBetween != 0) return;
    if (!begun_ && Clock::now() - start_ > std::chrono::seconds(1)) {
      begun_ = true;
      progress_.begin("integrating");
    }
    if (begun_) progress_.show(std::abs(t) / duration);
  };
}

WatchedRun::~WatchedRun() {
  if (keeps_) hold_interrupts(false);
}

bool WatchedRun::interrupted() const { return keeps_ && interrupt_held(); }

}  // namespace casimir::tools
