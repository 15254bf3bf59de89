#pragma once

#include <optional>
#include <string>
#include <vector>

#include "symbolic/model.hpp"
#include "tools/analysis/run/assessed_run.hpp"
#include "tools/plot/plot.hpp"

namespace casimir::tools {

/// States along a run, closely enough to be drawn as curves.
struct Motion {
  std::vector<std::string> names;  ///< of the states
  std::vector<double> times;
  std::vector<std::vector<double>> states;
};

/// "Kovalevskaya top, scene default".
std::string picture_title(const Model& model, const Scene& scene);

/// The run once more, up to where it came, with many samples.
/// \param every  time between them; 0: as the steps of the run tell
Motion motion_of(const PreparedScene& run, const AssessedRun& judged, double every = 0);

/// Names of states, or expressions over the variables, against time.
/// \param what  empty: all states
/// \throws CaseError, UsageError
Plot time_picture(const Model& model, const Scene& scene, const Motion& motion,
                  const std::vector<std::string>& what);

/// One quantity against another one: a phase curve.
Plot phase_picture(const Model& model, const Scene& scene, const Motion& motion,
                   const std::string& x, const std::string& y);

/// A vector of the phase space whose length the motion keeps, on its sphere: the part in front
/// solid, the part behind dotted.
/// \param name  of the vector; empty: the first one
/// \throws UsageError  if there is none
Plot sphere_picture(const Model& model, const Scene& scene, const Motion& motion,
                    const std::string& name);

/// The third axis of the body in space, whose vertical is a vector that dv/dt = v x dH/dM turns:
/// the body's apex on the fixed sphere.
/// \param name  of that vector; empty: the first one
/// \throws UsageError  if there is none
Plot apex_picture(const Model& model, const Scene& scene, const Motion& motion,
                  const std::string& name);

/// Whether such pictures can be had; for pages, which show what there is.
bool has_sphere(const Motion& motion);
bool has_apex(const Model& model, const Motion& motion);

}  // namespace casimir::tools
