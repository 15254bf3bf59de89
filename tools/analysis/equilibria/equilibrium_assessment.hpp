#pragma once

#include <Eigen/Core>
#include <optional>
#include <random>
#include <vector>

#include "codegen/specialise.hpp"
#include "symbolic/model.hpp"
#include "tools/analysis/equilibria/equilibria.hpp"
#include "tools/analysis/equilibria/flat_directions.hpp"
#include "tools/analysis/equilibria/kinks.hpp"
#include "tools/analysis/equilibria/linear_stability.hpp"
#include "tools/analysis/equilibria/relative_equations.hpp"

namespace casimir::equilibria {

/// What the linearised equations tell of a solution.
class Assessment {
 public:
  /// \param integrals  functions that keep their values without the velocities
  /// \param equations, scaled, random  have to outlive it
  Assessment(const Model& model, const Scene& scene, const Specialisation& spec,
             const std::vector<GiNaC::ex>& integrals, const Equations& equations,
             const ScaledEquations& scaled, std::mt19937_64& random);

  /// Completes the eigenvalues and the stability.
  void operator()(const Place& place, Equilibrium& found) const;

 private:
  /// Points that rounding does not tell from a solution. A multiple root may be anywhere near.
  std::vector<Place> indistinguishable(const Place& place, const Directions& directions,
                                       const Equilibrium& found) const;
  /// Of each entry: that of its own rounding, and what it changes by to the points nearby.
  /// \param tangent  to the constraints, where there are any: the linearised equations are those
  ///                 along it
  Eigen::MatrixXd error_of(const Place& place, const Eigen::MatrixXd& matrix,
                           const std::vector<Place>& nearby,
                           const std::optional<Eigen::MatrixXd>& tangent) const;
  /// The linearised equations, along the constraints where there are any.
  Eigen::MatrixXd linearised(const Place& place,
                             const std::optional<Eigen::MatrixXd>& tangent) const;
  /// Whether the equations or the linearised ones are others on the other side, however near:
  /// sign(x) - x and |x|, and not x|x|.
  bool has_no_derivative(const Place& place, const std::vector<Place>& nearby) const;
  /// The largest differences across a point.
  struct Differences {
    double rates = 0, linearised = 0;
  };
  Differences differences(const Place& place, double distance) const;
  LinearStructure structure(const Place& place, const Directions& directions,
                            const Equilibrium& found,
                            const std::optional<Eigen::MatrixXd>& tangent) const;
  /// Directions that a power of the linearised equations takes to 0. The flow of a symmetry is one
  /// where the symmetry is an integral of what moves it, as one alone is, or all are at rest; and
  /// what leads to other solutions is taken to a sum of such flows.
  Eigen::MatrixXd null_directions(const Place& place, const Directions& directions,
                                  const Equilibrium& found) const;
  double sign() const { return random_() % 2 == 0 ? -1 : 1; }

  const Equations& equations_;
  const ScaledEquations& scaled_;
  std::mt19937_64& random_;
  NumericBracket bracket_;
  PreservedForms forms_;
  /// The bracket at some point; empty where it is not proved to satisfy the Jacobi identity.
  std::optional<Eigen::MatrixXd> generic_;
  Kinks kinks_;
};

}  // namespace casimir::equilibria
