#include "runtime/validated/frame.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "runtime/validated/mid_rad.hpp"

namespace casimir::validated {
namespace {

/// What is left of a column, relative to it, when those before are taken away, has to be more: of a
/// gradient, ..
constexpr double kLeastOfGradient = 1e-4;
/// .. and of any other, which is a direction only.
constexpr double kLeastOfFrame = 1e-10;

using Column = std::span<double>;

double norm(Column column) {
  double sum = 0;
  for (const double x : column) sum += x * x;
  if (sum > 1e-250 && sum < 1e250) return std::sqrt(sum);
  double largest = 0;
  for (const double x : column) largest = std::max(largest, std::abs(x));
  if (!(largest > 0) || !std::isfinite(largest)) return 0;
  sum = 0;
  for (const double x : column) sum += (x / largest) * (x / largest);
  return largest * std::sqrt(sum);
}

void divide(Column column, double by) {
  const double share = 1 / by;
  const bool fits = std::isfinite(share) && share > 0x1p-1000;
  for (double& x : column) x = fits ? x * share : x / by;
}

/// Columns that are added one by one.
class GramSchmidt {
 public:
  explicit GramSchmidt(std::size_t dimension) : n_(dimension), columns_(dimension * dimension) {}

  bool full() const { return count_ == n_; }
  std::size_t count() const { return count_; }
  Matrix<double> columns() const {
    Matrix<double> result(n_, n_);
    for (std::size_t j = 0; j < n_; ++j)
      for (std::size_t i = 0; i < n_; ++i) result(i, j) = columns_[j * n_ + i];
    return result;
  }

  /// Twice is enough (Parlett, The Symmetric Eigenvalue Problem, 1980, Sec. 6.9).
  bool add(std::span<const double> wanted, double least) {
    if (full()) return false;
    const Column column = at(count_);
    std::ranges::copy(wanted, column.begin());
    const double size = norm(column);
    if (!(size > 0)) return false;
    divide(column, size);
    for (int pass = 0; pass < 2; ++pass) {
      for (std::size_t j = 0; j < count_; ++j) {
        const Column other = at(j);
        double along = 0;
        for (std::size_t i = 0; i < n_; ++i) along += other[i] * column[i];
        for (std::size_t i = 0; i < n_; ++i) column[i] -= along * other[i];
      }
      const double rest = norm(column);
      if (!(rest > least)) return false;
      divide(column, rest);
    }
    ++count_;
    return true;
  }

 private:
  Column at(std::size_t j) { return Column(columns_).subspan(j * n_, n_); }

  std::size_t n_, count_ = 0;
  std::vector<double> columns_;  ///< one after the other
};

/// With E = I - B^T B and |E| = s < 1, B^-1 = (B^T B)^-1 B^T = (I - E)^-1 B^T, and
/// (I - E)^-1 = I + F with |F| <= s / (1 - s). Infinite where s is not below 1/4. The entries of
/// the exact product of the doubles in B are in balls, so that s bounds the rows of E.
double defect_of(const Matrix<double>& columns) {
  const std::size_t n = columns.columns;
  std::vector<double> rows(n);
  ProductSums<MidRad> sums(columns.rows + 1);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      MidRad entry;
      for (std::size_t k = 0; k < columns.rows; ++k) {
        sums.begin(columns(k, i));
        sums.add(entry, columns(k, j));
      }
      if (i == j) {
        sums.begin(-1.);
        sums.add(entry, 1.);
      }
      sums.finish(entry);
      const double size = magnitude(entry);
      rows[i] = upwards(rows[i] + size);
      if (i != j) rows[j] = upwards(rows[j] + size);
    }
  }
  double largest = 0;
  for (const double row : rows) {
    if (!(row < 0.25)) return INFINITY;
    largest = std::max(largest, row);
  }
  return upwards(largest / (1 - largest));
}

}  // namespace

Frame unit_frame(std::size_t dimension) {
  Frame frame{Matrix<double>(dimension, dimension), 0};
  for (std::size_t i = 0; i < dimension; ++i) frame.columns(i, i) = 1;
  return frame;
}

Frame frame_along(const std::vector<std::vector<double>>& first, const Matrix<double>& others,
                  const std::vector<double>& weights, std::vector<int>& taken) {
  const std::size_t n = others.rows;
  GramSchmidt basis(n);
  taken.clear();
  for (const std::vector<double>& gradient : first)
    taken.push_back(basis.add(gradient, kLeastOfGradient) ? static_cast<int>(basis.count()) - 1
                                                          : -1);
  std::vector<double> columns(others.columns * n), reach;
  const auto column = [&](std::size_t j) { return Column(columns).subspan(j * n, n); };
  for (std::size_t j = 0; j < others.columns; ++j) {
    for (std::size_t i = 0; i < n; ++i) column(j)[i] = others(i, j);
    const double size = norm(column(j)) * weights[j];
    reach.push_back(std::isnan(size) ? 0 : size);
  }
  std::vector<std::size_t> order(others.columns);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, [&](auto a, auto b) { return reach[a] > reach[b]; });
  for (const std::size_t j : order) basis.add(column(j), kLeastOfFrame);
  // Where the columns were dependent any others will do.
  for (std::size_t i = 0; i < n && !basis.full(); ++i) {
    std::vector<double> axis(n);
    axis[i] = 1;
    basis.add(axis, 1e-3);
  }
  if (!basis.full()) return {};
  Frame frame{basis.columns(), defect_of(basis.columns())};
  return std::isfinite(frame.defect) ? frame : Frame{};
}

}  // namespace casimir::validated
