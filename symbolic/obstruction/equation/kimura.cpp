#include "symbolic/obstruction/equation/kimura.hpp"

#include <cln/integer.h>
#include <cln/rational.h>
#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "symbolic/algebra/number_text.hpp"
#include "symbolic/obstruction/equation/univariate.hpp"

namespace casimir::obstruction {
namespace {

using cln::cl_RA;

bool is_integer(const cl_RA& value) { return cln::denominator(value) == 1; }
bool is_odd(const cl_RA& value) { return is_integer(value) && cln::oddp(cln::numerator(value)); }
bool is_half(const cl_RA& value) { return cln::denominator(value) == 2; }

/// A row of Schwarz's list, as numerator and denominator; each entry plus an integer, whose sum has
/// to be even in some rows. The first row, of two halves and anything, is `two_halves` below.
struct Row {
  int number;
  std::array<std::pair<int, int>, 3> entries;
  bool even;
};

constexpr Row kSchwarz[] = {
    {2, {{{1, 2}, {1, 3}, {1, 3}}}, false},  {3, {{{2, 3}, {1, 3}, {1, 3}}}, true},
    {4, {{{1, 2}, {1, 3}, {1, 4}}}, false},  {5, {{{2, 3}, {1, 4}, {1, 4}}}, true},
    {6, {{{1, 2}, {1, 3}, {1, 5}}}, false},  {7, {{{2, 5}, {1, 3}, {1, 3}}}, true},
    {8, {{{2, 3}, {1, 5}, {1, 5}}}, true},   {9, {{{1, 2}, {2, 5}, {1, 5}}}, false},
    {10, {{{3, 5}, {1, 3}, {1, 5}}}, true},  {11, {{{2, 5}, {2, 5}, {2, 5}}}, true},
    {12, {{{2, 3}, {1, 3}, {1, 5}}}, true},  {13, {{{4, 5}, {1, 5}, {1, 5}}}, true},
    {14, {{{1, 2}, {2, 5}, {1, 3}}}, false}, {15, {{{3, 5}, {2, 5}, {1, 3}}}, true},
};

/// A number as a rational multiple of the root of a representative of its square class.
struct Root {
  std::size_t group = 0;  ///< 0: rational
  cl_RA multiple;
};

std::array<Root, 3> roots_of(const SquaredDifferences& squares) {
  std::array<Root, 3> result;
  std::vector<cl_RA> representatives{1};
  for (std::size_t i = 0; i < 3; ++i) {
    std::size_t group = 0;
    for (; group < representatives.size(); ++group)
      if (square_root(squares[i] / representatives[group])) break;
    if (group == representatives.size()) representatives.push_back(squares[i]);
    result[i] = {group, *square_root(squares[i] / representatives[group])};
  }
  return result;
}

/// An odd integer among the sums of the differences with signs; one sign may be fixed.
std::optional<cl_RA> odd_sum(const std::array<Root, 3>& roots) {
  for (int signs = 0; signs < 4; ++signs) {
    std::array<cl_RA, 4> sums{0, 0, 0, 0};
    for (std::size_t i = 0; i < 3; ++i) {
      const bool negative = i < 2 && (signs >> i & 1) != 0;
      sums[roots[i].group] =
          sums[roots[i].group] + (negative ? -roots[i].multiple : roots[i].multiple);
    }
    if (is_odd(sums[0]) &&
        std::all_of(sums.begin() + 1, sums.end(), [](const cl_RA& s) { return cln::zerop(s); }))
      return sums[0];
  }
  return std::nullopt;
}

bool two_halves(const std::array<Root, 3>& roots) {
  return std::count_if(roots.begin(), roots.end(),
                       [](const Root& r) { return r.group == 0 && is_half(r.multiple); }) >= 2;
}

bool in_row(const Row& row, const std::array<cl_RA, 3>& values) {
  std::array<std::size_t, 3> order{0, 1, 2};
  do {
    for (int signs = 0; signs < 8; ++signs) {
      cl_RA sum = 0;
      bool integers = true;
      for (std::size_t i = 0; i < 3 && integers; ++i) {
        const cl_RA value = (signs >> i & 1) != 0 ? -values[order[i]] : values[order[i]];
        const cl_RA rest = value - cl_RA(row.entries[i].first) / row.entries[i].second;
        integers = is_integer(rest);
        sum = sum + rest;
      }
      if (integers && (!row.even || !is_odd(sum))) return true;
    }
  } while (std::next_permutation(order.begin(), order.end()));
  return false;
}

}  // namespace

std::optional<std::string> kimura(const SquaredDifferences& squares) {
  const std::array<Root, 3> roots = roots_of(squares);
  if (const auto sum = odd_sum(roots))
    return fmt::format("a sum of the differences is the odd integer {}", rational_text(*sum));
  if (two_halves(roots)) return "Schwarz's list, row 1";
  std::array<cl_RA, 3> values;
  for (std::size_t i = 0; i < 3; ++i) {
    if (roots[i].group != 0) return std::nullopt;
    values[i] = roots[i].multiple;
  }
  for (const Row& row : kSchwarz)
    if (in_row(row, values)) return fmt::format("Schwarz's list, row {}", row.number);
  return std::nullopt;
}

}  // namespace casimir::obstruction
