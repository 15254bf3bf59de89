#include "symbolic/integer_factors.hpp"

#include <cln/integer_io.h>
#include <flint/fmpz.h>
#include <flint/fmpz_factor.h>

#include <sstream>

namespace casimir {

std::optional<std::vector<std::pair<cln::cl_I, unsigned long>>> prime_factors(const cln::cl_I& n) {
  constexpr std::size_t kMaxBits = 200;
  if (n <= 0 || cln::integer_length(n) > kMaxBits) return std::nullopt;
  std::ostringstream text;
  text << n;
  fmpz_t value;
  fmpz_init(value);
  fmpz_set_str(value, text.str().c_str(), 10);
  fmpz_factor_t factors;
  fmpz_factor_init(factors);
  fmpz_factor(factors, value);
  std::vector<std::pair<cln::cl_I, unsigned long>> result;
  for (slong i = 0; i < factors->num; ++i) {
    char* digits = fmpz_get_str(nullptr, 10, factors->p + i);
    result.emplace_back(cln::cl_I(digits), factors->exp[i]);
    flint_free(digits);
  }
  fmpz_factor_clear(factors);
  fmpz_clear(value);
  return result;
}

}  // namespace casimir
