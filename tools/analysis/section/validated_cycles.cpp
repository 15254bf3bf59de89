#include "tools/analysis/section/validated_cycles.hpp"

#include <cln/float.h>
#include <cln/real.h>
#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "codegen/specialise.hpp"
#include "symbolic/algebra/ball_evaluator.hpp"
#include "symbolic/prove.hpp"
#include "tools/analysis/estimate/cancelled_parts.hpp"
#include "tools/analysis/proof/ball_matrix.hpp"
#include "tools/analysis/proof/proved_facts.hpp"
#include "tools/analysis/run/exact_values.hpp"
#include "tools/analysis/run/prepared_scene.hpp"
#include "tools/analysis/run/validated.hpp"
#include "tools/analysis/section/flow_to_time.hpp"

namespace casimir {
namespace {

/// The double, and what is near it.
void set_near(arb_ptr ball, double value) {
  arb_set_d(ball, value);
  mag_t ulp;
  mag_init(ulp);
  mag_set_d(ulp, std::ldexp(std::abs(value), -52));
  arb_add_error_mag(ball, ulp);
  mag_clear(ulp);
}

class Prover {
 public:
  /// \param scene  with the symbols of the parameters that have ranges.
  Prover(const Model& model, const Scene& scene, const SectionProblem& problem,
         const Intervals& ranges, double seconds)
      : problem_(problem),
        variables_(model.variables),
        is_range_(!ranges.empty()),
        level_functions_(level_functions(model, scene, problem)),
        flow_(model, scene, level_functions_, ranges),
        levels_(BallFunctions(model.variables, values_of(level_functions_)).over(ranges)),
        level_derivatives_(levels_.derivatives()),
        plane_(model.variables, {problem.plane_function}),
        plane_derivatives_(plane_.derivatives()),
        structure_(
            BallFunctions(model.variables, structure_matrix(model, scene), model.variables.size())
                .over(ranges)),
        keeps_area_(verdict_on_jacobi(model, scene) == Verdict::proved),
        seconds_(seconds) {}

  /// \throws NotProved, NotCertified
  ProvedCycle proved(const Cycle& cycle) {
    const std::size_t n = variables_.size();
    BallMatrix z(n + 1, 1);
    for (std::size_t i = 0; i < n; ++i)
      arb_set_d(z.at(i), cycle.points.front().x[static_cast<Eigen::Index>(i)]);
    arb_set_d(z.at(n), cycle.period);
    // The cycle that is given is a good one, most often.
    constexpr int kProofRounds = 2;
    for (int round = 0; round < kProofRounds; ++round) {
      const BallMatrix y = polished(z, round == 0);
      const BallMatrix at = value(z, flow_(z, false, seconds_));
      double size = 1e-3;
      for (std::size_t i = 0; i < n; ++i) size = std::max(size, std::abs(z.near(i)));
      if (is_range_) {
        if (round + 1 < kProofRounds) continue;
        return proved_over_range(z, y, at, size);
      }
      for (const double radius : {1e-10, 1e-8, 1e-7}) {
        const BallMatrix box = widened(z, radius * size);
        const BoxImage image = flow_(box, true, seconds_);
        const BallMatrix solution = krawczyk(z, y, at, derivatives(box, image), box);
        if (inside(solution, box)) return checked(box, solution, image);
      }
    }
    throw NotProved{
        "Krawczyk's test fails: the cycle is nearly degenerate, or not known well enough"};
  }

 private:
  /// One step of Newton's method. \return  an approximate inverse of the derivatives before it.
  BallMatrix polished(BallMatrix& z, bool is_first) {
    const BoxImage image = flow_(z, true, seconds_);
    if (is_first) choose_closing(z);
    BallMatrix y(z.rows(), z.rows());
    if (arb_mat_approx_inv(y.raw(), derivatives(z, image).middle().raw(), kBallBits) == 0)
      throw NotProved{"the equations are singular there"};
    y = y.middle();
    z = rounded(z - y * value(z, image));
    return y;
  }

  static BallMatrix widened(const BallMatrix& z, double by) {
    BallMatrix box = z;
    for (std::size_t i = 0; i < z.rows(); ++i) {
      mag_t r;
      mag_init(r);
      mag_set_d(r, by);
      arb_add_error_mag(box.at(i), r);
      mag_clear(r);
    }
    return box;
  }

