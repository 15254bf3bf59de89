#pragma once

#include <ginac/ginac.h>

#include <Eigen/Core>
#include <string>
#include <vector>

#include "codegen/optimise/differentiate.hpp"
#include "runtime/validated_run.hpp"
#include "symbolic/model.hpp"
#include "tools/analysis/section/problem.hpp"

namespace casimir::horseshoe {

/// An autonomous system with a surface s = 0, which counts where s increases, on one level of
/// functions that are proved to be constant: so that the return map acts on a surface.
struct SectionSystem {
  std::vector<std::string> names;        ///< of the n states
  Program rates;                         ///< f, of the states and the time (which it does not use)
  SparseProgram jacobian;                ///< its derivatives
  Program plane;                         ///< s, and its derivative along solutions
  Program constraints;                   ///< s, and then the n - 3 functions of the level
  SparseProgram gradients;               ///< entry (i, k): of constraint k by state i
  std::vector<KnownIntegral> integrals;  ///< the same functions, proved to be constant
  std::vector<std::string> level_names;
  std::vector<RationalInterval> levels;  ///< what is proved holds for all values in these
  std::string plane_text;                ///< as it was written
  bool upwards = true;                   ///< in which direction that is crossed
  Eigen::VectorXd start;                 ///< of the scene; it need not be on the level

  std::size_t states() const { return names.size(); }
};

/// Prepares a scene. The level is that of the scene, or has the energy and the values of Casimir
/// functions of the request.
/// \throws RequestError  where the return map has not two dimensions on the level of what is proved
///                       to be constant, where the system depends on the time, where an assumption
///                       restricts the states, and where the surface is missing or an angle.
SectionSystem section_system(const Model& model, const Scene& scene, const SectionRequest& request);

}  // namespace casimir::horseshoe
