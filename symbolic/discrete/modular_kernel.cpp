#include "symbolic/discrete/modular_kernel.hpp"

#include <flint/nmod_mat.h>
#include <flint/nmod_poly.h>
#include <flint/nmod_poly_factor.h>

#include <algorithm>

#include "symbolic/search/modular/modular.hpp"

namespace casimir::discrete {
namespace {

/// FLINT's matrix over the prime field.
class Matrix {
 public:
  Matrix(std::size_t rows, std::size_t columns) {
    nmod_mat_init(value_, static_cast<slong>(rows), static_cast<slong>(columns), kPrime);
  }
  explicit Matrix(const std::vector<std::vector<Element>>& rows, std::size_t columns)
      : Matrix(rows.size(), columns) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
      for (std::size_t j = 0; j < columns; ++j) at(i, j) = rows[i][j];
    }
  }
  ~Matrix() { nmod_mat_clear(value_); }
  Matrix(const Matrix&) = delete;
  Matrix& operator=(const Matrix&) = delete;
  nmod_mat_struct* raw() { return value_; }
  Element& at(std::size_t i, std::size_t j) {
    return nmod_mat_entry(value_, static_cast<slong>(i), static_cast<slong>(j));
  }

 private:
  nmod_mat_t value_;
};

}  // namespace

std::vector<Element> values_at(const std::vector<Element>& point,
                               const search::Monomials& monomials) {
  const PrimeField field;
  std::vector<Element> result;
  for (std::size_t m = 0; m < monomials.size(); ++m) {
    Element product = 1;
    for (std::size_t i = 0; i < point.size(); ++i)
      product = field.multiply(product, field.power(point[i], monomials[m][i]));
    result.push_back(product);
  }
  return result;
}

std::vector<std::vector<Element>> echelon(const std::vector<std::vector<Element>>& rows,
                                          std::size_t columns) {
  Matrix matrix(rows, columns);
  const auto rank = static_cast<std::size_t>(nmod_mat_rref(matrix.raw()));
  std::vector<std::vector<Element>> result(rank);
  for (std::size_t i = 0; i < rank; ++i) {
    for (std::size_t j = 0; j < columns; ++j) result[i].push_back(matrix.at(i, j));
  }
  return result;
}

std::vector<std::vector<Element>> null_space(const std::vector<std::vector<Element>>& rows,
                                             std::size_t columns) {
  Matrix matrix(rows, columns);
  Matrix kernel(columns, columns);
  const auto nullity = static_cast<std::size_t>(nmod_mat_nullspace(kernel.raw(), matrix.raw()));
  std::vector<std::vector<Element>> vectors(nullity);
  for (std::size_t k = 0; k < nullity; ++k) {
    for (std::size_t j = 0; j < columns; ++j) vectors[k].push_back(kernel.at(j, k));
  }
  return vectors.empty() ? vectors : echelon(vectors, columns);
}

std::optional<std::vector<cln::cl_RA>> rationals_from(const std::vector<Element>& residues) {
  const cln::cl_I prime(static_cast<unsigned long>(kPrime));
  std::vector<cln::cl_RA> result;
  for (const Element residue : residues) {
    const auto value = search::rational_from(cln::cl_I(static_cast<unsigned long>(residue)), prime);
    if (!value) return std::nullopt;
    result.push_back(*value);
  }
  return result;
}

Eigenvalues common_eigenvalues(const std::vector<Pencil>& pencils) {
  nmod_poly_t common, own;
  nmod_poly_init(common, kPrime);
  nmod_poly_init(own, kPrime);
  for (const Pencil& pencil : pencils) {
    const std::size_t size = pencil.a.size();
    Matrix a(pencil.a, size), b(pencil.b, size), quotient(size, size);
    if (nmod_mat_solve(quotient.raw(), b.raw(), a.raw()) == 0) continue;
    nmod_mat_charpoly(own, quotient.raw());
    nmod_poly_gcd(common, common, own);
  }
  Eigenvalues result;
  if (nmod_poly_degree(common) > 0) {
    nmod_poly_factor_t roots;
    nmod_poly_factor_init(roots);
    nmod_poly_roots(roots, common, 1);
    slong in_field = 0;
    for (slong i = 0; i < roots->num; ++i) {
      const Element root = nmod_neg(nmod_poly_get_coeff_ui(roots->p + i, 0), common->mod);
      if (root != 0) result.numbers.push_back(root);
      in_field += roots->exp[i];
    }
    result.others = in_field < nmod_poly_degree(common);
    nmod_poly_factor_clear(roots);
  }
  nmod_poly_clear(own);
  nmod_poly_clear(common);
  return result;
}

}  // namespace casimir::discrete
