#include "tools/tables/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "symbolic/error.hpp"
#include "tools/cli/errors.hpp"
#include "tools/cli/output.hpp"
#include "tools/text/runs/run_report.hpp"

namespace casimir::tools {
namespace {

std::string ending_of(const std::string& path) {
  return std::filesystem::path(path).extension().string();
}

bool is_hdf5_name(const std::string& path) {
  const std::string ending = ending_of(path);
  return ending == ".h5" || ending == ".hdf5";
}

/// One cell of a column as a field of CSV.
class CellText {
 public:
  CellText(const Column& column, std::size_t row) : column_(column), row_(row) {}

  std::string operator()(const std::vector<double>& cells) const { return number(cells[row_]); }
  std::string operator()(const std::vector<std::int64_t>& cells) const {
    return std::to_string(cells[row_]);
  }
  std::string operator()(const std::vector<std::optional<double>>& cells) const {
    return cells[row_] ? number(*cells[row_]) : std::string{};
  }
  std::string operator()(const std::vector<std::string>& cells) const {
    return csv_field(cells[row_]);
  }
  std::string operator()(const Choices& cells) const {
    return csv_field(cells.words[static_cast<std::size_t>(cells.rows[row_])]);
  }

 private:
  std::string number(double value) const {
    return column_.format.empty() ? exact_text(value)
                                  : fmt::format(fmt::runtime(column_.format), value);
  }

  const Column& column_;
  std::size_t row_;
};

std::vector<std::string> names_of(const Table& table) {
  std::vector<std::string> names;
  for (const Column& column : table.columns) names.push_back(column.name);
  return names;
}

void write_text(const std::string& path, const Table& table) {
  OutputFile file(path);
  std::string line;
  for (const std::string& name : distinct_names(names_of(table)))
    line += (line.empty() ? "" : ",") + csv_field(name);
  file.stream() << line << '\n';
  const std::size_t rows = table.columns.empty() ? 0 : table.columns.front().size();
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t k = 0; k < table.columns.size(); ++k) {
      if (k > 0) file.stream() << ',';
      file.stream() << std::visit(CellText(table.columns[k], row), table.columns[k].cells);
    }
    file.stream() << '\n';
  }
  if (!table.note.empty()) file.stream() << "# " << table.note << '\n';
  file.commit();
}

void need(bool there, const char* library, const char* package) {
  if (!there)
    throw SystemError(
        fmt::format("casimir was built without {}; install it with: apt-get install {}, and build "
                    "again, or write a .csv file",
                    library, package));
}

}  // namespace

Choices choices_of(const std::vector<Status>& statuses) {
  Choices choices;
  for (int i = 0; i <= static_cast<int>(Status::at_jump); ++i)
    choices.words.push_back(to_string(static_cast<Status>(i)));
  for (const Status status : statuses) choices.rows.push_back(static_cast<int>(status));
  return choices;
}

std::size_t Column::size() const {
  if (const auto* words = std::get_if<Choices>(&cells)) return words->rows.size();
  return std::visit(
      [](const auto& held) -> std::size_t {
        if constexpr (requires { held.size(); }) return held.size();
        return 0;
      },
      cells);
}

std::vector<std::string> distinct_names(const std::vector<std::string>& names) {
  std::vector<std::string> distinct;
  for (std::string name : names) {
    while (std::ranges::count(distinct, name) > 0) name += '_';
    distinct.push_back(std::move(name));
  }
  return distinct;
}

std::vector<std::string> array_names(const Table& table) {
  constexpr std::string_view kGroup = "axes/", kGroupName = "axes";
  std::vector<std::string> names;
  bool has_group = false;
  for (const Column& column : table.columns) {
    std::string name = column.name;
    const bool in_group = name.starts_with(kGroup);
    has_group = has_group || in_group;
    std::replace(name.begin() + (in_group ? kGroup.size() : 0), name.end(), '/', '|');
    names.push_back(std::move(name));
  }
  if (!has_group) return distinct_names(names);
  names.insert(names.begin(), std::string(kGroupName));
  names = distinct_names(names);
  names.erase(names.begin());
  return names;
}

bool is_array_name(const std::string& path) {
  return ending_of(path) == ".npz" || is_hdf5_name(path);
}

bool is_table_name(const std::string& path) {
  return ending_of(path) == ".csv" || is_array_name(path);
}

void check_table_name(const std::string& path) {
  if (!ending_of(path).empty() && !is_table_name(path))
    throw UsageError(
        fmt::format("'{}' is no name for a table: {} are", printable(path, 200), kTableNames));
  if (is_hdf5_name(path)) need(has_hdf5(), "HDF5", "libhdf5-dev");
  if (ending_of(path) == ".npz") need(has_libzip(), "libzip", "libzip-dev");
}

void write_table(const std::string& path, const Table& table) {
  if (is_hdf5_name(path))
    write_hdf5(path, table);
  else if (is_array_name(path))
    write_npz(path, table);
  else
    write_text(path, table);
}

}  // namespace casimir::tools
