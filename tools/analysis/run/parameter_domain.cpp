#include "tools/analysis/run/parameter_domain.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "symbolic/algebra/number_text.hpp"
#include "symbolic/expression/expression_size.hpp"

namespace casimir {
namespace {

using GiNaC::ex;

class ParameterDomain {
 public:
  ParameterDomain(const Model& model, const GiNaC::exmap& folded)
      : model_(model), folded_(folded) {}

  std::vector<Assumption> conditions() && {
    std::vector<ex> written = model_.domain;
    written.insert(written.end(), model_.bracket_domain.begin(), model_.bracket_domain.end());
    written.insert(written.end(), model_.field.begin(), model_.field.end());
    if (model_.hamiltonian) written.push_back(*model_.hamiltonian);
    if (model_.poisson) {
      const std::size_t n = model_.variables.size();
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < i; ++j) written.push_back((*model_.poisson)(i, j));
      if (model_.hamiltonian)
        for (const ex& rate : model_.poisson->flow(*model_.hamiltonian)) written.push_back(rate);
    }
    for (ex expression : written) {
      if (!folded_.empty()) expression = substituted(expression, folded_, model_.limits);
      for (auto part = expression.preorder_begin(); part != expression.preorder_end(); ++part)
        look(*part);
    }
    return std::move(conditions_);
  }

 private:
  void look(const ex& part) {
    if (GiNaC::is_a<GiNaC::power>(part)) {
      const ex &base = part.op(0), &exponent = part.op(1);
      if (exponent.info(GiNaC::info_flags::negative)) add_factors(base);
      if (!exponent.info(GiNaC::info_flags::integer)) add(base, Comparison::at_least);
    } else if (GiNaC::is_a<GiNaC::function>(part)) {
      const std::string name = GiNaC::ex_to<GiNaC::function>(part).get_name();
      if (name == "log") add(part.op(0), Comparison::greater);
      if (name == "asin" || name == "acos")
        add(1 - GiNaC::pow(part.op(0), 2), Comparison::at_least);
    }
  }

  /// What is divided by vanishes wherever a factor of it does.
  void add_factors(const ex& product) {
    if (GiNaC::is_a<GiNaC::mul>(product))
      for (const ex& factor : product) add_factors(factor);
    else if (GiNaC::is_a<GiNaC::power>(product))
      add_factors(product.op(0));
    else
      add(product, Comparison::unequal);
  }

  void add(const ex& part, Comparison comparison) {
    const auto has = [&](const std::vector<GiNaC::symbol>& symbols) {
      return std::ranges::any_of(symbols, [&](const GiNaC::symbol& s) { return part.has(s); });
    };
    if (!has(model_.parameters) || has(model_.variables) || (model_.time && part.has(*model_.time)))
      return;
    const bool known = std::ranges::any_of(conditions_, [&](const Assumption& one) {
      return one.comparison == comparison && one.difference.is_equal(part);
    });
    if (!known)
      conditions_.push_back(
          {part, comparison, fmt::format("{} {} 0", expression_text(part), to_string(comparison))});
  }

  const Model& model_;
  const GiNaC::exmap& folded_;
  std::vector<Assumption> conditions_;
};

}  // namespace

std::vector<Assumption> implied_by_parameters(const Model& model, const GiNaC::exmap& folded) {
  return ParameterDomain(model, folded).conditions();
}

}  // namespace casimir
