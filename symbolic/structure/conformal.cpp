#include "symbolic/structure/conformal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <random>

#include "symbolic/case/limits.hpp"
#include "symbolic/error.hpp"
#include "symbolic/search/darboux.hpp"
#include "symbolic/search/finder.hpp"
#include "symbolic/search/modular/monomials.hpp"
#include "symbolic/search/modular/span.hpp"
#include "symbolic/structure/conformal_equations.hpp"
#include "symbolic/structure/conformal_factors.hpp"

namespace casimir::structure {
namespace {

/// The tensors of one factor.
struct ConformalSpace {
  Cofactor cofactor;
  /// Of those up to the degree 0, 1, ..: a basis over Q(parameters).
  std::vector<std::vector<ParametricRow>> bases;
};

/// A polynomial F with dF/dt = K F; K = 0 of an integral.
struct ConformalMultiplier {
  Polynomial value;
  Cofactor cofactor;
  int degree;
};

class ConformalSearch {
 public:
  ConformalSearch(const Model& model, TensorType type, int degree, const search::Watch& watch);
  ConformalReport run();

 private:
  void collect_multipliers();
  Cofactors all_cofactors();
  void add_sums_of_known(Cofactors& cofactors) const;
  void add_space(const Cofactor& cofactor);
  const ConformalSpace* space_of(const Cofactor& cofactor) const;
  std::optional<std::vector<search::Residue>> values_of(const ParametricRow& row) const;
  std::vector<ParametricRow> generated(const ConformalSpace& space, int degree) const;
  void list(const ConformalSpace& space);
  ConformalTensor described(const Cofactor& cofactor, int degree, const ParametricRow& row) const;
  void leave_open(const std::string& reason) {
    report_.complete = report_.complete_rational = report_.complete_constants = false;
    report_.reason = reason;
  }
  void doubt();

