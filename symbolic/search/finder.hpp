#pragma once

#include "symbolic/search/ansatz_degrees.hpp"
#include "symbolic/search/search.hpp"

namespace casimir::search {

/// As of a prover, of the one that the search has.
std::optional<std::string> thin_domain(System& system);

/// Everything that one search of a case needs, from reading to proof.
class Finder {
 public:
  /// Borrows all three.
  Finder(const Model& model, const Request& request, const Watch& watch);

  Report run();

  System& system() { return system_; }
  const System& system() const { return system_; }
  /// The problem of the integrals, to be found beside the known ones.
  Problem integral_problem(std::vector<Generator> known);

 private:
  std::vector<Generator> casimirs_as_needed();
  std::vector<Found> described(const std::vector<Generator>& generators,
                               const std::vector<Generator>& known, ClaimKind kind);
  void prove_all(std::vector<Found>& list, ClaimKind kind) const;
  void check_level();
  void take(const Solution& solution);
  void doubt();
  void drop_constants(std::vector<Generator>& found);

  const Model& model_;
  const Request& request_;
  const Watch& watch_;
  std::vector<NamedExpression> on_, known_;
  System system_;
  AnsatzDegrees degrees_;
  Report report_;
  std::optional<std::string> level_reason_;  ///< why it is not known what vanishes on the level
};

}  // namespace casimir::search
