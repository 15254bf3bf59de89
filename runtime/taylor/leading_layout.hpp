#pragma once

#include <vector>

#include "runtime/kernels/taylor/leading_tables.h"
#include "runtime/taylor/quadratic_form.hpp"

namespace casimir {

/// The right-hand side of a quadratic system in twice the digits, laid out for registers.
class LeadingTables {
 public:
  /// \param width  lanes of a register.
  LeadingTables(const QuadraticForm& form, int width);

  /// The tables as the kernel reads them; they live as long as this object does.
  casimir_leading_tables view() const;

 private:
  /// The factor of a product of two states in a rate; second = -1: of the first alone.
  struct Term {
    int first = 0, second = -1;
    double factor = 0, rest = 0;
  };
  void add_constants(const QuadraticForm& form, int block);
  void add_linear(const QuadraticForm& form, int block);
  void add_products(const QuadraticForm& form, int block);
  void add_factors(const std::vector<Term>& lanes, std::vector<double>& rows) const;
  std::vector<std::vector<Term>> rows_of(const std::vector<std::vector<Term>>& lanes) const;

  int states_, width_, blocks_;
  std::vector<double> constant_, linear_factor_, product_factor_;
  std::vector<int> linear_begin_, product_begin_;
  std::vector<long long> linear_state_, product_left_, product_right_;
};

}  // namespace casimir
