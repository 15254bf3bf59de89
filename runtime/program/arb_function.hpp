#pragma once

#include <arb.h>

#include "runtime/program.hpp"

namespace casimir {

/// A function of one ball, to so many bits.
using ArbFunction = void (*)(arb_t, const arb_t, slong);

/// What Arb has for an operation that `Arithmetic::function` is asked for: analytic where it has a
/// value.
inline ArbFunction arb_function(Op op) {
  switch (op) {
    case Op::sin:
      return arb_sin;
    case Op::cos:
      return arb_cos;
    case Op::tan:
      return arb_tan;
    case Op::sinh:
      return arb_sinh;
    case Op::cosh:
      return arb_cosh;
    case Op::tanh:
      return arb_tanh;
    default:
      return arb_exp;
  }
}

}  // namespace casimir
