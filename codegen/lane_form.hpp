#pragma once

#include <optional>
#include <string>

#include "runtime/taylor/lane_form.hpp"
#include "symbolic/case/limits.hpp"

namespace casimir {

/// The form of a right-hand side for ensembles, or nothing where it is of another kind: functions
/// or quotients of states, products of three, the time, or more than 24 states. What multiplies the
/// states may be any expression in the run-time parameters; numbers are exact until they are
/// rounded. Always the same for the same program.
/// \param limits  of these numbers, see `codegen::constant_value`
std::optional<LaneForm> lane_form(const Program& rhs, const Limits& limits);

/// The text of a module for ensembles of that form: its tables as constants in front of the kernel,
/// whose loops are then written out.
/// \param kernel_source  the text of runtime/kernels/lanes/lane_quadratic.hpp with all it includes.
std::string emit_lane_module(const LaneForm& form, const std::string& kernel_source);

}  // namespace casimir
