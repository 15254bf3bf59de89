#include "tools/analysis/run/interpreted_first.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "codegen/compile/compiler.hpp"
#include "codegen/optimise/differentiate.hpp"
#include "runtime/program/interpreted_radau.hpp"
#include "runtime/step/step_look.hpp"
#include "runtime/uncompiled.hpp"
#include "tools/analysis/run/taylor_path.hpp"

namespace casimir {
namespace {

using Integration = std::function<ModuleFunctions::Integration>;

/// Nominal seconds, about those of a core at 3 GHz with AVX2: of a line of a program that is
/// interpreted, and of the same in a Taylor series of order 20.
constexpr double kLine = 1.5e-9, kSeriesLine = 60e-9;
/// Evaluations of the right-hand side in a step of Radau IIA with s stages, for each stage.
constexpr double kSweepsOfStage = 5;
/// Nominal seconds of interpreted steps from which on compiled code, which is about twice as fast,
/// is worth its compilation: those, or these for each line of the program, which the compiler
/// takes.
constexpr double kLong = 0.05, kLongForLine = 5e-3;
/// Of that: what has to be done before the rest is estimated. In transients the time hardly moves.
constexpr double kKnown = 1. / 8;

/// What an interpreted run needs to go over.
struct Successor {
  double step = 0;   ///< nominal seconds of an interpreted one
  double worth = 0;  ///< nominal seconds of interpreted steps that make a run long
  /// The compiled module, made where it is first asked for; null where there is no compiler.
  std::function<const Module*()> compiled;
  std::function<bool(double, const std::vector<double>&)> may_go_over;
  std::size_t states = 0;
};

/// Counts the steps of an interpreted run, and ends it where compiled code shall go on.
class Lookout {
 public:
  Lookout(const casimir_run& run, const Successor& successor)
      : asked_(run), successor_(successor) {}

  void watch(casimir_run& run) {
    run.observe = [](void* self, const casimir_step* step) {
      return static_cast<Lookout*>(self)->see(*step);
    };
    run.observer = this;
  }
  bool is_long() const { return long_; }

 private:
  int see(const casimir_step& step) {
    if (asked_.observe && asked_.observe(asked_.observer, &step) != 0) return 1;
    if (++steps_ != next_ || step.t1 == asked_.t_end) return 0;
    next_ *= 2;
    const double part = (step.t1 - asked_.t_begin) / (asked_.t_end - asked_.t_begin);
    const double work = static_cast<double>(steps_) * successor_.step;
    if (work < successor_.worth * std::max(kKnown, part)) return 0;
    long_ = !successor_.may_go_over ||
            successor_.may_go_over(step.t1, {step.x1, step.x1 + successor_.states});
    return 1;
  }

  const casimir_run& asked_;
  const Successor& successor_;
  unsigned long long steps_ = 0, next_ = 1;
  bool long_ = false;
};

void add(casimir_outcome& sum, const casimir_outcome& part) {
  sum.status = part.status;
  sum.t = part.t;
  sum.steps += part.steps;
  sum.rejected += part.rejected;
  sum.evaluations += part.evaluations;
  sum.jacobians += part.jacobians;
}

/// The rest of a run that was made up to `out->t`.
void go_on(const Integration& by, const casimir_run& asked, double* x, casimir_outcome* out) {
  casimir_run rest = asked;
  rest.t_begin = out->t;
  if (asked.max_steps) {
    const unsigned long long done = out->steps + out->rejected;
    if (done >= asked.max_steps) {
      out->status = CASIMIR_MAX_STEPS;
      return;
    }
    rest.max_steps -= done;
  }
  casimir_outcome behind = {};
  by(&rest, x, &behind);
  add(*out, behind);
}

/// The same by a compiled module, which has code for what its steps are watched for.
void go_on(const Module& module, const casimir_run& asked, double* x, casimir_outcome* out) {
  casimir_run watched = asked;
  std::optional<StepLook> look;
  if (asked.look && module.watch()) {
    look.emplace(*module.watch(), static_cast<std::size_t>(module.dimension()), asked.parameters,
                 x);
    look->land_further(static_cast<const StepLook*>(asked.looker)->lands_further());
    watched.look = [](void* looker, const casimir_step* trial) {
      return (*static_cast<StepLook*>(looker))(*trial);
    };
    watched.looker = &*look;
  }
  go_on(module.functions().integrate, watched, x, out);
}

void integrate(const Integration& interpreted, const Successor& successor, const casimir_run& asked,
               double* x, casimir_outcome* out) {
  if (asked.fixed_step > 0) {
    const double steps = std::abs(asked.t_end - asked.t_begin) / asked.fixed_step;
    const Module* const module =
        steps * successor.step > successor.worth ? successor.compiled() : nullptr;
    return module ? module->functions().integrate(&asked, x, out) : interpreted(&asked, x, out);
  }
  Lookout lookout(asked, successor);
  casimir_run watched = asked;
  lookout.watch(watched);
  interpreted(&watched, x, out);
  if (!lookout.is_long()) return;
  if (const Module* const module = successor.compiled()) return go_on(*module, asked, x, out);
  go_on(interpreted, asked, x, out);
}

/// What is compiled once a run asks for it.
class LateModule {
 public:
  LateModule(const PreparedScene& run, const Method& method, std::shared_ptr<LaterCode> later)
      : run_(run), method_(method), later_(std::move(later)) {}

