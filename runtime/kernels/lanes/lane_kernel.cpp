// The table-driven kernel for ensembles, for one instruction set: see quadratic_kernel.cpp.
#define CASIMIR_JOIN_(a, b) a##b
#define CASIMIR_JOIN(a, b) CASIMIR_JOIN_(a, b)
#define casimir_kernel CASIMIR_JOIN(casimir_kernel_, CASIMIR_TARGET)

#include "runtime/kernels/lanes/lane_quadratic.hpp"

namespace {

struct RunTimeTables {
  static constexpr bool known = false;
  static constexpr int most_sums = 1, most_states = 0;
  const casimir_lane_tables& tables;
  const int states = tables.states;
};

using Series = casimir_kernel::lanes::Quadratic<RunTimeTables, casimir_kernel::kNativeWidth>;

}  // namespace

extern "C" {

int CASIMIR_JOIN(casimir_lanes_, CASIMIR_TARGET)(void) { return casimir_kernel::kNativeWidth; }

void CASIMIR_JOIN(casimir_ensemble_, CASIMIR_TARGET)(const casimir_lane_tables* tables,
                                                     const casimir_ensemble* run) {
  const int order = casimir_kernel::lanes::order_of(run), stride = order + 1;
  const int rows = Series::count_of_rows(*tables) * stride, sums = 4 * tables->sums,
            numbers = Series::count_of_numbers(*tables);
  auto* const memory = new Series::V[static_cast<unsigned long>(rows + sums + numbers)]();
  auto* const pairs = new Series::Pair[static_cast<unsigned long>(tables->first[tables->sums])];
  Series series(RunTimeTables{*tables}, order, stride,
                {memory, memory + rows, memory + rows + sums, pairs});
  casimir_kernel::lanes::March<Series>(run, series).go();
  delete[] pairs;
  delete[] memory;
}
}
