#include "runtime/validated/tangents.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "runtime/validated/wide_registers.hpp"

namespace casimir::validated {
namespace {

/// Columns that lie side by side: few for small systems.
constexpr std::size_t kFew = 4, kMany = 8;
using Quad = LanesOf<4>;

/// Some columns of all V_k.
struct Columns {
  const std::vector<std::vector<TangentEntry>>& rows;
  std::size_t n, order;
  bool forwards;
  double* values;  ///< the lanes of V_0, V_1, .., row by row
};

/// The row of V_{k+1} = (1 / (k + 1)) sum over the entries e of the row and j = 0..k of
/// J_e,j V_{k-j}. The terms of an entry are added for falling j to a sum of its own, and these to
/// one another: with E entries in the row the terms with j pass at most (j + 1) + E additions and
/// one product. So the midpoint is off by at most (j + E + 3) u |J V| for each, as in `product_of`
/// (the factors `noise` have (j + E + 3) u |J| beside the radius), and by u of itself for the
/// division. The radius passes at most k + E + 12 roundings, which `upwards` covers below 480: more
/// are covered by the factor `more`.
template <std::size_t kLanes>
CASIMIR_INLINE_ALWAYS void next_row(const Columns& columns, std::size_t row, std::size_t k) {
  constexpr std::size_t kQuads = kLanes / 4;
  const std::size_t stride = columns.n * 2 * kLanes;
  const std::vector<TangentEntry>& entries = columns.rows[row];
  Quad mid[kQuads]{}, rad[kQuads]{};
  for (const TangentEntry& entry : entries) {
    const std::size_t terms = std::min(entry.length, k + 1);
    if (terms == 0) continue;
    Quad part[kQuads]{};
    const TangentEntry::Factor* factor = entry.factors.data() + (terms - 1);
    const double* other = columns.values + (k + 1 - terms) * stride + entry.column * 2 * kLanes;
    for (std::size_t j = terms; j-- > 0; --factor, other += stride) {
      for (std::size_t q = 0; q < kQuads; ++q) {
        Quad middle, radius;
        load<4>(middle, other + 4 * q);
        load<4>(radius, other + kLanes + 4 * q);
        part[q] += factor->middle * middle;
        absolute<4>(middle);
        rad[q] += factor->size * radius + factor->noise * (middle + radius);
      }
    }
    for (std::size_t q = 0; q < kQuads; ++q) mid[q] += part[q];
  }
  const double orders = static_cast<double>(k + 1);
  const double more = 1 + 4 * kUnit * static_cast<double>(k + entries.size());
  const double share = kUpwards * more / orders;
  double* const result = columns.values + (k + 1) * stride + row * 2 * kLanes;
  for (std::size_t q = 0; q < kQuads; ++q) {
    mid[q] /= columns.forwards ? orders : -orders;
    std::memcpy(result + 4 * q, &mid[q], sizeof mid[q]);
    absolute<4>(mid[q]);
    rad[q] = rad[q] * share + (kUnit * kUpwards) * mid[q] + kUnderflow;
    std::memcpy(result + kLanes + 4 * q, &rad[q], sizeof rad[q]);
  }
}

template <std::size_t kLanes>
CASIMIR_INLINE_ALWAYS void expand_columns(const Columns& columns) {
  for (std::size_t k = 0; k < columns.order; ++k)
    for (std::size_t row = 0; row < columns.n; ++row) next_row<kLanes>(columns, row, k);
}

CASIMIR_FOR_WIDE_REGISTERS
void expand_few(const Columns& columns) { expand_columns<kFew>(columns); }
CASIMIR_FOR_WIDE_REGISTERS
void expand_many(const Columns& columns) { expand_columns<kMany>(columns); }

/// Four entries of a row of sum_k V_k h^k.
struct RowSum {
  const double* last;  ///< the middles of V_N; those of V_{N-1} are `stride` before
  std::size_t radii;   ///< so many numbers behind are the radii
  std::size_t stride, order;
  MidRad h;
};

/// Horner's rule in balls: y <- y h + V_k, where the product and the sum round once each.
CASIMIR_FOR_WIDE_REGISTERS
void sum_up(const RowSum& row, double* middles, double* radii) {
  const double step = row.h.mid, spread = row.h.rad, size = std::abs(step) + spread;
  const double* values = row.last;
  Quad mid, rad;
  load<4>(mid, values);
  load<4>(rad, values + row.radii);
  for (std::size_t k = row.order; k-- > 0;) {
    values -= row.stride;
    Quad middle, radius, before = mid, product = mid * step;
    load<4>(middle, values);
    load<4>(radius, values + row.radii);
    mid = product + middle;
    Quad after = mid;
    absolute<4>(before);
    absolute<4>(product);
    absolute<4>(after);
    rad =
        (before * spread + rad * size + radius + kUnit * (product + after)) * kUpwards + kUnderflow;
  }
  std::memcpy(middles, &mid, sizeof mid);
  std::memcpy(radii, &rad, sizeof rad);
}

}  // namespace

Tangents<MidRad>::Tangents(Entries entries, std::size_t dimension, std::size_t order)
    : entries_(std::move(entries)),
      n_(dimension),
      order_(order),
      lanes_(dimension <= kFew ? kFew : kMany),
      blocks_((dimension + lanes_ - 1) / lanes_),
      rows_(dimension),
      values_(blocks_ * (order + 1) * dimension * 2 * lanes_) {
  for (const auto& [row, column] : entries_) {
    auto& entries_of_row = rows_[static_cast<std::size_t>(row)];
    place_.push_back(entries_of_row.size());
    entries_of_row.push_back(
        {static_cast<std::size_t>(column), std::vector<TangentEntry::Factor>(order), 0});
  }
}

/// What is the same for all columns and orders. A coefficient that is exactly zero adds nothing.
void Tangents<MidRad>::know_factors(const std::vector<const Series*>& jacobian) {
  for (std::size_t e = 0; e < entries_.size(); ++e) {
    auto& row = rows_[static_cast<std::size_t>(entries_[e].first)];
    TangentEntry& entry = row[place_[e]];
    const auto count = static_cast<double>(row.size());
    entry.length = 0;
    for (std::size_t j = 0; j < order_; ++j) {
      const MidRad& factor = (*jacobian[e])[j];
      const double size = std::abs(factor.mid);
      const double roundings = kUnit * (static_cast<double>(j) + count + 3);
      const bool zero = size == 0 && factor.rad == 0;
      entry.factors[j] = {factor.mid, size,
                          zero ? 0 : factor.rad + roundings * (size + kUnderflow)};
      if (!zero) entry.length = j + 1;
    }
  }
}

void Tangents<MidRad>::expand(const std::vector<const Series*>& jacobian, bool forwards) {
  know_factors(jacobian);
  for (std::size_t block = 0; block < blocks_; ++block) {
    for (std::size_t row = 0; row < n_; ++row) {
      double* const unit = at(block, 0, row);
      std::fill(unit, unit + 2 * lanes_, 0.);
      if (row / lanes_ == block) unit[row % lanes_] = 1;
    }
    const Columns columns{rows_, n_, order_, forwards, at(block, 0, 0)};
    lanes_ == kFew ? expand_few(columns) : expand_many(columns);
  }
}

Matrix<MidRad> Tangents<MidRad>::coefficient(std::size_t k) const {
  Matrix<MidRad> result(n_, n_);
  for (std::size_t row = 0; row < n_; ++row)
    for (std::size_t column = 0; column < n_; ++column) {
      const double* const values = at(column / lanes_, k, row) + column % lanes_;
      result(row, column) = {values[0], values[lanes_]};
    }
  return result;
}

Matrix<MidRad> Tangents<MidRad>::at(const MidRad& h) const {
  Matrix<MidRad> result(n_, n_);
  double mid[4], rad[4];
  for (std::size_t row = 0; row < n_; ++row) {
    for (std::size_t column = 0; column < n_; column += 4) {
      const double* const last = at(column / lanes_, order_, row) + column % lanes_;
      sum_up({last, lanes_, n_ * 2 * lanes_, order_, h}, mid, rad);
      for (std::size_t l = 0; l < 4 && column + l < n_; ++l)
        result(row, column + l) = {mid[l], rad[l]};
    }
  }
  return result;
}

}  // namespace casimir::validated
