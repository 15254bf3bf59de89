#pragma once

#include "runtime/validated/arb_ball.hpp"
#include "runtime/validated_run.hpp"

namespace casimir::validated {

/// The ends of a ball, which are rational numbers: exactly.
/// \throws std::domain_error  where it is not finite.
RationalInterval ends_of(const ArbBall& ball);

}  // namespace casimir::validated
