// The lanes for the products of a quadratic right-hand side whose states fill several registers.
#include <algorithm>
#include <map>
#include <stdexcept>
#include <string>

#include "runtime/quadratic_layout.hpp"

namespace casimir {
namespace {

constexpr int kEmpty = -1;

/// Which product stands in which lane: where possible in that of a rate that needs it, and in a
/// register with others that the same register of rates needs.
std::vector<int> slots_of_products(const QuadraticForm& form, int width, int registers) {
  const auto count = static_cast<int>(form.products.size());
  std::vector<std::vector<std::pair<int, int>>> lanes(static_cast<std::size_t>(width));
  std::vector<int> rest;
  // Those that only one lane needs come first: others can give way.
  std::vector<std::pair<int, int>> order;
  std::vector<std::vector<int>> needed_by(form.products.size());
  for (int p = 0; p < count; ++p) {
    std::vector<int>& rates = needed_by[static_cast<std::size_t>(p)];
    for (int i = 0; i < form.states; ++i) {
      if (form.products[static_cast<std::size_t>(p)].factor[static_cast<std::size_t>(i)] != 0)
        rates.push_back(i);
    }
    order.emplace_back(static_cast<int>(rates.size()), p);
  }
  std::sort(order.begin(), order.end());
  for (const auto& [needs, p] : order) {
    int best = kEmpty;
    std::size_t least = static_cast<std::size_t>(registers);
    for (const int i : needed_by[static_cast<std::size_t>(p)]) {
      const std::size_t used = lanes[static_cast<std::size_t>(i % width)].size();
      if (used < least) {
        least = used;
        best = i;
      }
    }
    if (best == kEmpty)
      rest.push_back(p);
    else
      lanes[static_cast<std::size_t>(best % width)].emplace_back(best / width, p);
  }
  std::vector<int> slots(static_cast<std::size_t>(registers * width), kEmpty);
  for (int lane = 0; lane < width; ++lane) {
    auto& wanted = lanes[static_cast<std::size_t>(lane)];
    std::sort(wanted.begin(), wanted.end());
    for (std::size_t m = 0; m < wanted.size(); ++m)
      slots[m * static_cast<std::size_t>(width) + static_cast<std::size_t>(lane)] =
          wanted[m].second;
  }
  for (const int p : rest) *std::find(slots.begin(), slots.end(), kEmpty) = p;
  return slots;
}

}  // namespace

/// Fills the tables.
class WideLayout {
 public:
  WideLayout(const QuadraticForm& form, WideTables& tables)
      : form_(form),
        tables_(tables),
        width_(tables.width_),
        slots_(slots_of_products(form, tables.width_, tables.registers_)) {}

  void run() {
    lay_out_products();
    tables_.own_begin_ = {0};
    tables_.moved_begin_ = {0};
    for (int b = 0; b < tables_.blocks_; ++b) lay_out_rates(b);
  }

 private:
  /// The number of a source, counted through all registers of sources, and its factor in a rate.
  struct Term {
    int number;
    double factor;
  };

  static std::size_t index(int i) { return static_cast<std::size_t>(i); }

  void lay_out_products() {
    tables_.left_.resize(slots_.size());
    tables_.right_.resize(slots_.size());
    for (std::size_t slot = 0; slot < slots_.size(); ++slot) {
      if (slots_[slot] == kEmpty) continue;
      const QuadraticForm::Product& product = form_.products[index(slots_[slot])];
      tables_.left_.data()[slot] = product.first;
      tables_.right_.data()[slot] = product.second;
    }
  }

  std::vector<Term> terms_of(int rate) const {
    std::vector<Term> terms;
    for (std::size_t slot = 0; slot < slots_.size(); ++slot) {
      if (slots_[slot] == kEmpty) continue;
      const double factor = form_.products[index(slots_[slot])].factor[index(rate)];
      if (factor != 0) terms.push_back({static_cast<int>(slot), factor});
    }
    for (int j = 0; j < form_.states; ++j) {
      const double factor = form_.linear[index(rate)][index(j)];
      if (factor != 0) terms.push_back({tables_.registers_ * width_ + j, factor});
    }
    return terms;
  }

