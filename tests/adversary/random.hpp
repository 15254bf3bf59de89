#pragma once

#include <cstdint>
#include <random>
#include <vector>

namespace casimir::adversary {

/// Random choices that are the same on every machine: a standard distribution need not be.
class Random {
 public:
  /// \param index  of the claim: each has choices of its own, so that any can be made alone.
  Random(std::uint64_t seed, std::uint64_t index)
      : engine_(seed * 0x9E3779B97F4A7C15ULL ^ (index + 1) * 0xD1B54A32D192ED03ULL) {}

  /// From 0 to count - 1.
  int operator()(int count) {
    return static_cast<int>(engine_() % static_cast<std::uint64_t>(count));
  }
  /// From least to most.
  int between(int least, int most) { return least + (*this)(most - least + 1); }
  bool one_in(int count) { return (*this)(count) == 0; }
  template <typename T>
  const T& of(const std::vector<T>& list) {
    return list[static_cast<std::size_t>((*this)(static_cast<int>(list.size())))];
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace casimir::adversary
