#include "tools/scene_run.hpp"

#include <cln/float_io.h>
#include <cln/real.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "codegen/compile.hpp"
#include "codegen/emit_cpp.hpp"
#include "codegen/literal.hpp"
#include "codegen/quadratic.hpp"
#include "runtime/evaluate.hpp"
#include "runtime/methods.hpp"
#include "runtime/quadratic_targets.hpp"
#include "runtime/term_size.hpp"
#include "runtime/uncompiled.hpp"

namespace casimir::tools {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Digits to which constants such as sqrt(2)/2 are evaluated before they are rounded to double.
constexpr int kConstantDigits = 60;

std::vector<cln::cl_F> evaluate_start(const Specialisation& specialisation, int digits) {
  return evaluate(specialisation.start, {}, Arithmetic<cln::cl_F>(digits));
}

/// What is left of a value when its nearest double is taken away.
double remainder(const cln::cl_F& value, double nearest) {
  return cln::double_approx(value - cln::cl_float(cln::cl_DF(nearest), value));
}

double rounded(const cln::cl_F& value) { return codegen::nearest<double>(cln::rational(value)); }

}  // namespace

SceneRun prepare(const Model& model, const Scene& scene, const SceneOptions& options) {
  const auto start = Clock::now();
  SpecialiseOptions what;
  what.fold_parameters = options.fold_parameters;
  what.observe = options.observe;
  SceneRun run;
  run.specialisation = specialise(model, scene, what);
  const Specialisation& s = run.specialisation;
  const std::vector<cln::cl_F> values = evaluate_start(s, kConstantDigits);
  std::size_t next = 0;
  for (std::size_t i = 0; i < s.states.size(); ++i, ++next) {
    run.initial.push_back(rounded(values[next]));
    run.rounding.push_back(remainder(values[next], run.initial.back()));
  }
  for (std::size_t i = 0; i < s.parameters.size(); ++i)
    run.parameters.push_back(rounded(values[next++]));
  run.duration = rounded(values[next]);
  run.generate_seconds = seconds_since(start);
  return run;
}

std::function<void(double, const double*, double*)> SceneRun::invariant_sizes() const {
  return [this](double t, const double* x, double* sizes) {
    std::vector<SizedNumber> inputs;
    for (std::size_t i = 0; i < initial.size(); ++i)
      inputs.push_back(Arithmetic<SizedNumber>::plain(x[i]));
    for (const double p : parameters) inputs.push_back(Arithmetic<SizedNumber>::plain(p));
    inputs.push_back(Arithmetic<SizedNumber>::plain(t));
    const std::vector<SizedNumber> values = evaluate(specialisation.invariants, inputs);
    for (std::size_t i = 0; i < values.size(); ++i) sizes[i] = std::abs(values[i].size);
  };
}

namespace {

/// A module from the compiler.
/// \throws CompilerMissing  without one; the text names the method that does not need it.
CompiledModule compiled_module(const Specialisation& s, const Method& method) {
  // A library that only calls the right-hand side has no kernel: one module serves them all.
  const std::string kernel = method.header.empty() ? std::string{} : kernel_source(method);
  CompileOptions options;
  options.standard_library = !method.outside.empty() && !kernel.empty();
  const std::string text = emit_module(s, kernel, method.series);
  try {
    const CompiledObject object = compile(text, options);
    return {.module = Module::load(object.path), .from_cache = object.from_cache};
  } catch (const CompilerMissing& problem) {
    throw CompilerMissing(std::string(problem.what()) +
                          ", or use --method taylor, which needs none");
  }
}

/// For the method of Taylor series: the tables where the system has that shape, else the compiler,
/// and without one the program itself.
CompiledModule taylor_module(const SceneRun& run, const Method& method) {
  const Specialisation& s = run.specialisation;
  auto form = quadratic_form(s.rhs, run.parameters);
  if (form && !has_quadratic_kernel(*form)) form.reset();
  if (!form) {
    try {
      return compiled_module(s, method);
    } catch (const CompilerMissing&) {
    }
  }
  CompiledModule result{.module = uncompiled_module(s.rhs, s.invariants, form, run.parameters),
                        .compiled = false};
  if (!form)
    result.warning =
        "there is no C++ compiler: the equations are interpreted, which is several times slower; "
        "install one, for instance with: apt-get install g++";
  return result;
}

}  // namespace

