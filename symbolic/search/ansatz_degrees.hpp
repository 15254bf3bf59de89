#pragma once

#include <string>
#include <vector>

#include "symbolic/search/integral_space.hpp"
#include "symbolic/search/search.hpp"

namespace casimir::search {

/// The degrees up to which a search goes: read from a request, over the atoms of a system.
class AnsatzDegrees {
 public:
  /// \throws CaseError   for names and numbers that cannot be read
  /// \throws ModelError  where the limits leave infinitely many monomials, or too high ones, and
  ///     where weights are asked for by which the equations are not quasi-homogeneous
  AnsatzDegrees(const System& system, const Request& request);

  /// The weights, the degree and the limits of a problem with the fields of these places, which are
  /// atoms; of more of them nothing is in the ansatz.
  void set(Problem& problem) const;
  /// By the weights of the request, which may be negative.
  int degree_of(const Polynomial& p) const;
  /// By the weights that a problem has, which are positive.
  int order_of(const Polynomial& p) const;

  /// Whether there are limits beside the degree, or weights that are not positive.
  bool is_limited() const { return !limits_.empty(); }
  /// For people, as in `Report`.
  std::vector<std::pair<std::string, int>> named_weights() const;
  std::vector<std::pair<std::vector<std::string>, int>> named_limits() const;

 private:
  std::size_t place_of(const Text& name) const;
  void read_weights();
  void take_own_weights();
  void read_limits();
  std::vector<std::size_t> places_named(const std::vector<Text>& names) const;
  [[noreturn]] void refuse_unlimited(std::size_t atom) const;
  void check() const;

  const System& system_;
  const Request& request_;
  std::vector<std::string> names_;    ///< of the atoms
  std::vector<int> weights_, order_;  ///< of the request; and positive
  std::vector<DegreeLimit> groups_;   ///< of `degree_in`
  std::vector<DegreeLimit> limits_;   ///< all that there are, where the degree alone is not enough
};

}  // namespace casimir::search
