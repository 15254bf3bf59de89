#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "symbolic/functions/generator_table.hpp"

namespace casimir::functions {

/// Points at which functions are told apart by their values before algebra is asked.
constexpr std::size_t kProbes = 8;

/// A point in double precision, by which nothing is proved: it only saves the work on what does
/// not hold there.
struct Probe {
  std::vector<double> coordinates;                ///< of the symbols
  std::vector<std::optional<double>> generators;  ///< as far as they were computed
};
/// Whether two values at a point are of different functions; false where one is no number.
bool differ(double a, double b);

/// Computes values in double precision, to tell functions apart before algebra is asked whether
/// they are equal. Nothing is proved by it: a relation that is overlooked makes an answer
/// `undecided`.
class FunctionProbe {
 public:
  explicit FunctionProbe(const GeneratorTable& table) : table_(table) {}

  /// Another point for each k below `kProbes`: coordinates between 0.3 and 1 in no simple relation.
  Probe probe(std::size_t k) const;
  /// The value of `p` there, as exact as doubles are; not a number where it has no real one.
  double value_at(Probe& probe, const Polynomial& p) const;
  /// Whether all functions of the ring have, but for 1/d: the derivatives of roots have
  /// denominators where the roots themselves have values.
  bool has_values_at(Probe& probe) const;

 private:
  double generator_at(Probe& probe, std::size_t g) const;
  double new_generator_at(Probe& probe, std::size_t g) const;
  double arbitrary_at(Probe& probe, const Generator& g) const;

  const GeneratorTable& table_;
};

}  // namespace casimir::functions
