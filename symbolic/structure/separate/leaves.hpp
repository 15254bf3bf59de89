#pragma once

#include <vector>

#include "symbolic/search/system.hpp"
#include "symbolic/structure/bracket_equations.hpp"

namespace casimir::structure {

/// A level that is not made of symplectic leaves: its functions are no Casimir functions there.
class NotLeaves : public ModelError {
 public:
  using ModelError::ModelError;
};

/// The symplectic leaves of a case's bracket on a common level of Casimir functions, with functions
/// on them as polynomials of one ring.
class Leaves {
 public:
  /// \param on  the level; empty for all of the phase space
  /// \param others  further expressions that will be converted
  /// \throws ModelError  without a bracket of polynomials and for a motion that depends on time
  /// \throws NotLeaves
  Leaves(const Model& model, const std::vector<NamedExpression>& on,
         const std::vector<GiNaC::ex>& others);
  Leaves(const Leaves&) = delete;
  Leaves& operator=(const Leaves&) = delete;

  search::System& system() { return system_; }
  const search::System& system() const { return system_; }
  const PolynomialRing& ring() const { return system_.ring(); }
  std::size_t dimension() const { return system_.model().variables.size(); }
  /// The entries {x_i, x_j}, i < j.
  const Bivector& bivector() const { return bivector_; }
  const std::vector<NamedExpression>& on() const { return on_; }
  /// What generates the ideal of the level.
  const std::vector<Polynomial>& ideal() const { return ideal_; }
  /// Whether the leading monomials of these have no parameters, so that remainders are linear over
  /// the functions of the parameters.
  bool has_plain_leads() const { return plain_leads_; }

  const Polynomial& convert(const GiNaC::ex& expression);
  /// The numerator modulo the ideal: where it is zero, the function vanishes on the level.
  Polynomial reduced(const Polynomial& p) const;
  bool vanishes(const Polynomial& p) const { return reduced(p).is_zero(); }
  /// {f, g}.
  Polynomial bracket(const Polynomial& f, const Polynomial& g) const;
  /// The derivatives along the coordinates.
  std::vector<Polynomial> gradient(const Polynomial& f) const;

  /// The places of some coordinates in ascending order, for each a choice of `size` of them.
  std::vector<std::vector<std::size_t>> choices(std::size_t size) const;
  /// Half the largest dimension that leaves on the level can have: the Pfaffians of all larger
  /// minors of the bracket vanish there.
  std::size_t degrees_of_freedom() const { return freedom_; }

  /// Whether a bivector is tangent to the leaves wherever the Pfaffian of the minor with these 2n
  /// rows I is not zero.
  ///
  /// Theorem: there the kernel of P, of corank N - 2n, is spanned by the covectors
  /// e_a - sum P_I^(-1)_ij P_ja e_i for a outside of I, and a bivector is made of vectors tangent
  /// to the leaf exactly where it vanishes on that kernel. Hypothesis: the rank of P is 2n, as that
  /// of all larger minors is less on the level and that of this one is not.
  bool is_tangent(const Bivector& p, const std::vector<std::size_t>& rows) const;

 private:
  void read_bivector();
  void read_level();
  void find_freedom();

  std::vector<NamedExpression> on_;
  search::System system_;
  Bivector bivector_;
  std::vector<Polynomial> ideal_;
  bool plain_leads_ = true;
  std::size_t freedom_ = 0;
};

/// The Pfaffian of the rows and columns of a bivector in n variables that are named.
Polynomial pfaffian(const Bivector& p, std::size_t n, const std::vector<std::size_t>& places);

/// q^k for the coefficients of t^k in the Pfaffian of P + t Q: of the same rows and columns.
std::vector<Polynomial> pfaffian_of_pencil(const Bivector& p, const Bivector& q, std::size_t n,
                                           const std::vector<std::size_t>& places);

}  // namespace casimir::structure
