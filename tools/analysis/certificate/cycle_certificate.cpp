#include "tools/analysis/certificate/cycle_certificate.hpp"

#include <cln/float.h>
#include <cln/integer.h>
#include <cln/real.h>
#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "codegen/optimise/differentiate.hpp"
#include "codegen/optimise/lower.hpp"
#include "codegen/specialise.hpp"
#include "runtime/program/exact_number.hpp"
#include "runtime/trace_check.hpp"
#include "runtime/validated/flow_series.hpp"
#include "symbolic/algebra/ball_evaluator.hpp"
#include "symbolic/case/limits.hpp"
#include "symbolic/prove.hpp"
#include "tools/analysis/certificate/run_certificate.hpp"
#include "tools/analysis/proof/ball_matrix.hpp"

namespace casimir {
namespace {

/// Why the certificate of a cycle does not hold: a sentence.
struct CycleRefuted {
  std::string reason;
  bool stopped = false;
};

/// The equations of a cycle, and what is asked of them.
class CycleEquations {
 public:
  explicit CycleEquations(const CycleCertificate& certificate)
      : certificate_(certificate),
        model_(plain_model(certificate)),
        n_(model_.variables.size()),
        levels_(model_.variables, values_of(model_.integrals)),
        level_derivatives_(levels_.derivatives()),
        plane_(model_.variables, {plane_function()}),
        plane_derivatives_(plane_.derivatives()) {
    for (const NamedExpression& integral : model_.integrals) {
      const Proof proof = prove_claim(model_, ClaimKind::integral, integral);
      if (proof.verdict != Verdict::proved || !proof.where.empty())
        throw CycleRefuted{fmt::format("{} is not proved to be constant", integral.name)};
    }
  }

  std::size_t states() const { return n_; }
  const Model& model() const { return model_; }

  /// x' = T f(x), T' = 0 from the middle over a unit of time.
  ValidatedProblem problem(const cln::cl_RA& radius) const {
    const Specialisation s = scaled();
    ValidatedProblem result;
    result.rates = s.rhs;
    result.start = s.start;
    const SparseProgram jacobian = codegen::jacobian(s.rhs, n_ + 1);
    result.jacobian = jacobian.program;
    result.entries = jacobian.entries;
    if (cln::plusp(radius)) result.radii.assign(n_ + 1, radius);
    return result;
  }

  /// The functions of the level that might jump where their derivatives along solutions vanish.
  std::vector<Program> level_functions_with_branches() const {
    const Specialisation s = scaled();
    std::vector<Program> result;
    for (std::size_t k = 0; k < s.invariants.outputs.size(); ++k) {
      Program one = codegen::single_output(s.invariants, k);
      if (!validated::is_rational(one)) result.push_back(std::move(one));
    }
    return result;
  }

  /// The middle of the box: a point and a time, exactly.
  BallMatrix middle() const {
    const Scene& scene = model_.scenes.front();
    BallMatrix z(n_ + 1, 1);
    for (std::size_t i = 0; i <= n_; ++i)
      set_interval(z.at(i), exactly(i < n_ ? scene.initial[i] : *scene.duration));
    return z;
  }

  /// Plane, levels, and the differences that close the orbit.
  BallMatrix value(const BallMatrix& z, const BallMatrix& end) const {
    BallMatrix result(n_ + 1, 1);
    const BallMatrix x = z.rows_of(0, n_);
    arb_set(result.at(0), plane_(x).at(0));
    const BallMatrix functions = levels_(x);
    BallMatrix level(1, 1);
    for (std::size_t a = 0; a < levels(); ++a) {
      set_level(level.at(0), certificate_.levels[a]);
      arb_sub(result.at(1 + a), functions.at(a), level.at(0), kBallBits);
    }
    for (std::size_t k = 0; k < closing().size(); ++k)
      arb_sub(result.at(1 + levels() + k), end.at(coordinate(k)), x.at(coordinate(k)), kBallBits);
    return result;
  }

