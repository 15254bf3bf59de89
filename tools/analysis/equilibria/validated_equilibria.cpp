#include "tools/analysis/equilibria/validated_equilibria.hpp"

#include <acb_mat.h>
#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "runtime/step/dense.hpp"
#include "symbolic/algebra/ball_evaluator.hpp"
#include "symbolic/model/given_functions.hpp"
#include "symbolic/prove.hpp"
#include "tools/analysis/estimate/cancelled_parts.hpp"
#include "tools/analysis/proof/ball_matrix.hpp"
#include "tools/analysis/run/exact_values.hpp"

namespace casimir {
namespace {

/// The box with this share of the size of each number added to both sides, and as much of `unit`.
BallMatrix widened(const BallMatrix& z, slong log2_share, double unit) {
  BallMatrix result = z;
  for (std::size_t i = 0; i < z.rows(); ++i) {
    arb_t size;
    arb_init(size);
    arb_set_d(size, unit);
    arb_t own;
    arb_init(own);
    arb_abs(own, z.at(i));
    arb_max(size, size, own, kBallBits);
    arb_mul_2exp_si(size, size, log2_share);
    arb_add_error(result.at(i), size);
    arb_clear(own);
    arb_clear(size);
  }
  return result;
}

/// Over a range of parameters the zero moves: a box around the image of the middle is made larger
/// until it holds its own image.
std::optional<BallMatrix> inflated(const BallFunctions& derivatives, const BallMatrix& z,
                                   const BallMatrix& y, const BallMatrix& value, double unit) {
  BallMatrix box = z - y * value;
  constexpr int kRounds = 8;
  for (int round = 0; round < kRounds; ++round) {
    box = widened(box, -60, unit);
    for (std::size_t i = 0; i < box.rows(); ++i) {
      mag_t eighth;
      mag_init_set(eighth, arb_radref(box.at(i)));
      mag_mul_2exp_si(eighth, eighth, -3);
      arb_add_error_mag(box.at(i), eighth);
      mag_clear(eighth);
      arb_union(box.at(i), box.at(i), z.at(i), kBallBits);
    }
    const BallMatrix image = krawczyk(z, y, value, derivatives(box), box);
    if (inside(image, box)) return image;
    for (std::size_t i = 0; i < image.rows(); ++i)
      if (arb_is_finite(image.at(i)) == 0) return std::nullopt;
    box = image;
  }
  return std::nullopt;
}

/// The only zero of f near z, in a box; empty where none is proved.
std::optional<BallMatrix> only_zero(const BallFunctions& f, BallMatrix z, double unit) {
  const BallFunctions derivatives = f.derivatives();
  BallMatrix inverse(z.rows(), z.rows());
  constexpr int kRounds = 8;
  for (int round = 0; round < kRounds; ++round) {
    if (arb_mat_approx_inv(inverse.raw(), derivatives(z).middle().raw(), kBallBits) == 0)
      return std::nullopt;
    z = (z - inverse.middle() * f(z)).middle();
  }
  const BallMatrix y = inverse.middle();
  const BallMatrix value = f(z);
  // A box that is too small for rounding is too large for the derivatives nowhere before the last.
  for (const slong log2_share : {-120, -90, -60, -40, -25}) {
    const BallMatrix box = widened(z, log2_share, unit);
    const BallMatrix image = krawczyk(z, y, value, derivatives(box), box);
    if (inside(image, box)) return image;
  }
  return inflated(derivatives, z, y, value, unit);
}

bool definite(const BallMatrix& matrix) {
  BallMatrix factor(matrix.rows(), matrix.rows());
  if (arb_mat_cho(factor.raw(), matrix.raw(), kBallBits) != 0) return true;
  BallMatrix opposite = matrix;
  arb_mat_neg(opposite.raw(), matrix.raw());
  return arb_mat_cho(factor.raw(), opposite.raw(), kBallBits) != 0;
}

/// Vectors that span a kernel: each is 1 in one of the `free` entries, and 0 in the others of
/// these.
struct Kernel {
  BallMatrix columns;
  std::vector<std::size_t> free;

