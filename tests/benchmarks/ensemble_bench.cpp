// Ensembles against single trajectories, both by Taylor series and at equal achieved error.
//
//   ensemble_bench [--quick] [--orders] FOLDER_OF_CASES [CASE ..]
//
// Every member starts next to the scene's initial state. Achieved error is the median over the
// members of the largest error of a component at the end, against a run at the least tolerance and
// a high order. Each rate comes from runs over a range of tolerances, interpolated to that error.
// Times are processor times of one thread and wall times of two, the least of several interleaved
// runs; they are printed, never judged. --quick checks only that all members arrive where the
// single runs do; --orders prints the times of each order of the series.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <functional>
#include <limits>
#include <optional>
#include <random>

#include "codegen/compile.hpp"
#include "codegen/emit/number_literal.hpp"
#include "codegen/lane_form.hpp"
#include "codegen/quadratic.hpp"
#include "codegen/specialise.hpp"
#include "runtime/ensemble.hpp"
#include "runtime/taylor/quadratic_targets.hpp"
#include "symbolic/case_file.hpp"

namespace {

using namespace casimir;
using Run = std::function<std::vector<double>(double tolerance)>;

struct Options {
  bool quick = false, orders = false;
  std::string folder;
  std::vector<std::string> cases = {"kovalevskaya", "clebsch",  "euler",
                                    "steklov",      "lagrange", "manakov-so4"};
};

double processor_time() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double wall_time() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// A scene and its members.
struct Problem {
  Specialisation spec;
  Ensemble ensemble;
  double duration = 0;
  std::optional<QuadraticKernel> kernel;

  Problem(const std::string& file, std::size_t members) {
    const Model model = build_model(read_case(file));
    spec = specialise(model, model.scene("default"));
    std::vector<double> start;
    for (const int line : spec.start.outputs)
      start.push_back(
          codegen::nearest<double>(codegen::constant_value(spec.start, line, spec.limits)));
    duration = start.back();
    start.pop_back();
    ensemble.states = start.size();
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> near(1 - 1e-3, 1 + 1e-3);
    for (std::size_t i = 0; i < members; ++i)
      for (const double x : start) ensemble.initial.push_back(x * near(random));
    kernel.emplace(*quadratic_form(spec.rhs, spec.limits));
  }

  casimir_run single(double tolerance) const {
    casimir_run run = {};
    run.t_end = duration;
    run.rtol = run.atol = tolerance;
    return run;
  }

  std::vector<double> one_by_one(double tolerance) const {
    std::vector<double> end = ensemble.initial;
    const casimir_run run = single(tolerance);
    casimir_outcome out = {};
    for (std::size_t i = 0; i < ensemble.size(); ++i)
      kernel->integrate(&run, end.data() + i * ensemble.states, &out);
    return end;
  }

  std::vector<double> in_lanes(const LaneKernel& lanes, double tolerance, int jobs,
                               int order = 0) const {
    LaneKernel with_order = lanes;
    with_order.run = [&](const casimir_ensemble* run) {
      casimir_ensemble own = *run;
      own.order = order;
      lanes.run(&own);
    };
    Settings settings;
    settings.duration = duration;
    settings.rtol = settings.atol = tolerance;
    const EnsembleResult result = integrate_in_lanes(ensemble, with_order, {}, settings, jobs);
    std::vector<double> end;
    for (const MemberResult& member : result.members)
      end.insert(end.end(), member.state.begin(), member.state.end());
    return end;
  }

  double median_error(const std::vector<double>& end, const std::vector<double>& truth) const {
    std::vector<double> errors;
    for (std::size_t i = 0; i < end.size(); i += ensemble.states) {
      double largest = 0;
      for (std::size_t k = i; k < i + ensemble.states; ++k)
        largest = std::max(largest, std::abs(end[k] - truth[k]));
      errors.push_back(std::isnan(largest) ? std::numeric_limits<double>::infinity() : largest);
    }
    std::nth_element(errors.begin(), errors.begin() + errors.size() / 2, errors.end());
    return errors[errors.size() / 2];
  }
};

/// Error and time of a way to integrate over a range of tolerances.
class Curve {
 public:
  Curve(std::string curve_name, Run run, std::function<double()> clock)
      : name(std::move(curve_name)), run_(std::move(run)), clock_(std::move(clock)) {}

  static constexpr int kPoints = 22;  // 1e-4 .. 3e-15, half a decade apart
  static double tolerance(int i) { return std::pow(10., -4 - 0.5 * i); }

  void measure(const Problem& problem, const std::vector<double>& truth, int i) {
    if (times_.empty()) {
      times_.assign(kPoints, std::numeric_limits<double>::infinity());
      errors_.assign(kPoints, 0);
    }
    const auto place = static_cast<std::size_t>(i);
    const double start = clock_();
    const std::vector<double> end = run_(tolerance(i));
    times_[place] = std::min(times_[place], clock_() - start);
    errors_[place] = problem.median_error(end, truth);
  }

  /// Time and tolerance at an error, by interpolation between the last point above and the next.
  std::pair<double, double> at(double error) const {
    for (std::size_t i = 1; i < times_.size(); ++i) {
      if (errors_[i] > error) continue;
      const double above = std::max(errors_[i - 1], error);
      const double part =
          above > errors_[i] ? std::log(above / error) / std::log(above / errors_[i]) : 0;
      return {times_[i - 1] * std::pow(times_[i] / times_[i - 1], part),
              tolerance(static_cast<int>(i)) * std::sqrt(10.) * std::pow(0.1, 0.5 * part)};
    }
    const double none = std::numeric_limits<double>::quiet_NaN();
    return {none, none};
  }
  double time_at(double error) const { return at(error).first; }

