#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "codegen/specialise.hpp"
#include "runtime/program.hpp"
#include "runtime/program/interpreter.hpp"

namespace casimir::equilibria {

/// The equations of a relative equilibrium: rates and differences to the level, for the state and
/// the velocities.
class Equations {
 public:
  /// \param spec        of the model with the velocities as its last parameters; its invariants but
  ///                    H give the level
  /// \param velocities   how many there are
  /// \param constraints  how many of the invariants, the last ones, are constraints and no more: the
  ///                     phase space is where they vanish, and off it the equations say nothing
  Equations(const Specialisation& spec, std::size_t velocities, std::size_t constraints);

  /// The state of the scene.
  const Eigen::VectorXd& start() const { return start_; }
  /// How many variables there are.
  std::size_t states() const { return states_; }

  /// Of the right-hand side, for Kinks; valid until the next call of any function.
  const std::vector<double>& inputs(const Eigen::VectorXd& x, const Eigen::VectorXd& v) const;

  /// Of the state, with the velocities v.
  Eigen::VectorXd rates(const Eigen::VectorXd& x, const Eigen::VectorXd& v) const;

  /// The rates, then the differences to the level.
  Eigen::VectorXd residual(const Eigen::VectorXd& x, const Eigen::VectorXd& v) const;

  /// For each entry of the residual the size of the terms of which it is the sum: what its rounding
  /// is measured against.
  Eigen::VectorXd sizes_of_terms(const Eigen::VectorXd& x, const Eigen::VectorXd& v) const;

  /// Whether a rate is 0 in doubles, or nearly, for want of exponents alone, as exp(-x^2) far out:
  /// it is another number, and the same one wherever doubles differ by rounding.
  /// \param near  what rounding is of a coordinate
  bool vanish_by_underflow(const Eigen::VectorXd& x, const Eigen::VectorXd& v, double near) const;

  /// What each velocity adds to the rates, a column each: the flows of the symmetries, reversed.
  Eigen::MatrixXd by_velocities(const Eigen::VectorXd& x, Eigen::Index count) const;

  /// Of the rates by the state: the linearised equations.
  Eigen::MatrixXd linearised(const Eigen::VectorXd& x, const Eigen::VectorXd& v) const;

  /// Of the residual by the state and the velocities.
  Eigen::MatrixXd derivative(const Eigen::VectorXd& x, const Eigen::VectorXd& v) const;

  /// An orthonormal basis, as columns, of what is tangent to the constraints; empty where they do
  /// not cut more out of the phase space than the other functions of the level do.
  std::optional<Eigen::MatrixXd> tangent(const Eigen::VectorXd& x, const Eigen::VectorXd& v) const;

 private:
  Eigen::VectorXd invariants(const Eigen::VectorXd& x, const Eigen::VectorXd& v) const;

  Program rates_, levels_;
  std::size_t states_, velocities_;
  mutable std::vector<double> inputs_;
  Interpreter rhs_, jacobian_, invariants_, gradients_;
  std::vector<std::pair<int, int>> jacobian_entries_, gradient_entries_;
  std::size_t all_, constraints_;
  std::vector<std::size_t> level_;
  Eigen::VectorXd start_, values_;
};

/// A point: the state and the velocities.
struct Place {
  Eigen::VectorXd x, v;
};

/// The equations in units of their own: states and velocities by the sizes that they have where the
/// iteration starts, rates and levels by the sizes that they take there. What is small and what is
/// near is asked of these numbers.
class ScaledEquations {
 public:
  /// \param equations  have to outlive it
  ScaledEquations(const Equations& equations, std::size_t velocities, std::mt19937_64& random);

  /// What a state is compared with.
  double length() const { return length_; }
  /// What a rate is compared with.
  double rate() const;

  /// A normally distributed point.
  /// \param size  of the state, in its unit
  Place random_place(std::mt19937_64& random, double size = 1) const;

  /// Of Equations, in the units.
  Eigen::VectorXd residual(const Place& place) const;
  Eigen::VectorXd sizes_of_terms(const Place& place) const;
  /// The sizes of terms near a place where they are smaller than elsewhere, else 1: the equations
  /// of bodies that repel each other are as good as 0 wherever these are not close.
  Eigen::VectorXd units_around(const Place& place) const;
  bool vanish_by_underflow(const Place& place) const;
  /// The largest part of the residual.
  double error(const Place& place) const;
  /// Of the residual by the state and the velocities, in the units.
  Eigen::MatrixXd derivative(const Place& place) const;

  /// Of points, in units of the states.
  double distance(const Place& a, const Place& b) const;
  /// place + share * (to - place)
  static Place between(const Place& place, const Place& to, double share);
  /// \param step  in the units, of the state and the velocities
  Place moved(const Place& place, const Eigen::VectorXd& step) const;

 private:
  const Equations& equations_;
  Eigen::Index velocities_;
  double length_ = 1;
  Eigen::VectorXd sizes_;
};

}  // namespace casimir::equilibria
