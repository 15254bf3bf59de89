#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "codegen/optimise/differentiate.hpp"
#include "codegen/optimise/lower.hpp"
#include "runtime/program.hpp"
#include "symbolic/case/limits.hpp"
#include "symbolic/model.hpp"

namespace casimir {

using codegen::count_operations;
using codegen::OperationCount;

/// Something that the case file has and the generated code does not.
struct LeftOut {
  std::string kind;    ///< "parameter", "state", "invariant", "term", "time", "values"
  std::string name;    ///< "r", "g3", "K", "M1*M2 in dM3", "t", "q <= 0"
  std::string reason;  ///< "folded to 1", "not needed for M1, g1", ..
};

/// What is generated of a scene, and what stays open in it.
struct SpecialiseOptions {
  /// Replace the parameters by the scene's values; otherwise they are inputs at run time, and all
  /// that is generated is the same whatever their values.
  bool fold_parameters = true;
  /// Parameters that are inputs at run time although the others are replaced.
  std::vector<std::string> keep_parameters = {};
  /// States or invariants that are wanted; none: those of the scene; empty: everything.
  std::optional<std::vector<std::string>> observe;
  bool invariants = true;
  bool gradients = false;  ///< of the invariants
  bool jacobian = true;
  bool variational = false;
  bool taylor = false;  ///< emitted headers shall have the Taylor coefficients of solutions
};

/// What is generated for one scene of a case: exact straight-line programs and where they come
/// from.
///
/// The inputs of the programs are the kept states, the run-time parameters and the time. Everything
/// is the same in every process: nothing follows GiNaC's order of terms.
struct Specialisation {
  std::string case_name, file, scene, title, source;
  std::string hamiltonian;  ///< over the symbols of the file; empty for a system given by equations
  std::vector<std::pair<std::string, std::string>> values;  ///< each parameter and its exact value
  std::string time;                                         ///< what the file calls it, or empty
  bool uses_time = false;                                   ///< some program depends on the time

  std::vector<std::string> states;           ///< the kept ones, in the order of the file
  std::vector<int> state_indices;            ///< their indices in Model::variables
  std::vector<std::string> parameters;       ///< inputs at run time, in the order of the file
  std::vector<std::string> invariant_names;  ///< "H" first, then Casimirs and integrals

  Program rhs;              ///< outputs "dM1", ..: the time derivatives of the kept states
  Program invariants;       ///< one output for each of `invariant_names`
  SparseProgram gradients;  ///< d invariant_column / d state_row
  bool has_gradients = false;
  SparseProgram jacobian;  ///< d rhs_row / d state_column
  bool has_jacobian = false;
  /// `rhs` and the variational equations, as the right-hand side of a system of twice the size: its
  /// states are the kept ones and a deviation from each, as in "delta_M1".
  Program variational;
  bool has_variational = false;
  bool taylor = false;

  /// Of a map: then `rhs` has the next states, and whatever is said of derivatives with respect to
  /// the time has no meaning.
  bool of_map = false;
  Program inverse;  ///< of a map: outputs are the states before
  bool has_inverse = false;

  /// No inputs; outputs: initial values of the kept states, values of the run-time parameters, and
  /// the duration, 0 where the scene has none.
  Program start;
  bool has_duration = true;

  Limits limits{};  ///< of the model: numbers of the programs are held to them

  OperationCount general;      ///< one right-hand side of the case as it is in the file
  OperationCount specialised;  ///< `rhs`
  std::vector<LeftOut> left_out;
};

/// Binds the parameters of a scene exactly, drops what its observed quantities do not need, and
/// writes the rest as short programs.
/// \throws ModelError  for an unknown name to observe or to keep, and where the values of the
///                     parameters, at run time or not, make an expression undefined; the text names
///                     the function and the values.
Specialisation specialise(const Model& model, const Scene& scene,
                          const SpecialiseOptions& options = {});

}  // namespace casimir
