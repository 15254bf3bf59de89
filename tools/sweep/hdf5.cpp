// The results of a sweep as HDF5: what h5py, Julia and MATLAB read as arrays of the grid's shape.
#include <fmt/format.h>

#include "tools/cli/errors.hpp"
#include "tools/cli/output.hpp"
#include "tools/sweep/table.hpp"
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

template <class Number>
void write_array(hid_t place, const std::string& name, const Shape& shape,
                 const std::vector<Number>& numbers, hid_t type) {
  const Handle space(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr),
                     H5Sclose);
  const Handle set(
      H5Dcreate2(place, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
      H5Dclose);
  check(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data()));
}

/// Statuses as an enumeration whose names HDF5 keeps.
void write_statuses(hid_t file, const Shape& shape, const std::vector<PointResult>& rows) {
  const Handle type(H5Tenum_create(H5T_NATIVE_INT), H5Tclose);
  for (int i = 0; i <= static_cast<int>(Status::stopped); ++i)
    check(H5Tenum_insert(type, to_string(static_cast<Status>(i)).c_str(), &i));
  std::vector<int> numbers;
  for (const PointResult& row : rows) numbers.push_back(static_cast<int>(row.status));
  write_array(file, "status", shape, numbers, type);
}

void write_attribute(hid_t file, const char* name, const std::string& text) {
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  check(H5Tset_size(type, text.size() + 1));
  check(H5Tset_cset(type, H5T_CSET_UTF8));
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle attribute(H5Acreate2(file, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  check(H5Awrite(attribute, type, text.c_str()));
}

/// A name in a file has no slash, which would be a group.
std::string set_name(std::string name) {
  for (char& c : name)
    if (c == '/') c = '|';
  return name;
}

}  // namespace

std::string hdf5_version() {
  unsigned major = 0, minor = 0, release = 0;
  H5get_libversion(&major, &minor, &release);
  return fmt::format("{}.{}.{}", major, minor, release);
}

void write_hdf5(const std::string& path, const SweepTable& table) {
  OutputFile output(path);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  {
    const Handle file(
        H5Fcreate(output.temporary().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose);
    Shape shape;
    std::string names;
    const Handle axes(H5Gcreate2(file, "axes", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
    for (const Axis& axis : table.grid.axes) {
      shape.push_back(axis.values.size());
      names += (names.empty() ? "" : ",") + axis_title(axis);
      write_array(axes, set_name(axis_title(axis)), {axis.values.size()}, axis.values,
                  H5T_NATIVE_DOUBLE);
    }
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
      std::vector<double> numbers;
      for (const PointResult& row : table.rows) numbers.push_back(row.values[c]);
      write_array(file, set_name(table.columns[c]), shape, numbers, H5T_NATIVE_DOUBLE);
    }
    write_statuses(file, shape, table.rows);
    write_attribute(file, "case", table.case_name);
    write_attribute(file, "scene", table.scene);
    write_attribute(file, "method", table.method);
    write_attribute(file, "axes", names);
    write_attribute(file, "casimir", CASIMIR_VERSION);
  }
  output.commit();
}

#else

std::string hdf5_version() { return {}; }

void write_hdf5(const std::string& path, const SweepTable&) { check_sweep_output(path); }

#endif

}  // namespace casimir::tools
