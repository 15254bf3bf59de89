#pragma once

#include <functional>
#include <list>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "symbolic/algebra/rational_matrix.hpp"
#include "symbolic/functions/function_ring.hpp"
#include "symbolic/model.hpp"
#include "symbolic/proof/level.hpp"
#include "symbolic/proof/points/point_search.hpp"
#include "symbolic/proof/points/real_level_point.hpp"
#include "symbolic/proof/points/real_point.hpp"
#include "symbolic/prove.hpp"

namespace casimir {

/// Something that a claim says is zero.
struct Residual {
  std::string label;                    ///< as "{M1, F1}"
  Polynomial value;                     ///< in the prover's ring
  std::function<GiNaC::ex()> by_ginac;  ///< the same by GiNaC alone: re-evaluates a witness
};

/// The text, or its beginning with the number of terms.
std::string shortened(std::string text, std::size_t terms);

struct ExpressionPairLess {
  using Pair = std::pair<GiNaC::ex, GiNaC::ex>;
  bool operator()(const Pair& a, const Pair& b) const {
    const int order = a.first.compare(b.first);
    return order != 0 ? order < 0 : a.second.compare(b.second) < 0;
  }
};

/// What of the system a claim speaks of: it holds, or not, also where the rest has no real value.
enum class Subject { functions, bracket, motion };

/// Real points of a model's constraints that were found.
struct PointsOfConstraints {
  /// Where many claims are about nothing, points are not looked for again and again.
  static constexpr int kMostSearches = 6;
  std::vector<BallEvaluator> points{};
  bool empty = false;  ///< none was found, whatever has values there
  int vain_searches = 0;
};

/// What the claims of one case are decided with: its functions as polynomials, its flow, and the
/// search for witnesses. Deterministic: random points come from a fixed seed.
class Prover {
 public:
  /// \param expressions  what will be asked about, beside the bracket and the flow.
  /// \param subject  what of these; the others have no signs to give, and may not be asked for
  Prover(const Model& model, const std::vector<GiNaC::ex>& expressions,
         Subject subject = Subject::motion);

  const Model& model() const { return model_; }
  FunctionRing& ring() { return ring_; }
  const FunctionRing& ring() const { return ring_; }
  std::size_t dimension() const { return model_.variables.size(); }

  /// An expression in the ring; its denominators are from now on part of what a proof assumes.
  const Polynomial& convert(const GiNaC::ex& expression);
  /// Forgets what was divided by so far: the next claim begins.
  /// \param expressions  what it is about: it says nothing where one of them has no real value
  void begin_claim(const std::vector<GiNaC::ex>& expressions, Subject subject);
  /// The claim is about this spectral parameter. Witnesses give its value, and not those of other
  /// Lax pairs, which may have the same name.
  void set_spectral(const std::optional<GiNaC::symbol>& spectral) { spectral_ = spectral; }
  /// The expressions of the claim, and those of the bracket and the flow.
  const std::vector<GiNaC::ex>& domain() const { return domain_; }

  const Polynomial& bracket_entry(std::size_t i, std::size_t j) const {
    return used(brackets_[i * dimension() + j]);
  }
  /// Whether there are equations of motion, and the claim is about them: else there is no `field`,
  /// and no `rate`.
  bool has_motion() const { return field_.size() == dimension(); }
  /// dx_i/dt for every coordinate.
  const std::vector<Polynomial>& field() const;
  Polynomial bracket(const Polynomial& f, const Polynomial& g) const;
  /// {f, g} for functions of the case, kept since several claims ask for the same.
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

  /// The common zeros of functions; each one once, since factors and bases cost time.
  const Level& level(const std::vector<NamedExpression>& on);
  /// Residuals that say that the level is invariant.
  std::vector<Residual> level_rates(const Level& level);

  /// Is the common zero level of the functions carried into itself? That their rates vanish there
  /// is necessary, but not enough: on q = 0 so does that of q^2, whatever the motion. The rates
  /// have to lie in the ideal of the functions, with cofactors that are continuous there; one that
  /// only vanishes on the level joins them, and its own rate has to vanish too, and so on.
  ///
  /// Theorem (Gronwall): if f = (f_1, .., f_k) is continuously differentiable near the level and
  /// df/dt = A f with A continuous, a solution that starts on f = 0 stays there. Hypotheses: no
  /// radicand of f vanishes on the level (`is_smooth_on`), nor does a denominator of df/dt in
  /// lowest terms (`vanishes_nowhere_on`); nor does a motion pass a pole of df/dt, else the claim
  /// is about motions that do not (`say_where_motions_leave`); the leading coefficients that the
  /// level was solved by do not vanish, or the level on which they do is invariant too.
  void decide_invariance(Proof& proof, const std::vector<NamedExpression>& functions);

