// Runs of one initial state and of many, and the right-hand side as a function.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "tools/analysis/error.hpp"
#include "tools/analysis/run/doubted_invariants.hpp"
#include "tools/analysis/run/ensemble_check.hpp"
#include "tools/analysis/run/ensemble_kernel.hpp"
#include "tools/analysis/run/point_check.hpp"
#include "tools/analysis/solve.hpp"
#include "tools/python/core/bindings.hpp"
#include "tools/python/core/case.hpp"
#include "tools/python/core/guard.hpp"
#include "tools/python/core/requests.hpp"
#include "tools/text/runs/run_report.hpp"
#include "tools/text/runs/trust_report.hpp"

namespace casimir::python {
namespace py = pybind11;
using namespace py::literals;

namespace {

/// States as columns: the shape that SciPy gives them.
template <class State>
Doubles columns(std::size_t rows, std::size_t count, const State& state) {
  Doubles result({rows, count});
  auto values = result.mutable_unchecked<2>();
  for (std::size_t k = 0; k < count; ++k) {
    const auto& x = state(k);
    for (std::size_t i = 0; i < rows; ++i)
      values(static_cast<py::ssize_t>(i), static_cast<py::ssize_t>(k)) = x[i];
  }
  return result;
}

/// A finished run.
class Motion {
 public:
  Motion(std::shared_ptr<const Case> of, Solution solution)
      : case_(std::move(of)), solution_(std::make_unique<Solution>(std::move(solution))) {}
  Motion(Motion&&) = default;
  ~Motion() {
    const ExactAlgebra guard;
    solution_.reset();
  }

  const Solution& solution() const { return *solution_; }
  const Trajectory& trajectory() const { return solution_->trajectory(); }
  std::size_t size() const { return solution_->names().size(); }

  /// The times of the steps and the states there.
  py::tuple steps() const {
    const auto& steps = solution_->steps();
    Doubles times(static_cast<py::ssize_t>(steps.size()));
    for (std::size_t k = 0; k < steps.size(); ++k) times.mutable_data()[k] = steps[k].time;
    return py::make_tuple(
        times, columns(size(), steps.size(), [&](std::size_t k) { return steps[k].state; }));
  }

  /// The states at these times.
  Doubles at(const Doubles& times) const {
    std::vector<std::vector<double>> states(static_cast<std::size_t>(times.size()));
    {
      const double* t = times.data();
      const py::gil_scoped_release python;
      for (std::size_t k = 0; k < states.size(); ++k) states[k] = (*solution_)(t[k]);
    }
    return columns(size(), states.size(), [&](std::size_t k) { return states[k]; });
  }

  py::dict invariants() const {
    py::dict result;
    const Names& names = solution_->scene().specialisation.invariant_names;
    for (std::size_t i = 0; i < names.size(); ++i) {
      const InvariantRecord& record = trajectory().invariants[i];
      result[py::str(names[i])] =
          py::dict("initial"_a = static_cast<double>(record.initial),
                   "final"_a = static_cast<double>(record.final), "drift"_a = record.drift);
    }
    return result;
  }

  py::dict trust() const {
    const ErrorEstimate& trust = solution_->trust();
    const auto known = [&](double value) -> py::object {
      if (!trust.known) return py::none();
      return py::float_(value);
    };
    return py::dict(
        "conditioning"_a = known(trust.conditioning),
        "input_rounding"_a = known(trust.input_rounding),
        "error_estimate"_a = trust.unconfirmed ? py::none() : known(trust.error_estimate),
        "beyond_double"_a = trust.beyond_double);
  }

