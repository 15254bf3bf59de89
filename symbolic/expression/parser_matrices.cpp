// Expressions: matrices of families, their traces and entries.
#include "symbolic/expression/parser.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "symbolic/expression/indices.hpp"
#include "symbolic/expression/name_characters.hpp"
#include "symbolic/expression/notation.hpp"

namespace casimir {

using GiNaC::ex;

/// A square matrix, row by row, or a number: that has the size 0.
struct Parser::Matrix {
  long size = 0;
  std::vector<Quantity> entries;

  const Quantity& at(long i, long j) const {
    return entries[static_cast<std::size_t>((i - 1) * size + j - 1)];
  }
  /// The matrix with the entry of(i, j) at each place, from 1.
  template <class Entry>
  static Matrix of(long size, const Entry& entry) {
    Matrix result{size, {}};
    for (long i = 1; i <= size; ++i)
      for (long j = 1; j <= size; ++j) result.entries.push_back(entry(i, j));
    return result;
  }
};

Quantity Parser::trace(std::size_t start) {
  const Matrix matrix = matrix_argument("trace", start);
  Quantity total{0};
  GiNaC::exvector terms;
  for (long i = 1; i <= matrix.size; ++i) {
    const Quantity& q = matrix.at(i, i);
    terms.push_back(q.value);
    total.bits = std::max(total.bits, q.bits) + 1;
    total.degree = std::max(total.degree, q.degree);
    total.nodes += q.nodes;
    total.depth = std::max(total.depth, q.depth + 1);
  }
  total.value = evaluated(start, [&] { return ex(GiNaC::add(terms)); });
  return checked(total, start);
}

/// Row by row from the last one, by the minors of the rows below (Laplace): without divisions, and
/// of n rows with n*2^(n-1) products at most, fewer where entries are zero.
Quantity Parser::determinant(std::size_t start) {
  const Matrix matrix = matrix_argument("det", start);
  std::map<std::vector<long>, Quantity> minors{{{}, Quantity{1}}};
  for (long row = matrix.size; row >= 1; --row) {
    std::map<std::vector<long>, std::vector<std::pair<Quantity, Quantity>>> next;
    for (const auto& [columns, minor] : minors) {
      for (long column = 1; column <= matrix.size; ++column) {
        const auto place = std::lower_bound(columns.begin(), columns.end(), column);
        Quantity factor = matrix.at(row, column);
        if (factor.value.is_zero() || (place != columns.end() && *place == column)) continue;
        check(++repetitions_, &Limits::repetitions, start,
              "sums here write out more than {:.0f} terms");
        if ((place - columns.begin()) % 2 != 0) factor.value = -factor.value;
        std::vector<long> own = columns;
        own.insert(own.begin() + (place - columns.begin()), column);
        next[std::move(own)].emplace_back(std::move(factor), minor);
      }
    }
    minors.clear();
    for (const auto& [columns, pairs] : next)
      minors.emplace(columns, combined(pairs, false, start));
  }
  return minors.empty() ? Quantity{0} : minors.begin()->second;
}

Quantity Parser::entry(std::size_t start) {
  const Matrix matrix = matrix_argument("matrix", start);
  if (!accept('[')) unexpected("'[' and the place of an entry, as in matrix(A*B)[1, 2]");
  long place[2];
  for (long& k : place) {
    if (&k != place && !accept(',')) unexpected("',' and the column");
    peek();
    const std::size_t at = at_;
    k = integer("an index");
    if (k < 1 || k > matrix.size)
      fail_at(at, fmt::format("the matrix has the rows and columns 1 to {}", matrix.size));
  }
  if (!accept(']')) unexpected("']'");
  return matrix.at(place[0], place[1]);
}

Parser::Matrix Parser::matrix_argument(const char* function, std::size_t start) {
  const Depth depth(*this);
  if (!accept('(')) unexpected("'('");
  const std::optional<long> outside = std::exchange(component_, std::nullopt);
  Matrix matrix = matrix_sum();
  component_ = outside;
  if (!accept(')')) unexpected("an operator or ')'");
  if (matrix.size == 0)
    fail_at(start, fmt::format("{} is of a matrix, and this is a number", function),
            "a name A is a matrix where A11, A12, .. are declared, and A is not");
  return matrix;
}

Parser::Matrix Parser::matrix_sum() {
  const Depth depth(*this);
  Matrix total = matrix_product();
  for (char c = peek(); c == '+' || c == '-'; c = peek()) {
    const std::size_t offset = at_++;
    total = added(total, matrix_product(), c == '-', offset);
  }
  return total;
}

Parser::Matrix Parser::added(const Matrix& a, const Matrix& b, bool difference,
                             std::size_t offset) {
  if (a.size != b.size && (a.size == 0 || b.size == 0))
    fail_at(offset, "a matrix and a number are added", "the unit matrix is A^0");
  if (a.size != b.size)
    fail_at(offset, fmt::format("matrices of {} and {} rows are added", a.size, b.size));
  Matrix result{a.size, {}};
  for (std::size_t k = 0; k < a.entries.size(); ++k) {
    const Quantity &x = a.entries[k], &y = b.entries[k];
    Quantity q{difference ? x.value - y.value : x.value + y.value, std::max(x.bits, y.bits) + 1,
               std::max(x.degree, y.degree), x.nodes + y.nodes, std::max(x.depth, y.depth) + 1};
    result.entries.push_back(checked(q, offset));
  }
  return result;
}

Parser::Matrix Parser::matrix_product() {
  Matrix total = matrix_unary();
  for (char c = product_sign(); c != '\0'; c = product_sign()) {
    const std::size_t offset = at_;
    at_ += std::max<std::size_t>(1, 1 + latex_command(text_.value, at_).size());
    Matrix next = matrix_unary();
    if (c == '*') {
      total = multiplied(total, next, offset);
      continue;
    }
    if (next.size != 0) fail_at(offset, "this divides by a matrix");
    Quantity& divisor = next.entries.front();
    if (divisor.value.is_zero()) fail_at(offset, "division by zero");
    divisor.value = evaluated(offset, [&] { return ex(GiNaC::pow(divisor.value, -1)); });
    divisor.depth += 1;
    add_part(divisor.value);
    total = multiplied(total, next, offset);
  }
  return total;
}

Parser::Matrix Parser::multiplied(const Matrix& a, const Matrix& b, std::size_t offset) {
  if (a.size == 0 || b.size == 0) {
    const Matrix& matrix = a.size == 0 ? b : a;
    const Quantity& factor = a.size == 0 ? a.entries.front() : b.entries.front();
    Matrix result{matrix.size, {}};
    for (const Quantity& q : matrix.entries)
      result.entries.push_back(combined({{factor, q}}, false, offset));
    return result;
  }
  if (a.size != b.size)
    fail_at(offset, fmt::format("matrices of {} and {} rows are multiplied", a.size, b.size));
  return Matrix::of(a.size, [&](long i, long j) {
    std::vector<std::pair<Quantity, Quantity>> pairs;
    for (long k = 1; k <= a.size; ++k) {
      check(++repetitions_, &Limits::repetitions, offset,
            "sums here write out more than {:.0f} terms");
      pairs.emplace_back(a.at(i, k), b.at(k, j));
    }
    return combined(pairs, false, offset);
  });
}

Parser::Matrix Parser::matrix_unary() {
  const Depth depth(*this);
  peek();
  const std::size_t offset = at_;
  if (accept('-')) return multiplied({0, {Quantity{-1}}}, matrix_unary(), offset);
  if (accept('+')) return matrix_unary();
  return matrix_power();
}

Parser::Matrix Parser::matrix_power() {
  const Matrix base = matrix_primary();
  peek();
  const std::size_t offset = at_;
  if (base.size == 0 || !accept_power()) return base;
  peek();
  const std::size_t place = at_;
  const ex exponent = number_of(place, peek() == '{' ? braced() : unary()).value;
  check(GiNaC::is_a<GiNaC::numeric>(exponent) && exponent.info(GiNaC::info_flags::real)
            ? GiNaC::ex_to<GiNaC::numeric>(exponent).to_double()
            : 0,
        &Limits::degree, place, "the degree here exceeds {:.0f}");
  if (!exponent.info(GiNaC::info_flags::nonnegint))
    fail_at(place, "a power of a matrix has to be an integer that is not negative");
  Matrix result = Matrix::of(base.size, [](long i, long j) { return Quantity{i == j ? 1 : 0}; });
  for (long k = GiNaC::ex_to<GiNaC::numeric>(exponent).to_long(); k > 0; --k)
    result = multiplied(result, base, offset);
  return result;
}

Parser::Matrix Parser::matrix_primary() {
  const char c = peek();
  const std::size_t begin = at_;
  if (accept('(')) {
    Matrix inside = matrix_sum();
    if (!accept(')')) unexpected("an operator or ')'");
    if (inside.size != 0) return inside;
  } else if (accept('[')) {
    const Matrix a = matrix_sum();
    if (!accept(',')) unexpected("',' of a commutator [A, B]");
    const Matrix b = matrix_sum();
    if (!accept(']')) unexpected("']'");
    if (a.size == 0 || b.size == 0) fail_at(begin, "a commutator [A, B] is of two matrices");
    return added(multiplied(a, b, begin), multiplied(b, a, begin), true, begin);
  } else if (is_name_start(c)) {
    const std::string word = read_name(text_.value, at_, end_);
    if (names_.find(word) == nullptr) {
      if (peek() == '(') {
        if (word == "transpose") {
          const Matrix a = matrix_argument("transpose", begin);
          return Matrix::of(a.size, [&](long i, long j) { return a.at(j, i); });
        }
        if (word == "skew" || word == "symmetric") return of_triangle(word == "skew");
      } else if (peek() != '[' && names_.find(indexed_name(word, {1, 1})) != nullptr) {
        return of_family(word, begin);
      }
    }
  }
  // A number, with its power.
  at_ = begin;
  return {0, {number_of(begin, power())}};
}

Quantity Parser::member(const std::string& family, const std::vector<long>& places,
                        std::size_t start) {
  const std::string name = indexed_name(family, places);
  const Quantity* known = names_.find(name);
  if (known == nullptr)
    fail_at(start,
            fmt::format("the matrix '{}' has no entry {}", printable(family), printable(name)));
  add_parts_of(*known);
  return *known;
}

void Parser::refuse_vector(const std::string& family, std::size_t start) const {
  if (names_.find(indexed_name(family, {1})) != nullptr)
    fail_at(start, fmt::format("'{}' is a vector, and no matrix", printable(family)));
}

Parser::Matrix Parser::of_family(const std::string& family, std::size_t start) {
  const auto has = [&](long i, long j) {
    return names_.find(indexed_name(family, {i, j})) != nullptr;
  };
  refuse_vector(family, start);
  long size = 1;
  while (has(1, size + 1) || has(size + 1, 1)) ++size;
  return Matrix::of(size, [&](long i, long j) { return member(family, {i, j}, start); });
}

Parser::Matrix Parser::of_triangle(bool skew) {
  if (!accept('(')) unexpected("'('");
  peek();
  const std::size_t start = at_;
  if (at_ >= end_ || !is_name_start(text_.value[at_])) unexpected("the name of a family");
  const std::string family = read_name(text_.value, at_, end_);
  if (!accept(')')) unexpected("')'");
  refuse_vector(family, start);
  long size = 1;
  while (names_.find(indexed_name(family, {1, size + 1})) != nullptr) ++size;
  return Matrix::of(size, [&](long i, long j) {
    if (skew && i == j) return Quantity{0};
    Quantity q = member(family, {std::min(i, j), std::max(i, j)}, start);
    if (skew && i > j) q.value = -q.value;
    return q;
  });
}

}  // namespace casimir
