#pragma once

#include <string>
#include <vector>

#include "codegen/scene_hamiltonian.hpp"
#include "runtime/program.hpp"

namespace casimir {

/// A Hamiltonian as the sum of parts whose flows are known in closed form.
struct Splitting {
  std::vector<std::string> parts;  ///< each part of the Hamiltonian, over the names of the file
  /// For each part, what its flow adds to the states in a time: inputs are the states, the run-time
  /// parameters and the time; one output a state. Exact, whatever the time.
  std::vector<Program> flows;
};

/// Splits the Hamiltonian. Parts are sums of terms along whose common field the field itself does
/// not change (x + t X(x): kinetic and potential energy, functions of commuting variables);
/// functions of one variable, or of one linear form, of a Lie algebra (rotations about an axis of
/// the body and their likes), for which quadratic forms are brought to sums of squares; and
/// quadratic forms of canonical variables with a linear flow of the same kind (McLachlan, Quispel:
/// Splitting methods, Acta Numerica 11 (2002) 341).
/// \throws ModelError  naming the first term that no part can take.
Splitting split(const SceneHamiltonian& source);

namespace codegen {
/// For each state, whether a flow adds anything but zero to it.
std::vector<bool> moved_states(const Program& flow);
}  // namespace codegen

}  // namespace casimir
