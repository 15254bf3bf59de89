#pragma once

#include <string>
#include <vector>

#include "symbolic/case/limits.hpp"

namespace casimir::tools {

/// The members of an ensemble as a CSV file gives them: columns named in its first line, and one
/// row for each member.
struct EnsembleFile {
  std::vector<std::string> columns;
  std::vector<double> values;  ///< row by row

  std::size_t rows() const { return columns.empty() ? 0 : values.size() / columns.size(); }
};

/// Reads a CSV file (RFC 4180: fields may be quoted; lines end in LF or CRLF). Every entry is an
/// exact real constant such as `0.25`, `1/3`, `1e-3`, `75*10^(-152)` or `sqrt(2)/2`, and becomes
/// the nearest double.
/// \param known  what columns may be called.
/// \param limits  of the constants: those of the case
/// \param fixed  names that would be known were they not given on the command line.
/// \throws CaseError  with the place: an unknown or repeated name, a row of another length, an
///     entry that is no such constant, nothing but a header.
/// \throws UsageError   if the file cannot be read.
EnsembleFile read_ensemble(const std::string& path, const std::vector<std::string>& known,
                           const Limits& limits, const std::vector<std::string>& fixed = {});

}  // namespace casimir::tools
