#pragma once

#include <vector>

#include "runtime/kernels/lanes/lane_tables.h"
#include "runtime/program.hpp"

namespace casimir {

/// A right-hand side that is a polynomial of degree two in the states, without the time, as the
/// kernels for ensembles want it: a structure that all members share, and for each member numbers
/// that follow from its parameters. See casimir_lane_tables for what the lists mean.
struct LaneForm {
  int states = 0;
  std::vector<int> copied, first, negative, shared, shared_sum, linear, linear_state;
  std::vector<casimir_lane_product> products;
  Program numbers;  ///< inputs: the run-time parameters; outputs: the numbers of a member

  int sums() const { return static_cast<int>(negative.size()); }

  /// Points into this object.
  casimir_lane_tables tables() const {
    return {states,
            static_cast<int>(copied.size()),
            sums(),
            copied.data(),
            first.data(),
            negative.data(),
            products.data(),
            shared.data(),
            shared_sum.data(),
            linear.data(),
            linear_state.data()};
  }
};

}  // namespace casimir
