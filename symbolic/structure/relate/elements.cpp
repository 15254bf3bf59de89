#include "symbolic/structure/relate/elements.hpp"

#include <algorithm>
#include <cstdlib>

#include "symbolic/structure/relate/invariants.hpp"
#include "symbolic/structure/relate/linear_family.hpp"

namespace casimir::structure {

ElementSide::ElementSide(const LinearCase& c) : constants_(structure_constants(c)) {
  for (auto& [name, space] : characteristic_subspaces(constants_))
    subspaces_.push_back(std::move(space));
}

Element ElementSide::fingerprint(const Element& v) const {
  Element result;
  const RationalMatrix ad = adjoint(constants_, v);
  RationalMatrix power = ad;
  for (std::size_t m = 1; m <= v.size(); ++m) {
    cln::cl_RA trace = 0;
    for (std::size_t i = 0; i < power.size(); ++i) trace = trace + power[i][i];
    result.push_back(trace);
    result.emplace_back(static_cast<long>(rank(power)));
    power = product(power, ad);
  }
  for (const RationalMatrix& space : subspaces_) {
    RationalMatrix with = space;
    with.push_back(v);
    result.emplace_back(rank(with) == space.size() ? 1 : 0);
  }
  return result;
}

bool ElementLess::operator()(const Element& a, const Element& b) const {
  return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(), NumberLess{});
}

cln::cl_RA value_of(const RationalMatrix& form, const Element& v) {
  cln::cl_RA sum = 0;
  for (std::size_t i = 0; i < v.size(); ++i)
    for (std::size_t j = 0; j < v.size() && !cln::zerop(v[i]); ++j)
      sum = sum + v[i] * form[i][j] * v[j];
  return sum;
}

std::vector<Element> small_elements(std::size_t n, int height) {
  std::vector<std::vector<int>> list{{}};
  for (std::size_t i = 0; i < n; ++i) {
    std::vector<std::vector<int>> longer;
    for (const auto& v : list) {
      for (int e = -height; e <= height; ++e) {
        longer.push_back(v);
        longer.back().push_back(e);
      }
    }
    list = std::move(longer);
  }
  const auto size = [](const std::vector<int>& v) {
    int sum = 0;
    for (const int e : v) sum += std::abs(e);
    return sum;
  };
  // Positive entries first among those of one size.
  std::stable_sort(list.begin(), list.end(), [&](const auto& a, const auto& b) {
    return std::pair(size(a), b) < std::pair(size(b), a);
  });
  std::vector<Element> result;
  for (const auto& v : list)
    if (size(v) > 0) result.emplace_back(v.begin(), v.end());
  return result;
}

}  // namespace casimir::structure
