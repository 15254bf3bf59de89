#pragma once

#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include "runtime/program.hpp"

namespace casimir {

/// A map in doubles with random errors in every operation, each as large as rounding may make it:
/// what cancels, as 1 - cos(y) for small y, shows them.
class DisturbedMap {
 public:
  /// Borrows the program, whose inputs are the state, the parameters and the time.
  explicit DisturbedMap(const Program& program) : program_(program), value_(program.code.size()) {}

  /// How many operations a step has.
  std::size_t operations() const { return program_.code.size(); }

  /// \param next  receives one number for each output
  void operator()(const std::vector<double>& state, const std::vector<double>& parameters,
                  std::mt19937_64& random, std::vector<double>& next);

 private:
  const Program& program_;
  std::vector<double> value_;
};

/// A map in long doubles, where these are longer.
class LongerMap {
 public:
  /// Borrows the program, whose inputs are the state, the parameters and the time.
  LongerMap(const Program& program, std::vector<long double> parameters);

  /// The next state in the place of this one.
  void operator()(std::vector<long double>& state);

 private:
  const Program& program_;
  std::vector<long double> parameters_, value_;
};

/// The program with other doubles for the numbers in it that are none: what is computed with a
/// rounded number is another map, and all steps have the same error, so that it grows faster than
/// what happens at random. A constant becomes the double on its other side; what is computed of
/// constants alone is moved by one unit of its last digit. Nothing where all numbers are doubles.
/// \param all  whether all are moved, or each or not at random, so that their effects do not cancel twice
std::optional<Program> with_moved_constants(Program program, std::mt19937_64& random, bool all);

}  // namespace casimir
