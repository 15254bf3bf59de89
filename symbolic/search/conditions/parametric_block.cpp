#include "symbolic/search/conditions/parametric_block.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>

#include "symbolic/search/polynomial_system.hpp"

namespace casimir::search {
namespace {

using Exponents = std::vector<unsigned long>;

/// A polynomial as one in the places, with coefficients in the other variables.
std::map<Exponents, Polynomial> parts_of(const System& system, const Polynomial& p,
                                         const std::vector<std::size_t>& places) {
  std::map<Exponents, std::vector<std::pair<cln::cl_RA, Exponents>>> terms;
  for (auto& [number, exponents] : p.term_list()) {
    Exponents own, rest = exponents;
    for (const std::size_t place : places) {
      own.push_back(exponents[place]);
      rest[place] = 0;
    }
    terms[own].emplace_back(number, rest);
  }
  std::map<Exponents, Polynomial> result;
  for (const auto& [own, list] : terms) {
    TermCollector collector(system.ring());
    for (const auto& [number, rest] : list) collector.add(number, rest);
    result.emplace(own, collector.finish());
  }
  return result;
}

/// Equations by the monomial that they are the coefficients of.
class Collector {
 public:
  void add(std::size_t field, const Exponents& monomial, std::uint32_t column,
           const Polynomial& p) {
    auto& row = rows_[{field, monomial}];
    const auto place = row.find(column);
    if (place == row.end())
      row.emplace(column, p);
    else
      place->second += p;
  }

  std::vector<ParametricBlock> blocks(std::size_t columns) const {
    std::vector<std::uint32_t> parent(columns);
    std::iota(parent.begin(), parent.end(), 0U);
    const auto root = [&](std::uint32_t i) {
      while (parent[i] != i) i = parent[i] = parent[parent[i]];
      return i;
    };
    std::vector<ParametricBlock::Row> rows;
    for (const auto& [key, entries] : rows_) {
      ParametricBlock::Row row;
      for (const auto& [column, p] : entries)
        if (!p.is_zero()) row.emplace_back(column, p);
      for (const auto& [column, p] : row) parent[root(column)] = root(row[0].first);
      if (!row.empty()) rows.push_back(std::move(row));
    }
    std::map<std::uint32_t, ParametricBlock> result;
    std::vector<std::uint32_t> place(columns);
    for (std::uint32_t c = 0; c < columns; ++c)
      place[c] = static_cast<std::uint32_t>(result[root(c)].columns++);
    for (ParametricBlock::Row& row : rows) {
      ParametricBlock& block = result[root(row[0].first)];
      for (auto& [column, p] : row) column = place[column];
      std::sort(row.begin(), row.end(),
                [](const auto& a, const auto& b) { return a.first < b.first; });
      block.rows.push_back(std::move(row));
    }
    std::vector<ParametricBlock> list;
    for (auto& [key, block] : result)
      if (!block.rows.empty()) list.push_back(std::move(block));
    return list;
  }

