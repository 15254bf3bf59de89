#pragma once

#include <pybind11/numpy.h>

#include <optional>
#include <stdexcept>

#include "tools/analysis/error.hpp"
#include "tools/analysis/run_request.hpp"

namespace casimir::python {

/// An array of numbers, one row after the other.
using Doubles = pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast>;
/// A number, or None.
using Choice = std::optional<double>;

/// What is asked of a run. \param tolerance, rtol, atol  none: as `RunRequest` says.
inline RunRequest request(Choice duration, Choice tolerance, Choice rtol = {}, Choice atol = {}) {
  RunRequest result;
  result.duration = duration;
  result.tolerance = tolerance;
  result.rtol = rtol;
  result.atol = atol;
  return result;
}

/// `work` with what the libraries say of impossible settings as an error of the package.
template <class Work>
auto settled(const Work& work) {
  try {
    return work();
  } catch (const std::invalid_argument& problem) {
    throw RequestError(problem.what());
  }
}

}  // namespace casimir::python
