#pragma once

namespace casimir::tools {

/// The script of a report, from the files beside this one.
extern const char* const kReportScript;
/// That of the index over all reports.
extern const char* const kIndexScript;

}  // namespace casimir::tools