  /// Facts about the run by name.
  py::dict facts() const {
    const AssessedRun& run = solution_->run();
    const Trajectory& motion = trajectory();
    const tools::RunWords words = tools::words_of(run);
    Names left_out;
    for (const LeftOut& item : solution_->scene().specialisation.left_out)
      left_out.push_back(item.kind + " " + item.name + ": " + item.reason);
    return py::dict("status"_a = to_string(motion.status), "reason"_a = motion.reason,
                    "advice"_a = words.advice, "warnings"_a = words.warnings,
                    "method"_a = std::string(run.method->name), "chosen"_a = run.chosen,
                    "rtol"_a = run.settings.rtol, "atol"_a = run.settings.atol,
                    "time"_a = motion.time, "steps"_a = motion.steps,
                    "rejected"_a = motion.rejected, "evaluations"_a = motion.evaluations,
                    "jacobians"_a = motion.jacobians, "seconds"_a = motion.seconds,
                    "compile_seconds"_a = run.compiled->seconds, "left_out"_a = left_out);
  }

 private:
  std::shared_ptr<const Case> case_;
  std::unique_ptr<Solution> solution_;
};

Motion integrate(const std::shared_ptr<Case>& self, const std::string& scene,
                 const std::string& method, Choice duration, Choice tolerance, Choice rtol,
                 Choice atol, Choice step, unsigned long long max_steps,
                 const std::optional<Names>& observe, bool project, double time_limit,
                 const py::object& progress) {
  Interrupt interrupt(progress);
  SolveOptions options;
  options.method = method;
  options.run = request(duration, tolerance, rtol, atol);
  options.run.step = step;
  options.run.max_steps = max_steps;
  options.run.project = project;
  options.code.observe = observe;
  options.dense = true;
  options.time_limit = time_limit;
  options.give_up = [&] { return interrupt(); };
  if (interrupt.told()) options.progress = [&](double share) { interrupt.show(share); };
  std::optional<Motion> motion;
  {
    const ExactAlgebra guard;
    const Model& model = self->model();
    motion.emplace(self, settled([&] { return solve(model, model.scene(scene), options); }));
  }
  interrupt.finish();
  return std::move(*motion);
}

/// A scene compiled for repeated use: its right-hand side, and the flow by one method.
class System {
 public:
  System(const Case& of, const std::string& scene, const std::string& method, const Names& keep) {
    const ExactAlgebra guard;
    const Model& model = of.model();
    SceneOptions how;
    how.keep_parameters = keep;
    how.observe = Names{};
    run_ = std::make_unique<PreparedScene>(prepare(model, model.scene(scene), how));
    method_ = &method_named(method);
    compiled_ = std::make_unique<CompiledModule>(compile_for(*run_, *method_));
    point_check_ = std::make_unique<PointCheck>(model, model.scene(scene), run_->specialisation);
  }
  ~System() {
    const ExactAlgebra guard;
    point_check_.reset();
    compiled_.reset();
    run_.reset();
  }

  const Names& names() const { return run_->specialisation.states; }
  const Names& parameter_names() const { return run_->specialisation.parameters; }
  const Names& invariant_names() const { return run_->specialisation.invariant_names; }
  const std::vector<double>& initial() const { return run_->initial; }
  const std::vector<double>& parameters() const { return run_->parameters; }

  /// dx/dt at a state. \param p  values of the kept parameters; none: those of the scene.
  Doubles rhs(double t, const Doubles& x, const std::optional<Doubles>& p) const {
    return evaluated(compiled_->module.functions().rhs, names().size(), t, x, p);
  }
  /// Values of the invariants at a state.
  Doubles invariants(double t, const Doubles& x, const std::optional<Doubles>& p) const {
    return evaluated(compiled_->module.functions().invariants, invariant_names().size(), t, x, p);
  }
  /// The Jacobian of the right-hand side, n by n.
  py::array jacobian(double t, const Doubles& x, const std::optional<Doubles>& p) const {
    if (!compiled_->module.has_jacobian())
      throw RequestError("the module of this method has no Jacobian: ask for 'radau5'");
    const std::size_t n = names().size();
    const Doubles by_columns = evaluated(compiled_->module.functions().jacobian, n * n, t, x, p);
    return by_columns.attr("reshape")(n, n).attr("T");
  }

  /// The right-hand side as an address in C, with what it needs: see `low_level`.
  py::tuple address(const std::optional<std::string>& component, const py::object& keeper) const;

