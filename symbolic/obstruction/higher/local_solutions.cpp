#include "symbolic/obstruction/higher/local_solutions.hpp"

#include <flint/fmpq_mat.h>

#include <algorithm>

#include "symbolic/algebra/flint_conversion.hpp"
#include "symbolic/obstruction/equation/kovacic.hpp"

namespace casimir::obstruction {
namespace {

/// The linear equations for the coefficients of orders -poles .. last, the highest order first, so
/// that a solution of the reduced echelon form begins at its free coefficient.
class Coefficients {
 public:
  Coefficients(const SeriesMatrix& a, long poles, long last)
      : a_(a), size_(static_cast<long>(a.size())), poles_(poles), last_(last) {
    for (const auto& row : a)
      for (const LaurentSeries& entry : row)
        if (!entry.vanishes()) order_ = std::max(order_, -entry.valuation());
    columns_ = (last_ + poles_ + 1) * size_;
    rows_ = (last_ + poles_ + 1) * size_;
    fmpq_mat_init(matrix_, rows_, columns_);
    fill();
    rank_ = fmpq_mat_rref(matrix_, matrix_);
  }
  ~Coefficients() { fmpq_mat_clear(matrix_); }
  Coefficients(const Coefficients&) = delete;
  Coefficients& operator=(const Coefficients&) = delete;

  /// The equations hold below this order.
  long end() const { return last_ - order_ + 1; }

  /// The solutions that begin first, as columns; fewer where there are fewer.
  SeriesMatrix solutions() const {
    std::vector<long> pivots;
    std::vector<bool> is_pivot(static_cast<std::size_t>(columns_), false);
    for (long i = 0; i < rank_; ++i) {
      long j = pivots.empty() ? 0 : pivots.back() + 1;
      while (fmpq_is_zero(fmpq_mat_entry(matrix_, i, j))) ++j;
      pivots.push_back(j);
      is_pivot[static_cast<std::size_t>(j)] = true;
    }
    SeriesMatrix result(static_cast<std::size_t>(size_));
    long count = 0;
    for (long free = columns_ - 1; free >= 0 && count < size_; --free) {
      if (is_pivot[static_cast<std::size_t>(free)]) continue;
      ++count;
      add_solution(free, pivots, result);
    }
    return result;
  }

 private:
  long column(long order, long unknown) const { return (last_ - order) * size_ + unknown; }

  /// The coefficients of t^e in x' - A x for e up to last - order_, where no higher ones enter.
  void fill() {
    for (long e = -poles_ - order_; e <= last_ - order_; ++e) {
      for (long i = 0; i < size_; ++i) {
        const long row = (e + poles_ + order_) * size_ + i;
        if (e + 1 >= -poles_) fmpq_set_si(fmpq_mat_entry(matrix_, row, column(e + 1, i)), e + 1, 1);
        for (long k = 0; k < size_; ++k)
          for (long l = -order_; l <= e + poles_; ++l) subtract(row, i, k, l, e - l);
      }
    }
  }

  void subtract(long row, long i, long k, long l, long order) {
    const LaurentSeries& entry = a_[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)];
    Rational own(entry.coefficient(l));
    fmpq* place = fmpq_mat_entry(matrix_, row, column(order, k));
    fmpq_sub(place, place, own.get());
  }

  void add_solution(long free, const std::vector<long>& pivots, SeriesMatrix& result) const {
    std::vector<Univariate> own(static_cast<std::size_t>(size_));
    const auto set = [&](long place, const fmpq* value) {
      fmpq_poly_set_coeff_fmpq(own[static_cast<std::size_t>(place % size_)].raw(),
                               last_ - place / size_ + poles_, value);
    };
    Rational one(cln::cl_RA(1)), value;
    set(free, one.get());
    for (std::size_t i = 0; i < pivots.size(); ++i) {
      fmpq_neg(value.get(), fmpq_mat_entry(matrix_, static_cast<long>(i), free));
      set(pivots[i], value.get());
    }
    for (std::size_t i = 0; i < own.size(); ++i)
      result[i].emplace_back(-poles_, std::move(own[i]), last_ + 1);
  }

  const SeriesMatrix& a_;
  long size_, poles_, last_, order_ = 1, columns_ = 0, rows_ = 0, rank_ = 0;
  fmpq_mat_t matrix_;
};

}  // namespace

std::optional<SeriesMatrix> laurent_solutions(const SeriesMatrix& a, long poles, long last) {
  const Coefficients equations(a, poles, last);
  SeriesMatrix phi = equations.solutions();
  if (phi.front().size() != a.size()) return std::nullopt;
  SeriesMatrix rest = a * phi;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < a.size(); ++j) {
      rest[i][j] = (rest[i][j] - phi[i][j].derivative()).below(equations.end());
      if (!rest[i][j].vanishes()) return std::nullopt;
    }
  long known = last;
  try {
    for (const auto& row : inverse(phi) * rest)
      for (const LaurentSeries& entry : row) known = std::min(known, entry.end());
  } catch (const NotDecided&) {
    return std::nullopt;  // they are not known to be independent
  }
  if (known < 0) return std::nullopt;
  for (auto& row : phi) {
    long least = last;
    for (const LaurentSeries& entry : row) least = std::min(least, entry.valuation());
    for (LaurentSeries& entry : row) entry = entry.below(least + known + 1);
  }
  return phi;
}

}  // namespace casimir::obstruction
