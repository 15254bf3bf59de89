#include "symbolic/search/conditions/special_model.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <set>
#include <stdexcept>

#include "symbolic/algebra/rational_matrix.hpp"
#include "symbolic/error.hpp"
#include "symbolic/expression/expression.hpp"
#include "symbolic/expression/principal_values.hpp"
#include "symbolic/functions/function_ring.hpp"
#include "symbolic/proof/claims/claim_kinds.hpp"
#include "symbolic/proof/prover.hpp"

namespace casimir::search {
namespace {

using GiNaC::ex;

using Put = std::function<ex(const ex&)>;

/// What `compute` gives, or nothing where there is no value: GiNaC divides by zero or meets a pole
/// on the way, or a root is not real. All else that it may throw says nothing of values, and
/// passes.
template <class Compute>
auto where_it_has_value(const Compute& compute) -> std::optional<decltype(compute())> {
  try {
    return compute();
  } catch (const GiNaC::pole_error&) {
    return std::nullopt;
  } catch (const std::overflow_error&) {  // GiNaC's division of numbers by zero
    return std::nullopt;
  } catch (const NoValue&) {
    return std::nullopt;
  }
}

enum class Domain { inside, outside };

/// An assumption where a parameter has a value; kept where it still says something. It does not
/// hold where its difference has no value.
Domain put_assumptions(Model& model, const Put& put) {
  std::vector<Assumption> kept;
  for (Assumption& a : model.assumptions) {
    const std::optional<ex> difference = where_it_has_value([&] { return put(a.difference); });
    if (!difference) return Domain::outside;
    a.difference = *difference;
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

/// Whether some part of it is a constant that is not real, as sqrt(a)*sqrt(a) has at a = -2
/// although GiNaC makes -2 of the whole.
bool has_complex_constant(const ex& value) {
  for (auto part = value.preorder_begin(); part != value.preorder_end(); ++part)
    if (is_complex_constant(*part)) return true;
  return false;
}

void put_list(std::vector<ex>& list, const Put& put) {
  for (ex& own : list) own = put(own);
}

/// The value in all that the motion is made of, also in what GiNaC no longer shows of it.
void put_motion(Model& model, const Put& put) {
  put_list(model.domain, put);
  put_list(model.bracket_domain, put);
  if (model.hamiltonian) model.hamiltonian = put(*model.hamiltonian);
  if (model.poisson) {
    std::vector<ex> upper;
    for (std::size_t i = 0; i < model.poisson->dimension(); ++i)
      for (std::size_t j = i + 1; j < model.poisson->dimension(); ++j)
        upper.push_back(put((*model.poisson)(i, j)));
    model.poisson = PoissonStructure(model.poisson->coordinates(), upper);
  }
  // Derived anew: the derivative for all values may have a pole that this one has not.
  if (model.poisson && model.hamiltonian)
    model.field = model.poisson->flow(*model.hamiltonian);
  else
    put_list(model.field, put);
}

/// The same of named functions. Those that have no value then are none of the special case.
void put_functions(std::vector<NamedExpression>& list, const Put& put) {
  std::vector<NamedExpression> kept;
  for (NamedExpression& f : list) {
    const auto done = where_it_has_value([&] {
      f.value = put(f.value);
      put_list(f.domain, put);
      return true;
    });
    if (done) kept.push_back(std::move(f));
  }
  list = std::move(kept);
}

/// The same of the constraints. Where one has no value there is no point of the phase space; that
/// says nothing of the equations, which have integrals all the same.
void put_constraints(std::vector<NamedExpression>& constraints, const Put& put) {
  const std::size_t count = constraints.size();
  put_functions(constraints, put);
  if (constraints.size() < count) throw ModelError("a constraint has no value there");
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
  const Put put = [&](const ex& e) {
    ex result = e.subs(map, GiNaC::subs_options::no_pattern);
    if (!model.complex_numbers && has_complex_constant(result))
      throw NoValue("an expression has no real value");
    return result;
  };
  Model result = model;
  std::erase_if(result.parameters, [&](const GiNaC::symbol& s) { return s.is_equal(parameter); });
  if (put_assumptions(result, put) == Domain::outside) return std::nullopt;
  const auto has_motion = where_it_has_value([&] {
    put_motion(result, put);
    return true;
  });
  if (!has_motion) return std::nullopt;
  for (auto* list : {&result.definitions, &result.casimirs, &result.integrals})
    put_functions(*list, put);
  put_constraints(result.constraints, put);
  for (const ClaimRow& row : claim_rows()) {
    const bool known = row.kind == ClaimKind::casimir || row.kind == ClaimKind::integral;
    if (row.clear && !known) row.clear(result);
  }
  result.frame.reset();  // it has made its bracket
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
  Model motion = special;
  motion.constraints.clear();
  try {
    Prover prover(motion, {});
    prover.field();
    return false;
  } catch (const NoValue&) {
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
