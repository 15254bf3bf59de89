#pragma once

#include <ginac/ginac.h>

#include <optional>
#include <utility>
#include <vector>

#include "symbolic/functions/convert/parts_of_pi.hpp"
#include "symbolic/functions/convert/roots.hpp"
#include "symbolic/functions/convert/units.hpp"
#include "symbolic/functions/generator_table.hpp"
#include "symbolic/functions/sign_table.hpp"

namespace casimir::functions {

/// Sines and cosines of the polynomials of a table.
class Angles {
 public:
  Angles(GeneratorTable& table, SignTable& signs, PartsOfPi& pi, Roots& roots, Units& units,
         Convert convert)
      : table_(table),
        signs_(signs),
        pi_(pi),
        roots_(roots),
        units_(units),
        convert_(std::move(convert)) {}

  /// The sine and the cosine of an angle.
  std::pair<Polynomial, Polynomial> sine_cosine(const Polynomial& angle);
  /// The sine and the cosine of an inverse function as it is.
  /// \param value  atan(v), asin(v), acos(v) or atan2(v, x)
  std::pair<Polynomial, Polynomial> inverse_sine_cosine(const GiNaC::ex& value, unsigned long tag);

 private:
  /// Sine and cosine of a part of an angle, and how often the angle contains that part.
  struct PartOfAngle {
    Polynomial sine, cosine;
    cln::cl_I times;
  };
  std::pair<Polynomial, Polynomial> plain_sine_cosine(const Polynomial& unit);
  std::optional<PartOfAngle> algebraic_sine_cosine(const cln::cl_RA& coefficient,
                                                   const std::vector<unsigned long>& monomial);
  std::optional<PartOfAngle> part_of_inverse(std::size_t index, const cln::cl_I& parts);
  std::optional<PartOfAngle> first_part(std::size_t index, bool half);
  Polynomial half_sine(std::size_t index, const Polynomial& r, const Polynomial& x,
                       const Polynomial& y, const Polynomial& root);
  Polynomial part_cosine(const Polynomial& unit, const Polynomial& whole, unsigned long n);
  Polynomial part_sine(const Polynomial& unit, const Polynomial& cosine, const Polynomial& times,
                       const Polynomial& whole);

  GeneratorTable& table_;
  SignTable& signs_;
  PartsOfPi& pi_;
  Roots& roots_;
  Units& units_;
  Convert convert_;
};

}  // namespace casimir::functions
