// The table-driven kernels for one instruction set. This file is compiled once for each, with
// CASIMIR_TARGET naming it. Templates that were compiled with different options and carry the same
// name would be merged by the linker, so everything here is in a namespace of its target.
#define CASIMIR_JOIN_(a, b) a##b
#define CASIMIR_JOIN(a, b) CASIMIR_JOIN_(a, b)
#define casimir_kernel CASIMIR_JOIN(casimir_kernel_, CASIMIR_TARGET)

#include "runtime/kernels/taylor/quadratic.hpp"
#include "runtime/kernels/taylor/wide.hpp"

extern "C" void CASIMIR_JOIN(casimir_series_, CASIMIR_TARGET)(const casimir_series* series,
                                                              const casimir_run* run, double* x,
                                                              casimir_outcome* out);

namespace {

constexpr int kWidth = casimir_kernel::kNativeWidth;

template <int width, int order>
void integrate(const casimir_quadratic& tables, const casimir_run* run, double* x,
               casimir_outcome* out) {
  using Series = casimir_kernel::taylor::Quadratic<width, order>;
  Series series(tables);
  casimir_kernel::taylor::March<Series>(run, series, x, out).go();
}

template <int width>
void with_order(const casimir_quadratic& tables, const casimir_run* run, double* x,
                casimir_outcome* out) {
  const int order = casimir_kernel::taylor::order_for(run);
  if (order <= 8) return integrate<width, 8>(tables, run, x, out);
  if (order <= 16) return integrate<width, 16>(tables, run, x, out);
  integrate<width, 24>(tables, run, x, out);
}

template <int blocks>
void integrate_wide(const casimir_wide& tables, const casimir_run* run, double* x,
                    casimir_outcome* out) {
  casimir_kernel::taylor::Wide<kWidth, blocks> wide(tables);
  const casimir_series series = wide.functions();
  CASIMIR_JOIN(casimir_series_, CASIMIR_TARGET)(&series, run, x, out);
}

}  // namespace

extern "C" void CASIMIR_JOIN(casimir_wide_, CASIMIR_TARGET)(const casimir_wide* tables,
                                                            const casimir_run* run, double* x,
                                                            casimir_outcome* out) {
  static_assert(CASIMIR_WIDE_BLOCKS == 3);
  if constexpr (kWidth == 2) {  // else quadratic.hpp
    if (tables->blocks == 1) return integrate_wide<1>(*tables, run, x, out);
  }
  if (tables->blocks == 2) return integrate_wide<2>(*tables, run, x, out);
  if (tables->blocks == 3) return integrate_wide<3>(*tables, run, x, out);
  if constexpr (kWidth * CASIMIR_WIDE_BLOCKS < CASIMIR_WIDE_STATES)
    integrate_wide<0>(*tables, run, x, out);
}

extern "C" void CASIMIR_JOIN(casimir_quadratic_,
                             CASIMIR_TARGET)([[maybe_unused]] const casimir_quadratic* tables,
                                             [[maybe_unused]] const casimir_run* run,
                                             [[maybe_unused]] double* x,
                                             [[maybe_unused]] casimir_outcome* out) {
  if constexpr (kWidth >= 4) {
    if (tables->states <= 4) return with_order<4>(*tables, run, x, out);
  }
  if constexpr (kWidth == 8) with_order<8>(*tables, run, x, out);
}