  std::string name;

 private:
  Run run_;
  std::function<double()> clock_;
  std::vector<double> times_, errors_;
};

std::vector<Curve> curves_of(const Problem& problem, const LaneKernel& compiled,
                             const LaneKernel& tables, const Options& options) {
  std::vector<Curve> curves;
  curves.emplace_back(
      "single", [&](double tolerance) { return problem.one_by_one(tolerance); }, processor_time);
  const auto add = [&](const std::string& name, const LaneKernel& kernel, int jobs, int order,
                       const std::function<double()>& clock) {
    curves.emplace_back(
        name,
        [&problem, &kernel, jobs, order](double tolerance) {
          return problem.in_lanes(kernel, tolerance, jobs, order);
        },
        clock);
  };
  add("lanes", compiled, 1, 0, processor_time);
  if (options.orders) {
    for (const int order : {8, 12, 16, 20, 24})
      add(fmt::format("order {}", order), compiled, 1, order, processor_time);
  } else {
    add("tables", tables, 1, 0, processor_time);
    add("one thread", compiled, 1, 0, wall_time);
    add("two threads", compiled, 2, 0, wall_time);
  }
  return curves;
}

LaneKernel compiled_kernel(const LaneForm& form) {
  const std::string kernel = kernel_text("runtime/kernels/lanes/lane_quadratic.hpp");
  LaneKernel result = loaded_lanes(compile(emit_lane_module(form, kernel)).path);
  result.numbers = form.numbers;
  return result;
}

/// Whether every way arrives where the reference does.
bool all_arrive(const Problem& problem, std::vector<Curve>& curves,
                const std::vector<double>& truth) {
  bool good = true;
  for (Curve& curve : curves) {
    constexpr int kFine = 18;
    curve.measure(problem, truth, kFine);
    const double error = curve.time_at(1e-10);
    good = good && !std::isnan(error);
  }
  return good;
}

struct Ratios {
  double single = 1, tables = 1, threads = 1;
  int count = 0;
};

void report(const std::string& name, const std::vector<Curve>& curves, double members,
            const Options& options, double error, Ratios& ratios) {
  std::string line = fmt::format("{:<14} {:>6.0e}", name, error);
  for (const Curve& curve : curves) {
    const auto [time, tolerance] = curve.at(error);
    line += fmt::format(" {:>11.2f}", 1e6 * time / members);
    if (options.orders) line += fmt::format(" ({:.0e})", tolerance);
  }
  if (!options.orders) {
    const double single = curves[0].time_at(error);
    const double gain = single / curves[1].time_at(error);
    const double tables = single / curves[2].time_at(error);
    const double threads = curves[3].time_at(error) / curves[4].time_at(error);
    line += fmt::format("  {:>5.2f} {:>6.2f} {:>7.2f}", gain, tables, threads);
    ratios.single *= gain;
    ratios.tables *= tables;
    ratios.threads *= threads;
    ++ratios.count;
  }
  fmt::print("{}\n", line);
  std::fflush(stdout);
}

int run(const Options& options) {
  constexpr double kErrors[] = {1e-6, 1e-12};
  Ratios ratios[2];
  bool good = true;
  for (const std::string& name : options.cases) {
    const Problem problem(options.folder + "/" + name + ".toml", options.quick ? 20 : 1024);
    const LaneForm form = *lane_form(problem.spec.rhs, problem.spec.limits);
    const LaneKernel compiled = compiled_kernel(form), tables = table_driven_lanes(form);
    std::vector<Curve> curves = curves_of(problem, compiled, tables, options);
    const std::vector<double> truth = problem.in_lanes(tables, 1e-15, 0, 24);
    if (options.quick) {
      good = all_arrive(problem, curves, truth) && good;
      continue;
    }
    if (&name == &options.cases.front()) {
      fmt::print("microseconds a trajectory\n{:<14} {:>6}", "case", "error");
      for (const Curve& curve : curves) fmt::print(" {:>11}", curve.name);
      fmt::print("{}\n", options.orders ? "" : "  lanes tables threads");
    }
    for (int repeat = 0; repeat < 3; ++repeat)
      for (int i = 0; i < Curve::kPoints; ++i)
        for (Curve& curve : curves) curve.measure(problem, truth, i);
    for (int e = 0; e < 2; ++e)
      report(name, curves, static_cast<double>(problem.ensemble.size()), options, kErrors[e],
             ratios[e]);
  }
  for (int e = 0; e < 2 && ratios[e].count > 0; ++e) {
    const auto mean = [&](double product) { return std::pow(product, 1. / ratios[e].count); };
    fmt::print(
        "mean at {:.0e}: lanes {:.2f} times a single trajectory, with tables {:.2f}; two "
        "threads {:.2f} times one\n",
        kErrors[e], mean(ratios[e].single), mean(ratios[e].tables), mean(ratios[e].threads));
  }
  return good ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  std::vector<std::string> words;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--quick")
      options.quick = true;
    else if (word == "--orders")
      options.orders = true;
    else
      words.push_back(word);
  }
  if (words.empty()) return 2;
  options.folder = words.front();
  if (words.size() > 1) options.cases.assign(words.begin() + 1, words.end());
  return run(options);
}
