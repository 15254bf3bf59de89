// with_squares_joined and with_sums_taken_out: TermSystem -> TermSystem.
#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <utility>

#include "codegen/optimise/terms.hpp"

namespace casimir::codegen {

namespace {

/// The terms of a sum; those of higher degree come first.
struct ByDegree {
  bool operator()(const Monomial& a, const Monomial& b) const { return comes_before(a, b); }
};
using SortedTerms = std::map<Monomial, cln::cl_RA, ByDegree>;

SortedTerms terms_of(const Polynomial& polynomial) {
  SortedTerms result;
  for (const Term& t : polynomial) {
    const auto [place, is_new] = result.try_emplace(t.monomial, t.coefficient);
    if (!is_new) place->second = place->second + t.coefficient;
  }
  std::erase_if(result, [](const auto& term) { return term.second == 0; });
  return result;
}

Polynomial polynomial_of(const SortedTerms& terms) {
  Polynomial result;
  for (const auto& [monomial, coefficient] : terms) result.push_back({coefficient, monomial});
  return result;
}

void add_to(SortedTerms& to, const Monomial& monomial, const cln::cl_RA& coefficient) {
  const auto [place, is_new] = to.try_emplace(monomial, coefficient);
  if (is_new) return;
  place->second = place->second + coefficient;
  if (place->second == 0) to.erase(place);
}

/// a / b; nothing where b does not divide a.
std::optional<Monomial> without_factor(const Monomial& a, const Monomial& b) {
  Monomial result;
  auto j = b.begin();
  for (const VariablePower& l : a) {
    if (j == b.end() || j->variable != l.variable) {
      result.push_back(l);
      continue;
    }
    if (l.exponent < j->exponent) return std::nullopt;
    if (l.exponent > j->exponent) result.push_back({l.variable, l.exponent - j->exponent});
    ++j;
  }
  if (j != b.end()) return std::nullopt;
  return result;
}

// --- sin(u)^2 + cos(u)^2

/// Functions of one argument, the sum of whose squares, the second times `sign`, is 1.
struct Pair {
  int first, second;
  int sign;
};

std::vector<Pair> pairs_of(const TermSystem& system) {
  std::map<std::pair<Op, int>, int> functions;
  for (std::size_t v = 0; v < system.variables.size(); ++v) {
    const Variable& variable = system.variables[v];
    if (variable.kind == Variable::Kind::function && variable.arguments.size() == 1)
      functions.try_emplace({variable.function, variable.arguments[0]}, static_cast<int>(v));
  }
  std::vector<Pair> result;
  const auto find = [&](Op first, Op second, int sign) {
    for (const auto& [function, place] : functions) {
      if (function.first != first) continue;
      const auto other = functions.find({second, function.second});
      if (other != functions.end()) result.push_back({place, other->second, sign});
    }
  };
  find(Op::cos, Op::sin, 1);
  find(Op::cosh, Op::sinh, -1);
  return result;
}

/// k cos(u)^2 m + k sin(u)^2 m is k m.
bool join(SortedTerms& terms, const Pair& pair) {
  for (const auto& [monomial, coefficient] : terms) {
    const auto rest = without_factor(monomial, {{pair.first, 2}});
    if (!rest) continue;
    const Monomial other = multiply(*rest, {{pair.second, 2}});
    const auto partner = terms.find(other);
    if (partner == terms.end() || partner->second != coefficient * pair.sign) continue;
    const Monomial own = monomial;
    const cln::cl_RA k = coefficient;
    terms.erase(own);
    terms.erase(other);
    add_to(terms, *rest, k);
    return true;
  }
  return false;
}

// --- sums as factors

/// Writes `terms` as what is left and a multiple of `sum`, which is the variable `name`, where that
/// has fewer terms. Only monomials that are there already are touched: then each step takes one
/// away and adds one to the multiple at most.
bool take_out(SortedTerms& terms, const SortedTerms& sum, int name) {
  SortedTerms left = terms, multiple;
  const Monomial lead = sum.begin()->first;
  const cln::cl_RA unit = sum.begin()->second;
  for (const auto& [monomial, unused] : terms) {
    const auto found = left.find(monomial);
    if (found == left.end()) continue;
    const auto rest = without_factor(monomial, lead);
    if (!rest) continue;
    const auto is_there = [&](const auto& term) {
      return left.contains(multiply(*rest, term.first));
    };
    if (!std::ranges::all_of(sum, is_there)) continue;
    const cln::cl_RA times = found->second / unit;
    for (const auto& [inner, coefficient] : sum)
      add_to(left, multiply(*rest, inner), -times * coefficient);
    add_to(multiple, multiply(*rest, {{name, 1}}), times);
  }
  if (left.size() + multiple.size() >= terms.size()) return false;
  for (const auto& [monomial, coefficient] : multiple) add_to(left, monomial, coefficient);
  terms = std::move(left);
  return true;
}

}  // namespace

TermSystem with_squares_joined(TermSystem system) {
  for (const Pair& pair : pairs_of(system)) {
    for (const int output : system.outputs) {
      Polynomial& value = system.variables[static_cast<std::size_t>(output)].value;
      SortedTerms terms = terms_of(value);
      bool joined = false;
      while (join(terms, pair)) joined = true;
      if (joined) value = polynomial_of(terms);
    }
  }
  return system;
}

TermSystem with_sums_taken_out(TermSystem system, std::size_t limit) {
  // Beyond, it would take as long as all the rest.
  constexpr std::size_t kMostWork = 50'000;
  const std::size_t count = system.variables.size();
  std::size_t terms_in_all = 0;
  for (const int output : system.outputs)
    terms_in_all += system.variables[static_cast<std::size_t>(output)].value.size();
  if (count * terms_in_all > kMostWork) return system;
  for (std::size_t v = 0; v < count; ++v) {
    const Variable& variable = system.variables[v];
    const int name = static_cast<int>(v);
    if (variable.kind != Variable::Kind::polynomial || variable.constant ||
        std::ranges::count(system.outputs, name) > 0)
      continue;
    const std::optional<Polynomial> value = expanded_value(system, name, limit);
    if (!value || value->size() < 2) continue;
    const SortedTerms sum = terms_of(*value);
    for (const int output : system.outputs) {
      Polynomial& of = system.variables[static_cast<std::size_t>(output)].value;
      SortedTerms terms = terms_of(of);
      bool taken = false;
      while (take_out(terms, sum, name)) taken = true;
      if (taken) of = polynomial_of(terms);
    }
  }
  return system;
}

bool has_power_of_sum(const TermSystem& system) {
  return std::ranges::any_of(system.outputs, [&](int output) {
    return std::ranges::any_of(
        system.variables[static_cast<std::size_t>(output)].value, [&](const Term& term) {
          return std::ranges::any_of(term.monomial, [&](const VariablePower& l) {
            const Variable& base = system.variables[static_cast<std::size_t>(l.variable)];
            return l.exponent > 1 && base.kind == Variable::Kind::polynomial && !base.constant;
          });
        });
  });
}

}  // namespace casimir::codegen
