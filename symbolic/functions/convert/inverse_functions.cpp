// Inverse functions that are others, up to their sign and quarter turns.
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
#include "symbolic/functions/convert/inverse_functions.hpp"

#include <cln/integer.h>
#include <cln/rational.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "symbolic/functions/convert/denominators.hpp"
#include "symbolic/functions/convert/gaussian_argument.hpp"

namespace casimir::functions {
namespace {

using GiNaC::ex;

/// The sine and cosine of an angle, or of twice the angle.
std::pair<Polynomial, Polynomial> multiple(const GeneratorTable& table,
                                           const std::pair<Polynomial, Polynomial>& of, int times) {
  const auto& [sine, cosine] = of;
  if (times == 1) return of;
  return std::pair(table.checked_product(sine, cosine).scaled(2),
                   table.checked_product(cosine, cosine) - table.checked_product(sine, sine));
}

}  // namespace

Polynomial InverseFunctions::polynomial(const GiNaC::function& f, const Polynomial& v) {
  const std::string name = f.get_name();
  if (name == "atan") return arc_tangent(f, v);
  if (name == "asin" || name == "acos") return arc_sine_or_cosine(f, v);
  return arc_tangent_of_two(f, v);
}

/// The generator of f, or what f is by others.
/// \param factor  of its derivative
Polynomial InverseFunctions::generator(const GiNaC::function& f, const Polynomial& factor,
                                       const Polynomial& key, unsigned long tag) {
  std::size_t index = 0;
  if (table_.find(Kind::function, key, tag, &index) != nullptr) return table_.variable(index);
  if (const auto known = known_inverse(f)) return *known;
  return table_.generator(Kind::function, f, key, tag,
                          [&](const Polynomial& slope) { return slope * factor; });
}

Polynomial InverseFunctions::arc_tangent(const GiNaC::function& f, const Polynomial& v) {
  if (!table_.is_complex() && v.is_constant() && !v.is_zero()) {
    // Between arctangents of rational numbers and Pi there are relations, as Machin's.
    if (const auto known = gaussian_argument(v.term_list()[0].first)) {
      Polynomial sum = convert_(GiNaC::Pi).scaled(cln::cl_RA(known->quarters) / 4);
      for (const auto& [part, times] : known->parts)
        sum += convert_(GiNaC::atan(ex(GiNaC::numeric(part)))).scaled(times);
      return sum;
    }
  }
  const Polynomial one = table_.ring().constant(1);
  return generator(f, inverse_of(table_, one + v * v), v, kArcTangent);
}

Polynomial InverseFunctions::arc_sine_or_cosine(const GiNaC::function& f, const Polynomial& v) {
  const Polynomial one = table_.ring().constant(1);
  const bool sine = f.get_name() == "asin";
  // Of x/|x| it is a quarter of a turn, of that sign; it has no slope.
  if (!table_.is_complex() && table_.numerator(one - table_.checked_product(v, v)).is_zero()) {
    const Polynomial quarter = convert_(GiNaC::Pi).scaled(cln::cl_RA(1) / 2);
    return table_.checked_product(sine ? v : one - v, quarter);
  }
  signs_.imply_between(v);
  const Polynomial slope = inverse_of(table_, roots_.root(one - v * v, 2));
  return sine ? generator(f, slope, v, kArcSine) : generator(f, -slope, v, kArcCosine);
}

/// D atan2(y, x) = (x Dy - y Dx)/(x^2 + y^2); the key is kept by its value.
Polynomial InverseFunctions::arc_tangent_of_two(const GiNaC::function& f, const Polynomial& v) {
  const Polynomial x = convert_(f.op(1));
  const Polynomial squares = x * x + v * v, scale = inverse_of(table_, squares);
  const auto [unreduced, bottom] = table_.fraction(squares);
  const Polynomial top = table_.numerator(unreduced);
  if (!top.is_zero())  // there is no angle at x = y = 0
    signs_.imply_radicand(factors_of(table_, table_.checked_product(top, bottom)), true);
  for (std::size_t i = 0; i < table_.generators().size(); ++i) {
    if (table_.generators()[i].value.is_equal(f)) return table_.variable(i);
  }
  if (const auto known = known_inverse(f)) return *known;
  std::vector<Polynomial> derivatives;
  for (std::size_t i = 0; i < table_.symbols().size(); ++i) {
    derivatives.push_back((x * table_.derivative(v, i) - v * table_.derivative(x, i)) * scale);
  }
  const Polynomial one = table_.ring().constant(1);
  const Polynomial g =
      table_.generator(Kind::function, f, one, kArcTangentOfTwo,
                       [&](const Polynomial&) { return Polynomial(table_.ring()); });
  table_.last().derivatives = std::move(derivatives);
  table_.last().arguments = {v, x};
  return g;
}

InverseFunctions::TurnRange InverseFunctions::range(const Arc& arc) {
  const int sign = signs_.sign_of(convert_(arc.value.op(0)));
  if (arc.tag == kArcCosine) return {sign < 0 ? 1 : 0, sign > 0 ? 1 : 2, true, true};
  if (arc.tag == kArcSine || arc.tag == kArcTangent) {
    const bool ends = arc.tag == kArcSine;
    return {sign > 0 ? 0 : -1, sign < 0 ? 0 : 1, sign > 0 || ends, sign < 0 || ends};
  }
  if (signs_.sign_of(convert_(arc.value.op(1))) > 0) return {-1, 1, true, true};
  return {-2, 2, false, true};
}

/// Whether a - sign*b - quarters is zero wherever it is a whole number of turns.
bool InverseFunctions::is_one_turn_only(const TurnRange& a, const TurnRange& b, int sign,
                                        int quarters) {
  const int low = a.low - (sign > 0 ? b.high : -b.low) - quarters;
  const int high = a.high - (sign > 0 ? b.low : -b.high) - quarters;
  const bool has_low = a.has_low && (sign > 0 ? b.has_high : b.has_low);
  const bool has_high = a.has_high && (sign > 0 ? b.has_low : b.has_high);
  constexpr std::array kTurns = {-8, -4, 4, 8};
  return std::none_of(kTurns.begin(), kTurns.end(), [&](int turn) {
    return (turn > low || (turn == low && has_low)) && (turn < high || (turn == high && has_high));
  });
}

InverseFunctions::Squares InverseFunctions::squares(const Arc& arc) {
  const Polynomial one = table_.ring().constant(1);
  const Polynomial v = convert_(arc.value.op(0));
  const Polynomial square = table_.checked_product(v, v);
  if (arc.tag == kArcSine) return {square, one - square, one};
  if (arc.tag == kArcCosine) return {one - square, square, one};
  if (arc.tag == kArcTangent) return {square, one, one + square};
  const Polynomial x = convert_(arc.value.op(1));
  return {square, table_.checked_product(x, x), table_.checked_product(x, x) + square};
}

InverseFunctions::Squares InverseFunctions::doubled(const Squares& s) const {
  const Polynomial difference = s.cosine - s.sine;  // sin(2a) = 2 sin(a) cos(a)
  return {table_.checked_product(s.sine, s.cosine).scaled(4),
          table_.checked_product(difference, difference),
          table_.checked_product(s.bottom, s.bottom)};
}

/// The square of the sine, with which the same comparisons are made at a point first.
double InverseFunctions::square_at_point(const Arc& arc, std::size_t point) {
  const FunctionProbe probes(table_);
  const double v = probes.value_at(own_probe(point), convert_(arc.value.op(0)));
  if (arc.tag == kArcSine) return v * v;
  if (arc.tag == kArcCosine) return 1 - v * v;
  const double x =
      arc.tag == kArcTangent ? 1 : probes.value_at(own_probe(point), convert_(arc.value.op(1)));
  return v * v / (x * x + v * v);
}

Probe& InverseFunctions::own_probe(std::size_t k) {
  if (probes_[k].coordinates.empty()) probes_[k] = FunctionProbe(table_).probe(k);
  return probes_[k];
}

/// Whether the squares of the sines of these multiples are equal, or add up to 1, at a point.
bool InverseFunctions::may_agree(const Arc& f, const Arc& other, const Multiples& multiples) {
  const auto doubled_at_point = [](double square) { return 4 * square * (1 - square); };
  for (std::size_t point = 0; point < kProbes; ++point) {
    const double own = square_at_point(f, point);
    const double its = square_at_point(other, point);
    if (!std::isfinite(own) || !std::isfinite(its)) continue;
    const double s1 = multiples.own == 2 ? doubled_at_point(own) : own;
    const double s2 = multiples.others == 2 ? doubled_at_point(its) : its;
    return !differ(s1, s2) || !differ(s1, 1 - s2);
  }
  return true;
}

/// The same by algebra: the squares of the sines come without roots.
bool InverseFunctions::agree_in_squares(const Arc& f, const Arc& other,
                                        const Multiples& multiples) {
  const Squares a = squares(f), b = squares(other);
  const Squares of_f = multiples.own == 2 ? doubled(a) : a;
  const Squares of_other = multiples.others == 2 ? doubled(b) : b;
  const auto equal = [&](const Polynomial& second) {
    return table_
        .numerator(table_.checked_product(of_f.sine, of_other.bottom) -
                   table_.checked_product(second, of_f.bottom))
        .is_zero();
  };
  return equal(of_other.sine) || equal(of_other.cosine);
}

/// Whether the arguments of `other` have values where those of f have.
bool InverseFunctions::has_values(const Arc& f, const Arc& other) {
  const auto made_of = [&](const ex& value) {
    std::vector<Polynomial> arguments;
    for (std::size_t i = 0; i < value.nops(); ++i) arguments.push_back(convert_(value.op(i)));
    return table_.generators_in(arguments);
  };
  const std::vector<std::size_t> used = made_of(f.value), inner = made_of(other.value);
  return std::all_of(inner.begin(), inner.end(), [&](std::size_t g) {
    if (std::find(used.begin(), used.end(), g) != used.end()) return true;
    const Generator& own = table_.generators()[g];
    if (own.kind == Kind::inverse) return signs_.is_nowhere_zero(own.base);
    if (own.kind == Kind::root) return signs_.sign_of(own.base) > 0;
    return own.kind != Kind::function;
  });
}

/// What f is by the generator g, whose inverse function is `other`: up to a sign and quarter turns.
std::optional<Polynomial> InverseFunctions::by_turns(const Arc& f, const Arc& other, std::size_t g,
                                                     const Multiples& multiples) {
  const auto [s1, c1] =
      multiple(table_, angles_.inverse_sine_cosine(f.value, f.tag), multiples.own);
  const auto [s2, c2] =
      multiple(table_, angles_.inverse_sine_cosine(other.value, other.tag), multiples.others);
  const TurnRange own = range(f).times(multiples.own);
  const TurnRange its = range(other).times(multiples.others);
  for (const int sign : {1, -1}) {
    const Polynomial s = s2.scaled(sign);
    const std::array turned = {std::pair(s, c2), std::pair(c2, -s), std::pair(-s, -c2),
                               std::pair(-c2, s)};
    for (int k = 0; k < 4; ++k) {
      const int quarters = k == 3 ? -1 : k;
      const auto& [sine, cosine] = turned[static_cast<std::size_t>(k)];
      if (!is_one_turn_only(own, its, sign, quarters) || !table_.numerator(s1 - sine).is_zero() ||
          !table_.numerator(c1 - cosine).is_zero() || !has_values(f, other))
        continue;
      const Polynomial angle =
          table_.variable(g).scaled(cln::cl_RA(sign * multiples.others) / multiples.own);
      if (quarters == 0) return angle;
      return angle + convert_(GiNaC::Pi).scaled(cln::cl_RA(quarters) / (2 * multiples.own));
    }
  }
  return std::nullopt;
}

/// The generator, with a sign and quarter turns, that an inverse function is.
std::optional<Polynomial> InverseFunctions::known_inverse(const GiNaC::function& function) {
  if (table_.is_complex())
    return std::nullopt;  // on the cuts of complex functions values are a convention
  const std::string name = function.get_name();
  const Arc f{function, name == "asin"   ? kArcSine
                        : name == "acos" ? kArcCosine
                        : name == "atan" ? kArcTangent
                                         : kArcTangentOfTwo};
  for (std::size_t g = 0; g < table_.generators().size(); ++g) {
    if (table_.generators()[g].kind != Kind::function) continue;
    const unsigned long tag = table_.generators()[g].order;
    if (tag != kArcSine && tag != kArcCosine && tag != kArcTangent && tag != kArcTangentOfTwo)
      continue;
    const Arc other{table_.generators()[g].value, tag};  // a copy: more generators are made
    for (const Multiples& multiples : {Multiples{1, 1}, Multiples{1, 2}, Multiples{2, 1}}) {
      if (!may_agree(f, other, multiples) || !agree_in_squares(f, other, multiples)) continue;
      if (auto found = by_turns(f, other, g, multiples)) return found;
    }
  }
  return std::nullopt;
}

}  // namespace casimir::functions