  /// What is asked of functions on a level.
  enum class Smooth {
    everywhere,    ///< differentiable at each of its points, in all directions
    along_motion,  ///< differentiable along every motion on it
    without_jumps  ///< this, and no angle jumps, by a whole turn that a derivative does not see
  };

  /// Whether the functions are smooth on the level, as far as this can be told; if not, `proof` is
  /// left undecided for this reason.
  bool is_smooth_on(Proof& proof, const Level& level, const std::vector<NamedExpression>& list,
                    Smooth smooth = Smooth::everywhere);
  /// Says of a proved invariant level that motions may leave it at poles of the rates of its
  /// functions: along x' = 1, y' = 2*y/x, y is 0 and then x^2.
  void say_where_motions_leave(Proof& proof, const Level& level,
                               const std::vector<Residual>& rates);
  /// Whether a real point of the level was found at which the expressions have real values.
  bool has_points_on(const Level& level, const std::vector<GiNaC::ex>& expressions);
  /// Says of a proved claim about brackets of these functions that it holds where they are
  /// differentiable: {q + |p|, p} is 1 but where p = 0, whatever the bracket multiplies sign(p) by.
  void say_where_differentiable(Proof& proof, const std::vector<GiNaC::ex>& functions);
  /// Where a function may jump on the way of a motion: what vanishes there; empty where it is shown
  /// that it does not. The derivative of sign(x)*y along a motion may vanish wherever it has one,
  /// and still it is another constant behind x = 0; a density that jumps where the motion passes is
  /// no density there.
  ///
  /// Theorem: a function that is differentiable with rate zero along a motion but for isolated
  /// times, and continuous there, is constant on it. Continuous it is where no `jump_factors`
  /// vanishes; one that vanishes nowhere, whose sign the motion keeps (`keeps_sign`), or at whose
  /// zeros the motion has no value on either side, is passed by none.
  /// \param cuts  with the jumps of angles
  /// \param every  of the flows of all Hamiltonians, as where the claim is about the bracket alone:
  ///               what they keep the signs of are Casimir functions
  std::vector<Polynomial> passed_jumps(const Polynomial& function, bool cuts, bool every = false);
  /// Adds these places to what is said of a proved claim.
  void say_where_it_jumps(Proof& proof, const Polynomial& function, bool cuts, bool every = false);

  /// The poles of the equations, but for those that almost all motions end at or never reach.
  std::vector<Polynomial> passed_poles();
  /// Whether two functions may vanish at one point of the constraints, as far as is seen.
  bool may_meet(const Polynomial& a, const Polynomial& b);

  /// Whether `p` is not zero all over the zeros of `f` on the constraints, as far as is seen.
  bool is_nonzero_somewhere(const Polynomial& p, const Polynomial& f);
  /// Whether `p` is seen to be infinite wherever the irreducible `f` is zero, for all values of the
  /// parameters: |x|/x^2 is at x = 0, and |u|^3/u^3 is not, nor is k/x unless k is not zero.
  bool has_pole(const Polynomial& p, const Polynomial& f);
  /// The same of almost all of these points, as far as orders tell; `p` need not jump there.
  bool seems_to_have_pole(const Polynomial& p, const Polynomial& f);

  /// Does the motion keep the sign of `u`, and u = 0? Theorem: u(t) = u(0)*exp(int c dt) where
  /// du/dt = c*u along a solution with c continuous. Then |u| is differentiable along it, and has
  /// the rate c*|u|. Hypothesis: the denominator of c vanishes nowhere on the level, or the motion
  /// divides by it.
  bool keeps_sign(const Polynomial& u, const Level& level);

  /// Fills in verdict, evidence, residual, reason and witness: are all residuals zero on the level,
  /// wherever the functions of the claim have real values? A claim about nothing is not proved.
  ///
  /// Where the case has constraints a point outside of them refutes nothing. What is zero there
  /// only is left undecided, and `holds_on_constraints` says so: whether that proves the claim
  /// depends on what it says of points nearby.
  void decide(Proof& proof, const std::vector<Residual>& residuals, const Level& level);

  /// Whether the last decision found residuals that are zero on the constraints and not elsewhere.
  bool holds_on_constraints() const { return holds_on_constraints_; }
  /// Lets points outside of the constraints refute, until the next claim: for questions whose only
  /// answer of interest is `proved`, and that are not worth the time of deciding twice.
  void disregard_constraints() { constraints_count_ = false; }
  /// Functions whose common zeros are a part of the constraints: these with them.
  std::vector<NamedExpression> within_constraints(std::vector<NamedExpression> functions) const;

  /// Whether `p` is zero wherever it has a value. That its numerator is says so only where no
  /// denominator is a divisor of zero, as |x| - x is: (|x| - x)*(|x| + x) = 0.
  bool is_zero(const Polynomial& p);
  /// Whether no denominator in them is one: then they may be multiplied by their denominators.
  bool has_no_zero_divisors(const std::vector<std::vector<Polynomial>>& rows);

