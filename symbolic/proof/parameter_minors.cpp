#include "symbolic/proof/parameter_minors.hpp"

#include <algorithm>

#include <cln/integer.h>
#include <cln/rational.h>

#include <stdexcept>

namespace casimir {
namespace {

using MinorWord = std::uint64_t;
constexpr MinorWord kMinorPrime = 2147483629;  // products of two residues fit into a word

MinorWord minor_residue(const cln::cl_I& n) {
  return cln::cl_I_to_ulong(cln::mod(n, cln::cl_I(static_cast<unsigned long>(kMinorPrime))));
}

MinorWord minor_power(MinorWord base, MinorWord exponent) {
  MinorWord result = 1;
  for (; exponent > 0; exponent /= 2, base = base * base % kMinorPrime)
    if (exponent % 2 == 1) result = result * base % kMinorPrime;
  return result;
}

std::optional<MinorWord> minor_fraction(const cln::cl_RA& number) {
  const MinorWord below = minor_residue(cln::denominator(number));
  if (below == 0) return std::nullopt;
  return minor_residue(cln::numerator(number)) * minor_power(below, kMinorPrime - 2) % kMinorPrime;
}

}  // namespace

std::optional<Polynomial> short_determinant(std::vector<std::vector<Polynomial>> m,
                                            const PolynomialRing& ring, std::size_t most_terms) {
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
        if (m[i][j].terms() > most_terms) return std::nullopt;
      }
    }
    previous = m[k][k];
  }
  return m.empty() ? ring.constant(1) : m.back().back();
}

std::vector<std::vector<std::size_t>> with_one_changed(const std::vector<std::size_t>& indices,
                                                       std::size_t end) {
  std::vector<std::vector<std::size_t>> result{indices};
  for (std::size_t k = 0; k < indices.size(); ++k) {
    for (std::size_t other = 0; other < end; ++other) {
      if (std::find(indices.begin(), indices.end(), other) != indices.end()) continue;
      result.push_back(indices);
      result.back()[k] = other;
    }
  }
  return result;
}

MinorModulo::MinorModulo(const Polynomial& p) {
  for (const auto& [number, exponents] : p.term_list()) {
    const std::optional<MinorWord> residue = minor_fraction(number);
    if (!residue) throw std::domain_error("a denominator is a multiple of the prime");
    Term term{*residue, {}};
    for (std::size_t i = 0; i < exponents.size(); ++i)
      if (exponents[i] > 0) term.powers.emplace_back(i, exponents[i]);
    terms_.push_back(std::move(term));
  }
}

std::uint64_t MinorModulo::value_at(const std::vector<std::uint64_t>& point) const {
  MinorWord sum = 0;
  for (const Term& term : terms_) {
    MinorWord product = term.number;
    for (const auto& [place, exponent] : term.powers)
      product = product * minor_power(point[place], exponent) % kMinorPrime;
    sum = (sum + product) % kMinorPrime;
  }
  return sum;
}

MatrixModulo::MatrixModulo(const std::vector<std::vector<Polynomial>>& rows) {
  try {
    for (const auto& row : rows) {
      rows_.emplace_back();
      for (const Polynomial& p : row) rows_.back().emplace_back(p);
    }
  } catch (const std::domain_error&) {
    rows_.clear();
  }
}

std::size_t MatrixModulo::rank_at(const std::vector<GiNaC::ex>& point) const {
  std::vector<MinorWord> residues;
  for (const GiNaC::ex& x : point) {
    if (!x.info(GiNaC::info_flags::rational)) return 0;
    const auto residue =
        minor_fraction(cln::the<cln::cl_RA>(GiNaC::ex_to<GiNaC::numeric>(x).to_cl_N()));
    if (!residue) return 0;
    residues.push_back(*residue);
  }
  std::vector<std::vector<MinorWord>> m;
  for (const auto& row : rows_) {
    m.emplace_back();
    for (const MinorModulo& p : row) m.back().push_back(p.value_at(residues));
  }
  std::size_t rank = 0;
  for (std::size_t j = 0; rank < m.size() && j < m[0].size(); ++j) {
    std::size_t pivot = rank;
    while (pivot < m.size() && m[pivot][j] == 0) ++pivot;
    if (pivot == m.size()) continue;
    std::swap(m[pivot], m[rank]);
    const MinorWord over = minor_power(m[rank][j], kMinorPrime - 2);
    for (std::size_t i = rank + 1; i < m.size(); ++i) {
      const MinorWord factor = m[i][j] * over % kMinorPrime;
      if (factor == 0) continue;
      for (std::size_t k = j; k < m[0].size(); ++k)
        m[i][k] = (m[i][k] + (kMinorPrime - factor) * m[rank][k]) % kMinorPrime;
    }
    ++rank;
  }
  return rank;
}

}  // namespace casimir
