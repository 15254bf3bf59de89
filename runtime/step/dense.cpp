#include "runtime/step/dense.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <cmath>

namespace casimir {
namespace {

using Decomposition = Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>;

Decomposition decomposed(const Eigen::MatrixXd& a, double threshold) {
  Decomposition result(a.rows(), a.cols());
  result.setThreshold(threshold);
  result.compute(a);
  return result;
}

/// The same linear map of real and imaginary parts: of twice the rank, and as long.
Eigen::MatrixXd in_real_numbers(const Eigen::MatrixXcd& a) {
  Eigen::MatrixXd result(2 * a.rows(), 2 * a.cols());
  result << a.real(), -a.imag(), a.imag(), a.real();
  return result;
}

template <class Solver, class Matrix>
std::optional<Eigen::VectorXcd> eigenvalues(const Matrix& a) {
  const Solver solver(a, false);
  if (solver.info() != Eigen::Success) return std::nullopt;
  return solver.eigenvalues();
}

}  // namespace

Eigen::VectorXd shortest_solution(const Eigen::MatrixXd& a, const Eigen::VectorXd& b,
                                  double threshold) {
  return decomposed(a, threshold).solve(b);
}

Eigen::VectorXcd shortest_solution(const Eigen::MatrixXcd& a, const Eigen::VectorXcd& b,
                                   double threshold) {
  Eigen::VectorXd parts(2 * b.size());
  parts << b.real(), b.imag();
  const Eigen::VectorXd x = shortest_solution(in_real_numbers(a), parts, threshold);
  Eigen::VectorXcd result(a.cols());
  result.real() = x.head(a.cols());
  result.imag() = x.tail(a.cols());
  return result;
}

Eigen::Index rank_of(const Eigen::MatrixXd& a, double threshold) {
  return decomposed(a, threshold).rank();
}

Eigen::Index rank_of(const Eigen::MatrixXcd& a, double threshold) {
  return rank_of(in_real_numbers(a), threshold) / 2;
}

std::optional<Eigen::VectorXcd> eigenvalues_of(const Eigen::MatrixXd& a) {
  return eigenvalues<Eigen::EigenSolver<Eigen::MatrixXd>>(a);
}

std::optional<Eigen::VectorXcd> eigenvalues_of(const Eigen::MatrixXcd& a) {
  return eigenvalues<Eigen::ComplexEigenSolver<Eigen::MatrixXcd>>(a);
}

std::optional<std::vector<ConditionedEigenvalue>> conditioned_eigenvalues_of(
    const Eigen::MatrixXcd& a) {
  const Eigen::ComplexEigenSolver<Eigen::MatrixXcd> solver(a);
  if (solver.info() != Eigen::Success) return std::nullopt;
  const Eigen::MatrixXcd& right = solver.eigenvectors();
  const Eigen::MatrixXcd left = right.fullPivLu().inverse();
  std::vector<ConditionedEigenvalue> result;
  for (Eigen::Index k = 0; k < a.cols(); ++k) {
    const double condition = left.row(k).norm() * right.col(k).norm();
    result.push_back({solver.eigenvalues()(k), std::isfinite(condition) ? condition : HUGE_VAL});
  }
  return result;
}

Eigen::MatrixXd orthogonal_complement(const Eigen::MatrixXd& a, Eigen::Index count) {
  return Eigen::JacobiSVD<Eigen::MatrixXd>(a, Eigen::ComputeFullU).matrixU().rightCols(count);
}

}  // namespace casimir
