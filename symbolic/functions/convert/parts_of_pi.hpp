#pragma once

#include <cln/rational.h>

#include <optional>
#include <utility>

#include "symbolic/functions/generator_table.hpp"
#include "symbolic/functions/sign_table.hpp"

namespace casimir::functions {

/// The field of the sines and cosines of rational multiples of Pi that occur.
class PartsOfPi {
 public:
  PartsOfPi(GeneratorTable& table, Convert convert) : table_(table), convert_(std::move(convert)) {}

  /// All parts of Pi are multiples of Pi over this even number; 0 where none needs a generator.
  unsigned long parts() const { return parts_; }
  /// cos(k Pi/parts).
  Polynomial cosine(const cln::cl_I& times);
  /// Sine and cosine of a rational multiple of Pi, if the field is small enough.
  /// \throws Full  where the field has to become larger
  std::optional<std::pair<Polynomial, Polynomial>> sine_cosine(const cln::cl_RA& part);
  /// The square root of a prime, if it is in the field.
  std::optional<Polynomial> root(unsigned long prime);

 private:
  GeneratorTable& table_;
  Convert convert_;
  unsigned long parts_ = 0;
};

}  // namespace casimir::functions