  /// What a matrix that maps the kernel into itself does there.
  BallMatrix restriction(const BallMatrix& matrix) const {
    const BallMatrix image = matrix * columns;
    BallMatrix result(free.size(), free.size());
    for (std::size_t i = 0; i < free.size(); ++i)
      for (std::size_t j = 0; j < free.size(); ++j) arb_set(result.at(i, j), image.at(free[i], j));
    return result;
  }
};

/// The kernel of `rows`, which have full rank; empty where that is not certain.
std::optional<Kernel> kernel(const BallMatrix& rows) {
  const std::size_t m = rows.rows(), n = rows.columns();
  Eigen::MatrixXd middle(m, n);
  for (std::size_t i = 0; i < m; ++i)
    for (std::size_t j = 0; j < n; ++j)
      middle(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = rows.near(i, j);
  std::vector<std::size_t> order(n);
  for (std::size_t j = 0; j < n; ++j) order[j] = j;
  if (m > 0) {
    const Eigen::FullPivLU<Eigen::MatrixXd> lu(middle);
    for (std::size_t j = 0; j < n; ++j)
      order[j] =
          static_cast<std::size_t>(lu.permutationQ().indices()(static_cast<Eigen::Index>(j)));
  }
  BallMatrix pivots(m, m), others(m, n - m), solved(m, n - m);
  Kernel result{BallMatrix(n, n - m), {}};
  for (std::size_t i = 0; i < m; ++i) {
    for (std::size_t j = 0; j < m; ++j) arb_set(pivots.at(i, j), rows.at(i, order[j]));
    for (std::size_t j = m; j < n; ++j) arb_neg(others.at(i, j - m), rows.at(i, order[j]));
  }
  if (m > 0 && m < n && arb_mat_solve(solved.raw(), pivots.raw(), others.raw(), kBallBits) == 0)
    return std::nullopt;
  for (std::size_t j = 0; j < n - m; ++j) {
    for (std::size_t i = 0; i < m; ++i) arb_set(result.columns.at(order[i], j), solved.at(i, j));
    arb_one(result.columns.at(order[m + j], j));
    result.free.push_back(order[m + j]);
  }
  return result;
}

/// What is certain of the eigenvalues of every matrix in these balls.
struct Sides {
  bool some_right = false;  ///< one has a positive real part
  bool all_left = false;    ///< all have a negative one
};

Sides sides_of(const BallMatrix& a) {
  const auto n = static_cast<slong>(a.rows());
  acb_mat_t matrix, vectors;
  acb_mat_init(matrix, n, n);
  acb_mat_init(vectors, n, n);
  acb_mat_set_arb_mat(matrix, a.raw());
  acb_ptr approximate = _acb_vec_init(n), values = _acb_vec_init(n);
  acb_mat_approx_eig_qr(approximate, nullptr, vectors, matrix, nullptr, 0, kBallBits);
  Sides result;
  if (acb_mat_eig_multiple(values, matrix, approximate, vectors, kBallBits) != 0) {
    result.all_left = true;
    for (slong k = 0; k < n; ++k) {
      result.some_right = result.some_right || arb_is_positive(acb_realref(values + k)) != 0;
      result.all_left = result.all_left && arb_is_negative(acb_realref(values + k)) != 0;
    }
  }
  _acb_vec_clear(values, n);
  _acb_vec_clear(approximate, n);
  acb_mat_clear(vectors);
  acb_mat_clear(matrix);
  return result;
}

/// The equations of a scene's equilibria, with multipliers, and what stability is read off.
class Prover {
 public:
  Prover(const Model& model, const Scene& scene, const EquilibriumReport& report,
         const ParameterRanges& ranges)
      : model_(model),
        scene_(scene_over(model, scene, ranges)),
        ranges_(intervals_of(model, scene, ranges)),
        report_(report),
        unknowns_(model.variables) {
    if (report.constrained) unproved_ = "that it lies on the constraints is known in doubles alone";
    check_ranges(model, ranges);
    if (!model.poisson) {
      for (const GiNaC::ex& rate : model.field) equations_.push_back(at_scene(rate));
      return;
    }
    lagrangian_ = at_scene(*model.hamiltonian);
    for (std::size_t k = 0; k < report.symmetry_functions.size(); ++k) {
      const NamedExpression symmetry{report.symmetries[k], report.symmetry_functions[k], {}};
      require(ClaimKind::integral, symmetry);
      constrain(symmetry.value, fmt::format("velocity_{}", k + 1));
    }
    moving_ = lagrangian_;
    for (const NamedExpression& casimir : model.casimirs) {
      require(ClaimKind::casimir, casimir);
      constrain(casimir.value, fmt::format("multiplier_{}", casimir.name));
    }
    for (const GiNaC::symbol& x : model.variables) equations_.push_back(lagrangian_.diff(x));
    equations_.insert(equations_.end(), levels_.begin(), levels_.end());
  }

  ProvedEquilibrium proved(const Equilibrium& found) const {
    ProvedEquilibrium result;
    if (!unproved_.empty()) {
      result.reason = unproved_;
    } else if (found.degenerate) {
      result.reason = found.family > 0 ? "it belongs to a family"
                                       : "it is degenerate: as far as doubles tell, the equations "
                                         "do not change to first order";
    } else {
      try {
        enclose(found, result);
      } catch (const NotCertified&) {
        result.reason = "the equations are not certain to be smooth there";
      }
    }
    return result;
  }

 private:
  GiNaC::ex at_scene(const GiNaC::ex& e) const { return model_.at_parameters(e, scene_); }

  /// Functions of the unknowns, for all values of the ranges.
  BallFunctions functions(std::vector<GiNaC::ex> values, std::size_t columns = 1) const {
    return BallFunctions(unknowns_, std::move(values), columns).over(ranges_);
  }

  void require(ClaimKind kind, const NamedExpression& f) {
    const Proof proof = prove_claim(model_, kind, f);
    if (proof.verdict != Verdict::proved || !proof.where.empty())
      unproved_ = fmt::format("{} is not proved to be {}", f.name,
                              kind == ClaimKind::casimir ? "a Casimir function" : "an integral");
  }

  /// One more function that keeps its value, with a multiplier.
  void constrain(const GiNaC::ex& function, const std::string& multiplier) {
    GiNaC::exmap start;
    for (std::size_t i = 0; i < model_.variables.size(); ++i)
      start[model_.variables[i]] = scene_.initial[i];
    const GiNaC::ex value = at_scene(function);
    unknowns_.emplace_back(multiplier);
    lagrangian_ -= unknowns_.back() * value;
    levels_.push_back(value - value.subs(start));
  }

  std::size_t states() const { return model_.variables.size(); }
  std::size_t symmetries() const { return report_.symmetry_functions.size(); }

  /// The state that was found, with the multipliers that fit it best.
  BallMatrix start(const Equilibrium& found) const {
    BallMatrix z(unknowns_.size(), 1);
    for (std::size_t i = 0; i < states(); ++i) arb_set_d(z.at(i), found.state[i]);
    const std::size_t m = levels_.size();
    if (m == 0) return z;
    // The gradient of L is affine in the multipliers.
    const BallFunctions gradient =
        functions({equations_.begin(), equations_.begin() + static_cast<std::ptrdiff_t>(states())});
    const auto column = [&](const BallMatrix& values) {
      Eigen::VectorXd result(states());
      for (std::size_t i = 0; i < states(); ++i)
        result(static_cast<Eigen::Index>(i)) = values.near(i);
      return result;
    };
    const Eigen::VectorXd base = column(gradient(z));
    Eigen::MatrixXd by(states(), m);
    for (std::size_t k = 0; k < m; ++k) {
      BallMatrix other = z;
      arb_one(other.at(states() + k));
      by.col(static_cast<Eigen::Index>(k)) = column(gradient(other)) - base;
    }
    const Eigen::VectorXd fitted = shortest_solution(by, -base, 1e-14);
    for (std::size_t k = 0; k < m; ++k)
      arb_set_d(z.at(states() + k), fitted(static_cast<Eigen::Index>(k)));
    return z;
  }

  /// \throws NotCertified  where the box is not certain to be inside of where the case is defined: on its
  ///                        boundary no motion leads to the other side
  void check_domain(BallMatrix z) const {
    mag_t around;
    mag_init(around);
    mag_set_d(around, std::ldexp(report_.size, -60));
    for (std::size_t i = 0; i < z.rows(); ++i) arb_add_error_mag(z.at(i), around);
    mag_clear(around);
    for (const GiNaC::ex& part : written_parts(model_, scene_)) functions({part})(z);
    for (const Assumption& assumption : model_.assumptions) {
      const BallMatrix value = functions({at_scene(assumption.difference)})(z);
      Ball ball;
      acb_set_arb(ball.raw(), value.at(0));
      const std::optional<int> sign = ball.sign();
      if (!sign || !holds(assumption.comparison, *sign)) throw NotCertified();
    }
  }

  void enclose(const Equilibrium& found, ProvedEquilibrium& result) const {
    const BallFunctions f = functions(equations_);
    const auto zero = only_zero(f, start(found), report_.size);
    if (!zero) {
      result.reason =
          ranges_.empty()
              ? "Krawczyk's test fails: the equations are nearly singular there"
              : "Krawczyk's test fails for the whole range: a smaller one may have it, unless the "
                "branch turns or ends in it";
      return;
    }
    check_domain(*zero);
    const std::size_t shown = states() + symmetries();
    for (std::size_t i = 0; i < shown; ++i) {
      const RationalInterval one = ends_of(zero->at(i));
      result.radius = std::max(result.radius, cln::cl_RA((one.high - one.low) / 2));
      (i < states() ? result.state : result.velocities).push_back(one);
    }
    result.proved = true;
    result.stability = stability(*zero);
  }

  ProvedStability stability(const BallMatrix& z) const {
    // Several symmetries need not be integrals of the flow in which it rests.
    if (symmetries() > 1) return ProvedStability::undecided;
    try {
      const auto tangent = kernel(gradients(z));
      if (!tangent) return ProvedStability::undecided;
      // Along the level: beside it the eigenvalues are zero, and zeros are hard to tell apart.
      const Sides sides = sides_of(tangent->restriction(linearised(z)));
      if (sides.some_right) return ProvedStability::unstable;
      if (levels_.empty() && sides.all_left) return ProvedStability::stable;
      if (model_.poisson &&
          definite(tangent->columns.transposed() * second_variation(z) * tangent->columns))
        return ProvedStability::stable;
    } catch (const NotCertified&) {
      // A function without a second derivative there: nothing is said.
    }
    return ProvedStability::undecided;
  }

  /// Of the functions whose level it is on.
  BallMatrix gradients(const BallMatrix& z) const {
    std::vector<GiNaC::ex> entries;
    for (const GiNaC::ex& level : levels_)
      for (const GiNaC::symbol& x : model_.variables) entries.push_back(level.diff(x));
    if (entries.empty()) return BallMatrix(0, states());
    return functions(entries, states())(z);
  }

  /// Of the flow in which it rests.
  BallMatrix linearised(const BallMatrix& z) const {
    std::vector<GiNaC::ex> entries;
    const std::vector<GiNaC::ex> field =
        model_.poisson ? model_.poisson->flow(moving_) : model_.field;
    for (const GiNaC::ex& rate : field)
      for (const GiNaC::symbol& x : model_.variables) entries.push_back(at_scene(rate).diff(x));
    return functions(entries, states())(z);
  }

  BallMatrix second_variation(const BallMatrix& z) const {
    std::vector<GiNaC::ex> entries;
    for (const GiNaC::symbol& x : model_.variables)
      for (const GiNaC::symbol& y : model_.variables)
        entries.push_back(lagrangian_.diff(x).diff(y));
    return functions(entries, states())(z);
  }

  const Model& model_;
  const Scene scene_;  ///< with the symbols of the parameters that have ranges
  const std::vector<std::pair<GiNaC::symbol, RationalInterval>> ranges_;
  const EquilibriumReport& report_;
  std::vector<GiNaC::symbol> unknowns_;  ///< variables, velocities, multipliers
  GiNaC::ex lagrangian_, moving_;        ///< L; without the Casimir functions
  std::vector<GiNaC::ex> levels_, equations_;
  std::string unproved_;
};

/// The number that was found; or, where that lies outside of what is proved, the middle of it.
double within(double found, const RationalInterval& proved) {
  const double middle = cln::double_approx((proved.low + proved.high) / 2),
               half = cln::double_approx((proved.high - proved.low) / 2);
  return std::abs(found - middle) <= half ? found : middle + 0.;  // no -0
}

SpectralStability spectral(ProvedStability proved, SpectralStability found) {
  if (proved == ProvedStability::unstable) return SpectralStability::unstable;
  // Where a state is stable in the sense of Lyapunov, no eigenvalue is in the right half plane.
  return proved == ProvedStability::stable ? SpectralStability::stable : found;
}

}  // namespace

std::string to_string(ProvedStability stability) {
  switch (stability) {
    case ProvedStability::stable:
      return "stable";
    case ProvedStability::unstable:
      return "unstable";
    default:
      return "undecided";
  }
}

std::vector<ProvedEquilibrium> enclose_equilibria(const Model& model, const Scene& scene,
                                                  const EquilibriumReport& report,
                                                  const ParameterRanges& ranges) {
  if (has_arbitrary_functions(model)) {
    const auto [own, own_scene] = in_scene(model, scene);
    return enclose_equilibria(own, own_scene, report, ranges);
  }
  require_exact_values(model, scene, "an enclosure");
  const Prover prover(model, scene, report, ranges);
  std::vector<ProvedEquilibrium> result;
  for (const Equilibrium& found : report.equilibria) result.push_back(prover.proved(found));
  return result;
}

void take_proved(const std::vector<ProvedEquilibrium>& proofs, EquilibriumReport& report) {
  for (std::size_t k = 0; k < proofs.size(); ++k) {
    const ProvedEquilibrium& proof = proofs[k];
    Equilibrium& found = report.equilibria[k];
    for (std::size_t i = 0; i < proof.state.size(); ++i)
      found.state[i] = within(found.state[i], proof.state[i]);
    const std::size_t velocities = std::min(proof.velocities.size(), found.velocities.size());
    for (std::size_t i = 0; i < velocities; ++i)
      found.velocities[i] = within(found.velocities[i], proof.velocities[i]);
    found.stability = spectral(proof.stability, found.stability);
  }
}

}  // namespace casimir
