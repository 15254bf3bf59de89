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
  ModularProgram(const std::vector<GiNaC::symbol>& symbols,
                 const std::vector<GiNaC::ex>& functions);

  /// The values of the functions; empty where a denominator vanishes modulo the prime.
  std::optional<std::vector<Element>> run(const std::vector<Element>& values) const;

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

  std::vector<Operation> operations_;
  std::vector<std::size_t> results_;
  std::unordered_map<GiNaC::ex, std::size_t> known_;
};

}  // namespace casimir::discrete
