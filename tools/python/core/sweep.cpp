// The same study at every point of a grid of parameters and initial states.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <limits>

#include "tools/analysis/sweep/ranks.hpp"
#include "tools/python/core/bindings.hpp"
#include "tools/python/core/case.hpp"
#include "tools/python/core/guard.hpp"
#include "tools/python/core/requests.hpp"
#include "tools/sweep/study.hpp"

namespace casimir::python {
namespace py = pybind11;
using namespace py::literals;

namespace {

/// All points, in parts so that somebody can be told how far it is.
std::vector<PointResult> points_of(const tools::SweepStudy& study, int jobs, Interrupt& interrupt,
                                   const std::function<bool()>& late) {
  constexpr std::size_t kParts = 64, kLeast = 16;
  const std::size_t all = study.grid().points();
  const int threads = jobs > 0 ? jobs : Ranks().processors();
  const std::size_t size =
      std::max({kLeast, all / kParts, static_cast<std::size_t>(threads) * kLeast});
  std::vector<PointResult> rows;
  const auto give_up = [&] { return interrupt() || (late && late()); };
  for (std::size_t from = 0; from < all; from += size) {
    std::vector<std::size_t> part;
    for (std::size_t i = from; i < std::min(from + size, all); ++i) part.push_back(i);
    std::ranges::move(study.task().run(part, threads, give_up), std::back_inserter(rows));
    interrupt.show(static_cast<double>(rows.size()) / static_cast<double>(all));
  }
  return rows;
}

py::dict to_python(const tools::SweepStudy& study, const std::vector<PointResult>& rows,
                   const Names& warnings) {
  const Names columns = study.task().columns();
  py::list axes, status;
  std::vector<py::ssize_t> shape;
  for (const Axis& axis : study.grid().axes) {
    axes.append(py::make_tuple(
        axis.name, Doubles(static_cast<py::ssize_t>(axis.values.size()), axis.values.data())));
    shape.push_back(static_cast<py::ssize_t>(axis.values.size()));
  }
  for (const PointResult& row : rows) status.append(to_string(row.status));
  py::dict values;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    Doubles column(shape);
    for (std::size_t i = 0; i < rows.size(); ++i)
      column.mutable_data()[i] =
          k < rows[i].values.size() ? rows[i].values[k] : std::numeric_limits<double>::quiet_NaN();
    values[py::str(columns[k])] = column;
  }
  return py::dict("axes"_a = axes, "columns"_a = values, "status"_a = status,
                  "principal"_a = study.task().principal_column(), "warnings"_a = warnings);
}

py::object sweep(const Case& self, const std::string& scene, const std::string& task,
                 const std::string& method, const Names& over, const Names& lets, Choice duration,
                 Choice tolerance, std::size_t orbits, std::size_t points, int jobs, double seconds,
                 const py::object& progress) {
  Interrupt interrupt(progress);
  py::object result;
  {
    const ExactAlgebra guard;
    const Model& model = self.model();
    tools::StudyRequest asked{task, method, over, lets};
    asked.run = request(duration, tolerance);
    asked.orbits = orbits;
    asked.points = points;
    settled([&] {
      const tools::SweepStudy study(model, model.scene(scene), asked);
      const std::vector<PointResult> rows = points_of(study, jobs, interrupt, time_limit(seconds));
      const bool complete = std::ranges::none_of(
          rows, [](const PointResult& row) { return row.status == Status::stopped; });
      const Names warnings =
          study.warnings(rows, complete ? study.check(rows) : std::vector<CheckedMember>{});
      const py::gil_scoped_acquire python;
      interrupt.raise();
      result = to_python(study, rows, warnings);
      return 0;
    });
  }
  interrupt.finish();
  return result;
}

}  // namespace

void bind_sweep(py::module_& module) { module.def("sweep", &sweep); }

}  // namespace casimir::python
