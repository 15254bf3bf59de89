#pragma once

#include <ginac/ginac.h>

#include <optional>
#include <vector>

#include "symbolic/functions/convert/angles.hpp"
#include "symbolic/functions/convert/roots.hpp"
#include "symbolic/functions/convert/units.hpp"
#include "symbolic/functions/generator_table.hpp"
#include "symbolic/functions/sign_table.hpp"

namespace casimir::functions {

/// Exponentials and logarithms of the polynomials of a table.
class Exponentials {
 public:
  Exponentials(GeneratorTable& table, SignTable& signs, Roots& roots, Angles& angles, Units& units)
      : table_(table), signs_(signs), roots_(roots), angles_(angles), units_(units) {}

  Polynomial exponential(const Polynomial& exponent);
  /// \param whole  log(p)
  Polynomial logarithm(const GiNaC::ex& whole, const Polynomial& p);

 private:
  std::optional<Polynomial> logarithm_of_generator(const Polynomial& f);
  std::optional<Polynomial> logarithm_of_reciprocal(const Polynomial& p, unsigned long tag);
  std::optional<Polynomial> special_exponential(const cln::cl_RA& coefficient,
                                                const std::vector<unsigned long>& monomial);

  GeneratorTable& table_;
  SignTable& signs_;
  Roots& roots_;
  Angles& angles_;
  Units& units_;
};

}  // namespace casimir::functions
