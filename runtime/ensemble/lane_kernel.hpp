#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "runtime/module_abi.h"
#include "runtime/taylor/lane_form.hpp"

namespace casimir {

class StepWatch;

/// What advances the members of an ensemble, several in a register.
struct LaneKernel {
  std::string instruction_set;  ///< "avx512", "avx2" or "baseline"
  int lanes = 1;                ///< members in a register
  /// Threads may call it at the same time, each with a request of its own.
  std::function<void(const casimir_ensemble*)> run;
  /// What the kernel wants of a member beside its state, from the parameters. Without outputs:
  /// the parameters themselves.
  Program numbers;
  /// What its steps are watched for, or null: nothing in polynomials of degree two.
  std::shared_ptr<const StepWatch> watch = nullptr;

  /// Has its steps watched for what may be stepped over.
  /// \param rhs  the right-hand side.
  void watch_steps_of(const Program& rhs);
};

/// The instruction sets that have a table-driven kernel of their own here, the widest that this
/// processor runs first. Never empty.
std::vector<std::string> lane_targets();

/// The table-driven kernel, which needs no compiler.
/// \param target  one of `lane_targets`; empty: the first.
/// \throws std::invalid_argument  if this processor does not run it.
LaneKernel table_driven_lanes(LaneForm form, const std::string& target = {});

/// A compiled kernel for ensembles.
/// \throws std::runtime_error  as Module::load does.
LaneKernel loaded_lanes(const std::string& path);

}  // namespace casimir
