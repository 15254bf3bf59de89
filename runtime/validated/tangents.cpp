#include "runtime/validated/tangents.hpp"

#include <cmath>

// Compiled for wide registers too, and chosen when the program is loaded. Where these fuse products
// and sums, the radii are others than elsewhere; both are right.
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && defined(__linux__) && \
    !defined(__SANITIZE_ADDRESS__)
#define CASIMIR_FOR_WIDE_REGISTERS __attribute__((target_clones("arch=haswell", "default")))
#else
#define CASIMIR_FOR_WIDE_REGISTERS
#endif

namespace casimir::validated {
namespace {

constexpr std::size_t kLanes = kTangentLanes;

/// One row of V_{k+1} = (1 / (k + 1)) sum over the entries e of the row and j = 0..k of
/// J_e,j V_{k-j}. The terms are added for falling j to one sum: with E entries in the row the terms
/// with j pass at most E (j + 1) additions and one product. So the midpoint is off by at most
/// (E (j + 1) + 2) u |J V| for each, as in Arithmetic<MidRad>::convolution, and the radius passes
/// at most E (k + 1) + 8 roundings, which `upwards` covers below 480: more are covered by the
/// factor `more`.
CASIMIR_FOR_WIDE_REGISTERS
void next_row(const std::vector<TangentEntry>& row, const TangentLanes* known, std::size_t n,
              std::size_t k, bool forwards, TangentLanes& result) {
  double mid[kLanes] = {}, rad[kLanes] = {};
  const auto entries = static_cast<double>(row.size());
  for (std::size_t j = k + 1; j-- > 0;) {
    const double roundings = kUnit * (entries * static_cast<double>(j + 1) + 3);
    for (const TangentEntry& entry : row) {
      const MidRad& factor = entry.series[j];
      if (factor.mid == 0 && factor.rad == 0) continue;
      const double middle = factor.mid, size = std::abs(middle) + kUnderflow;
      const double noise = factor.rad + roundings * size;
      const TangentLanes& other = known[(k - j) * n + entry.column];
      for (std::size_t l = 0; l < kLanes; ++l) mid[l] += middle * other.mid[l];
      for (std::size_t l = 0; l < kLanes; ++l)
        rad[l] += size * other.rad[l] + noise * other.reach[l];
    }
  }
  const double more = 1 + 4 * kUnit * entries * static_cast<double>(k + 1);
  const double divisor = static_cast<double>(k + 1) * (forwards ? 1 : -1);
  const double share = upwards(1 / static_cast<double>(k + 1)) * more;
  for (std::size_t l = 0; l < kLanes; ++l) {
    result.mid[l] = mid[l] / divisor;
    result.rad[l] = upwards(rad[l] * share + kUnit * std::abs(result.mid[l]));
    result.reach[l] = upwards(std::abs(result.mid[l]) + result.rad[l]);
  }
}

}  // namespace

Tangents<MidRad>::Tangents(Entries entries, std::size_t dimension, std::size_t order)
    : entries_(std::move(entries)),
      n_(dimension),
      order_(order),
      blocks_((dimension + kLanes - 1) / kLanes),
      rows_(dimension),
      lanes_(blocks_ * (order + 1) * dimension) {}

void Tangents<MidRad>::expand(const std::vector<const Series*>& jacobian, bool forwards) {
  for (auto& row : rows_) row.clear();
  for (std::size_t e = 0; e < entries_.size(); ++e)
    rows_[static_cast<std::size_t>(entries_[e].first)].push_back(
        {static_cast<std::size_t>(entries_[e].second), jacobian[e]->data()});
  for (std::size_t block = 0; block < blocks_; ++block) {
    for (std::size_t row = 0; row < n_; ++row) {
      TangentLanes& unit = at(block, 0, row);
      for (std::size_t l = 0; l < kLanes; ++l) {
        unit.mid[l] = unit.reach[l] = row == block * kLanes + l ? 1 : 0;
        unit.rad[l] = 0;
      }
    }
    for (std::size_t k = 0; k < order_; ++k)
      for (std::size_t row = 0; row < n_; ++row)
        next_row(rows_[row], &at(block, 0, 0), n_, k, forwards, at(block, k + 1, row));
  }
}

/// Horner's rule in balls: y <- y h + V_k, where the product and the sum round once each.
Matrix<MidRad> Tangents<MidRad>::at(const MidRad& h) const {
  Matrix<MidRad> result(n_, n_);
  const double step = h.mid, spread = h.rad, size = std::abs(h.mid) + h.rad;
  for (std::size_t block = 0; block < blocks_; ++block) {
    for (std::size_t row = 0; row < n_; ++row) {
      TangentLanes y = at(block, order_, row);
      for (std::size_t k = order_; k-- > 0;) {
        const TangentLanes& v = at(block, k, row);
        for (std::size_t l = 0; l < kLanes; ++l) {
          const double product = y.mid[l] * step, before = std::abs(y.mid[l]);
          y.mid[l] = product + v.mid[l];
          y.rad[l] = upwards(before * spread + y.rad[l] * size + v.rad[l] +
                             kUnit * (std::abs(product) + std::abs(y.mid[l])));
        }
      }
      for (std::size_t l = 0; l < kLanes && block * kLanes + l < n_; ++l)
        result(row, block * kLanes + l) = {y.mid[l], y.rad[l]};
    }
  }
  return result;
}

}  // namespace casimir::validated
