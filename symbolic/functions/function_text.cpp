#include "symbolic/functions/function_text.hpp"

#include <cln/rational.h>
#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "symbolic/algebra/number_text.hpp"
#include "symbolic/expression/arbitrary.hpp"
#include "symbolic/expression/name_characters.hpp"

namespace casimir::functions {
namespace {

std::string power_text(unsigned long exponent) {
  return exponent == 1 ? "" : "^" + std::to_string(exponent);
}

bool is_name(const std::string& text) { return std::ranges::all_of(text, is_name_part); }

std::string bracketed(const std::string& text) { return "(" + text + ")"; }

}  // namespace

using GiNaC::ex;

std::string FunctionText::text(const Polynomial& p) const {
  std::string result;
  for (const auto& [coefficient, exponents] : p.term_list()) {
    std::string factors;
    for (std::size_t i = 0; i < exponents.size(); ++i) {
      if (exponents[i] == 0) continue;
      if (!factors.empty()) factors += "*";
      factors += i < table_.symbols().size()
                     ? table_.symbols()[i].get_name() + power_text(exponents[i])
                     : power_of(table_.at_place(i), exponents[i]);
    }
    append_term(result, coefficient, factors);
  }
  return result.empty() ? "0" : result;
}

/// A power associates to the right, and so does not take over a power that is written out: the
/// square of x^(1/3) is x^(2/3), not x^(1/3)^2.
std::string FunctionText::power_of(const Generator& g, unsigned long exponent) const {
  if (g.kind == Kind::root && g.order > 2) {
    const unsigned long common = std::gcd(exponent, g.order);
    const unsigned long bottom = g.order / common;
    return bracketed(text(g.base)) + "^" +
           (bottom == 1 ? std::to_string(exponent / common)
                        : fmt::format("({}/{})", exponent / common, bottom));
  }
  return name(g) + power_text(exponent);
}

/// What stands in a product or under a power as it is; GiNaC's text of log(x^2)/2 does not.
std::string FunctionText::name(const Generator& g) const {
  switch (g.kind) {
    case Kind::sine:
      return "sin(" + text(g.base) + ")";
    case Kind::cosine: {
      // Its sine stands just before it and has the angle.
      const auto index = static_cast<std::size_t>(&g - table_.generators().data());
      return "cos(" + text(table_.generators()[index - 1].base) + ")";
    }
    case Kind::exponential:
      return "exp(" + text(g.base) + ")";
    case Kind::root:
      return g.order == 2 ? "sqrt(" + text(g.base) + ")" : power_of(g, 1);
    case Kind::inverse:
      return "(1/" + (is_name(text(g.base)) ? text(g.base) : bracketed(text(g.base))) + ")";
    case Kind::absolute:
      return "sqrt(" + text(g.base) + ")";
    case Kind::imaginary:
      return "I";
    case Kind::function:
      break;
  }
  // GiNaC's order of terms differs from run to run.
  if (g.order == kPartCosine) return "cos(" + text(g.base) + ")";
  if (g.order == kPartSine) return "sin(" + text(g.base) + ")";
  if (g.order == kCosineOfPi) return "cos(Pi/" + text(g.base) + ")";
  if (g.order == kSignedHalf) {  // 2 r = (r - x) + (r + x)
    const Polynomial& other = table_.at_place(g.partner->first).base;
    return "(sqrt(" + text(g.relation[0] + other) + ")*sin(" + text(g.base) + "))";
  }
  if (g.order == kArbitrary || g.order == kLastArbitrary) {
    const Arbitrary own = *as_arbitrary(GiNaC::ex_to<GiNaC::function>(g.value));
    std::string arguments;
    for (const Polynomial& argument : g.arguments)
      arguments += (arguments.empty() ? "" : ", ") + text(argument);
    const auto named = function_name(own.function.get_name());
    return derivative_text(named ? named->name : own.function.get_name(), own.orders) +
           bracketed(arguments);
  }
  const std::string value = expression_text(g.value);
  return GiNaC::is_exactly_a<GiNaC::function>(g.value) ||
                 GiNaC::is_exactly_a<GiNaC::constant>(g.value)
             ? value
             : bracketed(value);
}

}  // namespace casimir::functions
