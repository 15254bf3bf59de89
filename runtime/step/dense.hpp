#pragma once

#include <Eigen/Core>
#include <complex>
#include <optional>
#include <vector>

namespace casimir {

// Products and decompositions of small dense matrices, instantiated once: a file that does it on
// its own takes a compiler ten seconds, and two for each product of other expressions.

/// a b.
Eigen::MatrixXd times(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

/// left^T a right: of a linear map or a form in other directions, the columns of left and right.
Eigen::MatrixXd between(const Eigen::MatrixXd& left, const Eigen::MatrixXd& a,
                        const Eigen::MatrixXd& right);

/// left^* right: of a Hermitian form whose images are the columns of right.
Eigen::MatrixXcd adjoint_times(const Eigen::MatrixXcd& left, const Eigen::MatrixXcd& right);

/// The inverse of a square matrix: not finite where it has none.
Eigen::MatrixXd inverted(const Eigen::MatrixXd& a);

/// The shortest of the vectors that make |a x - b| least.
/// \param threshold  pivots below it, relative to the largest, count as zero
Eigen::VectorXd shortest_solution(const Eigen::MatrixXd& a, const Eigen::VectorXd& b,
                                  double threshold);
Eigen::VectorXcd shortest_solution(const Eigen::MatrixXcd& a, const Eigen::VectorXcd& b,
                                   double threshold);

/// \param threshold  as above
Eigen::Index rank_of(const Eigen::MatrixXd& a, double threshold);
Eigen::Index rank_of(const Eigen::MatrixXcd& a, double threshold);

/// Of a square matrix, in no order; empty where the iteration does not converge.
std::optional<Eigen::VectorXcd> eigenvalues_of(const Eigen::MatrixXd& a);
std::optional<Eigen::VectorXcd> eigenvalues_of(const Eigen::MatrixXcd& a);

/// An eigenvalue, and how many times an error of the matrix it moves, to first order: infinite
/// where eigenvectors cannot be told apart.
struct ConditionedEigenvalue {
  std::complex<double> value;
  double condition;
};

/// Of a square matrix, in no order; empty where the iteration does not converge. The condition is
/// 1 / |y' x| of the left and the right eigenvector of length 1 (Wilkinson: The Algebraic
/// Eigenvalue Problem (1965), 2.8).
std::optional<std::vector<ConditionedEigenvalue>> conditioned_eigenvalues_of(
    const Eigen::MatrixXcd& a);

/// The eigenvalues of a square matrix with its right eigenvectors, columns of length 1, and the
/// left ones, the rows of their inverse.
struct EigenSystem {
  Eigen::VectorXcd values;
  Eigen::MatrixXcd right, left;
};

/// Empty where the iteration does not converge.
std::optional<EigenSystem> eigen_system_of(const Eigen::MatrixXcd& a);

/// Directions of length 1, a column each, that are orthogonal to each other and that a matrix maps
/// to orthogonal vectors of these sizes, from the largest to the smallest.
struct SingularDirections {
  Eigen::VectorXd sizes;
  Eigen::MatrixXd directions;
};

/// As many as a has columns.
SingularDirections singular_directions_of(const Eigen::MatrixXd& a);

/// An orthonormal basis, a column each, of `count` directions that are orthogonal to the columns of
/// a.
Eigen::MatrixXd orthogonal_complement(const Eigen::MatrixXd& a, Eigen::Index count);

}  // namespace casimir
