#include "runtime/step/dense.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <cmath>

namespace casimir {
namespace {

template <class Matrix>
Eigen::CompleteOrthogonalDecomposition<Matrix> decomposed(const Matrix& a, double threshold) {
  Eigen::CompleteOrthogonalDecomposition<Matrix> result(a.rows(), a.cols());
  result.setThreshold(threshold);
  result.compute(a);
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
  return decomposed(a, threshold).solve(b);
}

Eigen::Index rank_of(const Eigen::MatrixXd& a, double threshold) {
  return decomposed(a, threshold).rank();
}

Eigen::Index rank_of(const Eigen::MatrixXcd& a, double threshold) {
  return decomposed(a, threshold).rank();
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
