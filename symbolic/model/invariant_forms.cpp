#include "symbolic/model/invariant_forms.hpp"

#include <flint/fmpz_mat.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "symbolic/algebra/rational_matrix.hpp"
#include "symbolic/error.hpp"

namespace casimir {
namespace {

using GeneratorProduct = std::vector<std::size_t>;
using Equation = std::vector<std::pair<std::size_t, long>>;  ///< unknown and coefficient

/// A scoped FLINT matrix of integers.
class IntegerMatrix {
 public:
  IntegerMatrix(std::size_t rows, std::size_t columns) {
    fmpz_mat_init(value_, static_cast<slong>(rows), static_cast<slong>(columns));
  }
  ~IntegerMatrix() { fmpz_mat_clear(value_); }
  IntegerMatrix(const IntegerMatrix&) = delete;
  IntegerMatrix& operator=(const IntegerMatrix&) = delete;
  fmpz_mat_struct* get() { return value_; }
  fmpz* at(std::size_t i, std::size_t j) {
    return fmpz_mat_entry(value_, static_cast<slong>(i), static_cast<slong>(j));
  }

 private:
  fmpz_mat_t value_;
};

void append_monomials(std::size_t variables, std::size_t degree, GeneratorProduct& start,
                      std::vector<GeneratorProduct>& list) {
  if (degree == 0) {
    list.push_back(start);
    return;
  }
  for (std::size_t i = start.empty() ? 0 : start.back(); i < variables; ++i) {
    start.push_back(i);
    append_monomials(variables, degree - 1, start, list);
    start.pop_back();
  }
}

/// {x_i, x_j} for each pair as index and coefficient, all multiplied by one number that makes the
/// coefficients integers.
std::vector<std::vector<Equation>> integer_brackets(const LieAlgebra& algebra) {
  long common = 1;
  for (const StructureConstant& c : algebra.constants)
    common = std::lcm(common, static_cast<long>(c.denominator));
  std::vector<std::vector<Equation>> bracket(algebra.dimension,
                                             std::vector<Equation>(algebra.dimension));
  for (const StructureConstant& c : algebra.constants) {
    const long value = common / c.denominator * c.numerator;
    bracket[c.i][c.j].emplace_back(c.k, value);
    bracket[c.j][c.i].emplace_back(c.k, -value);
  }
  return bracket;
}

/// The coefficients of {x_i, F} for all i, as equations for those of F; each once.
std::set<Equation> equations_for(const LieAlgebra& algebra,
                                 const std::vector<GeneratorProduct>& unknowns) {
  const auto bracket = integer_brackets(algebra);
  std::set<Equation> result;
  for (std::size_t i = 0; i < algebra.dimension; ++i) {
    std::map<GeneratorProduct, std::map<std::size_t, long>> rows;
    for (std::size_t u = 0; u < unknowns.size(); ++u) {
      for (std::size_t place = 0; place < unknowns[u].size(); ++place) {
        for (const auto& [k, value] : bracket[i][unknowns[u][place]]) {
          GeneratorProduct image = unknowns[u];
          image[place] = k;
          std::ranges::sort(image);
          rows[image][u] += value;
        }
      }
    }
    for (const auto& [monomial, row] : rows) {
      Equation equation;
      std::ranges::copy_if(row, std::back_inserter(equation),
                           [](const auto& term) { return term.second != 0; });
      if (!equation.empty()) result.insert(equation);
    }
  }
  return result;
}

/// The unknowns in groups that no equation connects, which can be solved for one by one.
std::vector<std::vector<std::size_t>> groups_of(std::size_t unknowns,
                                                const std::set<Equation>& equations) {
  std::vector<std::size_t> parent(unknowns);
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&](std::size_t u) {
    while (parent[u] != u) u = parent[u] = parent[parent[u]];
    return u;
  };
  for (const Equation& equation : equations) {
    for (const auto& [u, value] : equation) {
      const std::size_t a = root(equation.front().first), b = root(u);
      parent[std::max(a, b)] = std::min(a, b);
    }
  }
  std::map<std::size_t, std::vector<std::size_t>> groups;
  for (std::size_t u = 0; u < unknowns; ++u) groups[root(u)].push_back(u);
  std::vector<std::vector<std::size_t>> result;
  for (auto& [first, group] : groups) result.push_back(std::move(group));
  return result;
}

/// The rows of a matrix in reduced echelon form, each without a common factor.
std::vector<IntegerForm> tidy_rows(IntegerMatrix& rows, std::size_t count,
                                   const std::vector<GeneratorProduct>& monomials) {
  fmpz_t number;
  fmpz_init(number);
  fmpz_mat_rref(rows.get(), number, rows.get());
  std::vector<IntegerForm> result;
  bool fits = true;
  for (std::size_t i = 0; i < count; ++i) {
    fmpz_zero(number);
    for (std::size_t j = 0; j < monomials.size(); ++j) fmpz_gcd(number, number, rows.at(i, j));
    IntegerForm form;
    for (std::size_t j = 0; j < monomials.size(); ++j) {
      if (fmpz_is_zero(rows.at(i, j))) continue;
      if (form.empty() && fmpz_sgn(rows.at(i, j)) < 0) fmpz_neg(number, number);
      fmpz_divexact(rows.at(i, j), rows.at(i, j), number);
      fits = fits && fmpz_fits_si(rows.at(i, j)) != 0;
      form.emplace_back(monomials[j], fits ? fmpz_get_si(rows.at(i, j)) : 0);
    }
    result.push_back(std::move(form));
  }
  fmpz_clear(number);
  if (!fits) throw ModelError("a coefficient of an invariant form does not fit a word");
  return result;
}

/// The forms in some of the monomials that solve the equations which are about these.
std::vector<IntegerForm> solutions(const std::vector<std::size_t>& group,
                                   const std::vector<Equation>& equations,
                                   const std::vector<GeneratorProduct>& unknowns) {
  const std::size_t n = group.size();
  IntegerMatrix system(equations.size(), n), kernel(n, n), rows(n, n);
  for (std::size_t i = 0; i < equations.size(); ++i) {
    for (const auto& [u, value] : equations[i]) {
      const auto column = std::ranges::lower_bound(group, u) - group.begin();
      fmpz_set_si(system.at(i, static_cast<std::size_t>(column)), value);
    }
  }
  const slong dimension = fmpz_mat_nullspace(kernel.get(), system.get());
  fmpz_mat_transpose(rows.get(), kernel.get());
  std::vector<GeneratorProduct> monomials;
  for (const std::size_t u : group) monomials.push_back(unknowns[u]);
  return tidy_rows(rows, static_cast<std::size_t>(dimension), monomials);
}

bool starts_with_a_power(const IntegerForm& form) {
  const GeneratorProduct& first = form.front().first;
  return first.front() == first.back();
}

IntegerForm product(const IntegerForm& a, const IntegerForm& b) {
  std::map<GeneratorProduct, long> terms;
  for (const auto& [x, p] : a) {
    for (const auto& [y, q] : b) {
      GeneratorProduct both = x;
      both.insert(both.end(), y.begin(), y.end());
      std::ranges::sort(both);
      terms[both] += p * q;
    }
  }
  return {terms.begin(), terms.end()};
}

/// Which of the forms no earlier ones combine to.
std::vector<std::size_t> independent(const std::vector<IntegerForm>& forms) {
  std::map<GeneratorProduct, std::size_t> row_of;
  for (const IntegerForm& form : forms) {
    for (const auto& [monomial, value] : form) row_of.try_emplace(monomial, row_of.size());
  }
  RationalMatrix matrix(row_of.size(), std::vector<cln::cl_RA>(forms.size(), 0));
  for (std::size_t j = 0; j < forms.size(); ++j) {
    for (const auto& [monomial, value] : forms[j]) matrix[row_of.at(monomial)][j] = value;
  }
  return independent_columns(matrix);
}

}  // namespace

