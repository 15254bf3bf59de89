#pragma once

#include <cln/rational.h>
#include <ginac/ginac.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "codegen/specialise.hpp"
#include "runtime/validated_run.hpp"
#include "symbolic/model.hpp"

namespace casimir {

/// Parameters that may have any value of an interval around that of the scene, and how far it goes
/// to both sides.
using ParameterRanges = std::vector<std::pair<std::string, cln::cl_RA>>;

/// That what is proved of the case holds all over the ranges.
/// \throws RequestError  for a name that is no parameter, and for one that an assumption ties to
///                       others.
void check_ranges(const Model& model, const ParameterRanges& ranges);

/// The scene with the symbols of these parameters in the place of their values: so that
/// `Model::at_parameters` leaves them.
Scene scene_over(const Model& model, const Scene& scene, const ParameterRanges& ranges);
/// The interval of each of these symbols.
std::vector<std::pair<GiNaC::symbol, RationalInterval>> intervals_of(const Model& model,
                                                                     const Scene& scene,
                                                                     const ParameterRanges& ranges);

/// What is asked of `enclose`.
struct ValidatedOptions {
  std::optional<GiNaC::ex> duration;   ///< an exact constant; without it that of the scene
  cln::cl_RA initial_radius = 0;       ///< by how much each initial value may be off, on both sides
  std::vector<cln::cl_RA> radii = {};  ///< the same for each state, where it is not empty
  ParameterRanges ranges = {};
  std::optional<std::vector<std::string>> observe = {};  ///< see SpecialiseOptions
  bool contract = true;                                  ///< by what is proved to be an integral
  ValidatedSettings run = {};                            ///< digits, samples, limits
};

/// An enclosure with what it is one of.
struct ValidatedMotion {
  Specialisation specialisation;  ///< the programs that were enclosed
  /// The states, and then the parameters of `ranges`: those of the boxes of `run`.
  std::vector<std::string> names;
  ValidatedRun run;  ///< what was proved
  /// A sentence about each invariant that could not be used, since it is not proved.
  std::vector<std::string> doubts;
};

/// An enclosure before it is computed.
struct PreparedEnclosure {
  Specialisation specialisation;    ///< the programs that are enclosed
  std::vector<std::string> names;   ///< as of ValidatedMotion
  ValidatedProblem problem;         ///< with the integrals that are proved
  std::vector<std::string> doubts;  ///< as of ValidatedMotion
};

/// What `enclose` encloses. \throws as it.
PreparedEnclosure prepare_enclosure(const Model& model, const Scene& scene,
                                    const ValidatedOptions& options = {});

/// Encloses the solutions of a scene: initial values, parameters and duration are the exact numbers
/// of the model. What is proved is said at ValidatedRun. It rests on the arithmetic of
/// runtime/validated, on Arb's functions and constants, on the exact algebra of the
/// specialisation, and, for each integral of `contracted_by`, on its proof.
/// \throws RequestError  for a range of a parameter that an assumption ties to others.
/// \throws ModelError, CaseError  as `specialise`, and where there is no duration.
ValidatedMotion enclose(const Model& model, const Scene& scene,
                        const ValidatedOptions& options = {});

}  // namespace casimir