  /// The state after a time.
  Doubles flow(const Doubles& x, double duration, Choice tolerance,
               const std::optional<Doubles>& p) {
    check(x, p);
    const std::vector<double> start(x.data(), x.data() + x.size());
    const std::vector<double> values =
        p ? std::vector<double>(p->data(), p->data() + p->size()) : run_->parameters;
    if (const auto fault = (*point_check_)(start, values); fault && !fault->constraint)
      throw RequestError(fault->text);
    Settings settings;
    settings.rtol = settings.atol = tolerance.value_or(1e-12);
    settings.duration = duration;
    settings.monitor = false;
    Interrupt interrupt;
    settings.give_up = [&] { return interrupt(); };
    Trajectory end;
    {
      const py::gil_scoped_release python;
      end = settled(
          [&] { return casimir::integrate(compiled_->module, *method_, settings, start, values); });
    }
    interrupt.raise();
    if (end.status != Status::ok)
      throw RequestError("the flow ends at t = " + std::to_string(end.time) + ": " + end.reason);
    return Doubles(static_cast<py::ssize_t>(end.state.size()), end.state.data());
  }

 private:
  void check(const Doubles& x, const std::optional<Doubles>& p) const {
    const auto differs = [](const Doubles& given, std::size_t size) {
      return given.ndim() != 1 || static_cast<std::size_t>(given.size()) != size;
    };
    if (differs(x, names().size()))
      throw RequestError("a state has " + std::to_string(names().size()) + " numbers");
    if (p && differs(*p, run_->parameters.size()))
      throw RequestError("there are " + std::to_string(run_->parameters.size()) +
                         " parameters that were kept");
  }

  Doubles evaluated(const std::function<ModuleFunctions::Evaluation>& function, std::size_t size,
                    double t, const Doubles& x, const std::optional<Doubles>& p) const {
    check(x, p);
    Doubles result(static_cast<py::ssize_t>(size));
    function(t, x.data(), p ? p->data() : run_->parameters.data(), result.mutable_data());
    return result;
  }

