#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

#include "runtime/validated_run.hpp"
#include "symbolic/algebra/number_text.hpp"

namespace casimir::python {

/// The ends of an interval, as texts of rational numbers.
inline pybind11::tuple exact_ends(const RationalInterval& x) {
  return pybind11::make_tuple(rational_text(x.low), rational_text(x.high));
}

/// The same of each interval of a box.
inline pybind11::list exact_ends(const std::vector<RationalInterval>& box) {
  pybind11::list result;
  for (const RationalInterval& x : box) result.append(exact_ends(x));
  return result;
}

/// The same by name. \param names  one for each interval
inline pybind11::dict exact_ends(const std::vector<std::string>& names,
                                 const std::vector<RationalInterval>& box) {
  pybind11::dict result;
  for (std::size_t i = 0; i < box.size(); ++i) result[pybind11::str(names[i])] = exact_ends(box[i]);
  return result;
}

}  // namespace casimir::python