  const Module* module() {
    if (!module_ && !later_->missing) compile();
    return module_ ? &module_->module : nullptr;
  }

 private:
  void compile() {
    const auto start = std::chrono::steady_clock::now();
    try {
      module_.emplace(compile_always(run_, method_));
      later_->compiled = true;
      later_->from_cache = module_->from_cache;
    } catch (const CompilerMissing&) {
      later_->missing = true;
    }
    later_->seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }

  const PreparedScene& run_;
  const Method& method_;
  std::shared_ptr<LaterCode> later_;
  std::optional<CompiledModule> module_;
};

bool has_compiler() {
  try {
    codegen::find_compiler("");
    return true;
  } catch (const CompilerMissing&) {
    return false;
  }
}

/// The method interpreted, and the nominal seconds of a step; nothing where it cannot be.
struct Interpreted {
  Integration integrate;
  double step;
};

std::optional<Interpreted> interpreted_by(const PreparedScene& run, const Method& method) {
  const Program& rhs = run.specialisation.rhs;
  const auto lines = static_cast<double>(rhs.code.size());
  if (method.name == "taylor") return Interpreted{nullptr, kSeriesLine * lines};
  const int stages = method.name == "radau9" ? 5 : method.name == "radau5" ? 3 : 0;
  if (stages == 0 || rhs.outputs.size() > kMostInterpretedStiff) return std::nullopt;
  SparseProgram jacobian = codegen::jacobian(rhs, rhs.outputs.size());
  return Interpreted{interpreted_radau(rhs, {jacobian.program, jacobian.entries}, stages),
                     kSweepsOfStage * stages * kLine * lines};
}

}  // namespace

BegunModule interpreted_first(
    const PreparedScene& run, const Method& method,
    const std::function<bool(double t, const std::vector<double>& x)>& may_go_over) {
  const auto start = std::chrono::steady_clock::now();
  const Specialisation& s = run.specialisation;
  std::optional<QuadraticForm> form;
  if (method.name == "taylor")
    form = choose_taylor_path(s.rhs, s.limits, run.parameters, true).form;
  const std::optional<Interpreted> how = form ? std::nullopt : interpreted_by(run, method);
  if (!how) return {compile_for(run, method), nullptr};
  CompiledModule result{.module = uncompiled_module(s.rhs, s.invariants, {}, run.parameters),
                        .compiled = false};
  auto later = std::make_shared<LaterCode>();
  later->missing = !has_compiler();
  auto late = std::make_shared<LateModule>(run, method, later);
  const double worth = std::max(kLong, kLongForLine * static_cast<double>(s.rhs.code.size()));
  Successor successor{how->step, worth, [late] { return late->module(); }, may_go_over,
                      s.states.size()};
  ModuleFunctions functions = result.module.functions();
  functions.integrate = [interpreted = how->integrate ? how->integrate : functions.integrate,
                         successor](const casimir_run* asked, double* x, casimir_outcome* out) {
    integrate(interpreted, successor, *asked, x, out);
  };
  result.module = Module::from_functions(functions);
  result.module.know_equations(s.rhs);
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return {std::move(result), std::move(later)};
}

}  // namespace casimir
