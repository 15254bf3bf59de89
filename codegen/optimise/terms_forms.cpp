// expanded and flattened: TermSystem -> TermSystem.
#include <algorithm>
#include <map>
#include <utility>

#include "codegen/optimise/terms.hpp"

namespace casimir::codegen {

namespace {

using Collected = std::map<Monomial, cln::cl_RA>;

/// A sum to a higher power stays as it is: the numbers in its expansion have hundreds of digits.
constexpr int kHighestPower = 100;

int degree(const Monomial& monomial) {
  int result = 0;
  for (const VariablePower& l : monomial) result += l.exponent;
  return result;
}

class Expander {
 public:
  Expander(const TermSystem& system, std::size_t limit) : system_(system), limit_(limit) {}

  /// Nothing when there are too many terms.
  std::optional<Polynomial> expand(const Polynomial& polynomial) {
    const std::optional<Collected> all = collect(polynomial);
    if (!all) return std::nullopt;
    Polynomial result;
    for (const auto& [monomial, coefficient] : *all) {
      if (coefficient != 0) result.push_back({coefficient, monomial});
    }
    std::ranges::sort(
        result, [](const Term& a, const Term& b) { return comes_before(a.monomial, b.monomial); });
    return result;
  }

 private:
  bool is_product_of_sums(int variable) const {
    const Variable& v = system_.variables[static_cast<std::size_t>(variable)];
    return v.kind == Variable::Kind::polynomial && !v.constant;
  }

  std::optional<Collected> collect(const Polynomial& polynomial) {
    Collected result;
    for (const Term& term : polynomial) {
      const std::optional<Collected> product = collect(term);
      if (!product) return std::nullopt;
      for (const auto& [monomial, coefficient] : *product) add(result, monomial, coefficient);
      if (result.size() > limit_) return std::nullopt;
    }
    return result;
  }

  std::optional<Collected> collect(const Term& term) {
    Collected result{{Monomial{}, term.coefficient}};
    for (const VariablePower& l : term.monomial) {
      if (!is_product_of_sums(l.variable)) {
        result = multiplied(result, {{Monomial{l}, 1}});
        continue;
      }
      const Polynomial& value = system_.variables[static_cast<std::size_t>(l.variable)].value;
      const std::optional<Collected> factor = collect(value);
      if (!factor) return std::nullopt;
      if (factor->size() > 1 && l.exponent > kHighestPower) return std::nullopt;
      for (int i = 0; i < l.exponent; ++i) {
        if (result.size() * factor->size() > 4 * limit_) return std::nullopt;
        result = multiplied(result, *factor);
        if (result.size() > limit_) return std::nullopt;
      }
    }
    return result;
  }

  Collected multiplied(const Collected& a, const Collected& b) const {
    Collected result;
    for (const auto& [left, c] : a) {
      for (const auto& [right, d] : b) add(result, cancelled(multiply(left, right)), c * d);
    }
    return result;
  }

  /// x * (1/x) = 1.
  Monomial cancelled(Monomial monomial) const {
    for (VariablePower& inverse : monomial) {
      const Variable& v = system_.variables[static_cast<std::size_t>(inverse.variable)];
      if (v.kind != Variable::Kind::function || v.function != Op::div) continue;
      for (VariablePower& base : monomial) {
        if (base.variable != v.arguments[0]) continue;
        const int common = std::min(base.exponent, inverse.exponent);
        base.exponent -= common;
        inverse.exponent -= common;
      }
    }
    std::erase_if(monomial, [](const VariablePower& l) { return l.exponent == 0; });
    return monomial;
  }

  static void add(Collected& to, const Monomial& monomial, const cln::cl_RA& coefficient) {
    const auto [place, is_new] = to.try_emplace(monomial, coefficient);
    if (!is_new) place->second = place->second + coefficient;
  }

  const TermSystem& system_;
  std::size_t limit_;
};

/// How often each variable is used, in polynomials, as an argument and as an output.
std::vector<int> use_counts(const TermSystem& system) {
  std::vector<int> uses(system.variables.size(), 0);
  for (const int output : system.outputs) ++uses[static_cast<std::size_t>(output)];
  for (const Variable& v : system.variables) {
    for (const int argument : v.arguments) ++uses[static_cast<std::size_t>(argument)];
    for (const Term& t : v.value) {
      for (const VariablePower& l : t.monomial) {
        uses[static_cast<std::size_t>(l.variable)] += l.exponent;
      }
    }
  }
  return uses;
}

}  // namespace

bool comes_before(const Monomial& a, const Monomial& b) {
  const int left = degree(a);
  const int right = degree(b);
  if (left != right) return left > right;
  return std::ranges::lexicographical_compare(
      a, b, [](const VariablePower& s, const VariablePower& t) {
        return s.variable != t.variable ? s.variable < t.variable : s.exponent > t.exponent;
      });
}

std::optional<Polynomial> expanded_value(const TermSystem& system, int variable,
                                         std::size_t limit) {
  return Expander(system, limit).expand(system.variables[static_cast<std::size_t>(variable)].value);
}

std::optional<TermSystem> expanded(const TermSystem& system, std::size_t limit) {
  TermSystem result = system;
  Expander expander(system, limit);
  std::size_t total = 0;
  for (const int output : system.outputs) {
    auto value = expander.expand(system.variables[static_cast<std::size_t>(output)].value);
    if (!value || (total += value->size()) > limit) return std::nullopt;
    result.variables[static_cast<std::size_t>(output)].value = std::move(*value);
  }
  return result;
}

TermSystem flattened(TermSystem system) {
  const std::vector<int> uses = use_counts(system);
  const auto is_inlined = [&](const Term& t) {
    if (t.monomial.size() != 1 || t.monomial[0].exponent != 1) return false;
    const auto v = static_cast<std::size_t>(t.monomial[0].variable);
    const Variable& variable = system.variables[v];
    return uses[v] == 1 && variable.kind == Variable::Kind::polynomial && !variable.constant &&
           (cln::abs(t.coefficient) == 1 || variable.value.size() == 1);
  };
  for (Variable& variable : system.variables) {
    for (std::size_t i = 0; i < variable.value.size();) {
      const Term term = variable.value[i];
      if (!is_inlined(term)) {
        ++i;
        continue;
      }
      Polynomial inner =
          system.variables[static_cast<std::size_t>(term.monomial[0].variable)].value;
      for (Term& t : inner) t.coefficient = t.coefficient * term.coefficient;
      const auto place = variable.value.erase(variable.value.begin() + static_cast<long>(i));
      variable.value.insert(place, inner.begin(), inner.end());
    }
  }
  return system;
}

}  // namespace casimir::codegen
