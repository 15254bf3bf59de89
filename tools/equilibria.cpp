#include "tools/equilibria.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <random>

#include "codegen/literal.hpp"
#include "codegen/specialise.hpp"
#include "runtime/dense.hpp"
#include "runtime/interpreter.hpp"
#include "symbolic/search/search.hpp"

namespace casimir::tools {
namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

constexpr std::size_t kStarts = 400;
// Of eigenvalues, relative to the largest: rounding splits a triple zero by the cube root of its
// size.
constexpr double kZero = 1e-5;

/// The integrals of degree 1 that are no Casimirs.
std::vector<GiNaC::ex> linear_integrals(const Model& model, std::vector<std::string>& names) {
  std::vector<GiNaC::ex> result;
  if (!model.poisson || model.time) return result;
  search::Request request;
  request.degree = 1;
  for (const search::Found& found : search::find_integrals(model, request).found) {
    if (found.verdict != Verdict::proved) continue;
    result.push_back(model.parse({found.text, {"found", 1, 1}, {}}));
    names.push_back(found.text);
  }
  return result;
}

/// The model with H - sum v_k F_k in place of H; the velocities v_k are parameters, at the end.
Model with_velocities(Model model, Scene& scene, const std::vector<GiNaC::ex>& integrals,
                      std::vector<std::string>& names) {
  for (std::size_t k = 0; k < integrals.size(); ++k) {
    const GiNaC::symbol velocity(fmt::format("velocity_{}", k + 1));
    model.hamiltonian = *model.hamiltonian - velocity * integrals[k];
    model.parameters.push_back(velocity);
    scene.parameters.push_back(0);
    names.push_back(velocity.get_name());
  }
  if (!integrals.empty()) model.field = model.poisson->flow(*model.hamiltonian);
  model.integrals.clear();
  for (std::size_t k = 0; k < integrals.size(); ++k)
    model.integrals.push_back({fmt::format("symmetry_{}", k + 1), integrals[k], {}});
  return model;
}

/// The equations of a relative equilibrium: rates and differences to the level, for the state and
/// the velocities.
class Equations {
 public:
  Equations(const Specialisation& spec, std::size_t velocities)
      : states_(spec.states.size()),
        velocities_(velocities),
        inputs_(spec.rhs.inputs.size(), 0),
        rhs_(spec.rhs),
        jacobian_(spec.jacobian.program),
        invariants_(spec.invariants),
        gradients_(spec.gradients.program),
        jacobian_entries_(spec.jacobian.entries),
        gradient_entries_(spec.gradients.entries),
        all_(spec.invariants.outputs.size()) {
    // H is on no level here.
    for (std::size_t i = 0; i < spec.invariant_names.size(); ++i)
      if (spec.invariant_names[i] != "H") level_.push_back(i);
    std::vector<double> start(spec.start.outputs.size());
    Interpreter run(spec.start);
    run(nullptr, start.data());
    start_ = Eigen::Map<Vector>(start.data(), static_cast<Eigen::Index>(states_));
    values_ = invariants(start_, Vector::Zero(static_cast<Eigen::Index>(velocities_)));
  }

  const Vector& start() const { return start_; }
  std::size_t states() const { return states_; }

  Vector rates(const Vector& x, const Vector& v) const {
    Vector result(static_cast<Eigen::Index>(states_));
    rhs_(filled(x, v), result.data());
    return result;
  }

  Vector residual(const Vector& x, const Vector& v) const {
    Vector result(static_cast<Eigen::Index>(states_ + level_.size()));
    result << rates(x, v), invariants(x, v) - values_;
    return result;
  }

  /// Of the rates by the state: the linearised equations.
  Matrix linearised(const Vector& x, const Vector& v) const {
    Matrix result =
        Matrix::Zero(static_cast<Eigen::Index>(states_), static_cast<Eigen::Index>(states_));
    std::vector<double> entries(jacobian_entries_.size());
    jacobian_(filled(x, v), entries.data());
    for (std::size_t k = 0; k < entries.size(); ++k)
      result(jacobian_entries_[k].first, jacobian_entries_[k].second) = entries[k];
    return result;
  }

  Matrix derivative(const Vector& x, const Vector& v) const {
    const auto n = static_cast<Eigen::Index>(states_);
    Matrix result = Matrix::Zero(n + static_cast<Eigen::Index>(level_.size()),
                                 n + static_cast<Eigen::Index>(velocities_));
    result.topLeftCorner(n, n) = linearised(x, v);
    const Vector base = rates(x, Vector::Zero(v.size()));
    for (Eigen::Index k = 0; k < v.size(); ++k)  // the rates are affine in the velocities
      result.col(n + k).head(n) = rates(x, Vector::Unit(v.size(), k)) - base;
    std::vector<double> entries(gradient_entries_.size());
    gradients_(filled(x, v), entries.data());
    for (std::size_t k = 0; k < entries.size(); ++k) {
      const auto [state, invariant] = gradient_entries_[k];
      const auto place =
          std::find(level_.begin(), level_.end(), static_cast<std::size_t>(invariant));
      if (place != level_.end()) result(n + (place - level_.begin()), state) = entries[k];
    }
    return result;
  }

 private:
  const double* filled(const Vector& x, const Vector& v) const {
    std::copy(x.data(), x.data() + x.size(), inputs_.begin());
    std::copy(v.data(), v.data() + v.size(),
              inputs_.begin() + static_cast<std::ptrdiff_t>(states_));
    return inputs_.data();
  }
  Vector invariants(const Vector& x, const Vector& v) const {
    std::vector<double> values(all_);
    invariants_(filled(x, v), values.data());
    Vector result(static_cast<Eigen::Index>(level_.size()));
    for (std::size_t i = 0; i < level_.size(); ++i)
      result(static_cast<Eigen::Index>(i)) = values[level_[i]];
    return result;
  }

