#include "symbolic/structure/relate/symmetries.hpp"

#include <algorithm>

#include "symbolic/functions/function_ring.hpp"
#include "symbolic/search/finder.hpp"
#include "symbolic/search/generic_parameters.hpp"
#include "symbolic/structure/bracket_equations.hpp"

namespace casimir::structure {
namespace {

using GiNaC::ex;
using Summand = ConstantEquations::Summand;

class SymmetrySearch {
 public:
  SymmetrySearch(const Model& model, const search::Watch& watch)
      : model_(model),
        watch_(watch),
        n_(model.variables.size()),
        system_(model, {}, {*model.hamiltonian}) {
    for (std::size_t i = 0; i < n_; ++i)
      for (std::size_t j = i + 1; j < n_; ++j)
        bracket_.push_back(polynomial((*model.poisson)(i, j)));
    hamiltonian_ = polynomial(*model.hamiltonian);
    // x_i, then x_i x_j with i <= j: what F may be made of.
    for (const GiNaC::symbol& x : model.variables) monomials_.push_back(x);
    for (std::size_t i = 0; i < n_; ++i)
      for (std::size_t j = i; j < n_; ++j)
        monomials_.push_back(model.variables[i] * model.variables[j]);
  }

  SymmetryReport run();

 private:
  Polynomial polynomial(const ex& e) {
    Polynomial p = system_.functions().reduced(system_.prover().convert(e));
    if (system_.functions().end_of_generators() > system_.functions().symbols().size())
      throw ModelError("linear symmetries are those of polynomial brackets and Hamiltonians");
    return p;
  }
  Polynomial x(std::size_t i) const { return system_.ring().variable(i); }
  std::vector<std::vector<ex>> fields();
  std::vector<std::vector<ex>> integrals();
  bool keeps_everything(const std::vector<ex>& y) const;
  void add(std::vector<ex> matrix, const ex& integral);

