#pragma once

// CLN's numbers as FLINT's and back, word by word: for the files that hold FLINT's types, and for
// no header of theirs.
#include <cln/integer.h>
#include <cln/rational.h>
#include <flint/fmpq.h>

#include <vector>

namespace casimir {

inline void to_fmpz(fmpz_t result, const cln::cl_I& value) {
  constexpr std::size_t kWord = 62;  // fits into a long with its sign
  const cln::cl_I size = cln::abs(value);
  const std::size_t length = cln::integer_length(size);  // of -2^62 it is one less than of 2^62
  if (length < kWord) {
    fmpz_set_si(result, cln::cl_I_to_long(value));
    return;
  }
  fmpz_zero(result);
  for (std::size_t word = (length + kWord - 1) / kWord; word-- > 0;) {
    const cln::cl_I part = cln::ldb(size, cln::cl_byte(kWord, word * kWord));
    fmpz_mul_2exp(result, result, kWord);
    fmpz_add_ui(result, result, cln::cl_I_to_ulong(part));
  }
  if (cln::minusp(value)) fmpz_neg(result, result);
}

inline cln::cl_I from_fmpz(const fmpz_t value) {
  if (!COEFF_IS_MPZ(*value)) return cln::cl_I(static_cast<long>(*value));
  constexpr int kWord = 64;
  std::vector<ulong> words(fmpz_size(value));
  fmpz_t absolute;  // the words of negative numbers cannot be asked for
  fmpz_init(absolute);
  fmpz_abs(absolute, value);
  fmpz_get_ui_array(words.data(), static_cast<slong>(words.size()), absolute);
  fmpz_clear(absolute);
  cln::cl_I size = 0;
  for (auto word = words.rbegin(); word != words.rend(); ++word)
    size = cln::ash(size, kWord) + cln::cl_I(*word);
  return fmpz_sgn(value) < 0 ? -size : size;
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
