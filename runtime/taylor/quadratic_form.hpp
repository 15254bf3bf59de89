#pragma once

#include <vector>

namespace casimir {

/// A right-hand side that is a polynomial of degree two in the states, without the time.
/// Plain data: code generation finds it, the precompiled kernels are laid out for it.
struct QuadraticForm {
  struct Product {
    int first, second;           ///< of the two states, first <= second
    std::vector<double> factor;  ///< in each rate
    std::vector<double> rest{};  ///< what rounding the factors to double lost, or empty: nothing
  };
  int states = 0;
  std::vector<double> constant;             ///< of each rate
  std::vector<std::vector<double>> linear;  ///< [rate][state]
  std::vector<Product> products;            ///< those that some rate has
  /// What rounding to double lost, or empty: nothing.
  std::vector<double> constant_rest;
  std::vector<std::vector<double>> linear_rest;
};

}  // namespace casimir
