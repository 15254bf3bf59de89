#include "symbolic/generic_rank.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <numeric>

namespace casimir {
namespace {

using Rows = std::vector<std::vector<cln::cl_RA>>;
using Indices = std::vector<std::size_t>;

bool is_skew(const PolynomialRows& rows) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].size() != rows.size()) return false;
    for (std::size_t j = 0; j <= i; ++j) {
      if (!(rows[i][j] + rows[j][i]).is_zero()) return false;
    }
  }
  return true;
}

/// Whether `count` of the candidates are in the kernel of all rows and independent at the point.
bool kernel_has(const Prover& prover, const PolynomialRows& rows,
                const std::vector<KernelCandidate>& candidates, const GenericRank& found,
                const Rows& values, std::size_t count) {
  const FunctionRing& ring = prover.ring();
  const auto orthogonal = [&](const KernelCandidate& candidate, std::size_t i) {
    if (candidate.orthogonal) return candidate.orthogonal(i);
    SumOfProducts sum(ring.ring());
    for (std::size_t j = 0; j < rows[i].size(); ++j) sum.add(rows[i][j], candidate.vector[j]);
    return ring.numerator(sum.finish()).is_zero();
  };
  Rows independent;
  for (const KernelCandidate& candidate : candidates) {
    if (independent.size() == count) break;
    if (!have_values(prover, {candidate.vector})) continue;
    independent.push_back(values_at({candidate.vector}, found.point)[0]);
    // What is not orthogonal at the point need not be multiplied out.
    bool belongs = std::all_of(values.begin(), values.end(), [&](const auto& row) {
      const auto& v = independent.back();
      return cln::zerop(std::inner_product(row.begin(), row.end(), v.begin(), cln::cl_RA(0)));
    });
    belongs = belongs && rank(independent) == independent.size();
    for (std::size_t i = 0; i < rows.size() && belongs; ++i) belongs = orthogonal(candidate, i);
    if (!belongs) independent.pop_back();
  }
  return independent.size() == count;
}

/// Rows and columns of a regular minor of full rank.
std::pair<Indices, Indices> regular_minor(const Rows& values, std::size_t size) {
  Indices rows;
  Rows chosen;
  for (std::size_t i = 0; i < values.size() && rows.size() < size; ++i) {
    chosen.push_back(values[i]);
    if (rank(chosen) == chosen.size())
      rows.push_back(i);
    else
      chosen.pop_back();
  }
  Indices columns;
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

/// The minors of a matrix that border a regular one, by expansion row by row: the minors of the
/// first k rows for every choice of k columns are made from those of the first k - 1. No division,
/// which the relations of the ring might not allow.
class BorderedMinors {
 public:
  /// \param rows     without denominators
  /// \param regular  rows and columns of the regular minor
  BorderedMinors(const FunctionRing& ring, const PolynomialRows& rows,
                 const std::pair<Indices, Indices>& regular)
      : ring_(ring), rows_(rows), first_(regular.first), columns_(regular.second) {
    const auto terms = [&](std::size_t i) {
      std::size_t sum = 0;
      for (const Polynomial& p : rows[i]) sum += p.terms();
      return sum;
    };
    // The shortest first, so that the many minors of a middle size are short.
    std::sort(first_.begin(), first_.end(),
              [&](std::size_t a, std::size_t b) { return terms(a) < terms(b); });
  }

  /// Whether all of them vanish; also false where that would be too much work.
  bool vanish() {
    constexpr std::size_t kMaxSize = 8;
    if (first_.size() > kMaxSize) return false;
    for (std::size_t j = 0; j < rows_[0].size(); ++j) {
      if (std::find(columns_.begin(), columns_.end(), j) == columns_.end() && !vanish_with(j))
        return false;
    }
    return true;
  }

 private:
  using Columns = unsigned;  ///< a set of positions in `columns_`

  bool vanish_with(std::size_t extra) {
    columns_.push_back(extra);
    const Columns all = (1U << columns_.size()) - 1;
    minors_.assign(all + 1, Polynomial(ring_.ring()));
    minors_[0] = ring_.ring().constant(1);
    for (std::size_t k = 0; k < first_.size(); ++k) {
      for (Columns set = 0; set <= all; ++set) {
        if (static_cast<std::size_t>(std::popcount(set)) == k + 1)
          minors_[set] = expand(first_[k], set);
      }
    }
    bool vanish = work_ < kMaxWork;
    for (std::size_t i = 0; i < rows_.size() && vanish; ++i) {
      if (std::find(first_.begin(), first_.end(), i) != first_.end()) continue;
      vanish = ring_.numerator(expand(i, all)).is_zero() && work_ < kMaxWork;
    }
    columns_.pop_back();
    return vanish;
  }

  /// The minor with these columns whose last row is row i.
  Polynomial expand(std::size_t i, Columns set) {
    SumOfProducts sum(ring_.ring());
    for (std::size_t c = 0; c < columns_.size() && work_ < kMaxWork; ++c) {
      if ((set >> c & 1U) == 0) continue;
      const Polynomial& entry = rows_[i][columns_[c]];
      const Polynomial& minor = minors_[set & ~(1U << c)];
      if (entry.is_zero() || minor.is_zero()) continue;
      work_ += kWorkOfOne + static_cast<double>(entry.terms()) * static_cast<double>(minor.terms());
      const bool minus = std::popcount(set >> (c + 1)) % 2 == 1;
      if (work_ < kMaxWork) sum.add(minus ? -entry : entry, minor);
    }
    return ring_.reduced(sum.finish());
  }

  static constexpr double kMaxWork = 1e7;   ///< in products of two terms: some tenths of a second
  static constexpr double kWorkOfOne = 50;  ///< for even the shortest product of polynomials

  const FunctionRing& ring_;
  const PolynomialRows& rows_;
  Indices first_, columns_;
  std::vector<Polynomial> minors_;
  double work_ = 0;
};

bool bordered_minors_vanish(const Prover& prover, const PolynomialRows& rows, const Rows& values,
                            std::size_t size) {
  auto [r, c] = regular_minor(values, size);
  // The sets of columns are gone through once for each further column: let these be the fewer.
  const bool transpose = rows.size() < rows[0].size();
  PolynomialRows matrix;
  for (const auto& row : rows) matrix.push_back(prover.ring().common_numerators(row));
  if (transpose) {
    PolynomialRows columns(rows[0].size());
    for (auto& row : matrix) {
      for (std::size_t j = 0; j < row.size(); ++j) columns[j].push_back(std::move(row[j]));
    }
    matrix = std::move(columns);
    std::swap(r, c);
  }
  return BorderedMinors(prover.ring(), matrix, {r, c}).vanish();
}

}  // namespace

