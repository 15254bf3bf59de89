#include "tools/analysis/sweep/deviations.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <stdexcept>
#include <thread>

#include "codegen/specialise.hpp"
#include "tools/analysis/error.hpp"

namespace casimir {

PreparedScene with_deviation(const Model& model, const Scene& scene, const PreparedScene& run) {
  const Specialisation& s = run.specialisation;
  if (s.uses_time)
    throw RequestError("the equations depend on the time: deviations are those of a flow");
  PreparedScene deviating = run;
  SpecialiseOptions what;
  what.keep_parameters = s.parameters;
  what.observe = s.states;
  what.invariants = what.jacobian = false;
  what.variational = true;
  Specialisation& twice = deviating.specialisation;
  twice = specialise(model, scene, what);
  twice.rhs = twice.variational;
  for (const std::string& name : s.states) twice.states.push_back("delta_" + name);
  double norm = 0;
  std::vector<double> deviation;
  for (std::size_t i = 0; i < s.states.size(); ++i) {
    deviation.push_back(1 + 0.618 * static_cast<double>(i % 3) - 0.27 * static_cast<double>(i));
    norm = std::hypot(norm, deviation.back());
  }
  for (const double d : deviation) deviating.initial.push_back(d / norm);
  deviating.rounding.resize(deviating.initial.size());
  return deviating;
}

const Method& deviation_method(const PreparedScene& run, const Method& method) {
  return method.name == "taylor" && !run.parameters.empty() ? *find_method("taylor-compiled")
                                                            : method;
}

std::string reason_of_deviations(Status status) {
  const std::string reason = reason_of(status);
  return status == Status::no_convergence
             ? reason + ", or it is not known how deviations pass a jump of the equations"
             : reason;
}

std::size_t threads_for(const std::vector<std::size_t>& points, int threads) {
  return std::min<std::size_t>(static_cast<std::size_t>(threads), points.size());
}

std::vector<PointResult> each_with_module(
    const PreparedScene& deviating, const Method& method, const std::vector<std::size_t>& points,
    int threads, const std::function<bool()>& give_up, const PointResult& unknown,
    const std::function<PointResult(const Module& module, std::size_t thread, std::size_t point)>&
        follow) {
  std::vector<PointResult> results(points.size(), unknown);
  // Exact numbers are counted without locks: whatever holds any is made in this thread.
  std::vector<CompiledModule> modules;
  const std::size_t workers = threads_for(points, threads);
  for (std::size_t i = 0; i < workers; ++i) modules.push_back(compile_for(deviating, method));
  std::atomic<std::size_t> next = 0;
  std::vector<std::exception_ptr> problems(workers);
  std::vector<std::jthread> pool;
  for (std::size_t i = 0; i < workers; ++i)
    pool.emplace_back([&, i] {
      try {
        for (std::size_t k = next++; k < points.size() && !(give_up && give_up()); k = next++)
          results[k] = follow(modules[i].module, i, points[k]);
      } catch (...) {
        problems[i] = std::current_exception();
      }
    });
  pool.clear();
  for (const std::exception_ptr& problem : problems) {
    if (!problem) continue;
    try {
      std::rethrow_exception(problem);
    } catch (const std::invalid_argument& said) {
      throw RequestError(said.what());
    }
  }
  return results;
}

}  // namespace casimir
