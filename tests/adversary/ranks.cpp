#include "tests/adversary/ranks.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace casimir::adversary {

std::size_t rank(std::vector<std::vector<Ball>> rows) {
  const std::size_t height = rows.size(), width = rows.empty() ? 0 : rows.front().size();
  std::size_t done = 0;
  for (; done < std::min(height, width); ++done) {
    std::size_t row = height, column = width;
    double largest = -1;
    for (std::size_t i = done; i < height; ++i) {
      for (std::size_t j = done; j < width; ++j) {
        const double size = std::fabs(rows[i][j].as_double());
        if (!rows[i][j].is_nonzero() || size <= largest) continue;
        largest = size;
        row = i;
        column = j;
      }
    }
    if (row == height) break;
    std::swap(rows[done], rows[row]);
    for (auto& r : rows) std::swap(r[done], r[column]);
    for (std::size_t i = done + 1; i < height; ++i) {
      const Ball factor = rows[i][done] / rows[done][done];
      for (std::size_t j = done; j < width; ++j)
        rows[i][j] = j == done ? Ball() : rows[i][j] - factor * rows[done][j];
    }
  }
  for (std::size_t i = done; i < height; ++i) {
    for (std::size_t j = done; j < width; ++j) {
      if (!rows[i][j].is_tiny()) throw Unknown();
    }
  }
  return done;
}

std::size_t largest_involutive(const Case& claim, const At& at) {
  const std::vector<Expr> functions = functions_of(claim, false);
  const std::size_t n = functions.size();
  std::vector<std::vector<Ball>> flows;
  std::vector<unsigned> commutes(n);
  for (const Expr& f : functions) flows.push_back(at.flow(f));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      if (i == j || at.bracket(functions[i], functions[j]).is_tiny()) commutes[i] |= 1U << j;
    }
  }
  std::size_t best = 0;
  for (unsigned set = 1; set < (1U << n); set += 2) {
    std::vector<std::vector<Ball>> rows;
    bool involutive = true;
    for (std::size_t i = 0; i < n; ++i) {
      if ((set >> i & 1U) == 0) continue;
      involutive = involutive && (set & ~commutes[i]) == 0;
      rows.push_back(flows[i]);
    }
    if (involutive && rank(rows) == rows.size()) best = std::max(best, rows.size());
  }
  return best;
}

}  // namespace casimir::adversary
