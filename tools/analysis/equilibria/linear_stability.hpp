#pragma once

#include <Eigen/Core>
#include <complex>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "symbolic/model.hpp"
#include "tools/analysis/equilibria/spectral_stability.hpp"

namespace casimir {

/// What is known of the eigenvalues of a linearised system besides its numbers.
struct LinearStructure {
  /// Whether the matrix is J S with a skew J and a symmetric S: then it is similar to its negative,
  /// transposed, and with each eigenvalue l there is one at -conj(l), of the same multiplicity.
  bool mirrored = false;
  std::size_t zeros = 0;    ///< eigenvalues that are exactly 0, at least
  Eigen::MatrixXd bracket;  ///< J, where it is mirrored
  /// Symmetric matrices S with A' S + S A = 0; asked for where nothing else decides.
  std::function<std::vector<Eigen::MatrixXd>()> forms;
};

/// The bracket of a model in numbers.
class NumericBracket {
 public:
  /// Without a value anywhere for a model that has no bracket.
  NumericBracket(const Model& model, const Scene& scene);

  /// Empty where it has no value.
  std::optional<Eigen::MatrixXd> at(const Eigen::VectorXd& state) const;

 private:
  std::vector<GiNaC::symbol> variables_;
  std::vector<std::vector<GiNaC::ex>> entries_;  ///< of the lower triangle
};

/// Second derivatives of integrals at a rest. Where a sum F of integrals with constant factors has
/// no first derivative there, the derivatives of F' f = 0 of second order are A' S + S A = 0 with S
/// = F'': x' S x is an integral of the linearised equations.
class PreservedForms {
 public:
  /// \param integrals  over the symbols of the model
  PreservedForms(const Model& model, const Scene& scene, std::vector<GiNaC::ex> integrals);

  /// Of those that are preserved up to rounding: not all integrals are, seen from a moving state.
  std::vector<Eigen::MatrixXd> at(const Eigen::VectorXd& state,
                                  const Eigen::MatrixXd& linearised) const;

 private:
  std::vector<GiNaC::symbol> variables_;
  std::vector<GiNaC::ex> integrals_;
};

/// The structure of the linearised equations at a critical point of the Hamiltonian on its leaf.
///
/// Near a point where the rank of the bracket is the largest there are Casimir functions C, as many
/// as the rank leaves (Weinstein, J. Differential Geom. 18, 523, 1983), and a rest of the flow of H
/// is a critical point of some L = H - sum l C: the linearised equations are J L''. Eigenvalues 0
/// are those of the C and, on the leaf, a symplectic space: one that contains `null` has at least
/// the dimension 2 p - r, where p is that of `null` and r the rank of the symplectic form on it.
/// \param generic  the bracket at a point in general position
/// \param null     columns that a power of the linearised equations takes to 0
/// \returns  empty where the rank of the bracket is not the largest.
std::optional<LinearStructure> hamiltonian_structure(const Eigen::MatrixXd& bracket,
                                                     const Eigen::MatrixXd& generic,
                                                     const Eigen::MatrixXd& null);

/// The rank, where columns below rounding are none.
std::size_t rank_of_directions(const Eigen::MatrixXd& columns);

/// Eigenvalues, from the right to the left, and what they tell.
struct LinearStability {
  std::vector<std::complex<double>> eigenvalues;  ///< parts that are within their error are 0
  SpectralStability stability = SpectralStability::undecided;
};

/// Of the matrices that differ from one by at most `error`, entry by entry, and have the structure.
///
/// An eigenvalue is off the imaginary axis where the whole group of its discs is
/// (eigenvalue_discs). It is exactly on it
/// - where the group has as many discs as there are known eigenvalues 0, which lie in it;
/// - where the matrix is mirrored and the group is a single disc whose image at the axis meets no
///   other: it holds one eigenvalue l, and that at -conj(l) is in it, too, so that they are one;
/// - where the matrix is mirrored and the Hermitian form i x* J^-1 x is definite on the group's
///   eigenvectors: eigenvalues of one Krein signature do not leave the axis (Krein; Gelfand and
///   Lidskii, Uspekhi Mat. Nauk 10 (1955) 3);
/// - where a sum of the preserved forms S is definite on the group's eigenvectors: with A x = l x
///   the equation of S says 2 Re(l) x* S x = 0;
/// - where all others are on it, no state acts on itself, and two are left that are not real: those
///   are conjugate to each other, and the real parts of all add up to the trace, which is 0.
/// Else it is not decided.
/// \returns  empty where the eigenvalues cannot be computed.
std::optional<LinearStability> linear_stability(const Eigen::MatrixXd& a,
                                                const Eigen::MatrixXd& error,
                                                const LinearStructure& structure);

}  // namespace casimir
