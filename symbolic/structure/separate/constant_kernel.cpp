#include "symbolic/structure/separate/constant_kernel.hpp"

#include <algorithm>
#include <map>
#include <memory>

#include "symbolic/search/modular/echelon.hpp"
#include "symbolic/search/modular/span.hpp"

namespace casimir::structure {
namespace {

/// Rows by the place in the vectors and the monomial in what moves.
std::vector<ParametricRow> rows_of(const search::System& system,
                                   const std::vector<std::vector<Polynomial>>& columns) {
  using Key = std::pair<std::size_t, std::vector<unsigned long>>;
  std::map<Key, std::map<std::size_t, std::unique_ptr<TermCollector>>> parts;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    for (std::size_t c = 0; c < columns[k].size(); ++c) {
      for (auto [number, exponents] : columns[k][c].term_list()) {
        std::vector<unsigned long> moving(exponents.size(), 0);
        for (std::size_t i = 0; i < exponents.size(); ++i)
          if (!system.is_constant()[i]) std::swap(moving[i], exponents[i]);
        auto& part = parts[{c, std::move(moving)}][k];
        if (!part) part = std::make_unique<TermCollector>(system.ring());
        part->add(number, exponents);
      }
    }
  }
  std::vector<ParametricRow> rows;
  for (auto& [key, row] : parts) {
    ParametricRow own;
    for (auto& [column, part] : row) {
      Polynomial sum = part->finish();
      if (!sum.is_zero()) own.emplace(column, std::move(sum));
    }
    if (!own.empty()) rows.push_back(std::move(own));
  }
  return rows;
}

/// The rows where the parameters have random values modulo a prime.
std::vector<std::vector<search::Entry>> modular(const std::vector<ParametricRow>& rows,
                                                const search::Point& point,
                                                const search::Modulus& modulus) {
  std::vector<std::vector<search::Entry>> result;
  for (const ParametricRow& row : rows) {
    result.emplace_back();
    for (const auto& [column, number] : row) {
      const std::optional<search::Residue> value = search::value_at(number, point, modulus);
      if (!value) throw search::NoAnswer("a coefficient has no value modulo a prime");
      if (*value != 0) result.back().push_back({static_cast<std::uint32_t>(column), *value});
    }
  }
  return result;
}

/// Of the rows, in the columns that are left, those that are independent modulo the prime.
std::vector<ParametricRow> independent_rows(const std::vector<ParametricRow>& rows,
                                            const std::vector<std::vector<search::Entry>>& residues,
                                            const std::vector<std::size_t>& places,
                                            const search::Modulus& modulus, std::size_t columns) {
  std::vector<std::size_t> order(rows.size());
  for (std::size_t r = 0; r < rows.size(); ++r) order[r] = r;
  std::ranges::stable_sort(order, {}, [&](std::size_t r) { return rows[r].size(); });
  search::Span span(modulus);
  std::vector<ParametricRow> result;
  for (const std::size_t r : order) {
    std::vector<search::Residue> dense(columns, 0);
    for (const search::Entry& own : residues[r])
      if (places[own.column] < columns) dense[places[own.column]] = own.value;
    if (!span.insert(std::move(dense))) continue;
    result.emplace_back();
    for (const auto& [column, number] : rows[r])
      if (places[column] < columns) result.back().emplace(places[column], number);
  }
  return result;
}

}  // namespace

ConstantKernel constant_kernel(const search::System& system,
                               const std::vector<std::vector<Polynomial>>& columns,
                               const search::Watch& watch) {
  const std::vector<ParametricRow> rows = rows_of(system, columns);
  const search::Modulus modulus = search::usable_modulus(system);
  std::mt19937_64 random(41);
  const std::optional<search::Point> point = system.random_point(modulus, random);
  if (!point) throw search::NoAnswer("the parameters have no values modulo a prime");
  const std::vector<std::vector<search::Entry>> residues = modular(rows, *point, modulus);
  const search::Echelon echelon(modulus, residues, columns.size(), watch);
  ConstantKernel result;
  result.bound = echelon.nullity();
  // What is zero in all solutions modulo the prime is taken to be zero in all: by bad luck that
  // loses solutions, and the bound says so.
  std::vector<std::size_t> places(columns.size(), columns.size()), live;
  for (const std::vector<search::Residue>& vector : echelon.null_basis()) {
    for (std::size_t k = 0; k < columns.size(); ++k) {
      if (vector[k] == 0 || places[k] != columns.size()) continue;
      places[k] = 0;
      live.push_back(k);
    }
  }
  std::ranges::sort(live);
  for (std::size_t k = 0; k < live.size(); ++k) places[live[k]] = k;
  if (live.empty()) return result;
  ParametricKernel kernel =
      kernel_of(independent_rows(rows, residues, places, modulus, live.size()), live.size(),
                system.ring(), watch.tick);
  for (const ParametricRow& own : kernel.basis) {
    result.basis.emplace_back();
    for (const auto& [place, number] : own) result.basis.back().emplace(live[place], number);
  }
  return result;
}

}  // namespace casimir::structure
