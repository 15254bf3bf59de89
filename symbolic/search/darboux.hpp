#pragma once

#include <string>
#include <vector>

#include "symbolic/model.hpp"
#include "symbolic/prove.hpp"
#include "symbolic/search/watch.hpp"

namespace casimir::search {

/// A polynomial whose rate is a multiple of it, so that its zero level is invariant.
struct DarbouxPolynomial {
  GiNaC::ex value;                     ///< over the symbols of the model
  std::string text, cofactor;          ///< in the notation of case files
  GiNaC::ex cofactor_value;            ///< over the symbols of the model
  std::vector<std::string> relations;  ///< between coefficients that are left, as algebraic numbers
  int degree = 0;
  Verdict verdict = Verdict::undecided;
};

/// A product of powers of Darboux polynomials, times an exponential, that the motion keeps.
struct DarbouxCombination {
  /// What it is for.
  enum class Kind {
    integral,
    multiplier,      ///< the density of an invariant measure
    time_dependent,  ///< constant along the motion, with the time in it
  };
  Kind kind = Kind::integral;
  std::string text;       ///< with the bases for their absolute values
  bool rational = false;  ///< a quotient of polynomials: whole exponents and no exponential
  Verdict verdict = Verdict::undecided;
  std::string evidence = {};  ///< what the proof says beside, and where it holds
};

/// "integral", "multiplier" or "time_dependent".
std::string to_string(DarbouxCombination::Kind kind);

/// What a search for them found, and whether that is all.
struct DarbouxReport {
  std::vector<DarbouxPolynomial> found;  ///< irreducible, with a cofactor that is not zero
  std::vector<DarbouxCombination> combinations;
  /// Proved: every integral that is a product of powers of those found, times an exponential of a
  /// polynomial up to the degree, follows from the combinations and the polynomial integrals.
  bool all_integrals_combined = false;
  /// There are no others, for generic parameters; of those that `has_conjugates` tells of, the
  /// products alone are among those found, or are integrals with complex factors.
  bool complete = false;
  /// Some of them, or integrals, are products of others whose coefficients are algebraic numbers ..
  bool has_conjugates = false;
  bool has_moving_conjugates = false;  ///< .. that depend on parameters, as the root of one
  std::string reason;
  std::vector<std::string> generic;  ///< parameters
};

/// All Darboux polynomials up to a degree that are no integrals and are irreducible over the
/// rational numbers and the parameters: the equations dF/dt = K F for the coefficients of F and K,
/// solved by cases. Proved one by one. With coefficients that are algebraic numbers there may be
/// factors of these.
/// \throws ModelError  where the equations of motion are not polynomials
DarbouxReport find_darboux(const Model& model, int degree, const Watch& watch = {});

/// The same without the combinations.
DarbouxReport find_darboux_polynomials(const Model& model, int degree, const Watch& watch = {});

/// Integrals that are quotients of polynomials.
struct RationalReport {
  std::vector<DarbouxCombination> integrals;  ///< with those that are products of integer powers
  /// There are no others with factors up to the degree that do not follow from these and the
  /// polynomial integrals, for generic parameters.
  bool complete = false;
  std::string reason;
  std::vector<std::string> generic;  ///< parameters
};

/// Those with irreducible factors up to a degree.
///
/// Theorem (Darboux): of a rational integral in lowest terms every irreducible factor of the
/// numerator and of the denominator is a Darboux polynomial or a polynomial integral. So there are
/// no others with factors up to the degree where all irreducible Darboux polynomials up to it are
/// known (with algebraic coefficients too) and all of their products that are integrals, and these
/// are quotients: products of others with these may be quotients too. `find_darboux` says the first
/// two of itself.
/// \throws ModelError  as `find_darboux`
RationalReport find_rational(const Model& model, int degree, const Watch& watch = {});

}  // namespace casimir::search
