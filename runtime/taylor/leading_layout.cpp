#include "runtime/taylor/leading_layout.hpp"

#include <algorithm>

namespace casimir {
namespace {

std::size_t place_of(int i) { return static_cast<std::size_t>(i); }

double entry(const std::vector<double>& numbers, std::size_t i) {
  return numbers.empty() ? 0 : numbers[i];
}

}  // namespace

LeadingTables::LeadingTables(const QuadraticForm& form, int width)
    : states_(form.states), width_(width), blocks_((form.states + width - 1) / width) {
  for (int b = 0; b < blocks_; ++b) {
    linear_begin_.push_back(static_cast<int>(linear_state_.size()) / width_);
    product_begin_.push_back(static_cast<int>(product_left_.size()) / width_);
    add_constants(form, b);
    add_linear(form, b);
    add_products(form, b);
  }
  linear_begin_.push_back(static_cast<int>(linear_state_.size()) / width_);
  product_begin_.push_back(static_cast<int>(product_left_.size()) / width_);
}

/// One term of each lane at a time.
std::vector<std::vector<LeadingTables::Term>> LeadingTables::rows_of(
    const std::vector<std::vector<Term>>& lanes) const {
  std::size_t most = 0;
  for (const auto& terms : lanes) most = std::max(most, terms.size());
  std::vector<std::vector<Term>> rows(most, std::vector<Term>(place_of(width_), Term{0, 0, 0, 0}));
  for (std::size_t lane = 0; lane < lanes.size(); ++lane)
    for (std::size_t e = 0; e < lanes[lane].size(); ++e) rows[e][lane] = lanes[lane][e];
  return rows;
}

void LeadingTables::add_factors(const std::vector<Term>& lanes, std::vector<double>& rows) const {
  for (const Term& term : lanes) rows.push_back(term.factor);
  for (const Term& term : lanes) rows.push_back(term.rest);
}

void LeadingTables::add_constants(const QuadraticForm& form, int block) {
  std::vector<Term> lanes(place_of(width_));
  for (int i = 0; i < width_ && block * width_ + i < states_; ++i) {
    const std::size_t rate = place_of(block * width_ + i);
    lanes[place_of(i)] = {0, -1, form.constant[rate], entry(form.constant_rest, rate)};
  }
  add_factors(lanes, constant_);
}

void LeadingTables::add_linear(const QuadraticForm& form, int block) {
  std::vector<std::vector<Term>> lanes(place_of(width_));
  for (int i = 0; i < width_ && block * width_ + i < states_; ++i) {
    const std::size_t rate = place_of(block * width_ + i);
    for (int j = 0; j < states_; ++j) {
      const double factor = form.linear[rate][place_of(j)];
      const double rest = form.linear_rest.empty() ? 0 : form.linear_rest[rate][place_of(j)];
      if (factor != 0) lanes[place_of(i)].push_back({j, -1, factor, rest});
    }
  }
  for (const std::vector<Term>& row : rows_of(lanes)) {
    add_factors(row, linear_factor_);
    for (const Term& term : row) linear_state_.push_back(term.first);
  }
}

void LeadingTables::add_products(const QuadraticForm& form, int block) {
  std::vector<std::vector<Term>> lanes(place_of(width_));
  for (int i = 0; i < width_ && block * width_ + i < states_; ++i) {
    const std::size_t rate = place_of(block * width_ + i);
    for (const QuadraticForm::Product& p : form.products)
      if (p.factor[rate] != 0)
        lanes[place_of(i)].push_back({p.first, p.second, p.factor[rate], entry(p.rest, rate)});
  }
  for (const std::vector<Term>& row : rows_of(lanes)) {
    add_factors(row, product_factor_);
    for (const Term& term : row) {
      product_left_.push_back(term.first);
      product_right_.push_back(term.second);
    }
  }
}

casimir_leading_tables LeadingTables::view() const {
  return {.states = states_,
          .width = width_,
          .blocks = blocks_,
          .constant = constant_.data(),
          .linear_begin = linear_begin_.data(),
          .product_begin = product_begin_.data(),
          .linear_factor = linear_factor_.data(),
          .product_factor = product_factor_.data(),
          .linear_state = linear_state_.data(),
          .product_left = product_left_.data(),
          .product_right = product_right_.data()};
}

}  // namespace casimir
