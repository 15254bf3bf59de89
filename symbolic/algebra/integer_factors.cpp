#include "symbolic/algebra/integer_factors.hpp"

#include <flint/fmpz.h>
#include <flint/fmpz_factor.h>

#include <algorithm>
#include <utility>

#include "symbolic/algebra/flint_conversion.hpp"
#include "symbolic/case/limits.hpp"

namespace casimir {
namespace {

class Integer {
 public:
  Integer() { fmpz_init(value_); }
  explicit Integer(const cln::cl_I& n) : Integer() { to_fmpz(value_, n); }
  ~Integer() { fmpz_clear(value_); }
  Integer(const Integer&) = delete;
  Integer& operator=(const Integer&) = delete;
  fmpz* get() { return value_; }

 private:
  fmpz_t value_;
};

class FlintFactors {
 public:
  FlintFactors() { fmpz_factor_init(value_); }
  ~FlintFactors() { fmpz_factor_clear(value_); }
  FlintFactors(const FlintFactors&) = delete;
  FlintFactors& operator=(const FlintFactors&) = delete;
  fmpz_factor_struct* get() { return value_; }
  void add_to(PrimeFactors& result, slong count, slong exponent) const {
    for (slong i = 0; i < count; ++i)
      result.emplace_back(from_fmpz(value_->p + i), exponent * value_->exp[i]);
  }

 private:
  fmpz_factor_t value_;
};

/// Factors numbers without small prime factors. fmpz_factor() would do, but it sieves in a file of
/// the working folder, always of the same name: two processes would spoil each other's.
class Splitter {
 public:
  explicit Splitter(PrimeFactors& result) : result_(result) { flint_randinit(state_); }
  ~Splitter() { flint_randclear(state_); }
  Splitter(const Splitter&) = delete;
  Splitter& operator=(const Splitter&) = delete;

  /// Appends the primes of n^exponent; false where they were not found.
  bool split(const fmpz* n, slong exponent) {
    constexpr flint_bitcnt_t kMostBitsOfPrime = 200;
    constexpr flint_bitcnt_t kMostBitsOfProduct = 96;
    constexpr double kWork = 1e6;
    WorkMeter::spend(kWork);
    if (fmpz_bits(n) <= FLINT_BITS) return split_word(n, exponent);
    if (fmpz_bits(n) > kMostBitsOfPrime) return false;
    if (fmpz_is_prime(n) == 1) {
      result_.emplace_back(from_fmpz(n), exponent);
      return true;
    }
    Integer factor, rest;
    if (const int power = fmpz_is_perfect_power(factor.get(), n); power > 1)
      return split(factor.get(), power * exponent);
    if (fmpz_bits(n) > kMostBitsOfProduct || !find_factor(factor.get(), n)) return false;
    fmpz_divexact(rest.get(), n, factor.get());
    return split(factor.get(), exponent) && split(rest.get(), exponent);
  }

 private:
  bool split_word(const fmpz* n, slong exponent) {
    FlintFactors factors;
    fmpz_factor(factors.get(), n);
    factors.add_to(result_, factors.get()->num, exponent);
    return true;
  }

  /// By elliptic curves: of factors up to 48 bits one in thousands is missed; 0.01 to 0.2 s.
  bool find_factor(fmpz* factor, const fmpz* n) {
    constexpr mp_limb_t kCurves = 200;
    constexpr mp_limb_t kFirstStage = 1000;
    constexpr mp_limb_t kSecondStage = 50 * kFirstStage;
    return fmpz_factor_ecm(factor, kCurves, kFirstStage, kSecondStage, state_, n) > 0 &&
           !fmpz_is_one(factor) && !fmpz_equal(factor, n) && fmpz_divisible(n, factor) != 0;
  }

  PrimeFactors& result_;
  flint_rand_t state_;
};

/// Each prime once, in ascending order.
PrimeFactors merged(PrimeFactors factors) {
  std::sort(factors.begin(), factors.end());
  PrimeFactors result;
  for (const auto& [prime, exponent] : factors) {
    if (result.empty() || result.back().first != prime)
      result.emplace_back(prime, exponent);
    else
      result.back().second += exponent;
  }
  return result;
}

}  // namespace

std::optional<PrimeFactors> prime_factors(const cln::cl_I& n) {
  constexpr std::size_t kMostBits = 4096;
  constexpr slong kSmallPrimes = 3512;  // all that FLINT has a table of
  if (n <= 0 || cln::integer_length(n) > kMostBits) return std::nullopt;
  FlintFactors small;
  PrimeFactors result;
  const bool complete = fmpz_factor_trial(small.get(), Integer(n).get(), kSmallPrimes) != 0;
  const slong count = small.get()->num;
  small.add_to(result, complete ? count : count - 1, 1);
  if (complete) return result;
  if (!Splitter(result).split(small.get()->p + (count - 1), 1)) return std::nullopt;
  return merged(std::move(result));
}

}  // namespace casimir
