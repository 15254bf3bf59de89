#include "tools/analysis/section/simple_zeros.hpp"

#include <algorithm>
#include <vector>

namespace casimir {
namespace {

/// Beyond that greatest common divisors may take long.
constexpr std::size_t kMostTermsToSplit = 30;

bool is_natural_power(const GiNaC::ex& e) {
  return GiNaC::is_a<GiNaC::power>(e) && e.op(1).info(GiNaC::info_flags::posint);
}

/// As a product of powers, where it has a multiple factor.
GiNaC::ex split_sum(const GiNaC::ex& sum) {
  if (sum.nops() > kMostTermsToSplit || !sum.info(GiNaC::info_flags::rational_polynomial))
    return sum;
  const GiNaC::ex split = GiNaC::sqrfree(sum);
  const bool multiple =
      is_natural_power(split) ||
      (GiNaC::is_a<GiNaC::mul>(split) && std::any_of(split.begin(), split.end(), is_natural_power));
  return multiple ? split : sum;
}

GiNaC::ex signed_part(const GiNaC::ex& e) {
  if (GiNaC::is_a<GiNaC::mul>(e)) {
    GiNaC::ex product = 1;
    for (const GiNaC::ex& factor : e) product *= signed_part(factor);
    return product;
  }
  if (is_natural_power(e))
    return e.op(1).info(GiNaC::info_flags::odd) ? signed_part(e.op(0)) : GiNaC::ex(1);
  if (!GiNaC::is_a<GiNaC::add>(e)) return e;
  const GiNaC::ex split = split_sum(e);
  return split.is_equal(e) ? e : signed_part(split);
}

}  // namespace

GiNaC::ex with_simple_zeros(const GiNaC::ex& function,
                            const std::vector<GiNaC::symbol>& variables) {
  const GiNaC::ex simple = signed_part(function);
  const bool depends = std::ranges::any_of(
      variables, [&](const GiNaC::symbol& variable) { return simple.has(variable); });
  return depends ? simple : function;
}

}  // namespace casimir
