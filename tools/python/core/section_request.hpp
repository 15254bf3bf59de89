#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tools/analysis/section/problem.hpp"
#include "tools/python/core/case.hpp"

namespace casimir::python {

/// The plane and the level of a section, as Python has them.
/// \param plane    a function; without it that of the case
/// \param casimirs names and values
inline SectionRequest section_request(const Model& model, const std::optional<std::string>& plane,
                                      std::optional<bool> upwards, std::optional<double> energy,
                                      std::vector<std::pair<std::string, double>> casimirs) {
  SectionRequest request;
  if (plane) request.plane = FunctionText{model.parse(typed(*plane, "section")), *plane};
  request.upwards = upwards;
  request.energy = energy;
  request.casimirs = std::move(casimirs);
  return request;
}

}  // namespace casimir::python
