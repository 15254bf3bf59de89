#include "tools/analysis/run/prepared_scene.hpp"

#include <cln/float_io.h>
#include <cln/real.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "codegen/add_jacobian.hpp"
#include "codegen/compile.hpp"
#include "codegen/emit/number_literal.hpp"
#include "codegen/emit_cpp.hpp"
#include "codegen/emit_watched.hpp"
#include "codegen/free_body.hpp"
#include "codegen/quadratic.hpp"
#include "codegen/split.hpp"
#include "runtime/evaluate.hpp"
#include "runtime/exact/closed_form.hpp"
#include "runtime/exact/polynomial_field.hpp"
#include "runtime/methods.hpp"
#include "runtime/program/exact_number.hpp"
#include "runtime/program/term_size.hpp"
#include "runtime/step/step_watch.hpp"
#include "runtime/taylor/program_layout.hpp"
#include "runtime/taylor/quadratic_targets.hpp"
#include "runtime/uncompiled.hpp"
#include "tools/analysis/run/closed_form_error.hpp"
#include "tools/analysis/run/interpreted_first.hpp"
#include "tools/analysis/run/taylor_path.hpp"

namespace casimir {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

CaseError without_duration(const Location& where, const std::string& scene) {
  return CaseError(where, fmt::format("the scene '{}' has no duration", printable(scene)), {},
                   "add a line such as duration = \"100\" to it, or give a duration to a command "
                   "that takes one");
}

}  // namespace

std::vector<cln::cl_F> start_values(const Specialisation& specialisation, int digits) {
  return evaluate(specialisation.start, {}, Arithmetic<cln::cl_F>(digits));
}

double rounded(const cln::cl_F& value) { return codegen::nearest<double>(cln::rational(value)); }

double remainder(const cln::cl_F& value, double nearest) {
  const cln::cl_RA left = cln::rational(value) - exact_number(nearest);
  // Nothing is left that a double could say.
  if (cln::abs(left) < exact_number(std::numeric_limits<double>::denorm_min())) return 0;
  return codegen::nearest<double>(left);
}

PreparedScene prepare(const Model& model, const Scene& scene, const SceneOptions& options) {
  const auto start = Clock::now();
  SpecialiseOptions what;
  what.fold_parameters = options.fold_parameters;
  what.keep_parameters = options.keep_parameters;
  what.observe = options.observe;
  what.jacobian = false;  // see `add_jacobian`
  PreparedScene run;
  run.specialisation = specialise(model, scene, what);
  const Specialisation& s = run.specialisation;
  const std::vector<cln::cl_F> values = start_values(s, kConstantDigits);
  std::size_t next = 0;
  for (std::size_t i = 0; i < s.states.size(); ++i, ++next) {
    run.initial.push_back(rounded(values[next]));
    run.rounding.push_back(remainder(values[next], run.initial.back()));
  }
  for (std::size_t i = 0; i < s.parameters.size(); ++i, ++next) {
    run.parameters.push_back(rounded(values[next]));
    run.parameter_rounding.push_back(remainder(values[next], run.parameters.back()));
  }
  run.duration = rounded(values[next]);
  run.duration_rounding = remainder(values[next], run.duration);
  run.where = scene.where;
  run.hamiltonian = scene_hamiltonian(model, scene, s.states, s.parameters, run.no_hamiltonian);
  run.generate_seconds = seconds_since(start);
  return run;
}

double duration_of(const PreparedScene& run) {
  if (!run.specialisation.has_duration) throw without_duration(run.where, run.specialisation.scene);
  return run.duration;
}

void require_duration(const Scene& scene) {
  if (!scene.duration) throw without_duration(scene.where, scene.name);
}

InvariantTerms PreparedScene::invariant_terms() const {
  return [this](double t, const double* x, long double* values, long double* sizes) {
    std::vector<SizedNumber> inputs;
    for (std::size_t i = 0; i < initial.size(); ++i)
      inputs.push_back(Arithmetic<SizedNumber>::plain(x[i]));
    for (const double p : parameters) inputs.push_back(Arithmetic<SizedNumber>::plain(p));
    inputs.push_back(Arithmetic<SizedNumber>::plain(t));
    for (const SizedNumber& number : evaluate(specialisation.invariants, inputs)) {
      *values++ = number.value;
      *sizes++ = std::abs(number.size);
    }
  };
}

