#pragma once

#include <string>
#include <vector>

#include "symbolic/model.hpp"

namespace casimir::structure {

/// Which skew tensors: with `rank` indices, all above (fields, bivectors, ..) or all below (forms).
struct TensorType {
  int rank = 1;
  bool form = false;
};

/// "fields", "bivectors", "3-vectors", "1-forms", "2-forms", ..
std::string name_of(TensorType type);

/// The ascending lists of `rank` numbers below `dimension`, in lexicographic order.
std::vector<std::vector<std::size_t>> skew_indices(std::size_t dimension, int rank);

/// The components of the wedge product of two skew tensors of one kind, in the order of
/// `skew_indices`.
std::vector<GiNaC::ex> wedge(std::size_t dimension, const std::vector<GiNaC::ex>& a, int rank_a,
                             const std::vector<GiNaC::ex>& b, int rank_b);

/// A system together with the linear motion that it gives to tangent vectors, covectors and their
/// exterior powers. A tensor T is the function F = sum_I T_I(x) u_I, linear in one more variable
/// u_I for each list of indices I.
///
/// Theorem: L_X T = 0 if and only if F is an integral of the lifted system. For multivectors u is
/// a k-covector, du_I/dt = -sum over the indices i of I and over a of dX_a/dx_i u_(i replaced by
/// a); for forms it is a k-vector, du_I/dt = sum of dX_i/dx_a u_(i replaced by a). Then
/// dF/dt = sum_I (L_X T)_I u_I, and the u_I are independent. No hypothesis is needed.
class Lift {
 public:
  /// \throws ModelError  for a system that depends on time, and for too many components.
  Lift(const Model& model, TensorType type);

  /// The lifted system: variables of the case first, then the u_I.
  const Model& model() const { return model_; }
  /// Of the tensors that are looked for.
  TensorType type() const { return type_; }
  /// The number of variables of the case.
  std::size_t dimension() const { return dimension_; }
  /// One list for each component.
  const std::vector<std::vector<std::size_t>>& indices() const { return indices_; }
  /// The names of the variables of a component with commas between, as "M1,M2".
  std::string label(std::size_t component) const;

  /// The function that a tensor is.
  GiNaC::ex function(const std::vector<GiNaC::ex>& components) const;

 private:
  void add_rates(const Model& base);

  TensorType type_;
  std::size_t dimension_;
  std::vector<std::vector<std::size_t>> indices_;
  Model model_;
};

}  // namespace casimir::structure
