#pragma once

#include "symbolic/expression/expression.hpp"
#include "symbolic/model.hpp"

namespace casimir {

/// The bracket and the flow of a model, for the expressions that use them. Borrows the model.
class ModelDynamics : public Dynamics {
 public:
  explicit ModelDynamics(const Model& model) : model_(model) {}
  bool has_bracket() const override { return model_.poisson.has_value(); }
  bool has_flow() const override { return !model_.field.empty(); }
  GiNaC::ex bracket(const GiNaC::ex& f, const GiNaC::ex& g) const override {
    return model_.poisson->bracket(f, g);
  }
  GiNaC::ex rate(const GiNaC::ex& f) const override { return model_.rate(f); }
  std::size_t dimension() const override { return model_.variables.size(); }

 private:
  const Model& model_;
};

}  // namespace casimir
