#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "runtime/program/interpreter.hpp"
#include "tools/analysis/section/problem.hpp"

namespace casimir {

/// The points of the plane on one energy and Casimir level. One object serves one thread.
class LevelSet {
 public:
  /// A state of the system.
  using Vector = Eigen::VectorXd;

  /// \param problem  must outlive this object.
  explicit LevelSet(const SectionProblem& problem);

  /// What was asked.
  const SectionProblem& problem() const { return problem_; }

  /// Moves a point to the nearest one of the level set, about, by Newton's method with the shortest
  /// correction (Gauss and Newton). Whether it arrived, to rounding.
  /// \param pair  these values of the plotted pair are to be met too.
  /// \param energy  false: on any energy.
  bool project(Vector& x, const std::array<double, 2>* pair = nullptr, bool energy = true) const;

  /// How far the level functions are from their values, relative to the size of their terms: the
  /// largest of all.
  double distance_from_level(const double* x) const;

  /// The value of the Hamiltonian.
  double energy(const Vector& x) const;
  /// Its derivatives by the states.
  Vector energy_gradient(const Vector& x) const;
  /// The rates of the states.
  Vector field(const Vector& x) const;
  /// The derivatives of the function of the plane.
  Vector plane_gradient(const Vector& x) const;
  /// Rate of the plane's function along the field over the product of the lengths of both: between
  /// -1 and 1, positive where it is crossed in the direction wanted.
  double speed(const Vector& x) const;
  /// The plotted pair, angles from 0 to their period.
  std::array<double, 2> plotted(const double* x) const;
  /// An orthonormal basis of the directions that stay in the level set: a column each, as many as
  /// the leaf has dimensions but two.
  Eigen::MatrixXd tangent(const Vector& x) const;
  /// The difference of two points, angles the short way round.
  Vector difference(const Vector& to, const Vector& from) const;

 private:
  void evaluate(const double* x) const;
  Eigen::MatrixXd gradients(const Vector& x) const;
  Eigen::Index plane_index() const { return static_cast<Eigen::Index>(problem_.levels.size()); }

  const SectionProblem& problem_;
  Interpreter invariants_, gradients_, rhs_;
  mutable std::vector<double> inputs_, values_, entries_;
};

}  // namespace casimir
