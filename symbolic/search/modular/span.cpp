#include "symbolic/search/modular/span.hpp"

#include <algorithm>

namespace casimir::search {

bool Span::reduce(std::vector<Residue>& vector) const {
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    const Residue factor = modulus_.negative(vector[pivots_[k]]);
    if (factor == 0) continue;
    for (std::size_t i = 0; i < vector.size(); ++i)
      vector[i] = modulus_.reduce(vector[i] + std::uint64_t{factor} * rows_[k][i]);
  }
  return std::any_of(vector.begin(), vector.end(), [](Residue r) { return r != 0; });
}

bool Span::insert(std::vector<Residue> vector) {
  if (!reduce(vector)) return false;
  const auto first = std::find_if(vector.begin(), vector.end(), [](Residue r) { return r != 0; });
  pivots_.push_back(static_cast<std::size_t>(first - vector.begin()));
  const Residue scale = modulus_.inverse(*first);
  for (Residue& r : vector) r = modulus_.multiply(r, scale);
  rows_.push_back(std::move(vector));
  return true;
}

}  // namespace casimir::search
