#include "symbolic/structure/tensor_space.hpp"

#include <fmt/format.h>

#include "symbolic/search/finder.hpp"
#include "symbolic/search/independence.hpp"
#include "symbolic/search/modular/span.hpp"

namespace casimir::structure {

using search::Generator;
using search::Problem;
using search::Watch;

TensorSpace::TensorSpace(const Model& model, TensorType type)
    : lift_(model, type), system_(lift_.model(), {}, {}) {
  for (const std::size_t atom : system_.atoms())
    fibre_.push_back(atom >= lift_.dimension() && atom < lift_.model().variables.size());
}

Problem TensorSpace::problem(int degree) const {
  Problem result;
  result.fields = {system_.atoms(), {system_.flow()}, {system_.plain_flow()}};
  result.weights.assign(system_.atoms().size(), 1);
  result.degree = degree + 1;  // with the component's variable
  result.known = known_;
  result.fibre = fibre_;
  return result;
}

/// A known function need not be made of what the equations of motion need, as the bracket of
/// {x, y} = 1/y is not: nothing new is converted in the ring of the system, whose variables have
/// been counted. Common factors cancel in a ring of its own. Of a denominator that is no integral
/// the numerator may be invariant although the function is not: that would be another tensor.
std::optional<TensorSpace::Numerator> TensorSpace::numerator_of(const GiNaC::ex& function) {
  Prover own(lift_.model(), {function});
  const FunctionRing& ring = own.ring();
  const auto [top, bottom] = ring.lowest_terms(own.convert(function));
  if (!own.is_zero(own.rate(bottom))) return std::nullopt;
  const FunctionRing& common = system_.functions();
  for (std::size_t g = ring.symbols().size(); g < ring.end_of_generators(); ++g) {
    if (!top.uses(g)) continue;
    const GiNaC::ex value = ring.variable_value(g);
    bool known = false;
    for (std::size_t k = common.symbols().size(); !known && k < common.end_of_generators(); ++k)
      known = common.variable_value(k).is_equal(value);
    if (!known) return std::nullopt;
  }
  Polynomial p = common.reduced(system_.prover().convert(ring.expression(top)));
  if (!system_.in_atoms(p)) return std::nullopt;
  return Numerator{std::move(p), ring.depends_on_first(bottom, lift_.model().variables.size())};
}

bool TensorSpace::add(const GiNaC::ex& function) {
  const std::optional<Numerator> numerator = numerator_of(function);
  if (!numerator) return false;
  const Polynomial& p = numerator->function;
  const std::vector<int> weights(system_.atoms().size(), 1);
  const int degree = search::weighted_degree(p, system_.atoms(), weights);
  // A bracket without the Jacobi identity is kept by no Hamiltonian flow.
  if (degree == 0 || !system_.prover().is_zero(system_.prover().rate(p))) return false;
  known_.push_back({p, degree});
  return true;
}

bool TensorSpace::add_integral(const GiNaC::ex& integral) { return add(integral); }

bool TensorSpace::add_tensor(const std::vector<GiNaC::ex>& components) {
  return add(lift_.function(components));
}

std::optional<std::vector<Polynomial>> TensorSpace::polynomials(
    const std::vector<GiNaC::ex>& tensor) {
  const std::optional<Numerator> numerator = numerator_of(lift_.function(tensor));
  if (!numerator || numerator->is_divided) return std::nullopt;
  return components(numerator->function);
}

void TensorSpace::search_up_to(int degree, const Watch& watch) {
  for (int d = static_cast<int>(dimensions_.size()); d <= degree; ++d) {
    watch.begin(fmt::format("{} of degree {}", name_of(lift_.type()), d));
    const search::Solution solution = search::solve(system_, problem(d), watch);
    for (const Generator& g : solution.found) {
      known_.push_back(g);
      found_.push_back(g);
    }
    dimensions_.push_back(solution.trivial + solution.found_dimension);
    if (!solution.complete && complete_) {
      complete_ = false;
      reason_ = solution.reason;
    }
  }
  if (!complete_) return;
  std::optional<std::string> doubt = search::unknown_relations(system_);
  if (!doubt) doubt = search::thin_domain(system_);
  if (!doubt) return;
  complete_ = false;
  reason_ = *doubt;
}

std::vector<Polynomial> TensorSpace::basis(int degree) {
  const Problem own = problem(degree);
  const search::Modulus modulus = search::usable_modulus(system_);
  std::mt19937_64 random(23);
  const std::vector<std::vector<int>> products =
      search::known_products(own.known, own, degree + 1, 0);
  const std::optional<search::Point> constants = system_.random_point(modulus, random);
  std::vector<search::Point> points;
  while (constants && points.size() < products.size() + 4) {
    std::optional<search::Point> point = system_.random_point(modulus, random, &*constants);
    if (!point) break;
    points.push_back(std::move(*point));
  }
  search::Span span(modulus);
  std::vector<Polynomial> result;
  for (const std::vector<int>& exponents : products) {
    Polynomial product = system_.ring().constant(1);
    for (std::size_t g = 0; g < exponents.size(); ++g) {
      if (exponents[g] > 0)
        product = product * own.known[g].function.pow(static_cast<unsigned long>(exponents[g]));
    }
    std::vector<search::Residue> values;
    for (const search::Point& point : points)
      values.push_back(search::value_at(product, point, modulus).value_or(0));
    if (span.insert(std::move(values))) result.push_back(std::move(product));
  }
  return result;
}

std::vector<Polynomial> TensorSpace::components(const Polynomial& tensor) const {
  std::vector<Polynomial> result;
  for (std::size_t c = 0; c < lift_.indices().size(); ++c)
    result.push_back(tensor.derivative(lift_.dimension() + c));
  return result;
}

std::vector<GiNaC::ex> TensorSpace::expressions(const Polynomial& tensor) const {
  std::vector<GiNaC::ex> result;
  for (const Polynomial& component : components(tensor))
    result.push_back(system_.expression(component));
  return result;
}

int TensorSpace::degree_of(const Polynomial& tensor) const {
  return search::weighted_degree(tensor, system_.atoms(),
                                 std::vector<int>(system_.atoms().size(), 1)) -
         1;
}

}  // namespace casimir::structure
