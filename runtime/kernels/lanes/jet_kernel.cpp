// The series of section functions, for one instruction set: see quadratic_kernel.cpp.
#define CASIMIR_JOIN_(a, b) a##b
#define CASIMIR_JOIN(a, b) CASIMIR_JOIN_(a, b)
#define casimir_kernel CASIMIR_JOIN(casimir_kernel_, CASIMIR_TARGET)

#include "runtime/kernels/lanes/lane_jet.hpp"
#include "runtime/module_abi.h"

extern "C" void CASIMIR_JOIN(casimir_jet_, CASIMIR_TARGET)(const casimir_jet_tables* tables,
                                                           const casimir_lane_step* step,
                                                           double* memory,
                                                           casimir_jet_range* range) {
  using V = casimir_kernel::Lanes<casimir_kernel::kNativeWidth>;
  casimir_kernel::lanes::Jet<V> jet(*tables, reinterpret_cast<V*>(memory));
  casimir_kernel::lanes::bernstein_range(jet.expand(*step), step->order,
                                         *reinterpret_cast<const V*>(step->taken), *range);
}
