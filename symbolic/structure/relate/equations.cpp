#include "symbolic/structure/relate/equations.hpp"

#include <algorithm>
#include <map>

#include "symbolic/algebra/exact_constant.hpp"
#include "symbolic/algebra/ideal.hpp"
#include "symbolic/error.hpp"

namespace casimir::structure {
namespace {

using GiNaC::ex;
using Exponents = std::vector<unsigned long>;

/// The ring of the equations: x_1 .. x_n, the free unknowns of the family, c, the m_k, s.
class FamilyEquations {
 public:
  FamilyEquations(const Pair& pair, const LinearFamily& family,
                  const std::optional<cln::cl_RA>& factor,
                  const std::vector<std::optional<cln::cl_RA>>& multiples)
      : pair_(pair),
        n_(pair.a.dimension),
        free_(family.free()),
        ring_(n_ + free_.size() + pair.casimirs.size() + 2),
        factor_known_(factor || !pair.with_hamiltonian()),
        factor_(factor_known_ ? ring_.constant(factor.value_or(1))
                              : ring_.variable(place_of_factor())) {
    for (std::size_t k = 0; k < pair.casimirs.size(); ++k) {
      const bool known = k < multiples.size() && multiples[k];
      multiples_.push_back(known ? ring_.constant(*multiples[k])
                                 : ring_.variable(place_of_factor() + 1 + k));
      multiple_known_.push_back(known);
    }
    std::map<std::size_t, std::size_t> places;
    for (std::size_t f = 0; f < free_.size(); ++f) places[free_[f]] = n_ + f;
    for (std::size_t i = 0; i < n_; ++i) {
      matrix_.emplace_back();
      for (std::size_t a = 0; a < n_; ++a) {
        const auto [constant, row] = family.value(i * n_ + a);
        Polynomial entry = ring_.constant(constant);
        for (const auto& [unknown, number] : row)
          entry += ring_.variable(places.at(unknown)).scaled(number);
        matrix_.back().push_back(std::move(entry));
      }
    }
  }

  MapSearch solve(const search::Watch& watch);

 private:
  std::size_t place_of_factor() const { return n_ + free_.size(); }
  std::size_t place_of_inverse() const { return ring_.size() - 1; }
  Polynomial at(const Terms& f, const std::vector<Polynomial>& y) const;
  Polynomial in_x(const Terms& f) const;
  void add(const Polynomial& identity);
  void add_bracket();
  void add_hamiltonian();
  void add_regularity();
  std::vector<Polynomial> independent() const;
  LinearMap map_at(const std::vector<ex>& values) const;

