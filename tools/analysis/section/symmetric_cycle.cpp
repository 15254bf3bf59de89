#include "tools/analysis/section/symmetric_cycle.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "runtime/step/dense.hpp"
#include "symbolic/case/limits.hpp"
#include "symbolic/expression/decimal.hpp"
#include "symbolic/expression/expression_size.hpp"
#include "symbolic/model/given_functions.hpp"
#include "tools/analysis/equilibria/eigenvalue_discs.hpp"
#include "tools/analysis/error.hpp"
#include "tools/analysis/estimate/saltation.hpp"
#include "tools/analysis/proof/proved_facts.hpp"
#include "tools/analysis/section/periods.hpp"
#include "tools/analysis/sweep/deviations.hpp"

namespace casimir {
namespace {

using State = Eigen::VectorXd;
using Square = Eigen::MatrixXd;

constexpr int kMostPassages = 48, kMostRounds = 60;
/// Of points in double: what holds there to this is taken to hold.
constexpr double kPointHolds = 1e-9;
/// Directions in which the equations say nothing: along families of cycles.
constexpr double kSilent = 1e-8;
/// Newton's method has arrived where it moves no further than this, relative to the state.
constexpr double kStill = 1e-12, kReturnMet = 1e-10;
/// Multipliers so near to the unit circle count as on it.
constexpr double kOnCircle = 1e-5;

/// A point in no special position, between 0.4 and 1.4.
GiNaC::exmap some_point(const Model& model, int which) {
  GiNaC::exmap point;
  for (std::size_t i = 0; i < model.variables.size(); ++i) {
    const double x = std::sqrt(2. + 3. * which) * static_cast<double>(i + 1);
    point[model.variables[i]] = GiNaC::numeric(0.4 + x - std::floor(x));
  }
  return point;
}

std::optional<double> value_at(const GiNaC::ex& f, const GiNaC::exmap& point,
                               const Limits& limits) {
  const auto number = real_decimal(substituted(f, point, limits), limits.bits);
  if (!number) return std::nullopt;
  return number->to_double();
}

GiNaC::exmap image_of(const Model& model, const std::vector<GiNaC::ex>& image) {
  GiNaC::exmap map;
  for (std::size_t i = 0; i < image.size(); ++i) map[model.variables[i]] = image[i];
  return map;
}

bool near(const std::optional<double>& a, const std::optional<double>& b) {
  return a && b && std::abs(*a - *b) <= kPointHolds * (1 + std::abs(*a) + std::abs(*b));
}

/// The least number of times after which some point is where it was.
int order_of(const Model& model, const std::vector<GiNaC::ex>& image) {
  const GiNaC::exmap start = some_point(model, 1);
  GiNaC::exmap here = start;
  for (int order = 1; order <= kMostPassages; ++order) {
    GiNaC::exmap next;
    bool back = true;
    for (std::size_t i = 0; i < image.size(); ++i) {
      const auto value = value_at(image[i], here, model.limits);
      if (!value) throw RequestError("the symmetry has no value at a point in general position");
      next[model.variables[i]] = GiNaC::numeric(*value);
      back = back && near(value, value_at(model.variables[i], start, model.limits));
    }
    here = std::move(next);
    if (back) return order;
  }
  throw RequestError(
      fmt::format("the symmetry is of no order up to {}: applied so often it is not the identity",
                  kMostPassages));
}

/// \throws RequestError  where not all of these are proved; `refused` says what one means.
void require_proved(const Model& model, const std::vector<Identity>& identities,
                    const std::function<std::string(const GiNaC::symbol&)>& refused) {
  if (verdict_on_identities(model, identities) == Verdict::proved) return;
  for (std::size_t i = 0; i < identities.size(); ++i)
    if (verdict_on_identities(model, {identities[i]}) == Verdict::refuted)
      throw RequestError(refused(model.variables[i]));
  throw RequestError("whether the map is a symmetry of the equations is not decided");
}

Identity identity(GiNaC::ex left, GiNaC::ex right) {
  return {"symmetry", {"symmetry", 1, 1}, std::move(left), std::move(right), {}};
}

/// S^n = 1, identically.
void check_order(const Model& model, const std::vector<GiNaC::ex>& image, int order) {
  const GiNaC::exmap map = image_of(model, image);
  std::vector<Identity> identities;
  for (const GiNaC::symbol& x : model.variables) {
    GiNaC::ex moved = x;
    for (int k = 0; k < order; ++k) moved = substituted(moved, map, model.limits);
    identities.push_back(identity(moved, x));
  }
  require_proved(model, identities, [order](const GiNaC::symbol& x) {
    return fmt::format("the symmetry is of no finite order: applied {} times it does not keep {}",
                       order, x.get_name());
  });
}

/// dS f = f(S), identically: at points of some region, or to some digits, it would be so of maps
/// that are no symmetries.
void check_motions(const Model& model, const std::vector<GiNaC::ex>& field,
                   const std::vector<GiNaC::ex>& image) {
  const GiNaC::exmap map = image_of(model, image);
  std::vector<Identity> identities;
  for (std::size_t i = 0; i < image.size(); ++i) {
    GiNaC::ex moved = 0;
    for (std::size_t j = 0; j < image.size(); ++j)
      moved += image[i].diff(model.variables[j]) * field[j];
    identities.push_back(identity(moved, substituted(field[i], map, model.limits)));
  }
  require_proved(model, identities, [](const GiNaC::symbol& x) {
    return fmt::format(
        "the map is no symmetry of the equations: the image of {} does not change as {} does at "
        "the image of a point",
        x.get_name(), x.get_name());
  });
}

/// Newton's method for one tolerance.
class SymmetricNewton {
 public:
  SymmetricNewton(const Model& model, const Scene& scene, const PreparedScene& run,
                  const PhaseSymmetry& symmetry, const SymmetricCycleRequest& request)
      : model_(model),
        deviating_(with_deviation(model, scene, run)),
        method_(*find_method("taylor")),
        code_(compile_for(deviating_, method_)),
        saltation_(run.specialisation.rhs),
        symmetry_(symmetry),
        request_(request) {
    for (const GiNaC::ex& f : symmetry.image) {
      image_.push_back(model.at_parameters(f, scene));
      for (const GiNaC::symbol& x : model.variables) slopes_.push_back(image_.back().diff(x));
    }
    std::vector<GiNaC::ex> functions;
    for (const GiNaC::ex& rate : model.field) functions.push_back(model.at_parameters(rate, scene));
    if (model.hamiltonian) functions.push_back(model.at_parameters(*model.hamiltonian, scene));
    angles_ = angles_among(model.variables, functions);
  }

