#pragma once

#include "symbolic/structure/bracket_equations.hpp"
#include "symbolic/structure/brackets.hpp"

namespace casimir::structure {

/// What the searches for brackets have in common: the polynomial integrals of a motion, its
/// invariant bivectors, and what is made of constants that were found.
class BracketSearch {
 public:
  /// \param hamiltonian_degree  highest, of the integrals that are taken as Hamiltonians
  /// \throws ModelError  where the equations of motion are not polynomials
  BracketSearch(const Model& model, int hamiltonian_degree, const search::Watch& watch);

  std::size_t dimension() const { return space_.lift().dimension(); }
  TensorSpace& space() { return space_; }
  /// Linearly independent integrals, without the constants, in the ring of the space: by random
  /// points modulo a prime, so that by bad luck one may be missing.
  const std::vector<Polynomial>& integrals() const { return integrals_; }
  /// What spans all of them for certain.
  const std::vector<Polynomial>& all_integrals() const { return all_integrals_; }
  bool integrals_are_all() const { return integrals_are_all_; }
  /// The motion times a function of the parameters, so that no denominator is left.
  const std::vector<Polynomial>& motion() const { return motion_; }

  /// The sum of constants times bivectors, made primitive; the factor by which it was multiplied.
  std::pair<Bivector, GiNaC::ex> combination(const std::vector<Bivector>& basis,
                                             const std::vector<GiNaC::ex>& constants);
  GiNaC::ex combination(const std::vector<Polynomial>& functions,
                        const std::vector<GiNaC::ex>& constants) const;
  /// The function of the parameters that the motion was multiplied by.
  GiNaC::ex factor_of_motion() const;

  /// H with P dH = X, among the integrals; empty where there is none or it is not found.
  std::optional<GiNaC::ex> hamiltonian_of(const Bivector& p);
  /// Of bivectors, those that are not in the linear span of `base` and of shorter ones before them,
  /// the shortest first.
  std::vector<Bivector> shortest_independent(std::vector<Bivector> list,
                                             const std::vector<Bivector>& base) const;
  /// A function in the notation of case files, its denominator behind it.
  std::string text_of(const GiNaC::ex& function);

  /// Everything of a bracket that follows from its components and its Hamiltonian, with proofs.
  Bracket described(const Bivector& p, const std::optional<GiNaC::ex>& hamiltonian);

  /// Why it is not known that nothing was lost; empty where it is.
  std::optional<std::string> doubt(const std::vector<search::Branch>& families) const;

 private:
  void take_integrals(int degree);
  std::string signed_text(const GiNaC::ex& polynomial);

  const Model& model_;
  const search::Watch& watch_;
  TensorSpace space_;
  std::vector<Polynomial> integrals_, all_integrals_, motion_;
  bool integrals_are_all_ = false;
  std::string integrals_reason_;
  int hamiltonian_degree_;
};

/// The degree of the equations of motion.
int degree_of_motion(const Model& model);

/// The values that are tried for the free constants of a family, the simplest first: one of them 1
/// and the others 0, then two of them, then small numbers.
std::vector<std::vector<GiNaC::ex>> simple_constants(std::size_t count);

/// Whether one bivector is a multiple of the other by a number or a function of parameters.
bool are_proportional(const Bivector& p, const Bivector& q);

}  // namespace casimir::structure
