#include "symbolic/structure/separate/separation_text.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace casimir::structure {

std::string in_powers(const Leaves& leaves, const std::vector<Polynomial>& coefficients,
                      const std::string& u) {
  std::string sum;
  for (std::size_t m = coefficients.size(); m-- > 0;) {
    if (coefficients[m].is_zero()) continue;
    const std::string power = m == 0 ? "" : m == 1 ? u : fmt::format("{}^{}", u, m);
    std::string own = text_of(leaves, coefficients[m]);
    if (coefficients[m].terms() > 1) own = "(" + own + ")";
    if (!power.empty()) own = own == "1" ? power : own == "-1" ? "-" + power : own + "*" + power;
    sum += sum.empty() ? own : own.starts_with('-') ? " - " + own.substr(1) : " + " + own;
  }
  return sum.empty() ? "0" : sum;
}

std::string text_of(const Leaves& leaves, const Polynomial& p) {
  return leaves.system().functions().text(p);
}

Separation::Relation relation_of(const Leaves& leaves, const Multipliers& s,
                                 const SeparationNames& names) {
  Separation::Relation result;
  result.may_vanish = true;
  for (std::size_t j = 0; j < s.size(); ++j) {
    std::string own = in_powers(leaves, s[j], names.root);
    result.multipliers.push_back(own);
    if (own == "0") continue;
    const bool is_constant = std::ranges::all_of(s[j].begin() + 1, s[j].end(),
                                                 [](const auto& p) { return p.is_zero(); });
    if (is_constant && s[j][0].is_constant()) result.may_vanish = false;
    const bool minus = own.starts_with('-') && own.find(' ') == std::string::npos;
    if (minus) own.erase(0, 1);
    if (own.find(' ') != std::string::npos && (own[0] != '(' || own.find(')') + 1 != own.size()))
      own = "(" + own + ")";
    const std::string product =
        (own == "1" ? "" : own + "*") + fmt::format("{}{}", names.integral, j + 1);
    const std::string sign = result.sum.empty() ? (minus ? "-" : "") : minus ? " - " : " + ";
    result.sum += sign + product;
  }
  return result;
}

/// In descending powers of u, times the sum G.
std::string text_of(const Leaves& leaves, const SeparatedEquation& equation, const std::string& u,
                    const std::string& g) {
  std::vector<SeparatedEquation::Term> terms = equation.terms;
  std::ranges::stable_sort(terms, [](const auto& a, const auto& b) {
    return std::pair(b.degree, b.power) < std::pair(a.degree, a.power);
  });
  const cln::cl_RA number =
      equation.denominator.is_constant() ? equation.denominator.content() : cln::cl_RA(1);
  const cln::cl_RA sign = equation.denominator.is_constant() &&
                                  !(equation.denominator == leaves.ring().constant(number))
                              ? -1
                              : 1;
  std::string sum;
  for (const SeparatedEquation::Term& one : terms) {
    std::string own = text_of(leaves, one.coefficient.scaled(sign / number));
    if (one.coefficient.terms() > 1) own = "(" + own + ")";
    for (const auto& [name, power] : {std::pair(u, one.power), std::pair(g, one.degree)}) {
      if (power == 0) continue;
      own = own == "1" ? "" : own == "-1" ? "-" : own + "*";
      own += power == 1 ? name : fmt::format("{}^{}", name, power);
    }
    sum += sum.empty() ? own : own.starts_with('-') ? " - " + own.substr(1) : " + " + own;
  }
  if (sum.empty()) return "0";
  std::string bottom =
      equation.denominator.is_constant() ? "" : text_of(leaves, equation.denominator);
  if (equation.denominator.terms() > 1) bottom = "(" + bottom + ")";
  if (equation.shift > 0)
    bottom += (bottom.empty() ? "" : "*") + fmt::format("{}^{}", u, equation.shift);
  if (bottom.empty()) return sum;
  return fmt::format("({})/({})", sum, bottom);
}

/// The factors of what may not be zero, each once, without numbers.
std::vector<std::string> factors_of(const Leaves& leaves, const std::vector<Polynomial>& list) {
  std::vector<std::string> result;
  for (const Polynomial& p : list) {
    std::vector<Polynomial> factors = moderate_factors(p);
    if (factors.empty()) factors.push_back(p);
    for (const Polynomial& factor : factors) {
      if (factor.is_constant()) continue;
      const std::string own = text_of(leaves, factor);
      if (std::ranges::find(result, own) == result.end()) result.push_back(own);
    }
  }
  return result;
}

void write_bivector(Separation& result, const Leaves& leaves, const Bivector& bivector) {
  for (std::size_t c = 0; c < bivector.size(); ++c) {
    const Polynomial& p = bivector[c];
    if (p.is_zero()) continue;
    const std::vector<std::size_t> pair = skew_indices(leaves.dimension(), 2)[c];
    result.bivector.emplace_back(
        leaves.system().name(pair[0]) + "," + leaves.system().name(pair[1]), text_of(leaves, p));
    long size = 0;
    for (const auto& [number, exponents] : p.term_list()) {
      long sum = 0;
      for (std::size_t i = 0; i < leaves.dimension(); ++i) sum += static_cast<long>(exponents[i]);
      size = std::max(size, sum);
    }
    result.degree = std::max(result.degree, static_cast<int>(size));
  }
}

void write_roots(Separation& result, const Leaves& leaves, const RootCoefficients& a) {
  const std::size_t n = a.size();
  result.polynomial = fmt::format("{}^{}", result.names.root, n);
  for (std::size_t k = 1; k <= n; ++k) {
    const std::string own_text = text_of(leaves, a[k - 1]);
    result.coefficients.push_back(own_text);
    if (a[k - 1].is_zero()) continue;
    const std::string power = n == k       ? ""
                              : n - k == 1 ? "*" + result.names.root
                                           : fmt::format("*{}^{}", result.names.root, n - k);
    result.polynomial += fmt::format(" + ({}){}", own_text, power);
  }
}

}  // namespace casimir::structure
