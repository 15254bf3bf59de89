#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <ctime>

#include "symbolic/case/limits.hpp"

/// What libFuzzer and tests/fuzz/replay.cpp call for each input. Whatever it throws, and whatever a
/// sanitizer sees, is an error.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace casimir::test {

#ifdef __OPTIMIZE__
inline constexpr double seconds_allowed = 1;
#else
inline constexpr double seconds_allowed = 5;  // with the sanitizers, about five times as long
#endif

/// Ends the process where one input takes more than `seconds_allowed` of the processor's time,
/// which unlike libFuzzer's -timeout does not count the time of others.
class OneSecond {
 public:
  OneSecond() : start_(now()) {}
  ~OneSecond() {
    if (now() - start_ > seconds_allowed) std::abort();
  }
  OneSecond(const OneSecond&) = delete;
  OneSecond& operator=(const OneSecond&) = delete;

 private:
  static double now() {
    std::timespec time = {};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }
  double start_;
};

/// The program's own limits allow work of seconds; many small inputs find more than few large ones.
inline Limits small_limits() {
  Limits small;
  small.variables = 12;
  small.parameters = 12;
  small.nesting = 40;
  small.depth = 100;
  small.degree = 40;
  small.bits = 2000;
  small.size = 2000;
  small.terms = 2000;
  return small;
}

}  // namespace casimir::test
