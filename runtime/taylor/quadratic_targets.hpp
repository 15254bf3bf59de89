#pragma once

#include <memory>
#include <string>
#include <vector>

#include "runtime/kernels/taylor/series.h"
#include "runtime/module_abi.h"
#include "runtime/taylor/quadratic_form.hpp"

namespace casimir {

/// The instruction sets with precompiled kernels of their own that this processor runs, from the
/// one that is chosen (instruction_set.hpp): some of "avx512", "avx2", "baseline". Never empty.
std::vector<std::string> quadratic_targets();

/// Whether the precompiled kernels have room for a system: up to 24 states and 320 products, which
/// is all products that 24 states can have.
bool has_quadratic_kernel(const QuadraticForm& form);

/// A quadratic system laid out for the precompiled kernel of one instruction set: the method of
/// Taylor series without a compiler. Cheap to copy; may be used by several threads at once.
class QuadraticKernel {
 public:
  /// \param target  one of quadratic_targets(); empty: the first.
  /// \throws std::invalid_argument  if this processor does not run it, or there is no room.
  explicit QuadraticKernel(const QuadraticForm& form, const std::string& target = {});

  /// As casimir_integrate of a module. Allocates nothing.
  void integrate(const casimir_run* run, double* x, casimir_outcome* out) const;

 private:
  struct Tables;
  std::shared_ptr<const Tables> tables_;
};

/// How many numbers a register of this processor holds: 2, 4 or 8.
int series_width();

/// Integrates by the method of Taylor series with coefficients that the functions of `series` work
/// out. Allocates nothing.
/// \param width  of the registers that its rows are made of.
/// \throws std::invalid_argument  if this processor has no such registers.
void integrate_series(const casimir_series& series, int width, const casimir_run* run, double* x,
                      casimir_outcome* out);

}  // namespace casimir
