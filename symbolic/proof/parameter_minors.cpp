#include "symbolic/proof/parameter_minors.hpp"

#include <cln/integer.h>
#include <cln/rational.h>

#include <stdexcept>

namespace casimir {
namespace {

using Word = std::uint64_t;
constexpr Word kPrime = 2147483629;  // products of two residues fit into a word

Word residue(const cln::cl_I& n) {
  return cln::cl_I_to_ulong(cln::mod(n, cln::cl_I(static_cast<unsigned long>(kPrime))));
}

Word power(Word base, Word exponent) {
  Word result = 1;
  for (; exponent > 0; exponent /= 2, base = base * base % kPrime)
    if (exponent % 2 == 1) result = result * base % kPrime;
  return result;
}

}  // namespace

std::optional<Polynomial> short_determinant(std::vector<std::vector<Polynomial>> m,
                                            const PolynomialRing& ring) {
  constexpr std::size_t kMostTerms = 40;
  Polynomial previous = ring.constant(1);
  for (std::size_t k = 0; k + 1 < m.size(); ++k) {
    std::size_t pivot = k;
    while (pivot < m.size() && m[pivot][k].is_zero()) ++pivot;
    if (pivot == m.size()) return Polynomial(ring);
    std::swap(m[pivot], m[k]);
    for (std::size_t i = k + 1; i < m.size(); ++i) {
      for (std::size_t j = k + 1; j < m.size(); ++j) {
        const Polynomial next = m[i][j] * m[k][k] - m[i][k] * m[k][j];
        next.divide(previous, &m[i][j]);
        if (m[i][j].terms() > kMostTerms) return std::nullopt;
      }
    }
    previous = m[k][k];
  }
  return m.empty() ? ring.constant(1) : m.back().back();
}

MinorModulo::MinorModulo(const Polynomial& p) {
  for (const auto& [number, exponents] : p.term_list()) {
    const Word below = residue(cln::denominator(number));
    if (below == 0) throw std::domain_error("a denominator is a multiple of the prime");
    Term term{residue(cln::numerator(number)) * power(below, kPrime - 2) % kPrime, {}};
    for (std::size_t i = 0; i < exponents.size(); ++i)
      if (exponents[i] > 0) term.powers.emplace_back(i, exponents[i]);
    terms_.push_back(std::move(term));
  }
}

bool MinorModulo::is_nonzero_at(const std::vector<std::uint64_t>& point) const {
  Word sum = 0;
  for (const Term& term : terms_) {
    Word product = term.number;
    for (const auto& [place, exponent] : term.powers)
      product = product * power(point[place], exponent) % kPrime;
    sum = (sum + product) % kPrime;
  }
  return sum != 0;
}

}  // namespace casimir
