// rescaled and within_range: TermSystem -> TermSystem.
#include <cln/integer.h>
#include <cln/rational.h>
#include <cln/real.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "codegen/optimise/terms.hpp"

namespace casimir::codegen {

namespace {

/// Where a sum is a factor: a term, as a polynomial and a place in it, and the exponent.
struct Use {
  std::size_t polynomial, term;
  int exponent;
};

struct Sum {
  bool can_scale = false;  ///< no output and no argument of a function
  std::vector<Use> uses;
};

std::vector<Sum> sums_of(const TermSystem& system) {
  std::vector<Sum> result(system.variables.size());
  for (std::size_t v = 0; v < result.size(); ++v) {
    const Variable& variable = system.variables[v];
    result[v].can_scale = variable.kind == Variable::Kind::polynomial && !variable.constant;
  }
  for (const int v : system.outputs) result[static_cast<std::size_t>(v)].can_scale = false;
  for (std::size_t v = 0; v < result.size(); ++v) {
    const Variable& variable = system.variables[v];
    for (const int a : variable.arguments) result[static_cast<std::size_t>(a)].can_scale = false;
    for (std::size_t t = 0; t < variable.value.size(); ++t) {
      for (const VariablePower& l : variable.value[t].monomial)
        result[static_cast<std::size_t>(l.variable)].uses.push_back({v, t, l.exponent});
    }
  }
  return result;
}

/// A term with this coefficient needs a multiplication by it.
bool multiplies(const cln::cl_RA& coefficient) { return cln::abs(coefficient) != 1; }

/// Multiplications by numbers in a sum and where it is used, if the sum is made `scale` times as
/// large.
long multiplications(const TermSystem& system, std::size_t sum, const Sum& about,
                     const cln::cl_RA& scale) {
  long result = 0;
  for (const Term& t : system.variables[sum].value)
    result += !t.monomial.empty() && multiplies(t.coefficient * scale);
  for (const Use& use : about.uses) {
    const Term& t = system.variables[use.polynomial].value[use.term];
    result += multiplies(t.coefficient / cln::expt(scale, use.exponent));
  }
  return result;
}

cln::cl_RA best_scale(const TermSystem& system, std::size_t sum, const Sum& about) {
  cln::cl_RA best = 1;
  long least = multiplications(system, sum, about, best);
  const auto consider = [&](const cln::cl_RA& scale) {
    const long now = multiplications(system, sum, about, scale);
    if (now >= least) return;
    least = now;
    best = scale;
  };
  for (const Use& use : about.uses) {
    if (use.exponent == 1)
      consider(cln::abs(system.variables[use.polynomial].value[use.term].coefficient));
  }
  for (const Term& t : system.variables[sum].value) consider(1 / cln::abs(t.coefficient));
  return best;
}

/// The root of a positive number: exactly, where it is rational, else to eight bits.
cln::cl_RA root_of(const cln::cl_RA& number, int degree) {
  cln::cl_RA exact;
  if (cln::rootp(number, cln::cl_I(degree), &exact)) return exact;
  const auto log2_of = [](const cln::cl_I& whole) {
    constexpr long kMantissa = 60;
    const long more = std::max(0L, static_cast<long>(cln::integer_length(whole)) - kMantissa);
    return static_cast<double>(more) +
           std::log2(cln::double_approx(cln::cl_I(cln::ash(whole, -more))));
  };
  const double log2 =
      (log2_of(cln::numerator(number)) - log2_of(cln::denominator(number))) / degree;
  constexpr int kBits = 8;
  const auto whole = static_cast<int>(std::floor(log2));
  const auto part = static_cast<long>(std::lround(std::exp2(log2 - whole + kBits)));
  return cln::cl_RA(part) * cln::expt(cln::cl_RA(2), whole - kBits);
}

}  // namespace

TermSystem rescaled(TermSystem system) {
  const std::vector<Sum> sums = sums_of(system);
  for (std::size_t v = 0; v < sums.size(); ++v) {
    if (!sums[v].can_scale || sums[v].uses.empty()) continue;
    const cln::cl_RA scale = best_scale(system, v, sums[v]);
    if (scale == 1) continue;
    for (Term& t : system.variables[v].value) t.coefficient = t.coefficient * scale;
    for (const Use& use : sums[v].uses) {
      cln::cl_RA& c = system.variables[use.polynomial].value[use.term].coefficient;
      c = c / cln::expt(scale, use.exponent);
    }
  }
  return system;
}

bool beyond_range(const cln::cl_RA& number) {
  constexpr long kMostBits = 600;  // doubles have 1000, and some are left for what it multiplies
  return number != 0 &&
         std::abs(static_cast<long>(cln::integer_length(cln::numerator(number))) -
                  static_cast<long>(cln::integer_length(cln::denominator(number)))) > kMostBits;
}

TermSystem within_range(TermSystem system) {
  for (std::size_t v = 0; v < system.variables.size(); ++v) {
    for (std::size_t t = 0; t < system.variables[v].value.size(); ++t) {
      const Term term = system.variables[v].value[t];
      if (!beyond_range(term.coefficient) || term.monomial.empty()) continue;
      const std::size_t place = static_cast<std::size_t>(
          std::ranges::max_element(term.monomial, {}, &VariablePower::exponent) -
          term.monomial.begin());
      const VariablePower power = term.monomial[place];
      if (power.exponent == 1) continue;
      const cln::cl_RA scale = root_of(cln::abs(term.coefficient), power.exponent);
      const Variable& base = system.variables[static_cast<std::size_t>(power.variable)];
      if (base.constant) continue;
      Variable scaled;
      scaled.kind = Variable::Kind::polynomial;
      scaled.value = {{scale, {{power.variable, 1}}}};
      if (base.kind == Variable::Kind::polynomial) {
        scaled.value = base.value;
        for (Term& inner : scaled.value) inner.coefficient = inner.coefficient * scale;
      }
      const int added = system.add(std::move(scaled));
      Term& used = system.variables[v].value[t];
      used.coefficient = used.coefficient / cln::expt(scale, power.exponent);
      used.monomial.erase(used.monomial.begin() + static_cast<std::ptrdiff_t>(place));
      used.monomial.push_back({added, power.exponent});
    }
  }
  return system;
}

}  // namespace casimir::codegen
