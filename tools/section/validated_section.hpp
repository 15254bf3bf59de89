#pragma once

#include <optional>
#include <string>

#include "symbolic/model.hpp"
#include "tools/analysis/section/problem.hpp"
#include "tools/cli/cli.hpp"

namespace casimir::tools {

/// `section --validated` without cycles: every crossing of the orbit of a scene.
/// \param duration  as typed, or that of the scene.
/// \return exit status.
int enclose_section(const Common& common, const Model& model, const SectionProblem& problem,
                    const std::optional<std::string>& duration);

/// Orbits that begin all over the domain of possible motion, and how they are looked for.
struct OrbitRequest {
  std::size_t count;
  double tolerance;
  int jobs;
};

/// `section --validated --orbits N`: the same for these orbits, whose starts are exact doubles.
/// \return exit status: that of the worst.
int enclose_orbits(const Common& common, const Model& model, const SectionProblem& problem,
                   const OrbitRequest& orbits, const std::optional<std::string>& duration);

}  // namespace casimir::tools
