#pragma once

#include "tools/analysis/run/validated.hpp"
#include "tools/cli/cli.hpp"
#include "tools/section/request.hpp"

namespace casimir::tools {

/// A case file and the values of its parameters, of which some may be intervals.
struct RangedCase {
  CaseFile file;  ///< with the middles of the intervals
  ParameterValues values;
  ParameterRanges ranges;

  /// \param may_be_ranges  whether what is asked for is proved for all values at once.
  /// \throws UsageError     where that is not so, and there is a range.
  RangedCase(CaseFile given, const Common& common, bool may_be_ranges);

  /// The request. \throws UsageError  where the plane moves with a parameter that has no value.
  SectionRequest request(const Model& model, const SectionOptions& options) const;
};

}  // namespace casimir::tools
