#pragma once

#include <cstdint>
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

}  // namespace casimir
