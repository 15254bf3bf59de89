#pragma once

#include <map>
#include <string>

#include "tools/cli/cli_names.hpp"

namespace casimir::tools {

/// The manual, made from the command line's own definitions: file names such as
/// "casimir-verify.1", and pages in the man macros of roff.
/// \param date  of the release, as pages show it
std::map<std::string, std::string> manual_pages(const CLI::App& program, const std::string& version,
                                                const std::string& date);

}  // namespace casimir::tools
