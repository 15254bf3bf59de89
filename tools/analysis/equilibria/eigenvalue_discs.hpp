#pragma once

#include <Eigen/Core>
#include <complex>
#include <cstddef>
#include <optional>
#include <vector>

namespace casimir {

/// An eigenvalue of a matrix whose entries are known to some error, and where that of the exact
/// matrix is.
struct EigenvalueDisc {
  std::complex<double> value;   ///< of the matrix as it is
  std::complex<double> centre;  ///< of the disc
  double radius = 0;            ///< 0 only where the eigenvalue is an entry without error
  std::size_t group = 0;        ///< discs that touch, directly or through others, are one group
  /// Whether the eigenvalues of its block lie mirrored at the imaginary axis, whatever the entries
  /// are: some change of signs of the coordinates turns the block into its negative, as it does for
  /// linear equations that are reversible in time.
  bool mirrored = false;
};

/// Discs around the eigenvalues of a real matrix. A group of m discs holds exactly m eigenvalues of
/// every matrix that differs from it by at most `error`, entry by entry.
///
/// The matrix is taken apart into the blocks of states that act on each other, whose eigenvalues
/// together are its own; an entry that is 0 without error connects nothing. In each block the units
/// are made alike by powers of 2 (Osborne, J. ACM 7, 338, 1960). For any regular X, X^-1 (A + E) X
/// = L + X^-1 E X with the diagonal L: by Gershgorin's theorem the eigenvalues are in the discs
/// around those of L whose radii are the sums of the rows of |X^-1| |E| |X|, m of them in each
/// group of m discs. With the eigenvectors of A as X this is the theorem of Bauer and Fike (Numer.
/// Math. 2, 137, 1960), eigenvalue by eigenvalue. Near a multiple one without as many eigenvectors,
/// X is regular for almost every small change of A, and the radius is about the m-th root of the
/// error (Davies, SIAM J. Matrix Anal. Appl. 29, 1051, 2007): a random one within the error is made
/// first. What the iteration for the eigenvalues does to A is a part of the error.
/// \returns  empty where an iteration does not converge.
std::optional<std::vector<EigenvalueDisc>> eigenvalue_discs(const Eigen::MatrixXd& a,
                                                            const Eigen::MatrixXd& error);

/// Units by powers of 2, one for each coordinate, in which rows and columns of a matrix with
/// entries of these sizes are alike: a(i, j) becomes a(i, j) * unit(j) / unit(i).
Eigen::VectorXd balancing_units(Eigen::MatrixXd sizes);

}  // namespace casimir
