#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "runtime/validated/arb_ball.hpp"
#include "runtime/validated/linear.hpp"

namespace casimir::validated {

/// Row and column of the entries of a Jacobian that are not identically zero.
using Entries = std::vector<std::pair<int, int>>;

/// The derivatives V_k of the Taylor coefficients x_k of solutions with respect to the state that
/// they begin with: V_0 is the unit matrix, and (k + 1) V_{k+1} = unit sum_j J_j V_{k-j}, where J_j
/// are the Taylor coefficients of the Jacobian along the solution (the variational equation). With
/// balls J_j that hold for all states of a box, so do the V_k.
template <class Ball>
class Tangents {
 public:
  using Series = std::vector<Ball>;
  Tangents(Entries entries, std::size_t dimension, std::size_t order);

  /// \param jacobian  the series of each entry.
  /// \param forwards  false: the time runs backwards, unit = -1.
  void expand(const std::vector<const Series*>& jacobian, bool forwards);

  /// sum_k V_k h^k
  Matrix<Ball> at(const Ball& h) const;
  /// V_k
  Matrix<Ball> coefficient(std::size_t k) const { return coefficients_[k]; }

 private:
  Entries entries_;
  std::size_t n_, order_;
  std::vector<Matrix<Ball>> coefficients_;
};

/// An entry of a row of the Jacobian: its column, and of each coefficient of its series the middle,
/// the size of that, and by how much products with it may be off, of the other factor.
struct TangentEntry {
  struct Factor {
    double middle = 0, size = 0, noise = 0;
  };
  std::size_t column;
  std::vector<Factor> factors;
  std::size_t length = 0;  ///< the coefficients from here on are zero
};

/// In doubles, with the columns side by side in the lanes of registers.
template <>
class Tangents<MidRad> {
 public:
  using Series = std::vector<MidRad>;
  Tangents(Entries entries, std::size_t dimension, std::size_t order);
  void expand(const std::vector<const Series*>& jacobian, bool forwards);
  Matrix<MidRad> at(const MidRad& h) const;
  Matrix<MidRad> coefficient(std::size_t k) const;

 private:
  /// The lanes of some columns in a row of V_k: their middles, and radii.
  double* at(std::size_t block, std::size_t k, std::size_t row) {
    return values_.data() + ((block * (order_ + 1) + k) * n_ + row) * 2 * lanes_;
  }
  const double* at(std::size_t block, std::size_t k, std::size_t row) const {
    return values_.data() + ((block * (order_ + 1) + k) * n_ + row) * 2 * lanes_;
  }
  void know_factors(const std::vector<const Series*>& jacobian);

  Entries entries_;
  std::size_t n_, order_, lanes_, blocks_;
  std::vector<std::vector<TangentEntry>> rows_;
  std::vector<std::size_t> place_;  ///< of each entry in its row
  std::vector<double> values_;
};

template <class Ball>
Tangents<Ball>::Tangents(Entries entries, std::size_t dimension, std::size_t order)
    : entries_(std::move(entries)),
      n_(dimension),
      order_(order),
      coefficients_(order + 1, Matrix<Ball>(dimension, dimension)) {}

template <class Ball>
void Tangents<Ball>::expand(const std::vector<const Series*>& jacobian, bool forwards) {
  coefficients_[0] = Matrix<Ball>(n_, n_);
  for (std::size_t i = 0; i < n_; ++i) coefficients_[0](i, i) = Ball(1.);
  for (std::size_t k = 0; k < order_; ++k) {
    Matrix<Ball> sum(n_, n_);
    for (std::size_t e = 0; e < entries_.size(); ++e) {
      const auto row = static_cast<std::size_t>(entries_[e].first);
      const auto column = static_cast<std::size_t>(entries_[e].second);
      for (std::size_t j = 0; j <= k; ++j) {
        const Ball& factor = (*jacobian[e])[j];
        if (log2_magnitude(factor) < -1e300) continue;  // zero
        for (std::size_t l = 0; l < n_; ++l)
          sum(row, l) = sum(row, l) + factor * coefficients_[k - j](column, l);
      }
    }
    const Ball divisor(static_cast<double>(k + 1) * (forwards ? 1 : -1));
    for (Ball& entry : sum.entries) entry = entry / divisor;
    coefficients_[k + 1] = std::move(sum);
  }
}

template <class Ball>
Matrix<Ball> Tangents<Ball>::at(const Ball& h) const {
  Matrix<Ball> value = coefficients_[order_];
  for (std::size_t k = order_; k-- > 0;) {
    for (std::size_t i = 0; i < value.entries.size(); ++i)
      value.entries[i] = value.entries[i] * h + coefficients_[k].entries[i];
  }
  return value;
}

}  // namespace casimir::validated
