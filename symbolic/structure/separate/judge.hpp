#pragma once

#include "symbolic/search/watch.hpp"
#include "symbolic/structure/separate/separated_equation.hpp"
#include "symbolic/structure/separation.hpp"

namespace casimir::structure {

/// Decides what is claimed of variables that separate, by the theorems of `Separation`.
class SeparationJudge {
 public:
  /// Borrows all.
  /// \param casimirs  each of them one on the level
  /// \param points  of the level, inside all assumptions
  SeparationJudge(const Leaves& leaves, const std::vector<Polynomial>& casimirs,
                  std::vector<RealPoint>& points, SeparationNames names, const search::Watch& watch)
      : leaves_(leaves),
        casimirs_(casimirs),
        points_(points),
        names_(std::move(names)),
        watch_(watch) {}

  /// Of the roots of det(P' - u P); empty where they are no variables, or not shown to separate.
  /// \param integrals  in involution on the level, as many as degrees of freedom
  std::optional<Separation> of_bivector(const Bivector& p,
                                        const std::vector<Polynomial>& integrals) const;
  /// Of the roots of a polynomial; `separated` may have any verdict.
  /// \param poles  where one of these is zero, the coefficients have no values
  Separation of_roots(const RootCoefficients& a, const std::vector<Polynomial>& poles,
                      const std::vector<Polynomial>& integrals) const;

 private:
  Separation begin(const RootCoefficients& a, const std::vector<Polynomial>& integrals) const;
  void judge_bivector(Separation& result, const Characteristic& own,
                      const std::vector<Polynomial>& integrals) const;
  bool exclude_zeros(Separation& result, const StaeckelForm& form, RealPoint& point) const;
  void judge_multipliers(Separation& result, const RootCoefficients& a,
                         const std::vector<Polynomial>& integrals, RealPoint& point) const;
  void judge_map(Separation& result, const RootCoefficients& a, const StaeckelForm& form,
                 const std::vector<SeparatedEquation>& equations,
                 const std::vector<Polynomial>& integrals) const;
  RealPoint* judge_point(Separation& result, const RootCoefficients& a,
                         std::vector<Polynomial> nonzero) const;
  void judge_commuting(Separation& result, const RootCoefficients& a, RealPoint& point) const;
  void judge_levi_civita(Separation& result, const RootCoefficients& a,
                         const std::vector<Polynomial>& integrals, RealPoint& point) const;

  const Leaves& leaves_;
  const std::vector<Polynomial>& casimirs_;
  std::vector<RealPoint>& points_;
  SeparationNames names_;
  const search::Watch& watch_;
};

}  // namespace casimir::structure