  /// The cycle moves with the parameters: its box is made larger until it holds its own image.
  ProvedCycle proved_over_range(const BallMatrix& z, const BallMatrix& y, const BallMatrix& at,
                                double size) {
    BallMatrix box = z - y * at;
    constexpr int kProofRounds = 6;
    for (int round = 0; round < kProofRounds; ++round) {
      box = widened(box, 1e-10 * size);
      for (std::size_t i = 0; i < box.rows(); ++i) {
        mag_t eighth;
        mag_init_set(eighth, arb_radref(box.at(i)));
        mag_mul_2exp_si(eighth, eighth, -3);
        arb_add_error_mag(box.at(i), eighth);
        mag_clear(eighth);
        arb_union(box.at(i), box.at(i), z.at(i), kBallBits);
      }
      const BoxImage image = flow_(box, true, seconds_);
      const BallMatrix solution = krawczyk(z, y, at, derivatives(box, image), box);
      if (inside(solution, box)) return checked(box, solution, image);
      box = solution;
    }
    throw NotProved{
        "Krawczyk's test fails for the whole range: a smaller one may have it, unless the branch "
        "turns or ends in it"};
  }

  ProvedCycle checked(const BallMatrix& box, const BallMatrix& solution,
                      const BoxImage& image) const {
    check_closed(box, image);
    check_leaf(box);
    return described(solution, image);
  }

  static std::vector<GiNaC::ex> values_of(const std::vector<NamedExpression>& functions) {
    std::vector<GiNaC::ex> result;
    for (const NamedExpression& one : functions) result.push_back(one.value);
    return result;
  }

  static std::vector<NamedExpression> level_functions(const Model& model, const Scene& scene,
                                                      const SectionProblem& problem) {
    std::vector<NamedExpression> result;
    for (const std::string& name : problem.level_names) {
      const std::string own = fmt::format("casimir_level_{}", result.size());
      if (name == "H") {
        result.push_back({own, model.at_parameters(*model.hamiltonian, scene), {}});
        continue;
      }
      const auto casimir = std::ranges::find(model.casimirs, name, &NamedExpression::name);
      const Proof proof = prove_claim(model, ClaimKind::casimir, *casimir);
      if (proof.verdict != Verdict::proved || !proof.where.empty())
        throw NotProved{fmt::format("{} is not proved to be a Casimir function", name)};
      result.push_back({own, model.at_parameters(casimir->value, scene), {}});
    }
    return result;
  }

  static std::vector<GiNaC::ex> structure_matrix(const Model& model, const Scene& scene) {
    std::vector<GiNaC::ex> result;
    for (std::size_t i = 0; i < model.variables.size(); ++i)
      for (std::size_t j = 0; j < model.variables.size(); ++j)
        result.push_back(model.at_parameters((*model.poisson)(i, j), scene));
    return result;
  }

  std::size_t states() const { return variables_.size(); }
  std::size_t levels() const { return problem_.levels.size(); }

  static BallMatrix rounded(const BallMatrix& z) {
    BallMatrix result(z.rows(), 1);
    for (std::size_t i = 0; i < z.rows(); ++i) arb_set_d(result.at(i), z.near(i));
    return result;
  }

  /// The coordinates in which the orbit is asked to close: those that are left when the levels are
  /// solved for the others.
  void choose_closing(const BallMatrix& z) {
    const BallMatrix x = z.rows_of(0, states());
    const BallMatrix gradients = level_derivatives_(x);
    Eigen::MatrixXd rows(static_cast<Eigen::Index>(levels()), static_cast<Eigen::Index>(states()));
    for (std::size_t a = 0; a < levels(); ++a)
      for (std::size_t i = 0; i < states(); ++i)
        rows(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(i)) = gradients.near(a, i);
    const Eigen::FullPivLU<Eigen::MatrixXd> lu(rows);
    order_.clear();
    for (Eigen::Index i = 0; i < lu.cols(); ++i)
      order_.push_back(static_cast<std::size_t>(lu.permutationQ().indices()(i)));
  }
  /// The coordinates of the others: a point of the level is determined by them and the closing
  /// ones.
  std::size_t pivot(std::size_t k) const { return order_[k]; }
  std::size_t closing(std::size_t k) const { return order_[levels() + k]; }
  std::size_t closings() const { return states() - levels(); }

