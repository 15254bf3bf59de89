#pragma once

#include <cln/float.h>

#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "codegen/compile.hpp"
#include "codegen/scene_hamiltonian.hpp"
#include "codegen/specialise.hpp"
#include "runtime/integrate.hpp"
#include "symbolic/model.hpp"

namespace casimir {

/// A scene made ready to run: generated code, and its numbers in double.
struct PreparedScene {
  Specialisation specialisation;
  std::vector<double> initial;     ///< of the kept states
  std::vector<double> rounding;    ///< what rounding them to double left out
  std::vector<double> parameters;  ///< at run time; empty when folded
  std::vector<double> parameter_rounding;
  double duration = 0;                          ///< see `duration_of`
  double duration_rounding = 0;                 ///< what rounding it to double left out
  Location where;                               ///< of the scene in its file
  std::optional<SceneHamiltonian> hamiltonian;  ///< of a method that needs it
  std::string no_hamiltonian;                   ///< why there is none

  /// For Settings; the scene must outlive it.
  InvariantTerms invariant_terms() const;
  double generate_seconds = 0;
};

/// What a scene is specialised for.
struct SceneOptions {
  bool fold_parameters = true;
  std::vector<std::string> keep_parameters = {};  ///< although the others are folded
  std::optional<std::vector<std::string>> observe;
};

/// Specialises a scene and rounds its data.
/// \throws ModelError  for data outside double's range.
PreparedScene prepare(const Model& model, const Scene& scene, const SceneOptions& options = {});

/// The duration of a scene.
/// \throws CaseError  where the scene gives none.
double duration_of(const PreparedScene& run);
/// \throws CaseError  where the scene gives no duration.
void require_duration(const Scene& scene);

/// The module of a scene for one method: from the cache, or compiled. Modules of methods that need
/// no kernel of ours are one and the same.
struct CompiledModule {
  Module module;
  double seconds = 0;  ///< to compile or fetch it
  bool from_cache = false;
  bool compiled = true;      ///< false: table-driven or interpreted
  std::string warning = {};  ///< what the user should know about how it was made, or empty
};
/// \throws ModelError  where the method splits the Hamiltonian and it does not split, or is defined
///                     for quadratic equations or free bodies and this is none.
CompiledModule compile_for(const PreparedScene& run, const Method& method);

/// Whether the method can do anything with the scene: those that split the Hamiltonian need one
/// that splits, Kahan's map quadratic equations, Moser's and Veselov's a free body.
bool suits(const PreparedScene& run, const Method& method);

/// What `load` loads of a compiled object.
/// \throws EnvironmentError  where it cannot be loaded.
template <class Load>
auto loaded(const Load& load) {
  try {
    return load();
  } catch (const std::runtime_error& problem) {
    throw EnvironmentError(problem.what());
  }
}

/// What is said where a compiled module would be but for the compiler.
inline constexpr const char* kInterpretedWarning =
    "there is no C++ compiler: the equations are interpreted, which is several times slower; "
    "install one, for instance with: apt-get install g++";

/// Digits to which constants such as sqrt(2)/2 are evaluated before they are rounded to double.
inline constexpr int kConstantDigits = 60;

/// The numbers of a scene, as Specialisation::start lists them.
std::vector<cln::cl_F> start_values(const Specialisation& specialisation, int digits);

/// The nearest double.
double rounded(const cln::cl_F& value);
/// What is left of a number when its nearest double is taken away.
double remainder(const cln::cl_F& value, double nearest);

/// A watch for `--time-limit`: answers true once that many seconds have passed; never for 0.
std::function<bool()> time_limit(double seconds);

}  // namespace casimir
