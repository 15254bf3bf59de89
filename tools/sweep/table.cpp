#include "tools/sweep/table.hpp"

#include <fmt/format.h>

#include "symbolic/error.hpp"
#include "tools/cli/errors.hpp"
#include "tools/cli/output.hpp"
#include "tools/text/runs/run_report.hpp"

namespace casimir::tools {
namespace {

bool is_hdf5(const std::string& path) { return path.ends_with(".h5") || path.ends_with(".hdf5"); }

void write_csv(const std::string& path, const SweepTable& table) {
  OutputFile file(path);
  std::ostream& out = file.stream();
  out << "point";
  for (const Axis& axis : table.grid.axes) out << ',' << csv_field(axis_title(axis));
  out << ",status";
  for (const std::string& name : table.columns) out << ',' << csv_field(name);
  out << '\n';
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
  if (is_hdf5(path)) {
    if (hdf5_version().empty())
      throw SystemError(
          "casimir was built without HDF5; install it with: apt-get install libhdf5-dev, and build "
          "again, or write a .csv file");
    return;
  }
  if (!path.ends_with(".csv"))
    throw UsageError(
        fmt::format("'{}': a sweep's name must end in .csv, .h5 or .hdf5", printable(path, 200)));
}

void write_sweep(const std::string& path, const SweepTable& table) {
  if (is_hdf5(path))
    write_hdf5(path, table);
  else
    write_csv(path, table);
}

}  // namespace casimir::tools
