#pragma once

#include <ginac/ginac.h>

#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "symbolic/discrete/prime_field.hpp"

namespace casimir::discrete {

/// Rational functions as a list of operations modulo the prime, each part once.
class ModularProgram {
 public:
  /// \param symbols  whose values `run` is given, in this order
  /// \throws ModelError  for what is no rational function with rational coefficients
  ModularProgram(const std::vector<GiNaC::symbol>& symbols, const std::vector<GiNaC::ex>& functions,
                 Element prime = kPrime);

  /// The values of the functions; empty where a denominator vanishes modulo the prime.
  std::optional<std::vector<Element>> run(const std::vector<Element>& values) const;

  /// The same over a ring that has the field in it.
  /// \param ring  has `constant`, `add`, `multiply`, `power`, and `inverse`, which may be empty
  template <class Number, class Ring>
  std::optional<std::vector<Number>> run_over(const std::vector<Number>& values,
                                              const Ring& ring) const {
    std::vector<Number> done;
    done.reserve(operations_.size());
    for (const Operation& o : operations_) {
      std::optional<Number> next;
      switch (o.kind) {
        case Kind::constant:
          next = ring.constant(o.value);
          break;
        case Kind::symbol:
          next = values[o.a];
          break;
        case Kind::sum:
          next = ring.add(done[o.a], done[o.b]);
          break;
        case Kind::product:
          next = ring.multiply(done[o.a], done[o.b]);
          break;
        case Kind::power:
          next = ring.power(done[o.a], o.b);
          break;
        case Kind::inverse:
          next = ring.inverse(done[o.a]);
          break;
      }
      if (!next) return std::nullopt;
      done.push_back(std::move(*next));
    }
    std::vector<Number> results;
    for (const std::size_t place : results_) results.push_back(done[place]);
    return results;
  }

 private:
  enum class Kind { constant, symbol, sum, product, power, inverse };
  struct Operation {
    Kind kind;
    std::size_t a = 0, b = 0;  ///< earlier operations; a place, or an exponent
    Element value = 0;         ///< of a constant
  };
  std::size_t place_of(const GiNaC::ex& e);
  std::size_t compile(const GiNaC::ex& e);
  std::size_t add(Operation operation);

  PrimeField field_;
  std::vector<Operation> operations_;
  std::vector<std::size_t> results_;
  std::unordered_map<GiNaC::ex, std::size_t> known_;
};

}  // namespace casimir::discrete
