#pragma once

#include <string>
#include <vector>

#include "symbolic/model.hpp"
#include "tools/cli/cli.hpp"

namespace casimir::tools {

/// What `section --symmetry` was asked.
struct SymmetricSectionRequest {
  const Common& common;
  const Model& model;
  const Scene& scene;
  std::vector<std::string> symmetry;  ///< NAME=EXPR, one for each variable that is moved
  std::string period;                 ///< an exact constant, or empty: the duration of the scene
  bool keep_period = false;
  double tolerance = 1e-14;
};

/// Finds the cycle with x(t + T/n) = S x(t) near the start of the scene and reports it.
/// \return the exit status
int section_with_symmetry(const SymmetricSectionRequest& request);

}  // namespace casimir::tools
