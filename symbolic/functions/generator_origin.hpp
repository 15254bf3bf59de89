#pragma once

#include "symbolic/functions/generator_table.hpp"

namespace casimir::functions {

/// What a generator of the ring is.
struct Origin {
  enum class Kind {
    sine,    ///< its cosine stands just behind it
    cosine,  ///< of the argument of the sine before it
    exponential,
    root,      ///< of order `order`
    inverse,   ///< 1/argument
    absolute,  ///< the positive root of the argument, which is a square
    imaginary,
    constant,   ///< such as Pi
    logarithm,  ///< of |argument|
    arc_tangent,
    arc_tangent_of_two,
    arc_sine,       ///< or cosine
    part_of_angle,  ///< a sine or cosine of a part of an inverse function, or of Pi
    arbitrary,      ///< a value of an arbitrary function, or of a derivative of one
  };
  Kind kind;
  Polynomial argument;      ///< of a function of two, the sum of their squares
  unsigned long order = 1;  ///< of a root, and of I, the root of -1
};

/// \param place  of the generator among the variables of the ring, behind the symbols
Origin origin_of(const GeneratorTable& table, std::size_t place);

}  // namespace casimir::functions
