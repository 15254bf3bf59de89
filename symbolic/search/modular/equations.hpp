#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "symbolic/search/modular/modular.hpp"

namespace casimir::search {

/// A coefficient of an equation.
struct Entry {
  std::uint32_t column;
  Residue value;
};

/// Homogeneous linear equations modulo a prime, row by row.
struct Equations {
  std::size_t columns = 0;
  std::vector<std::size_t> starts{0};  ///< of the rows in `entries`, and the end
  std::vector<Entry> entries;
  std::size_t rows() const { return starts.size() - 1; }
};

/// Makes equations column by column; a row is named by a key.
class EquationBuilder {
 public:
  /// \param modulus  borrowed
  /// \param expected  number of entries, roughly
  EquationBuilder(const Modulus& modulus, std::size_t columns, std::size_t expected);

  /// Adds `value` to the entry of the row `key` in the present column.
  void add(std::uint64_t key, Residue value) {
    Slot& slot = find(key);
    if (slot.last_column == column_ + 1) {
      Triplet& triplet = triplets_[slot.last_entry];
      triplet.value = modulus_.add(triplet.value, value);
      return;
    }
    slot.last_column = column_ + 1;
    slot.last_entry = triplets_.size();
    triplets_.push_back({slot.row, column_, value});
  }
  void next_column() { ++column_; }

  Equations finish();

 private:
  struct Slot {
    std::uint64_t key = 0;
    std::size_t last_entry = 0;
    std::uint32_t last_column = 0;  ///< that column + 1; 0: the slot is free
    std::uint32_t row = 0;
  };
  struct Triplet {
    std::uint32_t row, column;
    Residue value;
  };
  Slot& find(std::uint64_t key);
  void grow();

  const Modulus& modulus_;
  std::size_t columns_;
  std::uint32_t column_ = 0;
  std::uint32_t rows_ = 0;
  std::vector<Slot> slots_;
  std::vector<Triplet> triplets_;
};

/// Equations of which no unknown occurs in those of another block.
struct Block {
  std::vector<std::uint32_t> columns;    ///< its unknowns, ascending
  std::vector<std::vector<Entry>> rows;  ///< over places in `columns`
};

/// The finest split into blocks. It finds every weight, parity and torus grading by itself.
std::vector<Block> split(const Equations& equations);

}  // namespace casimir::search
