#include "tools/analysis/section/validated_cycles.hpp"

#include <cln/float.h>
#include <cln/real.h>
#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "codegen/optimise/differentiate.hpp"
#include "codegen/specialise.hpp"
#include "symbolic/algebra/ball_evaluator.hpp"
#include "symbolic/prove.hpp"
#include "tools/analysis/proof/ball_matrix.hpp"
#include "tools/analysis/run/prepared_scene.hpp"

namespace casimir {
namespace {

/// Why a cycle is not proved: a sentence.
struct NotProved {
  std::string reason;
};

/// Where a box of starts and times is after its time, with the derivatives of that.
struct Image {
  BallMatrix state;        ///< phi_T(x)
  BallMatrix derivatives;  ///< by x and T
};

/// x' = T f(x) with T and the derivatives of x by x(0) and T as further states, over a unit of
/// time.
class FlowToTime {
 public:
  FlowToTime(const Model& model, const Scene& scene) : n_(model.variables.size()) {
    Model extended;
    extended.name = model.name;
    extended.phase_space = "equations";
    extended.variables = model.variables;
    const GiNaC::symbol time("casimir_period");
    extended.variables.push_back(time);
    std::vector<GiNaC::ex> f;
    for (const GiNaC::ex& rate : model.field) f.push_back(model.at_parameters(rate, scene));
    for (const GiNaC::ex& rate : f) extended.field.push_back(time * rate);
    extended.field.emplace_back(0);
    // Column by column: those by x(0), and that by T.
    for (std::size_t j = 0; j <= n_; ++j) {
      std::vector<GiNaC::symbol> column;
      for (std::size_t i = 0; i < n_; ++i) column.emplace_back(fmt::format("casimir_d{}_{}", i, j));
      for (std::size_t i = 0; i < n_; ++i) {
        GiNaC::ex rate = j == n_ ? f[i] : GiNaC::ex(0);
        for (std::size_t k = 0; k < n_; ++k)
          rate += time * f[i].diff(model.variables[k]) * column[k];
        extended.field.push_back(rate);
      }
      extended.variables.insert(extended.variables.end(), column.begin(), column.end());
    }
    Scene scene_of_zeros;
    scene_of_zeros.name = "cycle";
    scene_of_zeros.initial.assign(extended.variables.size(), 0);
    scene_of_zeros.duration = 1;
    SpecialiseOptions what;
    what.observe = std::vector<std::string>{};
    what.jacobian = false;
    what.invariants = false;
    problem_.rates = specialise(extended, scene_of_zeros, what).rhs;
    const SparseProgram jacobian = codegen::jacobian(problem_.rates, extended.variables.size());
    problem_.jacobian = jacobian.program;
    problem_.entries = jacobian.entries;
  }

  /// \param box  a column: x, and then T.
  /// \throws NotProved
  Image operator()(const BallMatrix& box, double seconds) const {
    ValidatedProblem problem = problem_;
    for (std::size_t i = 0; i <= n_; ++i) {
      const RationalInterval ends = ends_of(box.at(i));
      append(problem.start, (ends.low + ends.high) / 2);
      problem.radii.push_back((ends.high - ends.low) / 2);
    }
    for (std::size_t j = 0; j <= n_; ++j)
      for (std::size_t i = 0; i < n_; ++i) append(problem.start, i == j ? 1 : 0);
    problem.radii.resize(problem.start.outputs.size(), 0);
    append(problem.start, 1);
    ValidatedSettings settings;
    settings.give_up = [late = time_limit(seconds)](double) { return late && late(); };
    const ValidatedRun run = validated_run(problem, settings);
    if (run.status != ValidatedStatus::ok)
      throw NotProved{fmt::format("its orbit is not enclosed to the end: {}", run.reason)};
    Image image{BallMatrix(n_, 1), BallMatrix(n_, n_ + 1)};
    for (std::size_t i = 0; i < n_; ++i) set_interval(image.state.at(i), run.end.states[i]);
    for (std::size_t j = 0; j <= n_; ++j)
      for (std::size_t i = 0; i < n_; ++i)
        set_interval(image.derivatives.at(i, j), run.end.states[n_ + 1 + j * n_ + i]);
    return image;
  }

 private:
  static void append(Program& start, const cln::cl_RA& value) {
    start.code.push_back({Op::constant, static_cast<int>(start.constants.size())});
    start.constants.push_back(value);
    start.outputs.push_back(static_cast<int>(start.code.size()) - 1);
    start.output_names.push_back(fmt::format("start_{}", start.outputs.size()));
  }

