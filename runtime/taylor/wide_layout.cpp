// The lanes for the products of a quadratic right-hand side whose states fill several registers.
#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "runtime/taylor/quadratic_layout.hpp"

namespace casimir {
namespace {

constexpr int kEmptyLane = -1;

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
    int best = kEmptyLane;
    std::size_t least = static_cast<std::size_t>(registers);
    for (const int i : needed_by[static_cast<std::size_t>(p)]) {
      const std::size_t used = lanes[static_cast<std::size_t>(i % width)].size();
      if (used < least) {
        least = used;
        best = i;
      }
    }
    if (best == kEmptyLane)
      rest.push_back(p);
    else
      lanes[static_cast<std::size_t>(best % width)].emplace_back(best / width, p);
  }
  std::vector<int> slots(static_cast<std::size_t>(registers * width), kEmptyLane);
  for (int lane = 0; lane < width; ++lane) {
    auto& wanted = lanes[static_cast<std::size_t>(lane)];
    std::sort(wanted.begin(), wanted.end());
    for (std::size_t m = 0; m < wanted.size(); ++m)
      slots[m * static_cast<std::size_t>(width) + static_cast<std::size_t>(lane)] =
          wanted[m].second;
  }
  for (const int p : rest) *std::find(slots.begin(), slots.end(), kEmptyLane) = p;
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
    if (few()) tables_.dense_.resize(index(tables_.registers_ * tables_.blocks_ * width_));
    tables_.linear_begin_ = tables_.own_begin_ = tables_.moved_begin_ = {0};
    for (int b = 0; b < tables_.blocks_; ++b) {
      lay_out_linear(b);
      lay_out_own(b);
      lay_out_moved(b);
    }
  }

 private:
  /// A state or product by its number, or a lane, and its factor in a rate.
  struct Term {
    int number = 0;
    double factor = 0;
  };
  using Lanes = std::vector<std::vector<Term>>;  ///< the terms that each lane of a register needs

  static std::size_t index(int i) { return static_cast<std::size_t>(i); }

  /// Whether the kernel has code of its own for so few registers.
  bool few() const {
    return tables_.registers_ > 0 && tables_.registers_ <= CASIMIR_WIDE_FEW &&
           tables_.blocks_ <= CASIMIR_WIDE_BLOCKS;
  }

  void lay_out_products() {
    tables_.left_.resize(slots_.size());
    tables_.right_.resize(slots_.size());
    for (std::size_t slot = 0; slot < slots_.size(); ++slot) {
      const bool empty = slots_[slot] == kEmptyLane;
      tables_.left_.data()[slot] = state_index(empty ? 0 : product_in(slot).first);
      tables_.right_.data()[slot] = state_index(empty ? 0 : product_in(slot).second);
    }
  }

  const QuadraticForm::Product& product_in(std::size_t slot) const {
    return form_.products[index(slots_[slot])];
  }

  /// What register b of the rates takes of the product in a slot: nothing beyond the last rate.
  double factor(std::size_t slot, int b, int lane) const {
    const int rate = b * width_ + lane;
    if (slots_[slot] == kEmptyLane || rate >= form_.states) return 0;
    return product_in(slot).factor[index(rate)];
  }

  /// The form of an index that `gathered` takes.
  long long state_index(int state) const {
    if (width_ != 4 || tables_.blocks_ > 3) return state;
    constexpr std::uint64_t kRegister[] = {0, std::uint64_t{1} << 63, std::uint64_t{1} << 62};
    return static_cast<long long>(static_cast<std::uint64_t>(lane_index(state % 4)) |
                                  kRegister[state / 4]);
  }

  /// The form of an index that `permuted_by` takes.
  long long lane_index(int lane) const {
    const long long low = 2LL * lane;
    return width_ == 4 ? low | (low + 1) << 32 : lane;
  }

  void lay_out_linear(int b) {
    Lanes lanes(index(width_));
    for (int lane = 0; lane < width_ && b * width_ + lane < form_.states; ++lane) {
      const std::vector<double>& row = form_.linear[index(b * width_ + lane)];
      for (int j = 0; j < form_.states; ++j)
        if (row[index(j)] != 0) lanes[index(lane)].push_back({j, row[index(j)]});
    }
    for (const std::vector<Term>& entry : entries_of(lanes)) {
      std::vector<long long> states;
      for (const Term& term : entry) states.push_back(state_index(term.number));
      tables_.linear_state_.append(states);
      tables_.linear_factor_.append(factors_of(entry));
    }
    tables_.linear_begin_.push_back(tables_.linear_factor_.count() / width_);
  }

  /// The products that stand in the lanes of the rates that need them.
  void lay_out_own(int b) {
    for (int m = 0; m < tables_.registers_; ++m) {
      std::vector<double> factors;
      for (int lane = 0; lane < width_; ++lane)
        factors.push_back(factor(index(m * width_ + lane), b, lane));
      if (std::all_of(factors.begin(), factors.end(), [](double f) { return f == 0; })) continue;
      if (few())
        std::copy(factors.begin(), factors.end(),
                  tables_.dense_.data() + (m * tables_.blocks_ + b) * width_);
      else
        add_own(m, factors);
    }
    if (tables_.own_from_.size() % 2 == 1)
      add_own(tables_.own_from_.back(), std::vector<double>(index(width_)));
    tables_.own_begin_.push_back(static_cast<int>(tables_.own_from_.size()));
  }

  void add_own(int m, const std::vector<double>& factors) {
    tables_.own_from_.push_back(m);
    tables_.own_factor_.append(factors);
  }

  /// The others: from one register at a time, or with two lanes from anywhere.
  void lay_out_moved(int b) {
    Lanes from_anywhere(index(width_));
    for (int m = 0; m < tables_.registers_; ++m) {
      Lanes lanes(index(width_));
      for (int lane = 0; lane < width_; ++lane) {
        for (int from = 0; from < width_; ++from) {
          const int slot = m * width_ + from;
          const double f = factor(index(slot), b, lane);
          if (f == 0 || from == lane) continue;
          lanes[index(lane)].push_back({from, f});
          from_anywhere[index(lane)].push_back({slot, f});
        }
      }
      if (width_ > 2) add_moves(m, lanes);
    }
    if (width_ == 2) add_moves(0, from_anywhere);
    if (tables_.moved_from_.size() % 2 == 1)
      add_move(tables_.moved_from_.back(), std::vector<Term>(index(width_)));
    tables_.moved_begin_.push_back(static_cast<int>(tables_.moved_from_.size()));
  }

  void add_moves(int m, const Lanes& lanes) {
    for (const std::vector<Term>& entry : entries_of(lanes)) add_move(m, entry);
  }

  void add_move(int m, const std::vector<Term>& entry) {
    std::vector<long long> lanes;
    for (const Term& term : entry) lanes.push_back(lane_index(term.number));
    tables_.moved_from_.push_back(m);
    tables_.moved_lane_.append(lanes);
    tables_.moved_factor_.append(factors_of(entry));
  }

  /// The terms of all lanes, one of each at a time; the factor 0 where a lane has no more.
  static std::vector<std::vector<Term>> entries_of(const Lanes& lanes) {
    std::vector<std::vector<Term>> entries;
    for (std::size_t lane = 0; lane < lanes.size(); ++lane) {
      for (std::size_t e = 0; e < lanes[lane].size(); ++e) {
        if (e == entries.size()) entries.emplace_back(lanes.size());
        entries[e][lane] = lanes[lane][e];
      }
    }
    return entries;
  }

  static std::vector<double> factors_of(const std::vector<Term>& entry) {
    std::vector<double> factors;
    for (const Term& term : entry) factors.push_back(term.factor);
    return factors;
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
  if (form.states > CASIMIR_WIDE_STATES || form.products.size() > CASIMIR_WIDE_PRODUCTS ||
      (width > 2 && blocks_ < 2))
    throw std::invalid_argument("there are no tables for " + std::to_string(form.states) +
                                " states and " + std::to_string(form.products.size()) +
                                " products");
  registers_ = (static_cast<int>(form.products.size()) + width - 1) / width;
  constant_.resize(static_cast<std::size_t>(blocks_) * static_cast<std::size_t>(width));
  std::copy(form.constant.begin(), form.constant.end(), constant_.data());
  WideLayout(form, *this).run();
}

casimir_wide WideTables::view() const {
  return {.states = states_,
          .width = width_,
          .blocks = blocks_,
          .registers = registers_,
          .left = left_.data(),
          .right = right_.data(),
          .constant = constant_.data(),
          .dense = dense_.data(),
          .linear_begin = linear_begin_.data(),
          .linear_state = linear_state_.data(),
          .linear_factor = linear_factor_.data(),
          .own_begin = own_begin_.data(),
          .own_from = own_from_.data(),
          .own_factor = own_factor_.data(),
          .moved_begin = moved_begin_.data(),
          .moved_from = moved_from_.data(),
          .moved_lane = moved_lane_.data(),
          .moved_factor = moved_factor_.data()};
}

}  // namespace casimir
