#pragma once

// Arb's names stay inside the files that prove numbers.
#include <arb_mat.h>
#include <ginac/ginac.h>

#include <cstddef>
#include <utility>
#include <vector>

#include "runtime/validated_run.hpp"

namespace casimir {

/// Of the balls here.
inline constexpr slong kBallBits = 192;

/// A matrix of Arb's, with value semantics: what is computed with it holds for every matrix with
/// entries in its balls.
class BallMatrix {
 public:
  /// Zero.
  BallMatrix(std::size_t rows, std::size_t columns) {
    arb_mat_init(value_, static_cast<slong>(rows), static_cast<slong>(columns));
  }
  BallMatrix(const BallMatrix& other) : BallMatrix(other.rows(), other.columns()) {
    arb_mat_set(value_, other.value_);
  }
  BallMatrix& operator=(const BallMatrix& other) {
    if (rows() != other.rows() || columns() != other.columns()) {
      arb_mat_clear(value_);
      arb_mat_init(value_, arb_mat_nrows(other.value_), arb_mat_ncols(other.value_));
    }
    arb_mat_set(value_, other.value_);
    return *this;
  }
  ~BallMatrix() { arb_mat_clear(value_); }

  std::size_t rows() const { return static_cast<std::size_t>(arb_mat_nrows(value_)); }
  std::size_t columns() const { return static_cast<std::size_t>(arb_mat_ncols(value_)); }
  arb_ptr at(std::size_t i, std::size_t j = 0) {
    return arb_mat_entry(value_, static_cast<slong>(i), static_cast<slong>(j));
  }
  arb_srcptr at(std::size_t i, std::size_t j = 0) const {
    return arb_mat_entry(value_, static_cast<slong>(i), static_cast<slong>(j));
  }
  arb_mat_struct* raw() { return value_; }
  const arb_mat_struct* raw() const { return value_; }
  /// The middle of an entry, rounded.
  double near(std::size_t i, std::size_t j = 0) const {
    return arf_get_d(arb_midref(at(i, j)), ARF_RND_NEAR);
  }

  BallMatrix transposed() const;
  /// The midpoints, as exact numbers.
  BallMatrix middle() const;
  /// Some of its rows.
  BallMatrix rows_of(std::size_t first, std::size_t count) const;

 private:
  arb_mat_t value_;
};

BallMatrix operator*(const BallMatrix& a, const BallMatrix& b);
BallMatrix operator-(const BallMatrix& a, const BallMatrix& b);
BallMatrix operator+(const BallMatrix& a, const BallMatrix& b);
/// The identity.
BallMatrix identity(std::size_t n);
/// Whether every entry of `inner` lies in the inside of that of `outer`.
bool inside(const BallMatrix& inner, const BallMatrix& outer);
/// z - Y f + (I - Y f') (Z - z): Krawczyk's operator (Computing 4 (1969) 187). Where it maps a box
/// into its inside, a function with value f at z and derivative within f' on the box Z has exactly
/// one zero in Z, and that lies in the image (Neumaier, Interval Methods for Systems of Equations,
/// chapter 5).
BallMatrix krawczyk(const BallMatrix& z, const BallMatrix& y, const BallMatrix& value,
                    const BallMatrix& derivatives, const BallMatrix& box);
/// The ends of a ball, exactly.
RationalInterval ends_of(arb_srcptr ball);
/// The ball around an interval, outwards.
void set_interval(arb_ptr ball, const RationalInterval& interval);

/// Expressions over some symbols, in balls.
class BallFunctions {
 public:
  /// \param values  a matrix by rows, with so many columns.
  BallFunctions(std::vector<GiNaC::symbol> unknowns, std::vector<GiNaC::ex> values,
                std::size_t columns = 1)
      : unknowns_(std::move(unknowns)), values_(std::move(values)), columns_(columns) {}

  /// The same functions where further symbols have any values of an interval each: what is said of
  /// the values then holds for all of these.
  BallFunctions over(std::vector<std::pair<GiNaC::symbol, RationalInterval>> fixed) const {
    BallFunctions result = *this;
    result.fixed_ = std::move(fixed);
    return result;
  }

  /// The values at every point of a box: a column with a ball for each symbol.
  /// \throws NotCertified  where some value is not certain to exist, to be real, and to depend
  ///                       differentiably on the point.
  BallMatrix operator()(const BallMatrix& box) const;

  /// The matrix of derivatives by the symbols; of a column of values.
  BallFunctions derivatives() const;

 private:
  std::vector<GiNaC::symbol> unknowns_;
  std::vector<GiNaC::ex> values_;
  std::size_t columns_;
  std::vector<std::pair<GiNaC::symbol, RationalInterval>> fixed_ = {};
};

}  // namespace casimir
