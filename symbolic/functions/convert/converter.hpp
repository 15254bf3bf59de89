#pragma once

#include <ginac/ginac.h>

#include <optional>
#include <unordered_map>
#include <vector>

#include "symbolic/functions/convert/angles.hpp"
#include "symbolic/functions/convert/elliptic_generators.hpp"
#include "symbolic/functions/convert/exponentials.hpp"
#include "symbolic/functions/convert/inverse_functions.hpp"
#include "symbolic/functions/convert/order_keys.hpp"
#include "symbolic/functions/convert/parts_of_pi.hpp"
#include "symbolic/functions/convert/roots.hpp"
#include "symbolic/functions/convert/units.hpp"
#include "symbolic/functions/generator_table.hpp"
#include "symbolic/functions/sign_table.hpp"

namespace casimir::functions {

/// Makes polynomials of expressions, and with them the generators of a table: it reads GiNaC's
/// trees, and has a part for each family of functions.
class Converter {
 public:
  /// \param highest_derivative  derivatives of arbitrary functions are made up to this order
  Converter(GeneratorTable& table, SignTable& signs, unsigned highest_derivative);
  Converter(const Converter&) = delete;
  Converter& operator=(const Converter&) = delete;

  /// Forgets what was converted, but not the units and orders that were found: the table starts
  /// again.
  void restart();
  /// \return  kept, so that the same expression is converted once
  /// \throws Full  where everything has to be converted again
  const Polynomial& convert(const GiNaC::ex& expression);
  /// The same as a function.
  Convert converting();

 private:
  struct Monomial {
    cln::cl_RA coefficient;
    std::vector<unsigned long> exponents;
  };
  Polynomial convert_new(const GiNaC::ex& e);
  Polynomial convert_number(const GiNaC::numeric& number);
  Polynomial convert_sum(const GiNaC::ex& sum);
  Polynomial convert_product(const GiNaC::ex& product);
  Polynomial convert_power(const GiNaC::ex& base, const GiNaC::ex& exponent);
  Polynomial convert_function(const GiNaC::function& f);
  Polynomial convert_arbitrary(const GiNaC::function& f);
  std::size_t place_of(const GiNaC::ex& symbol) const;
  bool multiply_power(const GiNaC::ex& base, const GiNaC::ex& exponent, Monomial& monomial) const;
  static bool multiply_number(const GiNaC::ex& number, Monomial& monomial);
  bool multiply_monomial(const GiNaC::ex& e, Monomial& monomial) const;
  void order(GiNaC::exvector& operands);
  GeneratorTools elliptic_tools();
  std::optional<std::size_t> find_elliptic(unsigned long tag,
                                           const std::vector<Polynomial>& arguments);

  GeneratorTable& table_;
  SignTable& signs_;
  unsigned highest_derivative_;
  std::unordered_map<GiNaC::ex, std::size_t> places_;  ///< of the symbols in the ring
  std::unordered_map<GiNaC::ex, Polynomial> known_;
  OrderKeys keys_;
  PartsOfPi pi_;
  Roots roots_;
  Units units_;
  Angles angles_;
  Exponentials exponentials_;
  InverseFunctions inverse_functions_;
};

}  // namespace casimir::functions
