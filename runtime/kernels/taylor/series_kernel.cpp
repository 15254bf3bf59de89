// The integrator along Taylor series for one instruction set: see quadratic_kernel.cpp about the
// names.
#define CASIMIR_JOIN_(a, b) a##b
#define CASIMIR_JOIN(a, b) CASIMIR_JOIN_(a, b)
#define casimir_kernel CASIMIR_JOIN(casimir_kernel_, CASIMIR_TARGET)

#include "runtime/kernels/taylor/called_series.hpp"

namespace {

template <int fixed>
void integrate(const casimir_series& called, int blocks, const casimir_run* run, double* x,
               casimir_outcome* out) {
  namespace taylor = casimir_kernel::taylor;
  const bool large = called.registers > 0 ? called.registers >= taylor::kManyRegisters
                                          : called.states >= taylor::kManyStates;
  using Series = taylor::CalledSeries<fixed>;
  Series series(called, taylor::order_for(run, large), blocks);
  called.start(called.object, series.order, run->parameters);
  taylor::March<Series>(run, series, x, out).go();
}

}  // namespace

extern "C" void CASIMIR_JOIN(casimir_series_, CASIMIR_TARGET)(const casimir_series* series,
                                                              const casimir_run* run, double* x,
                                                              casimir_outcome* out) {
  constexpr int width = casimir_kernel::kNativeWidth;
  const int blocks = (series->states + width - 1) / width;
  switch (blocks) {
    case 1:
      return integrate<1>(*series, blocks, run, x, out);
    case 2:
      return integrate<2>(*series, blocks, run, x, out);
    case 3:
      return integrate<3>(*series, blocks, run, x, out);
    case 4:
      return integrate<4>(*series, blocks, run, x, out);
    default:
      return integrate<0>(*series, blocks, run, x, out);
  }
}