  /// Plane, levels, and the differences that close it.
  BallMatrix value(const BallMatrix& z, const BoxImage& image) const {
    BallMatrix result(states() + 1, 1);
    const BallMatrix x = z.rows_of(0, states());
    arb_set(result.at(0), plane_(x).at(0));
    const BallMatrix functions = levels_(x);
    for (std::size_t a = 0; a < levels(); ++a) {
      arb_t level;
      arb_init(level);
      set_near(level, problem_.levels[a]);
      arb_sub(result.at(1 + a), functions.at(a), level, kBallBits);
      arb_clear(level);
    }
    for (std::size_t k = 0; k < closings(); ++k)
      arb_sub(result.at(1 + levels() + k), image.state.at(closing(k)), x.at(closing(k)), kBallBits);
    return result;
  }

  /// The derivative of a function may be smooth where the function jumps.
  /// \throws NotCertified
  void require_smooth(const BallMatrix& box) const {
    levels_(box);
    plane_(box);
  }

  BallMatrix derivatives(const BallMatrix& z, const BoxImage& image) const {
    const std::size_t n = states();
    BallMatrix result(n + 1, n + 1);
    const BallMatrix x = z.rows_of(0, n);
    require_smooth(x);
    const BallMatrix plane = plane_derivatives_(x), functions = level_derivatives_(x);
    for (std::size_t j = 0; j < n; ++j) {
      arb_set(result.at(0, j), plane.at(0, j));
      for (std::size_t a = 0; a < levels(); ++a) arb_set(result.at(1 + a, j), functions.at(a, j));
    }
    for (std::size_t k = 0; k < closings(); ++k) {
      const std::size_t row = 1 + levels() + k;
      for (std::size_t j = 0; j <= n; ++j)
        arb_set(result.at(row, j), image.derivatives.at(closing(k), j));
      arb_sub_ui(result.at(row, closing(k)), result.at(row, closing(k)), 1, kBallBits);
    }
    return result;
  }

  /// The other coordinates agree too: the derivatives of the levels by them are regular over the
  /// hull of start and end.
  void check_closed(const BallMatrix& box, const BoxImage& image) const {
    BallMatrix hull(states(), 1);
    for (std::size_t i = 0; i < states(); ++i)
      arb_union(hull.at(i), box.at(i), image.state.at(i), kBallBits);
    levels_(hull);  // smooth all over it, or thrown
    const BallMatrix functions = level_derivatives_(hull);
    BallMatrix pivots(levels(), levels()), inverse(levels(), levels());
    for (std::size_t a = 0; a < levels(); ++a)
      for (std::size_t k = 0; k < levels(); ++k)
        arb_set(pivots.at(a, k), functions.at(a, pivot(k)));
    if (arb_mat_inv(inverse.raw(), pivots.raw(), kBallBits) == 0)
      throw NotProved{"start and end are not certain to be one point of the level"};
  }

