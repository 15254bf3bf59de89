#pragma once

#include <cstddef>
#include <vector>

#include "runtime/program.hpp"

namespace casimir::codegen {

/// Programs taken apart into what their run-time parameters decide and what the state does: the
/// first part is computed once for a set of parameters, the second at every call.
struct Prepared {
  /// From the parameters alone; its outputs are called k1, k2, ..
  Program prepare;
  /// The programs given, with the outputs of `prepare` as further inputs in front of the time.
  std::vector<Program> rest;
};

/// Takes apart programs with the same inputs, of which those from `first` on, `count` of them, are
/// the parameters, and the last is the time.
///
/// Factors of a product that depend on parameters only are collected from all of it, and a division
/// by parameters becomes a product with their prepared reciprocal: in floating point the results
/// may differ from those of the whole in the last digits. Over the rationals they are the same.
/// No program has more operations at a call than before.
Prepared prepared(const std::vector<Program>& programs, std::size_t first, std::size_t count);

}  // namespace casimir::codegen
