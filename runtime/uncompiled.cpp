#include "runtime/uncompiled.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "runtime/program/interpreted_series.hpp"
#include "runtime/program/interpreter.hpp"
#include "runtime/taylor/quadratic_targets.hpp"
#include "runtime/taylor/scaled_run.hpp"

namespace casimir {
namespace {

/// The function of a program in the form of a module's entry points.
std::function<ModuleFunctions::Evaluation> evaluation(const Program& program, std::size_t states,
                                                      std::size_t parameters) {
  return [run = Interpreter(program), states, parameters,
          inputs = std::vector<double>(states + parameters + 1)](
             double t, const double* x, const double* p, double* values) mutable {
    std::copy_n(x, states, inputs.begin());
    std::copy_n(p, parameters, inputs.begin() + static_cast<std::ptrdiff_t>(states));
    inputs.back() = t;
    run(inputs.data(), values);
  };
}

/// The equations of y with x = scale y.
QuadraticForm scaled(QuadraticForm form, double scale) {
  for (double& constant : form.constant) constant /= scale;
  for (double& constant : form.constant_rest) constant /= scale;
  for (QuadraticForm::Product& product : form.products) {
    for (double& factor : product.factor) factor *= scale;
    for (double& factor : product.rest) factor *= scale;
  }
  return form;
}

void integrate_scaled(const QuadraticForm& form, double scale, const casimir_run& asked, double* x,
                      casimir_outcome* out) {
  const std::size_t states = static_cast<std::size_t>(form.states);
  const ScaledRun run(asked, scale, states);
  for (std::size_t i = 0; i < states; ++i) x[i] /= scale;
  QuadraticKernel(scaled(form, scale)).integrate(&run.run(), x, out);
  run.finish(x, out);
}

/// Ends a run whose state has grown out of the unit in which it is followed: of numbers beyond
/// 1e150 there are no products. Shows all steps to whom they were to be shown, and looks at each
/// sixteenth itself: no step of a series makes a state e^10 times as large.
class Outgrowth {
 public:
  Outgrowth(const casimir_run& run, std::size_t states)
      : observe_(run.observe), observer_(run.observer), states_(states) {}

  /// Follows the run in this unit.
  void begin(casimir_run& run, double unit) {
    constexpr double kLarge = 0x1p250;
    most_ = kLarge * unit;
    outgrown_ = false;
    run.observe = &see;
    run.observer = this;
  }
  bool outgrown() const { return outgrown_; }

 private:
  static int see(void* self, const casimir_step* step) {
    Outgrowth& own = *static_cast<Outgrowth*>(self);
    constexpr unsigned kSeldom = 16;
    if (++own.steps_ % kSeldom != 0) return own.observe_(own.observer_, step);
    double size = 0;
    for (std::size_t i = 0; i < own.states_; ++i) size = std::max(size, std::abs(step->x1[i]));
    const int stop = own.observe_(own.observer_, step);
    own.outgrown_ = size > own.most_ && stop == 0;
    return own.outgrown_ ? 1 : stop;
  }

  int (*const observe_)(void*, const casimir_step*);
  void* const observer_;
  const std::size_t states_;
  double most_ = 0;
  unsigned steps_ = 0;
  bool outgrown_ = false;
};

/// The power of two next below the largest state.
double unit_of(const double* x, std::size_t states) {
  double size = 0;
  for (std::size_t i = 0; i < states; ++i) size = std::max(size, std::abs(x[i]));
  return std::ldexp(1.0, std::ilogb(size));
}

std::function<ModuleFunctions::Integration> table_driven(const QuadraticForm& form,
                                                         const std::vector<double>& parameters) {
  return [form, kernel = QuadraticKernel(form), parameters](const casimir_run* run, double* x,
                                                            casimir_outcome* out) {
    if (!std::equal(parameters.begin(), parameters.end(), run->parameters))
      throw std::invalid_argument("the tables were made for other values of the parameters");
    const auto states = static_cast<std::size_t>(form.states);
    casimir_run rest = *run;
    Outgrowth growth(*run, states);
    casimir_outcome before = {};
    for (bool on = true; on;) {
      const double scale = growth.outgrown() ? unit_of(x, states) : ScaledRun::scale_for(x, states);
      if (run->observe && !(run->fixed_step > 0)) growth.begin(rest, scale);
      if (scale != 1)
        integrate_scaled(form, scale, rest, x, out);
      else
        kernel.integrate(&rest, x, out);
      out->steps += before.steps;
      out->rejected += before.rejected;
      out->evaluations += before.evaluations;
      on = growth.outgrown() && out->status == CASIMIR_STOPPED;
      before = *out;
      rest.t_begin = out->t;
    }
  };
}

}  // namespace

Module uncompiled_module(const Program& rhs, const Program& invariants,
                         const std::optional<QuadraticForm>& form,
                         const std::vector<double>& parameters) {
  const std::size_t states = rhs.outputs.size();
  ModuleFunctions functions;
  functions.dimension = static_cast<int>(states);
  functions.parameter_count = static_cast<int>(parameters.size());
  functions.invariant_count = static_cast<int>(invariants.outputs.size());
  functions.rhs = evaluation(rhs, states, parameters.size());
  functions.invariants = evaluation(invariants, states, parameters.size());
  functions.integrate =
      form ? table_driven(*form, parameters) : interpreted(rhs, parameters.size());
  Module module = Module::from_functions(functions);
  if (!form) module.know_equations(rhs);
  return module;
}

}  // namespace casimir