  /// The symplectic leaf has dimension 4: so many rows of the structure matrix are independent.
  void check_leaf(const BallMatrix& box) const {
    constexpr std::size_t kLeaf = 4;
    const BallMatrix matrix = structure_(box.rows_of(0, states()));
    Eigen::MatrixXd middle(static_cast<Eigen::Index>(states()),
                           static_cast<Eigen::Index>(states()));
    for (std::size_t i = 0; i < states(); ++i)
      for (std::size_t j = 0; j < states(); ++j)
        middle(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = matrix.near(i, j);
    const Eigen::FullPivLU<Eigen::MatrixXd> lu(middle);
    BallMatrix block(kLeaf, kLeaf), inverse(kLeaf, kLeaf);
    for (std::size_t i = 0; i < kLeaf; ++i)
      for (std::size_t j = 0; j < kLeaf; ++j)
        arb_set(block.at(i, j), matrix.at(row_of(lu.permutationP(), i),
                                          static_cast<std::size_t>(lu.permutationQ().indices()(
                                              static_cast<Eigen::Index>(j)))));
    if (arb_mat_inv(inverse.raw(), block.raw(), kBallBits) == 0)
      throw NotProved{"the symplectic leaf is not certain to have dimension 4 there"};
  }
  /// The row that a permutation of rows brings to a place.
  template <class Permutation>
  static std::size_t row_of(const Permutation& permutation, std::size_t place) {
    Eigen::Index row = 0;
    while (permutation.indices()(row) != static_cast<int>(place)) ++row;
    return static_cast<std::size_t>(row);
  }

  ProvedCycle described(const BallMatrix& solution, const BoxImage& image) const {
    ProvedCycle result;
    result.proved = true;
    result.keeps_area = keeps_area_;
    for (std::size_t i = 0; i <= states(); ++i) {
      const RationalInterval ends = ends_of(solution.at(i));
      result.radius = std::max(result.radius, cln::cl_RA((ends.high - ends.low) / 2));
      if (i < states())
        result.state.push_back(ends);
      else
        result.period = ends;
    }
    arb_t trace;
    arb_init(trace);
    for (std::size_t i = 0; i < states(); ++i)
      arb_add(trace, trace, image.derivatives.at(i, i), kBallBits);
    arb_sub_ui(trace, trace, levels() + 1, kBallBits);
    result.trace = ends_of(trace);
    arb_clear(trace);
    return result;
  }

  const SectionProblem& problem_;
  std::vector<GiNaC::symbol> variables_;
  bool is_range_;  ///< some parameter has any value of an interval
  std::vector<NamedExpression> level_functions_;
  FlowToTime flow_;
  BallFunctions levels_, level_derivatives_, plane_, plane_derivatives_, structure_;
  std::vector<std::size_t> order_;
  bool keeps_area_;
  double seconds_;
};

/// Why no cycle of this section can be proved, or nothing.
std::string unsuited(const Model& model, const SectionProblem& problem) {
  if (problem.plane.period > 0) return "the plane is an angle";
  if (model.variables.size() != problem.level_names.size() - 1 + 4)
    return "the level is no surface of energy on a symplectic leaf of dimension 4";
  return {};
}

/// Which assumption about the parameters a range leaves, or nothing: the case says nothing of what
/// is beyond.
std::string left_by(const Model& model, const Scene& open, const Intervals& ranges) {
  for (const Assumption& assumption : model.assumptions) {
    const GiNaC::ex difference = model.at_parameters(assumption.difference, open);
    const auto occurs = [&](const GiNaC::symbol& x) { return difference.has(x); };
    if (std::ranges::any_of(model.variables, occurs) ||
        std::ranges::none_of(ranges, [&](const auto& range) { return occurs(range.first); }))
      continue;
    try {
      const BallMatrix value = BallFunctions({}, {difference}).over(ranges)(BallMatrix(0, 1));
      Ball ball;
      acb_set_arb(ball.raw(), value.at(0));
      if (const auto sign = ball.sign(); sign && holds(assumption.comparison, *sign)) continue;
    } catch (const NotCertified&) {
      // It has no certain value all over the range.
    }
    return fmt::format("the range leaves the assumption '{}'", printable(assumption.text));
  }
  return {};
}

}  // namespace

std::string ProvedCycle::kind() const {
  if (!keeps_area) return "undecided";
  if (trace.low > 2) return "hyperbolic";
  if (trace.high < -2) return "inverse hyperbolic";
  if (trace.low > -2 && trace.high < 2) return "elliptic";
  return "undecided";
}

std::vector<ProvedCycle> enclose_cycles(const Model& model, const Scene& scene,
                                        const SectionProblem& problem,
                                        const std::vector<Cycle>& cycles,
                                        const ParameterRanges& ranges, double longest) {
  require_exact_values(model, scene, "an enclosure");
  check_ranges(model, ranges);
  std::vector<ProvedCycle> result(cycles.size());
  std::string reason = unsuited(model, problem);
  const Scene open = scene_over(model, scene, ranges);
  const Intervals intervals = intervals_of(model, scene, ranges);
  if (reason.empty()) reason = left_by(model, open, intervals);
  if (reason.empty()) reason = unwatched_parts(model, open);
  std::optional<Prover> prover;
  if (reason.empty()) {
    try {
      prover.emplace(model, open, problem, intervals, longest);
    } catch (const NotProved& problem_of_all) {
      reason = problem_of_all.reason;
    }
  }
  for (std::size_t k = 0; k < cycles.size(); ++k) {
    result[k].reason = reason;
    if (!prover) continue;
    try {
      result[k] = prover->proved(cycles[k]);
    } catch (const NotProved& own) {
      result[k].reason = own.reason;
    } catch (const NotCertified&) {
      result[k].reason =
          "the functions of the level or the plane are not certain to be smooth there";
    }
  }
  return result;
}

}  // namespace casimir