  /// That the claim is about something is shown elsewhere, since functions of it have no values: it
  /// is not looked at here. Until the next claim begins.
  void take_as_inhabited(bool taken) { taken_as_inhabited_ = taken; }

  /// What provers of the claims of one model have in common.
  void share(std::shared_ptr<PointsOfConstraints> points) { on_constraints_ = std::move(points); }

  /// Whether a real point of the constraints was found at which the function, and those of the
  /// claim, have values, and its own is not zero.
  bool is_nonzero_somewhere_on_constraints(const GiNaC::ex& f);
  /// Whether one was found at which it is positive, a real function.
  bool is_positive_somewhere_on_constraints(const GiNaC::ex& f);
  /// Whether it is shown that the function has no zero on the constraints.
  bool is_nowhere_zero_on_constraints(const Polynomial& p);

  /// A claim about nothing is not proved: for all points of the empty set everything is true.
  void check_inhabited(Proof& proof, const Level& level);

  /// Solutions need not be unique where a root in the equations vanishes: x = 0 and x = t^2 solve
  /// dx/dt = 2*sqrt(x), and along the first one sqrt(x) - t is no constant. Where a function has
  /// the same root it is proved to be an integral only beside its zeros.
  void say_where_motion_is_unique(Proof& proof, const NamedExpression& f);

  /// Says where roots and logarithms of the claim have values.
  void say_where_values_are(Proof& proof) const;

  /// Points for ranks and the like.
  RealPoints& real_points() { return real_points_; }

  /// A point of the ring at which no denominator vanishes, every assumption holds and the level's
  /// functions are zero; empty if none was found.
  std::optional<Point> random_point(const Level& level);

  /// A point of the level with rational coordinates, inside every assumption and at which all
  /// functions of the claim have real values; empty if none was found.
  std::optional<RealPoint> exact_point(const Level& level);

 private:
  friend class PassedJumps;
  const Polynomial& used(const Polynomial& p) const {
    if (!ring_.is_polynomial()) ring_.mark_denominators(p, divided_by_);
    return p;
  }
  Level make_level(const std::vector<NamedExpression>& on);
  /// A Groebner basis of the ideal of the level's numerators, with the relations between squares
  /// that the ring knows. Most claims do without, and it takes the longest.
  const std::vector<Polynomial>& basis_of(const Level& level);
  std::vector<Polynomial> basis_of_zeros(const std::vector<Polynomial>& functions);
  std::vector<NamedExpression> simplified(const NamedExpression& f, int depth);
  /// A function of a level with its numerator.
  struct LevelFunction {
    NamedExpression f;
    Polynomial numerator;
  };
  const std::vector<LevelFunction>& level_functions(const NamedExpression& f);
  bool vanishes_by_substitution(const Residual& residual, const Level& level) const;
  Polynomial along(const Polynomial& f, const std::vector<Polynomial>& field) const;
  /// Whether the residual is a combination of the level's functions with continuous coefficients
  /// (where nothing that the level was solved by vanishes).
  bool in_ideal(const Residual& residual, const Level& level);
  /// "c of f_i", the summand c*f_i of what has `of_numerator` times the numerator of f_i over
  /// `divisor` as a summand.
  std::string cofactor_text(const Polynomial& of_numerator, const Polynomial& divisor,
                            const Level& level, std::size_t i);
  /// A quotient in lowest terms, whose value at a witness is that of the residual; on a level what
  /// is left of its numerator there.
  std::string residual_text(const Residual& residual, const Polynomial& rest,
                            const Level& level) const;
  bool vanishes_on(const Residual& residual, Polynomial& rest, const Level& level, Proof& proof);
  void decide_on(Proof& proof, const std::vector<Residual>& residuals, const Level& level);
  void decide_with_branches(Proof& proof, const std::vector<Residual>& residuals, const Level& own);
  void decide_again_on_constraints(Proof& proof, const std::vector<Residual>& residuals,
                                   const Level& own);
  void decide_invariance_once(Proof& proof, std::vector<NamedExpression> functions);
  /// Decides again on the part of the level where what it was solved by vanishes.
  void decide_branches(
      Proof& proof, const std::vector<NamedExpression>& functions, int depth,
      const std::function<void(Proof&, const std::vector<NamedExpression>&, int)>& decide_part);
  /// What has no zero where something is said: what the motion divides by and ends at, or whatever
  /// the claim divides by, too.
  enum class Divisors { of_motion, all };
  /// Whether `p` vanishes at no point of the level at which the claim says something.
  bool vanishes_nowhere_on(const Polynomial& p, const Level& level, Divisors which = Divisors::all);
  const std::vector<Polynomial>& explicit_divisors(Divisors which);
  bool ends_motions(const Polynomial& f);
  bool ends_motions_at_poles(const Polynomial& f);
  /// Whether two functions vanish together only where a factor of this kind does.
  bool meet_only_where(const Polynomial& a, const Polynomial& b,
                       const std::function<bool(const Polynomial&)>& is_such);
  bool is_moved_by_bracket(const Polynomial& f);
  bool is_kept_where_zero(const Polynomial& g, const Polynomial& f);
  bool ends_almost_all_motions(const Polynomial& f);
  std::vector<Polynomial> kinks_of(const std::vector<Polynomial>& rates,
                                   const std::function<bool(const Polynomial&)>& is_passed_pole);
  const std::vector<Polynomial>& kinks_of_motion(bool almost);
  /// Of the flows of all Hamiltonians.
  std::vector<Polynomial> kinks_of_flows();
  /// Whether it depends on variables, or on the time.
  bool varies(const Polynomial& p) const;
  /// Whether an irreducible function vanishes nowhere, or is divided by; kept for this claim.
  bool seems_to_vanish(const Polynomial& f, Divisors which);
  bool is_kept_from_zero(const Polynomial& f, Divisors which);
  /// What holds between the functions everywhere, as c^2 - (1 - s^2): on a level such as c = 1 it
  /// says more than the normal form of the ring, that s^2 = 0.
  const std::vector<Polynomial>& square_relations();
  std::optional<Witness> witness(const Polynomial& rest, const Residual& residual,
                                 const Level& level);
  static std::vector<NamedExpression> functions_of(const Level& level);
  const std::vector<GiNaC::ex>& claim_expressions() const;
  const std::vector<GiNaC::ex>& all_expressions() const;
  bool has_inner_points();
  bool has_points_on_constraints(const Level& own);
  bool has_point_of_constraints(const std::vector<GiNaC::ex>& expressions, bool differentiable);
  void say_conditions(Proof& proof);
  static std::vector<GiNaC::symbol> symbols_of(const Model& model);
  /// What has cancelled in the equations, the bracket and the constraints, of which the subject
  /// speaks.
  static std::vector<GiNaC::ex> lost_of_dynamics(const Model& model, Subject subject);
  static std::vector<GiNaC::ex> with_dynamics(const Model& model,
                                              std::vector<GiNaC::ex> expressions, Subject subject);

