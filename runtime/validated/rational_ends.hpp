#pragma once

#include "runtime/validated/arb_ball.hpp"
#include "runtime/validated_run.hpp"

namespace casimir::validated {

/// The ends of a ball, which are rational numbers: exactly, but where a ball that is no point has
/// an end or a radius below 2^-20000, which is rounded away from it.
/// \throws std::domain_error  where it is not finite.
RationalInterval ends_of(const ArbBall& ball);

}  // namespace casimir::validated
