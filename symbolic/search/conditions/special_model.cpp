#include "symbolic/search/conditions/special_model.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <set>

#include "symbolic/algebra/rational_matrix.hpp"
#include "symbolic/error.hpp"
#include "symbolic/expression/expression.hpp"
#include "symbolic/functions/function_ring.hpp"
#include "symbolic/proof/claims/claim_kinds.hpp"
#include "symbolic/proof/prover.hpp"

namespace casimir::search {
namespace {

using GiNaC::ex;

enum class Domain { inside, outside };

/// An assumption where a parameter has a value; kept where it still says something.
Domain put_assumptions(Model& model, const std::function<ex(const ex&)>& put) {
  std::vector<Assumption> kept;
  for (Assumption& a : model.assumptions) {
    a.difference = put(a.difference);
    if (!GiNaC::is_a<GiNaC::numeric>(a.difference.expand())) {
      kept.push_back(a);
    } else if (a.difference.expand().info(GiNaC::info_flags::rational) &&
               !a.holds_at({}, model.limits)) {
      return Domain::outside;
    }
  }
  model.assumptions = std::move(kept);
  return Domain::inside;
}

std::vector<GiNaC::symbol> symbols_in(const Model& model) {
  std::vector<GiNaC::symbol> symbols = model.symbols();
  if (model.time) symbols.push_back(*model.time);
  return symbols;
}

}  // namespace

std::optional<Model> with_value(const Model& model, const GiNaC::symbol& parameter,
                                const ex& value) {
  const GiNaC::exmap map{{parameter, value}};
  const auto put = [&](const ex& e) { return e.subs(map, GiNaC::subs_options::no_pattern); };
  Model result = model;
  std::erase_if(result.parameters, [&](const GiNaC::symbol& s) { return s.is_equal(parameter); });
  if (put_assumptions(result, put) == Domain::outside) return std::nullopt;
  if (result.hamiltonian) result.hamiltonian = put(*result.hamiltonian);
  for (ex& rate : result.field) rate = put(rate);
  for (auto* list : {&result.definitions, &result.casimirs, &result.integrals})
    for (NamedExpression& f : *list) f.value = put(f.value);
  if (result.poisson) {
    std::vector<ex> upper;
    for (std::size_t i = 0; i < result.poisson->dimension(); ++i)
      for (std::size_t j = i + 1; j < result.poisson->dimension(); ++j)
        upper.push_back(put((*result.poisson)(i, j)));
    result.poisson = PoissonStructure(result.poisson->coordinates(), upper);
  }
  for (const ClaimRow& row : claim_rows()) {
    const bool known = row.kind == ClaimKind::casimir || row.kind == ClaimKind::integral;
    if (row.clear && !known) row.clear(result);
  }
  result.scenes.clear();
  result.section.reset();
  result.fixed.emplace_back(Text{parameter.get_name(), {}, {}}, value);
  return result;
}

std::vector<Found> additional(const Model& model, const std::vector<Found>& found,
                              const std::vector<NamedExpression>& known) {
  constexpr std::size_t kMostTerms = 2000;
  if (found.empty() || known.empty()) return found;
  std::vector<ex> values{1};
  for (const NamedExpression& f : known) values.push_back(f.value);
  const std::size_t first = values.size();
  for (const Found& f : found) values.push_back(f.value);
  FunctionRing ring(symbols_in(model), model.assumptions, values, model.limits);
  std::vector<Polynomial> row;
  for (const ex& value : values) row.push_back(ring.convert(value));
  row = ring.common_numerators(std::move(row));
  std::map<std::vector<unsigned long>, std::size_t> places;
  for (const Polynomial& p : row)
    for (const auto& [number, exponents] : p.term_list()) places.emplace(exponents, places.size());
  if (places.size() > kMostTerms) return found;
  RationalMatrix matrix(places.size(), std::vector<cln::cl_RA>(values.size(), 0));
  for (std::size_t k = 0; k < row.size(); ++k)
    for (const auto& [number, exponents] : row[k].term_list())
      matrix[places.at(exponents)][k] = number;
  std::vector<Found> result;
  for (const std::size_t k : independent_columns(matrix))
    if (k >= first) result.push_back(found[k - first]);
  return result;
}

std::vector<std::size_t> free_places(const Model& model, const std::vector<Text>& free) {
  std::vector<std::size_t> places;
  for (const Text& name : free) {
    const std::size_t position =
        symbol_position(name, name.value, 0, model.parameters, "a parameter of this case");
    places.push_back(model.variables.size() + position);
  }
  if (std::set<std::size_t>(places.begin(), places.end()).size() < places.size())
    throw free.back().error("a parameter is named twice");
  return places;
}

bool is_meaningless(const Model& special) {
  try {
    Prover prover(special, {});
    prover.field();
    return false;
  } catch (const TooLarge&) {
    return false;
  } catch (const ModelError&) {
    return true;
  }
}

bool contradict(const Model& model) {
  const std::vector<Assumption>& all = model.assumptions;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Comparison own = all[i].comparison;
    std::vector<Assumption> others = all;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    const GiNaC::symbol c;
    std::vector<GiNaC::symbol> symbols = symbols_in(model);
    symbols.push_back(c);
    const bool strict = own == Comparison::greater || own == Comparison::less;
    const bool upwards = own == Comparison::greater || own == Comparison::at_least;
    const bool sided = strict || upwards || own == Comparison::at_most;
    if (sided) others.push_back({c, strict ? Comparison::greater : Comparison::at_least, ""});
    const ex d = all[i].difference;
    const ex difference = !sided ? d : upwards ? c - d : c + d;
    try {
      FunctionRing ring(symbols, others, {difference}, model.limits);
      const Polynomial p = ring.convert(difference);
      const bool never =
          own == Comparison::unequal ? ring.numerator(p).is_zero() : ring.is_nowhere_zero(p);
      if (never) return true;
    } catch (const ModelError&) {  // a division by what vanishes there, or too large
    }
  }
  return false;
}

}  // namespace casimir::search
