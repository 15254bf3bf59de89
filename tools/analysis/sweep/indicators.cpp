#include "tools/analysis/sweep/indicators.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>

#include "codegen/specialise.hpp"
#include "runtime/program/interpreter.hpp"
#include "runtime/step/dense.hpp"
#include "tools/analysis/estimate/saltation.hpp"
#include "tools/analysis/sweep/deviations.hpp"
#include "tools/analysis/verify.hpp"

namespace casimir {
namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

constexpr int kIndicatorParts = 512;
constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();
/// Of gradients beside the largest: those of dependent integrals.
constexpr double kDependent = 1e-9;
/// The proofs of a sweep take no longer than this.
constexpr double kSecondsOfIntegrals = 20;
/// A direction that grows like the time is 4 times as long in the last quarter as in the one before
/// the middle; half of that in the logarithm tells them apart.
constexpr double kGrows = 0.5;
/// A MEGNO beyond this, still growing, is that of chaos.
constexpr double kRegular = 4;

struct Judged {
  std::vector<std::string> proved, left_out;
};

/// Which of the invariants are proved wherever a motion goes.
Judged judged_invariants(const Model& model, const std::vector<std::string>& names) {
  const Verification verification = verify(anywhere(model), kSecondsOfIntegrals);
  Judged result;
  for (const std::string& name : names) {
    const bool proved = std::ranges::any_of(verification.proofs, [&](const Proof& proof) {
      const bool kind = proof.kind == ClaimKind::casimir || proof.kind == ClaimKind::integral;
      return kind && proof.name == name && proof.verdict == Verdict::proved && proof.on.empty();
    });
    // Without the time in it the Hamiltonian is an integral by the skew symmetry of the bracket.
    (proved || name == "H" ? result.proved : result.left_out).push_back(name);
  }
  return result;
}

/// The singular values of a matrix, in falling order: the roots of the eigenvalues of its square.
std::vector<double> singular_values(const Matrix& a) {
  // By one-sided rotations (Hestenes, 1958): exact for columns of very different lengths.
  Matrix u = a;
  const Eigen::Index k = u.cols();
  for (int sweep = 0; sweep < 40; ++sweep) {
    double largest = 0;
    for (Eigen::Index i = 0; i < k; ++i)
      for (Eigen::Index j = i + 1; j < k; ++j) {
        const double p = u.col(i).dot(u.col(j)), a2 = u.col(i).squaredNorm(),
                     b2 = u.col(j).squaredNorm();
        if (!(a2 > 0) || !(b2 > 0) || p == 0) continue;
        largest = std::max(largest, std::abs(p) / std::sqrt(a2 * b2));
        const double t = (b2 - a2) / (2 * p);
        const double tangent = std::copysign(1., t) / (std::abs(t) + std::hypot(1., t));
        const double c = 1 / std::hypot(1., tangent), s = c * tangent;
        const Vector left = u.col(i);
        u.col(i) = c * left - s * u.col(j);
        u.col(j) = s * left + c * u.col(j);
      }
    if (largest < 1e-15) break;
  }
  std::vector<double> values;
  for (Eigen::Index i = 0; i < k; ++i) values.push_back(u.col(i).norm());
  std::ranges::sort(values, std::greater{});
  return values;
}

/// Deviations of any length, with the logarithms of these beside them.
struct Deviations {
  Matrix unit;  ///< a column each
  Vector logs;

  /// The logarithm of the length of their sum: of a deviation in general position.
  double log_of_sum() const {
    const double most = logs.maxCoeff();
    Vector sum = Vector::Zero(unit.rows());
    for (Eigen::Index i = 0; i < unit.cols(); ++i)
      sum += unit.col(i) * (std::exp(logs[i] - most) * (1 + 0.37 * static_cast<double>(i)));
    return most + std::log(sum.norm());
  }

  double gali(Eigen::Index k) const {
    double volume = 1;
    for (const double value : singular_values(unit.leftCols(k))) volume *= value;
    return volume;
  }

  /// The logarithms of the factors by which the map of the level's directions stretches.
  std::vector<double> stretches() const {
    Matrix all = unit;
    const double most = logs.maxCoeff();
    for (Eigen::Index i = 0; i < all.cols(); ++i) all.col(i) *= std::exp(logs[i] - most);
    std::vector<double> result;
    for (const double value : singular_values(all)) result.push_back(most + std::log(value));
    return result;
  }
};

/// What is seen of the growth along the way.
class Watch {
 public:
  void see(double t, double part, const Deviations& v) {
    const double log = v.log_of_sum();
    sum_ += (last_ + log) / 2 * part;  // the integral of log|v|
    last_ = log;
    const double y = 2 * (log - first_ - (sum_ - first_ * t) / t);
    mean_ += y * part;
    megno_ = mean_ / t;
  }
  void begin(const Deviations& v) { first_ = last_ = v.log_of_sum(); }
  double megno() const { return megno_; }
  double growth() const { return last_ - first_; }

