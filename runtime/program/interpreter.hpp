#pragma once

#include <vector>

#include "runtime/program.hpp"

namespace casimir {

/// Runs a program over doubles, line by line: what serves where nothing is compiled. Allocates
/// nothing after its construction. One object serves one thread at a time.
class Interpreter {
 public:
  explicit Interpreter(const Program& program);

  /// \param inputs  one number for each input of the program.
  /// \param outputs  one for each output.
  void operator()(const double* inputs, double* outputs) const;

 private:
  Program program_;
  mutable std::vector<double> values_;  ///< of each line; those of constants never change
};

}  // namespace casimir
