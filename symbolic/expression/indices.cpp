#include "symbolic/expression/indices.hpp"

#include <algorithm>

namespace casimir {

std::string indexed_name(const std::string& family, const std::vector<long>& indices) {
  const bool short_ones = std::ranges::all_of(indices, [](long index) { return index < 10; });
  std::string name = family;
  for (std::size_t k = 0; k < indices.size(); ++k) {
    if (k > 0 && !short_ones) name += '_';
    name += std::to_string(indices[k]);
  }
  return name;
}

}  // namespace casimir
