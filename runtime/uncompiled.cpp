#include "runtime/uncompiled.hpp"

#include <algorithm>
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
  for (std::size_t i = 0; i < states; ++i) x[i] *= scale;
}

std::function<ModuleFunctions::Integration> table_driven(const QuadraticForm& form,
                                                         const std::vector<double>& parameters) {
  return [form, kernel = QuadraticKernel(form), parameters](const casimir_run* run, double* x,
                                                            casimir_outcome* out) {
    if (!std::equal(parameters.begin(), parameters.end(), run->parameters))
      throw std::invalid_argument("the tables were made for other values of the parameters");
    const double scale = ScaledRun::scale_for(x, static_cast<std::size_t>(form.states));
    if (scale != 1) return integrate_scaled(form, scale, *run, x, out);
    kernel.integrate(run, x, out);
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
  if (!form) module.watch_steps_of(rhs);
  return module;
}

}  // namespace casimir
