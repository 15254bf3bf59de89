#include "symbolic/integer_factors.hpp"

#include <flint/fmpz.h>
#include <flint/fmpz_factor.h>

#include "symbolic/flint_number.hpp"
#include "symbolic/limits.hpp"

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

class Factors {
 public:
  Factors() { fmpz_factor_init(value_); }
  ~Factors() { fmpz_factor_clear(value_); }
  Factors(const Factors&) = delete;
  Factors& operator=(const Factors&) = delete;
  fmpz_factor_struct* get() { return value_; }
  void add_to(PrimeFactors& result, slong count) const {
    for (slong i = 0; i < count; ++i) result.emplace_back(from_fmpz(value_->p + i), value_->exp[i]);
  }

 private:
  fmpz_factor_t value_;
};

}  // namespace

std::optional<PrimeFactors> prime_factors(const cln::cl_I& n) {
  constexpr std::size_t kMostBits = 4096;
  constexpr slong kSmallPrimes = 3512;  // all that FLINT has a table of
  constexpr flint_bitcnt_t kMostBitsOfPrime = 200;
  constexpr flint_bitcnt_t kMostBitsOfProduct = 112;  // some 0.03 s
  constexpr double kWork = 1e6;
  if (n <= 0 || cln::integer_length(n) > kMostBits) return std::nullopt;
  Factors small;
  PrimeFactors result;
  const bool complete = fmpz_factor_trial(small.get(), Integer(n).get(), kSmallPrimes) != 0;
  const slong count = small.get()->num;
  small.add_to(result, complete ? count : count - 1);
  if (complete) return result;

  const fmpz* rest = small.get()->p + (count - 1);
  WorkMeter::spend(kWork);
  if (fmpz_bits(rest) > kMostBitsOfPrime) return std::nullopt;
  if (fmpz_bits(rest) > kMostBitsOfProduct && fmpz_is_prime(rest) != 1) return std::nullopt;
  Factors large;
  fmpz_factor(large.get(), rest);
  large.add_to(result, large.get()->num);
  return result;
}

}  // namespace casimir
