#include "tools/cli/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace casimir::tools {

Progress::Progress(bool wanted) : visible_(wanted && isatty(STDERR_FILENO) != 0) {}

Progress::~Progress() {
  if (drawn_once_) fmt::print(stderr, "\r\033[K");
}

void Progress::begin(const std::string& what) {
  what_ = what;
  start_ = Clock::now();
  draw(0);
}

void Progress::show(double share) {
  constexpr auto kBetween = std::chrono::milliseconds(100);
  if (visible_ && Clock::now() - drawn_ >= kBetween) draw(share);
}

void Progress::draw(double share) {
  if (!visible_) return;
  drawn_once_ = true;
  drawn_ = Clock::now();
  constexpr int kWidth = 24;
  const int full = static_cast<int>(share * kWidth);
  const double spent = std::chrono::duration<double>(drawn_ - start_).count();
  constexpr double kEnough = 0.05;  // of the work, to say how long the rest takes
  std::string left;
  if (share >= kEnough) left = fmt::format(", {:.0f} s left", spent * (1 - share) / share);
  fmt::print(stderr, "\r\033[K[{:#<{}}{:.<{}}] {:3.0f} %  {}{}", "", full, "", kWidth - full,
             100 * share, what_, left);
  std::fflush(stderr);
}

}  // namespace casimir::tools
