#pragma once

#include <string>

#include "symbolic/functions/generator_table.hpp"

namespace casimir::functions {

/// Writes polynomials of a table as text with terms in the ring's order: the same in every run,
/// unlike GiNaC's.
class FunctionText {
 public:
  explicit FunctionText(const GeneratorTable& table) : table_(table) {}
  std::string text(const Polynomial& p) const;

 private:
  std::string name(const Generator& g) const;
  std::string power_of(const Generator& g, unsigned long exponent) const;

  const GeneratorTable& table_;
};

}  // namespace casimir::functions