  std::size_t n_;
  ValidatedProblem problem_;  ///< without its start
};

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
  Prover(const Model& model, const Scene& scene, const SectionProblem& problem, double seconds)
      : problem_(problem),
        variables_(model.variables),
        flow_(model, scene),
        levels_(model.variables, level_functions(model, scene, problem)),
        level_derivatives_(levels_.derivatives()),
        plane_(model.variables, {problem.plane_function}),
        plane_derivatives_(plane_.derivatives()),
        structure_(model.variables, structure_matrix(model, scene), model.variables.size()),
        seconds_(seconds) {}

  /// \throws NotProved, NotCertified
  ProvedCycle proved(const Cycle& cycle) {
    const std::size_t n = variables_.size();
    BallMatrix z(n + 1, 1);
    for (std::size_t i = 0; i < n; ++i)
      arb_set_d(z.at(i), cycle.points.front().x[static_cast<Eigen::Index>(i)]);
    arb_set_d(z.at(n), cycle.period);
    BallMatrix y(n + 1, n + 1);
    constexpr int kPolishing = 2;
    for (int round = 0; round <= kPolishing; ++round) {
      const Image image = flow_(z, seconds_);
      if (round == 0) choose_closing(z);
      if (arb_mat_approx_inv(y.raw(), derivatives(z, image).middle().raw(), kBallBits) == 0)
        throw NotProved{"the equations are singular there"};
      y = y.middle();
      if (round < kPolishing) z = rounded(z - y * value(z, image));
    }
    const BallMatrix at = value(z, flow_(z, seconds_));
    double size = 1e-3;
    for (std::size_t i = 0; i < n; ++i) size = std::max(size, std::abs(z.near(i)));
    for (const double radius : {1e-10, 1e-8, 1e-7}) {
      BallMatrix box = z;
      for (std::size_t i = 0; i <= n; ++i) {
        mag_t r;
        mag_init(r);
        mag_set_d(r, radius * size);
        arb_add_error_mag(box.at(i), r);
        mag_clear(r);
      }
      const Image image = flow_(box, seconds_);
      const BallMatrix solution = krawczyk(z, y, at, derivatives(box, image), box);
      if (!inside(solution, box)) continue;
      check_closed(box, image);
      check_leaf(box);
      return described(solution, image);
    }
    throw NotProved{
        "Krawczyk's test fails: the cycle is nearly degenerate, or not known well enough"};
  }

 private:
  static std::vector<GiNaC::ex> level_functions(const Model& model, const Scene& scene,
                                                const SectionProblem& problem) {
    std::vector<GiNaC::ex> result;
    for (const std::string& name : problem.level_names) {
      if (name == "H") {
        result.push_back(model.at_parameters(*model.hamiltonian, scene));
        continue;
      }
      const auto casimir = std::ranges::find(model.casimirs, name, &NamedExpression::name);
      const Proof proof = prove_claim(model, ClaimKind::casimir, *casimir);
      if (proof.verdict != Verdict::proved || !proof.where.empty())
        throw NotProved{fmt::format("{} is not proved to be a Casimir function", name)};
      result.push_back(model.at_parameters(casimir->value, scene));
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
  BallMatrix value(const BallMatrix& z, const Image& image) const {
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

  BallMatrix derivatives(const BallMatrix& z, const Image& image) const {
    const std::size_t n = states();
    BallMatrix result(n + 1, n + 1);
    const BallMatrix x = z.rows_of(0, n);
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
  void check_closed(const BallMatrix& box, const Image& image) const {
    BallMatrix hull(states(), 1);
    for (std::size_t i = 0; i < states(); ++i)
      arb_union(hull.at(i), box.at(i), image.state.at(i), kBallBits);
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

  ProvedCycle described(const BallMatrix& solution, const Image& image) const {
    ProvedCycle result;
    result.proved = true;
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
  FlowToTime flow_;
  BallFunctions levels_, level_derivatives_, plane_, plane_derivatives_, structure_;
  std::vector<std::size_t> order_;
  double seconds_;
};

/// Why no cycle of this section can be proved, or nothing.
std::string unsuited(const Model& model, const SectionProblem& problem) {
  if (problem.plane.period > 0) return "the plane is an angle";
  if (model.variables.size() != problem.level_names.size() - 1 + 4)
    return "the level is no surface of energy on a symplectic leaf of dimension 4";
  return {};
}

}  // namespace

std::string ProvedCycle::kind() const {
  if (trace.low > 2) return "hyperbolic";
  if (trace.high < -2) return "inverse hyperbolic";
  if (trace.low > -2 && trace.high < 2) return "elliptic";
  return "undecided";
}

std::vector<ProvedCycle> enclose_cycles(const Model& model, const Scene& scene,
                                        const SectionProblem& problem,
                                        const std::vector<Cycle>& cycles, double longest) {
  std::vector<ProvedCycle> result(cycles.size());
  std::string reason = unsuited(model, problem);
  std::optional<Prover> prover;
  if (reason.empty()) {
    try {
      prover.emplace(model, scene, problem, longest);
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