  BallMatrix derivatives(const BallMatrix& z, const BallMatrix& of_end) const {
    BallMatrix result(n_ + 1, n_ + 1);
    const BallMatrix x = z.rows_of(0, n_);
    // The derivative of a function may be smooth where the function jumps.
    plane_(x);
    levels_(x);
    const BallMatrix plane = plane_derivatives_(x), functions = level_derivatives_(x);
    for (std::size_t j = 0; j < n_; ++j) {
      arb_set(result.at(0, j), plane.at(0, j));
      for (std::size_t a = 0; a < levels(); ++a) arb_set(result.at(1 + a, j), functions.at(a, j));
    }
    for (std::size_t k = 0; k < closing().size(); ++k) {
      const std::size_t row = 1 + levels() + k;
      for (std::size_t j = 0; j <= n_; ++j) arb_set(result.at(row, j), of_end.at(coordinate(k), j));
      arb_sub_ui(result.at(row, coordinate(k)), result.at(row, coordinate(k)), 1, kBallBits);
    }
    return result;
  }

  /// The value of a function of the level, and what is near it.
  static RationalInterval level(const std::string& text) {
    const cln::cl_RA value = traced_number(text);
    const cln::cl_RA by = cln::abs(value) / cln::expt_pos(cln::cl_RA(2), 52);
    return {value - by, value + by};
  }

  /// Start and end are one point of the level: the functions have not jumped on the way between
  /// them, which `check_trace` has seen to.
  void check_closed(const BallMatrix& box, const BallMatrix& end) const {
    BallMatrix hull(n_, 1);
    for (std::size_t i = 0; i < n_; ++i) arb_union(hull.at(i), box.at(i), end.at(i), kBallBits);
    levels_(hull);  // smooth all over it, or thrown
    const BallMatrix functions = level_derivatives_(hull);
    BallMatrix pivots(levels(), levels()), inverse(levels(), levels());
    std::size_t column = 0;
    for (std::size_t i = 0; i < n_; ++i) {
      if (std::ranges::find(closing(), static_cast<int>(i)) != closing().end()) continue;
      for (std::size_t a = 0; a < levels(); ++a) arb_set(pivots.at(a, column), functions.at(a, i));
      ++column;
    }
    if (arb_mat_inv(inverse.raw(), pivots.raw(), kBallBits) == 0)
      throw CycleRefuted{"start and end are not certain to be one point of the level"};
  }

  /// Those coordinates that are left when the levels are solved for the others.
  std::vector<int> best_closing() const {
    const BallMatrix gradients = level_derivatives_(middle().rows_of(0, n_));
    Eigen::MatrixXd rows(static_cast<Eigen::Index>(levels()), static_cast<Eigen::Index>(n_));
    for (std::size_t a = 0; a < levels(); ++a)
      for (std::size_t i = 0; i < n_; ++i)
        rows(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(i)) = gradients.near(a, i);
    const Eigen::FullPivLU<Eigen::MatrixXd> lu(rows);
    std::vector<int> result;
    for (auto k = static_cast<Eigen::Index>(levels()); k < lu.cols(); ++k)
      result.push_back(lu.permutationQ().indices()(k));
    std::ranges::sort(result);
    return result;
  }

 private:
  Specialisation scaled() const {
    Model scaled;
    scaled.limits = model_.limits;
    scaled.name = model_.name;
    scaled.phase_space = "equations";
    scaled.variables = model_.variables;
    const GiNaC::symbol time("casimir_period");
    scaled.variables.push_back(time);
    for (const GiNaC::ex& rate : model_.field) scaled.field.push_back(time * rate);
    scaled.field.emplace_back(0);
    scaled.integrals = model_.integrals;
    Scene scene = model_.scenes.front();
    scene.initial.push_back(*scene.duration);
    scene.reference.clear();
    scene.duration = 1;
    SpecialiseOptions what;
    what.observe = std::vector<std::string>{};
    what.jacobian = false;
    return specialise(scaled, scene, what);
  }

