// Expressions without variables.
#include <fmt/format.h>

#include "symbolic/case/limits.hpp"
#include "symbolic/expression/decimal.hpp"
#include "symbolic/expression/expression.hpp"

namespace casimir {

using GiNaC::ex;

GiNaC::ex parse_constant(const Text& text, const Limits& limits) {
  NameTable empty(limits);
  return parse_expression(text, empty).value;
}

GiNaC::ex parse_real_constant(const Text& text, const Limits& limits) {
  const ex value = parse_constant(text, limits);
  if (!real_decimal(value, limits.bits)) {
    throw text.error(fmt::format(
        "expected a real constant, such as 3/5 or sqrt(2)/2, with numbers of up to {:.0f} "
        "bits",
        limits.bits));
  }
  return value;
}

}  // namespace casimir
