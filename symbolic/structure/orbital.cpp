#include "symbolic/structure/orbital.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <random>

#include "symbolic/algebra/rational_matrix.hpp"
#include "symbolic/case/limits.hpp"
#include "symbolic/error.hpp"
#include "symbolic/search/finder.hpp"
#include "symbolic/search/modular/monomials.hpp"
#include "symbolic/search/system.hpp"
#include "symbolic/structure/parametric_kernel.hpp"

namespace casimir::structure {
namespace {

using search::Monomials;

// The unknowns are the coefficients of the components of Y, one component after the other, and then
// those of g. The equations are those of all monomials of all components of [X, Y] - g X. Among the
// solutions are Y = h X, g = X(h); as X is not zero these are as many as there are monomials in h.
// Where no pivot of the elimination vanishes, and for no other generic values, the solutions are
// what the basis spans.
class OrbitalSearch {
 public:
  OrbitalSearch(const Model& model, int degree, const search::Watch& watch);
  OrbitalReport run();

 private:
  std::size_t unknowns() const { return dimension_ * fields_.size() + factors_.size(); }
  Polynomial monomial(const Monomials& list, std::size_t i) const;
  /// X applied to a polynomial.
  Polynomial rate(const Polynomial& p) const;
  std::vector<Polynomial> contribution(std::size_t unknown) const;
  std::vector<ParametricRow> equations() const;
  std::vector<ParametricRow> trivial_ones() const;
  std::vector<bool> spanned_by_trivial(const ParametricKernel& kernel);
  OrbitalSymmetry described(const ParametricRow& solution) const;
  void leave_open(const std::string& reason) {
    report_.complete = false;
    report_.reason = reason;
  }

