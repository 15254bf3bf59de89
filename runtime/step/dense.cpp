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

Eigen::MatrixXd times(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) { return a * b; }

Eigen::MatrixXcd adjoint_times(const Eigen::MatrixXcd& left, const Eigen::MatrixXcd& right) {
  return left.adjoint() * right;
}

Eigen::MatrixXd between(const Eigen::MatrixXd& left, const Eigen::MatrixXd& a,
                        const Eigen::MatrixXd& right) {
  return times(times(left.transpose(), a), right);
}

Eigen::MatrixXd inverted(const Eigen::MatrixXd& a) { return a.inverse(); }

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

std::optional<EigenSystem> eigen_system_of(const Eigen::MatrixXcd& a) {
  const Eigen::ComplexEigenSolver<Eigen::MatrixXcd> solver(a);
  if (solver.info() != Eigen::Success) return std::nullopt;
  return EigenSystem{solver.eigenvalues(), solver.eigenvectors(),
                     solver.eigenvectors().fullPivLu().inverse()};
}

std::optional<std::vector<ConditionedEigenvalue>> conditioned_eigenvalues_of(
    const Eigen::MatrixXcd& a) {
  const auto system = eigen_system_of(a);
  if (!system) return std::nullopt;
  std::vector<ConditionedEigenvalue> result;
  for (Eigen::Index k = 0; k < a.cols(); ++k) {
    const double condition = system->left.row(k).norm() * system->right.col(k).norm();
    result.push_back({system->values(k), std::isfinite(condition) ? condition : HUGE_VAL});
  }
  return result;
}

SingularDirections singular_directions_of(const Eigen::MatrixXd& a) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(a, Eigen::ComputeFullV);
  SingularDirections result{Eigen::VectorXd::Zero(a.cols()), svd.matrixV()};
  result.sizes.head(svd.singularValues().size()) = svd.singularValues();
  return result;
}

Eigen::MatrixXd orthogonal_complement(const Eigen::MatrixXd& a, Eigen::Index count) {
  return Eigen::JacobiSVD<Eigen::MatrixXd>(a, Eigen::ComputeFullU).matrixU().rightCols(count);
}

}  // namespace casimir
