#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "runtime/program/interpreter.hpp"
#include "runtime/program/program_series.hpp"
#include "runtime/validated/flow_piece.hpp"
#include "tools/analysis/horseshoe/section_system.hpp"

namespace casimir::horseshoe {

/// Where an orbit returns, in doubles.
struct Returned {
  Eigen::VectorXd state;
  double time = 0;
  Eigen::MatrixXd derivative;  ///< of the return map, by the state: n x n; empty if not asked for
};

/// The return map in doubles, to look for what is then proved: nothing here proves anything.
class NumericReturn {
 public:
  using Vector = Eigen::VectorXd;
  using Matrix = Eigen::MatrixXd;

  /// The system must outlive this.
  explicit NumericReturn(const SectionSystem& system);

  /// The first return of a state; nothing where it does not come back soon.
  std::optional<Returned> operator()(const Vector& x, bool with_derivative) const;

  /// Moves a state onto the surface and the level, by the shortest corrections. Whether it arrived.
  bool project(Vector& x) const;
  /// An orthonormal basis of the directions along the surface and the level, a column each.
  Matrix tangent(const Vector& x) const;
  /// The gradients of s and of the functions of the level, a column each.
  Matrix gradients(const Vector& x) const;
  /// f
  Vector rates(const Vector& x) const;
  /// The derivative of s along the solution.
  double plane_rate(const Vector& x) const { return plane(x)[1]; }

 private:
  struct Piece;
  std::array<double, 2> plane(const Vector& x) const;
  Vector constraints(const Vector& x) const;
  void expand(const Vector& x, bool with_derivative, Piece& piece) const;
  Vector at(const Piece& piece, double t) const;
  std::optional<double> root(const Piece& piece, double from, double to) const;
  std::optional<double> crossing(const Piece& piece, bool first) const;
  Matrix tangents_at(const Piece& piece, double t) const;

  const SectionSystem& system_;
  validated::FlowProgram flow_;
  std::size_t n_;
  mutable TaylorJet<double> jet_, jet_with_jacobian_;
  Interpreter plane_, constraints_, gradients_, rates_;
  std::vector<double> levels_;
};

}  // namespace casimir::horseshoe