  std::unique_ptr<PreparedScene> run_;
  const Method* method_ = nullptr;
  std::unique_ptr<CompiledModule> compiled_;
  std::unique_ptr<PointCheck> point_check_;  ///< what states and parameters have to fulfil
};

/// What a function in C is given beside its numbers: a compiled right-hand side.
struct RightHandSide {
  py::object keeper;  ///< the system, whose module holds the code
  const std::function<ModuleFunctions::Evaluation>* rhs;
  std::vector<double> parameters;
  std::size_t states;
  std::size_t component;  ///< which rate is asked for, where only one is
};

/// The rates at a time and a state: nothing is thrown, since the caller is in C.
void rates_in_c(double t, double* x, double* rates, void* data) {
  const auto& of = *static_cast<const RightHandSide*>(data);
  (*of.rhs)(t, x, of.parameters.data(), rates);
}

/// One rate at n numbers, those of a state, with the time behind them or 0.
double rate_in_c(int n, double* x, void* data) {
  const auto& of = *static_cast<const RightHandSide*>(data);
  const auto given = static_cast<std::size_t>(n);
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  if (given != of.states && given != of.states + 1) return kNone;
  thread_local std::vector<double> rates;
  rates.resize(of.states);
  (*of.rhs)(given > of.states ? x[of.states] : 0, x, of.parameters.data(), rates.data());
  return rates[of.component];
}

py::tuple System::address(const std::optional<std::string>& component,
                          const py::object& keeper) const {
  std::size_t place = 0;
  if (component) {
    const auto found = std::ranges::find(names(), *component);
    if (found == names().end())
      throw RequestError("'" + printable(*component) +
                         "' is not a variable: " + suggest_or_list(*component, names()));
    place = static_cast<std::size_t>(found - names().begin());
  }
  const auto& rhs = compiled_->module.functions().rhs;
  auto* const data = new RightHandSide{keeper, &rhs, run_->parameters, names().size(), place};
  const py::capsule context(data, [](void* held) { delete static_cast<RightHandSide*>(held); });
  // SciPy reads the signature from the name of the capsule, which has to stay.
  if (component)
    return py::make_tuple(
        py::capsule(reinterpret_cast<void*>(&rate_in_c), "double (int, double *, void *)"),
        context);
  return py::make_tuple(py::capsule(reinterpret_cast<void*>(&rates_in_c),
                                    "void (double, double *, double *, void *)"),
                        context);
}

/// Where each column of `names` goes among `known`.
/// \throws RequestError  with the nearest name.
std::vector<std::size_t> places_of(const Names& names, const Names& known, const char* what) {
  std::vector<std::size_t> places;
  for (const std::string& name : names) {
    const auto found = std::ranges::find(known, name);
    if (found == known.end())
      throw RequestError("'" + printable(name) + "' is not " + what + ": " +
                         suggest_or_list(name, known));
    const auto place = static_cast<std::size_t>(found - known.begin());
    if (std::ranges::find(places, place) != places.end())
      throw RequestError("there are two columns '" + printable(name) + "'");
    places.push_back(place);
  }
  return places;
}

/// Puts each column of an array into its place in the rows of `into`.
void fill(std::vector<double>& into, std::size_t width, const Doubles& values,
          const std::vector<std::size_t>& places) {
  const auto from = values.unchecked<2>();
  for (py::ssize_t row = 0; row < from.shape(0); ++row)
    for (std::size_t column = 0; column < places.size(); ++column)
      into[static_cast<std::size_t>(row) * width + places[column]] =
          from(row, static_cast<py::ssize_t>(column));
}

/// Members `from` to `to`, without the latter.
Ensemble part_of(const Ensemble& all, std::size_t from, std::size_t to) {
  Ensemble part;
  part.states = all.states;
  part.parameters = all.parameters;
  part.initial.assign(all.state(from), all.state(to));
  part.values.assign(all.values_of(from), all.values_of(to));
  return part;
}

/// The members in parts, so that somebody can be told how far it is: what becomes of a member
/// depends on no other.
template <class Integrate>
EnsembleResult in_parts(const Ensemble& all, const Integrate& integrate, Interrupt& watch) {
  constexpr std::size_t kParts = 64, kLeast = 64;  // several times the lanes of all cores
  const std::size_t size = std::max(kLeast, all.size() / kParts);
  EnsembleResult result;
  for (std::size_t from = 0; from < all.size(); from += size) {
    EnsembleResult part = integrate(part_of(all, from, std::min(from + size, all.size())));
    std::ranges::move(part.members, std::back_inserter(result.members));
    result.seconds += part.seconds;
    result.jobs = std::max(result.jobs, part.jobs);
    watch.show(static_cast<double>(result.members.size()) / static_cast<double>(all.size()));
  }
  return result;
}

/// Many members at once. \param initial  a row for each, with a column for each of `variables`.
/// \param values  likewise for `parameters`.
py::dict ensemble(const Case& self, const std::string& scene, const std::string& method,
                  const Doubles& initial, const Names& variables, const Doubles& values,
                  const Names& parameters, Choice duration, Choice tolerance, Choice rtol,
                  Choice atol, int jobs, double seconds, const py::object& progress) {
  if (initial.ndim() != 2 || values.ndim() != 2 || initial.shape(0) != values.shape(0) ||
      static_cast<std::size_t>(initial.shape(1)) != variables.size() ||
      static_cast<std::size_t>(values.shape(1)) != parameters.size())
    throw RequestError("an ensemble is a row for each member and a column for each name");
  Interrupt interrupt(progress);
  const auto count = static_cast<std::size_t>(initial.shape(0));
  Ensemble members;
  EnsembleResult result;
  Names states, invariants;
  Names warnings;
  {
    const ExactAlgebra guard;
    const Model& model = self.model();
    SceneOptions how;
    how.keep_parameters = parameters;
    how.observe = Names{};
    const PreparedScene run = prepare(model, model.scene(scene), how);
    const Specialisation& s = run.specialisation;
    states = s.states;
    invariants = s.invariant_names;
    members.states = states.size();
    members.parameters = run.parameters.size();
    members.initial.reserve(count * members.states);
    members.values.reserve(count * members.parameters);
    for (std::size_t row = 0; row < count; ++row) {
      members.initial.insert(members.initial.end(), run.initial.begin(), run.initial.end());
      members.values.insert(members.values.end(), run.parameters.begin(), run.parameters.end());
    }
    fill(members.initial, members.states, initial, places_of(variables, states, "a variable"));
    fill(members.values, members.parameters, values,
         places_of(parameters, s.parameters, "a parameter"));
    const std::string off_constraints = require_members(model, model.scene(scene), s, members);
    const Method& by = method_named(method);
    const RunRequest asked = request(duration, tolerance, rtol, atol);
    Settings settings = settings_for(asked, run);
    settings.give_up = [&, late = time_limit(seconds)] { return interrupt() || (late && late()); };
    settings.invariant_terms = nullptr;
    const EnsembleKernel kernel = ensemble_kernel(run, by, count, true);
    const auto integrated = [&](Ensemble some) {
      scale_tolerances(asked, run, settings, some);
      return casimir::integrate_ensemble(some, run, kernel, by, settings, jobs);
    };
    result = settled([&] {
      return interrupt.told() ? in_parts(members, integrated, interrupt) : integrated(members);
    });
    if (!off_constraints.empty()) warnings.push_back(off_constraints);
    std::ranges::move(
        doubts_of_members(model, model.scene(scene), s.invariant_names, result, settings.rtol),
        std::back_inserter(warnings));
  }
  interrupt.finish();
  Doubles ends({count, members.states}), drift({count, invariants.size()});
  Doubles times(static_cast<py::ssize_t>(count));
  py::list status;
  py::array_t<unsigned long long> steps(static_cast<py::ssize_t>(count));
  for (std::size_t i = 0; i < count; ++i) {
    const MemberResult& member = result.members[i];
    // A member whose turn never came has no state.
    std::fill_n(ends.mutable_data() + i * members.states, members.states, std::nan(""));
    std::ranges::copy(member.state, ends.mutable_data() + i * members.states);
    double* const drifts = drift.mutable_data() + i * invariants.size();
    std::fill_n(drifts, invariants.size(), std::nan(""));
    for (std::size_t k = 0; k < member.invariants.size(); ++k)
      drifts[k] = member.invariants[k].drift;
    times.mutable_data()[i] = member.time;
    steps.mutable_data()[i] = member.steps;
    status.append(to_string(member.status));
  }
  return py::dict("names"_a = states, "invariant_names"_a = invariants, "states"_a = ends,
                  "t"_a = times, "drift"_a = drift, "status"_a = status, "steps"_a = steps,
                  "seconds"_a = result.seconds, "jobs"_a = result.jobs, "warnings"_a = warnings);
}

}  // namespace

void bind_motion(py::module_& module) {
  py::class_<Motion>(module, "Motion")
      .def_property_readonly("names", [](const Motion& self) { return self.solution().names(); })
      .def_property_readonly("ok", [](const Motion& self) { return self.solution().ok(); })
      .def("steps", &Motion::steps)
      .def("at", &Motion::at)
      .def("invariants", &Motion::invariants)
      .def("trust", &Motion::trust)
      .def("facts", &Motion::facts);
  py::class_<System>(module, "System")
      .def(py::init<const Case&, const std::string&, const std::string&, const Names&>())
      .def_property_readonly("names", &System::names)
      .def_property_readonly("parameter_names", &System::parameter_names)
      .def_property_readonly("invariant_names", &System::invariant_names)
      .def_property_readonly("initial", &System::initial)
      .def_property_readonly("parameters", &System::parameters)
      .def("rhs", &System::rhs)
      .def("jacobian", &System::jacobian)
      .def("invariants", &System::invariants)
      .def("address",
           [](const py::object& self, const std::optional<std::string>& component) {
             return self.cast<const System&>().address(component, self);
           })
      .def("flow", &System::flow);
  module.def("integrate", &integrate);
  module.def("ensemble", &ensemble);
  module.def("methods", &method_names);
}

}  // namespace casimir::python
