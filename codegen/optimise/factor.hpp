#pragma once

#include "codegen/optimise/terms.hpp"

namespace casimir::codegen {

/// What `factored` takes out first where both are possible.
enum class Preference {
  best,      ///< what saves most
  sums,      ///< common sums, that is factors
  products,  ///< common products
};

/// The same outputs with fewer operations: greedily introduces variables for sums of two terms that
/// occur more than once up to a factor (x*a + x*b = x*(a + b) counts) and for products of two
/// factors that occur more than once, while that saves operations. Common sums of more terms and
/// multivariate Horner forms arise by repetition.
///
/// The greedy double- and single-cube extraction of logic synthesis (Rajski & Vasudevamurthy,
/// 1992), over the rationals. Deterministic. Cost: about quadratic in the terms of each polynomial;
/// systems with very many terms are factored by products only.
TermSystem factored(const TermSystem& system, Preference preference);

}  // namespace casimir::codegen