CompiledModule compile_for(const SceneRun& run, const Method& method) {
  const auto start = Clock::now();
  CompiledModule result = method.name == "taylor" ? taylor_module(run, method)
                                                  : compiled_module(run.specialisation, method);
  result.seconds = seconds_since(start);
  return result;
}

TruthOrReason truth_of(const Scene& scene, const SceneRun& run, int digits,
                       const std::function<bool()>& give_up) {
  const Specialisation& s = run.specialisation;
  TruthOrReason result;
  std::vector<cln::cl_F> state;
  const bool at_its_time = rounded(evaluate_start(s, kConstantDigits).back()) == run.duration;
  const bool in_file = at_its_time && !scene.reference.empty() &&
                       std::all_of(s.state_indices.begin(), s.state_indices.end(), [&](int i) {
                         return scene.reference[static_cast<std::size_t>(i)].has_value();
                       });
  if (in_file) {
    const Arithmetic<cln::cl_F> arithmetic(kConstantDigits);
    for (const int i : s.state_indices) {
      const GiNaC::ex value = *scene.reference[static_cast<std::size_t>(i)];
      if (!GiNaC::is_a<GiNaC::numeric>(value))
        throw ModelError("a reference state must be given by numbers");
      state.push_back(
          arithmetic.from(cln::the<cln::cl_R>(GiNaC::ex_to<GiNaC::numeric>(value).to_cl_N())));
    }
    result.source = "the case file";
  } else {
    const std::vector<cln::cl_F> values = evaluate_start(s, digits + kConstantDigits);
    const auto n = static_cast<std::ptrdiff_t>(s.states.size());
    const std::vector<cln::cl_R> initial(values.begin(), values.begin() + n);
    const std::vector<cln::cl_R> parameters(values.begin() + n, values.end() - 1);
    // A duration from the command line is the double that the integrators get.
    const bool own = rounded(values.back()) == run.duration;
    const cln::cl_R duration =
        own ? cln::cl_R(values.back()) : cln::cl_R(cln::rational(cln::cl_DF(run.duration)));
    const Reference reference =
        reference_solution(s.rhs, initial, duration, digits, parameters, give_up);
    if (!reference.reached) {
      result.reason = fmt::format("there is no reference state: {} (t = {:.6g})", reference.reason,
                                  cln::double_approx(reference.time));
      return result;
    }
    constexpr double kGood = 1e-18;
    if (reference.error_bound > kGood) {
      result.reason = fmt::format(
          "two multiprecision runs differ by {:.1e}: more digits are needed for a reference",
          reference.error_bound);
      return result;
    }
    state = reference.state;
    result.source = fmt::format("our own Taylor series with {} digits, checked to {:.0e}",
                                reference.digits, reference.error_bound);
  }
  Truth truth;
  for (const cln::cl_F& x : state) {
    truth.state.push_back(rounded(x));
    truth.rest.push_back(remainder(x, truth.state.back()));
  }
  truth.scale = state_sizes(run);
  result.truth = std::move(truth);
  return result;
}

std::vector<double> state_sizes(const SceneRun& run) {
  const Method& method = *find_method("taylor");
  Settings settings;
  settings.duration = run.duration;
  settings.rtol = 1e-8;
  settings.atol =
      1e-8 * *std::max_element(run.initial.begin(), run.initial.end(),
                               [](double a, double b) { return std::abs(a) < std::abs(b); });
  settings.atol = std::max(std::abs(settings.atol), 1e-300);
  settings.sample_every = std::abs(run.duration) / 200;
  settings.monitor = false;
  const Trajectory trajectory =
      integrate(compile_for(run, method).module, method, settings, run.initial, run.parameters);
  std::vector<double> sizes(run.initial.size());
  for (std::size_t i = 0; i < sizes.size(); ++i) sizes[i] = std::abs(run.initial[i]);
  for (const std::vector<double>& x : trajectory.samples) {
    for (std::size_t i = 0; i < sizes.size(); ++i) sizes[i] = std::max(sizes[i], std::abs(x[i]));
  }
  const double largest = *std::max_element(sizes.begin(), sizes.end());
  for (double& size : sizes) size = largest == 0 ? 1 : std::max(size, 1e-6 * largest);
  return sizes;
}

std::function<bool()> time_limit(double seconds) {
  if (seconds <= 0) return {};
  const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                      std::chrono::duration<double>(seconds));
  return [end] { return Clock::now() > end; };
}

}  // namespace casimir::tools
