#pragma once

#include <string>
#include <utility>
#include <vector>

#include "symbolic/model.hpp"
#include "symbolic/prove.hpp"
#include "symbolic/search/watch.hpp"

namespace casimir::search {

/// A limit of the degree in some functions of the ansatz, each of which counts 1.
struct DegreeIn {
  /// Names of the ansatz, or `momenta`, `coordinates` (of a canonical case) and `rest`: what no
  /// other limit names.
  std::vector<Text> names;
  Text degree;  ///< a whole number, not negative
};

/// What a user asks for.
struct Request {
  /// Highest, weighted; negative where `degree_in` alone limits the degrees.
  int degree = 0;
  bool casimirs = false;                         ///< Casimir functions instead of integrals
  std::vector<Text> on;                          ///< the common zero level of these
  std::vector<Text> functions;                   ///< that the ansatz may use besides the variables
  std::vector<std::pair<Text, Text>> weights{};  ///< name and weight; 1 for the others
  std::vector<NamedExpression> known{};          ///< integrals that are not to be found again
  std::vector<DegreeIn> degree_in{};             ///< further limits
  /// The weights by which the equations of motion are quasi-homogeneous, instead of `weights`.
  bool own_weights = false;
  /// Inverses that the equations of motion or the Hamiltonian contain are functions of the ansatz.
  /// On a level they are not, where cofactors are looked for with polynomials.
  bool denominators = false;
  /// Casimir functions are integrals like others: none are looked for first and taken as known.
  bool casimirs_are_integrals = false;
};

/// A function that was found.
struct Found {
  GiNaC::ex value;   ///< over the symbols of the model
  std::string text;  ///< the value or its negative, in the notation of case files
  int degree = 0;    ///< weighted
  Verdict verdict = Verdict::undecided;
  bool independent = true;  ///< functionally, of what stands before it
};

/// What a search found, and whether that is all.
struct Report {
  ClaimKind kind = ClaimKind::integral;  ///< or `casimir`, `conditional`
  std::vector<Found> found;              ///< without what the known ones generate
  std::vector<Found> casimirs;           ///< polynomial ones, found first and taken as known
  bool hamiltonian = false;              ///< it was taken as known
  std::size_t trivial = 0;           ///< dimension of what those generate up to the degree, with 1
  bool complete = false;             ///< proved: there are no others
  std::string reason;                ///< where not
  std::vector<std::string> generic;  ///< parameters that it is about generic values of
  /// What is found is a polynomial in, beside the variables and the time: functions of the
  /// equations, as they are computed with, and those that were asked for.
  std::vector<std::string> functions;
  /// Where they are not all 1: of all functions of the ansatz, and the time.
  std::vector<std::pair<std::string, int>> weights;
  /// The limits beside the degree, with the names that they are of.
  std::vector<std::pair<std::vector<std::string>, int>> degree_in;
  std::size_t unknowns = 0, equations = 0, blocks = 0, largest_block = 0;
};

/// Finds the polynomial integrals (or Casimir functions) of a case up to a degree, exactly, and
/// proves each. Whether there are others is decided modulo a prime, where there can only be more.
/// \throws CaseError      for names or expressions that cannot be read
/// \throws ModelError     for what this search cannot treat
/// \throws TooMuchMemory, TimeUp
Report find_integrals(const Model& model, const Request& request, const Watch& watch = {});

/// Values of parameters for which there is an additional integral.
struct Condition {
  std::vector<std::pair<std::string, std::string>> parameters;  ///< name and value, over the others
  std::vector<GiNaC::ex> values;                                ///< the same values, in this order
  std::string relation;      ///< an irreducible polynomial that vanishes; empty for a point
  std::vector<Found> found;  ///< what is additional there; empty where this was not confirmed
  Verdict verdict = Verdict::undecided;  ///< whether all that was found there is proved
};

/// What a search for values of parameters found, and whether that is all.
struct ConditionReport {
  Report generic;  ///< for generic values of all parameters
  std::vector<Condition> conditions;
  bool complete = false;  ///< proved: there is no other value, curve or set
  /// No other hypersurface: there may be sets of two and more conditions.
  bool sets_open = false;
  std::string reason;  ///< where it is not complete
};

/// The values of some parameters at which additional integrals appear: where a block of equations
/// loses rank. Each is confirmed by an exact search there; Casimir functions that are new there
/// count as well. For one parameter in which the equations are polynomials these are all values;
/// for several, all hypersurfaces, and the sets of two and three conditions that a search among
/// simple ones finds. Where a parameter is inside a function, simple values are tried.
/// \param free  names of parameters
/// \throws as find_integrals
ConditionReport find_conditions(const Model& model, const Request& request,
                                const std::vector<Text>& free, const Watch& watch = {});

}  // namespace casimir::search
