#include "symbolic/search/darboux_equations.hpp"

#include <algorithm>
#include <map>
#include <numeric>

#include "symbolic/error.hpp"
#include "symbolic/search/newton_faces.hpp"

namespace casimir::search {
namespace {

using Exponents = std::vector<unsigned long>;

int field_growth(const System& system) {
  long degree = 1;
  for (const Polynomial& rate : system.flow()) {
    for (const auto& [number, exponents] : rate.term_list()) {
      long own = 0;
      for (const std::size_t atom : system.atoms()) own += static_cast<long>(exponents[atom]);
      degree = std::max(degree, own);
    }
  }
  return static_cast<int>(degree - 1);
}

/// Those that a cofactor may have: see `NewtonFaces`.
Monomials monomials_of_cofactors(const System& system, std::size_t dimension) {
  const NewtonFaces faces(system.flow(), dimension);
  const Monomials all = all_monomials(std::vector<int>(dimension, 1), field_growth(system));
  Monomials result(dimension);
  for (std::size_t i = 0; i < all.size(); ++i)
    if (faces.allows({all[i], all[i] + dimension}))
      result.add({all[i], all[i] + dimension}, all.degree(i));
  return result;
}

std::size_t room_for(const System& system, const Monomials& a, const Monomials& b) {
  return system.ring().size() + a.size() + b.size();
}

}  // namespace

DarbouxEquations::DarbouxEquations(const Model& model, int degree)
    : system_(model, {}, {}),
      dimension_(model.variables.size()),
      monomials_(all_monomials(std::vector<int>(dimension_, 1), degree)),
      cofactor_monomials_(monomials_of_cofactors(system_, dimension_)),
      first_f_(system_.ring().size()),
      first_k_(first_f_ + monomials_.size()),
      ring_(room_for(system_, monomials_, cofactor_monomials_)) {
  if (model.time)
    throw ModelError("Darboux polynomials need equations of motion that do not depend on the time");
  if (system_.atoms().size() > dimension_)
    throw ModelError(
        "Darboux polynomials need equations of motion that are rational in the variables");
  for (const Polynomial& rate : system_.flow()) field_.push_back(in_ring(rate, ring_));
  find_grading(model);
}

void DarbouxEquations::find_grading(const Model& model) {
  std::vector<std::string> names;
  for (const GiNaC::symbol& s : model.variables) names.push_back(s.get_name());
  weights_ = find_weights(field_, names);
  for (std::size_t i = 0; weights_ && i < dimension_; ++i) {
    for (const auto& [number, exponents] : field_[i].term_list()) {
      if (excess(*weights_, i, exponents) == 0) continue;
      weights_.reset();
      break;
    }
  }
}

int DarbouxEquations::weight(const Monomials& list, std::size_t i) const {
  int sum = 0;
  for (std::size_t v = 0; v < dimension_; ++v) sum += weights_->numerators[v] * list[i][v];
  return sum;
}

std::optional<Polynomial> DarbouxEquations::in_system_ring(const Polynomial& p) const {
  TermCollector collector(system_.ring());
  for (auto [number, exponents] : p.term_list()) {
    if (std::any_of(exponents.begin() + static_cast<std::ptrdiff_t>(first_f_), exponents.end(),
                    [](unsigned long e) { return e != 0; }))
      return std::nullopt;
    exponents.resize(first_f_);
    collector.add(number, exponents);
  }
  return collector.finish();
}

Polynomial DarbouxEquations::monomial(const Monomials& list, std::size_t i) const {
  Polynomial result = ring_.constant(1);
  for (std::size_t v = 0; v < dimension_; ++v) result = result * ring_.variable(v).pow(list[i][v]);
  return result;
}

/// Those of the monomials in the coordinates.
std::vector<Polynomial> DarbouxEquations::coefficients(const Polynomial& p) const {
  std::map<Exponents, std::vector<std::pair<cln::cl_RA, Exponents>>> parts;
  for (auto [number, exponents] : p.term_list()) {
    const Exponents own(exponents.begin(),
                        exponents.begin() + static_cast<std::ptrdiff_t>(dimension_));
    std::fill(exponents.begin(), exponents.begin() + static_cast<std::ptrdiff_t>(dimension_), 0);
    parts[own].emplace_back(number, exponents);
  }
  std::vector<Polynomial> result;
  for (const auto& [own, terms] : parts) {
    TermCollector collector(ring_);
    for (const auto& [number, exponents] : terms) collector.add(number, exponents);
    result.push_back(collector.finish());
  }
  return result;
}

int DarbouxEquations::degree_in_coordinates(const Polynomial& p) const {
  unsigned long degree = 0;
  for (const auto& [number, exponents] : p.term_list()) {
    const auto end = exponents.begin() + static_cast<std::ptrdiff_t>(dimension_);
    degree = std::max(degree, std::accumulate(exponents.begin(), end, 0UL));
  }
  return static_cast<int>(degree);
}

std::optional<Polynomial> DarbouxEquations::irreducible(const Polynomial& p) const {
  std::optional<Polynomial> result;
  for (const auto& [factor, exponent] : p.factors()) {
    if (degree_in_coordinates(factor) == 0) continue;
    if (result || exponent > 1) return std::nullopt;
    result = factor.scaled(1 / factor.content());
  }
  return result;
}

DarbouxEquations::Ansatz DarbouxEquations::of(std::size_t leading, bool one_weight) const {
  Ansatz result{monomial(monomials_, leading), Polynomial(ring_), {}, {}};
  for (std::size_t i = 0; i < leading; ++i) {
    if (one_weight && weight(monomials_, i) != weight(monomials_, leading)) continue;
    result.function += ring_.variable(first_f_ + i) * monomial(monomials_, i);
    result.unknowns.push_back(first_f_ + i);
  }
  for (std::size_t i = 0; i < cofactor_monomials_.size(); ++i) {
    if (weights_ && weight(cofactor_monomials_, i) != weights_->denominator) continue;
    result.cofactor += ring_.variable(first_k_ + i) * monomial(cofactor_monomials_, i);
    result.unknowns.push_back(first_k_ + i);
  }
  result.equations = coefficients(rate(result.function) + -(result.cofactor * result.function));
  return result;
}

Polynomial DarbouxEquations::rate(const Polynomial& p) const {
  Polynomial sum(ring_);
  for (std::size_t i = 0; i < dimension_; ++i) sum += p.derivative(i) * field_[i];
  return sum;
}

}  // namespace casimir::search
