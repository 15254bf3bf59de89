#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "runtime/program.hpp"

namespace casimir {

/// The entries of a matrix that are not identically zero.
struct SparseProgram {
  std::vector<std::pair<int, int>> entries;  ///< row and column of each output of the program
  Program program;
};

namespace codegen {

// Derivatives of straight-line programs, line by line (Griewank & Walther, Evaluating Derivatives,
// 2008). They are exact: the results are programs over the same inputs that differ from the
// derivatives by nothing but rounding. Values that a function and its derivative share are computed
// once: exp and its derivative, tan and 1 + tan^2, a quotient and its derivative.
//
// `variables` is how many of the inputs, from the first, are differentiated by.

/// d output_row / d input_column by the forward mode, by columns. What is zero because nothing
/// leads from the input to the output has no entry. The outputs are called "dM1/dg2" after an
/// output dM1 and an input g2.
SparseProgram jacobian(const Program& program, std::size_t variables);

/// The gradient of each output by the reverse mode: entry (i, k) is d output_k / d input_i,
/// gradient after gradient. Each takes at most five operations for each one that its output needs,
/// whatever the number of variables. Called "dH/dM1".
SparseProgram gradients(const Program& program, std::size_t variables);

/// The outputs, and then the derivative of each along a deviation of the variables: the right-hand
/// side of the variational equations. The deviations are inputs behind the variables and are called
/// "delta_M1"; the derivative of an output dM1 is called "ddelta_M1".
Program variational(const Program& program, std::size_t variables);

/// The same by the columns of the Jacobian, each times its deviation: where the entries are short,
/// the optimiser makes more of this.
Program variational_by_columns(const Program& program, std::size_t variables);

}  // namespace codegen
}  // namespace casimir
