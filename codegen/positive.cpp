#include "codegen/positive.hpp"

#include <algorithm>

namespace casimir::codegen {
namespace {

bool is_call(const GiNaC::ex& e, const char* name) {
  return GiNaC::is_a<GiNaC::function>(e) && GiNaC::ex_to<GiNaC::function>(e).get_name() == name;
}

/// An even root has values that are not negative, and so has an even power.
bool is_even_power(const GiNaC::ex& e) {
  if (!GiNaC::is_a<GiNaC::power>(e) || !GiNaC::is_a<GiNaC::numeric>(e.op(1))) return false;
  const auto& exponent = GiNaC::ex_to<GiNaC::numeric>(e.op(1));
  return exponent.is_rational() && (exponent.numer().is_even() || exponent.denom().is_even());
}

bool is_shown_not_negative(const GiNaC::ex& e) {
  if (is_shown_positive(e) || is_even_power(e) || is_call(e, "abs")) return true;
  if (e.is_zero()) return true;
  return (GiNaC::is_a<GiNaC::add>(e) || GiNaC::is_a<GiNaC::mul>(e)) &&
         std::all_of(e.begin(), e.end(), is_shown_not_negative);
}

}  // namespace

bool is_shown_positive(const GiNaC::ex& e) {
  if (e.info(GiNaC::info_flags::positive) || e.is_equal(GiNaC::Pi)) return true;
  if (is_call(e, "exp") || is_call(e, "cosh")) return true;
  if (GiNaC::is_a<GiNaC::power>(e)) return is_shown_positive(e.op(0));
  if (GiNaC::is_a<GiNaC::mul>(e)) return std::all_of(e.begin(), e.end(), is_shown_positive);
  return GiNaC::is_a<GiNaC::add>(e) && std::all_of(e.begin(), e.end(), is_shown_not_negative) &&
         std::any_of(e.begin(), e.end(), is_shown_positive);
}

}  // namespace casimir::codegen