 private:
  std::map<std::pair<std::size_t, Exponents>, std::map<std::uint32_t, Polynomial>> rows_;
};

const Polynomial* entry_of(const ParametricBlock::Row& row, std::uint32_t column) {
  const auto place = std::lower_bound(row.begin(), row.end(), column,
                                      [](const auto& a, std::uint32_t c) { return a.first < c; });
  return place != row.end() && place->first == column ? &place->second : nullptr;
}

/// row - factor * other, without the column.
ParametricBlock::Row combined(const ParametricBlock::Row& row, const Polynomial& factor,
                              const ParametricBlock::Row& other, std::uint32_t column) {
  ParametricBlock::Row result;
  auto a = row.begin();
  auto b = other.begin();
  while (a != row.end() || b != other.end()) {
    if (b == other.end() || (a != row.end() && a->first < b->first)) {
      if (a->first != column) result.push_back(*a);
      ++a;
      continue;
    }
    Polynomial value = -(factor * b->second);
    const std::uint32_t c = b->first;
    if (a != row.end() && a->first == c) value += (a++)->second;
    ++b;
    if (c != column && !value.is_zero()) result.emplace_back(c, std::move(value));
  }
  return result;
}

}  // namespace

void ParametricBlock::eliminate_constants() {
  for (;;) {
    std::optional<std::size_t> best;
    std::uint32_t column = 0;
    std::vector<std::size_t> use(columns, 0);
    for (const Row& row : rows)
      for (const auto& [c, p] : row) ++use[c];
    std::size_t cost = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      for (const auto& [c, p] : rows[i]) {
        if (!p.is_constant()) continue;
        const std::size_t own = (rows[i].size() - 1) * (use[c] - 1);
        if (best && own >= cost) continue;
        best = i;
        column = c;
        cost = own;
      }
    }
    if (!best) break;
    const Row pivot = std::move(rows[*best]);
    rows.erase(rows.begin() + static_cast<std::ptrdiff_t>(*best));
    const cln::cl_RA inverse = 1 / entry_of(pivot, column)->term_list()[0].first;
    for (Row& row : rows) {
      const Polynomial* entry = entry_of(row, column);
      if (entry == nullptr) continue;
      const Polynomial factor = entry->scaled(inverse);
      row = combined(row, factor, pivot, column);
    }
    std::erase_if(rows, [](const Row& row) { return row.empty(); });
  }
}

void ParametricBlock::put(std::size_t place, const Polynomial& value) {
  const Polynomial one = value.ring().constant(1);
  for (Row& row : rows) {
    for (auto& [column, entry] : row) entry = substituted(entry, place, value, one);
    std::erase_if(row, [](const auto& entry) { return entry.second.is_zero(); });
  }
  std::erase_if(rows, [](const Row& row) { return row.empty(); });
}

DenseRows ParametricBlock::at(const Point& point, const Modulus& modulus) const {
  std::vector<std::size_t> place(columns, 0);
  for (const Row& row : rows)
    for (const auto& [c, p] : row) place[c] = 1;
  std::size_t used = 0;
  for (std::size_t& p : place) p = p == 1 ? used++ : used;
  DenseRows matrix(rows.size(), used);
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (const auto& [c, p] : rows[i])
      matrix.row(i)[place[c]] = value_at(p, point, modulus).value_or(0);
  return matrix;
}

std::vector<ParametricBlock> parametric_blocks(const System& system, const Fields& fields,
                                               const Monomials& ansatz,
                                               const std::vector<Relation>& relations) {
  Collector collector;
  std::uint32_t column = 0;
  const auto shifted = [](const std::uint8_t* monomial, Exponents by) {
    for (std::size_t i = 0; i < by.size(); ++i) by[i] += monomial[i];
    return by;
  };
  for (const Relation& relation : relations) {
    const auto parts = parts_of(system, relation.function, fields.places);
    for (std::size_t c = 0; c < relation.multipliers.size(); ++c, ++column)
      for (const auto& [monomial, p] : parts)
        collector.add(0, shifted(relation.multipliers[c], monomial), column, p);
  }
  std::vector<std::vector<std::map<Exponents, Polynomial>>> rates;
  for (const auto& field : fields.rates) {
    auto& list = rates.emplace_back();
    for (const Polynomial& rate : field) list.push_back(parts_of(system, rate, fields.places));
  }
  for (std::size_t c = 0; c < ansatz.size(); ++c, ++column) {
    for (std::size_t f = 0; f < rates.size(); ++f) {
      for (std::size_t i = 0; i < rates[f].size(); ++i) {
        if (ansatz[c][i] == 0) continue;
        for (const auto& [monomial, p] : rates[f][i]) {
          Exponents row = shifted(ansatz[c], monomial);
          --row[i];
          collector.add(f, row, column, p.scaled(cln::cl_I(static_cast<long>(ansatz[c][i]))));
        }
      }
    }
  }
  return collector.blocks(column);
}

}  // namespace casimir::search
