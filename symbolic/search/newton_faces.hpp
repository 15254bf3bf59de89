#pragma once

#include <map>
#include <optional>
#include <vector>

#include "symbolic/algebra/polynomial.hpp"

namespace casimir::search {

/// A polynomial field X as a sum of x^a D_a over vectors a of whole numbers, with diagonal linear
/// fields D_a = sum of d_i x_i d/dx_i. Along a direction w the terms of highest w.a are its face.
///
/// Theorem: let L_X T = f T with T and f not zero. Along each w the parts of highest weight obey
/// the same equation with the face of X. So w.b <= max w.a for every monomial x^b of f. Where the
/// face is one vector a alone, the part of f is a number f_a times x^a, and T's parts x^b T_b, in
/// the frame of the x_i d/dx_i or of the dx_i/x_i, each obey (D_a.b) T_b - N T_b = f_a T_b. For
/// vectors N = D_a ^ (contraction with a), for forms -N = a ^ (contraction with D_a); N^2 = (a.D_a)
/// N up to that sign, so that its eigenvalues are 0 and a.D_a: f_a is D_a.b, or D_a.b - a.D_a for
/// vectors and D_a.b + a.D_a for forms. It is in Q(parameters).
class NewtonFaces {
 public:
  using Vector = std::vector<long>;

  /// \param dimension  of the field's first variables, which are the coordinates
  NewtonFaces(const std::vector<Polynomial>& field, std::size_t dimension);

  /// Whether a cofactor may have this monomial.
  bool allows(const Vector& monomial) const;
  /// D_a where a vertex is the face of some direction; null for other vectors.
  const std::vector<Polynomial>* vertex(const Vector& a) const;

  struct Face {
    Vector direction;
    long height = 0;  ///< max w.a
    bool contains(const Vector& a) const;
  };
  /// One direction for each set of vectors that is the face of some and no single one.
  const std::vector<Face>& faces() const { return faces_; }

 private:
  void add_direction(const Vector& w);

  std::map<Vector, std::vector<Polynomial>> terms_;  ///< D_a
  std::vector<Face> all_;                            ///< of all directions that were tried
  std::vector<Vector> vertices_;
  std::map<std::vector<Vector>, std::size_t> known_;
  std::vector<Face> faces_;
};

/// w.a
long product(const std::vector<long>& w, const std::vector<long>& a);

}  // namespace casimir::search
