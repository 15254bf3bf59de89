#pragma once

#include <string>
#include <vector>

#include "symbolic/case/limits.hpp"
#include "symbolic/model.hpp"

namespace casimir {

/// A phase space under the name of the case, or of the algebra, that has it.
struct Coordinates {
  std::string name;
  std::vector<GiNaC::symbol> variables;
  PoissonStructure bracket;
  bool canonical = false;
  std::vector<Assumption> domain;            ///< about the variables alone
  std::vector<NamedExpression> constraints;  ///< about the variables alone
  std::vector<NamedExpression> casimirs;
  bool linear_bracket = false;
  std::vector<GiNaC::ex> bracket_domain{};  ///< as of Model
};

/// One step between two sets of variables: a map, or a right inverse of one.
struct CoordinateChange {
  std::string name;      ///< of the map in its case file
  std::size_t from, to;  ///< indices of Atlas::sets
  bool forward = true;   ///< the map itself: Poisson, and usable for the equations
  /// One of several formulas, for a part of the space.
  struct Branch {
    std::vector<GiNaC::ex> expressions;  ///< one for each variable of `to`, over those of `from`
    std::vector<Assumption> domain;      ///< over the variables of `from`
  };
  std::vector<Branch> branches;        ///< the first whose domain holds is used
  std::vector<NamedExpression> on;     ///< where the map is Poisson, over those of `from`
  std::vector<NamedExpression> image;  ///< of an inverse: where it is one, over those of `from`
  std::vector<GiNaC::ex> domain{};     ///< of a map: as of PoissonMap, over those of `from`
};

/// Sets of variables, and the maps between them that have an inverse.
struct Atlas {
  std::vector<Coordinates> sets;
  std::vector<CoordinateChange> changes;

  /// Adds the variables of a case and its maps. Maps without an inverse are no change of variables.
  void add(const Model& model, bool canonical);

  /// The set of that name.
  /// \throws ModelError  with the nearest name
  std::size_t named(const std::string& name) const;

  /// The set that a case is written in: that of its name, or the first with the same bracket in the
  /// order of the variables (for canonical variables under the same names).
  /// \throws ModelError  if there is none
  std::size_t of(const Model& model) const;

  /// The shortest chain of changes; with `forward` of maps alone. Empty if there is none, or if
  /// both sets are one.
  std::vector<const CoordinateChange*> path(std::size_t from, std::size_t to, bool forward) const;

 private:
  /// The set of the variables of a model, which is known from now on.
  std::size_t set_of(const Model& model, bool canonical);
  /// The changes along the maps of a model, whose variables are those of the set `from`.
  void add_changes(const Model& model, std::size_t from);
  std::size_t set_for(const PoissonMap& map);
};

/// The image of an exact point: the expressions that the first branch in whose domain it lies
/// gives.
/// \param limits  of the case that the point is of
/// \throws SingularPoint  where no branch applies, or the point is not in the image of the map
std::vector<GiNaC::ex> image_of(const Atlas& atlas, const CoordinateChange& change,
                                const std::vector<GiNaC::ex>& point, const Limits& limits);

/// The case in other variables: the Hamiltonian, the integrals, the conditional integrals, the
/// invariant relations and the Lax pairs are carried along the maps, the scenes along their
/// inverses. What is observed and the reference states are not carried. Names that the new
/// variables take get an underscore.
/// \throws ModelError     if no maps lead from the set to the variables of the case
/// \throws SingularPoint  never: a scene whose initial state has no image is unusable
Model in_coordinates(const Model& model, const Atlas& atlas, const std::string& set);

}  // namespace casimir