  static Model plain_model(const CycleCertificate& certificate) {
    RunCertificate run;
    run.of_case = certificate.of_case;
    run.equations = certificate.equations;
    run.limits = certificate.limits;
    Model model = model_of_certificate(run);
    if (!model.scenes.front().duration) throw CycleRefuted{"there is no period"};
    if (model.time) throw CycleRefuted{"the equations have the time in them"};
    if (has_lost_parts(model, certificate.plane))
      throw CycleRefuted{"a part cancels in it that need not have a value"};
    if (model.integrals.size() != certificate.levels.size())
      throw CycleRefuted{"there is not one level for each integral"};
    return model;
  }
  static std::vector<GiNaC::ex> values_of(const std::vector<NamedExpression>& list) {
    std::vector<GiNaC::ex> result;
    for (const NamedExpression& one : list) result.push_back(one.value);
    return result;
  }
  GiNaC::ex plane_function() const {
    return model_.parse({certificate_.plane, {"plane", 1, 1}, certificate_.plane});
  }
  static RationalInterval exactly(const GiNaC::ex& value) {
    if (!GiNaC::is_a<GiNaC::numeric>(value) || !GiNaC::ex_to<GiNaC::numeric>(value).is_rational())
      throw CycleRefuted{"the middle of the box is no rational number"};
    const auto exact = cln::the<cln::cl_RA>(GiNaC::ex_to<GiNaC::numeric>(value).to_cl_N());
    return {exact, exact};
  }
  static void set_level(arb_ptr ball, const std::string& text) { set_interval(ball, level(text)); }

  std::size_t levels() const { return model_.integrals.size(); }
  const std::vector<int>& closing() const { return certificate_.closing; }
  std::size_t coordinate(std::size_t k) const { return static_cast<std::size_t>(closing()[k]); }

