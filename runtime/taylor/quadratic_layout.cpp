// The lanes for the products of a quadratic right-hand side of few states.
#include "runtime/taylor/quadratic_layout.hpp"

#include <algorithm>
#include <utility>

namespace casimir {
namespace {

constexpr int kEmpty = -1;

/// Which product stands in which lane.
class Layout {
 public:
  Layout(const QuadraticForm& form, int width)
      : form_(form),
        width_(width),
        registers_(std::max(1, (static_cast<int>(form.products.size()) + width - 1) / width)),
        slots_(static_cast<std::size_t>(registers_ * width), kEmpty) {
    begin();
    improve();
  }

  int registers() const { return registers_; }
  int product_at(int reg, int lane) const {
    return slots_[static_cast<std::size_t>(reg * width_ + lane)];
  }

  double factor(int product, int rate) const {
    return form_.products[static_cast<std::size_t>(product)].factor[static_cast<std::size_t>(rate)];
  }

  /// Lanes of a register whose products rate i needs and does not find in its own lane.
  std::vector<int> elsewhere(int reg, int i) const {
    std::vector<int> lanes;
    for (int lane = 0; lane < width_; ++lane) {
      const int product = product_at(reg, lane);
      if (product != kEmpty && lane != i && factor(product, i) != 0) lanes.push_back(lane);
    }
    return lanes;
  }

 private:
  /// Every product in the lane of a rate that needs it, as far as there is room.
  void begin() {
    std::vector<int> rest;
    for (int p = 0; p < static_cast<int>(form_.products.size()); ++p) {
      if (!place_in_own_lane(p)) rest.push_back(p);
    }
    for (const int p : rest) *std::find(slots_.begin(), slots_.end(), kEmpty) = p;
  }

  bool place_in_own_lane(int product) {
    for (int i = 0; i < form_.states; ++i) {
      if (factor(product, i) == 0) continue;
      for (int reg = 0; reg < registers_; ++reg) {
        int& slot = slots_[static_cast<std::size_t>(reg * width_ + i)];
        if (slot != kEmpty) continue;
        slot = product;
        return true;
      }
    }
    return false;
  }

  /// Moves that all rates together need, then products out of place.
  std::pair<int, int> cost() const {
    int moves = 0, away = 0;
    for (int reg = 0; reg < registers_; ++reg) {
      int most = 0;
      for (int i = 0; i < form_.states; ++i) {
        const int count = static_cast<int>(elsewhere(reg, i).size());
        most = std::max(most, count);
        away += count;
      }
      moves += most;
    }
    return {moves, away};
  }

  /// Swaps two lanes as long as that helps.
  void improve() {
    std::pair<int, int> best = cost();
    for (bool better = true; better && best.first > 0;) {
      better = false;
      for (std::size_t a = 0; a < slots_.size(); ++a) {
        for (std::size_t b = a + 1; b < slots_.size(); ++b) {
          std::swap(slots_[a], slots_[b]);
          if (const auto now = cost(); now < best) {
            best = now;
            better = true;
          } else {
            std::swap(slots_[a], slots_[b]);
          }
        }
      }
    }
  }

  const QuadraticForm& form_;
  int width_;
  int registers_;
  std::vector<int> slots_;
};

void lay_out_products(const QuadraticForm& form, const Layout& layout, int width,
                      casimir_quadratic& tables) {
  tables.products = layout.registers();
  for (int reg = 0; reg < layout.registers(); ++reg) {
    for (int lane = 0; lane < width; ++lane) {
      const int p = layout.product_at(reg, lane);
      if (p == kEmpty) continue;
      const QuadraticForm::Product& product = form.products[static_cast<std::size_t>(p)];
      tables.left[reg][lane] = product.first;
      tables.right[reg][lane] = product.second;
      if (lane < form.states) tables.own[reg][lane] = layout.factor(p, lane);
    }
  }
}

void lay_out_moves(const QuadraticForm& form, const Layout& layout, casimir_quadratic& tables) {
  for (int reg = 0; reg < layout.registers(); ++reg) {
    for (int i = 0; i < form.states; ++i) {
      int e = 0;
      for (const int lane : layout.elsewhere(reg, i)) {
        casimir_move& move = tables.move[reg][e++];
        move.from[i] = lane;
        move.factor[i] = layout.factor(layout.product_at(reg, lane), i);
      }
      tables.moves[reg] = std::max(tables.moves[reg], e);
    }
  }
}

/// The entries of the Jacobian in each row, those of one state on the same diagonal where possible.
void lay_out_jacobian(const QuadraticForm& form, casimir_quadratic& tables) {
  const auto n = static_cast<std::size_t>(form.states);
  for (std::size_t i = 0; i < n; ++i) {
    int d = 0;
    for (std::size_t j = 0; j < n; ++j) {
      std::vector<std::pair<int, double>> parts;  // the states in entry (i, j)
      for (const QuadraticForm::Product& product : form.products) {
        const double factor = product.factor[i];
        if (factor == 0) continue;
        const int state = static_cast<int>(j);
        if (product.first == state && product.second == state)
          parts.emplace_back(state, 2 * factor);
        else if (product.first == state)
          parts.emplace_back(product.second, factor);
        else if (product.second == state)
          parts.emplace_back(product.first, factor);
      }
      if (parts.empty() && form.linear[i][j] == 0) continue;
      tables.column[d][i] = static_cast<long long>(j);
      tables.fixed[d][i] = form.linear[i][j];
      for (std::size_t q = 0; q < parts.size(); ++q) {
        tables.part[d][q].from[i] = parts[q].first;
        tables.part[d][q].factor[i] = parts[q].second;
      }
      tables.parts[d] = std::max(tables.parts[d], static_cast<int>(parts.size()));
      tables.diagonals = std::max(tables.diagonals, ++d);
    }
  }
  tables.diagonals = std::max(2, (tables.diagonals + 1) / 2 * 2);
}

}  // namespace

std::optional<casimir_quadratic> narrow_tables(const QuadraticForm& form) {
  const int width = form.states <= 4 ? 4 : CASIMIR_LANES;
  const std::size_t room = static_cast<std::size_t>(width * CASIMIR_MOST_PRODUCTS);
  if (form.states > CASIMIR_LANES || form.products.size() > room) return std::nullopt;
  casimir_quadratic tables = {};
  tables.states = form.states;
  std::copy(form.constant.begin(), form.constant.end(), tables.constant);
  const Layout layout(form, width);
  lay_out_products(form, layout, width, tables);
  lay_out_moves(form, layout, tables);
  lay_out_jacobian(form, tables);
  return tables;
}

}  // namespace casimir
