#pragma once

#include <cstddef>
#include <vector>

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

/// The product of a matrix of balls and one of doubles, which are exact, or of balls.
template <class Ball, class Number>
Matrix<Ball> product(const Matrix<Ball>& a, const Matrix<Number>& b) {
  Matrix<Ball> result(a.rows, b.columns);
  for (std::size_t i = 0; i < a.rows; ++i) {
    for (std::size_t j = 0; j < b.columns; ++j) {
      Ball sum;
      for (std::size_t k = 0; k < a.columns; ++k) sum = sum + a(i, k) * Ball(b(k, j));
      result(i, j) = sum;
    }
  }
  return result;
}

/// A^T B for a matrix A of doubles.
template <class Ball>
Matrix<Ball> transposed_product(const Matrix<double>& a, const Matrix<Ball>& b) {
  Matrix<Ball> result(a.columns, b.columns);
  for (std::size_t i = 0; i < a.columns; ++i) {
    for (std::size_t j = 0; j < b.columns; ++j) {
      Ball sum;
      for (std::size_t k = 0; k < a.rows; ++k) sum = sum + Ball(a(k, i)) * b(k, j);
      result(i, j) = sum;
    }
  }
  return result;
}

template <class Ball, class Number>
std::vector<Ball> product(const Matrix<Number>& a, const std::vector<Ball>& x) {
  std::vector<Ball> result(a.rows);
  for (std::size_t i = 0; i < a.rows; ++i)
    for (std::size_t k = 0; k < a.columns; ++k) result[i] = result[i] + Ball(a(i, k)) * x[k];
  return result;
}

template <class Ball>
std::vector<Ball> transposed_product(const Matrix<double>& a, const std::vector<Ball>& x) {
  std::vector<Ball> result(a.columns);
  for (std::size_t i = 0; i < a.columns; ++i)
    for (std::size_t k = 0; k < a.rows; ++k) result[i] = result[i] + Ball(a(k, i)) * x[k];
  return result;
}

template <class Ball>
std::vector<Ball> sum(std::vector<Ball> a, const std::vector<Ball>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] = a[i] + b[i];
  return a;
}

}  // namespace casimir::validated