  const CycleCertificate& certificate_;
  Model model_;
  std::size_t n_;
  BallFunctions levels_, level_derivatives_, plane_, plane_derivatives_;
};

BallMatrix column_of(const std::vector<RationalInterval>& values, std::size_t columns = 1) {
  BallMatrix result(values.size() / columns, columns);
  for (std::size_t i = 0; i < values.size(); ++i)
    set_interval(result.at(i / columns, i % columns), values[i]);
  return result;
}

TraceCheck checked_trace(const ValidatedProblem& problem, const RunTrace& trace,
                         const TraceCheckSettings& settings, const char* which) {
  TraceCheck check = check_trace(problem, trace, settings);
  if (check.fault == TraceFault::stopped) throw CycleRefuted{"the time limit was reached", true};
  if (check.fault == TraceFault::not_smooth)
    throw CycleRefuted{
        "a function of the level is not certain to be smooth along the orbit: its value may jump"};
  if (check.fault != TraceFault::none)
    throw CycleRefuted{
        fmt::format("step {} of the run from the {} is not proved", check.step, which)};
  return check;
}

BallMatrix box_around(const BallMatrix& z, const std::string& radius) {
  const cln::cl_RA by = traced_number(radius);
  BallMatrix box(z.rows(), 1);
  for (std::size_t i = 0; i < z.rows(); ++i) {
    const RationalInterval ends = ends_of(z.at(i));
    set_interval(box.at(i), {ends.low - by, ends.high + by});
  }
  return box;
}

void check_form(const CycleCertificate& certificate, std::size_t n) {
  const std::vector<int>& closing = certificate.closing;
  const bool fits =
      closing.size() + certificate.levels.size() == n &&
      certificate.inverse.size() == (n + 1) * (n + 1) &&
      std::ranges::adjacent_find(closing, std::greater_equal<>()) == closing.end() &&
      std::ranges::all_of(closing, [&](int i) { return i >= 0 && i < static_cast<int>(n); });
  if (!fits) throw CycleRefuted{"the numbers of states, levels and coordinates do not go together"};
  if (!cln::plusp(traced_number(certificate.radius))) throw CycleRefuted{"the box has no radius"};
}

void verify(const CycleCertificate& certificate, const TraceCheckSettings& settings,
            CheckedCycle& result) {
  const CycleEquations equations(certificate);
  const std::size_t n = equations.states();
  for (const GiNaC::symbol& x : equations.model().variables) result.names.push_back(x.get_name());
  check_form(certificate, n);
  for (const NamedExpression& integral : equations.model().integrals)
    result.level_names.push_back(integral.name);
  for (const std::string& level : certificate.levels)
    result.levels.push_back(CycleEquations::level(level));
  TraceCheckSettings with_derivatives = settings;
  with_derivatives.derivatives = true;
  with_derivatives.smooth = equations.level_functions_with_branches();
  const TraceCheck point =
      checked_trace(equations.problem(0), certificate.point, settings, "middle");
  const TraceCheck wide = checked_trace(equations.problem(traced_number(certificate.radius)),
                                        certificate.box, with_derivatives, "box");
  const BallMatrix z = equations.middle(), box = box_around(z, certificate.radius);
  BallMatrix y(n + 1, n + 1);
  for (std::size_t i = 0; i < certificate.inverse.size(); ++i) {
    const cln::cl_RA entry = traced_number(certificate.inverse[i]);
    set_interval(y.at(i / (n + 1), i % (n + 1)), {entry, entry});
  }
  const BallMatrix solution =
      krawczyk(z, y, equations.value(z, column_of(point.end)),
               equations.derivatives(box, column_of(wide.derivatives, n + 1)), box);
  if (!inside(solution, box)) throw CycleRefuted{"Krawczyk's test fails"};
  equations.check_closed(box, column_of(wide.end));
  for (std::size_t i = 0; i <= n; ++i) {
    const RationalInterval ends = ends_of(solution.at(i));
    if (i < n) result.state.push_back(ends);
    if (i == n) result.period = ends;
  }
  if (!cln::plusp(result.period.low))
    throw CycleRefuted{"the period is not certain to be positive"};
}

RunTrace traced_run(const ValidatedProblem& problem) {
  RunTrace trace;
  ValidatedSettings settings;
  settings.trace = &trace;
  if (validated_run(problem, settings).status != ValidatedStatus::ok)
    throw CycleRefuted{"its orbit is not enclosed to the end"};
  return trace;
}

}  // namespace

CheckedCycle check_cycle(const CycleCertificate& certificate,
                         const std::function<bool()>& give_up) {
  CheckedCycle result;
  TraceCheckSettings settings;
  settings.give_up = give_up;
  try {
    verify(certificate, settings, result);
  } catch (const CycleRefuted& refuted) {
    result.reason = refuted.reason;
    result.stopped = refuted.stopped;
  } catch (const NotCertified&) {
    result.reason = "the functions of the level or the plane are not certain to be smooth there";
  }
  return result;
}

std::optional<CycleCertificate> certify_cycle(const std::string& of_case,
                                              const std::string& equations,
                                              const std::string& plane,
                                              const std::vector<double>& levels,
                                              const Limits& limits) {
  CycleCertificate certificate;
  certificate.of_case = of_case;
  certificate.equations = equations;
  certificate.limits = limits;
  certificate.plane = plane;
  for (const double level : levels) certificate.levels.push_back(traced_text(level));
  try {
    const CycleEquations system(certificate);
    const std::size_t n = system.states();
    certificate.closing = system.best_closing();
    certificate.point = traced_run(system.problem(0));
    const BallMatrix z = system.middle();
    for (const double radius : {0x1p-33, 0x1p-30, 0x1p-26}) {
      certificate.radius = traced_text(radius);
      const ValidatedProblem problem = system.problem(exact_number(radius));
      certificate.box = traced_run(problem);
      TraceCheckSettings settings;
      settings.derivatives = true;
      const TraceCheck wide = checked_trace(problem, certificate.box, settings, "box");
      const BallMatrix slopes = system.derivatives(z, column_of(wide.derivatives, n + 1)).middle();
      BallMatrix y(n + 1, n + 1);
      if (arb_mat_approx_inv(y.raw(), slopes.raw(), kBallBits) == 0) return std::nullopt;
      certificate.inverse.clear();
      for (std::size_t i = 0; i < (n + 1) * (n + 1); ++i)
        certificate.inverse.push_back(traced_text(y.near(i / (n + 1), i % (n + 1))));
      if (check_cycle(certificate).holds()) return certificate;
    }
  } catch (const CycleRefuted&) {
  } catch (const NotCertified&) {
  }
  return std::nullopt;
}

}  // namespace casimir
