#pragma once

#include <string>

#include "runtime/validated/arb_ball.hpp"

namespace casimir::certificate {

using validated::ArbBall;

/// The middle of a ball, exactly: "0", or as "-0x1b3p-52".
std::string middle_text(const ArbBall& ball);
/// At least the size of everything in a ball.
std::string size_text(const ArbBall& ball);
/// A number rounded to a double that is not above it, or not below it.
std::string double_text(const arf_t number, bool upwards);

/// The number of a text. \throws std::invalid_argument  for what `is_traced_number` refuses.
ArbBall number_of(const std::string& text);

}  // namespace casimir::certificate
