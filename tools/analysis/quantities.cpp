#include "tools/analysis/quantities.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "codegen/optimise/lower.hpp"
#include "codegen/optimise/terms.hpp"
#include "runtime/evaluate.hpp"
#include "tools/analysis/error.hpp"

namespace casimir {

Quantities::Quantities(const Model& model, const Scene& scene,
                       const std::vector<GiNaC::ex>& functions,
                       const std::vector<std::string>& states) {
  std::vector<GiNaC::symbol> symbols = model.variables;
  if (model.time) symbols.push_back(*model.time);
  inputs_ = symbols.size();
  std::vector<std::string> names, labels;
  for (const GiNaC::symbol& symbol : symbols) names.push_back(symbol.get_name());
  for (const std::string& state : states)
    places_.push_back(
        static_cast<std::size_t>(std::find(names.begin(), names.end(), state) - names.begin()));
  codegen::Dag dag(symbols, model.variables.size());
  std::vector<codegen::Scaled> outputs;
  for (const GiNaC::ex& function : functions) {
    const GiNaC::ex bound = model.at_parameters(function, scene);
    for (std::size_t i = 0; i < model.variables.size(); ++i) {
      if (bound.has(model.variables[i]) &&
          std::find(places_.begin(), places_.end(), i) == places_.end())
        throw RequestError(
            fmt::format("{} is left out of this run, which observes other variables", names[i]));
    }
    outputs.push_back(dag.convert(bound));
    labels.push_back(fmt::format("f{}", labels.size()));
  }
  program_ = codegen::lowered(codegen::system_of(dag, symbols.size(), outputs), names, labels);
}

std::vector<double> Quantities::operator()(double t, const std::vector<double>& state) const {
  std::vector<double> inputs(inputs_, 0.0);
  if (!inputs.empty()) inputs.back() = t;  // the time is the last, where there is one
  for (std::size_t i = 0; i < places_.size(); ++i) inputs[places_[i]] = state[i];
  try {
    return evaluate(program_, inputs);
  } catch (const std::domain_error&) {
    return std::vector<double>(program_.outputs.size(), std::numeric_limits<double>::quiet_NaN());
  }
}

}  // namespace casimir
