#include "symbolic/structure/relate/normal_basis.hpp"

#include <optional>

namespace casimir::structure {

using cln::cl_RA;
using LinearFunction = std::vector<cl_RA>;

RationalMatrix normal_basis(const RationalMatrix& skew) {
  const std::size_t n = skew.size();
  // Rows of the basis: linear functions; `left` are those that are not used yet.
  RationalMatrix left(n, LinearFunction(n, 0)), pairs;
  for (std::size_t i = 0; i < n; ++i) left[i][i] = 1;
  const auto bracket = [&](const LinearFunction& u, const LinearFunction& v) {
    cl_RA sum = 0;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) sum = sum + u[i] * skew[i][j] * v[j];
    return sum;
  };
  for (;;) {
    std::optional<std::pair<std::size_t, std::size_t>> found;
    for (std::size_t i = 0; i < left.size() && !found; ++i)
      for (std::size_t j = i + 1; j < left.size() && !found; ++j)
        if (!cln::zerop(bracket(left[i], left[j]))) found.emplace(i, j);
    if (!found) break;
    const LinearFunction q = left[found->first];
    LinearFunction p = left[found->second];
    const cl_RA size = bracket(q, p);
    for (cl_RA& e : p) e = e / size;
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(found->second));
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(found->first));
    for (LinearFunction& v : left) {
      const cl_RA along_q = bracket(v, p), along_p = bracket(q, v);
      for (std::size_t k = 0; k < n; ++k) v[k] = v[k] - along_q * q[k] - along_p * p[k];
    }
    pairs.push_back(q);
    pairs.push_back(p);
  }
  for (LinearFunction& v : left) pairs.push_back(std::move(v));
  return pairs;
}

}  // namespace casimir::structure
