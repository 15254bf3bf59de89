#pragma once

#include <bit>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include "symbolic/error.hpp"

namespace casimir::discrete {

/// The minors of the first k rows, for k up to all rows, by the set of their columns: Laplace's
/// expansion along the last row. Without divisions, and every minor is computed once.
/// \param product  of an entry and a minor
/// \throws TooLarge
template <class Entry, class Product>
std::map<unsigned, Entry> maximal_minors(const std::vector<std::vector<Entry>>& rows,
                                         const Entry& one, const Product& product) {
  const std::size_t columns = rows.empty() ? 0 : rows.front().size();
  constexpr std::size_t kMostColumns = 13;
  if (columns > kMostColumns) throw TooLarge("a determinant has more than twelve rows");
  std::map<unsigned, Entry> minors{{0U, one}};
  for (const auto& row : rows) {
    std::map<unsigned, Entry> larger;
    for (const auto& [set, minor] : minors) {
      for (std::size_t c = 0; c < columns; ++c) {
        if ((set >> c & 1U) != 0 || row[c].is_zero() || minor.is_zero()) continue;
        // The sign of the place that the new column takes among the others.
        const bool odd = std::popcount(set >> c) % 2 == 1;
        Entry term = product(row[c], minor);
        if (odd) term = -term;
        const auto [place, inserted] = larger.try_emplace(set | 1U << c, term);
        if (!inserted) place->second += term;
      }
    }
    minors = std::move(larger);
  }
  return minors;
}

}  // namespace casimir::discrete
