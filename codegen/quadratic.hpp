#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "runtime/kernels/quadratic_tables.h"
#include "runtime/program.hpp"

namespace casimir {

/// A right-hand side that is a polynomial of degree two in the states, without the time.
struct QuadraticForm {
  struct Product {
    int first, second;           ///< of the two states, first <= second
    std::vector<double> factor;  ///< in each rate
  };
  int states = 0;
  std::vector<double> constant;             ///< of each rate
  std::vector<std::vector<double>> linear;  ///< [rate][state]
  std::vector<Product> products;            ///< those that some rate has
};

/// The polynomials that a right-hand side computes, or nothing where it is of another kind:
/// functions or quotients of states, products of three, the time. Coefficients are exact until they
/// are rounded.
/// \param parameters  values of the inputs between the states and the time.
std::optional<QuadraticForm> quadratic_form(const Program& rhs,
                                            const std::vector<double>& parameters = {});

/// The layout for the lanes of a register: as few registers of products as possible, and of those
/// layouts one with few products that must be moved. Nothing if there are more than 8 states or
/// more products than the tables hold. Always the same for the same form.
std::optional<casimir_quadratic> quadratic_tables(const QuadraticForm& form);

}  // namespace casimir
