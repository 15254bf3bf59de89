#include "symbolic/search/modular/equations.hpp"

#include <bit>
#include <numeric>

namespace casimir::search {
namespace {

std::size_t scattered(std::uint64_t key) {
  key *= 0x9E3779B97F4A7C15U;
  return static_cast<std::size_t>(key ^ (key >> 32));
}

std::uint32_t root_of(std::vector<std::uint32_t>& parent, std::uint32_t i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

}  // namespace

EquationBuilder::EquationBuilder(const Modulus& modulus, std::size_t columns, std::size_t expected)
    : modulus_(modulus), columns_(columns), slots_(std::bit_ceil(expected / 2 + 64)) {
  triplets_.reserve(expected);
}

EquationBuilder::Slot& EquationBuilder::find(std::uint64_t key) {
  const std::size_t mask = slots_.size() - 1;
  std::size_t place = scattered(key) & mask;
  while (slots_[place].last_column != 0 && slots_[place].key != key) place = (place + 1) & mask;
  Slot& slot = slots_[place];
  if (slot.last_column != 0) return slot;
  if (rows_ * std::size_t{3} > slots_.size() * 2) {
    grow();
    return find(key);
  }
  slot.key = key;
  slot.row = rows_++;
  return slot;
}

void EquationBuilder::grow() {
  std::vector<Slot> old(slots_.size() * 2);
  old.swap(slots_);
  const std::size_t mask = slots_.size() - 1;
  for (const Slot& slot : old) {
    if (slot.last_column == 0) continue;
    std::size_t place = scattered(slot.key) & mask;
    while (slots_[place].last_column != 0) place = (place + 1) & mask;
    slots_[place] = slot;
  }
}

Equations EquationBuilder::finish() {
  Equations result;
  result.columns = columns_;
  result.starts.assign(rows_ + std::size_t{1}, 0);
  for (const Triplet& triplet : triplets_) {
    if (triplet.value != 0) ++result.starts[triplet.row + std::size_t{1}];
  }
  std::partial_sum(result.starts.begin(), result.starts.end(), result.starts.begin());
  result.entries.resize(result.starts.back());
  std::vector<std::size_t> next(result.starts.begin(), result.starts.end() - 1);
  for (const Triplet& triplet : triplets_) {
    if (triplet.value != 0) result.entries[next[triplet.row]++] = {triplet.column, triplet.value};
  }
  return result;
}

std::vector<Block> split(const Equations& equations) {
  std::vector<std::uint32_t> parent(equations.columns);
  std::iota(parent.begin(), parent.end(), 0U);
  for (std::size_t r = 0; r < equations.rows(); ++r) {
    for (std::size_t i = equations.starts[r] + 1; i < equations.starts[r + 1]; ++i) {
      parent[root_of(parent, equations.entries[i].column)] =
          root_of(parent, equations.entries[equations.starts[r]].column);
    }
  }
  constexpr auto kNone = static_cast<std::uint32_t>(-1);
  std::vector<std::uint32_t> block_of_root(equations.columns, kNone), place(equations.columns);
  std::vector<Block> blocks;
  for (std::uint32_t c = 0; c < equations.columns; ++c) {
    std::uint32_t& block = block_of_root[root_of(parent, c)];
    if (block == kNone) {
      block = static_cast<std::uint32_t>(blocks.size());
      blocks.emplace_back();
    }
    place[c] = static_cast<std::uint32_t>(blocks[block].columns.size());
    blocks[block].columns.push_back(c);
  }
  for (std::size_t r = 0; r < equations.rows(); ++r) {
    const std::size_t begin = equations.starts[r], end = equations.starts[r + 1];
    if (begin == end) continue;
    Block& block = blocks[block_of_root[root_of(parent, equations.entries[begin].column)]];
    std::vector<Entry>& row = block.rows.emplace_back();
    row.reserve(end - begin);
    for (std::size_t i = begin; i < end; ++i)
      row.push_back({place[equations.entries[i].column], equations.entries[i].value});
  }
  return blocks;
}

}  // namespace casimir::search
