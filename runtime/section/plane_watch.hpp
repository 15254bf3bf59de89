#pragma once

#include <cstddef>
#include <optional>

#include "runtime/step/step_watch.hpp"

namespace casimir {

/// What the steps of an orbit are watched for so that its crossings of a surface are seen. The
/// function of a surface may be anything but negligible only where the orbit is for a moment, as
/// exp(-((q - 1/3)/w)^2) - 1/2, or have a corner, as |q| - w: its series about the beginning of a
/// step is then that of something else.
/// \param function  of a surface: see SectionPlane
/// \param states    its first so many inputs are those that a kernel has first
/// \param size      all states of the kernel
/// \return  none where the series shows all by itself that there is, as of polynomials and angles
std::optional<StepWatch> watch_of_plane(const Program& function, std::size_t states,
                                        std::size_t size);

}  // namespace casimir
