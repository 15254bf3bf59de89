#pragma once

// CLN's numbers as FLINT's and back: for the files that implement Polynomial, and for no other.
#include <cln/integer.h>
#include <cln/integer_io.h>
#include <cln/rational.h>
#include <flint/fmpq.h>

#include <sstream>

namespace casimir {

inline void to_fmpz(fmpz_t result, const cln::cl_I& value) {
  constexpr std::size_t kWordBits = 62;
  if (cln::integer_length(value) < kWordBits) {
    fmpz_set_si(result, cln::cl_I_to_long(value));
    return;
  }
  std::ostringstream text;
  text << value;
  fmpz_set_str(result, text.str().c_str(), 10);
}

inline cln::cl_I from_fmpz(const fmpz_t value) {
  if (!COEFF_IS_MPZ(*value)) return cln::cl_I(static_cast<long>(*value));
  char* text = fmpz_get_str(nullptr, 10, value);
  const cln::cl_I result = cln::cl_I(text);
  flint_free(text);
  return result;
}

/// A scoped FLINT rational.
class Rational {
 public:
  Rational() { fmpq_init(value_); }
  explicit Rational(const cln::cl_RA& value) : Rational() {
    to_fmpz(fmpq_numref(value_), cln::numerator(value));
    to_fmpz(fmpq_denref(value_), cln::denominator(value));
  }
  ~Rational() { fmpq_clear(value_); }
  Rational(const Rational&) = delete;
  Rational& operator=(const Rational&) = delete;
  fmpq* get() { return value_; }
  cln::cl_RA number() const {
    const cln::cl_I numerator = from_fmpz(fmpq_numref(value_));
    if (fmpz_is_one(fmpq_denref(value_))) return numerator;
    return numerator / from_fmpz(fmpq_denref(value_));
  }

 private:
  fmpq_t value_;
};

}  // namespace casimir
