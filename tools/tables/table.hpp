#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "runtime/integrate.hpp"

namespace casimir::tools {

/// Which of a few words stands in each row, as the status of each run.
struct Choices {
  std::vector<std::string> words;  ///< all that there are, also those in no row
  std::vector<int> rows;           ///< places in `words`
};

/// How each of many integrations ended.
Choices choices_of(const std::vector<Status>& statuses);

/// What the rows of a column hold: numbers, whole numbers, numbers that may be missing, text, or
/// one of a few words. Numbers of more digits than a double has are text.
using Cells = std::variant<std::vector<double>, std::vector<std::int64_t>,
                           std::vector<std::optional<double>>, std::vector<std::string>, Choices>;

/// An array with a name.
struct Column {
  std::string name;
  Cells cells;
  std::vector<std::size_t> shape = {};  ///< the last index runs fastest; empty: one for each row
  std::string format = {};  ///< of numbers in CSV, as "{:g}"; empty: as many digits as are needed

  /// How many cells there are.
  std::size_t size() const;
};

/// What a command writes beside its report: columns of equal length. In files of arrays each is an
/// array under its name. NumPy files hold missing numbers as NaN and words as text; HDF5 files hold
/// them as NaN and as an enumeration, `facts` as attributes, and names with "axes/" in a group.
struct Table {
  std::vector<Column> columns;
  std::vector<std::pair<std::string, std::string>> facts = {};  ///< what all rows share; not in CSV
  std::string note = {};  ///< a sentence on why rows are missing; empty: none are
};

/// Names that differ: an underscore behind one that stands for an earlier column already, as that
/// of a variable `t`.
std::vector<std::string> distinct_names(const std::vector<std::string>& names);

/// The names of the arrays in a file, one for each column: distinct ones, with no slash but that of
/// "axes/", the name of a group, which stands for no array then.
std::vector<std::string> array_names(const Table& table);

/// The names that a table may be written to, for usage and errors.
inline constexpr const char* kTableNames = "FILE.csv, FILE.npz and FILE.h5";

/// Whether the name says that arrays are meant: .npz for NumPy, .h5 or .hdf5.
bool is_array_name(const std::string& path);
/// Whether the name says .csv, or that arrays are meant.
bool is_table_name(const std::string& path);

/// Refuses, before any work is done for it, what this program cannot write.
/// \throws UsageError   for a name with another ending; none at all is a table in CSV
/// \throws SystemError  where it was built without the library for it
void check_table_name(const std::string& path);

/// Writes the file that the name asks for. \throws SystemError  if it cannot be written
void write_table(const std::string& path, const Table& table);

/// Arrays in NumPy's format, a member for each in an archive that is not compressed. The bytes
/// depend on the table only. \throws SystemError  also where there is no libzip
void write_npz(const std::string& path, const Table& table);

/// \throws SystemError  also where the part of casimir that writes HDF5 is not there
void write_hdf5(const std::string& path, const Table& table);

/// Whether this program was built with the library for them.
/// \throws SystemError  where it was, and its module for HDF5 does not load
bool has_hdf5();
bool has_libzip();

}  // namespace casimir::tools