  const Model& model_;
  int degree_;
  const search::Watch& watch_;
  search::System system_;
  std::size_t dimension_;
  std::vector<Polynomial> field_;
  int field_degree_ = 0;
  Monomials fields_, factors_, multiples_;  ///< of a component of Y, of g and of h
  OrbitalReport report_;
};

/// Of a degree that may be negative: then there are none.
Monomials monomials_up_to(std::size_t dimension, int degree) {
  if (degree < 0) return Monomials(dimension);
  return search::all_monomials(std::vector<int>(dimension, 1), degree);
}

using Exponents = std::vector<unsigned long>;

/// The monomial in the coordinates of a term; what is left are parameters.
Exponents take_coordinates(Exponents& exponents, std::size_t dimension) {
  const auto end = exponents.begin() + static_cast<std::ptrdiff_t>(dimension);
  Exponents own(exponents.begin(), end);
  std::fill(exponents.begin(), end, 0);
  return own;
}

int degree_of(const Polynomial& p, std::size_t dimension) {
  unsigned long degree = 0;
  for (auto [number, exponents] : p.term_list()) {
    unsigned long own = 0;
    for (const unsigned long e : take_coordinates(exponents, dimension)) own += e;
    degree = std::max(degree, own);
  }
  return static_cast<int>(degree);
}

/// The coefficients of the monomials in the coordinates.
std::map<Exponents, Polynomial> coefficients_of(const Polynomial& p, std::size_t dimension) {
  std::map<Exponents, std::vector<std::pair<cln::cl_RA, Exponents>>> parts;
  for (auto [number, exponents] : p.term_list()) {
    Exponents own = take_coordinates(exponents, dimension);
    parts[std::move(own)].emplace_back(number, exponents);
  }
  std::map<Exponents, Polynomial> result;
  for (const auto& [own, terms] : parts) {
    TermCollector collector(p.ring());
    for (const auto& [number, exponents] : terms) collector.add(number, exponents);
    result.emplace(own, collector.finish());
  }
  return result;
}

OrbitalSearch::OrbitalSearch(const Model& model, int degree, const search::Watch& watch)
    : model_(model),
      degree_(degree),
      watch_(watch),
      system_(model, {}, {}),
      dimension_(model.variables.size()),
      fields_(monomials_up_to(dimension_, degree)),
      factors_(monomials_up_to(dimension_, degree - 1)),
      multiples_(dimension_) {
  if (model.time || system_.atoms().size() > dimension_)
    throw ModelError("symmetries of orbits need equations of motion that are polynomials");
  for (std::size_t i = 0; i < dimension_; ++i) {
    field_.push_back(system_.prover().convert(model.field[i]));
    // A common denominator is multiplied out of the flow of a search.
    if (!(field_[i] == system_.flow()[i]))
      throw ModelError("symmetries of orbits need equations of motion that are polynomials");
    field_degree_ = std::max(field_degree_, degree_of(field_[i], dimension_));
  }
  if (std::ranges::all_of(field_, [](const Polynomial& p) { return p.is_zero(); }))
    throw ModelError("there is no motion: all fields are symmetries of its orbits");
  multiples_ = monomials_up_to(dimension_, degree - field_degree_);
  constexpr std::size_t kMostUnknowns = 3000;
  if (unknowns() > kMostUnknowns)
    throw ModelError(
        fmt::format("{} unknown coefficients are more than {}: a lower degree is "
                    "needed",
                    unknowns(), kMostUnknowns));
  report_.degree = degree;
  report_.trivial = multiples_.size();
  report_.generic = system_.generic_parameters();
}

Polynomial OrbitalSearch::monomial(const Monomials& list, std::size_t i) const {
  Polynomial result = system_.ring().constant(1);
  for (std::size_t v = 0; v < dimension_; ++v)
    result = result * system_.ring().variable(v).pow(list[i][v]);
  return result;
}

Polynomial OrbitalSearch::rate(const Polynomial& p) const {
  Polynomial sum(system_.ring());
  for (std::size_t i = 0; i < dimension_; ++i) sum += p.derivative(i) * field_[i];
  return sum;
}

/// The components of [X, Y] - g X where this unknown is 1 and all others are 0.
std::vector<Polynomial> OrbitalSearch::contribution(std::size_t unknown) const {
  std::vector<Polynomial> result;
  const std::size_t component = unknown / fields_.size(), place = unknown % fields_.size();
  const bool of_factor = component >= dimension_;
  const Polynomial own = of_factor ? monomial(factors_, unknown - dimension_ * fields_.size())
                                   : monomial(fields_, place);
  for (std::size_t k = 0; k < dimension_; ++k) {
    result.push_back(-(own * (of_factor ? field_[k] : field_[k].derivative(component))));
    if (k == component) result.back() += rate(own);
  }
  return result;
}

std::vector<ParametricRow> OrbitalSearch::equations() const {
  std::map<std::pair<std::size_t, Exponents>, ParametricRow> rows;
  for (std::size_t u = 0; u < unknowns(); ++u) {
    const std::vector<Polynomial> parts = contribution(u);
    for (std::size_t k = 0; k < dimension_; ++k)
      for (const auto& [own, coefficient] : coefficients_of(parts[k], dimension_))
        rows[{k, own}].emplace(u, coefficient);
    watch_.tick(0);
  }
  std::vector<ParametricRow> result;
  for (auto& [place, row] : rows) result.push_back(std::move(row));
  return result;
}

/// The coefficients of Y = h X and of g = X(h), for each monomial h.
std::vector<ParametricRow> OrbitalSearch::trivial_ones() const {
  std::map<Exponents, std::size_t> places;  // of the monomials of g too: both ascend alike
  for (std::size_t i = 0; i < fields_.size(); ++i)
    places.emplace(Exponents(fields_[i], fields_[i] + dimension_), i);
  std::vector<ParametricRow> result;
  for (std::size_t h = 0; h < multiples_.size(); ++h) {
    result.emplace_back();
    const Polynomial own = monomial(multiples_, h);
    for (std::size_t i = 0; i <= dimension_; ++i) {
      const Polynomial part = i < dimension_ ? own * field_[i] : rate(own);
      for (const auto& [exponents, number] : coefficients_of(part, dimension_))
        result.back().emplace(i * fields_.size() + places.at(exponents), number);
    }
  }
  return result;
}

/// Which vectors of the basis follow from the others and the fields h X: a regular minor of these
/// in the free columns, at one point of the parameters, shows it for generic ones.
std::vector<bool> OrbitalSearch::spanned_by_trivial(const ParametricKernel& kernel) {
  std::vector<bool> result(kernel.free.size(), false);
  const std::vector<ParametricRow> trivial = trivial_ones();
  std::mt19937_64 random(29);
  constexpr int kTries = 5;
  for (int attempt = 0; attempt < kTries; ++attempt) {
    std::vector<cln::cl_RA> point;
    for (std::size_t i = 0; i < system_.ring().size(); ++i)
      point.emplace_back(static_cast<int>(random() % 997) + 2);
    RationalMatrix values(trivial.size(), std::vector<cln::cl_RA>(kernel.free.size(), 0));
    for (std::size_t h = 0; h < trivial.size(); ++h) {
      for (std::size_t c = 0; c < kernel.free.size(); ++c) {
        const auto entry = trivial[h].find(kernel.free[c]);
        if (entry != trivial[h].end()) values[h][c] = entry->second.evaluate(point);
      }
    }
    if (trivial.empty()) return result;
    const std::vector<std::size_t> columns = independent_columns(values);
    if (columns.size() < trivial.size()) continue;
    for (const std::size_t c : columns) result[c] = true;
    return result;
  }
  leave_open("which of the symmetries are multiples of the motion was not found out");
  return result;
}

/// Proved by multiplying out: [X, Y] - g X is zero.
OrbitalSymmetry OrbitalSearch::described(const ParametricRow& solution) const {
  OrbitalSymmetry result;
  std::vector<Polynomial> components(dimension_, Polynomial(system_.ring()));
  Polynomial factor(system_.ring());
  for (const auto& [unknown, number] : solution) {
    const std::size_t component = unknown / fields_.size();
    if (component < dimension_)
      components[component] += number * monomial(fields_, unknown % fields_.size());
    else
      factor += number * monomial(factors_, unknown - dimension_ * fields_.size());
  }
  bool holds = true;
  for (std::size_t k = 0; k < dimension_; ++k) {
    Polynomial rest = rate(components[k]);
    rest -= factor * field_[k];
    for (std::size_t i = 0; i < dimension_; ++i) rest -= components[i] * field_[k].derivative(i);
    holds = holds && rest.is_zero();
    result.components.push_back(system_.expression(components[k]));
    result.degree = std::max(result.degree, degree_of(components[k], dimension_));
    if (!components[k].is_zero())
      result.texts.emplace_back(model_.variables[k].get_name(),
                                system_.functions().text(components[k]));
  }
  result.factor = system_.expression(factor);
  result.factor_text = system_.functions().text(factor);
  result.verdict = holds ? Verdict::proved : Verdict::undecided;
  return result;
}

OrbitalReport OrbitalSearch::run() {
  report_.complete = true;
  watch_.begin(fmt::format("symmetries of orbits of degree {}", degree_));
  const WorkMeter meter(model_.limits);
  try {
    const ParametricKernel kernel = kernel_of(equations(), unknowns(), system_.ring(),
                                              [&](double share) { watch_.tick(share); });
    const std::vector<bool> spanned = spanned_by_trivial(kernel);
    for (std::size_t k = 0; k < kernel.basis.size(); ++k)
      if (!spanned[k]) report_.found.push_back(described(kernel.basis[k]));
  } catch (const TooLarge& limit) {
    leave_open(limit.what());
  }
  std::ranges::stable_sort(report_.found, {}, &OrbitalSymmetry::degree);
  for (const std::size_t place : system_.parameters()) {
    if (place >= system_.functions().symbols().size())
      leave_open(fmt::format("'{}' is taken as a parameter of its own", system_.name(place)));
  }
  for (const OrbitalSymmetry& own : report_.found)
    if (own.verdict != Verdict::proved) leave_open("a field was found but not proved");
  if (!report_.complete) return report_;
  if (const auto doubt = search::thin_domain(system_)) leave_open(*doubt);
  return report_;
}

}  // namespace

OrbitalReport find_orbital_symmetries(const Model& model, int degree, const search::Watch& watch) {
  return OrbitalSearch(model, degree, watch).run();
}

}  // namespace casimir::structure
