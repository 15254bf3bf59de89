#pragma once

#include <map>
#include <utility>
#include <vector>

#include "symbolic/search/modular/monomials.hpp"
#include "symbolic/search/newton_faces.hpp"
#include "symbolic/search/system.hpp"
#include "symbolic/search/watch.hpp"
#include "symbolic/structure/lift.hpp"
#include "symbolic/structure/parametric_kernel.hpp"

namespace casimir::structure {

/// A polynomial in the coordinates with coefficients that are quotients of polynomials in the
/// parameters.
struct Cofactor {
  Polynomial top, bottom;  ///< in lowest terms; `bottom` has parameters only

  bool is_zero() const { return top.is_zero(); }
  friend bool operator==(const Cofactor& a, const Cofactor& b) {
    return a.top * b.bottom == b.top * a.bottom;
  }
};

/// In lowest terms, and the denominator with a positive leading coefficient.
Cofactor lowest(Polynomial top, Polynomial bottom);
Cofactor sum_of(const Cofactor& a, const Cofactor& b);
Cofactor negative_of(const Cofactor& a);

/// The equations L_X T = f T for polynomial skew tensors T of one type and a polynomial f. All is
/// over the field Q(parameters): T has its coefficients there, and so has f, as the quotient of two
/// components.
class ConformalEquations {
 public:
  /// \throws ModelError  where the equations of motion are no polynomials, or zero
  ConformalEquations(const Model& model, TensorType type);

  const Lift& lift() const { return lift_; }
  search::System& system() { return system_; }
  const search::System& system() const { return system_; }
  std::size_t dimension() const { return lift_.dimension(); }
  std::size_t components() const { return lift_.indices().size(); }
  /// The highest degree of the motion's field.
  int field_degree() const { return highest_; }
  /// The cofactor of dx_1 ^ .. ^ dx_n.
  const Polynomial& divergence() const { return divergence_; }

  /// L_X T for the components of T, over the system's ring.
  std::vector<Polynomial> derivative(const std::vector<Polynomial>& tensor) const;
  /// The degree in the coordinates; -1 of zero.
  int degree_of(const Polynomial& p) const;
  /// The coefficients of the monomials in the coordinates.
  std::map<std::vector<unsigned long>, Polynomial> coefficients_of(const Polynomial& p) const;

  /// The unknowns: coefficients of the monomials up to a degree, component by component.
  struct Basis {
    search::Monomials monomials;
    std::size_t components;
    std::size_t size() const { return monomials.size() * components; }
  };
  Basis basis(int degree) const;
  std::vector<Polynomial> tensor_of(const Basis& basis, const ParametricRow& row) const;
  ParametricRow row_of(const Basis& basis, const std::vector<Polynomial>& tensor) const;

  /// All T up to a degree for one cofactor: linear equations.
  std::vector<ParametricRow> solutions(const Basis& basis, const Cofactor& cofactor,
                                       const search::Watch& watch) const;

  /// The parts of one kind of the field, or all of it.
  struct Motion {
    std::vector<Polynomial> field;
    /// coupling[I][J]: what T_I adds to the J-th component of L_X T, but for X(T_I).
    std::vector<std::vector<Polynomial>> coupling;
  };
  const Motion& motion() const { return motion_; }
  /// The part of one degree.
  Motion motion_of(int degree) const;
  /// The part of a face of Newton's polytope of such a part.
  Motion motion_of(const Motion& motion, const search::NewtonFaces::Face& face) const;

  /// Some coefficients of T and of f, the others of T being zero; f = known + sum of u_k
  /// unknown[k].
  struct Ansatz {
    const Motion& motion;
    search::Monomials monomials;  ///< of each component of T
    Cofactor known;
    std::vector<std::vector<unsigned long>> unknown;  ///< monomials
  };
  /// The linear equations for T, over a ring that has the u_k behind the variables of the system's.
  std::vector<ParametricRow> rows(const Ansatz& ansatz, const PolynomialRing& ring) const;
  /// Whether they have none but zero: where the rank modulo a prime, which is not above the true
  /// one, is the number of columns.
  bool has_no_solution(const std::vector<ParametricRow>& rows, std::size_t columns) const;
  /// The same where each of the u_k is a root of a polynomial, whose coefficients are given: at a
  /// point of the parameters where each has all its roots modulo the prime, and they are different,
  /// and for all combinations of roots. A solution with algebraic coefficients would be one there.
  bool has_no_solution_at_roots(const std::vector<ParametricRow>& rows, std::size_t columns,
                                const std::vector<std::vector<Polynomial>>& roots) const;
  Polynomial monomial(const std::vector<unsigned long>& exponents) const;
  /// The lowest degree of the motion's field.
  int lowest_degree() const { return lowest_; }

 private:
  Polynomial part(const Polynomial& p, int degree) const;
  std::vector<Polynomial> contribution(const Motion& motion, std::size_t component,
                                       const Polynomial& monomial) const;

  Lift lift_;
  search::System system_;
  Motion motion_;
  Polynomial divergence_;
  int highest_ = 0, lowest_ = 0;
};

}  // namespace casimir::structure
