#pragma once

#include <string>

#include "tools/analysis/benchmark/method_comparison.hpp"

namespace casimir::tools::html {

/// A heading and a table: each contender's time for the same errors, beside the fastest of ours.
std::string equal_error_table(const MethodComparison& contest);

/// A heading and a table: operations of the general and of the specialised code, and what the
/// former takes longer.
std::string code_table(const MethodComparison& contest);

/// All that was measured, folded away until it is asked for.
std::string rows_table(const MethodComparison& contest);

}  // namespace casimir::tools::html
