#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tools/analysis/error.hpp"
#include "tools/analysis/section/problem.hpp"
#include "tools/python/core/case.hpp"

namespace casimir::python {

/// The plane and the level of a section, as Python has them.
/// \param plane    a function; without it that of the case
/// \param casimirs names and values
/// \throws RequestError  for a level that is no number
inline SectionRequest section_request(const Model& model, const std::optional<std::string>& plane,
                                      std::optional<bool> upwards, std::optional<double> energy,
                                      std::vector<std::pair<std::string, double>> casimirs) {
  const auto finite = [](const std::string& name, double value) {
    if (!std::isfinite(value))
      throw RequestError("the level of " + name + " must be a finite number");
  };
  if (energy) finite("the energy", *energy);
  for (const auto& [name, value] : casimirs) finite(name, value);
  SectionRequest request;
  if (plane) request.plane = FunctionText{model.parse(typed(*plane, "section")), *plane};
  request.upwards = upwards;
  request.energy = energy;
  request.casimirs = std::move(casimirs);
  return request;
}

}  // namespace casimir::python