  SymmetricCycle solve(State x, double period, double tolerance) {
    SymmetricCycle result;
    tolerance_ = tolerance;
    double part = period / symmetry_.order;
    for (int round = 1; round <= kMostRounds; ++round) {
      if (request_.give_up && request_.give_up()) return failed("it was stopped");
      if (!flow(x, part))
        return failed("the motion could not be continued for a part of the period");
      const State miss = difference(end_, image_at(x));
      const double size = 1e-300 + x.norm();
      Square equations(x.size(), x.size() + (request_.keep_period ? 0 : 1));
      equations.leftCols(x.size()) = derivative_ - slopes_at(x);
      if (!request_.keep_period) equations.rightCols(1) = rate_;
      const State step = -shortest_solution(equations, miss, kSilent);
      if (!step.allFinite()) return failed("Newton's method left the numbers");
      const double longest = 0.2 * size, shorter = std::min(1., longest / step.norm());
      x += shorter * step.head(x.size());
      if (!request_.keep_period) part += shorter * step[x.size()];
      if (!(part * period > 0)) return failed("the period has shrunk to nothing");
      result.rounds = round;
      result.residual = miss.norm() / size;
      if (step.norm() < kStill * (size + std::abs(part)) ||
          (round > 8 && miss.norm() < kReturnMet * size && step.norm() < 100 * kStill * size)) {
        result.found = result.residual < kReturnMet;
        break;
      }
    }
    if (!result.found) return failed("Newton's method has not arrived at a cycle");
    if (is_at_rest(x, part))
      return failed("Newton's method has arrived at an equilibrium, which has no period");
    result.order = symmetry_.order;
    result.fixed_after = fixed_after(x);
    result.state.assign(x.data(), x.data() + x.size());
    result.period = part * symmetry_.order;
    if (!flow(x, part)) return failed("the motion could not be continued for a part of the period");
    find_multipliers(x, result);
    close(x, result);
    return result;
  }

