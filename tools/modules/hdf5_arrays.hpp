#pragma once

#include <cstddef>

namespace casimir::tools {

/// What the cells of an array of a file are.
enum class Hdf5Cells : int {
  doubles,   ///< double
  integers,  ///< std::int64_t
  text,      ///< `width` bytes of UTF-8 each, with zeros behind shorter ones
  words,     ///< int, places in `words`
};

/// An array with a name, as plain data: a module of its own is linked to HDF5, and loaded only
/// where a table goes into such a file.
struct Hdf5Array {
  const char* name;  ///< with "axes/" in front it is in the group `axes`
  Hdf5Cells kind;
  const void* cells;
  const std::size_t* shape;  ///< the last index runs fastest
  std::size_t rank;          ///< how many numbers `shape` has
  std::size_t width;         ///< of text
  const char* const* words;
  std::size_t word_count;
};

/// An attribute of the file.
struct Hdf5Attribute {
  const char* name;
  const char* text;
};

/// Takes the bytes of a file, all at once.
using TakeBytes = void(void* taker, const char* bytes, std::size_t count);

/// Makes a file in memory: the library itself writes much of a file, and finds that there is no
/// room, only where it closes it, says so to nobody, and ends the program at its end.
/// \returns whether it was made, and taken
using MakeHdf5 = bool(const Hdf5Array* arrays, std::size_t array_count,
                      const Hdf5Attribute* attributes, std::size_t attribute_count, TakeBytes* take,
                      void* taker);

/// The name of the module and of the `MakeHdf5` in it.
inline constexpr const char* kHdf5Module = "casimir_hdf5";
inline constexpr const char* kMakeHdf5 = "casimir_make_hdf5";

}  // namespace casimir::tools
