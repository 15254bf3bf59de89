#include <hdf5.h>

#include <cstring>
#include <optional>
#include <vector>

#include "tools/modules/hdf5_arrays.hpp"

namespace casimir::tools {
namespace {

/// Thrown where HDF5 refuses, caught in this file.
struct NotWritten {};

/// An identifier of the library, closed when it goes.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {
    if (id < 0) throw NotWritten{};
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
  if (status < 0) throw NotWritten{};
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

/// An enumeration of the words.
hid_t word_type(const Hdf5Array& array) {
  const hid_t type = H5Tenum_create(H5T_NATIVE_INT);
  for (int i = 0; type >= 0 && i < static_cast<int>(array.word_count); ++i)
    check(H5Tenum_insert(type, array.words[i], &i));
  return type;
}

void write_cells(hid_t file, const Hdf5Array& array, hid_t type) {
  const std::vector<hsize_t> shape(array.shape, array.shape + array.rank);
  const Handle space(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr),
                     H5Sclose);
  const Handle set(H5Dcreate2(file, array.name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                   H5Dclose);
  check(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, array.cells));
}

void write_array(hid_t file, const Hdf5Array& array) {
  switch (array.kind) {
    case Hdf5Cells::doubles:
      return write_cells(file, array, H5T_NATIVE_DOUBLE);
    case Hdf5Cells::integers:
      return write_cells(file, array, H5T_NATIVE_INT64);
    case Hdf5Cells::text:
      return write_cells(file, array, Handle(text_type(array.width), H5Tclose));
    case Hdf5Cells::words:
      return write_cells(file, array, Handle(word_type(array), H5Tclose));
  }
}

void write_attribute(hid_t file, const Hdf5Attribute& fact) {
  const Handle type(text_type(std::strlen(fact.text) + 1), H5Tclose);
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle attribute(H5Acreate2(file, fact.name, type, space, H5P_DEFAULT, H5P_DEFAULT),
                         H5Aclose);
  check(H5Awrite(attribute, type, fact.text));
}

void write_all(hid_t file, const Hdf5Array* arrays, std::size_t array_count,
               const Hdf5Attribute* attributes, std::size_t attribute_count) {
  std::optional<Handle> axes;
  for (std::size_t k = 0; k < array_count; ++k) {
    if (!axes && std::strncmp(arrays[k].name, "axes/", 5) == 0)
      axes.emplace(H5Gcreate2(file, "axes", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
    write_array(file, arrays[k]);
  }
  for (std::size_t k = 0; k < attribute_count; ++k) write_attribute(file, attributes[k]);
}

/// Memory that grows by so much at a time, and is not written to a file when it is closed.
hid_t memory() {
  constexpr std::size_t kIncrement = std::size_t{1} << 20;
  const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
  if (access >= 0) check(H5Pset_fapl_core(access, kIncrement, false));
  return access;
}

}  // namespace
}  // namespace casimir::tools

extern "C" bool casimir_make_hdf5(const casimir::tools::Hdf5Array* arrays, std::size_t array_count,
                                  const casimir::tools::Hdf5Attribute* attributes,
                                  std::size_t attribute_count, casimir::tools::TakeBytes* take,
                                  void* taker) {
  using namespace casimir::tools;
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  try {
    const Handle access(memory(), H5Pclose);
    const Handle file(H5Fcreate("table.h5", H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose);
    write_all(file, arrays, array_count, attributes, attribute_count);
    check(H5Fflush(file, H5F_SCOPE_GLOBAL));
    const ssize_t size = H5Fget_file_image(file, nullptr, 0);
    if (size < 0) return false;
    std::vector<char> bytes(static_cast<std::size_t>(size));
    if (H5Fget_file_image(file, bytes.data(), bytes.size()) != size) return false;
    take(taker, bytes.data(), bytes.size());
    return true;
  } catch (const NotWritten&) {
    return false;
  }
}
