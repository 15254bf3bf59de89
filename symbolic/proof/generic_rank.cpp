#include "symbolic/proof/generic_rank.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <map>

#include "symbolic/proof/special_parameters.hpp"
#include "symbolic/proof/thin_domain.hpp"

namespace casimir {

std::pair<std::vector<std::size_t>, std::vector<std::size_t>> regular_minor(
    RealPoint& point, const PolynomialRows& matrix, std::size_t size) {
  std::vector<std::size_t> rows;
  PolynomialRows chosen;
  for (std::size_t i = 0; i < matrix.size() && rows.size() < size; ++i) {
    chosen.push_back(matrix[i]);
    if (point.rank(chosen) == chosen.size())
      rows.push_back(i);
    else
      chosen.pop_back();
  }
  std::vector<std::size_t> columns;
  PolynomialRows transposed;
  for (std::size_t j = 0; j < matrix[0].size() && columns.size() < size; ++j) {
    transposed.emplace_back();
    for (const std::size_t i : rows) transposed.back().push_back(matrix[i][j]);
    if (point.rank(transposed) == transposed.size())
      columns.push_back(j);
    else
      transposed.pop_back();
  }
  return {rows, columns};
}

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

/// The candidates that are orthogonal to all rows at the point, as far as its values tell, which
/// are taken once for each vector.
std::vector<const KernelCandidate*> likely_kernel(const PolynomialRows& rows,
                                                  const std::vector<KernelCandidate>& candidates,
                                                  RealPoint& point) {
  std::vector<RealPoint::Values> at_rows;
  for (const auto& row : rows) at_rows.push_back(point.values(row));
  std::vector<const KernelCandidate*> likely;
  for (const KernelCandidate& candidate : candidates) {
    const RealPoint::Values own = point.values(candidate.vector);
    if (std::all_of(at_rows.begin(), at_rows.end(),
                    [&](const auto& row) { return point.may_be_orthogonal(row, own); }))
      likely.push_back(&candidate);
  }
  return likely;
}

/// Whether `count` of the candidates are in the kernel of all rows and independent at the point.
bool kernel_has(Prover& prover, const PolynomialRows& rows,
                const std::vector<KernelCandidate>& candidates, RealPoint& point,
                std::size_t count) {
  const FunctionRing& ring = prover.ring();
  const auto orthogonal = [&](const KernelCandidate& candidate, std::size_t i) {
    if (candidate.orthogonal) return candidate.orthogonal(i);
    SumOfProducts sum(ring.ring());
    for (std::size_t j = 0; j < rows[i].size(); ++j) sum.add(rows[i][j], candidate.vector[j]);
    return prover.is_zero(sum.finish());
  };
  // What is not orthogonal at the point need not be multiplied out.
  const auto likely = likely_kernel(rows, candidates, point);
  if (likely.size() < count) return false;
  PolynomialRows independent;
  for (const KernelCandidate* candidate : likely) {
    if (independent.size() == count) break;
    independent.push_back(candidate->vector);
    bool belongs = point.rank(independent) == independent.size();
    for (std::size_t i = 0; i < rows.size() && belongs; ++i) belongs = orthogonal(*candidate, i);
    if (!belongs) independent.pop_back();
  }
  return independent.size() == count;
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

bool bordered_minors_vanish(Prover& prover, const PolynomialRows& rows, RealPoint& point,
                            std::size_t size) {
  if (!prover.has_no_zero_divisors(rows)) return false;
  auto [r, c] = regular_minor(point, rows, size);
  if (r.size() != size || c.size() != size) return false;
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

/// The rank at the points of one piece: the largest, or where each point stands for itself alone,
/// the smallest. `best` becomes the point.
std::size_t rank_on(PiecePoints::Piece& piece, const PolynomialRows& rows, std::size_t* best,
                    std::string* uneven) {
  std::vector<std::size_t> ranks;
  for (RealPoint& point : piece.points) ranks.push_back(point.rank(rows));
  const auto [least, most] = std::minmax_element(ranks.begin(), ranks.end());
  if (!piece.rigid && *least != *most)
    *uneven =
        fmt::format("the rank is {} at {}, but {} at {}", *least,
                    piece.points[static_cast<std::size_t>(least - ranks.begin())].text(), *most,
                    piece.points[static_cast<std::size_t>(most - ranks.begin())].text());
  const auto chosen = piece.rigid ? most : least;
  *best = static_cast<std::size_t>(chosen - ranks.begin());
  return *chosen;
}

bool is_constant(const PolynomialRows& rows) {
  return std::all_of(rows.begin(), rows.end(), [](const auto& row) {
    return std::all_of(row.begin(), row.end(), [](const Polynomial& p) { return p.is_constant(); });
  });
}

std::size_t rank_of_constants(const PolynomialRows& rows, std::size_t variables) {
  const std::vector<cln::cl_RA> anywhere(variables, 0);
  Rows values;
  for (const auto& row : rows) {
    values.emplace_back();
    for (const Polynomial& p : row) values.back().push_back(p.evaluate(anywhere));
  }
  return rank(values);
}

constexpr std::size_t kPointsOfPiece = 4;  // of a piece
constexpr std::size_t kManyPoints = 24;    // where pieces have to be found

}  // namespace

PiecePoints::PiecePoints(Prover& prover, const std::vector<Polynomial>& functions)
    : prover_(prover) {
  const FunctionRing::Pieces what = prover.ring().pieces(functions);
  if (what.switches.empty() && what.rigid) {
    if (auto point = draw()) pieces_.emplace_back().points.push_back(std::move(*point));
  } else {
    sort_by_signs(what);
  }
  if (pieces_.empty() || !thin_domain(prover)) return;
  for (Piece& piece : pieces_) piece.rigid = false;
  where_ = "around " + pieces_[0].points[0].text() + (where_.empty() ? "" : ", " + where_);
}

std::optional<RealPoint> PiecePoints::draw() {
  const FunctionRing& ring = prover_.ring();
  if (!ring.is_polynomial()) return prover_.real_points().random(prover_.domain());
  const auto point = prover_.random_point({});
  if (!point) return prover_.real_points().any({});
  std::vector<GiNaC::ex> coordinates;
  for (std::size_t i = 0; i < ring.symbols().size(); ++i)
    coordinates.emplace_back(GiNaC::numeric((*point)[i]));
  return prover_.real_points().at(std::move(coordinates));
}

bool PiecePoints::add_point() {
  if (pieces_.size() != 1 || pieces_[0].points.size() >= kPointsOfPiece) return false;
  auto point = draw();
  if (!point) return false;
  pieces_[0].points.push_back(std::move(*point));
  return true;
}

void PiecePoints::sort_by_signs(const FunctionRing::Pieces& what) {
  std::map<std::vector<int>, Piece> found;
  for (std::size_t k = 0; k < kManyPoints; ++k) {
    // Where all of the points have to do, none may be special by accident.
    auto point = what.rigid ? draw() : prover_.real_points().generic(prover_.domain(), k);
    if (!point) break;
    std::vector<int> signs;
    try {
      for (const Polynomial& p : what.switches) signs.push_back(point->value(p).sign().value_or(0));
    } catch (const NotCertified&) {
      continue;
    }
    if (std::find(signs.begin(), signs.end(), 0) != signs.end()) continue;
    Piece& piece = found[signs];
    piece.rigid = what.rigid;
    if (!what.rigid || piece.points.size() < kPointsOfPiece)
      piece.points.push_back(std::move(*point));
  }
  std::vector<std::string> parts;
  for (auto& [signs, piece] : found) {
    std::vector<std::string> conditions;
    for (std::size_t i = 0; i < signs.size(); ++i)
      conditions.push_back(prover_.ring().text(what.switches[i]) +
                           (signs[i] > 0 ? " > 0" : " < 0"));
    parts.push_back(fmt::format("{}", fmt::join(conditions, " and ")));
    pieces_.push_back(std::move(piece));
  }
  if (pieces_.empty()) return;
  if (!what.rigid) {
    where_ = "on the connected part, around " + pieces_[0].points[0].text() +
             ", of where all its functions are analytic";
  } else if (found.size() < std::size_t{1} << std::min<std::size_t>(what.switches.size(), 20)) {
    where_ = fmt::format("{}", fmt::join(parts, ", or "));
  }
}

std::string text_of(const std::vector<RealPoint>& points) {
  std::vector<std::string> texts;
  constexpr std::size_t kMost = 4;
  for (std::size_t i = 0; i < std::min(points.size(), kMost); ++i)
    texts.push_back(points[i].text());
  return fmt::format("{}{}", fmt::join(texts, "; and at "), points.size() > kMost ? "; .." : "");
}

std::optional<GenericRank> generic_rank(
    Prover& prover, const PolynomialRows& rows,
    const std::function<std::vector<KernelCandidate>()>& kernel) {
  const std::size_t columns = rows.empty() ? 0 : rows[0].size();
  const std::size_t full = std::min(rows.size(), columns);
  if (is_constant(rows)) {
    GenericRank result;
    result.rank = rank_of_constants(rows, prover.ring().ring().size());
    result.exact = true;
    return result;
  }
  std::vector<Polynomial> entries;
  for (const auto& row : rows) entries.insert(entries.end(), row.begin(), row.end());
  PiecePoints found(prover, entries);
  if (found.pieces().empty()) return std::nullopt;
  const bool skew = is_skew(rows);
  std::optional<std::vector<KernelCandidate>> candidates;
  GenericRank result;
  result.where = found.where();
  try {
    for (bool first = true; first || (!result.exact && found.add_point()); first = false) {
      result.exact = true;
      result.points.clear();
      std::vector<std::size_t> ranks;
      for (PiecePoints::Piece& piece : found.pieces()) {
        std::size_t best = 0;
        ranks.push_back(rank_on(piece, rows, &best, &result.uneven));
        const std::size_t rank = ranks.back();
        bool exact = rank == full || (skew && rank + 1 == full);
        if (!exact && kernel) {
          if (!candidates) candidates = kernel();
          exact = kernel_has(prover, rows, *candidates, piece.points[best], columns - rank);
        }
        result.exact = result.exact && exact;
        result.points.push_back(piece.points[best]);
      }
      const auto [least, most] = std::minmax_element(ranks.begin(), ranks.end());
      result.rank = *least;
      if (*least != *most)
        result.uneven = fmt::format(
            "the rank is {} at {}, but {} at {}", *least,
            result.points[static_cast<std::size_t>(least - ranks.begin())].text(), *most,
            result.points[static_cast<std::size_t>(most - ranks.begin())].text());
    }
    if (!result.exact && result.uneven.empty()) {
      result.exact = std::all_of(result.points.begin(), result.points.end(), [&](RealPoint& point) {
        return bordered_minors_vanish(prover, rows, point, result.rank);
      });
    }
    if (!result.uneven.empty()) result.exact = false;
  } catch (const NotCertified&) {
    return std::nullopt;
  }
  return result;
}

std::optional<GenericRank> rank_with_conditions(
    Prover& prover, const PolynomialRows& rows,
    const std::function<std::vector<KernelCandidate>()>& kernel) {
  std::optional<GenericRank> result = generic_rank(prover, rows, kernel);
  if (result) result->nonzero = needed_parameters(prover, rows, result->rank);
  return result;
}

std::optional<GenericRank> gradient_rank(Prover& prover, const std::vector<Polynomial>& functions) {
  PolynomialRows rows;
  for (const Polynomial& f : functions) rows.push_back(prover.gradient(f));
  // {f, g} = -{g, f}: each bracket is looked at once.
  std::map<std::pair<std::size_t, std::size_t>, bool> commute;
  return generic_rank(prover, rows, [&] {
    std::vector<KernelCandidate> candidates;
    if (!prover.model().poisson) {
      if (prover.has_motion()) candidates.push_back({prover.field()});
      return candidates;
    }
    for (std::size_t j = 0; j < rows.size(); ++j) {
      const std::vector<Polynomial> flow = prover.flow_of(rows[j]);
      candidates.push_back({flow, [&, j, flow](std::size_t i) {
                              if (i == j) return true;
                              const auto pair = std::minmax(i, j);
                              const auto known = commute.find(pair);
                              if (known != commute.end()) return known->second;
                              SumOfProducts sum(prover.ring().ring());
                              for (std::size_t k = 0; k < flow.size(); ++k)
                                sum.add(rows[i][k], flow[k]);
                              return commute[pair] = prover.is_zero(sum.finish());
                            }});
    }
    return candidates;
  });
}

}  // namespace casimir
