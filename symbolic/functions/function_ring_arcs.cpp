// Inverse functions in a FunctionRing that are others, up to their sign and quarter turns.
//
// Two angles with one sine and one cosine differ by a multiple of 2 Pi. Where the ranges of the
// inverse functions leave no such difference but zero, they are equal, and that at every point at
// which both have real values, the ends of their ranges included:
//   asin(-u) = -asin(u), acos(-u) = Pi - acos(u), asin(u) + acos(u) = Pi/2,
//   atan(1/u) = Pi/2 - atan(u) for u > 0 and -Pi/2 - atan(u) for u < 0,
//   atan2(y, x) = atan(y/x) for x > 0, atan2(t y, t x) = atan2(y, x) for t > 0,
//   asin(u/sqrt(1 + u^2)) = atan(u),
//   2*atan(u/(1 + sqrt(1 + u^2))) = atan(u), 2*atan(|u|) = acos((1 - u^2)/(1 + u^2)),
//   2*asin(sqrt((1 - u)/2)) = acos(u): of one of the two the sine and cosine are those of twice it.
// The signs come in by the roots in the sines and cosines, which know no more than is declared.
// atan2(-y, x) = -atan2(y, x) is not among them: on the cut both are Pi.
#include <algorithm>
#include <array>
#include <cmath>

#include "symbolic/functions/function_ring.hpp"

namespace casimir {
namespace {

/// Of an inverse function, in quarters of a turn.
struct Range {
  int low, high;
  bool has_low, has_high;  ///< whether the ends belong to it