  const Pair& pair_;
  std::size_t n_;
  std::vector<std::size_t> free_;
  PolynomialRing ring_;
  bool factor_known_;
  Polynomial factor_;
  std::vector<Polynomial> multiples_;
  std::vector<bool> multiple_known_;
  std::vector<std::vector<Polynomial>> matrix_;
  std::vector<Polynomial> equations_;
};

/// f(y).
Polynomial FamilyEquations::at(const Terms& f, const std::vector<Polynomial>& y) const {
  Polynomial sum(ring_);
  for (const auto& [number, exponents] : f) {
    Polynomial term = ring_.constant(number);
    for (std::size_t i = 0; i < n_; ++i)
      if (exponents[i] > 0) term *= y[i].pow(exponents[i]);
    sum += term;
  }
  return sum;
}

Polynomial FamilyEquations::in_x(const Terms& f) const {
  TermCollector collector(ring_);
  for (const auto& [number, exponents] : f) {
    Exponents own = exponents;
    own.resize(ring_.size(), 0);
    collector.add(number, own);
  }
  return collector.finish();
}

/// Each coefficient of a power of x has to vanish.
void FamilyEquations::add(const Polynomial& identity) {
  std::map<Exponents, std::unique_ptr<TermCollector>> parts;
  for (auto [number, exponents] : identity.term_list()) {
    const Exponents moving(exponents.begin(), exponents.begin() + static_cast<std::ptrdiff_t>(n_));
    std::fill(exponents.begin(), exponents.begin() + static_cast<std::ptrdiff_t>(n_), 0UL);
    auto& part = parts[moving];
    if (!part) part = std::make_unique<TermCollector>(ring_);
    part->add(number, exponents);
  }
  for (auto& [moving, part] : parts) equations_.push_back(part->finish());
}

/// Q_ij(T x) = sum_ab T_ia T_jb P_ab(x).
void FamilyEquations::add_bracket() {
  std::vector<Polynomial> y;
  for (const auto& row : matrix_) {
    SumOfProducts sum(ring_);
    for (std::size_t a = 0; a < n_; ++a) sum.add(row[a], ring_.variable(a));
    y.push_back(sum.finish());
  }
  for (std::size_t i = 0; i < n_; ++i) {
    for (std::size_t j = i + 1; j < n_; ++j) {
      SumOfProducts sum(ring_);
      sum.add(at(pair_.b.bracket(i, j), y), ring_.constant(-1));
      for (std::size_t a = 0; a < n_; ++a) {
        if (matrix_[i][a].is_zero()) continue;
        for (std::size_t b = 0; b < n_; ++b) {
          const Terms entry = pair_.a.bracket(a, b);
          if (!entry.empty() && !matrix_[j][b].is_zero())
            sum.add(matrix_[i][a] * matrix_[j][b], in_x(entry));
        }
      }
      add(sum.finish());
    }
  }
  if (!pair_.with_hamiltonian()) return;
  SumOfProducts sum(ring_);
  sum.add(at(*pair_.b.hamiltonian, y), ring_.constant(1));
  sum.add(-factor_, in_x(*pair_.a.hamiltonian));
  for (std::size_t k = 0; k < multiples_.size(); ++k)
    sum.add(-multiples_[k], in_x(pair_.casimirs[k]));
  add(sum.finish());
}

/// s c det(T) = 1.
void FamilyEquations::add_regularity() {
  Polynomial product =
      search::determinant_without_sign(matrix_, ring_) * ring_.variable(place_of_inverse());
  if (pair_.with_hamiltonian()) product *= factor_;
  equations_.push_back(product - ring_.constant(1));
}

/// Rows of the echelon form over all monomials, those of high degree first.
std::vector<Polynomial> FamilyEquations::independent() const {
  std::map<std::pair<long, Exponents>, std::size_t> order;
  for (const Polynomial& p : equations_) {
    for (const auto& [number, exponents] : p.term_list()) {
      long degree = 0;
      for (const unsigned long e : exponents) degree += static_cast<long>(e);
      order.emplace(std::pair(-degree, exponents), 0);
    }
  }
  std::vector<Exponents> monomials;
  for (auto& [key, column] : order) {
    column = monomials.size();
    monomials.push_back(key.second);
  }
  LinearFamily echelon(monomials.size());
  for (const Polynomial& p : equations_) {
    LinearFamily::Row row;
    for (const auto& [number, exponents] : p.term_list()) {
      long degree = 0;
      for (const unsigned long e : exponents) degree += static_cast<long>(e);
      row[order.at({-degree, exponents})] = number;
    }
    if (!row.empty()) echelon.add(std::move(row), 0);
  }
  std::vector<bool> is_free(monomials.size(), false);
  for (const std::size_t f : echelon.free()) is_free[f] = true;
  std::vector<Polynomial> result;
  for (std::size_t m = 0; m < monomials.size(); ++m) {
    if (is_free[m]) continue;
    TermCollector collector(ring_);
    collector.add(1, monomials[m]);
    for (const auto& [column, number] : echelon.value(m).second)
      collector.add(-number, monomials[column]);
    result.push_back(collector.finish());
  }
  return result;
}

LinearMap FamilyEquations::map_at(const std::vector<ex>& values) const {
  const auto value = [&](const Polynomial& p) {
    ex sum = 0;
    for (const auto& [number, exponents] : p.term_list()) {
      ex term = GiNaC::numeric(number);
      for (std::size_t i = 0; i < exponents.size(); ++i)
        if (exponents[i] > 0) term *= GiNaC::pow(values[i], static_cast<int>(exponents[i]));
      sum += term;
    }
    return sum.expand();
  };
  LinearMap map;
  for (const auto& row : matrix_) {
    map.matrix.emplace_back();
    for (const Polynomial& entry : row) map.matrix.back().push_back(value(entry));
  }
  map.factor = value(factor_);
  for (const Polynomial& m : multiples_) map.multiples.push_back(value(m));
  return map;
}

bool is_not_zero(const ex& value) {
  const auto constant = exact_constant(value);
  return constant && !constant->zero;
}

bool is_regular(const LinearMap& map) {
  GiNaC::matrix m(static_cast<unsigned>(map.matrix.size()),
                  static_cast<unsigned>(map.matrix.size()));
  for (unsigned i = 0; i < m.rows(); ++i)
    for (unsigned j = 0; j < m.cols(); ++j) m(i, j) = map.matrix[i][j];
  return is_not_zero(m.determinant().expand()) && is_not_zero(map.factor);
}

MapSearch FamilyEquations::solve(const search::Watch& watch) {
  MapSearch result;
  // Of many unknowns the determinant has too many terms: then it is looked at afterwards.
  constexpr std::size_t kMostForDeterminant = 9;
  const bool regular = free_.size() <= kMostForDeterminant;
  add_bracket();
  if (regular) add_regularity();
  std::vector<std::size_t> unknowns;
  for (std::size_t f = 0; f < free_.size(); ++f) unknowns.push_back(n_ + f);
  if (pair_.with_hamiltonian()) {
    if (!factor_known_) unknowns.push_back(place_of_factor());
    for (std::size_t k = 0; k < multiples_.size(); ++k)
      if (!multiple_known_[k]) unknowns.push_back(place_of_factor() + 1 + k);
  }
  if (regular) unknowns.push_back(place_of_inverse());
  const std::vector<search::Branch> branches = search::solve_system(independent(), unknowns, watch);
  result.none = branches.empty() && regular;
  for (const search::Branch& branch : branches) {
    if (!branch.decided) continue;
    watch.tick(0.5);
    if (find_real_values(branch, unknowns, ring_.size(), [&](const std::vector<ex>& values) {
          LinearMap map = map_at(values);
          if (!is_regular(map)) return false;
          result.map = std::move(map);
          return true;
        }))
      return result;
  }
  return result;
}

}  // namespace

MapSearch solve_family(const Pair& pair, const LinearFamily& family,
                       const std::optional<cln::cl_RA>& factor,
                       const std::vector<std::optional<cln::cl_RA>>& multiples,
                       const search::Watch& watch) {
  try {
    return FamilyEquations(pair, family, factor, multiples).solve(watch);
  } catch (const TooLarge&) {
    return {};
  }
}

}  // namespace casimir::structure
