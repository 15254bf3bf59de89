#include "symbolic/search/modular/grading.hpp"

#include <algorithm>
#include <cstdlib>
#include <optional>

#include "symbolic/algebra/rational_matrix.hpp"
#include "symbolic/search/modular/linear_map.hpp"

namespace casimir::search {
namespace {

std::size_t pivot_of(const std::vector<std::int64_t>& row) {
  const auto first = std::ranges::find_if(row, [](std::int64_t e) { return e != 0; });
  return static_cast<std::size_t>(first - row.begin());
}

std::int64_t floor_quotient(std::int64_t a, std::int64_t b) {
  const std::int64_t quotient = a / b;
  return a % b != 0 && (a < 0) != (b < 0) ? quotient - 1 : quotient;
}

void subtract(std::vector<std::int64_t>& row, std::int64_t factor,
              const std::vector<std::int64_t>& other) {
  for (std::size_t i = 0; i < row.size(); ++i) row[i] -= factor * other[i];
}

/// Which functions of a system the fields' rates and the relations of these are made of.
std::vector<bool> functions_of(const System& system, const Fields& fields) {
  std::vector<bool> used(system.ring().size(), false);
  std::vector<std::size_t> open = fields.places;
  const auto add = [&](const Polynomial& p) {
    for (std::size_t i = 0; i < used.size(); ++i)
      if (!system.is_constant()[i] && p.uses(i)) open.push_back(i);
  };
  for (const auto& rates : fields.plain)
    for (const Polynomial& rate : rates) add(rate);
  while (!open.empty()) {
    const std::size_t place = open.back();
    open.pop_back();
    if (used[place]) continue;
    used[place] = true;
    if (const std::optional<Polynomial> relation = system.relation_of(place)) add(*relation);
  }
  return used;
}

}  // namespace

Grading::Grading(const System& system, const Fields& fields)
    : system_(system), places_(fields.places) {
  used_ = functions_of(system, fields);
  for (std::size_t place = 0; place < used_.size(); ++place) {
    if (!used_[place]) continue;
    if (const std::optional<Polynomial> relation = system.relation_of(place)) relate(*relation);
  }
  for (const auto& rates : fields.plain) relate_field(places_, rates);
}

Grading::Exponents Grading::exponents_of(const std::vector<unsigned long>& powers) const {
  Exponents result(powers.size(), 0);
  for (std::size_t i = 0; i < powers.size(); ++i)
    if (!system_.is_constant()[i]) result[i] = static_cast<std::int64_t>(powers[i]);
  return result;
}

/// All terms of p are of one part.
void Grading::relate(const Polynomial& p) {
  std::optional<Exponents> first;
  for (const auto& [number, powers] : p.term_list()) {
    Exponents own = exponents_of(powers);
    if (!first) {
      first = std::move(own);
      continue;
    }
    subtract(own, 1, *first);
    insert(std::move(own));
  }
}

/// The rate of x is as far from x for all x.
void Grading::relate_field(const std::vector<std::size_t>& places,
                           const std::vector<Polynomial>& rates) {
  std::optional<Exponents> first;
  for (std::size_t i = 0; i < rates.size(); ++i) {
    for (const auto& [number, powers] : rates[i].term_list()) {
      Exponents own = exponents_of(powers);
      --own[places[i]];
      if (!first) {
        first = std::move(own);
        continue;
      }
      subtract(own, 1, *first);
      insert(std::move(own));
    }
  }
}

void Grading::insert(Exponents difference) {
  constexpr std::int64_t kLargest = std::int64_t{1} << 28;
  const auto is_large = [](std::int64_t e) { return std::abs(e) > kLargest; };
  for (std::size_t k = 0; k <= rows_.size() && !is_trivial_; ++k) {
    const std::size_t pivot = pivot_of(difference);
    if (pivot == difference.size()) return;
    if (k == rows_.size() || pivot < pivot_of(rows_[k])) {
      if (difference[pivot] < 0)
        for (std::int64_t& e : difference) e = -e;
      rows_.insert(rows_.begin() + static_cast<std::ptrdiff_t>(k), std::move(difference));
      return;
    }
    // Euclid's algorithm leaves the common divisor in the row and nothing in the difference.
    while (pivot == pivot_of(rows_[k]) && difference[pivot] != 0) {
      subtract(rows_[k], floor_quotient(rows_[k][pivot], difference[pivot]), difference);
      std::swap(rows_[k], difference);
      if (std::ranges::any_of(rows_[k], is_large) || std::ranges::any_of(difference, is_large)) {
        is_trivial_ = true;
        return;
      }
    }
    if (pivot == pivot_of(rows_[k]) && rows_[k][pivot] < 0)
      for (std::int64_t& e : rows_[k]) e = -e;
  }
}

std::vector<std::int64_t> Grading::part_of(const std::uint8_t* exponents) const {
  if (is_trivial_) return {};
  Exponents result(system_.ring().size(), 0);
  for (std::size_t i = 0; i < places_.size(); ++i) result[places_[i]] += exponents[i];
  for (const Exponents& row : rows_) {
    const std::size_t pivot = pivot_of(row);
    subtract(result, floor_quotient(result[pivot], row[pivot]), row);
  }
  return result;
}

std::vector<std::vector<std::int64_t>> Grading::weights() const {
  if (is_trivial_) return {};
  RationalMatrix rows;
  for (const Exponents& row : rows_) rows.emplace_back(row.begin(), row.end());
  // What nothing uses has no weight.
  for (std::size_t i = 0; i < used_.size(); ++i) {
    if (used_[i]) continue;
    rows.emplace_back(used_.size(), 0);
    rows.back()[i] = 1;
  }
  std::vector<std::vector<std::int64_t>> result;
  for (const std::vector<cln::cl_I>& vector : null_space(rows, used_.size())) {
    std::vector<std::int64_t> own;
    for (const std::size_t place : places_) {
      constexpr std::uint32_t kMostBits = 40;
      if (cln::integer_length(vector[place]) > kMostBits) return {};
      own.push_back(cln::cl_I_to_long(vector[place]));
    }
    result.push_back(std::move(own));
  }
  return result;
}

}  // namespace casimir::search
