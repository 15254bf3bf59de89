#include "symbolic/structure/relate/linear_family.hpp"

#include <stdexcept>

namespace casimir::structure {
namespace {

void subtract_row(LinearFamily::Row& row, const LinearFamily::Row& other,
                  const cln::cl_RA& factor) {
  for (const auto& [column, number] : other) {
    cln::cl_RA& sum = row.try_emplace(column, 0).first->second;
    sum = sum - factor * number;
    if (cln::zerop(sum)) row.erase(column);
  }
}

}  // namespace

bool LinearFamily::add(Row row, cln::cl_RA right) {
  for (const auto& [unknown, known] : solved_) {
    const auto own = row.find(unknown);
    if (own == row.end()) continue;
    const cln::cl_RA factor = own->second;
    row.erase(own);
    subtract_row(row, known.row, factor);
    right = right - factor * known.right;
  }
  if (row.empty()) return cln::zerop(right);
  const auto [pivot, leading] = *row.begin();
  row.erase(row.begin());
  for (auto& [column, number] : row) number = number / leading;
  right = right / leading;
  for (auto& [unknown, known] : solved_) {
    const auto own = known.row.find(pivot);
    if (own == known.row.end()) continue;
    const cln::cl_RA factor = own->second;
    known.row.erase(own);
    subtract_row(known.row, row, factor);
    known.right = known.right - factor * right;
  }
  solved_.emplace(pivot, Solved{std::move(row), right});
  return true;
}

std::vector<std::size_t> LinearFamily::free() const {
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < unknowns_; ++i)
    if (!solved_.contains(i)) result.push_back(i);
  return result;
}

std::pair<cln::cl_RA, LinearFamily::Row> LinearFamily::value(std::size_t unknown) const {
  const auto own = solved_.find(unknown);
  if (own == solved_.end()) return {0, {{unknown, 1}}};
  Row row = own->second.row;
  for (auto& [column, number] : row) number = -number;
  return {own->second.right, std::move(row)};
}

RationalMatrix null_space(const RationalMatrix& rows, std::size_t columns) {
  LinearFamily family(columns);
  for (const auto& row : rows) {
    LinearFamily::Row sparse;
    for (std::size_t i = 0; i < columns; ++i)
      if (!cln::zerop(row[i])) sparse.emplace(i, row[i]);
    family.add(std::move(sparse), 0);
  }
  RationalMatrix result;
  for (const std::size_t f : family.free()) {
    result.emplace_back(columns, 0);
    for (std::size_t i = 0; i < columns; ++i) {
      const auto [constant, row] = family.value(i);
      if (const auto own = row.find(f); own != row.end()) result.back()[i] = own->second;
    }
  }
  return result;
}

RationalMatrix product(const RationalMatrix& a, const RationalMatrix& b) {
  const std::size_t columns = b.empty() ? 0 : b[0].size();
  RationalMatrix result(a.size(), std::vector<cln::cl_RA>(columns, 0));
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t k = 0; k < b.size(); ++k) {
      if (cln::zerop(a[i][k])) continue;
      for (std::size_t j = 0; j < columns; ++j)
        if (!cln::zerop(b[k][j])) result[i][j] = result[i][j] + a[i][k] * b[k][j];
    }
  }
  return result;
}

RationalMatrix transposed(const RationalMatrix& a) {
  RationalMatrix result(a.empty() ? 0 : a[0].size(), std::vector<cln::cl_RA>(a.size(), 0));
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < a[i].size(); ++j) result[j][i] = a[i][j];
  return result;
}

RationalMatrix inverse(const RationalMatrix& a) {
  RationalMatrix columns;
  for (std::size_t j = 0; j < a.size(); ++j) {
    RationalMatrix equations = a;
    for (std::size_t i = 0; i < a.size(); ++i) equations[i].push_back(i == j ? 1 : 0);
    const auto column = solve_unique(equations);
    if (!column) throw std::invalid_argument("a singular matrix has no inverse");
    columns.push_back(*column);
  }
  return transposed(columns);
}

}  // namespace casimir::structure
