#pragma once

#include <string>

namespace casimir::tools {

/// Coq makes the name of a certificate's file the name of a module.
/// \throws UsageError  for a name that is no identifier with .v behind it
void check_certificate_name(const std::string& path);

}  // namespace casimir::tools
