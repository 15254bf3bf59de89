#pragma once

#include <functional>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "symbolic/function_ring.hpp"
#include "symbolic/ideal.hpp"
#include "symbolic/model.hpp"
#include "symbolic/prove.hpp"
#include "symbolic/rational_matrix.hpp"

namespace casimir {

/// Something that a claim says is zero.
struct Residual {
  std::string label;                    ///< as "{M1, F1}"
  Polynomial value;                     ///< in the prover's ring
  std::function<GiNaC::ex()> by_ginac;  ///< the same by GiNaC alone: re-evaluates a witness
};

/// The common zero level of some functions.
struct Level {
  std::vector<std::string> texts;
  std::vector<GiNaC::ex> functions;
  std::vector<Polynomial> numerators;  ///< of the functions
  std::vector<SolvedRelation> solved;  ///< the same relations as a triangular set, if they are one
  std::vector<Polynomial> basis;       ///< else a Groebner basis of their ideal
  bool empty() const { return functions.empty(); }
};

/// What the claims of one case are decided with: its functions as polynomials, its flow, and the
/// search for witnesses. Deterministic: random points come from a fixed seed.
class Prover {
 public:
  /// \param further  expressions beyond those of the model that will be asked about.
  Prover(const Model& model, const std::vector<GiNaC::ex>& further);

  const Model& model() const { return model_; }
  FunctionRing& ring() { return ring_; }
  std::size_t dimension() const { return model_.variables.size(); }

  const Polynomial& bracket_entry(std::size_t i, std::size_t j) const {
    return brackets_[i * dimension() + j];
  }
  Polynomial bracket(const Polynomial& f, const Polynomial& g) const;
  /// df/dt along the flow, with the explicit dependence on time.
  Polynomial rate(const Polynomial& f) const;
  /// Of the flow: the sum of d(dx_i/dt)/dx_i.
  Polynomial divergence() const;
  std::vector<Polynomial> gradient(const Polynomial& f) const;

  Level level(const std::vector<NamedExpression>& on);
  /// Residuals that say that the level is invariant.
  std::vector<Residual> level_rates(const Level& level);

  /// Fills in verdict, evidence, residual, reason and witness: are all residuals zero on the level?
  void decide(Proof& proof, const std::vector<Residual>& residuals, const Level& level);

  /// A point of the ring at which no denominator vanishes, every assumption holds and the level's
  /// functions are zero; empty if none was found.
  std::optional<std::vector<cln::cl_RA>> random_point(const Level& level);
  std::optional<std::vector<cln::cl_RA>> random_point(const Level& level,
                                                      const FunctionRing::Freedom& freedom);

  /// Exact values of the symbols of such a point, by name; variables first.
  std::vector<std::pair<std::string, std::string>> describe(
      const std::vector<cln::cl_RA>& point) const;

 private:
  bool vanishes_on(const Residual& residual, Polynomial& rest, const Level& level, Proof& proof);
  static std::vector<GiNaC::symbol> symbols_of(const Model& model);
  static std::vector<GiNaC::ex> expressions_of(const Model& model,
                                               const std::vector<GiNaC::ex>& further);
  cln::cl_RA draw();
  bool solve_level(std::vector<cln::cl_RA>& point, const Level& level);
  GiNaC::exmap substitution(const std::vector<cln::cl_RA>& point) const;
  bool inside_assumptions(const std::vector<cln::cl_RA>& point) const;
  std::optional<Witness> witness(const Residual& residual, const Polynomial& numerator,
                                 const Level& level);

  const Model& model_;
  FunctionRing ring_;
  std::vector<Polynomial> brackets_;
  std::vector<Polynomial> field_;
  std::mt19937 random_{20190101};
};

}  // namespace casimir
