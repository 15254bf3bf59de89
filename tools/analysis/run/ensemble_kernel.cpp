#include "tools/analysis/run/ensemble_kernel.hpp"

#include <chrono>
#include <memory>
#include <mutex>

#include "codegen/compile.hpp"
#include "codegen/emit_cpp.hpp"
#include "codegen/emit_watched.hpp"
#include "codegen/expansion_loss.hpp"
#include "codegen/lane_form.hpp"
#include "runtime/step/step_watch.hpp"
#include "runtime/uncompiled.hpp"
#include "runtime/undefined_motion.hpp"

namespace casimir {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::string_view kQuadratic = "runtime/kernels/lanes/lane_quadratic.hpp";
constexpr std::string_view kGeneral = "runtime/kernels/lanes/lane_convolved.hpp";

/// Fewer members than this are done before a compiler is.
constexpr std::size_t kFew = 64;
/// More products than this make the compiler slow.
constexpr std::size_t kManyProducts = 64;

/// \return  where the object is.
std::string load(const std::string& text, EnsembleKernel& result) {
  const CompiledObject object = compile(text);
  result.lanes = loaded([&] { return loaded_lanes(object.path); });
  result.compiled = true;
  result.from_cache = object.from_cache;
  return object.path;
}

/// The tables as constants of a compiled kernel where there is a compiler and enough to do, else
/// those of this program: the same operations in the same order.
void quadratic(const LaneForm& form, bool worth_compiling, EnsembleKernel& result) {
  if (worth_compiling && form.products.size() <= kManyProducts) {
    try {
      load(emit_lane_module(form, kernel_text(kQuadratic)), result);
      result.lanes->numbers = form.numbers;
      return;
    } catch (const EnvironmentError&) {
    }
  }
  result.lanes = table_driven_lanes(form);
}

/// A module of the method, whose parameters may be others than the scene's.
CompiledModule module_for_any(const PreparedScene& run, const Method& method) {
  // Tables for one trajectory hold the parameters of one.
  const bool tables = method.name == "taylor" && !run.parameters.empty();
  if (!tables) return compile_for(run, method);
  const Specialisation& s = run.specialisation;
  try {
    return compile_for(run, *find_method("taylor-compiled"));
  } catch (const CompilerMissing&) {
    return {.module = uncompiled_module(s.rhs, s.invariants, std::nullopt, run.parameters),
            .compiled = false,
            .warning = kInterpretedWarning};
  }
}

/// One module for each thread.
std::function<Module()> modules(const PreparedScene& run, const Method& method,
                                EnsembleKernel& result) {
  struct Store {
    std::mutex guard;
    std::optional<Module> first;
  };
  const auto store = std::make_shared<Store>();
  CompiledModule made = module_for_any(run, method);
  result.compiled = made.compiled;
  result.from_cache = made.from_cache;
  result.warning = made.warning;
  store->first = std::move(made.module);
  return [store, &run, &method] {
    const std::lock_guard lock(store->guard);
    if (!store->first) return module_for_any(run, method).module;
    Module module = std::move(*store->first);
    store->first.reset();
    return module;
  };
}

}  // namespace

EnsembleKernel ensemble_kernel(const PreparedScene& run, const Method& method, std::size_t members,
                               bool lanes) {
  const auto start = Clock::now();
  EnsembleKernel result;
  const Specialisation& s = run.specialisation;
  const bool compiled = method.name == "taylor-compiled";
  if (lanes && method.series) {
    const auto form = expansion_loses_digits(s.rhs) ? std::nullopt : lane_form(s.rhs, s.limits);
    if (form) {
      quadratic(*form, compiled || members >= kFew, result);
    } else {
      try {
        const Program watched = StepWatch(s.rhs).arguments();
        const std::string path =
            load(emit_series_lanes(s, kernel_text(kGeneral)) + emit_watched(s, watched), result);
        result.lanes->watch = watch_of_object(s.rhs, path);
      } catch (const CompilerMissing&) {
      }
    }
  }
  if (!result.lanes) result.module_for_thread = modules(run, method, result);
  result.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return result;
}

EnsembleResult integrate_ensemble(const Ensemble& ensemble, const PreparedScene& run,
                                  const EnsembleKernel& kernel, const Method& method,
                                  const Settings& settings, int jobs) {
  const Specialisation& s = run.specialisation;
  EnsembleResult result =
      kernel.lanes ? integrate_in_lanes(ensemble, *kernel.lanes, s.invariants, settings, jobs)
                   : integrate_members(ensemble, kernel.module_for_thread, method, s.invariants,
                                       settings, jobs);
  const UndefinedMotion undefined(s.rhs);
  for (std::size_t i = 0; i < result.members.size(); ++i) {
    MemberResult& member = result.members[i];
    if (member.state.empty()) continue;
    const auto inputs = [&](const double* x, double t) {
      std::vector<double> all(x, x + ensemble.states);
      all.insert(all.end(), ensemble.values_of(i), ensemble.values_of(i) + ensemble.parameters);
      all.push_back(t);
      return all;
    };
    const std::string why = undefined.why(member.status, inputs(ensemble.state(i), settings.begin),
                                          inputs(member.state.data(), member.time));
    if (!why.empty()) member.status = Status::at_jump;
  }
  return result;
}

}  // namespace casimir
