// Products of known functions: what a search does not find again.
#include <algorithm>
#include <numeric>

#include "symbolic/search/integral_space.hpp"

namespace casimir::search {

int fibre_degree(const std::uint8_t* exponents, const std::vector<bool>& fibre) {
  int sum = 0;
  for (std::size_t i = 0; i < fibre.size(); ++i) sum += fibre[i] ? exponents[i] : 0;
  return sum;
}

namespace {

/// Keeps the products within the limits of a problem.
void remove_beyond(std::vector<std::vector<int>>& products,
                   const std::vector<Generator>& generators, const Problem& problem) {
  for (const DegreeLimit& limit : problem.limits) {
    std::vector<int> own;
    for (const Generator& g : generators)
      own.push_back(limit.of(g.function, problem.fields.places));
    std::erase_if(products, [&](const std::vector<int>& exponents) {
      return std::inner_product(own.begin(), own.end(), exponents.begin(), 0) > limit.degree;
    });
  }
}

/// Whether a function is among those that are searched.
bool is_within(const System& system, const Problem& problem, const Polynomial& p) {
  if (!system.in_atoms(p)) return false;
  for (const std::size_t place : problem.fields.places)
    if (system.is_silent()[place] && p.uses(place)) return false;
  if (weighted_degree(p, problem.fields.places, problem.weights) > problem.degree) return false;
  return std::ranges::all_of(problem.limits, [&](const DegreeLimit& limit) {
    return limit.of(p, problem.fields.places) <= limit.degree;
  });
}

}  // namespace

std::vector<std::vector<int>> known_products(const std::vector<Generator>& generators,
                                             const Problem& problem, int degree, std::size_t old) {
  std::vector<int> degrees;
  for (const Generator& g : generators) degrees.push_back(g.degree);
  if (problem.fibre.empty()) {
    std::vector<std::vector<int>> products = products_up_to(degrees, degree, old);
    remove_beyond(products, generators, problem);
    return products;
  }
  // One tensor, times a product of functions.
  std::vector<bool> is_tensor;
  for (const Generator& g : generators) {
    bool linear = false;
    for (std::size_t i = 0; i < problem.fibre.size(); ++i)
      linear = linear || (problem.fibre[i] && g.function.uses(problem.fields.places[i]));
    is_tensor.push_back(linear);
  }
  std::vector<int> of_functions;
  std::vector<std::size_t> functions;
  for (std::size_t g = 0; g < generators.size(); ++g) {
    if (is_tensor[g]) continue;
    functions.push_back(g);
    of_functions.push_back(degrees[g]);
  }
  std::vector<std::vector<int>> result;
  for (std::size_t t = 0; t < generators.size(); ++t) {
    if (!is_tensor[t] || degrees[t] > degree) continue;
    for (const std::vector<int>& factors : products_up_to(of_functions, degree - degrees[t], 0)) {
      std::vector<int> exponents(generators.size(), 0);
      exponents[t] = 1;
      for (std::size_t f = 0; f < functions.size(); ++f) exponents[functions[f]] = factors[f];
      const bool is_new = std::any_of(exponents.begin() + static_cast<std::ptrdiff_t>(old),
                                      exponents.end(), [](int e) { return e != 0; });
      if (is_new) result.push_back(std::move(exponents));
    }
  }
  return result;
}

std::vector<std::vector<int>> lowered_products(const System& system,
                                               const std::vector<Generator>& generators,
                                               const Problem& problem, std::size_t old) {
  constexpr std::size_t kMostProducts = 300, kMostTerms = 1000;
  if (system.relations().empty()) return {};
  Problem wider = problem;
  wider.limits.clear();
  std::vector<std::vector<int>> result;
  std::size_t tried = 0;
  for (const std::vector<int>& exponents :
       known_products(generators, wider, 2 * problem.degree, old)) {
    if (tried++ == kMostProducts) break;
    Polynomial product = system.ring().constant(1);
    for (std::size_t g = 0; g < exponents.size() && product.terms() <= kMostTerms; ++g) {
      for (int k = 0; k < exponents[g] && product.terms() <= kMostTerms; ++k)
        product = system.functions().reduced(product * generators[g].function);
    }
    if (product.terms() <= kMostTerms && is_within(system, problem, product))
      result.push_back(exponents);
  }
  return result;
}

}  // namespace casimir::search
