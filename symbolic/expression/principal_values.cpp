#include "symbolic/expression/principal_values.hpp"

#include <optional>

#include "symbolic/expression/decimal.hpp"

namespace casimir {

using GiNaC::ex;

ex principal_power(const ex& base, const ex& exponent, bool complex_numbers) {
  const bool fraction =
      GiNaC::is_a<GiNaC::numeric>(exponent) && !GiNaC::ex_to<GiNaC::numeric>(exponent).is_integer();
  if (!fraction || !complex_numbers) return GiNaC::pow(base, exponent);
  ex inner = base;
  ex factor = 1;  // positive numbers are taken out
  if (GiNaC::is_a<GiNaC::mul>(base) && base.nops() == 2 &&
      GiNaC::is_a<GiNaC::numeric>(base.op(1)) && base.op(1).info(GiNaC::info_flags::positive)) {
    inner = base.op(0);
    factor = GiNaC::pow(base.op(1), exponent);
  }
  const bool reciprocal = GiNaC::is_a<GiNaC::power>(inner) && inner.op(1).is_equal(GiNaC::ex(-1));
  if (!reciprocal) return GiNaC::pow(base, exponent);
  return factor * GiNaC::pow(inner.op(0), exponent) /
         GiNaC::pow(GiNaC::pow(inner.op(0), 2), exponent);
}

namespace {

/// GiNaC leaves sqrt(-2) as it is, while sqrt(-4) is 2*I.
bool is_even_root_of_negative(const ex& part) {
  if (!GiNaC::is_exactly_a<GiNaC::power>(part)) return false;
  const ex base = part.op(0), exponent = part.op(1);
  return base.info(GiNaC::info_flags::negative) && exponent.info(GiNaC::info_flags::rational) &&
         GiNaC::ex_to<GiNaC::numeric>(exponent).denom().is_even();
}

}  // namespace

bool is_complex_constant(const ex& value) {
  bool complex = false;
  for (auto part = value.preorder_begin(); part != value.preorder_end(); ++part) {
    if (GiNaC::is_a<GiNaC::symbol>(*part)) return false;
    complex = complex || is_even_root_of_negative(*part) ||
              (GiNaC::is_exactly_a<GiNaC::numeric>(*part) &&
               !GiNaC::ex_to<GiNaC::numeric>(*part).is_real());
  }
  return complex;
}

bool is_no_real_constant(const ex& value, double bits) {
  if (is_complex_constant(value)) return true;
  const std::optional<GiNaC::numeric> number = decimal(value, bits);
  return number && !number->is_real();
}

}  // namespace casimir
