#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "runtime/validated/mid_rad.hpp"

namespace casimir::validated {

/// A dense matrix, row after row.
template <class Number>
struct Matrix {
  std::size_t rows = 0, columns = 0;
  std::vector<Number> entries;

  Matrix() = default;
  Matrix(std::size_t row_count, std::size_t column_count)
      : rows(row_count), columns(column_count), entries(row_count * column_count) {}
  Number& operator()(std::size_t i, std::size_t j) { return entries[i * columns + j]; }
  const Number& operator()(std::size_t i, std::size_t j) const { return entries[i * columns + j]; }
};

/// Sums of so many products a b of balls, where a may be an exact double too.
template <class Ball>
class ProductSums {
 public:
  explicit ProductSums(std::size_t) {}
  /// The first factor of products that follow.
  template <class Number>
  void begin(const Number& a) {
    a_ = Ball(a);
  }
  template <class Number>
  void add(Ball& sum, const Number& b) const {
    sum = sum + a_ * Ball(b);
  }
  /// What has been summed.
  void finish(Ball&) const {}

 private:
  Ball a_;
};

/// In doubles. A sum of n products passes n additions and one product for each of them, whatever
/// their order and where they are fused: so its midpoint is off by at most
/// gamma_{n+1} |m_a m_b| <= (n + 2) u |m_a m_b| for each, and with the radii by
///   |m_a| rad(b) + (rad(a) + (n + 2) u (|m_a| + kUnderflow)) (|m_b| + rad(b))
/// as in Arithmetic<MidRad>::convolution. The radius passes at most 2 n + 8 roundings; those that
/// are more than `upwards` covers are covered by a factor of their own.
template <>
class ProductSums<MidRad> {
 public:
  explicit ProductSums(std::size_t terms)
      : roundings_(kUnit * (static_cast<double>(terms) + 2)),
        more_(1 + 4 * kUnit * static_cast<double>(terms)) {}
  void begin(const MidRad& a) {
    mid_ = a.mid;
    size_ = std::abs(a.mid);
    noise_ = a.rad + roundings_ * (size_ + kUnderflow);
  }
  void begin(double a) { begin(MidRad(a)); }
  void add(MidRad& sum, const MidRad& b) const {
    sum.mid += mid_ * b.mid;
    sum.rad += size_ * b.rad + noise_ * (std::abs(b.mid) + b.rad);
  }
  void add(MidRad& sum, double b) const {
    sum.mid += mid_ * b;
    sum.rad += noise_ * std::abs(b);
  }
  void finish(MidRad& sum) const { sum.rad = upwards(sum.rad * more_); }

 private:
  double roundings_, more_;
  double mid_ = 0, size_ = 0, noise_ = 0;
};

/// The product of a matrix of balls and one of doubles, which are exact, or of balls.
template <class Ball, class Number>
Matrix<Ball> product(const Matrix<Ball>& a, const Matrix<Number>& b) {
  Matrix<Ball> result(a.rows, b.columns);
  ProductSums<Ball> sums(a.columns);
  for (std::size_t i = 0; i < a.rows; ++i) {
    for (std::size_t k = 0; k < a.columns; ++k) {
      sums.begin(a(i, k));
      for (std::size_t j = 0; j < b.columns; ++j) sums.add(result(i, j), b(k, j));
    }
  }
  for (Ball& entry : result.entries) sums.finish(entry);
  return result;
}

/// A^T B for a matrix A of doubles.
template <class Ball>
Matrix<Ball> transposed_product(const Matrix<double>& a, const Matrix<Ball>& b) {
  Matrix<Ball> result(a.columns, b.columns);
  ProductSums<Ball> sums(a.rows);
  for (std::size_t i = 0; i < a.columns; ++i) {
    for (std::size_t k = 0; k < a.rows; ++k) {
      sums.begin(a(k, i));
      for (std::size_t j = 0; j < b.columns; ++j) sums.add(result(i, j), b(k, j));
    }
  }
  for (Ball& entry : result.entries) sums.finish(entry);
  return result;
}

template <class Ball, class Number>
std::vector<Ball> product(const Matrix<Number>& a, const std::vector<Ball>& x) {
  std::vector<Ball> result(a.rows);
  ProductSums<Ball> sums(a.columns);
  for (std::size_t i = 0; i < a.rows; ++i) {
    for (std::size_t k = 0; k < a.columns; ++k) {
      sums.begin(a(i, k));
      sums.add(result[i], x[k]);
    }
    sums.finish(result[i]);
  }
  return result;
}

template <class Ball>
std::vector<Ball> transposed_product(const Matrix<double>& a, const std::vector<Ball>& x) {
  std::vector<Ball> result(a.columns);
  ProductSums<Ball> sums(a.rows);
  for (std::size_t i = 0; i < a.columns; ++i) {
    for (std::size_t k = 0; k < a.rows; ++k) {
      sums.begin(a(k, i));
      sums.add(result[i], x[k]);
    }
    sums.finish(result[i]);
  }
  return result;
}

template <class Ball>
std::vector<Ball> sum(std::vector<Ball> a, const std::vector<Ball>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] = a[i] + b[i];
  return a;
}

template <class Ball>
Matrix<Ball> sum(Matrix<Ball> a, const Matrix<Ball>& b) {
  for (std::size_t i = 0; i < a.entries.size(); ++i) a.entries[i] = a.entries[i] + b.entries[i];
  return a;
}

/// The unit matrix, in balls without radius.
template <class Ball>
Matrix<Ball> unit_matrix(std::size_t dimension) {
  Matrix<Ball> unit(dimension, dimension);
  for (std::size_t i = 0; i < dimension; ++i) unit(i, i) = Ball(1.);
  return unit;
}

/// Doubles as balls without radius.
template <class Ball>
Matrix<Ball> in_balls(const Matrix<double>& a) {
  Matrix<Ball> result(a.rows, a.columns);
  for (std::size_t i = 0; i < a.entries.size(); ++i) result.entries[i] = Ball(a.entries[i]);
  return result;
}

}  // namespace casimir::validated