  /// Of the function times a positive number.
  Range times(int factor) const { return {low * factor, high * factor, has_low, has_high}; }
};

/// Whether a - sign*b - quarters is zero wherever it is a whole number of turns.
bool is_one_turn_only(const Range& a, const Range& b, int sign, int quarters) {
  const int low = a.low - (sign > 0 ? b.high : -b.low) - quarters;
  const int high = a.high - (sign > 0 ? b.low : -b.high) - quarters;
  const bool has_low = a.has_low && (sign > 0 ? b.has_high : b.has_low);
  const bool has_high = a.has_high && (sign > 0 ? b.has_low : b.has_high);
  constexpr std::array kTurns = {-8, -4, 4, 8};
  return std::none_of(kTurns.begin(), kTurns.end(), [&](int turn) {
    return (turn > low || (turn == low && has_low)) && (turn < high || (turn == high && has_high));
  });
}

}  // namespace

/// The generator, with a sign and quarter turns, that an inverse function is.
std::optional<Polynomial> FunctionRing::known_inverse(const GiNaC::function& f) {
  if (complex_) return std::nullopt;  // on the cuts of complex functions values are a convention
  const std::string name = f.get_name();
  const Polynomial one = ring_->constant(1);
  const auto tag = name == "asin"   ? kArcSine
                   : name == "acos" ? kArcCosine
                   : name == "atan" ? kArcTangent
                                    : kArcTangentOfTwo;
  const auto range = [&](const GiNaC::ex& value, unsigned long kind) {
    const int sign = sign_of(convert(value.op(0)));
    if (kind == kArcCosine) return Range{sign < 0 ? 1 : 0, sign > 0 ? 1 : 2, true, true};
    if (kind == kArcSine || kind == kArcTangent) {
      const bool ends = kind == kArcSine;
      return Range{sign > 0 ? 0 : -1, sign < 0 ? 0 : 1, sign > 0 || ends, sign < 0 || ends};
    }
    if (sign_of(convert(value.op(1))) > 0) return Range{-1, 1, true, true};
    return Range{-2, 2, false, true};
  };
  struct Squares {
    Polynomial sine, cosine, bottom;
  };
  const auto squares = [&](const GiNaC::ex& value, unsigned long kind) {
    const Polynomial v = convert(value.op(0));
    const Polynomial square = checked_product(v, v);
    if (kind == kArcSine) return Squares{square, one - square, one};
    if (kind == kArcCosine) return Squares{one - square, square, one};
    if (kind == kArcTangent) return Squares{square, one, one + square};
    const Polynomial x = convert(value.op(1));
    return Squares{square, checked_product(x, x), checked_product(x, x) + square};
  };
  const auto doubled = [&](const Squares& s) {  // sin(2a) = 2 sin(a) cos(a)
    const Polynomial difference = s.cosine - s.sine;
    return Squares{checked_product(s.sine, s.cosine).scaled(4),
                   checked_product(difference, difference), checked_product(s.bottom, s.bottom)};
  };
  // The square of the sine, with which the same comparisons are made at a point first.
  const auto square_at_point = [&](const GiNaC::ex& value, unsigned long kind, std::size_t point) {
    const double v = value_at(own_probe(point), convert(value.op(0)));
    if (kind == kArcSine) return v * v;
    if (kind == kArcCosine) return 1 - v * v;
    const double x = kind == kArcTangent ? 1 : value_at(own_probe(point), convert(value.op(1)));
    return v * v / (x * x + v * v);
  };
  const auto doubled_at_point = [](double square) { return 4 * square * (1 - square); };
  const auto multiple = [&](const std::pair<Polynomial, Polynomial>& of, int times) {
    const auto& [sine, cosine] = of;
    if (times == 1) return of;
    return std::pair(checked_product(sine, cosine).scaled(2),
                     checked_product(cosine, cosine) - checked_product(sine, sine));
  };
  /// The arguments of `other` have values where those of f have.
  const auto has_values = [&](std::size_t other) {
    const auto made_of = [&](const GiNaC::ex& value) {
      std::vector<Polynomial> arguments;
      for (std::size_t i = 0; i < value.nops(); ++i) arguments.push_back(convert(value.op(i)));
      return generators_in(arguments);
    };
    const std::vector<std::size_t> used = made_of(f), inner = made_of(generators_[other].value);
    return std::all_of(inner.begin(), inner.end(), [&](std::size_t g) {
      if (std::find(used.begin(), used.end(), g) != used.end()) return true;
      const Generator& own = generators_[g];
      if (own.kind == Kind::inverse) return is_nowhere_zero(own.base);
      if (own.kind == Kind::root) return sign_of(own.base) > 0;
      return own.kind != Kind::function;
    });
  };
  for (std::size_t g = 0; g < generators_.size(); ++g) {
    if (generators_[g].kind != Kind::function) continue;
    const unsigned long other = generators_[g].order;
    if (other != kArcSine && other != kArcCosine && other != kArcTangent &&
        other != kArcTangentOfTwo)
      continue;
    const auto may_agree = [&](int times, int others) {
      for (std::size_t point = 0; point < kProbes; ++point) {
        const double own = square_at_point(f, tag, point);
        const double its = square_at_point(generators_[g].value, other, point);
        if (!std::isfinite(own) || !std::isfinite(its)) continue;
        const double s1 = times == 2 ? doubled_at_point(own) : own;
        const double s2 = others == 2 ? doubled_at_point(its) : its;
        return !differ(s1, s2) || !differ(s1, 1 - s2);
      }
      return true;
    };
    for (const auto& [times, others] : {std::pair(1, 1), std::pair(1, 2), std::pair(2, 1)}) {
      if (!may_agree(times, others)) continue;
      // The squares of the sines come without roots.
      const Squares a = squares(f, tag), b = squares(generators_[g].value, other);
      const Squares of_f = times == 2 ? doubled(a) : a, of_other = others == 2 ? doubled(b) : b;
      const auto equal = [&, first = of_f.sine](const Polynomial& second) {
        return numerator(checked_product(first, of_other.bottom) -
                         checked_product(second, of_f.bottom))
            .is_zero();
      };
      if (!equal(of_other.sine) && !equal(of_other.cosine)) continue;
      const auto [s1, c1] =
          multiple(inverse_sine_cosine({Kind::function, f, one, tag, {}, 1}), times);
      const auto [s2, c2] = multiple(inverse_sine_cosine(Generator(generators_[g])), others);
      const Range own = range(f, tag).times(times);
      const Range its = range(generators_[g].value, other).times(others);
      for (const int sign : {1, -1}) {
        const Polynomial s = s2.scaled(sign);
        const std::array turned = {std::pair(s, c2), std::pair(c2, -s), std::pair(-s, -c2),
                                   std::pair(-c2, s)};
        for (int k = 0; k < 4; ++k) {
          const int quarters = k == 3 ? -1 : k;
          const auto& [sine, cosine] = turned[static_cast<std::size_t>(k)];
          if (!is_one_turn_only(own, its, sign, quarters) || !numerator(s1 - sine).is_zero() ||
              !numerator(c1 - cosine).is_zero() || !has_values(g))
            continue;
          const Polynomial angle =
              ring_->variable(symbols_.size() + g).scaled(cln::cl_RA(sign * others) / times);
          if (quarters == 0) return angle;
          return angle + convert(GiNaC::Pi).scaled(cln::cl_RA(quarters) / (2 * times));
        }
      }
    }
  }
  return std::nullopt;
}

}  // namespace casimir