  std::size_t states_, velocities_;
  mutable std::vector<double> inputs_;
  Interpreter rhs_, jacobian_, invariants_, gradients_;
  std::vector<std::pair<int, int>> jacobian_entries_, gradient_entries_;
  std::size_t all_;
  std::vector<std::size_t> level_;
  Vector start_, values_;
};

/// Newton's iteration with the shortest step that the linear equations allow.
bool solve(const Equations& equations, Vector& x, Vector& v, double scale) {
  constexpr int kRounds = 60;
  constexpr double kSmall = 1e-12;
  double last = HUGE_VAL;
  for (int round = 0; round < kRounds; ++round) {
    const Vector residual = equations.residual(x, v);
    const double size = residual.lpNorm<Eigen::Infinity>();
    if (!std::isfinite(size)) return false;
    if (size < kSmall * scale * scale || (size < 1e-9 * scale * scale && size > last / 2))
      return true;
    last = size;
    Vector step = shortest_solution(equations.derivative(x, v), residual, 1e-10);
    const double length = step.norm(), longest = 2 * scale;
    if (length > longest) step *= longest / length;
    x -= step.head(x.size());
    v -= step.tail(v.size());
  }
  return false;
}

/// Empty where the eigenvalues cannot be computed.
std::optional<Equilibrium> described(const Equations& equations, const Vector& x, const Vector& v) {
  Equilibrium result;
  result.state.assign(x.data(), x.data() + x.size());
  const bool moves =
      v.size() > 0 && equations.rates(x, Vector::Zero(v.size())).norm() > 1e-8 * (1 + x.norm());
  if (moves) result.velocities.assign(v.data(), v.data() + v.size());
  const auto values = eigenvalues_of(equations.linearised(x, moves ? v : Vector::Zero(v.size())));
  if (!values) return std::nullopt;
  const double small = kZero * std::max(1., values->cwiseAbs().maxCoeff());
  for (const std::complex<double>& value : *values) {
    result.eigenvalues.emplace_back(std::abs(value.real()) < small ? 0 : value.real(),
                                    std::abs(value.imag()) < small ? 0 : value.imag());
  }
  std::sort(result.eigenvalues.begin(), result.eigenvalues.end(), [](const auto& a, const auto& b) {
    return std::pair(-std::round(a.real() * 1e5), -a.imag()) <
           std::pair(-std::round(b.real() * 1e5), -b.imag());
  });
  const Matrix derivative = equations.derivative(x, v);
  result.family = static_cast<std::size_t>(derivative.cols() - rank_of(derivative, 1e-8));
  result.residual = equations.rates(x, v).lpNorm<Eigen::Infinity>();
  return result;
}

/// The same point; of a family, one with the same eigenvalues.
bool same(const Equilibrium& a, const Equilibrium& b, double scale) {
  constexpr double kNear = 1e-6;
  if (a.family != b.family || a.velocities.size() != b.velocities.size()) return false;
  double distance = 0;
  if (a.family == 0) {
    for (std::size_t i = 0; i < a.state.size(); ++i)
      distance = std::max(distance, std::abs(a.state[i] - b.state[i]));
    return distance < kNear * scale;
  }
  double largest = 1;
  for (std::size_t i = 0; i < a.eigenvalues.size(); ++i) {
    distance = std::max(distance, std::abs(a.eigenvalues[i] - b.eigenvalues[i]));
    largest = std::max(largest, std::abs(a.eigenvalues[i]));
  }
  return distance < std::sqrt(kNear) * largest;
}

}  // namespace

double Equilibrium::growth() const {
  double real = 0;
  for (const auto& value : eigenvalues) real = std::max(real, value.real());
  return real;
}

EquilibriumReport find_equilibria(const Model& model, const Scene& scene,
                                  const std::function<void(double)>& tick) {
  EquilibriumReport report;
  const std::vector<GiNaC::ex> integrals = linear_integrals(model, report.symmetries);
  Scene own = scene;
  SpecialiseOptions options;
  options.observe.emplace();
  options.gradients = true;
  const Model extended = with_velocities(model, own, integrals, options.keep_parameters);
  const Specialisation spec = specialise(extended, own, options);
  if (spec.uses_time) throw ModelError("equations that depend on the time have no equilibria");
  for (const std::string& name : spec.invariant_names) {
    if (name == "H") continue;
    const bool symmetry = name.rfind("symmetry_", 0) == 0;
    report.level.push_back(symmetry ? report.symmetries[std::stoul(name.substr(9)) - 1] : name);
  }
  const Equations equations(spec, integrals.size());
  const double scale = std::max(equations.start().norm(), 1e-3);
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  for (; report.starts < kStarts; ++report.starts) {
    tick(static_cast<double>(report.starts) / kStarts);
    Vector x = equations.start(), v = Vector::Zero(static_cast<Eigen::Index>(integrals.size()));
    if (report.starts > 0)
      for (double& entry : x) entry = scale * normal(random);
    for (double& entry : v) entry = normal(random);
    if (!solve(equations, x, v, scale)) continue;
    const auto found = described(equations, x, v);
    if (found && std::none_of(report.equilibria.begin(), report.equilibria.end(),
                              [&](const Equilibrium& known) { return same(known, *found, scale); }))
      report.equilibria.push_back(*found);
  }
  std::stable_sort(report.equilibria.begin(), report.equilibria.end(),
                   [](const auto& a, const auto& b) { return a.family < b.family; });
  return report;
}

}  // namespace casimir::tools
