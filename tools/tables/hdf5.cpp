// Tables as HDF5: what h5py, Julia and MATLAB read as arrays.
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <list>

#include "symbolic/error.hpp"
#include "tools/cli/errors.hpp"
#include "tools/cli/output.hpp"
#include "tools/modules/hdf5_arrays.hpp"
#include "tools/modules/load.hpp"
#include "tools/tables/table.hpp"

namespace casimir::tools {
namespace {

/// The arrays of a table as the module takes them, with what they point to.
class PlainArrays {
 public:
  explicit PlainArrays(const Table& table) : names_(array_names(table)) {
    for (std::size_t k = 0; k < table.columns.size(); ++k) {
      const Column& column = table.columns[k];
      shapes_.push_back(column.shape.empty() ? std::vector<std::size_t>{column.size()}
                                             : column.shape);
    }
    for (std::size_t k = 0; k < table.columns.size(); ++k) {
      Hdf5Array array{};
      array.name = names_[k].c_str();
      array.shape = shapes_[k].data();
      array.rank = shapes_[k].size();
      std::visit([&](const auto& cells) { take(array, cells); }, table.columns[k].cells);
      arrays_.push_back(array);
    }
  }

  const std::vector<Hdf5Array>& arrays() const { return arrays_; }

 private:
  void take(Hdf5Array& array, const std::vector<double>& cells) {
    array.kind = Hdf5Cells::doubles;
    array.cells = cells.data();
  }
  void take(Hdf5Array& array, const std::vector<std::int64_t>& cells) {
    array.kind = Hdf5Cells::integers;
    array.cells = cells.data();
  }
  void take(Hdf5Array& array, const std::vector<std::optional<double>>& cells) {
    std::vector<double>& numbers = numbers_.emplace_back();
    for (const auto& cell : cells)
      numbers.push_back(cell.value_or(std::numeric_limits<double>::quiet_NaN()));
    take(array, numbers);
  }
  void take(Hdf5Array& array, const std::vector<std::string>& cells) {
    array.kind = Hdf5Cells::text;
    array.width = 1;
    for (const std::string& cell : cells) array.width = std::max(array.width, cell.size() + 1);
    std::string& all = texts_.emplace_back();
    for (std::size_t row = 0; row < cells.size(); ++row) {
      all += cells[row];
      all.resize((row + 1) * array.width);
    }
    array.cells = all.data();
  }
  void take(Hdf5Array& array, const Choices& cells) {
    array.kind = Hdf5Cells::words;
    array.cells = cells.rows.data();
    std::vector<const char*>& words = words_.emplace_back();
    for (const std::string& word : cells.words) words.push_back(word.c_str());
    array.words = words.data();
    array.word_count = words.size();
  }

  std::vector<std::string> names_;
  std::vector<std::vector<std::size_t>> shapes_;
  std::vector<Hdf5Array> arrays_;
  // Lists, whose members stay where they are.
  std::list<std::vector<double>> numbers_;
  std::list<std::string> texts_;
  std::list<std::vector<const char*>> words_;
};

MakeHdf5* maker() { return reinterpret_cast<MakeHdf5*>(module_symbol(kHdf5Module, kMakeHdf5)); }

}  // namespace

bool has_hdf5() {
#ifdef CASIMIR_HDF5
  return maker() != nullptr;
#else
  return false;
#endif
}

void write_hdf5(const std::string& path, const Table& table) {
  MakeHdf5* const make = maker();
  OutputFile output(path);
  const PlainArrays plain(table);
  std::vector<Hdf5Attribute> attributes;
  for (const auto& [name, text] : table.facts) attributes.push_back({name.c_str(), text.c_str()});
  if (!table.note.empty()) attributes.push_back({"note", table.note.c_str()});
  attributes.push_back({"casimir", CASIMIR_VERSION});
  const auto take = [](void* file, const char* bytes, std::size_t count) {
    static_cast<OutputFile*>(file)->stream().write(bytes, static_cast<std::streamsize>(count));
  };
  if (!make(plain.arrays().data(), plain.arrays().size(), attributes.data(), attributes.size(),
            take, &output))
    throw SystemError(fmt::format("HDF5 cannot hold the table for '{}'", printable(path, 200)));
  output.commit();
}

}  // namespace casimir::tools
