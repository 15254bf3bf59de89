#include "symbolic/generic_rank.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace casimir {
namespace {

constexpr int kPoints = 4;
constexpr std::size_t kMaxMinorTerms = 200000;

using Rows = std::vector<std::vector<cln::cl_RA>>;

Rows evaluate(const PolynomialRows& rows, const std::vector<cln::cl_RA>& point) {
  Rows result;
  for (const auto& row : rows) {
    result.emplace_back();
    for (const Polynomial& entry : row) result.back().push_back(entry.evaluate(point));
  }
  return result;
}

/// Rows and columns of a regular minor of full rank.
std::pair<std::vector<std::size_t>, std::vector<std::size_t>> regular_minor(const Rows& values,
                                                                            std::size_t size) {
  std::vector<std::size_t> rows;
  Rows chosen;
  for (std::size_t i = 0; i < values.size() && rows.size() < size; ++i) {
    chosen.push_back(values[i]);
    if (rank(chosen) == chosen.size())
      rows.push_back(i);
    else
      chosen.pop_back();
  }
  std::vector<std::size_t> columns;
  Rows transposed;
  for (std::size_t j = 0; j < values[0].size() && columns.size() < size; ++j) {
    transposed.emplace_back();
    for (const std::size_t i : rows) transposed.back().push_back(values[i][j]);
    if (rank(transposed) == transposed.size())
      columns.push_back(j);
    else
      transposed.pop_back();
  }
  return {rows, columns};
}

/// The determinant by expansion along the first row; empty when it grows too large.
std::optional<Polynomial> determinant(const PolynomialRows& rows, const std::vector<std::size_t>& r,
                                      const std::vector<std::size_t>& c) {
  if (r.size() == 1) return rows[r[0]][c[0]];
  Polynomial sum(rows[0][0].ring());
  const std::vector<std::size_t> rest_rows(r.begin() + 1, r.end());
  for (std::size_t k = 0; k < c.size(); ++k) {
    if (rows[r[0]][c[k]].is_zero()) continue;
    std::vector<std::size_t> rest_columns = c;
    rest_columns.erase(rest_columns.begin() + static_cast<std::ptrdiff_t>(k));
    const std::optional<Polynomial> minor = determinant(rows, rest_rows, rest_columns);
    if (!minor || minor->terms() * rows[r[0]][c[k]].terms() > kMaxMinorTerms) return std::nullopt;
    if (k % 2 == 0)
      sum += rows[r[0]][c[k]] * *minor;
    else
      sum -= rows[r[0]][c[k]] * *minor;
  }
  return sum;
}

bool bordered_minors_vanish(Prover& prover, const PolynomialRows& rows, const Rows& values,
                            std::size_t size) {
  constexpr std::size_t kMaxSize = 7;
  if (size >= kMaxSize) return false;
  const auto [r, c] = regular_minor(values, size);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (std::find(r.begin(), r.end(), i) != r.end()) continue;
    for (std::size_t j = 0; j < rows[0].size(); ++j) {
      if (std::find(c.begin(), c.end(), j) != c.end()) continue;
      std::vector<std::size_t> bordered_rows = r;
      std::vector<std::size_t> bordered_columns = c;
      bordered_rows.push_back(i);
      bordered_columns.push_back(j);
      const std::optional<Polynomial> minor = determinant(rows, bordered_rows, bordered_columns);
      if (!minor || !prover.ring().numerator(*minor).is_zero()) return false;
    }
  }
  return true;
}

}  // namespace

std::optional<GenericRank> generic_rank(Prover& prover, const PolynomialRows& rows) {
  for (const auto& row : rows) {
    for (const Polynomial& entry : row) {
      if (!prover.ring().has_value(entry)) return std::nullopt;
    }
  }
  std::optional<GenericRank> best;
  Rows values;
  const std::size_t full = rows.empty() ? 0 : std::min(rows.size(), rows[0].size());
  for (int k = 0; k < kPoints; ++k) {
    const auto point = prover.random_point({});
    if (!point) continue;
    Rows here = evaluate(rows, *point);
    const std::size_t found = rank(here);
    if (best && found <= best->rank) continue;
    best = GenericRank{found, *point, found == full};
    values = std::move(here);
    if (best->exact) return best;
  }
  if (best) best->exact = bordered_minors_vanish(prover, rows, values, best->rank);
  return best;
}

std::string point_text(const Prover& prover, const std::vector<cln::cl_RA>& point) {
  std::string text;
  for (const auto& [name, value] : prover.describe(point))
    text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", name, value);
  return text;
}

}  // namespace casimir