 private:
  double first_ = 0, last_ = 0, sum_ = 0, mean_ = 0, megno_ = 0;
};

}  // namespace

/// The gradients of the proved integrals at a state.
struct Indicators::Gradients {
  SparseProgram program;
  std::vector<std::string> names;

  Matrix at(const Interpreter& values, const Vector& x,
            const std::vector<double>& parameters) const {
    std::vector<double> inputs(x.data(), x.data() + x.size());
    inputs.insert(inputs.end(), parameters.begin(), parameters.end());
    inputs.push_back(0);
    std::vector<double> entries(program.program.outputs.size());
    values(inputs.data(), entries.data());
    Matrix result = Matrix::Zero(x.size(), static_cast<Eigen::Index>(names.size()));
    for (std::size_t i = 0; i < entries.size(); ++i)
      result(program.entries[i].first, program.entries[i].second) = entries[i];
    return result;
  }
};

Indicators::~Indicators() = default;

Indicators::Indicators(const Model& model, const Scene& scene, const PreparedScene& run,
                       const GridPoints& places, const Method& method, const Settings& settings)
    : places_(places),
      method_(deviation_method(run, method)),
      settings_(settings),
      rates_(run.specialisation.rhs),
      deviating_(with_deviation(model, scene, run)) {
  SpecialiseOptions what;
  what.keep_parameters = run.specialisation.parameters;
  what.observe = run.specialisation.states;
  what.gradients = true;
  what.jacobian = false;
  Model known = model;
  const Specialisation all = specialise(model, scene, what);
  const Judged judged = judged_invariants(model, all.invariant_names);
  left_out_ = judged.left_out;
  const auto unproved = [&](const NamedExpression& f) {
    return std::ranges::count(left_out_, f.name) > 0;
  };
  std::erase_if(known.casimirs, unproved);
  std::erase_if(known.integrals, unproved);
  const Specialisation kept = specialise(known, scene, what);
  proved_ = kept.invariant_names;
  gradients_ = std::make_unique<const Gradients>(Gradients{kept.gradients, proved_});
  const std::size_t n = run.specialisation.states.size();
  Vector x = Eigen::Map<const Vector>(run.initial.data(), static_cast<Eigen::Index>(n));
  const Interpreter values(gradients_->program.program);
  const Matrix g = gradients_->at(values, x, run.parameters);
  level_dimension_ =
      n - (g.size() == 0 || !g.allFinite() ? 0 : static_cast<std::size_t>(rank_of(g, kDependent)));
}

std::vector<std::string> Indicators::columns() const {
  std::vector<std::string> names{"t", "megno", "megno_half", "level", "dimension"};
  for (std::size_t k = 2; k <= std::min(kMostGali, level_dimension_); ++k)
    names.push_back(fmt::format("gali_{}", k));
  names.emplace_back("steps");
  return names;
}

std::string Indicators::reason(Status status) const { return reason_of_deviations(status); }

std::string Indicators::fingerprint() const {
  std::string text = "indicators " + run_fingerprint(deviating_, method_, settings_);
  for (const std::string& name : proved_) text += "\n" + name;
  return text;
}

namespace {

/// The columns of `v` without what is across the level, which the exact ones have none of.
void keep_to_level(Matrix& v, const Matrix& gradients) {
  if (gradients.cols() == 0) return;
  for (Eigen::Index i = 0; i < v.cols(); ++i)
    v.col(i) -= gradients * shortest_solution(gradients, v.col(i), kDependent);
}

/// Directions of the level, of length 1: the first along the motion, where there is any.
Matrix first_directions(const Matrix& gradients, const Vector& field, Eigen::Index count) {
  Matrix normals(field.size(), gradients.cols() + 1);
  normals << gradients, field;
  for (Eigen::Index i = 0; i < normals.cols(); ++i)
    if (normals.col(i).norm() > 0) normals.col(i).normalize();
  if (!(field.norm() > 0)) return orthogonal_complement(normals, count);
  Matrix result(field.size(), count);
  result.col(0) = field.normalized();
  if (count > 1) result.rightCols(count - 1) = orthogonal_complement(normals, count - 1);
  return result;
}

}  // namespace

/// What serves one thread at a time, made where no other makes exact numbers.
struct Indicators::ThreadsOwn {
  Interpreter gradients;
  Saltation saltation;
};

