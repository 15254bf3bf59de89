#include "symbolic/search/modular/linear_map.hpp"

#include <algorithm>
#include <map>
#include <stdexcept>

namespace casimir::search {
namespace {

struct Term {
  std::uint64_t key;
  Residue coefficient;
};

/// Polynomials as terms in some of their variables, the others having values.
class Flattener {
 public:
  Flattener(const std::vector<std::size_t>& places, const std::vector<std::uint64_t>& keys,
            const Point& constants, const Modulus& modulus)
      : keys_(constants.size(), 0),
        is_row_(constants.size()),
        constants_(constants),
        modulus_(modulus) {
    for (std::size_t i = 0; i < places.size(); ++i) {
      keys_[places[i]] = keys[i];
      is_row_[places[i]] = true;
    }
  }

  std::vector<Term> terms(const Polynomial& p) const {
    std::map<std::uint64_t, Residue> sums;
    for (const auto& [number, exponents] : p.term_list()) {
      const std::optional<Residue> residue = modulus_.reduce(number);
      if (!residue) throw std::domain_error("the prime divides a denominator");
      Residue coefficient = *residue;
      std::uint64_t key = 0;
      for (std::size_t i = 0; i < exponents.size(); ++i) {
        if (exponents[i] == 0) continue;
        if (is_row_[i]) {
          key += keys_[i] * exponents[i];
        } else {
          coefficient = modulus_.multiply(coefficient, modulus_.power(constants_[i], exponents[i]));
        }
      }
      Residue& sum = sums[key];
      sum = modulus_.add(sum, coefficient);
    }
    std::vector<Term> result;
    for (const auto& [key, sum] : sums)
      if (sum != 0) result.push_back({key, sum});
    return result;
  }

 private:
  std::vector<std::uint64_t> keys_;
  std::vector<bool> is_row_;
  const Point& constants_;
  const Modulus& modulus_;
};

std::uint64_t key_of(const std::uint8_t* exponents, const std::vector<std::uint64_t>& keys) {
  std::uint64_t key = 0;
  for (std::size_t i = 0; i < keys.size(); ++i) key += exponents[i] * keys[i];
  return key;
}

int highest_degree(const Monomials& monomials) {
  int highest = 0;
  for (std::size_t c = 0; c < monomials.size(); ++c) {
    int degree = 0;
    for (std::size_t i = 0; i < monomials.variables(); ++i) degree += monomials[c][i];
    highest = std::max(highest, degree);
  }
  return highest;
}

/// Field by field and variable by variable: terms of rate/variable, so that their keys are added to
/// that of a monomial.
using FlatFields = std::vector<std::vector<std::vector<Term>>>;

FlatFields flatten(const Fields& fields, const Flattener& flat,
                   const std::vector<std::uint64_t>& keys) {
  // A number of its own for each field keeps its equations apart.
  std::mt19937_64 random(2);
  FlatFields result;
  for (const std::vector<Polynomial>& rates : fields.rates) {
    const std::uint64_t label = fields.rates.size() > 1 ? random() : 0;
    auto& field = result.emplace_back();
    for (std::size_t i = 0; i < rates.size(); ++i) {
      std::vector<Term> terms = flat.terms(rates[i]);
      for (Term& term : terms) term.key += label - keys[i];
      field.push_back(std::move(terms));
    }
  }
  return result;
}

}  // namespace

Equations make_equations(const Fields& fields, const Monomials& ansatz,
                         const std::vector<Relation>& relations, const Point& constants,
                         const Modulus& modulus) {
  int growth = 0;
  for (const auto& rates : fields.rates)
    for (const Polynomial& rate : rates)
      growth = std::max(growth, static_cast<int>(rate.total_degree()));
  int degree = highest_degree(ansatz) + growth;
  for (const Relation& relation : relations) {
    degree = std::max(degree, highest_degree(relation.multipliers) +
                                  static_cast<int>(relation.function.total_degree()));
  }
  const std::vector<std::uint64_t> keys = monomial_keys(fields.places.size(), degree);
  const Flattener flat(fields.places, keys, constants, modulus);
  const FlatFields rates = flatten(fields, flat, keys);
  std::size_t columns = ansatz.size(), expected = 0;
  for (const Relation& relation : relations) columns += relation.multipliers.size();
  for (std::size_t c = 0; c < ansatz.size(); ++c)
    for (const auto& field : rates)
      for (std::size_t i = 0; i < field.size(); ++i)
        if (ansatz[c][i] != 0) expected += field[i].size();
  EquationBuilder builder(modulus, columns, expected);
  for (const Relation& relation : relations) {
    const std::vector<Term> terms = flat.terms(relation.function);
    for (std::size_t c = 0; c < relation.multipliers.size(); ++c) {
      const std::uint64_t key = key_of(relation.multipliers[c], keys);
      for (const Term& term : terms) builder.add(key + term.key, term.coefficient);
      builder.next_column();
    }
  }
  for (std::size_t c = 0; c < ansatz.size(); ++c) {
    const std::uint64_t key = key_of(ansatz[c], keys);
    for (const auto& field : rates) {
      for (std::size_t i = 0; i < field.size(); ++i) {
        const std::uint8_t exponent = ansatz[c][i];
        if (exponent == 0) continue;
        for (const Term& term : field[i])
          builder.add(key + term.key, modulus.multiply(term.coefficient, exponent));
      }
    }
    builder.next_column();
  }
  return builder.finish();
}

double bytes_of_equations(const Fields& fields, const std::vector<int>& weights, int degree) {
  // A triplet, its share of the table of rows, and the entry, twice while blocks are split off.
  constexpr double kBytesOfAnEntry = 60;
  const double columns = count_monomials(weights, degree);
  double entries = 0;
  for (const auto& rates : fields.rates) {
    for (std::size_t i = 0; i < rates.size(); ++i) {
      if (weights[i] > degree) continue;
      entries +=
          static_cast<double>(rates[i].terms()) * count_monomials(weights, degree - weights[i]);
    }
  }
  return entries * kBytesOfAnEntry + columns * static_cast<double>(weights.size() + 60);
}

}  // namespace casimir::search
