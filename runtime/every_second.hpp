#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace casimir {

/// Leaves the second, fourth, .. of a list whose first stands for the first step: of what was kept
/// at the end of every step, that of every second one.
template <class T>
void keep_every_second(std::vector<T>& list) {
  std::size_t kept = 0;
  for (std::size_t k = 1; k < list.size(); k += 2, ++kept) std::swap(list[kept], list[k]);
  list.resize(kept);
}

}  // namespace casimir