std::vector<IntegerForm> invariant_forms(const LieAlgebra& algebra, std::size_t degree) {
  std::vector<GeneratorProduct> unknowns;
  GeneratorProduct start;
  append_monomials(algebra.dimension, degree, start, unknowns);
  const std::set<Equation> equations = equations_for(algebra, unknowns);
  const auto groups = groups_of(unknowns.size(), equations);
  std::vector<std::size_t> group_of(unknowns.size());
  for (std::size_t g = 0; g < groups.size(); ++g) {
    for (const std::size_t u : groups[g]) group_of[u] = g;
  }
  std::vector<std::vector<Equation>> by_group(groups.size());
  for (const Equation& equation : equations)
    by_group[group_of[equation.front().first]].push_back(equation);
  std::vector<IntegerForm> result;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    for (IntegerForm& form : solutions(groups[g], by_group[g], unknowns))
      result.push_back(std::move(form));
  }
  std::stable_partition(result.begin(), result.end(), starts_with_a_power);
  return result;
}

std::vector<IntegerForm> invariant_forms_to_degree_two(const LieAlgebra& algebra) {
  std::vector<IntegerForm> result = invariant_forms(algebra, 1);
  std::vector<IntegerForm> quadratic;
  for (std::size_t i = 0; i < result.size(); ++i) {
    for (std::size_t j = i; j < result.size(); ++j)
      quadratic.push_back(product(result[i], result[j]));
  }
  const std::size_t products = quadratic.size();
  for (IntegerForm& form : invariant_forms(algebra, 2)) quadratic.push_back(std::move(form));
  for (const std::size_t i : independent(quadratic)) {
    if (i >= products) result.push_back(quadratic[i]);
  }
  return result;
}

}  // namespace casimir
