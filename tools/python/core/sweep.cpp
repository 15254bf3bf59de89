// The same study at every point of a grid of parameters and initial states.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <memory>

#include "tools/analysis/sweep/indicators.hpp"
#include "tools/analysis/sweep/integrations.hpp"
#include "tools/analysis/sweep/lyapunov.hpp"
#include "tools/analysis/sweep/ranks.hpp"
#include "tools/analysis/sweep/rotations.hpp"
#include "tools/analysis/sweep/sections.hpp"
#include "tools/python/core/bindings.hpp"
#include "tools/python/core/case.hpp"
#include "tools/python/core/guard.hpp"
#include "tools/python/core/requests.hpp"
#include "tools/sweep/grid_options.hpp"

namespace casimir::python {
namespace py = pybind11;
using namespace py::literals;

namespace {

/// Of a step in a section: every crossing keeps the level to 1e-10.
constexpr double kSectionSteps = 1e-14;

/// What is asked of a sweep.
struct SweepRequest {
  std::string task, method;
  Names over, lets;
  RunRequest run;
  std::size_t orbits, points;
  int jobs;
};

bool follows_crossings(const std::string& task) { return task == "section" || task == "rotation"; }

/// A grid with what it is studied by. Each part refers to those before it.
class SweepStudy {
 public:
  SweepStudy(const Model& model, const Scene& scene, const SweepRequest& asked)
      : grid_(tools::read_grid(asked.over, asked.lets, model)) {
    if (grid_.axes.empty()) throw RequestError("a sweep goes over at least one name");
    SceneOptions how;
    const Names set = tools::names_set(grid_, asked.lets);
    for (const GiNaC::symbol& p : model.parameters)
      if (std::ranges::find(set, p.get_name()) != set.end())
        how.keep_parameters.push_back(p.get_name());
    run_ = prepare(model, scene, how);
    RunRequest how_far = asked.run;
    if (follows_crossings(asked.task) && !scene.duration) how_far.duration = 0;
    settings_ = settings_for(how_far, run_);
    settings_.invariant_terms = nullptr;
    places_ = std::make_unique<GridPoints>(model, scene, run_, grid_,
                                           tools::read_lets(asked.lets, grid_, model));
    task_ = task(model, scene, asked);
  }

  const Grid& grid() const { return grid_; }
  const SweepTask& task() const { return *task_; }

 private:
  std::unique_ptr<SweepTask> task(const Model& model, const Scene& scene,
                                  const SweepRequest& asked) const {
    const Method& method = method_named(asked.method);
    if (asked.task == "integrate")
      return std::make_unique<Integrations>(run_, *places_, method, settings_, grid_.points(),
                                            asked.run);
    if (asked.task == "section")
      return std::make_unique<Sections>(model, scene, *places_, SectionRequest{}, asked.orbits,
                                        asked.points, kSectionSteps);
    if (asked.task == "rotation")
      return std::make_unique<Rotations>(model, scene, *places_, SectionRequest{}, asked.points,
                                         kSectionSteps);
    if (asked.task == "indicators")
      return std::make_unique<Indicators>(model, scene, run_, *places_, method, settings_);
    if (asked.task == "exponents")
      return std::make_unique<LyapunovExponents>(model, scene, run_, *places_, method, settings_);
    throw RequestError("'" + printable(asked.task) + "' is nothing that a sweep does: " +
                       suggest_or_list(asked.task, {"integrate", "section", "exponents",
                                                    "indicators", "rotation"}));
  }

  Grid grid_;
  PreparedScene run_;
  Settings settings_;
  std::unique_ptr<GridPoints> places_;
  std::unique_ptr<SweepTask> task_;
};

/// All points, in parts so that somebody can be told how far it is.
std::vector<PointResult> points_of(const SweepStudy& study, int jobs, Interrupt& interrupt,
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

py::dict to_python(const SweepStudy& study, const std::vector<PointResult>& rows) {
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
                  "principal"_a = study.task().principal_column());
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
    const SweepRequest asked{task,   method, over, lets, request(duration, tolerance),
                             orbits, points, jobs};
    settled([&] {
      const SweepStudy study(model, model.scene(scene), asked);
      const std::vector<PointResult> rows = points_of(study, jobs, interrupt, time_limit(seconds));
      const py::gil_scoped_acquire python;
      interrupt.raise();
      result = to_python(study, rows);
      return 0;
    });
  }
  interrupt.finish();
  return result;
}

}  // namespace

void bind_sweep(py::module_& module) { module.def("sweep", &sweep); }

}  // namespace casimir::python
