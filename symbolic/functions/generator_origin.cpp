#include "symbolic/functions/generator_origin.hpp"

#include "symbolic/functions/convert/elliptic_generators.hpp"

namespace casimir::functions {

Origin origin_of(const GeneratorTable& table, std::size_t place) {
  using Of = Origin::Kind;
  const Generator& g = table.generators().at(place - table.symbols().size());
  switch (g.kind) {
    case Kind::sine:
      return {Of::sine, g.base};
    case Kind::cosine:
      return {Of::cosine, table.at_place(place - 1).base};
    case Kind::exponential:
      return {Of::exponential, g.base};
    case Kind::root:
      return {Of::root, g.base, g.order};
    case Kind::inverse:
      return {Of::inverse, g.base};
    case Kind::absolute:
      return {Of::absolute, g.base, g.order};
    case Kind::imaginary:
      return {Of::imaginary, g.base, g.order};
    case Kind::function:
      break;
  }
  switch (g.order) {
    case kLogarithm:
    case kLogOfAbsolute:
      return {Of::logarithm, g.base};
    case kArcTangent:
      return {Of::arc_tangent, g.base};
    case kArcSine:
    case kArcCosine:
      return {Of::arc_sine, g.base};
    case kArcTangentOfTwo: {
      const Polynomial& y = g.arguments[0];
      const Polynomial& x = g.arguments[1];
      return {Of::arc_tangent_of_two, x * x + y * y};
    }
    case kArbitrary:
    case kLastArbitrary:
      return {Of::arbitrary, g.base};
    case kPartCosine:
    case kPartSine:
    case kSignedHalf:
    case kCosineOfPi:
      return {Of::part_of_angle, g.base};
    default:
      // Of elliptic functions proofs need to know no more than that these are no constants; what
      // asks for more refuses them.
      if (g.order >= kFirstElliptic) return {Of::part_of_angle, g.base};
      return {Of::constant, g.base};
  }
}

}  // namespace casimir::functions
