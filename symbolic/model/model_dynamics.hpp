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
  std::vector<GiNaC::ex> parts_of_bracket() const override { return model_.bracket_domain; }
  std::vector<GiNaC::ex> parts_of_flow() const override {
    std::vector<GiNaC::ex> parts = model_.bracket_domain;
    parts.insert(parts.end(), model_.domain.begin(), model_.domain.end());
    return parts;
  }

 private:
  const Model& model_;
};

}  // namespace casimir
