#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "symbolic/search/degree_limit.hpp"
#include "symbolic/search/modular/echelon.hpp"
#include "symbolic/search/modular/linear_map.hpp"
#include "symbolic/search/modular/span.hpp"
#include "symbolic/search/watch.hpp"

namespace casimir::search {

/// A function that others are made of.
struct Generator {
  Polynomial function;
  int degree;  ///< weighted
};

/// What a search has to solve.
struct Problem {
  Fields fields;
  std::vector<int> weights;  ///< one for each place; positive
  int degree = 0;            ///< highest, weighted
  /// Where there are any, the unknowns are the monomials within all of them, and none has a degree
  /// above `degree`.
  std::vector<DegreeLimit> limits{};
  std::vector<Polynomial> on;    ///< the level, if any
  std::vector<Generator> known;  ///< that are not to be found again, nor what they generate
  /// Which places are those of a tensor's components: where there are any, only functions that are
  /// linear in them are looked for. Their weights are 1, and count in the degree.
  std::vector<bool> fibre{};
};

/// How many of the variables of a monomial are a tensor's components.
int fibre_degree(const std::uint8_t* exponents, const std::vector<bool>& fibre);

/// The unknowns of a problem. On a level, and where the atoms have relations, only functions are
/// looked for that no relation makes simpler, and cofactors of the relations are unknowns too.
struct Ansatz {
  Monomials monomials;
  std::vector<Relation> relations;
  /// Whether the leading monomials of the relations have no variable in common: then what is in
  /// their ideal has cofactors of the degrees that are searched.
  bool coprime = true;
  /// Whether the monomials are linearly independent as functions.
  bool independent = true;
  /// Whether what the relations put in the place of a monomial is within the limits as well.
  bool closed = true;
};

/// \throws TooMuchMemory
Ansatz make_ansatz(const System& system, const Problem& problem, const Watch& watch);

/// All monomials of a problem but those with silent atoms. These may obey relations.
/// \throws TooMuchMemory
Monomials visible_monomials(const System& system, const Problem& problem, const Watch& watch);

/// What came of it.
struct Solution {
  std::vector<Generator> found;
  std::size_t trivial = 0;  ///< dimension of what the known ones generate, with the constants
  std::size_t found_dimension = 0;  ///< what the found ones add to that
  bool complete = false;            ///< there are no others: proved
  std::string reason;               ///< where it is not complete
  std::size_t unknowns = 0, equations = 0, blocks = 0, largest_block = 0;
};

/// All polynomials up to a degree that the fields annihilate (on the level), less those that the
/// known ones generate. Complete where the null space modulo a prime is no larger than what was
/// found, as it can only be larger than that over the rationals. With symbolic parameters all this
/// is about generic values of them.
/// \throws TooMuchMemory, TimeUp
Solution solve(const System& system, const Problem& problem, const Watch& watch);

/// The products of generators that a problem has among its solutions, up to a degree, without those
/// that use only the first `old` generators: exponents for each.
std::vector<std::vector<int>> known_products(const std::vector<Generator>& generators,
                                             const Problem& problem, int degree, std::size_t old);

/// More of them: those of a higher degree that the relations between the functions bring back
/// within the problem, as sqrt(x)^2 = x does. A moderate number of products is tried.
std::vector<std::vector<int>> lowered_products(const System& system,
                                               const std::vector<Generator>& generators,
                                               const Problem& problem, std::size_t old);

/// The weighted degree of a polynomial in the variables at `places`.
int weighted_degree(const Polynomial& p, const std::vector<std::size_t>& places,
                    const std::vector<int>& weights);

/// The rank of the functions' gradients at a random point modulo a prime, which bounds the generic
/// rank from below.
std::size_t rank_of_gradients(const System& system, const std::vector<Polynomial>& functions);

}  // namespace casimir::search