  const Model& model_;
  const search::Watch& watch_;
  std::size_t n_;
  search::System system_;
  Bivector bracket_;
  std::optional<Polynomial> hamiltonian_;
  std::vector<ex> monomials_;
  std::vector<std::size_t> free_;       ///< entries of D that decide the others
  std::vector<std::vector<ex>> taken_;  ///< the values of these of the fields in the report
  SymmetryReport report_;
};

/// A basis of the matrices D, each as D_00, D_01, ..
std::vector<std::vector<ex>> SymmetrySearch::fields() {
  ConstantEquations equations(system_, n_ * n_);
  const auto d = [&](std::size_t i, std::size_t a) { return i * n_ + a; };
  for (std::size_t i = 0; i < n_; ++i) {
    for (std::size_t j = i + 1; j < n_; ++j) {
      std::vector<Summand> sum;
      for (std::size_t k = 0; k < n_; ++k) {
        const Polynomial slope = entry(bracket_, n_, i, j).derivative(k);
        for (std::size_t a = 0; a < n_ && !slope.is_zero(); ++a)
          sum.push_back({slope * x(a), {d(k, a)}});
        sum.push_back({-entry(bracket_, n_, k, j), {d(i, k)}});
        sum.push_back({-entry(bracket_, n_, i, k), {d(j, k)}});
      }
      equations.add(sum);
    }
  }
  std::vector<Summand> sum;
  for (std::size_t i = 0; i < n_; ++i)
    for (std::size_t a = 0; a < n_; ++a)
      sum.push_back({hamiltonian_->derivative(i) * x(a), {d(i, a)}});
  equations.add(sum);
  std::vector<std::vector<ex>> result;
  for (const search::Branch& branch : equations.solve(watch_)) {
    report_.complete = branch.decided;  // linear: one family
    if (!branch.decided) continue;
    free_ = equations.free_in(branch);
    for (std::size_t k = 0; k < free_.size(); ++k) {
      std::vector<ex> values(free_.size(), 0);
      values[k] = 1;
      if (auto matrix = equations.values(branch, values)) result.push_back(std::move(*matrix));
    }
  }
  return result;
}

/// The F with a linear field and {F, H} = 0, by their coefficients.
std::vector<std::vector<ex>> SymmetrySearch::integrals() {
  ConstantEquations equations(system_, monomials_.size());
  std::vector<std::vector<Polynomial>> flows;
  for (const ex& m : monomials_) flows.push_back(hamiltonian_field(bracket_, n_, polynomial(m)));
  for (std::size_t i = 0; i < n_; ++i) {
    std::vector<Summand> sum;
    for (std::size_t m = 0; m < monomials_.size(); ++m) {
      TermCollector others(system_.ring());
      for (const auto& [number, exponents] : flows[m][i].term_list()) {
        unsigned long degree = 0;
        for (std::size_t k = 0; k < n_; ++k) degree += exponents[k];
        if (degree != 1) others.add(number, exponents);
      }
      sum.push_back({others.finish(), {m}});
    }
    equations.add(sum);
  }
  std::vector<Summand> sum;
  for (std::size_t m = 0; m < monomials_.size(); ++m)
    for (std::size_t i = 0; i < n_; ++i)
      sum.push_back({flows[m][i] * hamiltonian_->derivative(i), {m}});
  equations.add(sum);
  std::vector<std::vector<ex>> result;
  for (const search::Branch& branch : equations.solve(watch_)) {
    if (!branch.decided) continue;
    const std::size_t count = equations.free_in(branch).size();
    for (std::size_t k = 0; k < count; ++k) {
      std::vector<ex> values(count, 0);
      values[k] = 1;
      if (auto own = equations.values(branch, values)) result.push_back(std::move(*own));
    }
  }
  return result;
}

/// Whether L_Y P = 0 and Y(H) = 0, computed anew.
bool SymmetrySearch::keeps_everything(const std::vector<ex>& y) const {
  const auto along = [&](const ex& f) {
    ex sum = 0;
    for (std::size_t k = 0; k < n_; ++k) sum += y[k] * f.diff(model_.variables[k]);
    return sum;
  };
  for (std::size_t i = 0; i < n_; ++i) {
    for (std::size_t j = i + 1; j < n_; ++j) {
      ex sum = along((*model_.poisson)(i, j));
      for (std::size_t k = 0; k < n_; ++k)
        sum -= (*model_.poisson)(k, j) * y[i].diff(model_.variables[k]) +
               (*model_.poisson)(i, k) * y[j].diff(model_.variables[k]);
      if (!sum.normal().expand().is_zero()) return false;
    }
  }
  return along(*model_.hamiltonian).normal().expand().is_zero();
}

/// Takes a field unless those taken before span it.
void SymmetrySearch::add(std::vector<ex> matrix, const ex& integral) {
  std::vector<ex> own;
  for (const std::size_t f : free_) own.push_back(matrix[f]);
  GiNaC::matrix rows(static_cast<unsigned>(taken_.size() + 1), static_cast<unsigned>(free_.size()));
  for (unsigned i = 0; i < rows.rows(); ++i)
    for (unsigned j = 0; j < rows.cols(); ++j)
      rows(i, j) = i < taken_.size() ? taken_[i][j] : own[j];
  if (rows.rank() < rows.rows()) return;
  taken_.push_back(own);
  std::vector<ex> field;
  for (std::size_t i = 0; i < n_; ++i) {
    ex sum = 0;
    for (std::size_t a = 0; a < n_; ++a) sum += matrix[i * n_ + a] * model_.variables[a];
    field.push_back(sum);
  }
  std::vector<ex> all = field;
  all.push_back(integral);
  FunctionRing ring(model_.symbols(), model_.assumptions, all, model_.limits);
  LinearSymmetry symmetry;
  for (std::size_t i = 0; i < n_; ++i)
    if (!field[i].is_zero())
      symmetry.field.emplace_back(model_.variables[i].get_name(),
                                  ring.text(ring.convert(field[i])));
  if (integral.is_zero()) {
    symmetry.verdict = keeps_everything(field) ? Verdict::proved : Verdict::undecided;
  } else {
    symmetry.integral = ring.text(ring.convert(integral));
    symmetry.verdict =
        prove_claim(model_, ClaimKind::integral, {symmetry.integral, integral, {}}).verdict;
  }
  report_.found.push_back(std::move(symmetry));
}

SymmetryReport SymmetrySearch::run() {
  report_.generic = system_.generic_parameters();
  if (const std::string bound = system_.bound_parameter(); !bound.empty())
    throw ModelError("the parameter " + bound + " is bound to others: give numbers to them");
  const std::vector<std::vector<ex>> all = fields();
  if (!report_.complete) {
    report_.reason = "the equations for the fields were not solved";
  } else if (const auto doubt = search::thin_domain(system_)) {
    report_.complete = false;
    report_.reason = *doubt;
  }
  for (const std::vector<ex>& coefficients : integrals()) {
    ex f = 0;
    for (std::size_t m = 0; m < monomials_.size(); ++m) f += coefficients[m] * monomials_[m];
    std::vector<ex> matrix;
    for (const ex& component : model_.poisson->flow(f)) {
      const ex own = component.expand();
      for (const GiNaC::symbol& x : model_.variables) matrix.push_back(own.coeff(x, 1).normal());
    }
    if (std::any_of(matrix.begin(), matrix.end(), [](const ex& e) { return !e.is_zero(); }))
      add(std::move(matrix), f);
  }
  for (const std::vector<ex>& matrix : all) add(matrix, 0);
  for (const LinearSymmetry& symmetry : report_.found) {
    if (symmetry.verdict == Verdict::proved) continue;
    report_.complete = false;
    report_.reason = "a symmetry was found but not proved";
  }
  return report_;
}

}  // namespace

SymmetryReport linear_symmetries(const Model& model, const search::Watch& watch) {
  if (!model.poisson || !model.hamiltonian)
    throw ModelError("linear symmetries are those of a bracket and a Hamiltonian");
  if (model.time)
    throw ModelError("linear symmetries are searched where no time is in the equations");
  search::check_parameters_are_free(model);
  return SymmetrySearch(model, watch).run();
}

}  // namespace casimir::structure
