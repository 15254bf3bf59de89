#include "tools/analysis/proof/ball_matrix.hpp"

#include "runtime/validated/rational_ends.hpp"
#include "symbolic/algebra/ball_evaluator.hpp"
#include "symbolic/algebra/flint_conversion.hpp"

namespace casimir {

BallMatrix BallMatrix::transposed() const {
  BallMatrix result(columns(), rows());
  arb_mat_transpose(result.value_, value_);
  return result;
}

BallMatrix BallMatrix::middle() const {
  BallMatrix result(rows(), columns());
  arb_mat_get_mid(result.value_, value_);
  return result;
}

BallMatrix BallMatrix::rows_of(std::size_t first, std::size_t count) const {
  BallMatrix result(count, columns());
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = 0; j < columns(); ++j) arb_set(result.at(i, j), at(first + i, j));
  return result;
}

BallMatrix operator*(const BallMatrix& a, const BallMatrix& b) {
  BallMatrix result(a.rows(), b.columns());
  arb_mat_mul(result.raw(), a.raw(), b.raw(), kBallBits);
  return result;
}

BallMatrix operator-(const BallMatrix& a, const BallMatrix& b) {
  BallMatrix result(a.rows(), a.columns());
  arb_mat_sub(result.raw(), a.raw(), b.raw(), kBallBits);
  return result;
}

BallMatrix operator+(const BallMatrix& a, const BallMatrix& b) {
  BallMatrix result(a.rows(), a.columns());
  arb_mat_add(result.raw(), a.raw(), b.raw(), kBallBits);
  return result;
}

BallMatrix identity(std::size_t n) {
  BallMatrix result(n, n);
  arb_mat_one(result.raw());
  return result;
}

bool inside(const BallMatrix& inner, const BallMatrix& outer) {
  for (std::size_t i = 0; i < inner.rows(); ++i)
    for (std::size_t j = 0; j < inner.columns(); ++j)
      if (arb_contains_interior(outer.at(i, j), inner.at(i, j)) == 0) return false;
  return true;
}

BallMatrix krawczyk(const BallMatrix& z, const BallMatrix& y, const BallMatrix& value,
                    const BallMatrix& derivatives, const BallMatrix& box) {
  return z - y * value + (identity(z.rows()) - y * derivatives) * (box - z);
}

RationalInterval ends_of(arb_srcptr ball) {
  validated::ArbBall own;
  arb_set(own.raw(), ball);
  return validated::ends_of(own);
}

void set_interval(arb_ptr ball, const RationalInterval& interval) {
  Rational low(interval.low), high(interval.high);
  arb_t other;
  arb_init(other);
  arb_set_fmpq(ball, low.get(), kBallBits);
  arb_set_fmpq(other, high.get(), kBallBits);
  arb_union(ball, ball, other, kBallBits);
  arb_clear(other);
}

BallMatrix BallFunctions::operator()(const BallMatrix& box) const {
  BallEvaluator evaluate(BallEvaluator::Numbers::real, kBallBits);
  for (std::size_t i = 0; i < unknowns_.size(); ++i) {
    Ball ball;
    acb_set_arb(ball.raw(), box.at(i));
    evaluate.set(unknowns_[i], ball);
  }
  for (const auto& [symbol, interval] : fixed_) {
    Ball ball;
    validated::ArbBall ends;
    set_interval(ends.raw(), interval);
    acb_set_arb(ball.raw(), ends.raw());
    evaluate.set(symbol, ball);
  }
  BallMatrix result(values_.size() / columns_, columns_);
  for (std::size_t k = 0; k < values_.size(); ++k) {
    const Ball& value = evaluate(values_[k]);
    if (!value.is_real() || !value.is_finite() || !evaluate.smooth()) throw NotCertified();
    arb_set(result.at(k / columns_, k % columns_), acb_realref(value.raw()));
  }
  return result;
}

BallFunctions BallFunctions::derivatives() const {
  std::vector<GiNaC::ex> result;
  for (const GiNaC::ex& value : values_)
    for (const GiNaC::symbol& unknown : unknowns_) result.push_back(value.diff(unknown));
  return BallFunctions(unknowns_, result, unknowns_.size()).over(fixed_);
}

}  // namespace casimir
