#pragma once

#include <ginac/ginac.h>

#include <optional>
#include <utility>
#include <vector>

#include "symbolic/functions/convert/parts_of_pi.hpp"
#include "symbolic/functions/function_factors.hpp"
#include "symbolic/functions/generator_table.hpp"
#include "symbolic/functions/sign_table.hpp"

namespace casimir::functions {

/// Roots and absolute values of the polynomials of a table.
class Roots {
 public:
  Roots(GeneratorTable& table, SignTable& signs, PartsOfPi& pi)
      : table_(table), signs_(signs), pi_(pi) {}

  /// p^(1/q), over a common denominator, and with q-th powers taken out of the radicand.
  /// \throws Full  where a root of a higher order has to be made of the same radicand
  Polynomial root(const Polynomial& p, unsigned long q);
  /// |p|.
  Polynomial absolute(const Polynomial& p);

 private:
  Polynomial outside(const Polynomial& f, unsigned long k, unsigned long q);
  Polynomial real_root(Polynomial factor, const Factors& factors, unsigned long q);
  Polynomial complex_root(const Polynomial& p, unsigned long q);
  Polynomial number_root(const cln::cl_RA& r, unsigned long q);
  Polynomial plain_root(const Polynomial& primitive, unsigned long q);
  Polynomial root_generator(const Polynomial& radicand, unsigned long q);
  std::optional<Polynomial> square_root_by_pi(const Polynomial& top, const Polynomial& bottom);
  std::optional<Polynomial> denested(const Polynomial& radicand);
  std::optional<Polynomial> denested_number(const Polynomial& radicand, unsigned long q);

  GeneratorTable& table_;
  SignTable& signs_;
  PartsOfPi& pi_;
  /// For a radicand: the least common multiple of the orders of its roots.
  std::vector<std::pair<GiNaC::ex, unsigned long>> root_orders_;
};

}  // namespace casimir::functions
