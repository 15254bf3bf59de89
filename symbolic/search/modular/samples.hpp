#pragma once

#include <cstdint>
#include <vector>

#include "symbolic/search/modular/equations.hpp"
#include "symbolic/search/modular/linear_map.hpp"
#include "symbolic/search/watch.hpp"

namespace casimir::search {

/// Equations for the coefficients of functions that obey relations, as roots and inverses do, from
/// values at random points modulo a prime.
///
/// Theorem: the functions of a system are a ring that is made of one of polynomials over the whole
/// numbers by adjoining roots of monic equations and inverses. No whole number divides zero in it,
/// so that a combination of them that is zero, has whole coefficients and is divided by the prime
/// is zero at every point of the ring modulo the prime. What holds for functions holds for their
/// values there; so there are at least as many solutions modulo the prime as functions, at any
/// values of the parameters and whatever the points. No cofactors of the relations are needed.
class Samples {
 public:
  /// What a combination of monomials has to be.
  enum class Goal { zero, annihilated };

  /// \param system, fields, modulus  borrowed
  Samples(const System& system, const Fields& fields, const Modulus& modulus, std::uint64_t seed);

  /// Until there are `count` of them. Their constants are those given, or are drawn for each where
  /// that is null; those at `parameters` are free of any relations then.
  /// \return  false where no points were found
  bool draw(std::size_t count, const Point* constants, const std::vector<std::size_t>& parameters,
            const Watch& watch);
  std::size_t size() const { return samples_.size(); }

  /// A row for each of the first `rows` points.
  /// \param columns  of the monomials
  /// \param places   of the monomials' variables in the ring
  std::vector<std::vector<Entry>> rows(Goal goal, const Monomials& monomials,
                                       const std::vector<std::uint32_t>& columns,
                                       const std::vector<std::size_t>& places,
                                       std::size_t rows) const;

 private:
  /// A polynomial modulo the prime, for many values.
  struct Term {
    Residue number;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> powers;
  };
  using Terms = std::vector<Term>;
  struct Sample {
    Point point;
    std::vector<Residue> growth;  ///< of each place's variable: its rate divided by itself
  };
  Terms flat(const Polynomial& p) const;
  Residue value(const Terms& terms, const Point& point) const;
  bool add(Point point);

  const System& system_;
  const Fields& fields_;
  const Modulus& modulus_;
  std::mt19937_64 random_;
  std::vector<std::vector<Terms>> rates_;
  std::vector<Sample> samples_;
};

}  // namespace casimir::search
