#include "tools/sweep/table.hpp"

#include <fmt/format.h>

#include "symbolic/error.hpp"
#include "tools/cli/errors.hpp"
#include "tools/cli/output.hpp"
#include "tools/tables/table.hpp"
#include "tools/text/runs/run_report.hpp"

namespace casimir::tools {
namespace {

/// The axes, then an array of the grid's shape for each column.
Table arrays_of(const SweepTable& sweep) {
  Table table;
  std::vector<std::size_t> shape;
  std::string names;
  for (const Axis& axis : sweep.grid.axes) {
    shape.push_back(axis.values.size());
    names += (names.empty() ? "" : ",") + axis_title(axis);
    table.columns.push_back({"axes/" + axis_title(axis), axis.values});
  }
  for (std::size_t c = 0; c < sweep.columns.size(); ++c) {
    std::vector<double> numbers;
    for (const PointResult& row : sweep.rows) numbers.push_back(row.values[c]);
    table.columns.push_back({sweep.columns[c], std::move(numbers), shape});
  }
  std::vector<Status> statuses;
  for (const PointResult& row : sweep.rows) statuses.push_back(row.status);
  table.columns.push_back({"status", choices_of(statuses), shape});
  table.facts = {
      {"case", sweep.case_name}, {"scene", sweep.scene}, {"method", sweep.method}, {"axes", names}};
  return table;
}

void write_csv(const std::string& path, const SweepTable& table) {
  OutputFile file(path);
  std::ostream& out = file.stream();
  std::vector<std::string> names{"point"};
  for (const Axis& axis : table.grid.axes) names.push_back(axis_title(axis));
  names.emplace_back("status");
  names.insert(names.end(), table.columns.begin(), table.columns.end());
  for (std::string& name : names = distinct_names(names)) name = csv_field(name);
  out << fmt::format("{}\n", fmt::join(names, ","));
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    out << i + 1;
    for (const double x : table.grid.at(i)) out << ',' << exact_text(x);
    out << ',' << to_string(table.rows[i].status);
    for (const double x : table.rows[i].values) out << ',' << exact_text(x);
    out << '\n';
  }
  file.commit();
}

}  // namespace

std::string axis_title(const Axis& axis) {
  return axis.kind == Axis::Kind::state ? axis.name + "(0)" : axis.name;
}

void check_sweep_output(const std::string& path) {
  if (!is_table_name(path))
    throw UsageError(fmt::format("'{}': a sweep's name must end in .csv, .npz, .h5 or .hdf5",
                                 printable(path, 200)));
  check_table_name(path);
}

void write_sweep(const std::string& path, const SweepTable& table) {
  if (is_array_name(path))
    write_table(path, arrays_of(table));
  else
    write_csv(path, table);
}

}  // namespace casimir::tools