namespace {

/// The system that the method is made from.
/// \throws ModelError  where there is none.
const SceneHamiltonian& hamiltonian_of(const PreparedScene& run, const Method& method) {
  if (!run.hamiltonian)
    throw ModelError(fmt::format("{} cannot be used: {}", method.name, run.no_hamiltonian));
  return *run.hamiltonian;
}

/// What the kernel of a method asks for beside a right-hand side.
/// \throws ModelError  where the system does not have it.
KernelNeeds needs_of(const PreparedScene& run, const Method& method) {
  KernelNeeds needs{.series = method.series};
  if (method.splits) needs.splitting = split(hamiltonian_of(run, method));
  if (method.free_body) needs.moments = free_body_moments(hamiltonian_of(run, method));
  return needs;
}

/// For any values of the parameters at run time: those of the scene are as good as others.
bool is_quadratic(const PreparedScene& run) {
  return quadratic_form(run.specialisation.rhs, run.specialisation.limits, run.parameters)
      .has_value();
}

/// A module from the compiler.
/// \throws ModelError  where the method is not defined for the equations.
/// \throws CompilerMissing  without one; the text names the method that does not need it.
CompiledModule compiled_module(const PreparedScene& run, const Method& method) {
  if (method.quadratic_only && !is_quadratic(run))
    throw ModelError(fmt::format(
        "{} is defined for equations that are polynomials of degree two at most in the variables "
        "and do not depend on the time, and these are not",
        method.name));
  Specialisation s = run.specialisation;
  const KernelNeeds needs = needs_of(run, method);
  // What no kernel of ours calls need not be compiled.
  if (method.header.empty() || method.uses_jacobian) add_jacobian(s);
  // A library that only calls the right-hand side has no kernel: one module serves them all.
  const std::string kernel = method.header.empty() ? std::string{} : kernel_source(method);
  CompileOptions options;
  options.standard_library = !method.outside.empty() && !kernel.empty();
  std::string text = emit_module(s, kernel, needs);
  // Only our own kernels ask whether a step may be taken.
  if (!kernel.empty() && method.outside.empty())
    text += emit_watched(s, StepWatch(s.rhs).arguments());
  try {
    const CompiledObject object = compile(text, options);
    CompiledModule result{.module = loaded([&] { return Module::load(object.path); }),
                          .from_cache = object.from_cache};
    result.module.know_equations(run.specialisation.rhs);
    return result;
  } catch (const CompilerMissing& problem) {
    throw CompilerMissing(std::string(problem.what()) +
                          ", or use the method taylor, which needs none");
  }
}

/// Where a program has more lines, the compiler takes many seconds, and tables are half as fast as
/// what it makes.
constexpr std::size_t kMostCompiledLines = 1500;

/// For the method of Taylor series: the tables where the system has that shape, else the compiler,
/// and without one, or where it would take too long, the program itself.
CompiledModule taylor_module(const PreparedScene& run, const Method& method) {
  const Specialisation& s = run.specialisation;
  TaylorChoice choice = choose_taylor_path(s.rhs, s.limits, run.parameters, true);
  const bool large = s.rhs.code.size() > kMostCompiledLines &&
                     ProgramLayout::of(s.rhs, run.parameters.size(), series_width());
  if (choice.path == TaylorPath::compiled && !large) {
    try {
      return compiled_module(run, method);
    } catch (const CompilerMissing&) {
      choice.path = TaylorPath::interpreted;
    }
  }
  CompiledModule result{
      .module = uncompiled_module(s.rhs, s.invariants, choice.form, run.parameters),
      .compiled = false};
  if (choice.path == TaylorPath::interpreted && !large) result.warning = kInterpretedWarning;
  return result;
}

/// The closed form of a scene's motion, or why there is none.
Recognised recognised(const PreparedScene& run, std::vector<cln::cl_F>& start) {
  if (!run.parameters.empty()) return {nullptr, "the parameters have no values before the run"};
  start = start_values(run.specialisation, kExactDigits);
  start.resize(run.initial.size());
  return closed_form(run.specialisation.rhs, start);
}

/// \throws ModelError  where there is no closed form.
CompiledModule exact_module(const PreparedScene& run) {
  const Specialisation& s = run.specialisation;
  std::vector<cln::cl_F> start;
  Recognised found = recognised(run, start);
  if (!found.form) throw ModelError("no closed form of the solution is known: " + found.reason);
  ModuleFunctions functions =
      uncompiled_module(s.rhs, s.invariants, {}, run.parameters).functions();
  functions.integrate = exact_integration(s.rhs, start, run.initial, found.form);
  return {.module = Module::from_functions(functions), .compiled = false};
}

}  // namespace

std::optional<double> closed_form_error(const PreparedScene& run,
                                        const std::vector<double>& sizes) {
  std::vector<cln::cl_F> start;
  const Recognised found = recognised(run, start);
  if (!found.form) return std::nullopt;
  const std::vector<double> reach = found.form->reach();
  double most = 1;
  for (std::size_t i = 0; i < reach.size(); ++i)
    if (sizes[i] > 0) most = std::max(most, reach[i] / sizes[i]);
  return most * found.form->error();
}

std::optional<double> closed_form_period(const PreparedScene& run) {
  std::vector<cln::cl_F> start;
  const Recognised found = recognised(run, start);
  if (!found.form) return std::nullopt;
  return found.form->period();
}

CompiledModule compile_for(const PreparedScene& run, const Method& method) {
  const auto start = Clock::now();
  CompiledModule result = method.name == "taylor" ? taylor_module(run, method)
                          : method.closed_form    ? exact_module(run)
                                                  : compiled_module(run, method);
  result.seconds = seconds_since(start);
  return result;
}

CompiledModule compile_always(const PreparedScene& run, const Method& method) {
  const auto start = Clock::now();
  CompiledModule result = compiled_module(run, method);
  result.seconds = seconds_since(start);
  return result;
}

bool suits(const PreparedScene& run, const Method& method) {
  std::vector<cln::cl_F> start;
  if (method.closed_form) return recognised(run, start).form != nullptr;
  if (method.quadratic_only) return is_quadratic(run);
  try {
    needs_of(run, method);
    return true;
  } catch (const ModelError&) {
    return false;
  }
}

std::function<bool()> time_limit(double seconds) {
  if (seconds <= 0) return {};
  const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                      std::chrono::duration<double>(seconds));
  return [end] { return Clock::now() > end; };
}

}  // namespace casimir
