// rescaled: TermSystem -> TermSystem.
#include <algorithm>
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

}  // namespace casimir::codegen