 private:
  static SymmetricCycle failed(std::string reason) {
    SymmetricCycle result;
    result.reason = std::move(reason);
    return result;
  }

  GiNaC::exmap at(const State& x) const {
    GiNaC::exmap point;
    for (std::size_t i = 0; i < model_.variables.size(); ++i)
      point[model_.variables[i]] = GiNaC::numeric(x[static_cast<Eigen::Index>(i)]);
    return point;
  }

  double number(const GiNaC::ex& f, const GiNaC::exmap& point) const {
    return value_at(f, point, model_.limits).value_or(std::numeric_limits<double>::quiet_NaN());
  }

  State image_at(const State& x) const {
    const GiNaC::exmap point = at(x);
    State result(x.size());
    for (std::size_t i = 0; i < image_.size(); ++i)
      result[static_cast<Eigen::Index>(i)] = number(image_[i], point);
    return result;
  }

  Square slopes_at(const State& x) const {
    const GiNaC::exmap point = at(x);
    Square result(x.size(), x.size());
    for (Eigen::Index i = 0; i < x.size(); ++i)
      for (Eigen::Index j = 0; j < x.size(); ++j)
        result(i, j) = number(slopes_[static_cast<std::size_t>(i * x.size() + j)], point);
    return result;
  }

  State difference(const State& to, const State& from) const {
    State result = to - from;
    const double turn = 2 * std::acos(-1.);
    for (Eigen::Index i = 0; i < result.size(); ++i)
      if (angles_[static_cast<std::size_t>(i)]) result[i] -= turn * std::round(result[i] / turn);
    return result;
  }

  Settings settings(double duration) {
    Settings settings;
    saltation_.begin();
    settings.after_step =
        saltation_.hook(deviating_.parameters, deviating_.specialisation.states.size());
    settings.duration = duration;
    settings.rtol = tolerance_;
    settings.atol = tolerance_ * 1e-2;
    settings.monitor = false;
    settings.give_up = request_.give_up;
    return settings;
  }

  /// The end of the motion from x, its derivative by x, and the rate there.
  bool flow(const State& x, double duration) {
    const Eigen::Index n = x.size();
    derivative_.resize(n, n);
    for (Eigen::Index k = 0; k < n; ++k) {
      std::vector<double> state(x.data(), x.data() + n);
      state.resize(static_cast<std::size_t>(2 * n), 0);
      state[static_cast<std::size_t>(n + k)] = 1;
      const Trajectory run =
          integrate(code_.module, method_, settings(duration), state, deviating_.parameters);
      if (run.status != Status::ok) return false;
      end_ = Eigen::Map<const State>(run.state.data(), n);
      derivative_.col(k) = Eigen::Map<const State>(run.state.data() + n, n);
    }
    std::vector<double> state(end_.data(), end_.data() + n), rate(static_cast<std::size_t>(2 * n));
    state.resize(static_cast<std::size_t>(2 * n), 0);
    code_.module.functions().rhs(0, state.data(), deviating_.parameters.data(), rate.data());
    rate_ = Eigen::Map<const State>(rate.data(), n);
    return derivative_.allFinite();
  }

