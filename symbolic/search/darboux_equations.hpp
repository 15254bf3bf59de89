#pragma once

#include <optional>
#include <vector>

#include "symbolic/model.hpp"
#include "symbolic/search/modular/monomials.hpp"
#include "symbolic/search/quasi_homogeneous.hpp"
#include "symbolic/search/system.hpp"

namespace casimir::search {

/// The equations X F = K F for the coefficients of a Darboux polynomial F up to a degree and of its
/// cofactor K, where X is the field of the motion, multiplied by its denominators.
class DarbouxEquations {
 public:
  /// \throws ModelError  where the equations of motion are not rational in the variables
  DarbouxEquations(const Model& model, int degree);

  /// Polynomials of one leading monomial: its coefficient is 1, those of later monomials are 0.
  struct Ansatz {
    Polynomial function, cofactor;
    std::vector<std::size_t> unknowns;  ///< the coefficients; places in the ring
    std::vector<Polynomial> equations;
  };
  /// \param leading   from 1 to one less than the number of monomials
  /// \param one_weight  parts of one weight only; for a field with weights
  Ansatz of(std::size_t leading, bool one_weight) const;
  const Monomials& monomials() const { return monomials_; }

  System& system() { return system_; }
  const System& system() const { return system_; }
  /// Variables of the system, then coefficients of F, then those of K.
  const PolynomialRing& ring() const { return ring_; }
  /// Whether the whole field is quasi-homogeneous: then a cofactor has the weight of 1/t, and the
  /// parts of one weight of a Darboux polynomial are some themselves, all with its cofactor.
  bool has_weights() const { return weights_.has_value(); }

  /// X applied to a polynomial in the coordinates.
  Polynomial rate(const Polynomial& p) const;
  /// Empty where coefficients are left.
  std::optional<Polynomial> in_system_ring(const Polynomial& p) const;
  /// The degree in the coordinates: parameters are elements of the field.
  int degree_in_coordinates(const Polynomial& p) const;
  /// The irreducible polynomial over the field of the parameters that p is up to a factor from that
  /// field; empty where p is a product of others, which are found on their own. Gauss's lemma: what
  /// is irreducible over Q, and has a coordinate, is irreducible over Q(parameters).
  std::optional<Polynomial> irreducible(const Polynomial& p) const;

 private:
  void find_grading(const Model& model);
  int weight(const Monomials& list, std::size_t i) const;
  Polynomial monomial(const Monomials& list, std::size_t i) const;
  std::vector<Polynomial> coefficients(const Polynomial& p) const;

  System system_;
  std::size_t dimension_;
  Monomials monomials_, cofactor_monomials_;
  std::size_t first_f_, first_k_;
  std::optional<Weights> weights_;
  PolynomialRing ring_;
  std::vector<Polynomial> field_;
};

}  // namespace casimir::search