Rows values_at(const PolynomialRows& rows, const std::vector<cln::cl_RA>& point) {
  Rows result;
  for (const auto& row : rows) {
    result.emplace_back();
    for (const Polynomial& entry : row)
      result.back().push_back(entry.is_zero() ? 0 : entry.evaluate(point));
  }
  return result;
}

bool have_values(const Prover& prover, const PolynomialRows& rows) {
  return std::all_of(rows.begin(), rows.end(), [&](const auto& row) {
    return std::all_of(row.begin(), row.end(),
                       [&](const Polynomial& p) { return prover.ring().has_value(p); });
  });
}

std::optional<GenericRank> generic_rank(
    Prover& prover, const PolynomialRows& rows,
    const std::function<std::vector<KernelCandidate>()>& kernel) {
  if (!have_values(prover, rows)) return std::nullopt;
  constexpr int kPoints = 4;
  const std::size_t columns = rows.empty() ? 0 : rows[0].size();
  const std::size_t full = std::min(rows.size(), columns);
  const bool skew = is_skew(rows);
  std::optional<std::vector<KernelCandidate>> candidates;
  std::optional<GenericRank> best;
  Rows values;
  for (int k = 0; k < kPoints; ++k) {
    const auto point = prover.random_point({});
    if (!point) continue;
    Rows here = values_at(rows, *point);
    const std::size_t found = rank(here);
    if (best && found <= best->rank) continue;
    best = GenericRank{found, *point, found == full || (skew && found + 1 == full)};
    values = std::move(here);
    if (!best->exact && kernel) {
      if (!candidates) candidates = kernel();
      best->exact = kernel_has(prover, rows, *candidates, *best, values, columns - found);
    }
    if (best->exact) return best;
  }
  if (best) best->exact = bordered_minors_vanish(prover, rows, values, best->rank);
  return best;
}

std::optional<GenericRank> gradient_rank(Prover& prover, const std::vector<Polynomial>& functions) {
  PolynomialRows rows;
  for (const Polynomial& f : functions) rows.push_back(prover.gradient(f));
  return generic_rank(prover, rows, [&] {
    std::vector<KernelCandidate> candidates;
    if (prover.model().poisson) {
      for (const auto& slope : rows) candidates.push_back({prover.flow_of(slope)});
    } else {
      candidates.push_back({prover.field()});
    }
    return candidates;
  });
}

std::string point_text(const Prover& prover, const std::vector<cln::cl_RA>& point) {
  std::string text;
  for (const auto& [name, value] : prover.describe(point))
    text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", name, value);
  return text;
}

}  // namespace casimir