  /// Whether nothing moves but for rounding, beside the size of the variables that do at all.
  bool is_at_rest(const State& x, double part) const {
    constexpr double kOfSize = 1e-10;
    double size = 0;
    for (Eigen::Index i = 0; i < x.size(); ++i)
      if (!model_.field[static_cast<std::size_t>(i)].is_zero()) size = std::hypot(size, x[i]);
    return !(rate_.norm() * std::abs(part) > kOfSize * size);
  }

  /// After how many times S takes x to itself; at most its order.
  int fixed_after(const State& x) const {
    State here = x;
    for (int k = 1; k < symmetry_.order; ++k) {
      here = image_at(here);
      if (difference(here, x).norm() < kPointHolds * (1e-300 + x.norm())) return k;
    }
    return symmetry_.order;
  }

  void find_multipliers(const State& x, SymmetricCycle& result) const {
    const Square slopes = slopes_at(x);
    Square turned(x.size(), x.size());
    for (Eigen::Index k = 0; k < x.size(); ++k)
      turned.col(k) = shortest_solution(slopes, derivative_.col(k), 1e-12);
    constexpr double kOfDerivative = 1e-10;
    const auto discs = eigenvalue_discs(
        turned, Square::Constant(x.size(), x.size(), kOfDerivative * turned.cwiseAbs().maxCoeff()));
    if (!discs) return;
    for (const EigenvalueDisc& disc : *discs) result.multipliers.push_back(disc.value);
    result.grows = std::ranges::any_of(*discs, [&](const EigenvalueDisc& one) {
      return std::ranges::all_of(*discs, [&](const EigenvalueDisc& disc) {
        return disc.group != one.group || std::abs(disc.centre) - disc.radius > 1 + kOnCircle;
      });
    });
    std::ranges::sort(result.multipliers, [](const auto& a, const auto& b) {
      return std::pair(-std::abs(a), std::arg(a)) < std::pair(-std::abs(b), std::arg(b));
    });
  }

  void close(const State& x, SymmetricCycle& result) {
    std::vector<double> state(x.data(), x.data() + x.size());
    state.resize(static_cast<std::size_t>(2 * x.size()), 0);
    const Trajectory run =
        integrate(code_.module, method_, settings(result.period), state, deviating_.parameters);
    const State end = Eigen::Map<const State>(run.state.data(), x.size());
    result.closure = run.status == Status::ok ? difference(end, x).norm() / (1e-300 + x.norm())
                                              : std::numeric_limits<double>::infinity();
  }