  /// The terms of one register of rates.
  void lay_out_rates(int b) {
    std::map<int, std::vector<double>> own;         // by source
    std::vector<std::vector<Term>> away(index(width_));  // for each lane
    for (int lane = 0; lane < width_ && b * width_ + lane < form_.states; ++lane) {
      for (const Term& term : terms_of(b * width_ + lane)) {
        if (term.number % width_ == lane) {
          std::vector<double>& factors = own[term.number / width_];
          factors.resize(index(width_));
          factors[index(lane)] = term.factor;
        } else {
          away[index(lane)].push_back(term);
        }
      }
    }
    for (const auto& [source, factors] : own) {
      tables_.own_source_.push_back(source);
      tables_.own_factor_.append(factors);
    }
    if (own.size() % 2 == 1) {
      tables_.own_source_.push_back(own.begin()->first);
      tables_.own_factor_.append(std::vector<double>(index(width_)));
    }
    tables_.own_begin_.push_back(static_cast<int>(tables_.own_source_.size()));
    if (width_ == 8)
      move_by_source(away);
    else
      move_from_anywhere(away);
    if (tables_.moved_source_.size() % 2 == 1)
      add_move(tables_.moved_source_.back(), std::vector<Term>(index(width_)));
    tables_.moved_begin_.push_back(static_cast<int>(tables_.moved_source_.size()));
  }

  /// One move has lanes of one source only.
  void move_by_source(const std::vector<std::vector<Term>>& away) {
    std::map<int, std::vector<std::vector<Term>>> by_source;
    for (int lane = 0; lane < width_; ++lane) {
      for (const Term& term : away[index(lane)]) {
        auto& lanes = by_source[term.number / width_];
        lanes.resize(index(width_));
        lanes[index(lane)].push_back({term.number % width_, term.factor});
      }
    }
    for (const auto& [source, lanes] : by_source) add_moves(source, lanes);
  }

  void move_from_anywhere(const std::vector<std::vector<Term>>& away) { add_moves(0, away); }

  void add_moves(int source, const std::vector<std::vector<Term>>& lanes) {
    std::size_t most = 0;
    for (const auto& terms : lanes) most = std::max(most, terms.size());
    for (std::size_t e = 0; e < most; ++e) {
      std::vector<Term> move(index(width_), Term{0, 0});
      for (int lane = 0; lane < width_; ++lane) {
        if (e < lanes[index(lane)].size()) move[index(lane)] = lanes[index(lane)][e];
      }
      add_move(source, move);
    }
  }

  void add_move(int source, const std::vector<Term>& move) {
    std::vector<long long> from;
    std::vector<double> factor;
    for (const Term& term : move) {
      from.push_back(term.number);
      factor.push_back(term.factor);
    }
    tables_.moved_source_.push_back(source);
    tables_.moved_from_.append(from);
    tables_.moved_factor_.append(factor);
  }

  const QuadraticForm& form_;
  WideTables& tables_;
  const int width_;
  const std::vector<int> slots_;
};

template <class Number>
void WideTables::Registers<Number>::append(const std::vector<Number>& lanes) {
  resize(used_ + lanes.size());
  std::copy(lanes.begin(), lanes.end(), data() + used_);
  used_ += lanes.size();
}

WideTables::WideTables(const QuadraticForm& form, int width)
    : states_(form.states), width_(width), blocks_((form.states + width - 1) / width) {
  if (form.states > CASIMIR_WIDE_STATES || form.products.size() > CASIMIR_WIDE_PRODUCTS)
    throw std::invalid_argument("there are no tables for " + std::to_string(form.states) +
                                " states and " + std::to_string(form.products.size()) +
                                " products");
  registers_ = (static_cast<int>(form.products.size()) + width - 1) / width;
  for (const auto& row : form.linear)
    linear_ = linear_ || std::any_of(row.begin(), row.end(), [](double f) { return f != 0; });
  constant_.resize(static_cast<std::size_t>(blocks_ * width));
  std::copy(form.constant.begin(), form.constant.end(), constant_.data());
  WideLayout(form, *this).run();
}

casimir_wide WideTables::view() const {
  return {.states = states_,
          .width = width_,
          .blocks = blocks_,
          .registers = registers_,
          .linear = linear_,
          .left = left_.data(),
          .right = right_.data(),
          .constant = constant_.data(),
          .own_begin = own_begin_.data(),
          .own_source = own_source_.data(),
          .own_factor = own_factor_.data(),
          .moved_begin = moved_begin_.data(),
          .moved_from = moved_from_.data(),
          .moved_factor = moved_factor_.data(),
          .moved_source = moved_source_.data()};
}

}  // namespace casimir
