#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "tools/analysis/run/prepared_scene.hpp"
#include "tools/analysis/sweep/task.hpp"

namespace casimir {

/// The states and one deviation, by the variational equations: a system of twice the size. The
/// deviation is along the same direction everywhere, one that a system is unlikely to single out.
/// \param run  of the same scene, with the parameters that are kept
/// \throws RequestError  for equations that depend on the time
PreparedScene with_deviation(const Model& model, const Scene& scene, const PreparedScene& run);

/// The method that integrates deviations: the tables of the one that needs no compiler hold the
/// values of the parameters, which a sweep changes.
const Method& deviation_method(const PreparedScene& run, const Method& method);

/// Does the same with each of these points on several threads, each with a module of its own.
/// \param deviating  of `with_deviation`
/// \param follow  told which of the threads it is done in, from 0, for what serves one at a time
/// \param unknown  the result of a point that is not done
/// \throws RequestError  for settings that cannot be
std::vector<PointResult> each_with_module(
    const PreparedScene& deviating, const Method& method, const std::vector<std::size_t>& points,
    int threads, const std::function<bool()>& give_up, const PointResult& unknown,
    const std::function<PointResult(const Module& module, std::size_t thread, std::size_t point)>&
        follow);

/// Why deviations could not be followed to the end: a sentence.
std::string reason_of_deviations(Status status);

/// How many threads `each_with_module` takes.
std::size_t threads_for(const std::vector<std::size_t>& points, int threads);

}  // namespace casimir
