#include "symbolic/obstruction/homogeneous_table.hpp"

#include <cln/rational.h>
#include <fmt/format.h>

#include <set>
#include <vector>

#include "symbolic/algebra/number_text.hpp"
#include "symbolic/obstruction/equation/univariate.hpp"

namespace casimir::obstruction {
namespace {

using cln::cl_RA;

/// lambda = constant + factor*(start + step*p)^2.
struct TableRow {
  cl_RA constant, factor, start;
  int step;
};

cl_RA over(long numerator, long denominator) { return cl_RA(numerator) / denominator; }

std::vector<TableRow> rows_of(long k) {
  // p + p(p-1)k/2 and ((k-1)/k + p(p+1)k)/2 with completed squares.
  std::vector<TableRow> rows{{-over((k - 2) * (k - 2), 8 * k), over(k, 2), over(2 - k, 2 * k), 1},
                             {over(k - 1, 2 * k) - over(k, 8), over(k, 2), over(1, 2), 1}};
  const long sign = k < 0 ? -1 : 1;
  const auto add = [&](const cl_RA& constant, const cl_RA& factor, int start, int step) {
    rows.push_back({constant, sign * factor, start, step});
  };
  switch (k) {
    case 3:
    case -3: {
      const cl_RA constant = k > 0 ? over(-1, 24) : over(25, 24);
      add(constant, over(1, 6), 1, 3);
      add(constant, over(3, 32), 1, 4);
      add(constant, over(3, 50), 1, 5);
      add(constant, over(3, 50), 2, 5);
      break;
    }
    case 4:
    case -4:
      add(k > 0 ? over(-1, 8) : over(9, 8), over(2, 9), 1, 3);
      break;
    case 5:
    case -5:
      add(k > 0 ? over(-9, 40) : over(49, 40), over(5, 18), 1, 3);
      add(k > 0 ? over(-9, 40) : over(49, 40), over(1, 10), 2, 5);
      break;
    default:
      break;
  }
  return rows;
}

std::string described(const TableRow& row, const cl_RA& p) {
  return fmt::format("{} {} {}*({} + {}*p)^2 with p = {}", rational_text(row.constant),
                     cln::minusp(row.factor) ? '-' : '+', rational_text(cln::abs(row.factor)),
                     rational_text(row.start), row.step, rational_text(p));
}

}  // namespace

std::optional<std::string> integrable_eigenvalue(long k, const cl_RA& lambda) {
  if (k == 2 || k == -2) return "any, for degree 2 and -2";
  for (const TableRow& row : rows_of(k)) {
    const auto root = square_root((lambda - row.constant) / row.factor);
    if (!root) continue;
    for (const int sign : {1, -1}) {
      const cl_RA p = (sign * *root - row.start) / row.step;
      if (cln::denominator(p) == 1) return described(row, p);
    }
  }
  return std::nullopt;
}

std::array<cl_RA, 3> straight_line_differences(long k, const cl_RA& lambda) {
  const cl_RA degree = k;
  return {1 / (degree * degree), over(1, 4),
          ((degree - 2) * (degree - 2) + 8 * degree * lambda) / (4 * degree * degree)};
}

namespace {

/// The numbers lambda - 1 of the table between two bounds, but zero, in order. All rows grow with
/// (start + step*p)^2 for degrees above 2.
std::vector<cl_RA> entries(long k, const cl_RA& low, const cl_RA& high) {
  std::set<cl_RA> result;
  for (const TableRow& row : rows_of(k)) {
    for (const int direction : {1, -1}) {
      for (long p = direction > 0 ? 0 : -1;; p += direction) {
        const cl_RA root = row.start + cl_RA(row.step * p);
        const cl_RA value = row.constant + row.factor * root * root - 1;
        // Beyond the vertex the values grow.
        if (value > high && direction * root > 0) break;
        if (value >= low && value <= high && !cln::zerop(value)) result.insert(value);
      }
    }
  }
  return {result.begin(), result.end()};
}

/// Lists of numbers whose inverses add up: the negative ones first, then positive ones, each in
/// order.
class RelationSearch {
 public:
  explicit RelationSearch(long k) : k_(k), negative_(entries(k, -k, 0)) { negatives(0, -1); }
  std::vector<std::vector<cl_RA>> found;

 private:
  void negatives(std::size_t first, const cl_RA& rest) {
    const long left = k_ - static_cast<long>(list_.size());
    positives(left, rest, 0);
    if (left == 0) return;
    for (std::size_t i = first; i < negative_.size(); ++i) {
      list_.push_back(negative_[i]);
      negatives(i, rest - 1 / negative_[i]);
      list_.pop_back();
    }
  }

  /// `left` numbers of at least `least` whose inverses add up to the rest.
  void positives(long left, const cl_RA& rest, const cl_RA& least) {
    if (left == 0 && cln::zerop(rest)) found.push_back(list_);
    if (left == 0 || rest <= 0) return;
    const cl_RA low = 1 / rest;
    for (const cl_RA& value : entries(k_, low > least ? low : least, left / rest)) {
      list_.push_back(value);
      positives(left - 1, rest - 1 / value, value);
      list_.pop_back();
    }
  }

  long k_;
  std::vector<cl_RA> negative_, list_;
};

}  // namespace

std::vector<std::vector<cl_RA>> darboux_relation_solutions(long k) {
  return RelationSearch(k).found;
}

}  // namespace casimir::obstruction