  const Model& model_;
  int degree_;
  const search::Watch& watch_;
  ConformalEquations equations_;
  std::vector<ConformalEquations::Basis> bases_;  ///< of the degrees 0, 1, ..
  std::vector<ConformalMultiplier> multipliers_;
  std::vector<ConformalSpace> spaces_;
  search::Modulus modulus_ = search::Modulus::nth(0);
  search::Point point_;  ///< of the parameters
  ConformalReport report_;
};

ConformalSearch::ConformalSearch(const Model& model, TensorType type, int degree,
                                 const search::Watch& watch)
    : model_(model), degree_(degree), watch_(watch), equations_(model, type) {
  constexpr std::size_t kMostUnknowns = 1500;
  for (int d = 0; d <= degree; ++d) bases_.push_back(equations_.basis(d));
  if (bases_.back().size() > kMostUnknowns)
    throw ModelError(
        fmt::format("{} unknown coefficients are more than {}: a lower degree is "
                    "needed",
                    bases_.back().size(), kMostUnknowns));
  std::mt19937_64 random(37);
  point_.assign(equations_.system().ring().size(), 0);
  for (search::Residue& value : point_) value = modulus_.random(random);
  report_.type = type;
  report_.degree = degree;
  report_.generic = equations_.system().generic_parameters();
}

/// Darboux polynomials and integrals. Where some are missing, more is listed.
void ConformalSearch::collect_multipliers() {
  constexpr int kHighest = 6;  // of Darboux polynomials that are searched
  Prover& prover = equations_.system().prover();
  const Polynomial one = equations_.system().ring().constant(1);
  const auto add = [&](const GiNaC::ex& value, const GiNaC::ex& cofactor) {
    const Polynomial p = prover.convert(value);
    const auto rate = prover.ring().lowest_terms(prover.convert(cofactor));
    const int degree = equations_.degree_of(p);
    if (degree > 0 && degree <= degree_)
      multipliers_.push_back({p, lowest(rate.first, rate.second), degree});
  };
  if (degree_ < 1) return;
  for (const auto& own :
       search::find_darboux_polynomials(model_, std::min(degree_, kHighest), watch_).found)
    add(own.value, own.cofactor_value);
  search::Request request;
  request.degree = degree_;
  request.casimirs_are_integrals = true;
  const search::Report integrals = search::find_integrals(model_, request, watch_);
  for (const search::Found& own : integrals.found) add(own.value, 0);
  if (integrals.hamiltonian) add(*model_.hamiltonian, 0);
}

/// What the cofactors of known Darboux polynomials and of the volume form add up to.
void ConformalSearch::add_sums_of_known(Cofactors& cofactors) const {
  const Polynomial one = equations_.system().ring().constant(1);
  const Cofactor zero{Polynomial(equations_.system().ring()), one},
      divergence{equations_.divergence(), one};
  std::vector<int> degrees;
  for (const ConformalMultiplier& own : multipliers_) degrees.push_back(own.degree);
  for (const std::vector<int>& exponents : search::products_up_to(degrees, degree_, 0)) {
    Cofactor sum = zero;
    for (std::size_t k = 0; k < exponents.size(); ++k)
      for (int e = 0; e < exponents[k]; ++e) sum = sum_of(sum, multipliers_[k].cofactor);
    for (const Cofactor& start : {zero, divergence, negative_of(divergence)})
      cofactors.add(sum_of(start, sum));
  }
}

Cofactors ConformalSearch::all_cofactors() {
  watch_.begin("factors of conformal tensors");
  Cofactors result;
  try {
    result = conformal_factors(equations_, degree_, watch_);
  } catch (const TooLarge& limit) {
    result.leave_open(limit.what());
  }
  report_.complete_rational = report_.complete_constants = result.complete;
  const bool irrational = result.irrational || !result.algebraic.empty();
  report_.complete = result.complete && !irrational;
  report_.reason = result.reason;
  if (result.complete && irrational)
    report_.reason = "there may be some with coefficients that are algebraic numbers, as sqrt(2)";
  if (result.complete) return result;
  add_sums_of_known(result);
  try {
    const Cofactors constants = constant_factors(equations_, degree_, watch_);
    for (const Cofactor& own : constants.found) result.add(own);
    report_.complete_constants = constants.complete;
  } catch (const TooLarge&) {
    report_.complete_constants = false;
  }
  return result;
}

void ConformalSearch::add_space(const Cofactor& cofactor) {
  ConformalSpace space{cofactor, {}};
  std::vector<ParametricRow> all = equations_.solutions(bases_.back(), cofactor, watch_);
  if (all.empty()) return;
  for (int d = 0; d < degree_; ++d)
    space.bases.push_back(
        equations_.solutions(bases_[static_cast<std::size_t>(d)], cofactor, watch_));
  space.bases.push_back(std::move(all));
  spaces_.push_back(std::move(space));
}

const ConformalSpace* ConformalSearch::space_of(const Cofactor& cofactor) const {
  const auto found = std::ranges::find(spaces_, cofactor, &ConformalSpace::cofactor);
  return found == spaces_.end() ? nullptr : &*found;
}

/// The coefficients in the basis of the highest degree, modulo a prime.
std::optional<std::vector<search::Residue>> ConformalSearch::values_of(
    const ParametricRow& row) const {
  std::vector<search::Residue> result(bases_.back().size(), 0);
  for (const auto& [column, entry] : row) {
    const auto value = search::value_at(entry, point_, modulus_);
    if (!value) return std::nullopt;
    result[column] = *value;
  }
  return result;
}

/// Products of those of lower degree with Darboux polynomials and integrals.
std::vector<ParametricRow> ConformalSearch::generated(const ConformalSpace& space,
                                                      int degree) const {
  std::vector<ParametricRow> result;
  for (const ConformalMultiplier& own : multipliers_) {
    if (own.degree > degree) continue;
    const ConformalSpace* other = space_of(sum_of(space.cofactor, negative_of(own.cofactor)));
    if (other == nullptr) continue;
    const auto left = static_cast<std::size_t>(degree - own.degree);
    for (const ParametricRow& row : other->bases[left]) {
      std::vector<Polynomial> tensor = equations_.tensor_of(bases_[left], row);
      for (Polynomial& component : tensor) component = component * own.value;
      result.push_back(equations_.row_of(bases_.back(), tensor));
    }
  }
  return result;
}

/// By ascending degree, what the others do not generate. That these span the space is proved: the
/// rank modulo a prime is not above the true one, and the dimension is that of a kernel.
void ConformalSearch::list(const ConformalSpace& space) {
  std::size_t own = 0, rank = 0;
  std::vector<ParametricRow> listed;  // in the basis of the highest degree
  for (int d = 0; d <= degree_; ++d) {
    search::Span span(modulus_);
    const auto insert = [&](const ParametricRow& row) {
      std::optional<std::vector<search::Residue>> values = values_of(row);
      return values && span.insert(std::move(*values));
    };
    for (const ParametricRow& row : generated(space, d)) insert(row);
    for (const ParametricRow& row : listed) insert(row);
    for (const ParametricRow& row : space.bases[static_cast<std::size_t>(d)]) {
      ParametricRow raised = equations_.row_of(
          bases_.back(), equations_.tensor_of(bases_[static_cast<std::size_t>(d)], row));
      if (!insert(raised)) continue;
      report_.found.push_back(described(space.cofactor, d, row));
      listed.push_back(std::move(raised));
      ++own;
    }
    rank = span.dimension();
  }
  if (rank < space.bases.back().size())
    leave_open("which of the tensors others generate was not found out");
  report_.trivial += rank - own;
}

/// Proved by multiplying out: L_X T - f T is zero.
ConformalTensor ConformalSearch::described(const Cofactor& cofactor, int degree,
                                           const ParametricRow& row) const {
  ConformalTensor result;
  const search::System& system = equations_.system();
  const std::vector<Polynomial> tensor =
      equations_.tensor_of(bases_[static_cast<std::size_t>(degree)], row);
  const std::vector<Polynomial> rates = equations_.derivative(tensor);
  bool holds = true;
  for (std::size_t c = 0; c < tensor.size(); ++c) {
    holds = holds && (rates[c] * cofactor.bottom - cofactor.top * tensor[c]).is_zero();
    result.components.push_back(system.expression(tensor[c]));
    if (!tensor[c].is_zero())
      result.texts.emplace_back(equations_.lift().label(c), system.functions().text(tensor[c]));
  }
  result.factor = system.expression(cofactor.top) / system.expression(cofactor.bottom);
  result.factor_text = system.functions().text(cofactor.top);
  if (!cofactor.bottom.is_constant())
    result.factor_text =
        fmt::format("({})/({})", result.factor_text, system.functions().text(cofactor.bottom));
  result.degree = degree;
  result.verdict = holds ? Verdict::proved : Verdict::undecided;
  return result;
}

/// What else has to hold for "no others".
void ConformalSearch::doubt() {
  for (const std::size_t place : equations_.system().parameters()) {
    if (place >= equations_.system().functions().symbols().size())
      leave_open(
          fmt::format("'{}' is taken as a parameter of its own", equations_.system().name(place)));
  }
  for (const ConformalTensor& own : report_.found)
    if (own.verdict != Verdict::proved) leave_open("a tensor was found but not proved");
  if (!report_.complete_rational && !report_.complete_constants) return;
  if (const auto reason = search::thin_domain(equations_.system())) leave_open(*reason);
}

ConformalReport ConformalSearch::run() {
  collect_multipliers();
  const WorkMeter meter(model_.limits);
  const Cofactors cofactors = all_cofactors();
  const Polynomial one = equations_.system().ring().constant(1);
  watch_.begin(fmt::format("conformal {}", name_of(report_.type)));
  try {
    add_space({Polynomial(one.ring()), one});  // the invariant ones
    for (const Cofactor& own : cofactors.found)
      if (!own.is_zero()) add_space(own);
    for (const ConformalSpace& space : spaces_)
      if (!space.cofactor.is_zero()) list(space);
  } catch (const TooLarge& limit) {
    leave_open(limit.what());
  }
  std::ranges::stable_sort(report_.found, {}, &ConformalTensor::degree);
  doubt();
  return report_;
}

}  // namespace

ConformalReport find_conformal_tensors(const Model& model, TensorType type, int degree,
                                       const search::Watch& watch) {
  return ConformalSearch(model, type, degree, watch).run();
}

}  // namespace casimir::structure