  const Model& model_;
  FunctionRing ring_;
  std::vector<Polynomial> brackets_;
  std::vector<Polynomial> field_;
  std::unordered_map<GiNaC::ex, std::vector<Polynomial>> flows_;
  /// Of what was converted: which of the ring's denominators it has.
  std::unordered_map<GiNaC::ex, std::vector<bool>> denominators_of_;
  std::map<std::pair<GiNaC::ex, GiNaC::ex>, Polynomial, ExpressionPairLess> known_brackets_;
  PointSearch points_;
  std::optional<GiNaC::symbol> spectral_;
  RealPoints real_points_;
  std::vector<GiNaC::ex> claim_, domain_, all_;
  std::optional<std::vector<Polynomial>> divisors_, motion_divisors_, kinks_, kinks_almost_;
  std::optional<std::vector<Polynomial>> one_sided_poles_;  ///< of the Hamiltonian
  Subject subject_;
  struct KeptFromZero {
    Divisors which;
    Polynomial function;
    bool kept;
  };
  std::vector<KeptFromZero> kept_from_zero_;
  /// With the end of the generators that they are about.
  std::pair<std::size_t, std::vector<Polynomial>> square_relations_;
  std::optional<bool> all_inhabited_, claim_inhabited_, all_on_constraints_, claim_on_constraints_;
  std::shared_ptr<PointsOfConstraints> on_constraints_ = std::make_shared<PointsOfConstraints>();
  bool taken_as_inhabited_ = false, holds_on_constraints_ = false, constraints_count_ = true;
  /// A level, by its functions and by how much work it was worth.
  struct KnownLevel {
    std::vector<NamedExpression> on;
    bool in_branch;
    Level level;
  };
  std::list<KnownLevel> known_levels_;
  struct KnownBasis {
    std::vector<Polynomial> generators;
    bool in_branch;
    std::vector<Polynomial> basis;
  };
  std::list<KnownBasis> known_bases_;
  /// For all claims: factors cost time.
  std::map<std::string, std::pair<GiNaC::ex, std::vector<LevelFunction>>> level_functions_;
  std::vector<std::optional<bool>> never_zero_;  ///< of the ring's denominators
  std::vector<Polynomial> leads_;                ///< that the last decision took for not zero
  bool in_branch_ = false;  ///< where less work is spent: the answer may become a condition
  mutable std::vector<bool> divided_by_;  ///< which of the ring's denominators
};

}  // namespace casimir
