#include "runtime/validated/frame.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "runtime/validated/mid_rad.hpp"

namespace casimir::validated {
namespace {

/// What is left of a column, relative to it, when those before are taken away, has to be more: of a
/// gradient, ..
constexpr double kLeastOfGradient = 1e-4;
/// .. and of any other, which is a direction only.
constexpr double kLeast = 1e-10;

double norm(const std::vector<double>& column) {
  double largest = 0;
  for (const double x : column) largest = std::max(largest, std::abs(x));
  if (!(largest > 0) || !std::isfinite(largest)) return 0;
  double sum = 0;
  for (const double x : column) sum += (x / largest) * (x / largest);
  return largest * std::sqrt(sum);
}

/// Columns that are added one by one.
class GramSchmidt {
 public:
  explicit GramSchmidt(std::size_t dimension) : columns_(dimension, dimension) {}

  bool full() const { return count_ == columns_.rows; }
  std::size_t count() const { return count_; }
  const Matrix<double>& columns() const { return columns_; }

  /// Twice is enough (Parlett, The Symmetric Eigenvalue Problem, 1980, Sec. 6.9).
  bool add(std::vector<double> column, double least) {
    const double size = norm(column);
    if (full() || !(size > 0)) return false;
    for (double& x : column) x /= size;
    for (int pass = 0; pass < 2; ++pass) {
      for (std::size_t j = 0; j < count_; ++j) {
        double along = 0;
        for (std::size_t i = 0; i < column.size(); ++i) along += columns_(i, j) * column[i];
        for (std::size_t i = 0; i < column.size(); ++i) column[i] -= along * columns_(i, j);
      }
      const double rest = norm(column);
      if (!(rest > least)) return false;
      for (double& x : column) x /= rest;
    }
    for (std::size_t i = 0; i < column.size(); ++i) columns_(i, count_) = column[i];
    ++count_;
    return true;
  }

 private:
  Matrix<double> columns_;
  std::size_t count_ = 0;
};

/// With E = I - B^T B and |E| = s < 1, B^-1 = (B^T B)^-1 B^T = (I - E)^-1 B^T, and
/// (I - E)^-1 = I + F with |F| <= s / (1 - s). Infinite where s is not below 1/4. The rows of E are
/// summed in balls: s is a bound for the exact product of the doubles in B.
double defect_of(const Matrix<double>& columns) {
  double largest = 0;
  for (std::size_t i = 0; i < columns.columns; ++i) {
    double row = 0;
    for (std::size_t j = 0; j < columns.columns; ++j) {
      MidRad entry(i == j ? 1. : 0.);
      for (std::size_t k = 0; k < columns.rows; ++k)
        entry = entry - MidRad(columns(k, i)) * MidRad(columns(k, j));
      row = upwards(row + magnitude(entry));
    }
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
  std::vector<std::vector<double>> columns(others.columns, std::vector<double>(n));
  std::vector<double> reach;
  for (std::size_t j = 0; j < others.columns; ++j) {
    for (std::size_t i = 0; i < n; ++i) columns[j][i] = others(i, j);
    const double size = norm(columns[j]) * weights[j];
    reach.push_back(std::isnan(size) ? 0 : size);
  }
  std::vector<std::size_t> order(others.columns);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, [&](auto a, auto b) { return reach[a] > reach[b]; });
  for (const std::size_t j : order) basis.add(columns[j], kLeast);
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
