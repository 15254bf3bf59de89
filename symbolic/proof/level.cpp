#include "symbolic/proof/level.hpp"

#include <algorithm>
#include <map>
#include <optional>

namespace casimir {
namespace {

using IndexPairs = std::vector<std::pair<std::size_t, std::size_t>>;  ///< coordinates i <= j

/// A relation sum x_i x_j = constant: each pair once, all with one coefficient.
struct ScalarProduct {
  IndexPairs pairs;
  Polynomial constant;
};

std::optional<ScalarProduct> scalar_product(const Polynomial& relation, std::size_t coordinates) {
  ScalarProduct result{{}, Polynomial(relation.ring())};
  std::optional<cln::cl_RA> scale;
  for (const auto& [coefficient, exponents] : relation.term_list()) {
    std::vector<std::size_t> factors;
    for (std::size_t i = 0; i < coordinates; ++i) {
      for (unsigned long k = 0; k < exponents[i]; ++k) factors.push_back(i);
    }
    const bool others = std::any_of(exponents.begin() + static_cast<std::ptrdiff_t>(coordinates),
                                    exponents.end(), [](unsigned long e) { return e > 0; });
    if (factors.empty()) {
      Polynomial term = relation.ring().constant(-coefficient);
      for (std::size_t i = coordinates; i < exponents.size(); ++i) {
        if (exponents[i] > 0) term *= relation.ring().variable(i).pow(exponents[i]);
      }
      result.constant += term;
      continue;
    }
    if (factors.size() != 2 || others || (scale && *scale != coefficient)) return std::nullopt;
    scale = coefficient;
    result.pairs.emplace_back(factors[0], factors[1]);
  }
  if (!scale || result.pairs.size() < 2) return std::nullopt;
  result.constant = result.constant.scaled(1 / *scale);
  return result;
}

bool is_square(const IndexPairs& pairs) {
  return std::all_of(pairs.begin(), pairs.end(), [](const auto& p) { return p.first == p.second; });
}

/// The coordinates that the pairs put beside those of `vector`, in its order.
std::optional<std::vector<std::size_t>> partner(const IndexPairs& pairs,
                                                const std::vector<std::size_t>& vector) {
  std::map<std::size_t, std::size_t> beside;
  for (const auto& [i, j] : pairs) {
    beside[i] = j;
    beside[j] = i;
  }
  std::vector<std::size_t> result;
  for (const std::size_t i : vector) {
    if (!beside.contains(i)) return std::nullopt;
    result.push_back(beside[i]);
  }
  return pairs.size() == vector.size() ? std::optional(result) : std::nullopt;
}

}  // namespace

std::vector<OrthogonalVectors> orthogonal_vectors(const std::vector<Polynomial>& relations,
                                                  std::size_t coordinates) {
  std::vector<OrthogonalVectors> groups;
  std::vector<ScalarProduct> mixed;
  for (const Polynomial& relation : relations) {
    const auto found = scalar_product(relation, coordinates);
    if (!found) continue;
    if (!is_square(found->pairs)) {
      if (found->constant.is_zero()) mixed.push_back(*found);
      continue;
    }
    std::vector<std::size_t> vector;
    for (const auto& [i, j] : found->pairs) vector.push_back(i);
    std::sort(vector.begin(), vector.end());
    groups.push_back({{vector}, {found->constant}});
  }
  // Two groups with an orthogonality between them become one.
  for (const ScalarProduct& product : mixed) {
    for (std::size_t a = 0; a < groups.size(); ++a) {
      for (std::size_t b = a + 1; b < groups.size(); ++b) {
        const auto linked = std::find_if(
            groups[b].vectors.begin(), groups[b].vectors.end(), [&](const auto& candidate) {
              return std::any_of(
                  groups[a].vectors.begin(), groups[a].vectors.end(), [&](const auto& v) {
                    auto w = partner(product.pairs, v);
                    return w && std::is_permutation(w->begin(), w->end(), candidate.begin(),
                                                    candidate.end());
                  });
            });
        if (linked == groups[b].vectors.end()) continue;
        groups[a].vectors.insert(groups[a].vectors.end(), groups[b].vectors.begin(),
                                 groups[b].vectors.end());
        groups[a].squared_lengths.insert(groups[a].squared_lengths.end(),
                                         groups[b].squared_lengths.begin(),
                                         groups[b].squared_lengths.end());
        groups.erase(groups.begin() + static_cast<std::ptrdiff_t>(b));
        --b;
      }
    }
  }
  // More vectors than dimensions, or a coordinate used twice, are no such frame.
  std::erase_if(groups, [](const OrthogonalVectors& group) {
    std::vector<std::size_t> all;
    for (const auto& v : group.vectors) {
      if (v.size() != group.vectors[0].size()) return true;
      all.insert(all.end(), v.begin(), v.end());
    }
    std::sort(all.begin(), all.end());
    return group.vectors.size() > group.vectors[0].size() ||
           std::adjacent_find(all.begin(), all.end()) != all.end();
  });
  return groups;
}

}  // namespace casimir