PointResult Indicators::follow(const Module& module, ThreadsOwn& own, std::size_t point,
                               const std::function<bool()>& give_up) const {
  const auto [start, parameters] = places_.at(point);
  const auto n = static_cast<Eigen::Index>(start.size());
  const Interpreter& gradient_values = own.gradients;
  Vector x = Eigen::Map<const Vector>(start.data(), n);
  const Matrix gradients = gradients_->at(gradient_values, x, parameters);
  std::vector<double> values(columns().size(), kNoValue);
  const auto failed = [&](Status status, double t) {
    values[0] = t;
    return PointResult{status, values};
  };
  if (!gradients.allFinite()) return failed(Status::non_finite, 0);
  const Eigen::Index level = n - (gradients.size() == 0 ? 0 : rank_of(gradients, kDependent));
  values[3] = static_cast<double>(level);
  std::vector<double> state(static_cast<std::size_t>(2 * n)), rate(state.size());
  std::copy(start.begin(), start.end(), state.begin());
  module.functions().rhs(0, state.data(), parameters.data(), rate.data());
  if (level < 1) return failed(Status::ok, 0);
  Deviations v{first_directions(gradients, Eigen::Map<const Vector>(rate.data(), n), level),
               Vector::Zero(level)};
  Settings settings = settings_;
  settings.duration /= kIndicatorParts;
  settings.monitor = false;
  settings.give_up = give_up;
  own.saltation.begin();
  settings.after_step = own.saltation.hook(parameters, state.size());
  Watch watch;
  watch.begin(v);
  std::vector<double> before(static_cast<std::size_t>(level)), after(before.size());
  double half = kNoValue, steps = 0;
  for (int part = 1; part <= kIndicatorParts; ++part) {
    Vector next = x;
    const Saltation::Sides sides = own.saltation.sides();
    for (Eigen::Index i = 0; i < level; ++i) {
      own.saltation.begin(sides);
      std::copy_n(x.data(), n, state.begin());
      std::copy_n(v.unit.col(i).data(), n, state.begin() + n);
      const Trajectory piece = integrate(module, method_, settings, state, parameters);
      const double t = std::abs(settings.duration) * (part - 1) + std::abs(piece.time);
      if (piece.status != Status::ok) return failed(piece.status, t);
      if (i == 0) next = Eigen::Map<const Vector>(piece.state.data(), n);
      steps += static_cast<double>(piece.steps);
      v.unit.col(i) = Eigen::Map<const Vector>(piece.state.data() + n, n);
    }
    x = next;
    const double t = std::abs(settings.duration) * part;
    keep_to_level(v.unit, gradients_->at(gradient_values, x, parameters));
    for (Eigen::Index i = 0; i < level; ++i) {
      const double size = v.unit.col(i).norm();
      if (!(size > 0) || !std::isfinite(size)) return failed(Status::non_finite, t);
      v.logs[i] += std::log(size);
      v.unit.col(i) /= size;
    }
    watch.see(t, std::abs(settings.duration), v);
    if (2 * part == kIndicatorParts) half = watch.megno();
    const bool early = part > kIndicatorParts / 4 && part <= kIndicatorParts / 2,
               late = part > 3 * kIndicatorParts / 4;
    if (!early && !late) continue;
    const std::vector<double> stretches = v.stretches();
    constexpr double share = 4. / kIndicatorParts;
    for (std::size_t i = 0; i < stretches.size(); ++i)
      (early ? before : after)[i] += stretches[i] * share;
  }
  values[0] = settings_.duration;
  values[1] = watch.megno();
  values[2] = half;
  if (values[1] < kRegular || values[1] < half) {
    // From the middle of the second quarter to that of the last the time grows 7/3 times.
    const double power = std::log(7. / 3.);
    double growing = 0;
    bool clear = true;
    for (std::size_t i = 0; i < before.size(); ++i) {
      const double slope = (after[i] - before[i]) / power;
      if (slope > kGrows) ++growing;
      clear = clear && std::abs(std::abs(slope) - kGrows) > 0.2 && slope < 2.5;
    }
    if (clear) values[4] = static_cast<double>(level) - growing;
  }
  const std::size_t gali = std::min(kMostGali, level_dimension_);
  for (std::size_t k = 2; k <= gali && k <= static_cast<std::size_t>(level); ++k)
    values[3 + k] = v.gali(static_cast<Eigen::Index>(k));
  values.back() = steps;
  return {Status::ok, values};
}

std::vector<PointResult> Indicators::run(const std::vector<std::size_t>& points, int threads,
                                         const std::function<bool()>& give_up) const {
  std::vector<ThreadsOwn> own(threads_for(points, threads),
                              {Interpreter(gradients_->program.program), Saltation(rates_)});
  return each_with_module(deviating_, method_, points, threads, give_up,
                          {Status::stopped, std::vector<double>(columns().size(), kNoValue)},
                          [&](const Module& module, std::size_t thread, std::size_t point) {
                            return follow(module, own[thread], point, give_up);
                          });
}

}  // namespace casimir