  const Model& model_;
  PreparedScene deviating_;
  const Method& method_;
  CompiledModule code_;
  Saltation saltation_;
  const PhaseSymmetry& symmetry_;
  const SymmetricCycleRequest& request_;
  std::vector<GiNaC::ex> image_, slopes_;  ///< for the values of the parameters; row by row
  std::vector<bool> angles_;
  double tolerance_ = 0;
  State end_, rate_;
  Square derivative_;
};

}  // namespace

PhaseSymmetry phase_symmetry(const Model& model, const Scene& scene,
                             const std::vector<std::pair<std::string, GiNaC::ex>>& images) {
  PhaseSymmetry result;
  std::vector<GiNaC::ex> at_scene, field;
  for (const GiNaC::ex& rate : model.field) field.push_back(model.at_parameters(rate, scene));
  for (const GiNaC::symbol& x : model.variables) {
    const auto given = std::ranges::find_if(
        images, [&](const auto& image) { return image.first == x.get_name(); });
    result.image.push_back(given == images.end() ? GiNaC::ex(x) : given->second);
    at_scene.push_back(model.at_parameters(result.image.back(), scene));
  }
  if (model.time) throw RequestError("the equations depend on the time: no cycle of the flow");
  result.order = order_of(model, at_scene);
  const Model own = model_in_scene(model, scene);
  check_order(own, at_scene, result.order);
  check_motions(own, field, at_scene);
  return result;
}

namespace {

/// Of two variables whose rates have no divergence the multipliers are 1, along the motion, and,
/// by Liouville's formula, 1.
bool keeps_areas(const Model& model, const Scene& scene) {
  if (model.variables.size() != 2) return false;
  GiNaC::ex divergence = 0;
  for (std::size_t i = 0; i < 2; ++i)
    divergence += model.at_parameters(model.field[i], scene).diff(model.variables[i]);
  return divergence.expand().is_zero();
}

}  // namespace

SymmetricCycle symmetric_cycle(const Model& model, const Scene& scene, const PreparedScene& run,
                               const PhaseSymmetry& symmetry,
                               const SymmetricCycleRequest& request) {
  if (run.specialisation.states.size() != model.variables.size())
    throw RequestError("a cycle needs every variable");
  SymmetricNewton newton(model, scene, run, symmetry, request);
  const State start =
      Eigen::Map<const State>(run.initial.data(), static_cast<Eigen::Index>(run.initial.size()));
  SymmetricCycle cycle = newton.solve(start, request.guess, request.tolerance);
  if (!cycle.found) return cycle;
  cycle.reciprocal = (model.poisson && verdict_on_jacobi(model, scene) == Verdict::proved) ||
                     keeps_areas(model, scene);
  const State found =
      Eigen::Map<const State>(cycle.state.data(), static_cast<Eigen::Index>(cycle.state.size()));
  constexpr double kCoarser = 100;
  const SymmetricCycle other = newton.solve(found, cycle.period, kCoarser * request.tolerance);
  constexpr double kUnknown = std::numeric_limits<double>::infinity();
  cycle.state_error = cycle.period_error = kUnknown;
  if (!other.found) return cycle;
  const State again =
      Eigen::Map<const State>(other.state.data(), static_cast<Eigen::Index>(other.state.size()));
  cycle.state_error = std::max((again - found).norm(), cycle.residual * found.norm());
  cycle.period_error =
      std::max(std::abs(other.period - cycle.period), cycle.residual * std::abs(cycle.period));
  return cycle;
}

SpectralStability SymmetricCycle::stability() const {
  if (grows) return SpectralStability::unstable;
  if (!reciprocal) {
    const auto from_one = [](const std::complex<double>& m) { return std::abs(m - 1.); };
    const auto along = std::ranges::min_element(multipliers, {}, from_one);
    for (auto m = multipliers.begin(); m != multipliers.end(); ++m)
      if (m != along && !(std::abs(*m) < 1 - kOnCircle)) return SpectralStability::undecided;
    return multipliers.size() > 1 ? SpectralStability::stable : SpectralStability::undecided;
  }
  const bool on_circle = std::ranges::all_of(multipliers, [](const std::complex<double>& m) {
    return std::abs(std::abs(m) - 1) < kOnCircle;
  });
  return on_circle && !multipliers.empty() ? SpectralStability::stable
                                           : SpectralStability::undecided;
}

std::vector<std::string> SymmetricCycle::warnings() const {
  constexpr double kFarFromClosing = 1e-6;
  std::vector<std::string> result;
  if (closure > kFarFromClosing)
    result.push_back(
        fmt::format("over all of the period the motion misses its start by {:.1e}: the cycle is "
                    "too unstable, or no cycle",
                    closure));
  if (fixed_after > 0 && fixed_after < order)
    result.push_back(fmt::format(
        "S {} this cycle as it is, point by point: {} of T is a period of it already",
        fixed_after == 1 ? "leaves" : fmt::format("applied {} times leaves", fixed_after),
        fmt::format("{}/{}", fixed_after, order)));
  if (!(state_error < kFarFromClosing))
    result.emplace_back(
        "a coarser tolerance gives another cycle, or none: where the symmetry is of a whole "
        "family, one of its members is meant and no other is better");
  return result;
}

}  // namespace casimir
