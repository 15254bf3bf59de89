#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "symbolic/function_ring.hpp"
#include "symbolic/level.hpp"
#include "symbolic/model.hpp"
#include "symbolic/point_search.hpp"
#include "symbolic/prove.hpp"
#include "symbolic/rational_matrix.hpp"

namespace casimir {

/// Something that a claim says is zero.
struct Residual {
  std::string label;                    ///< as "{M1, F1}"
  Polynomial value;                     ///< in the prover's ring
  std::function<GiNaC::ex()> by_ginac;  ///< the same by GiNaC alone: re-evaluates a witness
};

struct ExpressionPairLess {
  using Pair = std::pair<GiNaC::ex, GiNaC::ex>;
  bool operator()(const Pair& a, const Pair& b) const {
    const int order = a.first.compare(b.first);
    return order != 0 ? order < 0 : a.second.compare(b.second) < 0;
  }
};

/// What the claims of one case are decided with: its functions as polynomials, its flow, and the
/// search for witnesses. Deterministic: random points come from a fixed seed.
class Prover {
 public:
  /// \param expressions  what will be asked about, beside the bracket and the flow.
  Prover(const Model& model, const std::vector<GiNaC::ex>& expressions);

  const Model& model() const { return model_; }
  FunctionRing& ring() { return ring_; }
  const FunctionRing& ring() const { return ring_; }
  std::size_t dimension() const { return model_.variables.size(); }

  /// An expression in the ring; its denominators are from now on part of what a proof assumes.
  const Polynomial& convert(const GiNaC::ex& expression);
  /// Forgets what was divided by so far: the next claim begins.
  void begin_claim() {
    divided_by_.clear();
    spectral_.reset();
  }
  /// The claim is about this spectral parameter. Witnesses give its value, and not those of other
  /// Lax pairs, which may have the same name.
  void set_spectral(const std::optional<GiNaC::symbol>& spectral) { spectral_ = spectral; }

  const Polynomial& bracket_entry(std::size_t i, std::size_t j) const {
    return used(brackets_[i * dimension() + j]);
  }
  /// dx_i/dt for every coordinate.
  const std::vector<Polynomial>& field() const;
  Polynomial bracket(const Polynomial& f, const Polynomial& g) const;
  /// The numerator of {f, g} for functions of the case, kept since several claims ask for the same.
  Polynomial bracket(const GiNaC::ex& f, const GiNaC::ex& g);
  /// J grad f for a function of the case, kept: entry i is {x_i, f}.
  const std::vector<Polynomial>& flow(const GiNaC::ex& f);
  /// J times a gradient.
  std::vector<Polynomial> flow_of(const std::vector<Polynomial>& slope) const;
  /// df/dt along the flow, with the explicit dependence on time.
  Polynomial rate(const Polynomial& f) const;
  /// Of the flow: the sum of d(dx_i/dt)/dx_i.
  Polynomial divergence() const;
  std::vector<Polynomial> gradient(const Polynomial& f) const;

  Level level(const std::vector<NamedExpression>& on);
  /// Residuals that say that the level is invariant.
  std::vector<Residual> level_rates(const Level& level);

  /// Is the common zero level of the functions carried into itself? That their rates vanish there
  /// is necessary, but not enough: on q = 0 so does that of q^2, whatever the motion. The rates
  /// have to lie in the ideal of the functions; one that only vanishes on the level joins them, and
  /// its own rate has to vanish too, and so on.
  void decide_invariance(Proof& proof, std::vector<NamedExpression> functions);

  /// Fills in verdict, evidence, residual, reason and witness: are all residuals zero on the level?
  void decide(Proof& proof, const std::vector<Residual>& residuals, const Level& level);

  /// An exact point inside every assumption at which the function is shown not to be zero; empty if
  /// none was found.
  std::optional<Witness> nonzero_point(const Residual& function);

  /// A point of the ring at which no denominator vanishes, every assumption holds and the level's
  /// functions are zero; empty if none was found.
  std::optional<Point> random_point(const Level& level);

  /// Exact values of the symbols of such a point, by name; variables first.
  std::vector<std::pair<std::string, std::string>> describe(const Point& point) const;

 private:
  const Polynomial& used(const Polynomial& p) const {
    if (!ring_.is_polynomial()) ring_.mark_denominators(p, divided_by_);
    return p;
  }
  bool vanishes_by_substitution(const Residual& residual, const Level& level) const;
  Polynomial along(const Polynomial& f, const std::vector<Polynomial>& field) const;
  /// Whether the residual is a combination of the level's functions (where nothing that the level
  /// was solved by vanishes).
  bool in_ideal(const Residual& residual, const Level& level);
  bool vanishes_on(const Residual& residual, Polynomial& rest, const Level& level, Proof& proof);
  static std::vector<GiNaC::symbol> symbols_of(const Model& model);
  using NamedValues = std::vector<std::pair<std::string, std::string>>;
  NamedValues without_other_spectra(NamedValues all) const;
  static std::vector<GiNaC::ex> with_dynamics(const Model& model,
                                              std::vector<GiNaC::ex> expressions);

  const Model& model_;
  FunctionRing ring_;
  std::vector<Polynomial> brackets_;
  std::vector<Polynomial> field_;
  std::unordered_map<GiNaC::ex, std::vector<Polynomial>> flows_;
  std::map<std::pair<GiNaC::ex, GiNaC::ex>, Polynomial, ExpressionPairLess> known_brackets_;
  PointSearch points_;
  std::optional<GiNaC::symbol> spectral_;
  mutable std::vector<bool> divided_by_;  ///< which of the ring's denominators
};

}  // namespace casimir
