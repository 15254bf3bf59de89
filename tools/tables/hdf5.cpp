// Tables as HDF5: what h5py, Julia and MATLAB read as arrays.
#include <fmt/format.h>

#include <limits>

#include "tools/cli/errors.hpp"
#include "tools/cli/output.hpp"
#include "tools/tables/table.hpp"
#ifdef CASIMIR_HDF5
#include <hdf5.h>
#endif

namespace casimir::tools {

#ifdef CASIMIR_HDF5

namespace {

/// An identifier of the library, closed when it goes.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {
    if (id < 0) throw SystemError("HDF5 could not write the file");
  }
  ~Handle() { close_(id_); }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }  // NOLINT: it stands for the identifier

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

void check(herr_t status) {
  if (status < 0) throw SystemError("HDF5 could not write the file");
}

using Shape = std::vector<hsize_t>;

void write_array(hid_t place, const std::string& name, const Shape& shape, const void* cells,
                 hid_t type) {
  const Handle space(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr),
                     H5Sclose);
  const Handle set(
      H5Dcreate2(place, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
      H5Dclose);
  check(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, cells));
}

/// Text of this width in UTF-8, with zeros behind shorter ones.
hid_t text_type(std::size_t width) {
  const hid_t type = H5Tcopy(H5T_C_S1);
  if (type >= 0) {
    check(H5Tset_size(type, width));
    check(H5Tset_cset(type, H5T_CSET_UTF8));
  }
  return type;
}

/// Writes the array of a column.
class WriteCells {
 public:
  WriteCells(hid_t file, const std::string& name, Shape shape)
      : file_(file), name_(name), shape_(std::move(shape)) {}

  void operator()(const std::vector<double>& cells) const {
    write_array(file_, name_, shape_, cells.data(), H5T_NATIVE_DOUBLE);
  }
  void operator()(const std::vector<std::int64_t>& cells) const {
    write_array(file_, name_, shape_, cells.data(), H5T_NATIVE_INT64);
  }
  void operator()(const std::vector<std::optional<double>>& cells) const {
    std::vector<double> numbers;
    for (const auto& cell : cells)
      numbers.push_back(cell.value_or(std::numeric_limits<double>::quiet_NaN()));
    (*this)(numbers);
  }
  void operator()(const std::vector<std::string>& cells) const {
    std::size_t width = 1;
    for (const std::string& cell : cells) width = std::max(width, cell.size() + 1);
    std::string all;
    for (std::size_t row = 0; row < cells.size(); ++row) {
      all += cells[row];
      all.resize((row + 1) * width);
    }
    const Handle type(text_type(width), H5Tclose);
    write_array(file_, name_, shape_, all.data(), type);
  }
  void operator()(const Choices& cells) const {
    const Handle type(H5Tenum_create(H5T_NATIVE_INT), H5Tclose);
    for (int i = 0; i < static_cast<int>(cells.words.size()); ++i)
      check(H5Tenum_insert(type, cells.words[static_cast<std::size_t>(i)].c_str(), &i));
    write_array(file_, name_, shape_, cells.rows.data(), type);
  }

 private:
  hid_t file_;
  const std::string& name_;
  Shape shape_;
};

void write_attribute(hid_t file, const char* name, const std::string& text) {
  const Handle type(text_type(text.size() + 1), H5Tclose);
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle attribute(H5Acreate2(file, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  check(H5Awrite(attribute, type, text.c_str()));
}

}  // namespace

std::string hdf5_version() {
  unsigned major = 0, minor = 0, release = 0;
  H5get_libversion(&major, &minor, &release);
  return fmt::format("{}.{}.{}", major, minor, release);
}

void write_hdf5(const std::string& path, const Table& table) {
  OutputFile output(path);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  {
    const Handle file(
        H5Fcreate(output.temporary().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose);
    const std::vector<std::string> names = array_names(table);
    std::optional<Handle> axes;
    for (std::size_t k = 0; k < names.size(); ++k) {
      const Column& column = table.columns[k];
      if (!axes && names[k].starts_with("axes/"))
        axes.emplace(H5Gcreate2(file, "axes", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
      Shape shape(column.shape.begin(), column.shape.end());
      if (shape.empty()) shape = {column.size()};
      std::visit(WriteCells(file, names[k], shape), column.cells);
    }
    for (const auto& [name, text] : table.facts) write_attribute(file, name.c_str(), text);
    if (!table.note.empty()) write_attribute(file, "note", table.note);
    write_attribute(file, "casimir", CASIMIR_VERSION);
  }
  output.commit();
}

#else

std::string hdf5_version() { return {}; }

void write_hdf5(const std::string& path, const Table&) { check_table_name(path); }

#endif

}  // namespace casimir::tools
