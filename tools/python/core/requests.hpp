#pragma once

#include <pybind11/numpy.h>

#include <optional>
#include <stdexcept>

#include "tools/analysis/error.hpp"
#include "tools/analysis/run_request.hpp"

namespace casimir::python {

/// An array of numbers, one row after the other. Of complex ones NumPy would drop a part: they are
/// refused.
class Doubles
    : public pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast> {
 public:
  using array_t::array_t;
};
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

namespace pybind11::detail {

template <>
struct type_caster<casimir::python::Doubles> : pyobject_caster<casimir::python::Doubles> {
  bool load(handle source, bool) {
    if (isinstance<array>(source) && reinterpret_borrow<array>(source).dtype().kind() == 'c')
      throw type_error("an array of complex numbers, where real ones are expected");
    const auto numbers = casimir::python::Doubles::ensure(source);
    if (!numbers) PyErr_Clear();
    if (numbers) value = reinterpret_borrow<casimir::python::Doubles>(numbers);
    return static_cast<bool>(numbers);
  }
};

}  // namespace pybind11::detail
